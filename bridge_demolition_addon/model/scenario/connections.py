"""Which shards are connected, how, and what breaks a connection: for all of them, and between certain members."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import Field, astuple, dataclass, fields, replace
from typing import Any, ClassVar, Self

from ...engineering.elasticity.section_stiffness import ELASTIC_MODULI, ElasticModuli
from ...engineering.elasticity.steel_bars import MODULUS_PA, USUAL_STEEL, Steel
from ...engineering.mechanics.joint import MOTIONS, TYPES, Joint, Springs
from ...engineering.mechanics.strength import MATERIALS, NEWTON_PER_SQUARE_MILLIMETRE, SMEARED, Strength
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...errors import ScenarioError
from ..materials.materials import MODULUS, POISSON, Material, moduli, strengths
from ..schema import LARGEST_INTEGER, SHARE, Table, check_exactly_one, expected, given, key

_SPRINGS = {
    "move": ("stiffness_n_m", "damping_ns_m"),
    "turn": ("turning_stiffness_nm_rad", "turning_damping_nms_rad"),
}
"""Keys of the springs, stiffness and damping, in each kind of motion."""

_SPRING_KEYS = (*_SPRINGS["move"], *_SPRINGS["turn"])

_STIFFENED = "Bullet softens what is stiffer than a 16th of the body's {} by the square of the sub-step."


class _Breaking(Table):
    """Base of the tables of connections that break by a force."""

    __slots__ = ()
    breaking_force_n: float | None
    breaking_force_kgf: float | None

    @property
    def breaking_force_newton(self) -> float | None:
        """Return the force that breaks it, N; None where none was given."""
        if self.breaking_force_kgf is not None:
            return self.breaking_force_kgf * STANDARD_GRAVITY_M_S2
        return self.breaking_force_n


@dataclass(frozen=True, slots=True, kw_only=True)
class JointSettings(_Breaking):
    """The type of a connection, what is free in it, and its springs; each table of these also has a breaking force."""

    type: str | None = key(
        "Kind of rigid-body constraint, as in `[connections]`.", default=None, choices=TYPES, label="Joint Model"
    )
    free: tuple[str, ...] | None = key(
        "Motions that a `GENERIC` or `GENERIC_SPRING` connection allows, along and about the axes of the bridge: "
        '`["move x", "turn y"]` for a bearing that slides along the road and turns about the axis across it.',
        default=None,
        choices=MOTIONS,
    )
    stiffness_n_m: float | None = key(
        f"Stiffness of a `GENERIC_SPRING` along its free axes. {_STIFFENED.format('mass')}",
        default=None,
        unit="N/m",
        above=0,
    )
    damping_ns_m: float | None = key("Damping with it.", default=None, unit="N·s/m", at_least=0)
    turning_stiffness_nm_rad: float | None = key(
        f"Stiffness of a `GENERIC_SPRING` about its free axes. {_STIFFENED.format('moment of inertia')}",
        default=None,
        unit="N·m/rad",
        above=0,
    )
    turning_damping_nms_rad: float | None = key("Damping with it.", default=None, unit="N·m·s/rad", at_least=0)

    @property
    def springs(self) -> Springs:
        return Springs(**{name: getattr(self, name) or 0.0 for name in _SPRING_KEYS})

    def check_type(self, kind: str) -> None:
        """Check that what is free and the springs go with the type of the connection."""
        wrong = {"free": kind not in ("GENERIC", "GENERIC_SPRING")}
        wrong |= {name: kind != "GENERIC_SPRING" for name in _SPRING_KEYS}
        for name, is_wrong in wrong.items():
            if is_wrong and getattr(self, name) is not None:
                raise self.unexpected(name, f'none with type "{kind}"')
        if kind != "GENERIC_SPRING":
            return
        free = " ".join(self.free or ())
        for motion, (stiffness, damping) in _SPRINGS.items():
            if getattr(self, stiffness) is not None and motion not in free:
                raise ScenarioError(f'{self.table}.{stiffness} is given: expected a "{motion}" in {self.table}.free')
            if getattr(self, damping) is not None and getattr(self, stiffness) is None:
                raise ScenarioError(f"{self.table}.{damping} is given: expected {self.table}.{stiffness} with it")
        if not any(getattr(self, name) for name in _SPRING_KEYS):
            raise ScenarioError(
                f"{self.table}.stiffness_n_m is missing: expected it or {self.table}.turning_stiffness_nm_rad "
                'with type "GENERIC_SPRING"'
            )


GROUND_NAME = "ground"

LARGE_MODEL = 1000
"""Shards from which on a bridge is large. The report of 2019, whose models have hundreds (section 2.5.2), means its one
breaking force for all connections of these: the finer a bridge is cut, the more of them hold a section."""

MATERIAL_OF_LARGE_MODELS = "reinforced concrete slab"
"""What connections of a large model break by where no strength is given: of the reinforced concretes the weakest."""

STRENGTH_KEYS = ("breaking_force_n", "breaking_force_kgf", "material")
"""Keys of which one says what breaks a connection."""

ELASTIC_TYPES = ("FIXED", "GENERIC", "GENERIC_SPRING")
"""Kinds of connections that can be elastic: those whose rows Bullet lets be changed."""

_OWN_MATERIAL = "the name of one of `[[materials]]`"

_STEEL = ("ductile_yield_n_mm2", "ductile_hardening", "ductile_rupture_strain")

_JOINT = tuple(item.name for item in fields(JointSettings))


@dataclass(frozen=True, slots=True, kw_only=True)
class ConnectionBetween(JointSettings):
    """Connections between two members, or two kinds of members, that differ from the others: bearings, joints, gaps.
    Keys that are left out are as in `[connections]`, with one exception: once `type`, `free` or a spring is given here,
    `free` and the springs of `[connections]` do not count. The first of these tables that names both members counts.
    """

    table: ClassVar[str] = "connections.between"

    members: tuple[str, str] = key(
        'The two members, each by the name that `bda check` lists or by kind, or `"ground"` for the foundations: '
        '`["deck", "pier cap"]`. Give the same twice for connections within a member.'
    )
    none: bool = key("Whether there are no connections between them at all; then give nothing else.", default=False)
    breaking_force_n: float | None = key("Force that breaks it.", default=None, unit="N", above=0)
    breaking_force_kgf: float | None = key(
        "Force that breaks it, 1 kgf = 9.80665 N.", default=None, unit="kgf", above=0
    )
    material: str | None = key(
        "Material by whose strengths it breaks; with method `face`. Give at most one of this, `breaking_force_n` and "
        "`breaking_force_kgf`.",
        default=None,
        choices=tuple(MATERIALS),
        or_else=_OWN_MATERIAL,
    )
    elastic_modulus_n_mm2: float | None = key(
        "Modulus of elasticity, where connections are elastic, if it is not the material's.", default=None, **MODULUS
    )
    poisson_ratio: float | None = key(
        "Poisson's ratio, where connections are elastic, if it is not the material's.", default=None, **POISSON
    )

    @property
    def changes_joint(self) -> bool:
        """Return whether type, freedom or springs are given; then those of `[connections]` do not count."""
        return any(getattr(self, name) is not None for name in _JOINT)

    def _check_together(self) -> None:
        breaking = [name for name in STRENGTH_KEYS if getattr(self, name) is not None]
        others = breaking + [name for name in _JOINT if getattr(self, name) is not None]
        if self.none and others:
            raise ScenarioError(f"{self.table}.none is true: expected nothing else but members, found {others[0]}")
        if len(breaking) > 1:
            listed = " and ".join(f"{self.table}.{name}" for name in breaking)
            raise ScenarioError(f"{listed} are given together: expected at most one of them")


@dataclass(frozen=True, slots=True, kw_only=True)
class ConnectionSettings(JointSettings):
    """Which shards are connected, how, and what breaks a connection."""

    table: ClassVar[str] = "connections"

    type: str = key(
        "Kind of rigid-body constraint: `FIXED` holds everything, `POINT` a point, `HINGE` all but the rotation about "
        "the vertical, `GENERIC` all but what is `free`, and `GENERIC_SPRING` has springs in what is.",
        default="HINGE",
        choices=TYPES,
        label="Joint Model",
    )
    method: str = key(
        "Which shards are connected: those whose nearest vertices (`vertex`) or centres of mass (`centre`) lie within "
        "`search_radius_m`, those that share a face (`face`), or each with as many as `neighbours` says whose centres "
        "of mass are nearest to its own (`nearest`).",
        default="vertex",
        choices=("vertex", "centre", "face", "nearest"),
        label="How Neighbours Are Found",
    )
    search_radius_m: float | None = key(
        "Distance up to which shards are connected. Needed for `vertex` and `centre`, and only for them.",
        default=None,
        unit="m",
        above=0,
    )
    neighbours: int | None = key(
        "How many of its nearest each shard is connected with; a shard may be among the nearest of more. Needed for "
        "`nearest`, and only for it.",
        default=None,
        at_least=1,
        at_most=LARGEST_INTEGER,
    )
    limit_per_shard: int = key(
        "Most connections of one shard; the nearest are kept.", default=50, at_least=1, at_most=LARGEST_INTEGER
    )
    breaking_force_n: float | None = key(
        "Force that breaks a connection, the same for all however finely the bridge is cut. Give this, "
        "`breaking_force_kgf` or `material`.",
        default=None,
        unit="N",
        above=0,
    )
    breaking_force_kgf: float | None = key(
        "Force that breaks a connection, 1 kgf = 9.80665 N. Give this, `breaking_force_n` or `material`.",
        default=None,
        unit="kgf",
        above=0,
    )
    material: str | None = key(
        "Material by whose strengths a connection breaks, under axial force, shear and bending together; with method "
        "`face`, as it takes the area of the shared face. Give this, `breaking_force_n` or `breaking_force_kgf`. "
        f"With method `face` and `fracture.shards` of {LARGE_MODEL} or more none is needed: they then break by that of "
        f"`{MATERIAL_OF_LARGE_MODELS}`.",
        default=None,
        choices=tuple(MATERIALS),
        or_else=_OWN_MATERIAL,
    )
    strength_factor: float = key(
        "Factor on all strengths and breaking forces, also on those between certain members: for a bridge that is "
        "weaker or stronger throughout, which a study may sample.",
        default=1.0,
        above=0,
        at_most=100,
    )
    stiffness: str | None = key(
        "Whether connections hold bodies rigidly, so that redundant ones share a load as the solver leaves it "
        "(`rigid`, as in 2019), or deform by their material, so that loads go where stiffness sends them (`elastic`). "
        "`elastic` needs method `face`, a material with a modulus of elasticity, and `type` `FIXED` or `GENERIC`. If "
        "it is left out connections are elastic where they can be.",
        default=None,
        choices=("rigid", "elastic"),
    )
    elastic_modulus_n_mm2: float | None = key(
        "Modulus of elasticity, with `stiffness` `elastic`, if it is not the material's.", default=None, **MODULUS
    )
    poisson_ratio: float | None = key(
        "Poisson's ratio, with `stiffness` `elastic`, if it is not the material's.", default=None, **POISSON
    )
    damping_ratio: float | None = key(
        "Damping of the first frequency as a share of the critical one, with `stiffness` `elastic`; 0.05 where it is "
        "left out. It also holds for what is left when supports go. Steps in time damp by π × frequency × sub-step at "
        "least.",
        default=None,
        **SHARE,
    )
    ductile_share: float = key(
        "Part of a material's tensile strength that a connection keeps when it breaks, as reinforcement across the "
        "crack: the force at which that yields, by area. 0 for none.",
        default=0.0,
        **SHARE,
    )
    ductile_elongation_m: float | None = key(
        "How far the crack opens before the reinforcement ruptures. Needed with `ductile_share`. Bars of "
        "`[[reinforcement]]` without it rupture as their steel and bond say: `bda check` prints at which opening.",
        default=None,
        unit="m",
        above=0,
    )
    ductile_yield_n_mm2: float | None = key(
        "Yield strength of the reinforcement, with `stiffness` `elastic`; where it is left out that of "
        "`[[reinforcement]]`, in the mean by area, or 500. Until then it stretches by its modulus of elasticity, "
        "200 000 N/mm².",
        default=None,
        unit="N/mm²",
        above=0,
        at_most=5000,
    )
    ductile_hardening: float | None = key(
        "Tensile strength of the reinforcement over its yield strength, with `stiffness` `elastic`; 1.08 where it is "
        "left out, as of class B in EN 1992-1-1, table C.1.",
        default=None,
        at_least=1,
        at_most=3,
    )
    ductile_rupture_strain: float | None = key(
        "Strain at which the reinforcement ruptures, with `stiffness` `elastic`; 0.05 where it is left out, as of "
        "class B. `ductile_elongation_m` by this is the length over which a bar stretches at a crack.",
        default=None,
        above=0,
        at_most=0.5,
    )
    cracks_within_shards: bool = key(
        "Whether concrete cracks within shards as it does between them, with `stiffness` `elastic` and bars in layers "
        "or by a rule. Bars then stretch from the middle of a shard to that of the next, as in the fully cracked state "
        "of EN 1992-1-1, 7.4.3, or of EN 1994-1-1, 5.4.2.3. Otherwise they stretch at the cracks between shards alone.",
        default=False,
    )
    warm_up_s: float = key(
        "Time from the start in which no connection breaks, so that the bridge settles under its own weight; shards "
        "that start deactivated do not settle.",
        default=0.0,
        unit="s",
        at_least=0,
    )
    warm_up_damping: float = key(
        "Share of all velocities that shards lose in one second of the warm-up, above their own damping, so that they "
        "are at rest when it ends: `0.99` or more.",
        default=0.0,
        **SHARE,
    )
    foundation: bool = key("Whether shards that stand on the ground are connected to it.", default=True)
    between: tuple[ConnectionBetween, ...] = ()

    @property
    def steel(self) -> Steel:
        """Return what the reinforcement of elastic connections is made of."""
        return self.steel_or(USUAL_STEEL)

    def steel_or(self, other: Steel) -> Steel:
        """Return the same, with the values of another steel where none are given."""
        own = self.ductile_yield_n_mm2, self.ductile_hardening, self.ductile_rupture_strain
        columns = zip(own, (NEWTON_PER_SQUARE_MILLIMETRE, 1.0, 1.0), astuple(other), strict=True)
        return Steel(*(usual if value is None else unit * value for value, unit, usual in columns))

    @property
    def is_elastic(self) -> bool:
        return self.stiffness == "elastic"

    def joints(self, materials: Sequence[Material] = (), *, have_bars: bool = False) -> tuple[Joint, ...]:
        """Return the joint of connections that follow no rule, then that of each rule.

        In members that have bars, concrete has no steel that is smeared.
        """
        known = {name: strength.times(self.strength_factor) for name, strength in strengths(materials).items()}
        self._check_materials(known)
        if have_bars:
            known |= {name: known[plain] for name, plain in SMEARED.items()}
        factor = self.strength_factor
        own = Joint(
            self.type,
            self.free or (),
            self.springs,
            _times(factor, self.breaking_force_newton),
            known[self.material] if self.material else None,
            _moduli(self, materials) if self.is_elastic else None,
        )
        return (own, *(_joint_between(own, rule, factor, known, materials) for rule in self.between))

    def with_strength(self, shards: int) -> Self:
        """Return the settings of a bridge in so many shards: large ones need no strength."""
        if not self._has_strength and shards >= LARGE_MODEL and self.method == "face":
            return replace(self, material=MATERIAL_OF_LARGE_MODELS)
        check_exactly_one(self, *STRENGTH_KEYS)
        return self

    def with_stiffness(self, materials: Sequence[Material]) -> Self:
        """Return the settings with a stiffness: elastic where none is given and nothing is against it."""
        if self.stiffness is not None:
            return self
        return replace(self, stiffness="elastic" if self._can_be_elastic(materials) else "rigid")

    def _can_be_elastic(self, materials: Sequence[Material]) -> bool:
        if self.method != "face" or self.material is None:
            return False
        known = set(ELASTIC_MODULI) | {material.name for material in materials if material.moduli}
        tables = [table for table in self._tables if not getattr(table, "none", False)]
        return all(
            (table.type or self.type) in ELASTIC_TYPES
            and (table is self or table.breaking_force_newton is None)
            and (table.elastic_modulus_n_mm2 is not None or (table.material or self.material) in known)
            for table in tables
        )

    @property
    def _tables(self) -> "tuple[ConnectionSettings | ConnectionBetween, ...]":
        return (self, *self.between)

    @property
    def _has_strength(self) -> bool:
        return any(getattr(self, name) is not None for name in STRENGTH_KEYS)

    def _check_together(self) -> None:
        if self._has_strength:
            check_exactly_one(self, *STRENGTH_KEYS)
        for table in self._tables:
            if table.material is not None and self.method != "face":
                wanted = f'method "face" with it, found "{self.method}"'
                if table.material not in MATERIALS:
                    wanted += f", and {expected(_field(table, 'material'))}"
                raise table.unexpected("material", wanted)
            if isinstance(table, ConnectionSettings) or table.changes_joint:
                table.check_type(table.type or self.type)
        if self.ductile_share > 0.0 and self.material is None:
            raise self.unexpected("ductile_share", "0 where connections.material is not given")
        if self.ductile_share > 0.0 and self.ductile_elongation_m is None:
            raise self.unexpected(
                "ductile_elongation_m", "a number above 0 (m) with a connections.ductile_share above 0"
            )
        self._check_steel()
        if self.warm_up_damping > 0.0 and self.warm_up_s == 0.0:
            raise self.unexpected("warm_up_damping", "0 where connections.warm_up_s is 0")
        self._check_elastic()
        self._check_method("search_radius_m", "a number above 0 (m)", ("vertex", "centre"))
        self._check_method("neighbours", "a whole number of at least 1", ("nearest",))

    def check_no_steel(self) -> None:
        """Check that no steel is described where there is no reinforcement."""
        for name in _STEEL:
            if getattr(self, name) is not None:
                wanted = "none where connections.ductile_share is 0 and there is no [[reinforcement]]"
                raise self.unexpected(name, wanted)
        self.check_no_layers()

    def check_no_layers(self) -> None:
        """Check that nothing is said of cracks in shards where no layers of bars run through these."""
        if self.cracks_within_shards:
            raise self.unexpected("cracks_within_shards", "false where there is no [[reinforcement]]")

    def _check_steel(self) -> None:
        """Check that the steel is described only where it counts, and yields before it ruptures."""
        for name in _STEEL:
            if getattr(self, name) is not None and self.stiffness == "rigid":
                wanted = 'none but with connections.stiffness "elastic"'
                raise self.unexpected(name, wanted)
        is_given = self.ductile_rupture_strain is not None
        rupture = USUAL_STEEL.rupture_strain if self.ductile_rupture_strain is None else self.ductile_rupture_strain
        yield_pa = USUAL_STEEL.yield_pa
        if self.ductile_yield_n_mm2 is not None:
            yield_pa = self.ductile_yield_n_mm2 * NEWTON_PER_SQUARE_MILLIMETRE
        if rupture <= yield_pa / MODULUS_PA:
            wanted = f"less: by 200 000 N/mm² it would be a strain above that at rupture, {rupture:g}"
            if is_given:
                wanted = f"more than {yield_pa / MODULUS_PA:.3g}, the strain at which the reinforcement yields"
            raise self.unexpected("ductile_rupture_strain" if is_given else "ductile_yield_n_mm2", wanted)

    def _check_elastic(self) -> None:
        """Check that keys of elastic connections go with them, and that none is missing."""
        if self.stiffness is None:
            return
        names = ("elastic_modulus_n_mm2", "poisson_ratio", "damping_ratio")
        for table in self._tables:
            for name in names:
                if not self.is_elastic and getattr(table, name, None) is not None:
                    raise table.unexpected(name, 'none where connections.stiffness is "rigid"')
        if not self.is_elastic:
            return
        if self.method != "face":
            raise self.unexpected("method", '"face" with stiffness "elastic", which takes the area of shared faces')
        if self.material is None and self._has_strength:
            raise ScenarioError(
                'connections.material is missing: expected it with stiffness "elastic"; elastic connections break by '
                "stress, not by one force"
            )
        for table in self._tables:
            kind = table.type or self.type
            if kind not in ELASTIC_TYPES and not getattr(table, "none", False):
                raise table.unexpected("type", f'one of {", ".join(ELASTIC_TYPES)} with stiffness "elastic"')
            if table is not self and table.breaking_force_newton is not None:
                raise ScenarioError(
                    f'{table.table} has a breaking force: expected a material with stiffness "elastic"; elastic '
                    "connections break by stress, not by one force"
                )

    def _check_materials(self, known: Collection[str]) -> None:
        for table in self._tables:
            if table.material is not None and table.material not in known:
                raise table.unexpected("material", expected(_field(table, "material")))

    def _check_method(self, name: str, wanted: str, methods: tuple[str, ...]) -> None:
        is_given, is_needed = getattr(self, name) is not None, self.method in methods
        if is_given != is_needed:
            raise self.unexpected(name, f'{wanted if is_needed else "none"} with method "{self.method}"')


def _field(table: Table, name: str) -> Field[Any]:
    return next(item for item in fields(table) if item.name == name)


def _joint_between(
    own: Joint,
    rule: ConnectionBetween,
    factor: float,
    known: Mapping[str, Strength],
    materials: Sequence[Material],
) -> Joint:
    kind = rule.type or own.type
    free, springs = (rule.free or (), rule.springs) if rule.changes_joint else (own.free, own.springs)
    force, strength = _times(factor, rule.breaking_force_newton), known[rule.material] if rule.material else None
    if force is None and strength is None:
        force, strength = own.breaking_force_n, own.strength
    own_moduli = _moduli(rule, materials, own.moduli) if own.moduli else None
    return Joint(kind, free, springs, force, strength, own_moduli)


def _times(factor: float, force_n: float | None) -> float | None:
    return None if force_n is None else factor * force_n


def _moduli(
    settings: ConnectionSettings | ConnectionBetween,
    materials: Sequence[Material],
    others: ElasticModuli | None = None,
) -> ElasticModuli:
    """Return moduli that are given, or else those of a material, or else of the other connections."""
    young, poisson = settings.elastic_modulus_n_mm2, settings.poisson_ratio
    if young is not None and poisson is not None:
        return ElasticModuli(young * NEWTON_PER_SQUARE_MILLIMETRE, poisson)
    known = moduli(materials, settings.material) if settings.material else others
    return ElasticModuli(
        given(known).young_pa if young is None else young * NEWTON_PER_SQUARE_MILLIMETRE,
        given(known).poisson if poisson is None else poisson,
    )
