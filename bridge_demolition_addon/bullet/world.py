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

import bpy
import numpy as np

from ..errors import LayoutError, SimulationError
from ..model.results.removed_shards import OUT_OF_REACH_M
from ..scene.world import scene_time_step
from . import checks
from .body_motion import BodyMotionReader
from .collision_pairs import CollisionPairs
from .constraint_rows import ConstraintRows
from .contacts import ContactReader
from .layout import ASLEEP, AWAKE, DISABLED, SLEEPING, WANTS_SLEEP, Layout, platform_layout
from .memory import (
    Places,
    add_vectors,
    gather_doubles,
    gather_integers,
    gather_pointers,
    read_pointer,
    read_value,
    write_bytes,
    write_doubles,
    write_integers,
    write_pointers,
    write_vectors,
)
from .snapshots import SnapshotTaker
from .teardown import Fingerprints, retire, take_bodies_from, take_out_constraints

_FEEDBACK_DOUBLES = 16
"""btJointFeedback: force and torque on body A, force and torque on body B, four doubles each."""

_TRANSFORM = 8 * np.array([0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14])
"""Rotation matrix and origin in bytes from the start of a btTransform: four vectors of four doubles each."""

_CACHE_LINE = 64
"""Bytes; also more than the 16 that Bullet asks for its vectors."""

_tokens = itertools.count(0x42444100)

_STEP_FUNCTION = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_double)

_callbacks_bullet_may_call: list[object] = []
"""Callbacks handed to Bullet, never to be freed either."""

_buffers_bullet_may_write: list[np.ndarray] = []
"""Buffers handed to Bullet. They are never freed: a constraint may outlive the recording that asked for its forces."""


class WorldState(Enum):
    """What `BulletWorld.bind` found."""

    ABSENT = "Blender has made no world yet"
    NEW = "a world that was checked and prepared just now"
    KNOWN = "the world of the last call"


@dataclass(frozen=True, slots=True, eq=False)
class _BoundWorld:
    """A world that was checked: n bodies, m connections of which e exist in it, c of these keep bodies from colliding.

    Attributes
    ----------
    dynamics : int
        Address of the btDiscreteDynamicsWorld.
    bodies, connections : (n,) uint64, (m,) uint64
        Addresses; 0 for a connection that does not exist.
    exists : (m,) bool
        Whether each connection exists; kept up to date.
    transforms : Places
        Where each body's rotation matrix and, behind it, its position are.
    removed : (n,) bool
        Bodies that were taken out of the simulation; kept up to date.
    thresholds : (e,) float
        Breaking thresholds for sub-steps of normal length, N·s.
    forbids_collision : (m,) bool
        Whether each connection keeps its bodies from colliding; kept up to date.
    collision_pairs, pair_rows : CollisionPairs or None, (m,) int
        How these are let collide, and the rows of connections in it; None in a world that is not read.
    fingerprints : Fingerprints
        Tells connections that were freed from those in use.
    contacts : ContactReader
        Reads the contacts.
    depsgraph : int
        Address of the dependency graph whose copies of the connections have the constraints.
    copies : dict or None
        The rows of these copies by their addresses; None where the constraints are on the connections themselves, and
        stay.
    """

    dynamics: int
    bodies: np.ndarray
    connections: np.ndarray
    exists: np.ndarray
    transforms: Places
    removed: np.ndarray
    thresholds: np.ndarray
    forbids_collision: np.ndarray
    collision_pairs: CollisionPairs | None
    pair_rows: np.ndarray
    fingerprints: Fingerprints
    contacts: ContactReader
    depsgraph: int
    copies: dict[int, int] | None


