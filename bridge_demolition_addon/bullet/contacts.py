"""Contacts between bodies: where they touch, and their impulses."""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields

import numpy as np

from ..engineering.arrays import same
from ..engineering.geometry.vectors import dot, length
from ..engineering.mechanics.contact_pairs import contact_friction
from ..errors import LayoutError
from .layout import Layout
from .memory import DOUBLES, INTEGERS, POINTERS, Fields, copy_pointers, field_loops, read, read_pointers, read_value

_MOST_POINTS = 4
"""Bullet keeps no more of two bodies (MANIFOLD_CACHE_SIZE)."""

_MOST_MANIFOLDS = 50_000_000
"""More contacts than there can be: they would take 76 GB."""

_CHECKED_POINTS = 200
"""Contact points looked at in a check; a wrong offset is wrong in the first of them."""

_TOO_MANY_POINTS = "a contact has more than four points"

_MANIFOLD_END = struct.Struct("<QQi")
"""Both bodies of a contact, then the number of its points."""

_UNIT = 1e-6
"""How far a unit vector's length, computed by Bullet in double precision, may be from 1."""


@dataclass(frozen=True, slots=True, eq=False)
class ContactCopies:
    """Copies of the k contact points that carry a load, as Bullet holds them after a sub-step.

    Attributes
    ----------
    components
        (15, k) position, normal, impulses along the normal and two lateral directions, and these directions.
    bodies
        (2, k) uint64 addresses of the two bodies.
    """

    components: np.ndarray
    bodies: np.ndarray

    @classmethod
    def none(cls) -> ContactCopies:
        """Return copies of no contact point."""
        return cls(np.zeros((15, 0)), np.zeros((2, 0), np.uint64))

    @property
    def size(self) -> int:
        """Their bytes in memory."""
        return self.components.nbytes + self.bodies.nbytes


@dataclass(frozen=True, slots=True, eq=False)
class Contacts:
    """Contact points of s sub-steps.

    Attributes
    ----------
    substeps
        (k,) in which sub-step each is, in ascending order.
    pairs
        (k, 2) indices of the two bodies.
    positions_m
        (k, 3) where they touch, on the second body.
    normals
        (k, 3) unit vectors from the second body to the first.
    normal_impulses_ns, tangential_impulses_ns
        (k,) and (k, 3) impulse on the first body; the second gets the opposite.
    """

    substeps: np.ndarray
    pairs: np.ndarray
    positions_m: np.ndarray
    normals: np.ndarray
    normal_impulses_ns: np.ndarray
    tangential_impulses_ns: np.ndarray

    @property
    def impulses_ns(self) -> np.ndarray:
        """Whole impulses (k, 3) on the first bodies, N·s."""
        return self.normal_impulses_ns[:, None] * self.normals + self.tangential_impulses_ns

    def without(self, bodies: np.ndarray) -> Contacts:
        """Return the contacts without those of bodies that a mask (s, n) marks in their sub-step."""
        kept = ~bodies[self.substeps[:, None], self.pairs].any(axis=1)
        return Contacts(*(getattr(self, item.name)[kept] for item in fields(self)))

    def __len__(self) -> int:
        return len(self.pairs)


