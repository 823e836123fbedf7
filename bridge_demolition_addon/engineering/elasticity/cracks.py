"""Cracks that reinforcement holds together: their resistance in a sub-step, in the equations of the structure.

A connection that broke leaves four points at the corners of the rectangle with the same second moments as its face. In
each is a quarter of the bars, or what resists the same moments as bars in their layers. There the sides of the crack
press on each other where it is closed, as stiff as the connection was. So bars have the plastic moment of such that are
spread evenly over the face, or are in their layers: all of them yield, about the pressed edge.

A sub-step is implicit, as of connections, but these forces are not linear: they are guessed (`core/src/guesses.h`).

All arrays have their components first. Places are numbered corner by corner, in each of these all cracks.
"""

from __future__ import annotations

import ctypes
from typing import TypeVar

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..core.calls import call
from ..core.structs import Count, Doubles, Indices, Struct, WrittenDoubles, WrittenFlags
from .crack_state import DOWEL_SHARE, FRICTION, SHEARED, CrackState, stretches_of_bars
from .joint_rows import (
    dot_products,
    turned,
    turned_back,
)
from .steel_bars import Bars, Steel, SteelOfBars, bar_response
from .substep import Places, Term

Numbers = TypeVar("Numbers", FloatArray, IntArray, BoolArray)

CORNERS = np.array([(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)])
"""Places as shares of half of the sides of the rectangle."""

_COUNT = len(CORNERS)

CRACK_STATES = 8
"""Numbers of the state of a crack, `bda_cracks_state`."""

_LITTLE_SHARE = 1e-9
"""Part of the bars of a crack up to which a corner has no bars: what is left is rounding."""

_IN_FACE = 1e-6
"""Cosine up to which bars lie in the face: what rounding leaves of a right angle."""

_SAME_GRIP = 0.01
"""Change of friction, by the largest in any crack, up to which it counts as the same."""

_PARTED_M = 0.01
"""Opening from which on sides without bars have parted: where they meet again, they touch as any bodies."""


