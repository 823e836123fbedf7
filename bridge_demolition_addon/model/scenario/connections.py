"""Which shards are connected, how, and what breaks a connection."""

from collections.abc import Sequence
from dataclasses import astuple, dataclass, replace
from typing import ClassVar, Self

from ...engineering.elasticity.section_stiffness import ELASTIC_MODULI
from ...engineering.elasticity.steel_bars import USUAL_STEEL, Steel
from ...engineering.mechanics.joint import TYPES
from ...engineering.mechanics.strength import MATERIALS, NEWTON_PER_SQUARE_MILLIMETRE
from ..materials.materials import MODULUS, POISSON, Material
from ..schema import LARGEST_INTEGER, SHARE, check_exactly_one, key
from .connection_checks import check_connections
from .connections_between import OWN_MATERIAL, ConnectionBetween
from .joint_settings import ELASTIC_TYPES, STEEL_KEYS, STRENGTH_KEYS, JointSettings

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
        """Return the settings of a bridge in so many shards: large ones need no strength."""
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
