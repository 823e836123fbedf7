"""Letting the two bodies of a broken connection collide again.

A connection can keep its two bodies from colliding, so that it alone carries the load between them. Bullet 3 notes
that in a list that each body has of bodies it ignores, and leaves it there when the connection breaks: former
neighbours, and shards broken off their foundation, would pass through each other for good. So the entries of a broken
connection are replaced by the body itself, which it never meets. Bullet looks for entries by their value, so it
neither misses them nor frees anything twice when it removes the constraint later.
"""

from __future__ import annotations

from collections import defaultdict

import numpy as np

from ..errors import LayoutError
from .layout import Layout
from .memory import POINTERS, read_pointer, read_pointers, read_value

_MOST_IGNORED = 1_000_000


class CollisionPairs:
    """The entries that connections have in the lists of their bodies.

    The connections at checked addresses (m,) keep their bodies from colliding; all bodies are at addresses (n,).
    """

    def __init__(self, layout: Layout, connections: np.ndarray, bodies: np.ndarray):
        self._list_offset = np.uint64(layout.body.ignored_bodies_data)
        fields = np.array((layout.constraint.body_a, layout.constraint.body_b), np.uint64)
        self._pairs = POINTERS.gather(connections[:, None] + fields)
        lists = {body: _ignored_bodies(layout, body) for body in bodies.tolist()}
        self._slots = _slots(self._pairs, lists)

    def restore(self, rows: np.ndarray) -> None:
        """Let the bodies of connections (k,) collide, where no other connection still forbids it."""
        for side in (0, 1):
            body, other = self._pairs[rows, side], self._pairs[rows, 1 - side]
            entries = POINTERS.gather(body + self._list_offset) + 8 * self._slots[rows, side]
            there = POINTERS.gather(entries) == other
            POINTERS.write(entries[there], body[there])


def let_collide(layout: Layout, first: int, second: int) -> None:
    """Let two bodies collide whose connection is gone, where no other connection still forbids it."""
    for body, other in ((first, second), (second, first)):
        ignored = _ignored_bodies(layout, body)
        if other in ignored:
            data = read_pointer(body + layout.body.ignored_bodies_data)
            POINTERS.write(data + 8 * ignored.index(other), body)


def _ignored_bodies(layout: Layout, body: int) -> list[int]:
    """Read the list of bodies that a body ignores."""
    count = read_value(body + layout.body.ignored_bodies_count, "i")
    if not 0 <= count <= _MOST_IGNORED:
        raise LayoutError(f"a body ignores {count} others")
    data_field = body + layout.body.ignored_bodies_data
    return read_pointers(data_field, count, "the list of bodies that a body ignores").tolist()


def _slots(pairs: np.ndarray, lists: dict[int, list[int]]) -> np.ndarray:
    """Where in the lists of its two bodies each connection has its entry, (m, 2)."""
    free: dict[tuple[int, int], list[int]] = defaultdict(list)
    for body, ignored in lists.items():
        for slot, other in enumerate(ignored):
            free[body, other].append(slot)
    slots = np.zeros(pairs.shape, np.uint64)
    for row, (a, b) in enumerate(pairs.tolist()):
        for side, key in enumerate(((a, b), (b, a))):
            if not free[key]:
                raise LayoutError("a connection is missing in the list of bodies that its body ignores")
            slots[row, side] = free[key].pop()
    if any(free.values()):
        raise LayoutError("a body ignores another without a connection between them")
    return slots
