"""Faces of connections as the rectangles that cracks have in their place, and the bars across these."""

from __future__ import annotations

from dataclasses import dataclass

from ..arrays import FloatArray, IntArray
from ..elasticity.cracks import Cracks, corner_positions, corner_shares
from ..elasticity.joint_rows import components_first, matrix_products
from ..elasticity.steel_bars import Steel
from ..geometry.vectors import transformed, transformed_back
from .reinforcement import FaceBars
from .strength import rectangular_sections


@dataclass(frozen=True, slots=True, eq=False)
class TornFaces:
    """Some connections `rows` (r,) that crack, between bodies `first` and `second` (r,)."""

    rows: IntArray
    first: IntArray
    second: IntArray
    points_m: FloatArray  # (r, 3), middles of their faces
    axes: FloatArray  # (r, 3, 3), of their sections, the first along the normal
    signs: FloatArray  # (r,), 1 where the normal points to the second body, -1 where to the first


class CrackFaces:
    """Rectangles with the areas (m,) and second moments (m, 2, 2) of the faces of m connections, crossed by bars."""

    def __init__(self, areas_m2: FloatArray, second_moments_m4: FloatArray, bars: FaceBars):
        sections = rectangular_sections(areas_m2, second_moments_m4)
        self._sides_m = 6.0 * sections.bending_moduli_m3[:, ::-1].T / areas_m2
        self._across = components_first(sections.directions)
        self._bars = bars
        offsets = components_first(transformed_back(sections.directions, bars.offsets_m))
        self._yield_n = bars.yield_n * corner_shares(offsets, self._sides_m)

    def cracks(self, steel: Steel, left: FloatArray, pressed_n_m: FloatArray) -> Cracks:
        """Return the cracks, none at first; `left` (m,) and `pressed_n_m` (m,) are as in `Cracks`."""
        return Cracks(steel, self._bars.openings_m, self._yield_n, left, pressed_n_m)

    def tear(self, cracks: Cracks, torn: TornFaces, positions_m: FloatArray, rotations: FloatArray) -> None:
        """Add cracks in place of faces, with bodies at positions (3, n) in rotations (3, 3, n)."""
        rows, axes = torn.rows, torn.axes
        across = matrix_products(components_first(axes)[:, 1:], self._across[..., rows])
        places = corner_positions(components_first(torn.points_m), across, self._sides_m[:, rows])
        outwards = torn.signs * components_first(axes[:, :, 0])
        along = torn.signs * components_first(transformed(axes, self._bars.directions[rows]))
        cracks.add(rows, torn.first, torn.second, places, outwards, along, positions_m, rotations)
