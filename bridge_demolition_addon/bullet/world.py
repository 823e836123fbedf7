"""The Bullet world of a scene, bound to the scene's bodies and connections.

Blender makes another world whenever a simulation starts again, often at the same address. A token in a field that
Blender leaves unused tells a world that has been checked and prepared from one that has not.
"""

from __future__ import annotations

import ctypes
import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any

import bpy
import numpy as np

from ..errors import LayoutError, SimulationError
from ..scene.world import scene_time_step
from . import checks
from .binding import EvaluatedCopies, find_bodies, find_constraints, find_copies, find_dynamics_world
from .bodies import BodyTable
from .collision_pairs import CollisionPairs
from .constraint_rows import ConstraintRows
from .constraints import FEEDBACK_DOUBLES, ConstraintTable
from .contacts import ContactReader
from .layout import ONE_DIRECTION, TWO_DIRECTIONS, Layout, platform_layout
from .memory import DOUBLES, INTEGERS, POINTERS, read_pointer, read_value
from .snapshots import SnapshotTaker
from .teardown import detach_freed, take_bodies_from, take_out_constraints

_CACHE_LINE = 64
"""Bytes; also more than the 16 that Bullet asks for its vectors."""

_tokens = itertools.count(0x42444100)

_STEP_FUNCTION = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_double)

_callbacks_bullet_may_call: list[object] = []
"""Callbacks handed to Bullet, never to be freed either."""

_buffers_bullet_may_write: list[np.ndarray] = []
"""Buffers handed to Bullet. They are never freed: a constraint may outlive the recording that asked for its forces."""


class WorldState(Enum):
    """State of the world at a call of `BulletWorld.bind`."""

    ABSENT = "Blender has made no world yet"
    NEW = "a world that was checked and prepared just now"
    KNOWN = "the world of the last call"


@dataclass(frozen=True, slots=True, eq=False)
class _BoundWorld:
    """A world that was checked, a btDiscreteDynamicsWorld at an address."""

    dynamics: int
    bodies: BodyTable
    constraints: ConstraintTable
    copies: EvaluatedCopies | None


