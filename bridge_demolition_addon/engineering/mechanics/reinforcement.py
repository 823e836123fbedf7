"""Layers of bars across the faces of connections."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..geometry.vectors import length

_ALONG_FACE = 0.5
"""Part of a direction along the normal up to which bars with a law of their own lie in the face."""


@dataclass(frozen=True, slots=True, eq=False)
class FaceBars:
    """Layers of bars across the faces of m connections, each face's put together."""

    yield_n: FloatArray  # (m,), force at which all bars across a face yield; 0 where there are none
    offsets_m: FloatArray  # (m, 2), where it acts, from the connection's point along the section's y and z
    directions: FloatArray  # (m, 3), of it, along the section's axes; the first is not below 0
    openings_m: FloatArray  # (m,), opening along it at which they rupture
    hinges: FloatArray | None = None
    """(m, 3), of sections of steel that yield as a whole, and of studs along a face: strain at yield, hardening and
    strain at rupture; nan of the others."""
    yield_shares: FloatArray | None = None
    """(m,), part of `openings_m` at which bars yield, where these stretch along cracked shards; nan of the others,
    which yield as their steel says."""

    def with_even(self, even_n: FloatArray, opening_m: float | FloatArray) -> FaceBars:
        """Return them together with bars (m,) that are spread evenly over the faces, and pull across these.

        Those rupture at an opening of their own, or at one (m,) each.
        """
        forces = self.yield_n[:, None] * self.directions
        forces[:, 0] += even_n
        whole, parts = length(forces), self.yield_n + even_n
        share = np.divide(self.yield_n, parts, out=np.zeros_like(parts), where=parts > 0.0)
        along = np.zeros_like(forces)
        along[:, 0] = 1.0
        return FaceBars(
            whole,
            share[:, None] * self.offsets_m,
            np.divide(forces, whole[:, None], out=along, where=whole[:, None] > 0.0),
            share * self.openings_m + (1.0 - share) * opening_m,
            self.hinges,
            self.yield_shares,
        )

    def with_pulls(
        self,
        rows: IntArray,
        pulls_n: FloatArray,
        offsets_m: FloatArray,
        directions: FloatArray,
        openings_m: FloatArray,
    ) -> FaceBars:
        """Return them together with bars across faces `rows` (b,), some maybe of one face.

        They yield at `pulls_n` (b,), at offsets (b, 2) and along directions (b, 3) as above. Where bars stretch along
        cracked shards, all of a face yield at the opening at which those do.
        """
        forces, parts = self.yield_n[:, None] * self.directions, self.yield_n.copy()
        by_offset, by_opening = self.yield_n[:, None] * self.offsets_m, self.yield_n * self.openings_m
        np.add.at(parts, rows, pulls_n)
        np.add.at(forces, rows, pulls_n[:, None] * directions)
        np.add.at(by_offset, rows, pulls_n[:, None] * offsets_m)
        np.add.at(by_opening, rows, pulls_n * openings_m)
        has_bars, whole = parts > 0.0, length(forces)
        openings = np.divide(by_opening, parts, out=np.zeros_like(parts), where=has_bars)
        shares = self.yield_shares
        if shares is not None:
            shares = np.divide(shares * self.openings_m, openings, out=np.full_like(shares, np.nan), where=has_bars)
        return FaceBars(
            whole,
            np.divide(by_offset, parts[:, None], out=np.zeros_like(by_offset), where=has_bars[:, None]),
            np.divide(forces, whole[:, None], out=self.directions.copy(), where=whole[:, None] > 0.0),
            openings,
            self.hinges,
            shares,
        )

    @property
    def have_own_law(self) -> BoolArray:
        """Which of them (m,) are sections of steel or studs."""
        if self.hinges is None:
            return np.zeros(len(self.yield_n), bool)
        return ~np.isnan(self.hinges[:, 0])

    @property
    def are_hinges(self) -> BoolArray:
        """Which of them (m,) are sections of steel."""
        return self.have_own_law & (self.directions[:, 0] > _ALONG_FACE)

    @property
    def are_studs(self) -> BoolArray:
        """Which of them (m,) are studs, whose direction lies in the face."""
        return self.have_own_law & (self.directions[:, 0] <= _ALONG_FACE)

    def with_hinges(self, rows: IntArray, yield_n: FloatArray, openings_m: FloatArray, hinges: FloatArray) -> FaceBars:
        """Return them with sections of steel in place of those in some rows (s,)."""
        return self._with_own_laws(rows, yield_n, openings_m, hinges, (1.0, 0.0, 0.0))

    def with_studs(
        self,
        rows: IntArray,
        yield_n: FloatArray,
        slips_m: FloatArray,
        laws: FloatArray,
        direction: tuple[float, float, float],
    ) -> FaceBars:
        """Return them with studs in place of those in some rows (s,), which yield along a direction in the face.

        `laws` (s, 3) are as `hinges`, and `slips_m` (s,) those at which studs fail.
        """
        return self._with_own_laws(rows, yield_n, slips_m, laws, direction)

    def _with_own_laws(
        self,
        rows: IntArray,
        yield_n: FloatArray,
        openings_m: FloatArray,
        laws: FloatArray,
        direction: tuple[float, float, float],
    ) -> FaceBars:
        all_yield_n, offsets_m, directions = self.yield_n.copy(), self.offsets_m.copy(), self.directions.copy()
        openings = self.openings_m.copy()
        all_laws = np.full((len(all_yield_n), 3), np.nan) if self.hinges is None else self.hinges.copy()
        all_yield_n[rows], openings[rows], all_laws[rows] = yield_n, openings_m, laws
        offsets_m[rows], directions[rows] = 0.0, direction
        return FaceBars(all_yield_n, offsets_m, directions, openings, all_laws, self.yield_shares)

    @classmethod
    def none(cls, count: int) -> FaceBars:
        """Return no bars across m faces."""
        along = np.zeros((count, 3))
        along[:, 0] = 1.0
        return cls(np.zeros(count), np.zeros((count, 2)), along, np.zeros(count))