class Cracks:
    """All cracks between n bodies, in place of some of m connections.

    `yield_n` (4, m): forces at which the bars in each corner yield. `openings_m` (m,): how far they stretch until they
    rupture. `shares` (m,): part of the bars that is left, which the caller keeps up to date. `pressed_n_m` (m,):
    stiffness along the normals, with which the sides of a closed crack press on each other. The steel is that of all
    bars, or of those of each connection.
    """

    def __init__(
        self,
        steel: Steel | SteelOfBars,
        openings_m: FloatArray,
        yield_n: FloatArray,
        shares: FloatArray,
        pressed_n_m: FloatArray,
    ):
        self._yield_n, self._shares = np.ascontiguousarray(yield_n, float), shares
        self._steel = SteelOfBars.alike(steel, len(openings_m)) if isinstance(steel, Steel) else steel
        self.have_bars = (yield_n > 0.0).any(axis=0)  # (m,)
        self._openings_m = np.where(self.have_bars, openings_m, _PARTED_M)
        self._pressed_n_m = pressed_n_m / _COUNT
        self.rows: IntArray = np.zeros(0, int)  # connections that cracks have replaced, oldest first
        self._first: IntArray = np.zeros(0, int)
        self._second: IntArray = np.zeros(0, int)
        self._first_anchors, self._second_anchors = np.zeros((3, 0)), np.zeros((3, 0))
        self._normals, self._directions = np.zeros((3, 0)), np.zeros((3, 0))
        self._slips, self._flows, self._holds = np.zeros((3, 0)), np.zeros(0), np.zeros(0, bool)
        self._meets: BoolArray = np.zeros(0, bool)  # corners where sides that have parted can meet again
        self._rests, self._grips_n = np.zeros((3, 0)), np.zeros(0)  # where sides that rub do not pull, and at most by
        self.remembered = np.zeros((12, 0))  # what the core knows of the last sub-step
        self._core: CoreCracks | None = None

    def __getstate__(self) -> dict[str, object]:
        """Return what a copy has: where its arrays are in memory is its own."""
        return self.__dict__ | {"_core": None}

    def __len__(self) -> int:
        return len(self.rows)

    def add(
        self,
        rows: IntArray,
        first: IntArray,
        second: IntArray,
        places_m: FloatArray,
        normals: FloatArray,
        directions: FloatArray,
        positions_m: FloatArray,
        rotations: FloatArray,
        pulls_n: FloatArray | None = None,
        parted_m: FloatArray | None = None,
    ) -> None:
        """Let bars hold in place of connections `rows` (r,), whose bodies are `first` and `second`.

        The cracks are still closed: bars cross them at `places_m` (3, 4, r), along `directions` (3, r). These and the
        `normals` (3, r) point from the first to the second bodies. Bars begin without force, or with `pulls_n`
        (3, 4, r) on the first bodies. Sides that have already parted did so by `parted_m` (3, 4, r).
        """
        ends = [np.tile(bodies, _COUNT) for bodies in (first, second)]
        sides = [places_m, places_m if parted_m is None else places_m + parted_m]
        anchors = [
            turned_back(rotations[..., end], side.reshape(3, -1) - positions_m[:, end])
            for end, side in zip(ends, sides, strict=True)
        ]
        count = len(ends[0])
        self.rows = np.concatenate((self.rows, rows))
        self._first, self._second = _joined(self._first, ends[0]), _joined(self._second, ends[1])
        self._first_anchors = _joined(self._first_anchors, anchors[0])
        self._second_anchors = _joined(self._second_anchors, anchors[1])
        normals, directions = (
            turned_back(rotations[..., ends[0]], np.tile(axes, _COUNT)) for axes in (normals, directions)
        )
        self._normals = _joined(self._normals, normals)
        self._directions = _joined(self._directions, directions)
        slips = np.zeros((3, count))
        if pulls_n is not None:
            slips = self._slips_under(rows, turned_back(rotations[..., ends[0]], pulls_n.reshape(3, -1)), directions)
        self._slips, self._flows = _joined(self._slips, slips), _joined(self._flows, np.zeros(count))
        self._holds = _joined(self._holds, np.ones(count, bool))
        self._meets = _joined(self._meets, np.ones(count, bool))
        self._rests = _joined(self._rests, np.zeros((3, count)))
        self._grips_n = _joined(self._grips_n, np.zeros(count))
        self.remembered = _joined(self.remembered, np.full((12, count), np.nan))
        self._core = None

    def pressed_n_m(self, rows: IntArray) -> FloatArray:
        """Return the stiffness (r,) with which the sides of connections press on each other at each corner."""
        return self._pressed_n_m[rows]

    def update_plastic_state(self, positions_m: FloatArray, rotations: FloatArray) -> IntArray:
        """Take over how far bars have yielded by now; return the connections (d,) that no bar replaces any more."""
        holds = np.empty(len(self.rows), bool)
        call("bda_cracks_settle", self.core, Places.of(positions_m, rotations), holds)
        return self.keep(holds)

    def keep(self, holds: BoolArray) -> IntArray:
        """Forget the cracks (t,) that no bar holds; return the connections (d,) that no bar replaces any more."""
        gone = self.rows[~holds]
        if len(gone):
            self._keep(holds)
        return gone

    @property
    def held_corners(self) -> tuple[int, int]:
        """How many corners bars hold, and at how many sides still meet, of which ever fewer do."""
        return int(np.count_nonzero(self._holds)), int(np.count_nonzero(self._meets))

    def ruptured_in_part(self) -> IntArray:
        """Return the connections (d,) whose bars have ruptured at some corners, and hold at others."""
        return self.rows[~self._holds.reshape(_COUNT, -1).all(axis=0)]

    def slid_off(self) -> IntArray:
        """Return the connections (d,) whose sides have slid off each other at some corners."""
        return self.rows[~self._meets.reshape(_COUNT, -1).all(axis=0)]

    def grip(self, positions_m: FloatArray, rotations: FloatArray) -> bool:
        """Let sides resist sliding by how they would be pressed with bodies at these positions.

        All else stays as it is. Return whether they then resist another force.
        """
        before = self._grips_n.copy()
        call("bda_cracks_grip", self.core, Places.of(positions_m, rotations))
        return bool((abs(self._grips_n - before) > _SAME_GRIP * self._grips_n.max(initial=0.0)).any())

    def state(self, positions_m: FloatArray, rotations: FloatArray) -> CrackState:
        """Return the state of all cracks after a sub-step, before it is settled."""
        states = np.empty((CRACK_STATES, len(self.rows)))
        call("bda_cracks_state", self.core, Places.of(positions_m, rotations), states)
        return CrackState(self.rows, *states)

    def used(self, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
        """Return the force (t,) of bars in the most used corner, by that at which they rupture; nan without bars.

        Bars that are pressed do not count: those do not rupture. Studs, which lie along the face, do either way.
        """
        bars = self._bars()
        gaps = turned_back(rotations[..., self._first], self._gaps(positions_m, rotations))
        forces = bar_response(bars, stretches_of_bars(gaps, self._directions), self._slips, self._flows).forces_n
        hardening = self._steel.hardening[np.tile(self.rows, _COUNT)]
        size, most = np.sqrt(dot_products(forces, forces)), hardening * bars.yield_n
        holds = self._holds & (most > _LITTLE_SHARE * np.tile(_summed(most), _COUNT))
        either_way = np.abs(dot_products(self._normals, self._directions)) < _IN_FACE
        pulled = np.where(either_way | (dot_products(forces, self._directions) > 0.0), size, 0.0)
        shares = np.divide(pulled, most, out=np.full_like(size, np.nan), where=holds)
        used: FloatArray = np.fmax.reduce(shares.reshape(_COUNT, -1), axis=0)
        return used

    def term(self, chosen: IntArray) -> Term:
        """Return what some cracks (c,) do, as long as there are the same."""
        return Term.of_cracks(self.rows[chosen], chosen, self.remembered, DOWEL_SHARE, SHEARED, self.core)

    @property
    def core(self) -> CoreCracks:
        """What the core works on, which changes what is here."""
        if self._core is None:
            count, connections = len(self.rows), len(self._shares)
            self._core = CoreCracks(
                count=count, connections=connections, dowel=DOWEL_SHARE, sheared=SHEARED, friction=FRICTION
            )
            arrays: dict[str, tuple[FloatArray | IntArray | BoolArray, int]] = {
                "rows": (self.rows, count),
                "first": (self._first, _COUNT * count),
                "second": (self._second, _COUNT * count),
                "first_anchors": (self._first_anchors, 3 * _COUNT * count),
                "second_anchors": (self._second_anchors, 3 * _COUNT * count),
                "normals": (self._normals, 3 * _COUNT * count),
                "directions": (self._directions, 3 * _COUNT * count),
                "slips": (self._slips, 3 * _COUNT * count),
                "flows": (self._flows, _COUNT * count),
                "rests": (self._rests, 3 * _COUNT * count),
                "grips": (self._grips_n, _COUNT * count),
                "holds": (self._holds, _COUNT * count),
                "meets": (self._meets, _COUNT * count),
                "remembered": (self.remembered, 12 * _COUNT * count),
                "yields": (self._yield_n, _COUNT * connections),
                "shares": (self._shares, connections),
                "openings": (self._openings_m, connections),
                "pressed": (self._pressed_n_m, connections),
                "yield_strain": (self._steel.yield_strain, connections),
                "hardening": (self._steel.hardening, connections),
                "rupture_strain": (self._steel.rupture_strain, connections),
            }
            for name, (array, size) in arrays.items():
                self._core.point(name, array, size)
        return self._core

    def _bars(self) -> Bars:
        """Return all bars, with their remaining area."""
        return self._bars_of(self.rows)

    def _bars_of(self, rows: IntArray) -> Bars:
        """Return the bars of connections (r,), with their remaining area."""
        whole, of = self._yield_n[:, rows] * self._shares[rows], np.tile(rows, _COUNT)
        return Bars.of(whole.ravel(), self._steel[of], self._openings_m[of])

    def _slips_under(self, rows: IntArray, pulls_n: FloatArray, directions: FloatArray) -> FloatArray:
        """Return slips (3, 4 r) of bars across closed cracks with which they pull so (3, 4 r)."""
        along = dot_products(pulls_n, directions) * directions
        of_bars = along + (pulls_n - along) / DOWEL_SHARE
        stiffness = self._bars_of(rows).stiffness_n_m
        return -np.divide(of_bars, stiffness, out=np.zeros_like(of_bars), where=stiffness > 0.0)

    def _gaps(self, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
        first, second = (
            positions_m[:, ends] + turned(rotations[..., ends], anchors)
            for ends, anchors in ((self._first, self._first_anchors), (self._second, self._second_anchors))
        )
        return second - first

    def _keep(self, chosen: BoolArray) -> None:
        """Forget all cracks but those chosen (t,)."""
        bars = np.tile(chosen, _COUNT)
        self.rows = self.rows[chosen]
        for name in (
            "_first",
            "_second",
            "_first_anchors",
            "_second_anchors",
            "_normals",
            "_directions",
            "_slips",
            "_flows",
            "_holds",
            "_meets",
            "_rests",
            "_grips_n",
        ):
            setattr(self, name, getattr(self, name).compress(bars, axis=-1))
        self.remembered = self.remembered.compress(bars, axis=-1)
        self._core = None


class ExpectedCracks(Struct):
    """Frames and rows of Bullet in place of c cracks: `bda_expected_cracks` in `core/src/cracks.h`.

    Attributes
    ----------
    first, second : ((3, 3, c) float, (3, c) float)
        Axes, as columns, and points, in the axes of both bodies, in the middle of the stiffness of each crack: so the
        sides of one that is closed at one edge turn about that edge, against its bars alone.
    rows : ((6, c) float, (6, c) float)
        Softness of the rows, and how they will be deformed if nothing else acts.
    """

    _fields_ = (
        ("bodies", Count),
        ("substep_s", ctypes.c_double),
        *((name, Doubles) for name in ("inverse_masses", "inverse_inertias", "velocities")),
        *((name, WrittenDoubles) for name in ("first_axes", "first_points", "second_axes", "second_points")),
        *((name, WrittenDoubles) for name in ("softness", "deformations")),
    )

    @classmethod
    def of(cls, cracks: Term, bodies: int) -> ExpectedCracks:
        """Return those of a term, between some of so many bodies, before they are found."""
        count = len(cracks.rows)
        made = cls(bodies=bodies)
        made.cracks = cracks
        made.first, made.second = ((np.empty((3, 3, count)), np.empty((3, count))) for _ in range(2))
        made.rows = np.empty((6, count)), np.empty((6, count))
        return made.take(
            first_axes=(made.first[0], 9 * count),
            first_points=(made.first[1], 3 * count),
            second_axes=(made.second[0], 9 * count),
            second_points=(made.second[1], 3 * count),
            softness=(made.rows[0], 6 * count),
            deformations=(made.rows[1], 6 * count),
        )

    def between(
        self, inverse_masses: FloatArray, inverse_inertias: FloatArray, velocities: FloatArray
    ) -> ExpectedCracks:
        """Take bodies with inverse masses (n,), inverse inertias (3, 3, n) and velocities (6, n), and return itself."""
        return self.take(
            inverse_masses=(inverse_masses, self.bodies),
            inverse_inertias=(inverse_inertias, 9 * self.bodies),
            velocities=(velocities, 6 * self.bodies),
        )

    def find(self, places: Places, substep_s: float) -> None:
        """Find them in a sub-step that is solved."""
        self.substep_s = substep_s
        call("bda_expect_cracks", self.cracks, places, self)


class CoreCracks(Struct):
    """Cracks as the core takes them: `bda_cracks` in `core/src/cracks.h`."""

    _fields_ = (
        ("count", Count),
        ("connections", Count),
        ("rows", Indices),
        ("first", Indices),
        ("second", Indices),
        *((name, Doubles) for name in ("first_anchors", "second_anchors", "normals", "directions")),
        *((name, WrittenDoubles) for name in ("slips", "flows", "rests", "grips")),
        *((name, WrittenFlags) for name in ("holds", "meets")),
        ("remembered", WrittenDoubles),
        *((name, Doubles) for name in ("yields", "shares", "openings", "pressed")),
        *((name, Doubles) for name in ("yield_strain", "hardening", "rupture_strain")),
        *((name, ctypes.c_double) for name in ("dowel", "sheared", "friction")),
    )


def corner_positions(points_m: FloatArray, axes: FloatArray, sides_m: FloatArray) -> FloatArray:
    """Return the corners (3, 4, r) of cracks with middles (3, r), principal axes (3, 2, r), and sides (2, r)."""
    halves = 0.5 * CORNERS[:, :, None] * sides_m
    return points_m[:, None] + axes[:, 0, None] * halves[:, 0] + axes[:, 1, None] * halves[:, 1]


def corner_shares(positions_m: FloatArray, sides_m: FloatArray) -> FloatArray:
    """Return the parts (4, m) of a force at positions (2, m) that the corners of rectangles with sides (2, m) resist.

    Together they have the same moments about all edges.
    """
    beside = np.clip(2.0 * positions_m / sides_m, -1.0, 1.0)
    shares: FloatArray = 0.25 * (1.0 + CORNERS[:, :1] * beside[0]) * (1.0 + CORNERS[:, 1:] * beside[1])
    return shares


def _joined(before: Numbers, added: Numbers) -> Numbers:
    """Numbers of bars (…, b), with those of more."""
    shape = before.shape[:-1]
    parts = (before.reshape(*shape, _COUNT, -1), added.reshape(*shape, _COUNT, -1))
    return np.concatenate(parts, axis=-1).reshape(*shape, -1)


def _summed(values: FloatArray) -> FloatArray:
    """Sums (…, c) over the bars (…, 4 c) of each crack."""
    of_corners = values.reshape(*values.shape[:-1], _COUNT, -1)
    total: FloatArray = of_corners[..., 0, :]
    for corner in range(1, _COUNT):
        total = total + of_corners[..., corner, :]
    return total
