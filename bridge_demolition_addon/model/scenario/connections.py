"""Which shards are connected, how, what breaks a connection, and what it is to the solver."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import astuple, dataclass, replace
from typing import ClassVar, Self

from ...engineering.elasticity.section_stiffness import ELASTIC_MODULI, ElasticModuli
from ...engineering.elasticity.steel_bars import MODULUS_PA, USUAL_STEEL, Steel
from ...engineering.mechanics.strength import MATERIALS, NEWTON_PER_SQUARE_MILLIMETRE, SMEARED, TYPES, Joint, Strength
from ...errors import ScenarioError
from ..materials import MODULUS, POISSON, Material, moduli, strengths
from ..schema import LARGEST_INTEGER, SHARE, check_exactly_one, expected, given, key
from .joint_settings import ELASTIC_TYPES, OWN_MATERIAL, STEEL_KEYS, STRENGTH_KEYS, ConnectionBetween, JointSettings

LARGE_MODEL = 1000
"""Shards from which on a bridge is large. The report of 2019, whose models have hundreds (section 2.5.2), means its one
breaking force for all connections of these: the finer a bridge is cut, the more of them hold a section."""

MATERIAL_OF_LARGE_MODELS = "reinforced concrete slab"
"""What connections of a large model break by where no strength is given: of the reinforced concretes the weakest."""


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
        or_else=OWN_MATERIAL,
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

    def with_strength(self, shards: int) -> Self:
        """Return the settings of a bridge in a number of shards: large ones need no strength."""
        if not self.has_strength and shards >= LARGE_MODEL and self.method == "face":
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
        tables = [table for table in self.tables if not getattr(table, "none", False)]
        return all(
            (table.type or self.type) in ELASTIC_TYPES
            and (table is self or table.breaking_force_newton is None)
            and (table.elastic_modulus_n_mm2 is not None or (table.material or self.material) in known)
            for table in tables
        )

    @property
    def tables(self) -> "tuple[ConnectionSettings | ConnectionBetween, ...]":
        return (self, *self.between)

    @property
    def has_strength(self) -> bool:
        return any(getattr(self, name) is not None for name in STRENGTH_KEYS)

    def _check_together(self) -> None:
        check_connections(self)

    def check_no_steel(self) -> None:
        """Check that no steel is described where there is no reinforcement."""
        for name in STEEL_KEYS:
            if getattr(self, name) is not None:
                wanted = "none where connections.ductile_share is 0 and there is no [[reinforcement]]"
                raise self.unexpected(name, wanted)
        self.check_no_layers()

    def check_no_layers(self) -> None:
        """Check that nothing is said of cracks in shards where no layers of bars run through these."""
        if self.cracks_within_shards:
            raise self.unexpected("cracks_within_shards", "false where there is no [[reinforcement]]")


_BY_STRESS = 'with stiffness "elastic"; elastic connections break by stress, not by one force'


def check_connections(settings: ConnectionSettings) -> None:
    """Check the values of connections against each other.

    Raises
    ------
    ScenarioError
        Where they do not fit, with the key and what is expected.
    """
    if settings.has_strength:
        check_exactly_one(settings, *STRENGTH_KEYS)
    for table in settings.tables:
        _check_material(settings, table)
        if not isinstance(table, ConnectionBetween) or table.changes_joint:
            table.check_type(table.type or settings.type)
    _check_ductility(settings)
    _check_steel(settings)
    if settings.warm_up_damping > 0.0 and settings.warm_up_s == 0.0:
        raise settings.unexpected("warm_up_damping", "0 where connections.warm_up_s is 0")
    _check_elastic(settings)
    _check_method(settings, "search_radius_m", "a number above 0 (m)", ("vertex", "centre"))
    _check_method(settings, "neighbours", "a whole number of at least 1", ("nearest",))


def _check_material(settings: ConnectionSettings, table: ConnectionSettings | ConnectionBetween) -> None:
    """Check that a material is given only where connections have an area."""
    if table.material is None or settings.method == "face":
        return
    wanted = f'method "face" with it, found "{settings.method}"'
    if table.material not in MATERIALS:
        wanted += f", and {expected(table.__dataclass_fields__['material'])}"
    raise table.unexpected("material", wanted)


def _check_ductility(settings: ConnectionSettings) -> None:
    """Check that smeared reinforcement has concrete around it, and an elongation."""
    if settings.ductile_share == 0.0:
        return
    if settings.material is None:
        raise settings.unexpected("ductile_share", "0 where connections.material is not given")
    if settings.ductile_elongation_m is None:
        wanted = "a number above 0 (m) with a connections.ductile_share above 0"
        raise settings.unexpected("ductile_elongation_m", wanted)


def _check_steel(settings: ConnectionSettings) -> None:
    """Check that the steel is described only where it counts, and yields before it ruptures."""
    for name in STEEL_KEYS:
        if getattr(settings, name) is not None and settings.stiffness == "rigid":
            wanted = 'none but with connections.stiffness "elastic"'
            raise settings.unexpected(name, wanted)
    is_given = settings.ductile_rupture_strain is not None
    rupture = USUAL_STEEL.rupture_strain if settings.ductile_rupture_strain is None else settings.ductile_rupture_strain
    yield_pa = USUAL_STEEL.yield_pa
    if settings.ductile_yield_n_mm2 is not None:
        yield_pa = settings.ductile_yield_n_mm2 * NEWTON_PER_SQUARE_MILLIMETRE
    if rupture <= yield_pa / MODULUS_PA:
        wanted = f"less: by 200 000 N/mm² it would be a strain above that at rupture, {rupture:g}"
        if is_given:
            wanted = f"more than {yield_pa / MODULUS_PA:.3g}, the strain at which the reinforcement yields"
        raise settings.unexpected("ductile_rupture_strain" if is_given else "ductile_yield_n_mm2", wanted)


def _check_elastic(settings: ConnectionSettings) -> None:
    """Check that keys of elastic connections go with them, and that none is missing."""
    if settings.stiffness is None:
        return
    if not settings.is_elastic:
        for table in settings.tables:
            for name in ("elastic_modulus_n_mm2", "poisson_ratio", "damping_ratio"):
                if getattr(table, name, None) is not None:
                    raise table.unexpected(name, 'none where connections.stiffness is "rigid"')
        return
    if settings.method != "face":
        raise settings.unexpected("method", '"face" with stiffness "elastic", which takes the area of shared faces')
    if settings.material is None and settings.has_strength:
        raise ScenarioError(f"connections.material is missing: expected it {_BY_STRESS}")
    for table in settings.tables:
        kind = table.type or settings.type
        if kind not in ELASTIC_TYPES and not getattr(table, "none", False):
            raise table.unexpected("type", f'one of {", ".join(ELASTIC_TYPES)} with stiffness "elastic"')
        if table is not settings and table.breaking_force_newton is not None:
            raise ScenarioError(f"{table.table} has a breaking force: expected a material {_BY_STRESS}")


def _check_method(settings: ConnectionSettings, name: str, wanted: str, methods: tuple[str, ...]) -> None:
    is_given, is_needed = getattr(settings, name) is not None, settings.method in methods
    if is_given != is_needed:
        raise settings.unexpected(name, f'{wanted if is_needed else "none"} with method "{settings.method}"')


def joints_of_connections(
    settings: ConnectionSettings, materials: Sequence[Material] = (), *, have_bars: bool = False
) -> tuple[Joint, ...]:
    """Return the joint of connections that follow no rule, then that of each rule.

    In members that have bars, concrete has no steel that is smeared.
    """
    known = {name: strength.times(settings.strength_factor) for name, strength in strengths(materials).items()}
    _check_materials(settings, known)
    if have_bars:
        known |= {name: known[plain] for name, plain in SMEARED.items()}
    factor = settings.strength_factor
    own = Joint(
        settings.type,
        settings.free or (),
        settings.springs,
        _times(factor, settings.breaking_force_newton),
        known[settings.material] if settings.material else None,
        _moduli(settings, materials) if settings.is_elastic else None,
    )
    return (own, *(_joint_between(own, rule, factor, known, materials) for rule in settings.between))


def _check_materials(settings: ConnectionSettings, known: Collection[str]) -> None:
    for table in settings.tables:
        if table.material is not None and table.material not in known:
            raise table.unexpected("material", expected(table.__dataclass_fields__["material"]))


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
    """Return given moduli, or else a material's, or else the moduli of the other connections."""
    young, poisson = settings.elastic_modulus_n_mm2, settings.poisson_ratio
    if young is not None and poisson is not None:
        return ElasticModuli(young * NEWTON_PER_SQUARE_MILLIMETRE, poisson)
    known = moduli(materials, settings.material) if settings.material else others
    return ElasticModuli(
        given(known).young_pa if young is None else young * NEWTON_PER_SQUARE_MILLIMETRE,
        given(known).poisson if poisson is None else poisson,
    )
