"""Making a Bullet world safe that objects were taken out of.

When a body or a connection is deleted, Blender frees Bullet's part of it, but not everything that points at it: freed
constraints stay in the world, and in the lists of their bodies; freed bodies stay in their constraints and, depending
on how they were deleted, in the world. Blender crashes over them when it next takes a step, validates the constraints
or frees the world for a new one, which it makes at the start frame.

So all these pointers are taken out here. The rest must not be simulated any more (`time_control.stop_time`), as
collision detection still knows the freed bodies.
"""

from __future__ import annotations

import numpy as np

from ..errors import LayoutError
from .binding import bodies_in_use
from .collision_pairs import let_collide
from .layout import Layout
from .memory import INTEGERS, POINTERS, read, read_pointer, read_pointers, read_value

_MOST_ENTRIES = 10_000_000
_INERT_BYTES = 4096
"""More than a btRigidBody takes."""

_inert_bodies: list[np.ndarray] = []
"""Stand-ins for the bodies of constraints, never to be freed: Blender asks for them when it deletes a constraint."""


class PointerArray:
    """One of Bullet's arrays, at the address of its structure, read without trust: only known pointers may be in it."""

    def __init__(self, layout: Layout, address: int, known: set[int]):
        self._count_field = address + layout.array.count
        count, capacity = (read_value(address + field, "i") for field in (layout.array.count, layout.array.capacity))
        if not 0 <= count <= capacity <= _MOST_ENTRIES:
            raise LayoutError(f"an array of Bullet has {count} of {capacity} entries")
        self._data_field = address + layout.array.data
        self.entries = read_pointers(self._data_field, count, "an array of Bullet").tolist()
        if not known.issuperset(self.entries):
            raise LayoutError("an array of Bullet holds what Blender did not put there")

    def keep(self, kept: set[int]) -> None:
        """Take out all entries but those to keep."""
        entries = np.array([entry for entry in self.entries if entry in kept], np.uint64)
        if len(entries) == len(self.entries):
            return
        POINTERS.write(read_pointer(self._data_field) + 8 * np.arange(len(entries)), entries)
        INTEGERS.write(np.array([self._count_field]), len(entries))


class Fingerprints:
    """First bytes of checked constraints at addresses (m,), to tell them from memory that was freed."""

    def __init__(self, layout: Layout, constraints: np.ndarray):
        # Class, type and the two bodies; a flag in between changes when the constraint breaks.
        bodies = range(layout.constraint.body_a, layout.constraint.body_b + 8)
        self._columns = np.array([*range(layout.constraint.type + 4), *bodies])
        self._size = layout.constraint.body_b + 8
        self._prints = {address: self._print(address) for address in constraints.tolist()}

    def still_there(self, addresses: np.ndarray) -> np.ndarray:
        """Return whether at each of the addresses (k,) there is still its constraint."""
        prints = (self._print(address) == self._prints[address] for address in addresses.tolist())
        return np.fromiter(prints, bool, len(addresses))

    def _print(self, address: int) -> bytes | None:
        raw = read(address, self._size)
        return np.frombuffer(raw, np.uint8)[self._columns].tobytes() if raw else None


def detach_freed(
    layout: Layout, dynamics: int, bodies: np.ndarray, connections: np.ndarray, alive: np.ndarray, *, bodies_stay: bool
) -> None:
    """Take out of the world at an address all that may point at freed memory.

    When it was checked it had bodies and connections at addresses (n,) and (m,); connections that are alive (m,) are
    still there. With `bodies_stay` the bodies of now will not be freed before the world is.
    """
    known_bodies, known_connections = set(bodies.tolist()), set(connections.tolist())
    living = known_bodies & bodies_in_use(layout)
    world = layout.world
    constraints = PointerArray(layout, dynamics + world.constraints, known_connections)
    everything = PointerArray(layout, dynamics + world.bodies, known_bodies)
    moving = PointerArray(layout, dynamics + world.moving_bodies, known_bodies)
    lists = [PointerArray(layout, body + layout.body.constraints, known_connections) for body in living]
    for array in (constraints, *lists):
        array.keep(set())
    for array in (everything, moving):
        array.keep(living if bodies_stay else set())
    take_bodies_from(layout, connections[alive], read_pointer(min(living)) if living else 0)


def take_bodies_from(layout: Layout, connections: np.ndarray, body_class: int = 0) -> None:
    """Give constraints at addresses (k,) an inert body in place of their own, which may be freed."""
    inert = _inert_body(body_class)
    for field in (layout.constraint.body_a, layout.constraint.body_b):
        POINTERS.write(connections + np.uint64(field), inert)


def take_out_constraints(layout: Layout, dynamics: int, bodies: np.ndarray, known: set[int], gone: set[int]) -> None:
    """Take constraints that Blender has freed out of a world at an address that goes on.

    All its bodies are at addresses (n,); of the known constraints that may be in it, those that are gone are taken out.
    """
    in_world = PointerArray(layout, dynamics + layout.world.constraints, known)
    lists = {body: PointerArray(layout, body + layout.body.constraints, known) for body in bodies.tolist()}
    lost = {body: gone.intersection(array.entries) for body, array in lists.items()}
    in_world.keep(known - gone)
    for array in lists.values():
        array.keep(known - gone)
    pairs = [tuple(body for body in lost if address in lost[body]) for address in gone]
    for pair in pairs:
        if len(pair) == 2:  # a connection that keeps its bodies from colliding is in the lists of both
            let_collide(layout, *pair)


def _inert_body(class_address: int) -> int:
    """Return the address of a body that no constraint holds and that ignores no other."""
    raw = np.zeros(_INERT_BYTES // 8 + 1, np.uint64)
    _inert_bodies.append(raw)
    address = raw.ctypes.data + raw.ctypes.data % 16
    raw[(address - raw.ctypes.data) // 8] = class_address
    return address
