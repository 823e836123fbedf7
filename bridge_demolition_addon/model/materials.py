"""Materials of the user's own, and layers of reinforcing bars with the moments that sections with them resist."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ..engineering.arithmetic import power
from ..engineering.elasticity.section_stiffness import ELASTIC_MODULI, ElasticModuli
from ..engineering.elasticity.steel_bars import MODULUS_PA, YIELD_PA
from ..engineering.geometry.vectors import AXES, SIDES
from ..engineering.mechanics.strength import MATERIALS, NEWTON_PER_SQUARE_MILLIMETRE, Strength
from ..errors import ScenarioError
from .schema import DENSITY, POSITION, Table, given, key

MODULUS = {"unit": "N/mm²", "above": 0, "at_most": 1e7}
"""Unit and limits of a modulus of elasticity."""

POISSON = {"at_least": 0, "at_most": 0.49}
"""Limits of Poisson's ratio."""

_STRENGTH = {"unit": "N/mm²", "above": 0}


@dataclass(frozen=True, slots=True, kw_only=True)
class Material(Table):
    """A material of your own, which `connections.material` and `connections.between.material` may name: strengths that
    were measured on this bridge, or that a study samples."""

    table: ClassVar[str] = "materials"

    name: str = key("What it is called, other than the materials that come with the add-on.")
    compression_n_mm2: float = key("Strength in compression.", **_STRENGTH)
    tension_n_mm2: float = key("Strength in tension.", **_STRENGTH)
    shear_n_mm2: float = key("Strength in shear, for the mean over a section.", **_STRENGTH)
    torsion_n_mm2: float = key(
        "Strength in torsion, for the shear stress at the edge of an uncracked section.", **_STRENGTH
    )
    bending_n_mm2: float = key("Strength in bending, for the stress at the edge of an uncracked section.", **_STRENGTH)
    elastic_modulus_n_mm2: float | None = key(
        "Modulus of elasticity. Needed where connections are elastic.", default=None, **MODULUS
    )
    poisson_ratio: float = key("Poisson's ratio, where connections are elastic.", default=0.2, **POISSON)
    density_kg_m3: float | None = key(
        "Density of all members that have none of their own, where it is that of `connections.material` and the bridge "
        "gives neither `density_kg_m3` nor `mass_kg`.",
        **DENSITY,
    )

    @property
    def strength(self) -> Strength:
        return Strength.in_n_mm2(
            self.compression_n_mm2, self.tension_n_mm2, self.shear_n_mm2, self.torsion_n_mm2, self.bending_n_mm2
        )

    @property
    def moduli(self) -> ElasticModuli | None:
        """Return how it deforms; None where that is not given."""
        if self.elastic_modulus_n_mm2 is None:
            return None
        return ElasticModuli(self.elastic_modulus_n_mm2 * NEWTON_PER_SQUARE_MILLIMETRE, self.poisson_ratio)


def check_materials(materials: Iterable[Material]) -> None:
    """Check that materials differ by name from those that are known."""
    for material in materials:
        if material.name in MATERIALS:
            raise material.unexpected("name", "a name that no other material has")


def strengths(materials: Iterable[Material]) -> Mapping[str, Strength]:
    """Return the strengths of materials by name: the known ones and the user's own."""
    return MATERIALS | {material.name: material.strength for material in materials}


def moduli(materials: Iterable[Material], name: str) -> ElasticModuli:
    own = {material.name: material for material in materials}
    if name not in own:
        return ELASTIC_MODULI[name]
    material_moduli = own[name].moduli
    if material_moduli is None:
        wanted = 'it with connections.stiffness "elastic", where no connections give their own'
        raise own[name].unexpected("elastic_modulus_n_mm2", wanted)
    return material_moduli


_SQUARE_METRE_PER_SQUARE_MILLIMETRE = 1e-6

_CRUSHING_STRAIN = 0.0035
_BLOCK = 0.8
"""Strain at which concrete up to C50/60 is crushed, and depth of its stress block by that of the neutral axis:
EN 1992-1-1:2004, table 3.1 and equation 3.19. Its stress is the strength, equation 3.21, without factors of safety."""

_OF_LAYERS = (
    ("side", "bottom"),
    ("depth_m", None),
    ("area_mm2", None),
    ("from_m", None),
    ("to_m", None),
    ("anchored", True),
    ("own_axes", False),
)
"""Keys that say nothing of bars that are spread over a member, with the values by default."""

