"""Faces of connections as the rectangles that cracks have in their place, and the bars across these."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..arrays import FloatArray, IntArray
from ..elasticity.cracks import Cracks, corner_positions, corner_shares
from ..elasticity.joint_rows import components_first, cross_products, dot_products, matrix_products
from ..elasticity.steel_bars import Steel, SteelOfBars
from ..geometry.vectors import transformed, transformed_back
from .reinforcement import FaceBars
from .strength import rectangular_sections

_EDGE_BY_FIBRE = 3.0
"""How far the edges of a rectangle are from its middle, 3 W / A, by how far the fibres of a hinge are, W / A."""


@dataclass(frozen=True, slots=True, eq=False)
class TornFaces:
    """Some connections `rows` (r,) that crack, between bodies `first` and `second` (r,)."""

    rows: IntArray
    first: IntArray
    second: IntArray
    points_m: FloatArray  # (r, 3), middles of their faces
    axes: FloatArray  # (r, 3, 3), of their sections, the first along the normal
    signs: FloatArray  # (r,), 1 where the normal points to the second body, -1 where to the first
    forces_n: FloatArray  # (r, 3), that they carried, on the body that the normal points away from
    moments_nm: FloatArray  # (r, 3), about their middles


class CrackFaces:
    """Rectangles with the areas (m,) and second moments (m, 2, 2) of the faces of m connections, crossed by bars.

    A section of steel is four fibres at W_pl / A from its axes. They yield at its plastic axial force and moments, by
    the linear rule of EN 1993-1-1:2005, 6.2.1 (7), and press as they pull. Studs go on with the shear that they
    carried, and their face presses as a crack does.
    """

    def __init__(self, areas_m2: FloatArray, second_moments_m4: FloatArray, bars: FaceBars):
        sections = rectangular_sections(areas_m2, second_moments_m4)
        self._sides_m = 6.0 * sections.bending_moduli_m3[:, ::-1].T / areas_m2
        self._sides_m[:, bars.are_hinges] /= _EDGE_BY_FIBRE
        self._across = components_first(sections.directions)
        self._bars = bars
        offsets = components_first(transformed_back(sections.directions, bars.offsets_m))
        self._yield_n = bars.yield_n * corner_shares(offsets, self._sides_m)

    def cracks(self, steel: Steel, left: FloatArray, pressed_n_m: FloatArray) -> Cracks:
        """Return the cracks, none at first; `left` (m,) and `pressed_n_m` (m,) are as in `Cracks`."""
        bars = self._bars
        if bars.hinges is None and bars.yield_shares is None:
            return Cracks(steel, bars.openings_m, self._yield_n, left, pressed_n_m)
        of_each = SteelOfBars.alike(steel, len(left))
        if bars.yield_shares is not None:
            by_share = bars.yield_shares * of_each.rupture_strain
            of_each = replace(of_each, yield_strain=np.where(np.isnan(by_share), of_each.yield_strain, by_share))
        if bars.hinges is not None:
            columns = zip((of_each.yield_strain, of_each.hardening, of_each.rupture_strain), bars.hinges.T, strict=True)
            of_each = SteelOfBars(*(np.where(bars.have_own_law, own, usual) for usual, own in columns))
        return Cracks(of_each, bars.openings_m, self._yield_n, left, np.where(bars.are_hinges, 0.0, pressed_n_m))

    def tear(self, cracks: Cracks, torn: TornFaces, positions_m: FloatArray, rotations: FloatArray) -> None:
        """Add cracks in place of faces, with bodies at positions (3, n) in rotations (3, 3, n)."""
        rows, axes = torn.rows, torn.axes
        across = matrix_products(components_first(axes)[:, 1:], self._across[..., rows])
        places = corner_positions(components_first(torn.points_m), across, self._sides_m[:, rows])
        outwards = torn.signs * components_first(axes[:, :, 0])
        along = torn.signs * components_first(transformed(axes, self._bars.directions[rows]))
        ends = torn.first, torn.second
        pulls_n = self._pulls_n(torn, places) if self._bars.hinges is not None else None
        parted_m = None
        if self._bars.yield_shares is not None:
            stretch = ~np.isnan(self._bars.yield_shares[rows])
            parted_m = np.where(stretch, self._parted_m(torn, places, cracks.pressed_n_m(rows)), 0.0)
        cracks.add(rows, *ends, places, outwards, along, positions_m, rotations, pulls_n, parted_m)

    def _parted_m(self, torn: TornFaces, places_m: FloatArray, pressed_n_m: FloatArray) -> FloatArray:
        """By how much (3, 4, r) corners of shards part with what these had stretched before they cracked within.

        Whole sections bend by I = A h² / 12, where corners that are as stiff as they in all bend by A h² / 4.
        """
        normal = torn.signs * components_first(torn.axes[:, :, 0])
        shared = self._shared(torn, places_m, 3.0)
        pulls = np.divide(shared, pressed_n_m, out=np.zeros_like(shared), where=pressed_n_m > 0.0)
        parted: FloatArray = normal[:, None] * (pulls * normal[:, None]).sum(axis=0)
        return parted

    def _pulls_n(self, torn: TornFaces, places_m: FloatArray) -> FloatArray:
        """Forces (3, 4, r) at the corners that sections of steel and studs begin with: what they carried."""
        pulls = self._shared(torn, places_m)
        forces = components_first(torn.signs[:, None] * torn.forces_n)
        normal = components_first(torn.axes[:, :, 0])
        along = forces - dot_products(forces, normal) * normal
        of_studs = np.where(self._bars.are_studs[torn.rows], np.repeat(0.25 * along[:, None], 4, axis=1), 0.0)
        return np.where(self._bars.are_hinges[torn.rows], pulls, of_studs)

    def _shared(self, torn: TornFaces, places_m: FloatArray, of_moments: float = 1.0) -> FloatArray:
        """Forces (3, 4, r) at the corners that come to the forces of faces, and to their moments times a factor."""
        count = len(torn.rows)
        forces, moments = (components_first(torn.signs[:, None] * loads) for loads in (torn.forces_n, torn.moments_nm))
        arms = places_m - places_m.mean(axis=1, keepdims=True)
        # As forces c × r share a moment, with c by what Σ r × (c × r) is about each axis.
        about = np.zeros((3, count))
        normal = components_first(torn.axes[:, :, 0])
        beside = [arms[:, 3] - arms[:, 1], arms[:, 1] - arms[:, 0]]
        sides = [np.sqrt(dot_products(side, side)) for side in beside]
        squares = [side * side for side in sides]
        for axis, turning in (
            (normal, squares[0] + squares[1]),
            (beside[0] / sides[0], squares[1]),
            (beside[1] / sides[1], squares[0]),
        ):
            about += axis * dot_products(axis, moments) / turning
        return 0.25 * forces[:, None] + of_moments * np.stack(
            [cross_products(about, arms[:, corner]) for corner in range(4)], axis=1
        )