class BulletWorld:
    """Bodies and connections of a scene as arrays over Bullet's own memory.

    Parameters
    ----------
    scene
        Scene with a rigid-body world.
    bodies, connections
        Objects with a rigid body, and objects with a rigid-body constraint. All arrays are in their order.
    layout
        Byte offsets; those of this platform unless given.

    """

    def __init__(
        self,
        scene: bpy.types.Scene,
        bodies: Sequence[bpy.types.Object],
        connections: Sequence[bpy.types.Object],
        layout: Layout | None = None,
    ):
        self.scene = scene
        self.bodies = tuple(bodies)
        self.connections = tuple(connections)
        self._layout = layout or platform_layout()
        self._token = 0
        self._bound: _BoundWorld | None = None
        self._enabled: tuple[np.ndarray, Places] | None = None  # of the connections that exist
        self._constraint_rows: ConstraintRows | None = None
        self._threshold_factor, self._holds_connections = 1.0, False
        self._feedback = _aligned_doubles(len(self.connections))

    def bind(self, depsgraph: bpy.types.Depsgraph, *, to_read: bool = True) -> WorldState:
        """Find the world, and check and prepare it where it is new. Cheap where it is not.

        Not for the start frame: there Blender still holds the world of an earlier simulation.

        Parameters
        ----------
        depsgraph
            Evaluated for the present frame.
        to_read
            Whether loads and motion are to be read. Otherwise the world may have been recorded or edited before, and
            only `retire` and `take_out_edited` can be used.

        Raises
        ------
        LayoutError
            Memory is not as expected; nothing has been written.
        SimulationError
            A body is not part of Blender's simulation.
        """
        dynamics = self._find_dynamics_world()
        if self._is_bound_to(dynamics):
            return WorldState.KNOWN
        self._bound = self._enabled = self._constraint_rows = None
        if not dynamics:
            return WorldState.ABSENT
        self._bound = self._check(dynamics, depsgraph, to_read)
        self._prepare()
        return WorldState.NEW

    @property
    def removed(self) -> np.ndarray:
        """Bodies (n,) that `remove_bodies` took out of the simulation."""
        return self._bound.removed

    def call_around_substeps(
        self, before: Callable[[float], None], after: Callable[[float], None] | None = None
    ) -> None:
        """Have functions called before and after every sub-step of this world, with the sub-step's length in s.

        They are called from whatever thread simulates, while Blender's data is in use: they must not touch bpy, and
        must not raise. Another world that Blender makes does not know them.
        """
        world = self._layout.world
        for field, action in ((world.before_step, before), (world.after_step, after)):
            address = ctypes.cast(_callback(action), ctypes.c_void_p).value if action else 0
            write_pointers(self._bound.dynamics + field, address)

    def take_substep(self) -> float:
        """Length in s of the sub-steps taken since the last call, 0.0 where none was taken.

        Bullet writes the length at every sub-step and never reads it back, so that taking it out tells frames that
        were simulated from frames that Blender played back from its cache.
        """
        address = self._bound.dynamics + self._layout.world.step
        substep = float(gather_doubles(np.array([address]))[0, 0])
        write_doubles(np.array([address]), 0.0)
        return substep

    def positions(self) -> tuple[np.ndarray, np.ndarray]:
        """Origins (n, 3) in m and rotation matrices (n, 3, 3) of all bodies."""
        transforms = np.ascontiguousarray(self._bound.transforms.copy().T)
        return transforms[:, 9:], transforms[:, :9].reshape(-1, 3, 3)

    def velocities(self) -> np.ndarray:
        """Linear velocities (n, 3) of all bodies, m/s."""
        return gather_doubles(self._body_fields(self._layout.body.linear_velocity), 3)

    def angular_velocities(self) -> np.ndarray:
        """Angular velocities (n, 3) of all bodies, rad/s."""
        return gather_doubles(self._body_fields(self._layout.body.angular_velocity), 3)

    def set_velocities(self, bodies: np.ndarray, velocities_m_s: np.ndarray, spins_rad_s: np.ndarray) -> None:
        """Give bodies (k,) velocities (k, 3) and spins (k, 3); those that sleep go on sleeping."""
        for offset, vectors in (
            (self._layout.body.linear_velocity, velocities_m_s),
            (self._layout.body.angular_velocity, spins_rad_s),
        ):
            write_vectors(self._bound.bodies[bodies] + np.uint64(offset), vectors)

    def put(self, bodies: np.ndarray, positions_m: np.ndarray) -> None:
        """Put bodies (k,) at positions (k, 3)."""
        write_vectors(self._bound.bodies[bodies] + np.uint64(self._layout.body.transform + 96), positions_m)

    def lead(self, bodies: np.ndarray, positions_m: np.ndarray, velocity_m_s: np.ndarray) -> None:
        """Put bodies (k,) that are animated at positions (k, 3), with one velocity (3,) for the coming sub-step.

        To be called before a sub-step: Bullet has worked out by then how animation would move them.
        """
        self.put(bodies, positions_m)
        resting = np.zeros((len(bodies), 3))
        for offset, values in (
            (self._layout.body.linear_velocity, resting + velocity_m_s),
            (self._layout.body.angular_velocity, resting),
        ):
            write_vectors(self._bound.bodies[bodies] + np.uint64(offset), values)

    def add_forces(self, bodies: np.ndarray, forces_n: np.ndarray, torques_nm: np.ndarray | None = None) -> None:
        """Add forces (k, 3) and torques (k, 3) on bodies (k,), each as often as it is named, in the coming sub-step.

        To be called before a sub-step, from a function of `call_around_substeps`: Bullet forgets them after it. A body
        that sleeps or cannot move is not moved by them.
        """
        count = len(self.bodies)
        named = self._named(bodies)
        for offset, values in ((0, forces_n), (32, torques_nm)):
            if values is None:
                continue
            sums = np.column_stack([np.bincount(bodies, column, count) for column in values.T])[named]
            fields = self._bound.bodies[named] + np.uint64(self._layout.body.total_force + offset)
            write_vectors(fields, gather_doubles(fields, 3) + sums)

    def push(self, bodies: np.ndarray, forces_n: np.ndarray) -> None:
        """Wake bodies (k,), each named once and in order, and add forces (k, 3) on them in the coming sub-step."""
        addresses, body = self._bound.bodies[bodies], self._layout.body
        states = gather_integers(addresses + np.uint64(body.activation))
        if ((states == ASLEEP) | (states == WANTS_SLEEP)).any():
            self.wake(bodies)
        add_vectors(addresses + np.uint64(body.total_force), forces_n)

    def wake(self, bodies: np.ndarray) -> None:
        """Wake those of bodies (k,) that sleep or are about to, as Bullet does when something touches them.

        To be called before a sub-step: Bullet has passed the sleeping ones by when it gave all others their weight, so
        they get it here.
        """
        named = self._named(bodies)
        states = gather_integers(self._bound.bodies[named] + np.uint64(self._layout.body.activation))
        drowsy = self._bound.bodies[named[(states == ASLEEP) | (states == WANTS_SLEEP)]]
        write_integers(drowsy + np.uint64(self._layout.body.activation), AWAKE)
        write_doubles(drowsy + np.uint64(self._layout.body.deactivation_time), 0.0)
        sleeping = named[states == ASLEEP]
        if not len(sleeping):
            return
        weights = gather_doubles(self._bound.bodies[sleeping] + np.uint64(self._layout.body.gravity), 3)
        self.add_forces(sleeping, weights)

    def asleep(self) -> np.ndarray:
        """Whether each body (n,) is asleep; what can never move is not."""
        states = gather_integers(self._body_fields(self._layout.body.activation))
        return np.isin(states, list(SLEEPING)) & self.can_move()

    def snapshots(self, sides: np.ndarray) -> SnapshotTaker:
        """What takes snapshots of this world, as long as it is bound.

        Parameters
        ----------
        sides
            (k,) which loads of connections are in them: 2 c for those of connection c on Bullet's body A, 2 c + 1 for
            those on its body B.
        """
        bound = self._bound
        return SnapshotTaker(
            self._layout,
            bound.bodies,
            bound.connections,
            bound.exists,
            bound.removed,
            bound.contacts,
            self._feedback,
            sides,
        )

    def body_motion(self) -> BodyMotionReader:
        """What reads and moves the bodies of this world, as long as it is bound."""
        return BodyMotionReader(self._layout, self._bound.bodies)

    def constraint_rows(self) -> ConstraintRows:
        """What writes to the rows of the connections of this world, as long as it is bound; all have to exist.

        When the world is released they are as Blender made them again.

        Raises
        ------
        LayoutError
            Memory is not as expected.
        SimulationError
            A connection is switched off.
        """
        if not self._bound.exists.all():
            name = self.connections[int(np.argmin(self._bound.exists))].name
            raise SimulationError(f"elastic connection {name!r} is switched off: enable it, or delete it")
        names = [each.name for each in self.connections]
        self._constraint_rows = ConstraintRows(self._layout, self._bound.connections, names)
        return self._constraint_rows

    def write_loads(self, *, wanted: bool) -> None:
        """Have Bullet write the loads of connections after every sub-step, as it does from `bind` on, or leave them.

        Loads that are there stay.
        """
        starts = self._feedback.ctypes.data + 8 * _FEEDBACK_DOUBLES * np.arange(len(self.connections), dtype=np.uint64)
        self._point_feedback_at(starts[self._bound.exists] if wanted else np.uint64(0))

    def break_connections(self, rows: np.ndarray) -> None:
        """Break connections (k,), as Bullet does at their breaking thresholds."""
        rows = rows[self._bound.exists[rows]]
        write_bytes(self._bound.connections[rows] + np.uint64(self._layout.constraint.enabled), 0)
        self._feedback[rows] = 0.0  # Bullet would leave the last load of one whose bodies are not simulated any more

    def weaken_connections(self, rows: np.ndarray, factor: float) -> None:
        """Multiply the breaking thresholds of connections (k,)."""
        rows = rows[self._bound.exists[rows]]
        self._bound.thresholds[(np.cumsum(self._bound.exists) - 1)[rows]] *= factor
        self._write_thresholds()

    def remove_bodies(self, rows: np.ndarray) -> None:
        """Take bodies (k,) out of the simulation for good; their connections have to be broken.

        Deleting them would crash Blender, which still points at them. They stay, disabled, out of reach of all others:
        `OUT_OF_REACH_M` below their positions.
        """
        addresses, body = self._bound.bodies[rows], self._layout.body
        origins = addresses + np.uint64(body.transform + 96)
        self._bound.contacts.forget(rows)
        write_vectors(origins, gather_doubles(origins, 3) - (0.0, 0.0, OUT_OF_REACH_M))
        for field in (body.linear_velocity, body.angular_velocity):
            write_vectors(addresses + np.uint64(field), np.zeros((len(rows), 3)))
        write_integers(addresses + np.uint64(body.activation), DISABLED)
        self._bound.removed[rows] = True

    def slow_down(self, bodies: np.ndarray, share: float) -> None:
        """Multiply the velocities and angular velocities of bodies (k,) by a share."""
        for offset in (self._layout.body.linear_velocity, self._layout.body.angular_velocity):
            fields = self._bound.bodies[bodies] + np.uint64(offset)
            write_vectors(fields, share * gather_doubles(fields, 3))

    def can_move(self) -> np.ndarray:
        """Whether each body (n,) is free now: neither passive nor led by animation."""
        return gather_doubles(self._body_fields(self._layout.body.inverse_mass))[:, 0] > 0.0

    def hold_connections(self) -> None:
        """Let no connection break at its threshold, until `release_connections`."""
        self._holds_connections = True
        self._write_thresholds()

    def release_connections(self) -> None:
        """Let connections break at their thresholds again."""
        self._holds_connections = False
        self._write_thresholds()

    def scale_thresholds(self, factor: float) -> None:
        """Let connections break at a multiple of the thresholds that Blender gave them."""
        if factor != self._threshold_factor:
            self._threshold_factor = factor
            self._write_thresholds()

    def intact(self) -> np.ndarray:
        """Whether each connection (m,) exists and has not broken."""
        exists = self._bound.exists
        if self._enabled is None or not np.array_equal(exists, self._enabled[0]):
            offsets = [self._layout.constraint.enabled]
            self._enabled = exists.copy(), Places(self._bound.connections[exists], offsets, np.uint8)
        intact = np.zeros(len(self.connections), bool)
        intact[exists] = self._enabled[1].copy()[0] != 0
        return intact

    def let_broken_collide(self, intact: np.ndarray) -> None:
        """Let the bodies of connections (m,) that broke since the last call, and are not intact now, collide again."""
        broken = self._bound.forbids_collision & ~intact
        if broken.any():
            self._bound.collision_pairs.restore(self._bound.pair_rows[broken])
            self._bound.forbids_collision[broken] = False

    def first_is_body_a(self) -> np.ndarray:
        """Whether `object1` of each connection (m,) is Bullet's body A; True where the connection does not exist."""
        first = np.ones(len(self.connections), bool)
        addresses = self._connection_fields(self._layout.constraint.body_a)
        body_a = gather_pointers(addresses)
        by_object = dict(zip(self.bodies, self._bound.bodies.tolist(), strict=True))
        existing = itertools.compress(self.connections, self._bound.exists)
        expected = [by_object.get(connection.rigid_body_constraint.object1) for connection in existing]
        first[self._bound.exists] = [a == e for a, e in zip(body_a.tolist(), expected, strict=True)]
        return first

    def release(self) -> None:
        """Take our buffers out of the world again, where it is still the one that was prepared."""
        try:
            ours = self._is_bound_to(self._find_dynamics_world())
        except (LayoutError, ReferenceError):  # the scene is gone, and its world with it
            ours = False
        if ours:
            self._forget_freed_connections()
            self._point_feedback_at(np.uint64(0))
            if self._constraint_rows:
                self._constraint_rows.restore(np.flatnonzero(self._bound.exists))
            world = self._layout.world
            for field in (world.before_step, world.after_step, world.user_info):
                write_pointers(self._bound.dynamics + field, 0)
        self._bound = self._enabled = self._constraint_rows = None

    def retire(self, *, bodies_stay: bool = True) -> None:
        """Make a world safe that objects are being taken out of; it must not be simulated any more.

        Where the bodies that are there now do not stay until the world is freed, it lets go of all of them.

        Raises
        ------
        LayoutError
            Memory is not as expected; nothing has been written but that no loads are read any more.
        """
        if not self._is_bound_to(self._find_dynamics_world()):
            return
        bound = self._bound
        connections = bound.connections[bound.exists]
        alive = bound.fingerprints.still_there(connections)
        self._forget_freed_connections()
        self._point_feedback_at(np.uint64(0))
        retire(self._layout, bound.dynamics, bound.bodies, connections, alive, bodies_stay=bodies_stay)
        bound.exists[:] = False

    def outlive(self) -> None:
        """Make the connections of a removed world safe: Blender has freed their bodies, and deletes them later.

        To be called before Blender updates anything.
        """
        if self._bound is not None:
            connections = self._bound.connections[self._bound.exists]
            alive = self._bound.fingerprints.still_there(connections)
            take_bodies_from(self._layout, connections[alive])

    def has_grown(self) -> bool:
        """Return whether Blender has added anything to the world since it was bound, as it does after an edit."""
        world, count = self._layout.world, self._layout.array.count
        known = ((world.bodies, len(self._bound.bodies)), (world.constraints, np.count_nonzero(self._bound.exists)))
        return any(read_value(self._bound.dynamics + array + count, "i") > number for array, number in known)

    def take_out_edited(self) -> list[bpy.types.Object]:
        """Take out of the world what Blender is about to free, as it was edited; return the connections concerned.

        Blender copies an edited object anew. It frees the constraint of the former copy, makes another, and forgets to
        take the first one out. To be called before Blender updates anything.

        Raises
        ------
        LayoutError
            Memory is not as expected; nothing has been written.
        """
        depsgraph = self._depsgraph_with_copies()
        rows = self._edited_rows(depsgraph) if depsgraph else np.empty(0, int)
        rows = rows[self._bound.exists[rows]] if len(rows) else rows
        if len(rows):
            self._take_out(rows)
        return [self.connections[row] for row in rows]

    def _depsgraph_with_copies(self) -> bpy.types.Depsgraph | None:
        """What copies the connections of the world that was prepared, where their constraints are on copies."""
        if not self._is_bound_to(self._find_dynamics_world()) or self._bound.copies is None:
            return None
        depsgraphs = (layer.depsgraph for layer in self.scene.view_layers)
        return next((each for each in depsgraphs if each and each.as_pointer() == self._bound.depsgraph), None)

    def _edited_rows(self, depsgraph: bpy.types.Depsgraph) -> np.ndarray:
        """Rows (k,) of the connections whose copies the coming update replaces, or frees as their collection is hidden.

        What waits for an update is known by its copy: the original may be deleted by now.
        """
        constraints = self.scene.rigidbody_world.constraints
        if depsgraph.id_type_updated("SCENE") and not _is_shown(constraints, depsgraph.view_layer.layer_collection):
            return np.arange(len(self.connections))
        if not depsgraph.id_type_updated("OBJECT"):
            return np.empty(0, int)
        rows = (self._bound.copies.get(update.id.as_pointer()) for update in depsgraph.updates)
        return np.array([row for row in rows if row is not None], int)

    def _take_out(self, rows: np.ndarray) -> None:
        """Take connections (k,) that exist out of the world."""
        bound = self._bound
        known, gone = (set(each.tolist()) for each in (bound.connections[bound.exists], bound.connections[rows]))
        take_out_constraints(self._layout, bound.dynamics, bound.bodies, known, gone)
        bound.exists[rows] = False

    def _named(self, bodies: np.ndarray) -> np.ndarray:
        """Those of bodies (k,), each once and in order."""
        return np.flatnonzero(np.bincount(bodies, minlength=len(self.bodies)))

    def _forget_freed_connections(self) -> None:
        """Leave those alone that Blender has freed by now."""
        self._bound.exists[self._bound.exists] = self._bound.fingerprints.still_there(
            self._bound.connections[self._bound.exists]
        )

    def _find_dynamics_world(self) -> int:
        """Address of the btDiscreteDynamicsWorld, 0 while there is none."""
        blender, world = self._layout.blender, self.scene.rigidbody_world
        if world is None:
            return 0
        checks.check_settings(self._layout, world)
        shared = read_pointer(world.as_pointer() + blender.world_shared)
        holder = read_pointer(shared + blender.shared_physics_world) if shared else 0
        if not holder:
            return 0
        # Blender 4.2 points at the physics world itself, later ones at a block whose first field points at it.
        inner = read_pointer(holder)
        if not inner:
            return 0
        for candidate in (holder, inner):
            if checks.is_physics_world(self._layout, candidate):
                return read_pointer(candidate)
        raise LayoutError("no Bullet world where Blender should keep it")

    def _is_bound_to(self, dynamics: int) -> bool:
        """Whether this is the world that was prepared, and not one that Blender has made since."""
        return self._bound is not None and dynamics == self._bound.dynamics and self._is_marked(dynamics)

    def _is_marked(self, dynamics: int) -> bool:
        if not (dynamics and self._token):
            return False
        return read_value(dynamics + self._layout.world.user_info, "Q") == self._token

    def _check(self, dynamics: int, depsgraph: bpy.types.Depsgraph, to_read: bool) -> _BoundWorld:
        """Check a new world from end to end. Nothing is written."""
        layout, world = self._layout, self._layout.world
        if to_read:
            checks.check_solver(layout, dynamics, self.scene.rigidbody_world, scene_time_step(self.scene).substep_s)
        bodies = self._find_bodies(depsgraph, to_read)
        are_copied = self._are_copied(depsgraph)
        holders = [each.evaluated_get(depsgraph) for each in self.connections] if are_copied else self.connections
        connections = self._find_connections(holders, bodies, to_read)
        bodies = bodies[bodies != 0]
        for field in (world.user_info, world.before_step, world.after_step):
            if read_value(dynamics + field, "Q") and not self._is_marked(dynamics):
                raise LayoutError("something else has its hand on Blender's Bullet world")
        exists = connections != 0
        forbidding = [each.rigid_body_constraint.disable_collisions for each in self.connections]
        forbids_collision = np.array(forbidding, bool) & exists
        return _BoundWorld(
            dynamics=dynamics,
            bodies=bodies,
            connections=connections,
            exists=exists,
            transforms=Places(bodies, layout.body.transform + _TRANSFORM),
            removed=np.zeros(len(bodies), bool),
            thresholds=gather_doubles(connections[exists] + np.uint64(layout.constraint.breaking_threshold))[:, 0],
            forbids_collision=forbids_collision,
            collision_pairs=CollisionPairs(layout, connections[forbids_collision], bodies) if to_read else None,
            pair_rows=np.cumsum(forbids_collision) - 1,
            fingerprints=Fingerprints(layout, connections[exists]),
            contacts=ContactReader(layout, read_pointer(dynamics + world.dispatcher), bodies),
            depsgraph=depsgraph.as_pointer(),
            copies={each.as_pointer(): row for row, each in enumerate(holders)} if are_copied else None,
        )

    def _prepare(self) -> None:
        """Write our token and our buffers into the world that was checked."""
        self._threshold_factor, self._holds_connections = 1.0, False
        self._feedback[:] = 0.0
        self.write_loads(wanted=True)
        self._token = next(_tokens)
        write_pointers(self._bound.dynamics + self._layout.world.user_info, self._token)

    def _find_bodies(self, depsgraph: bpy.types.Depsgraph, to_read: bool) -> np.ndarray:
        """Bullet's bodies (n,); 0 for one that is not simulated, where nothing is to be read."""
        holders, addresses = [], []
        for body in self.bodies:
            shared = read_pointer(body.rigid_body.as_pointer() + self._layout.blender.body_shared)
            holder = read_pointer(shared) if shared else 0
            if to_read and not holder:
                raise SimulationError(f"body {body.name!r} is not simulated: give it a mesh and a rigid body")
            holders.append(holder)
            addresses.append(read_pointer(holder) if holder else 0)
        found = [each for each in zip(self.bodies, holders, addresses, strict=True) if each[1]]
        if to_read:
            checks.check_bodies(self._layout, found, depsgraph)
        else:
            checks.check_owners(self._layout, found)
        return np.array(addresses, np.uint64)

    def _are_copied(self, depsgraph: bpy.types.Depsgraph) -> bool:
        """Whether Blender notes its constraints on evaluated copies of the connections.

        It notes them on the objects that it finds in the collection of the world's constraints. Where that collection
        is not in the scene, as Blender's own buttons leave it, these are the objects themselves.
        """
        constraints = self.scene.rigidbody_world.constraints
        return bool(constraints) and constraints.evaluated_get(depsgraph).is_evaluated

    def _address(self, holder: bpy.types.Object) -> int:
        """Bullet's constraint of a connection, or of its copy; 0 where there is none."""
        return read_pointer(holder.rigid_body_constraint.as_pointer() + self._layout.blender.connection_physics)

    def _find_connections(
        self, holders: Sequence[bpy.types.Object], body_addresses: np.ndarray, to_read: bool
    ) -> np.ndarray:
        """Bullet's constraints (m,) that connections or their copies hold, 0 for one that is switched off."""
        addresses = [self._address(each) for each in holders]
        existing = [pair for pair in zip(self.connections, addresses, strict=True) if pair[1]]
        for connection, address in zip(self.connections, addresses, strict=True):
            if to_read and not address and connection.rigid_body_constraint.enabled:
                raise SimulationError(
                    f"connection {connection.name!r} is not simulated: give it two bodies and show it"
                )
        by_object = dict(zip(self.bodies, body_addresses.tolist(), strict=True))
        checks.check_connections(self._layout, existing, by_object, were_edited=not to_read)
        return np.array(addresses, np.uint64)

    def _body_fields(self, offset: int) -> np.ndarray:
        """Return the addresses (n,) of a field of all bodies."""
        return self._bound.bodies + np.uint64(offset)

    def _connection_fields(self, offset: int) -> np.ndarray:
        """Return the addresses (e,) of a field of the connections that exist."""
        return self._bound.connections[self._bound.exists] + np.uint64(offset)

    def _write_thresholds(self) -> None:
        values = np.inf if self._holds_connections else self._bound.thresholds * self._threshold_factor
        write_doubles(self._connection_fields(self._layout.constraint.breaking_threshold), values)

    def _point_feedback_at(self, targets: np.ndarray | np.uint64) -> None:
        write_pointers(self._connection_fields(self._layout.constraint.joint_feedback), targets)


def _is_shown(collection: bpy.types.Collection, layer_collection: bpy.types.LayerCollection) -> bool:
    """Return whether a collection is in a part of a view layer, so that Blender evaluates what is in it."""
    if layer_collection.collection.hide_viewport:
        return False
    if layer_collection.collection == collection and not layer_collection.exclude:
        return True
    return any(_is_shown(collection, each) for each in layer_collection.children)


def _callback(action: Callable[[float], None]) -> object:
    """A function as Bullet calls it, never to be freed."""
    callback = _STEP_FUNCTION(lambda _world, substep: action(substep))
    _callbacks_bullet_may_call.append(callback)
    return callback


def _aligned_doubles(count: int) -> np.ndarray:
    """Zeroed feedback blocks (count, 4, 4), aligned so that a body's load is in one cache line, never to be freed."""
    raw = np.zeros(count * _FEEDBACK_DOUBLES + _CACHE_LINE // 8)
    _buffers_bullet_may_write.append(raw)
    start = (-raw.ctypes.data % _CACHE_LINE) // 8
    return raw[start : start + count * _FEEDBACK_DOUBLES].reshape(count, 4, 4)
