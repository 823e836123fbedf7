"""Ends of bars that bolts join to a gusset: bearing, block tearing and the moment of the pattern (EN 1993-1-8:2005).

The bar lies on the gusset with a flat part: a web, a leg, a stem or the flat bar itself. Bar and gusset have the same
distances of bolts from ends and edges. No partial factors: γ_M0 = γ_M2 = 1.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ...errors import ScenarioError
from ..arrays import FloatArray
from ..mechanics.strength import Strength
from .bolts import BoltPattern, Bolts
from .resistance import plastic_strength, strengths_pa
from .sections import FLAT_BAR, LEG, WEB, FlatPart, SteelSection

_MM = 1e-3

_MOST_BEARING = 2.5
"""k_1 at most: EN 1993-1-8:2005, table 3.4."""

_ONE_ROW = 1.5
"""Most of f_u d t that a bolt resists in bearing, of one row in single shear: 3.6.1 (10)."""

_LONG, _SHORTENS, _LEAST_LONG = 15.0, 200.0, 0.75
"""Joints longer than 15 d resist less, by 1 / 200 d of what they are longer, but 0.75 at least: 3.8 (1)."""

_ONE_LEG = {2: (0.4, 0.7), 3: (0.5, 0.7)}
"""β_2 and β_3 of angles on one leg, at pitches of 2.5 and 5 holes: table 3.8."""

_PITCHES = (2.5, 5.0)

_ONE_SIDED = 0.5
"""Part of the section in tension that counts in block tearing where the load is beside the bolts: 3.10.2 (3)."""


@dataclass(frozen=True, slots=True)
class Plate:
    """What bolts press on."""

    thickness_m: float
    yield_pa: float
    ultimate_pa: float


@dataclass(frozen=True, slots=True)
class BoltedEnd:
    """An end of a bar on a gusset, by the pattern of its bolts.

    Attributes
    ----------
    bar, gusset : Plate
        The part of the bar that lies on the gusset, and all gussets together.
    """

    bolts: Bolts
    pattern: BoltPattern
    section: SteelSection
    part: FlatPart
    bar: Plate
    gusset: Plate

    @property
    def bolt_n(self) -> float:
        """Shear of one bolt, less in long joints: 3.8."""
        diameter_m = _MM * self.bolts.diameter_mm
        beyond = (self.pattern.rows - 1) * self.pattern.pitch_m / diameter_m - _LONG
        return self.bolts.shear_n / self.bolts.count * min(1.0, max(_LEAST_LONG, 1.0 - beyond / _SHORTENS))

    @property
    def bearing_n(self) -> FloatArray:
        """Bearing of each bolt (rows, lines) along the bar, in what resists less: k_1 α_b f_u d t, table 3.4."""
        rows = (self.pattern.rows, self.pattern.pitch_m, self.pattern.end_m)
        lines = (self.pattern.lines, self.pattern.gauge_m, self.pattern.edge_m)
        return self._bearing_n(_towards_the_end(*rows, self._hole_m), _beside(*lines, self._hole_m, edges=2))

    @property
    def bearing_across_n(self) -> FloatArray:
        """The same across the bar (lines, rows), towards an edge."""
        rows = (self.pattern.rows, self.pattern.pitch_m, self.pattern.end_m)
        lines = (self.pattern.lines, self.pattern.gauge_m, self.pattern.edge_m)
        return self._bearing_n(_towards_the_end(*lines, self._hole_m), _beside(*rows, self._hole_m, edges=1))

    @property
    def bolts_n(self) -> float:
        """Axial force that all bolts resist in shear and in bearing: 3.7."""
        return self._together_n(self.bearing_n)

    @property
    def net_n(self) -> float:
        """Tension that the section between holes resists: EN 1993-1-1, equation 6.7; angles on one line by 3.10.3."""
        if self.part.kind != LEG or self.pattern.lines > 1:
            return self.bolts.net_section_n(self.section, self.bar.ultimate_pa)
        hole_m, thickness_m = self._hole_m, self.bar.thickness_m
        if self.pattern.rows == 1:
            return 2.0 * (self.pattern.edge_m - 0.5 * hole_m) * thickness_m * self.bar.ultimate_pa
        closest, widest = _PITCHES
        low, high = _ONE_LEG[min(self.pattern.rows, max(_ONE_LEG))]
        within = min(max((self.pattern.pitch_m / hole_m - closest) / (widest - closest), 0.0), 1.0)
        return (low + (high - low) * within) * self.bolts.net_area_m2(self.section) * self.bar.ultimate_pa

    @property
    def block_n(self) -> float:
        """Tension at which a block tears out of the bar or of the gusset, whichever resists less: 3.10.2.

        It tears between the outer lines, and in a bar with free edges from one of these to the farthest line.
        """
        between_m = (self.pattern.lines - 1) * (self.pattern.gauge_m - self._hole_m)
        counted = 1.0 if self.part.kind in (FLAT_BAR, WEB) else _ONE_SIDED
        blocks = [math.inf]
        if self.part.kind != WEB:
            beside_m = between_m + self.pattern.edge_m - 0.5 * self._hole_m
            blocks.append(self._block_n(self.bar, beside_m, 1, counted))
        if self.pattern.lines > 1:
            blocks += [self._block_n(self.bar, between_m, 2, counted), self._block_n(self.gusset, between_m, 2, 1.0)]
        return min(blocks)

    @property
    def axial_n(self) -> float:
        """Axial force that the end resists, by what resists least."""
        return min(self.bolts_n, self.net_n, self.block_n)

    @property
    def shear_n(self) -> float:
        """Shear in the plane of the gusset that the bolts resist, in shear and in bearing."""
        return self._together_n(self.bearing_across_n)

    @property
    def moment_nm(self) -> float:
        """Moment in the plane of the gusset at which the farthest bolt resists no more; 0 of one bolt."""
        used = self.farthest_bolt_used(0.0, 0.0, 1.0)
        return 1.0 / used if used > 0.0 else 0.0

    @property
    def bending_axis(self) -> int:
        """About which of y and z (0, 1) that moment is."""
        return 1 - self.part.along

    def bending_to_axial_ratio(self, yield_pa: float, share: float) -> tuple[float, float]:
        """Return its share of the bar's resistance in bending about y and z over its share in axial force.

        `share` is its resistance in axial force over the bar's. In the plane of the gusset the pattern resists, and the
        section between holes; out of it the end is taken to be as weak as along the bar. One bolt resists no moment:
        the bar turns about it.
        """
        bending_to_axial_ratio, axis = [1.0, 1.0], self.bending_axis
        plastic_nm = float(self.section.shape.plastic_moduli_m3[axis]) * yield_pa
        by_holes = self.bolts.net_section_n(self.section, self.bar.ultimate_pa) / (self.section.area_m2 * yield_pa)
        if self.moment_nm > 0.0:
            bending_to_axial_ratio[axis] = min(self.moment_nm / plastic_nm, by_holes) / share
        return bending_to_axial_ratio[0], bending_to_axial_ratio[1]

    def strength(self, yield_pa: float, share: float) -> Strength:
        """Return the strength of its joint, which resists a share of the axial force of the bar."""
        whole = plastic_strength(self.section, yield_pa, self.bending_to_axial_ratio(yield_pa, share))
        by_bolts_pa = self.shear_n / self.section.area_m2
        return replace(whole.times(share), shear_pa=min(float(whole.shear_pa), by_bolts_pa))

    def farthest_bolt_n(self, axial_n: float, shear_n: float, moment_nm: float) -> tuple[float, float]:
        """Return the force along the bar and across it on the bolt that carries most.

        Bolts share forces evenly, and a moment in the plane of the gusset by their distance from the middle. One of the
        four corners has all of them in the same direction.
        """
        along_m, across_m = self.pattern.half_m
        by_moment = abs(moment_nm) / self.pattern.polar_m2 if self.pattern.polar_m2 > 0.0 else 0.0
        along_n = abs(axial_n) / self.bolts.count + by_moment * across_m
        across_n = abs(shear_n) / self.bolts.count + by_moment * along_m
        return along_n, across_n

    def farthest_bolt_used(self, axial_n: float, shear_n: float, moment_nm: float) -> float:
        """Return what that bolt is used by: in shear, or in bearing along and across the bar together.

        Bearing counts as √(… ² + …²) of both directions (SCI P358, Joints in steel construction, simple joints).
        """
        along_n, across_n = self.farthest_bolt_n(axial_n, shear_n, moment_nm)
        along_used = along_n / float(self.bearing_n.min())
        across_used = across_n / float(self.bearing_across_n.min())
        in_bearing = math.sqrt(along_used * along_used + across_used * across_used)
        return max(math.sqrt(along_n * along_n + across_n * across_n) / self.bolt_n, in_bearing)

    @property
    def _hole_m(self) -> float:
        return self.bolts.hole_m

    def _bearing_n(self, towards: FloatArray, beside: FloatArray) -> FloatArray:
        """Bearing by what counts of distances along the force (k,) and across it (l,), (k, l)."""
        plates = []
        for plate in (self.bar, self.gusset):
            by_strength = min(self.bolts.ultimate_pa / plate.ultimate_pa, 1.0)
            factors = np.minimum(towards, by_strength)[:, None] * beside
            if self.bolts.planes == 1 and len(towards) == 1:
                factors = np.minimum(factors, _ONE_ROW)
            plates.append(factors * (plate.ultimate_pa * _MM * self.bolts.diameter_mm * plate.thickness_m))
        return np.minimum(*plates)

    def _together_n(self, bearing_n: FloatArray) -> float:
        """Resistance of the bolts: the sum in bearing where none shears first, else their number times the least."""
        if self.bolt_n >= float(bearing_n.max()):
            return math.fsum(bearing_n.ravel().tolist())
        return self.bolts.count * min(self.bolt_n, float(bearing_n.min()))

    def _block_n(self, plate: Plate, tension_m: float, sheared: int, counted: float) -> float:
        """Resistance of a block with a length in tension, and one or two planes in shear along the bar."""
        shear_m = self.pattern.end_m + (self.pattern.rows - 1) * self.pattern.pitch_m
        shear_m -= (self.pattern.rows - 0.5) * self._hole_m
        by_shear = sheared * shear_m * plate.yield_pa / math.sqrt(3.0)
        return plate.thickness_m * (counted * tension_m * plate.ultimate_pa + by_shear)


def bolted_end(bolts: Bolts, section: SteelSection, grade: str) -> BoltedEnd | None:
    """Return an end of a bar of a grade by the pattern of its bolts; None where that is not given.

    Raises
    ------
    ScenarioError
        No part of the section lies on a gusset, or the pattern is wider than that part.
    """
    pattern, part = bolts.pattern, section.on_gusset
    if pattern is None:
        return None
    if part is None:
        raise ScenarioError(
            f"a pattern of bolts needs a flat part that lies on a gusset, which {section.name} has not: expected a "
            "flat bar, an angle, a channel, a T- or an I-section, or bolts without distances"
        )
    wide_m = (pattern.lines - 1) * pattern.gauge_m + 2.0 * pattern.edge_m
    if wide_m > part.width_m + 1e-9:
        raise ScenarioError(
            f"the pattern of bolts needs {wide_m / _MM:.0f} mm, p2 between lines and e2 at both edges, and "
            f"{section.name} has {part.width_m / _MM:.0f} mm: expected fewer lines or smaller distances"
        )
    thickness_m = bolts.planes * pattern.gusset_m
    bar = Plate(part.thickness_m, *strengths_pa(grade, section.thickest_m))
    gusset = Plate(thickness_m, *strengths_pa(pattern.gusset_grade or grade, pattern.gusset_m))
    return BoltedEnd(bolts, pattern, section, part, bar, gusset)


def _towards_the_end(count: int, apart_m: float, end_m: float, hole_m: float) -> FloatArray:
    """α_d of bolts in line (k,); the last one pushes towards the end."""
    factors = np.full(count, apart_m / (3.0 * hole_m) - 0.25)
    factors[-1] = end_m / (3.0 * hole_m)
    return factors


def _beside(count: int, apart_m: float, edge_m: float, hole_m: float, *, edges: int) -> FloatArray:
    """k_1 of bolts side by side (k,), with an edge next to the last one or next to both outer ones."""
    inner = 1.4 * apart_m / hole_m - 1.7 if count > 1 else math.inf
    factors = np.full(count, min(inner, _MOST_BEARING))
    by_edge = min(2.8 * edge_m / hole_m - 1.7, _MOST_BEARING)
    factors[-1] = min(factors[-1], by_edge)
    if edges > 1:
        factors[0] = min(factors[0], by_edge)
    return factors
