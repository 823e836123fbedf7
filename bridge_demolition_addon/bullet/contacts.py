"""Contacts between bodies: where they touch, and their impulses."""

from __future__ import annotations

import ctypes
import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields

import numpy as np

from ..engineering.core.structs import Count, Indices, Struct, WrittenAddresses, WrittenDoubles
from ..engineering.geometry.vectors import dot, length
from ..engineering.mechanics.contact_pairs import contact_friction
from ..errors import LayoutError
from .layout import Layout
from .memory import INTEGERS, POINTERS, copy_pointers, read, read_pointers, read_value

_MOST_POINTS = 4
"""Bullet keeps no more of two bodies (MANIFOLD_CACHE_SIZE)."""

_MOST_MANIFOLDS = 50_000_000
"""More contacts than there can be: they would take 76 GB."""

_CHECKED_POINTS = 200
"""Contact points looked at in a check; a wrong offset is wrong in the first of them."""

_MANIFOLD_END = struct.Struct("<QQi")
"""Both bodies of a contact, then the number of its points."""

TOO_MANY_CONTACTS = "contacts, or points of one, are more than there can be"

_UNIT = 1e-6
"""How far a unit vector's length, computed by Bullet in double precision, may be from 1."""


class BulletContacts(Struct):
    """All contacts, and room for copies of their points: `bda_bullet_contacts`."""

    _fields_ = (
        ("dispatcher", ctypes.c_uint64),
        *((name, Count) for name in ("manifold_count", "manifold_data")),
        *((name, Count) for name in ("body_a", "body_b", "point_count", "points", "point_size")),
        ("components", Indices),
        ("most_manifolds", Count),
        ("most_points", Count),
        ("room", Count),
        ("values", WrittenDoubles),
        ("bodies", WrittenAddresses),
        ("found", Count),
        ("wrong", ctypes.c_uint64),
    )

    @classmethod
    def of(cls, layout: Layout, dispatcher: int) -> BulletContacts:
        """Return the contacts of a btCollisionDispatcher at an address, with room for none."""
        manifold, point, listed = layout.manifold, layout.manifold.point, layout.dispatcher
        made = cls(
            dispatcher=dispatcher,
            manifold_count=listed.manifold_count,
            manifold_data=listed.manifold_data,
            body_a=manifold.body_a,
            body_b=manifold.body_b,
            point_count=manifold.count,
            points=manifold.points,
            point_size=point.size,
            most_manifolds=_MOST_MANIFOLDS,
            most_points=_MOST_POINTS,
        )
        impulses = [point.normal_impulse, point.lateral_impulses, point.lateral_impulses + 8]
        vectors = [
            start + 8 * axis
            for start in (
                *(point.position_on_b, point.normal),
                *(point.lateral_directions, point.lateral_directions + 32),
            )
            for axis in range(3)
        ]
        made.point("components", np.array([*vectors[:6], *impulses, *vectors[6:]], np.int64), 15)
        made.make_room(0)
        return made

    def make_room(self, count: int) -> None:
        """Make room for so many points."""
        self.room, self.copied = count, ContactCopies(np.empty((15, count)), np.empty((2, count), np.uint64))
        self.point("values", self.copied.components, 15 * count)
        self.point("bodies", self.copied.bodies, 2 * count)


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
        self._is_checked, self._core = False, BulletContacts.of(layout, dispatcher)

    def core(self) -> BulletContacts:
        """Return what the core gets of them."""
        if not self._is_checked:
            self._checked_manifolds()
        return self._core

    def make_room(self) -> None:
        """Make room for all that carry a load now, and as many."""
        self._core.make_room(2 * self._core.found)

    def copied(self) -> ContactCopies:
        """Return the contact points that the core has copied."""
        points, found = self._core.copied, self._core.found
        return ContactCopies(points.components[:, :found].copy(), points.bodies[:, :found].copy())

    def wrong_body(self) -> int:
        """Return the first body of the point that is not finite."""
        return int(self._indices(np.array([self._core.wrong], np.uint64))[0])

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