class ContactReader:
    """Reads the contacts of a world, by the addresses of its btCollisionDispatcher and of its bodies (n,)."""

    def __init__(self, layout: Layout, dispatcher: int, bodies: np.ndarray):
        self._layout, self._dispatcher = layout, dispatcher
        self._order = np.argsort(bodies, kind="stable")
        self._sorted = bodies[self._order]
        self._is_checked, self._point_doubles = False, layout.manifold.point.size // DOUBLES.size
        point = layout.manifold.point
        vectors = np.array([point.position_on_b, point.normal, point.lateral_directions, point.lateral_directions + 32])
        impulses = np.array([point.normal_impulse, point.lateral_impulses, point.lateral_impulses + 8])
        self._impulse_offsets = layout.manifold.points + impulses
        self._vector_offsets = layout.manifold.points + (vectors[:, None] + 8 * np.arange(3)).ravel()
        self._find(np.zeros(0, np.uint64))

    def copy(self) -> ContactCopies:
        """Copy the contact points that carry a load now."""
        manifolds = self._checked_manifolds()
        if not same(manifolds, self._known_manifolds):
            self._find(manifolds)
        loops = field_loops()
        if loops is not None:
            everywhere, points = (DOUBLES.everywhere, POINTERS.everywhere, INTEGERS.everywhere), self._places
            components, bodies, are_few = loops.loaded_points(*everywhere, *points, self._point_doubles, _MOST_POINTS)
            if not are_few:
                raise LayoutError(_TOO_MANY_POINTS)
            return ContactCopies(components, bodies)
        counts = self._counts.copy()[0]
        if len(counts) and (counts.min() < 0 or counts.max() > _MOST_POINTS):
            raise LayoutError(_TOO_MANY_POINTS)
        used = np.flatnonzero(counts)
        counts = counts.take(used)
        rows = np.repeat(used, counts)
        number = np.arange(len(rows)) - np.repeat(np.cumsum(counts) - counts, counts)
        further = number * self._layout.manifold.point.size
        impulses = self._impulses.copy_at(rows, further)
        # The solver's iterations can end with friction where no normal impulse is left.
        loaded = np.flatnonzero((impulses[0] != 0.0) | (impulses[1] != 0.0) | (impulses[2] != 0.0))
        rows, further = rows.take(loaded), further.take(loaded)
        vectors = self._vectors.copy_at(rows, further)
        components = np.concatenate((vectors[:6], impulses.take(loaded, axis=1), vectors[6:]))
        return ContactCopies(components, self._bodies.copy_at(rows))

    def contacts(self, copies: Sequence[ContactCopies]) -> Contacts:
        """Return the contact points in copies of s sub-steps, also those of sleeping bodies, which keep their last."""
        values = np.concatenate([copy.components for copy in copies], axis=1)
        bodies = np.concatenate([copy.bodies for copy in copies], axis=1)
        substeps = np.repeat(np.arange(len(copies)), [copy.components.shape[1] for copy in copies])
        _check_directions(values)
        first, second = values[7] * values[9:12], values[8] * values[12:15]
        # Bullet leaves the second direction unset where it solved only one.
        tangential = first + np.where(values[8] != 0.0, second, 0.0)
        return Contacts(substeps, self._indices(bodies).T, values[0:3].T, values[3:6].T, values[6], tangential.T)

    def forget(self, rows: np.ndarray) -> None:
        """Drop all contact points of bodies (k,) that were put elsewhere; Bullet finds those of their new positions.

        It would take the distance that they were moved by for how deep they are in others, and push them apart.
        """
        manifolds, layout = self._checked_manifolds(), self._layout.manifold
        pairs = [self._indices(POINTERS.gather(manifolds + np.uint64(side))) for side in (layout.body_a, layout.body_b)]
        moved = np.isin(pairs, rows).any(axis=0)
        INTEGERS.write(manifolds[moved] + np.uint64(layout.count), 0)

    def _find(self, manifolds: np.ndarray) -> None:
        """Note where everything is in manifolds at these addresses."""
        layout = self._layout.manifold
        self._known_manifolds = manifolds
        self._counts = Fields(manifolds, [layout.count], INTEGERS)
        self._bodies = Fields(manifolds, [layout.body_a, layout.body_b], POINTERS)
        self._impulses = Fields(manifolds, self._impulse_offsets)
        self._vectors = Fields(manifolds, self._vector_offsets)
        self._places = tuple(each.places for each in (self._counts, self._impulses, self._vectors, self._bodies))

    def _checked_manifolds(self) -> np.ndarray:
        """Addresses of all manifolds, from Bullet's pool and from beyond it; checked when the first are there."""
        layout, address = self._layout.dispatcher, self._dispatcher
        count_field, data_field = address + layout.manifold_count, address + layout.manifold_data
        count = INTEGERS.one(count_field) if self._is_checked else read_value(count_field, "i")
        if not 0 <= count <= _MOST_MANIFOLDS:
            raise LayoutError(f"{count} contacts")
        if self._is_checked:
            return copy_pointers(POINTERS.one(data_field), count)
        manifolds = read_pointers(data_field, count, "the list of contacts")
        _check_contacts(self._layout, manifolds, set(self._sorted.tolist()))
        self._is_checked = count > 0
        return manifolds

    def _indices(self, addresses: np.ndarray) -> np.ndarray:
        """Bodies at addresses, by their indices."""
        indices = np.minimum(np.searchsorted(self._sorted, addresses), len(self._sorted) - 1)
        if not (self._sorted[indices] == addresses).all():
            raise LayoutError("a contact names a body that is not in the scene")
        return self._order[indices]


def _check_contacts(layout: Layout, manifolds: np.ndarray, bodies: set[int]) -> None:
    """Contacts name known bodies, and their points agree with each other."""
    left = _CHECKED_POINTS
    for manifold in manifolds.tolist():
        raw = read(manifold + layout.manifold.body_a, _MANIFOLD_END.size)
        if raw is None:
            raise LayoutError("a contact cannot be read")
        *pair, count = _MANIFOLD_END.unpack(raw)
        if not bodies.issuperset(pair) or pair[0] == pair[1] or not 0 <= count <= _MOST_POINTS:
            raise LayoutError("a contact does not name two bodies of the scene")
        frictions = [read_value(body + layout.body.friction, "d") for body in pair] if count else []
        for number in range(count):
            _check_point(layout, manifold + layout.manifold.points + number * layout.manifold.point.size, frictions)
        left -= count
        if left <= 0:
            return


def _check_point(layout: Layout, address: int, frictions: list[float]) -> None:
    point = layout.manifold.point
    raw = read(address, point.size)
    if raw is None:
        raise LayoutError("a contact point cannot be read")
    doubles = np.frombuffer(raw)

    def vector(offset: int) -> np.ndarray:
        return doubles[offset // 8 : offset // 8 + 3]

    normal, gap = vector(point.normal), vector(point.position_on_a) - vector(point.position_on_b)
    size = 1.0 + abs(vector(point.position_on_a)).max()
    friction = contact_friction(*frictions)
    checks: Mapping[str, bool] = {
        "normal": bool(abs(length(normal) - 1.0) <= _UNIT),
        "distance": bool(abs(dot(gap, normal) - doubles[point.distance // 8]) <= _UNIT * size),
        "friction": abs(doubles[point.friction // 8] - friction) <= _UNIT * (1.0 + friction),
        "normal impulse": 0.0 <= doubles[point.normal_impulse // 8] < np.inf,
    }
    wrong = [name for name, is_right in checks.items() if not is_right]
    if wrong:
        raise LayoutError(f"{', '.join(wrong)} of a contact point: not as expected")


def _check_directions(values: np.ndarray) -> None:
    """The lateral directions (3, k) that carry an impulse are unit vectors at right angles to the normal."""
    for impulse, start in ((7, 9), (8, 12)):
        used = values.compress(values[impulse] != 0.0, axis=1).T
        directions, normals = used[:, start : start + 3], used[:, 3:6]
        excess = abs(dot(directions, directions) - 1.0)
        slope = abs(dot(directions, normals))
        if not (max(excess.max(initial=0.0), slope.max(initial=0.0)) <= _UNIT):
            raise LayoutError("lateral directions of a contact point: not as expected")