_HALVINGS = 60

_ON_CURVE = 400
"""Points of the curve of axial forces and moments that a section resists, by the depth of its neutral axis."""

_DEPTHS = -4.0, 3.0
"""Least and largest of these depths by the height, as decimal logarithms."""

_LITTLE = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class BarLayer(Table):
    """A layer of reinforcing bars in a member, or in all members of a kind, at their depth in the section. It holds a
    crack together once a connection broke by its material, with as much as the section resists at yield. It needs
    method `face`, `connections.material` and `connections.ductile_elongation_m`."""

    table: ClassVar[str] = "reinforcement"

    members: tuple[str, ...] = key("Members that have it, by the names that `bda check` lists or by kind: `['deck']`.")
    along: str = key("Axis of the bridge that the bars run along.", default="x", choices=AXES)
    side: str = key(
        "Side of the member that `depth_m` is measured from; `right` is towards negative y, `start` backwards along "
        "the road.",
        default="bottom",
        choices=tuple(SIDES),
    )
    depth_m: float | None = key(
        "How deep below that side the axes of the bars are; with `area_mm2`.", default=None, unit="m", above=0
    )
    area_mm2: float | None = key(
        "Area of steel of all bars of the layer together, in one section of one member. They are spread evenly over "
        "the width that the member has at their depth.",
        default=None,
        unit="mm²",
        above=0,
    )
    spread_mm2_m2: float | None = key(
        "Area of steel in each square metre across the bars, instead of `side`, `depth_m` and `area_mm2`: of bars that "
        "are spread over the whole member, such as links, A_sw / (s b).",
        default=None,
        unit="mm²/m²",
        above=0,
        at_most=500_000,
    )
    from_m: float | None = key(
        "Where the bars begin along their axis, in the coordinates of the bridge, and in a skewed member in the middle "
        "of the road; by default where the member does. They have their whole strength from there on, so leave out "
        "what anchors them.",
        default=None,
        **POSITION,
    )
    to_m: float | None = key("Where they end, by default where the member does.", default=None, **POSITION)
    yield_n_mm2: float = key(
        "Yield strength of the bars.",
        default=YIELD_PA / NEWTON_PER_SQUARE_MILLIMETRE,
        unit="N/mm²",
        above=0,
        at_most=5000,
    )

    diameter_mm: float = key(
        "Diameter of one bar, which decides how far a crack opens until the bars rupture, and how long straight ones "
        "are anchored.",
        default=20.0,
        unit="mm",
        above=0,
        at_most=100,
    )
    anchored: bool = key(
        "Whether bars resist their yield force up to the ends of their member, by hooks, bends, laps or in the next "
        "member. Straight ones, `false`, have less by bond alone near these ends.",
        default=True,
    )
    own_axes: bool = key(
        "Whether the bars follow a member that is curved or inclined: x runs along it from its beginning, y across it "
        "to the left and z up from its underside, for `along`, `side`, `depth_m`, `from_m` and `to_m`.",
        default=False,
    )

    @property
    def is_spread(self) -> bool:
        return self.spread_mm2_m2 is not None

    @property
    def ratio(self) -> float:
        """Area of spread bars by that across them."""
        return _SQUARE_METRE_PER_SQUARE_MILLIMETRE * given(self.spread_mm2_m2)

    def is_in(self, name: str, kind: str) -> bool:
        """Return whether a member of a name and kind has the bars."""
        return bool({name, kind} & set(self.members))

    @property
    def diameter_m(self) -> float:
        return 1e-3 * self.diameter_mm

    @property
    def area_m2(self) -> float:
        return _SQUARE_METRE_PER_SQUARE_MILLIMETRE * given(self.area_mm2)

    @property
    def yield_pa(self) -> float:
        return NEWTON_PER_SQUARE_MILLIMETRE * self.yield_n_mm2

    @property
    def axes(self) -> tuple[int, int, int]:
        """Return the axes that the bars run along, across their side and along their layer."""
        along, across = AXES.index(self.along), SIDES[self.side][0]
        return along, across, 3 - along - across

    def level_m(self, lowest: float, highest: float) -> float:
        """Return where the bars are along the axis across their side, of a member from the lowest to the highest."""
        return lowest + given(self.depth_m) if SIDES[self.side][1] < 0 else highest - given(self.depth_m)

    @property
    def ends_m(self) -> tuple[float, float]:
        """Where the bars begin and end along their axis; infinite where they do so with the member."""
        return (
            -math.inf if self.from_m is None else self.from_m,
            math.inf if self.to_m is None else self.to_m,
        )

    def _check_together(self) -> None:
        if self.is_spread:
            self._check_spread()
            return
        for name in ("depth_m", "area_mm2"):
            if getattr(self, name) is None:
                raise ScenarioError(f"reinforcement.{name} is missing: expected it, or reinforcement.spread_mm2_m2")
        begin, end = self.ends_m
        if begin >= end:
            raise self.unexpected("to_m", f"more than reinforcement.from_m, {begin:g} (m)")
        if AXES[SIDES[self.side][0]] == self.along:
            wanted = f"a side that bars along {self.along} run beside, one of {', '.join(self._sides_beside())}"
            raise self.unexpected("side", wanted)

    def _check_spread(self) -> None:
        for name, usual in _OF_LAYERS:
            if getattr(self, name) != usual:
                raise self.unexpected(name, "none with reinforcement.spread_mm2_m2, which is all over a member")

    def _sides_beside(self) -> list[str]:
        return [name for name, (axis, _) in SIDES.items() if AXES[axis] != self.along]