class BulletWorld:
    """Bodies and connections of a scene in Bullet's memory.

    Parameters
    ----------
    scene
        Scene with a rigid-body world.
    bodies, connections
        Objects with a rigid body, and objects with a rigid-body constraint. All arrays are in their order.
    layout
        Byte offsets; by default those of this platform.
    """

    def __init__(
        self,
        scene: bpy.types.Scene,
        bodies: Sequence[bpy.types.Object],
        connections: Sequence[bpy.types.Object],
        layout: Layout | None = None,
    ):
        self.scene = scene
        self.body_objects = tuple(bodies)
        self.connection_objects = tuple(connections)
        self._layout = layout or platform_layout()
        self._token = 0
        self._bound: _BoundWorld | None = None
        self._feedback = _aligned_doubles(len(self.connection_objects))

    def bind(self, depsgraph: bpy.types.Depsgraph, *, to_read: bool = True) -> WorldState:
        """Find the world, and check and prepare it if it is new. Not for the start frame, which has an earlier world.

        Parameters
        ----------
        depsgraph
            Evaluated for the present frame.
        to_read
            Whether loads and motion are to be read. Otherwise the world may have been recorded or edited before, and
            only `detach_freed` and `take_out_edited` can be used.

        Raises
        ------
        LayoutError
            Memory is not as expected; nothing has been written.
        SimulationError
            A body is not part of Blender's simulation.
        """
        dynamics = self._find()
        if self._is_bound_to(dynamics):
            return WorldState.KNOWN
        self._bound = None
        if not dynamics:
            return WorldState.ABSENT
        self._bound = self._check(dynamics, depsgraph, to_read)
        self._bound.constraints.prepare()
        self._token = next(_tokens)
        POINTERS.write(dynamics + self._layout.world.user_info, self._token)
        return WorldState.NEW

    @property
    def _world(self) -> _BoundWorld:
        assert self._bound is not None
        return self._bound

    @property
    def bodies(self) -> BodyTable:
        """Its bodies, as long as it is bound."""
        return self._world.bodies

    @property
    def constraints(self) -> ConstraintTable:
        """Its connections, as long as it is bound."""
        return self._world.constraints

    def call_around_substeps(
        self, before: Callable[[float], None], after: Callable[[float], None] | None = None
    ) -> None:
        """Have functions called before and after every sub-step of this world, with the sub-step's length in s.

        They are called from the thread that simulates, while Blender's data is in use: they must not touch bpy, and
        must not raise. Another world that Blender makes does not know them.
        """
        world = self._layout.world
        for field, action in ((world.before_step, before), (world.after_step, after)):
            address = ctypes.cast(_callback(action), ctypes.c_void_p).value or 0 if action else 0
            POINTERS.write(self._world.dynamics + field, address)

    def end_passes(self, least_change_m_s: float) -> None:
        """Have the solver's pass over all connections and contacts be the last that changes no velocity by more.

        The change of angular velocities counts in rad/s.
        """
        DOUBLES.write(self._world.dynamics + self._layout.world.least_change, least_change_m_s * least_change_m_s)

    def rub_across(self, *, wanted: bool) -> None:
        """Have friction act across the direction in which bodies slide too, or along it alone, as Blender has it.

        Along it alone what lies in a pile creeps sideways: the direction is that of velocities without contacts.
        """
        mode = TWO_DIRECTIONS if wanted else ONE_DIRECTION
        INTEGERS.write(self._world.dynamics + self._layout.world.mode, mode)

    def take_substep(self) -> float:
        """Return the length in s of the sub-steps since the last call, 0.0 where Bullet took none, and clear it.

        Bullet writes the length at every sub-step and never reads it: so frames that were simulated differ from frames
        that Blender played back from its cache.
        """
        field = self._world.dynamics + self._layout.world.step
        substep: float = DOUBLES.one(field)
        DOUBLES.write(field, 0.0)
        return substep

    def snapshots(self, sides: np.ndarray) -> SnapshotTaker:
        """Return the taker of snapshots of this world, as long as it is bound; with loads on `sides` of connections."""
        return SnapshotTaker(self.bodies, self.constraints, sides)

    def elastic_rows(self) -> ConstraintRows:
        """Return the rows of the connections of this world, as long as it is bound; all have to exist.

        When the world is released they are as Blender made them again.
        """
        names, exists = [connection.name for connection in self.connection_objects], self.constraints.exists
        if not exists.all():
            name = names[int(np.argmin(exists))]
            raise SimulationError(f"elastic connection {name!r} is switched off: enable it, or delete it")
        return self.constraints.elastic_rows(names)

    def first_is_body_a(self) -> np.ndarray:
        """Return whether `object1` of each connection (m,) is Bullet's body A; True where no connection exists."""
        exists = self.constraints.exists
        first = np.ones(len(exists), bool)
        by_object = dict(zip(self.body_objects, self.bodies.addresses.tolist(), strict=True))
        existing = itertools.compress(self.connection_objects, exists)
        objects = [by_object.get(connection.rigid_body_constraint.object1, 0) for connection in existing]
        first[exists] = self.constraints.first_bodies() == np.array(objects, np.uint64)
        return first

    def release(self) -> None:
        """Take our buffers out of the world again, if it is still the one that was prepared."""
        try:
            ours = self._is_bound_to(self._find())
        except (LayoutError, ReferenceError):  # the scene is gone, and its world with it
            ours = False
        if ours:
            self.constraints.forget_freed()
            self.constraints.restore()
            world = self._layout.world
            for field in (world.before_step, world.after_step, world.user_info):
                POINTERS.write(self._world.dynamics + field, 0)
            self.end_passes(0.0)
            self.rub_across(wanted=False)
        self._bound = None

    def detach_freed(self, *, bodies_stay: bool = True) -> None:
        """Make a world safe from which objects are being removed; it must not be simulated any more.

        If the bodies of now do not stay until the world is freed, all of them are taken out of it. Raises a
        `LayoutError` if memory is not as expected; then no loads are read any more, and nothing else has changed.
        """
        if not self._is_bound_to(self._find()):
            return
        bound, constraints = self._world, self.constraints
        connections = constraints.existing
        alive = constraints.forget_freed()
        constraints.write_loads(wanted=False)
        bodies = bound.bodies.addresses
        detach_freed(self._layout, bound.dynamics, bodies, connections, alive, bodies_stay=bodies_stay)
        constraints.exists[:] = False

    def outlive(self) -> None:
        """Make the connections of a removed world safe, before Blender updates anything.

        Blender has freed their bodies, and deletes the connections later.
        """
        if self._bound is not None:
            self.constraints.forget_freed()
            take_bodies_from(self._layout, self.constraints.existing)

    def has_grown(self) -> bool:
        """Return whether Blender has added anything to the world since it was bound, as after an edit."""
        world, count = self._layout.world, self._layout.array.count
        known = ((world.bodies, len(self.bodies)), (world.constraints, len(self.constraints.existing)))
        return any(read_value(self._world.dynamics + array + count, "i") > number for array, number in known)

    def take_out_edited(self) -> list[bpy.types.Object]:
        """Take edited connections, which Blender is about to free, out of the world; return them.

        Blender copies an edited object again. It frees the constraint of the former copy, makes another, and forgets to
        take the first one out. To be called before Blender updates anything. Raises a `LayoutError` if memory is not as
        expected; then nothing has been written.
        """
        if not self._is_bound_to(self._find()) or self._world.copies is None:
            return []
        bound, constraints = self._world, self.constraints
        rows = self._world.copies.edited_rows(self.scene)
        rows = rows[constraints.exists[rows]]
        if len(rows):
            known, gone = set(constraints.existing.tolist()), set(constraints.addresses[rows].tolist())
            take_out_constraints(self._layout, bound.dynamics, bound.bodies.addresses, known, gone)
            constraints.exists[rows] = False
        return [self.connection_objects[row] for row in rows]

    def _find(self) -> int:
        """Address of the btDiscreteDynamicsWorld, 0 while there is none."""
        return find_dynamics_world(self._layout, self.scene.rigidbody_world)

    def _is_bound_to(self, dynamics: int) -> bool:
        """Whether this is the world that was prepared, and not one that Blender has made since."""
        return self._bound is not None and dynamics == self._bound.dynamics and self._is_marked(dynamics)

    def _is_marked(self, dynamics: int) -> bool:
        token = read_value(dynamics + self._layout.world.user_info, "Q") if dynamics and self._token else 0
        return bool(token) and token == self._token

    def _check(self, dynamics: int, depsgraph: bpy.types.Depsgraph, to_read: bool) -> _BoundWorld:
        """Check a new world from end to end. Nothing is written."""
        layout, world = self._layout, self._layout.world
        if to_read:
            checks.check_solver(layout, dynamics, self.scene.rigidbody_world, scene_time_step(self.scene).substep_s)
        bodies = find_bodies(layout, self.body_objects, depsgraph, to_read)
        holders, copies = find_copies(self.scene, self.connection_objects, depsgraph)
        by_object = dict(zip(self.body_objects, bodies.tolist(), strict=True))
        constraints = find_constraints(layout, self.connection_objects, holders, by_object, to_read)
        bodies = bodies[bodies != 0]
        for field in (world.user_info, world.before_step, world.after_step):
            if read_value(dynamics + field, "Q") and not self._is_marked(dynamics):
                raise LayoutError("another program uses Blender's Bullet world")
        settings = (connection.rigid_body_constraint for connection in self.connection_objects)
        forbids_collision = np.array([item.disable_collisions for item in settings], bool) & (constraints != 0)
        pairs = CollisionPairs(layout, constraints[forbids_collision], bodies) if to_read else None
        contacts = ContactReader(layout, read_pointer(dynamics + world.dispatcher), bodies)
        table = ConstraintTable(layout, constraints, forbids_collision, pairs, self._feedback)
        return _BoundWorld(dynamics, BodyTable(layout, bodies, contacts), table, copies)


def _callback(action: Callable[[float], None]) -> Any:
    """Return a function as Bullet calls it, never to be freed."""
    callback = _STEP_FUNCTION(lambda _world, substep: action(substep))
    _callbacks_bullet_may_call.append(callback)
    return callback


def _aligned_doubles(count: int) -> np.ndarray:
    """Return feedback blocks (count, 4, 4), aligned so that a body's load is in one cache line, never to be freed."""
    raw = np.zeros(count * FEEDBACK_DOUBLES + _CACHE_LINE // 8)
    _buffers_bullet_may_write.append(raw)
    start = (-raw.ctypes.data % _CACHE_LINE) // 8
    return raw[start : start + count * FEEDBACK_DOUBLES].reshape(count, 4, 4)