@dataclass(frozen=True, slots=True)
class ReinforcedSection:
    """A rectangular section, or a T, with layers of bars.

    `compressive_pa` is the strength of its concrete. Each layer has a depth below the first edge, an area and a yield
    strength; the width is along the layers, in a T the web's. A T has a `flange` at the first edge, whose width and
    depth that is.
    """

    height_m: float
    width_m: float
    compressive_pa: float
    depths_m: Sequence[float]
    areas_m2: Sequence[float]
    yields_pa: Sequence[float]
    flange: tuple[float, float] | None = None

    def moments_nm(self) -> tuple[float, float]:
        """Return the plastic moments with the first and with the other edge pressed.

        Sections stay plane, concrete in tension resists nothing, and there is no axial force: EN 1992-1-1:2004, 6.1
        (2). With one layer that yields, this is M = A_s f_y (d - a / 2) with a = A_s f_y / (b f_c).
        """
        return self._moment(from_first=True), self._moment(from_first=False)

    def utilisations(self, axial_n: np.ndarray, moments_nm: np.ndarray) -> np.ndarray:
        """Return the parts (k,) of its resistance that axial forces and moments use, which grow together.

        Forces (k,) are positive in tension; moments (k,), about half the height, where they press the first edge.
        Resistances are as in `moments_nm`, under any axial force: a convex curve around no load at all.
        """
        sides = [
            self._on_curve(from_first=True) * (1.0, 1.0),
            self._on_curve(from_first=False)[::-1] * (1.0, -1.0),
        ]
        curve = np.concatenate(sides)  # their ends meet: all bars pulled, and all of the section pressed
        edges = np.roll(curve, -1, axis=0) - curve
        outwards = np.column_stack((-edges[:, 1], edges[:, 0]))
        offsets = (outwards * curve).sum(axis=1)
        is_edge = abs(offsets) > _LITTLE * abs(offsets).max()
        loads = np.column_stack((axial_n, moments_nm))
        parts = (loads[:, None] * outwards[is_edge]).sum(axis=2) / offsets[is_edge]
        used: np.ndarray = parts.max(axis=1)
        return used

    def _on_curve(self, *, from_first: bool) -> np.ndarray:
        """Return axial forces, tension positive, and moments about half the height (k, 2) that crush an edge."""
        depths_m = np.array(self._depths_m(from_first))
        neutrals_m = self.height_m * power(10.0, np.linspace(*_DEPTHS, _ON_CURVE))
        strains = _CRUSHING_STRAIN * (depths_m - neutrals_m[:, None]) / neutrals_m[:, None]
        yields_pa = np.array(self.yields_pa)
        pulls = np.array(self.areas_m2) * np.clip(MODULUS_PA * strains, -yields_pa, yields_pa)
        pressed, by_depth = self._pressed(np.minimum(_BLOCK * neutrals_m, self.height_m), from_first)
        middle_m = 0.5 * self.height_m
        moments = (pulls * (depths_m - middle_m)).sum(axis=1) + pressed * middle_m - by_depth
        return np.column_stack((pulls.sum(axis=1) - pressed, moments))

    def across_cracks_n(self) -> list[float]:
        """Return the force at which each layer yields across a crack that closes at one of its edges.

        A crack between rigid bodies rotates about its pressed edge, and all bars are in tension; in a section concrete
        is pressed over some depth, and bars there are not. With these forces both plastic moments equal the section's.
        In pure tension they resist somewhat less than the bars.
        """
        first, other = self.moments_nm()
        pulls = [area * strength for area, strength in zip(self.areas_m2, self.yields_pa, strict=True)]
        near = [depth < 0.5 * self.height_m for depth in self.depths_m]
        of_near, by_near = self._resultant(pulls, near)
        of_far, by_far = self._resultant(pulls, [not is_near for is_near in near])
        if not of_near:
            shares = 0.0, first / by_far
        elif not of_far:
            shares = other / (self.height_m * of_near - by_near), 0.0
        else:
            shares = self._shares(first, other, (of_near, by_near), (of_far, by_far))
        return [pull * min(shares[0] if is_near else shares[1], 1.0) for pull, is_near in zip(pulls, near, strict=True)]

    def _shares(
        self, first: float, other: float, near: tuple[float, float], far: tuple[float, float]
    ) -> tuple[float, float]:
        """Return parts of the forces of near and far layers that resist both moments."""
        (of_near, by_near), (of_far, by_far) = near, far
        from_near, from_far = self.height_m * of_near - by_near, self.height_m * of_far - by_far
        whole = by_near * from_far - by_far * from_near
        of_near, of_far = (first * from_far - other * by_far) / whole, (other * by_near - first * from_near) / whole
        if of_near < 0.0:
            return 0.0, first / by_far
        return (of_near, of_far) if of_far >= 0.0 else (other / from_near, 0.0)

    def _resultant(self, pulls: Sequence[float], chosen: Sequence[bool]) -> tuple[float, float]:
        rows = [(pull, depth) for pull, depth, counts in zip(pulls, self.depths_m, chosen, strict=True) if counts]
        return math.fsum(pull for pull, _ in rows), math.fsum(pull * depth for pull, depth in rows)

    def _moment(self, *, from_first: bool) -> float:
        """Return the plastic moment with an edge pressed."""
        depths_m = self._depths_m(from_first)
        low, high = 0.0, self.height_m / _BLOCK
        for _ in range(_HALVINGS):
            neutral = 0.5 * (low + high)
            is_pulled = math.fsum(self._pulls(neutral, depths_m)) > self._pressed(_BLOCK * neutral, from_first)[0]
            low, high = (neutral, high) if is_pulled else (low, neutral)
        neutral = 0.5 * (low + high)
        pulled = math.fsum(pull * depth for pull, depth in zip(self._pulls(neutral, depths_m), depths_m, strict=True))
        return float(pulled - self._pressed(_BLOCK * neutral, from_first)[1])

    def _depths_m(self, from_first: bool) -> Sequence[float]:
        return self.depths_m if from_first else [self.height_m - depth_m for depth_m in self.depths_m]

    def _pressed(self, block_m: Any, from_first: bool) -> tuple[Any, Any]:
        """Return the force of a block, or of each of some (k,), so deep from an edge, and that by its depth there."""
        flange_m, flange_depth_m = self.flange or (self.width_m, 0.0)
        if from_first:
            of_flange = np.minimum(block_m, flange_depth_m)
            lever_m = 0.5 * of_flange
        else:
            of_flange = np.maximum(block_m - (self.height_m - flange_depth_m), 0.0)
            lever_m = block_m - 0.5 * of_flange
        web, beside = self.width_m * block_m, (flange_m - self.width_m) * of_flange
        return self.compressive_pa * (web + beside), self.compressive_pa * (0.5 * block_m * web + lever_m * beside)

    def _pulls(self, neutral_m: float, depths_m: Sequence[float]) -> list[float]:
        """Return forces of the layers with the neutral axis so deep, as concrete is crushed; tension positive."""
        strains = [_CRUSHING_STRAIN * (depth - neutral_m) / neutral_m for depth in depths_m]
        return [
            area * min(max(MODULUS_PA * strain, -strength), strength)
            for strain, area, strength in zip(strains, self.areas_m2, self.yields_pa, strict=True)
        ]
