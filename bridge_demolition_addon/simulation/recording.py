"""Recording a simulation while Blender's timeline runs: forces, motion and breaking, frame by frame."""

from __future__ import annotations

import time
from pathlib import Path

import bpy
import numpy as np

from ..bullet.held_time import hold_time, release_time, time_is_held
from ..bullet.world import BulletWorld, WorldState
from ..core import forces
from ..core.errors import SimulationError
from ..core.motion import throw, travel
from ..core.results import Results
from ..scene.bodies import bodies_of, kind_of
from ..scene.connections import connections_of
from .logs import DEBRIS_COLUMNS, FORCE_COLUMNS, BodyLog


class Recording:
    """What happens in one scene from its start frame on; a simulation that starts anew is recorded anew.

    Parameters
    ----------
    scene
        Scene with a rigid-body world.
    folder
        Existing folder for the logs.

    Attributes
    ----------
    scene, folder
        As given.
    error
        Why the recording ended before its time, or None.
    seconds
        Wall time that recording has taken so far.
    """

    def __init__(self, scene: bpy.types.Scene, folder: Path):
        if scene.rigidbody_world is None or scene.rigidbody_world.collection is None:
            raise SimulationError(f"scene {scene.name!r} has no rigid-body world: build a demolition in it first")
        self.scene = scene
        self.error: Exception | None = None
        self.seconds = 0.0
        self.folder = folder
        self._bodies = bodies_of(scene)
        self._connections = connections_of(scene)
        self._counts_at_start = self._object_counts()
        self._world = BulletWorld(scene, self._bodies, self._connections)
        self._logs: tuple[BodyLog, BodyLog] | None = None
        self._steps: list[dict[str, np.ndarray | float]] = []

    def before_frame(self) -> None:
        """Let no time pass in the frame in which Blender makes its world.

        The world's first step otherwise happens in the same breath as its making, before anything can be asked of it.
        """
        if self.scene.frame_current == self._start_frame + 1:
            hold_time(self.scene)

    def after_frame(self, depsgraph: bpy.types.Depsgraph) -> None:
        """Take down what the frame's last sub-step left behind.

        Raises
        ------
        LayoutError, SimulationError
            The world cannot be read, or bodies were added or removed while it ran.
        """
        began = time.perf_counter()
        try:
            if self.scene.frame_current > self._start_frame:
                self._record(self._bound_state(depsgraph), time_is_held(depsgraph))
        finally:
            release_time(self.scene)
            self.seconds += time.perf_counter() - began

    def fail(self, error: Exception) -> None:
        """End the recording for a reason."""
        self.error = error
        self.close()

    def close(self) -> None:
        """Take everything of ours out of Blender's world and close the logs. What was recorded stays."""
        self._world.release()
        if self._logs:
            self._write_debris(self._steps[-1])
            for log in self._logs:
                log.close()
            self._logs = None

    @property
    def recorded_frames(self) -> int:
        """Frames recorded so far."""
        return len(self._steps)

    @property
    def broken(self) -> int:
        """Connections broken by now."""
        return int((~self._steps[-1]["intact"]).sum()) if self._steps else 0

    def results(self) -> Results:
        """Everything recorded.

        Raises
        ------
        SimulationError
            Nothing was recorded.
        """
        if not self._steps:
            raise SimulationError("nothing was recorded: play the timeline from its start frame")
        series = {name: np.array([step[name] for step in self._steps]) for name in self._steps[0]}
        return Results(
            body_names=np.array(self._names),
            body_kinds=np.array(self._kinds),
            masses_kg=self._masses,
            connection_names=np.array(self._connection_names),
            pairs=self._pairs,
            **series,
        )

    @property
    def _start_frame(self) -> int:
        return self.scene.rigidbody_world.point_cache.frame_start

    def _bound_state(self, depsgraph: bpy.types.Depsgraph) -> WorldState:
        if self.scene.rigidbody_world is None:
            raise SimulationError("the rigid-body world was removed while it was recorded")
        if self._object_counts() != self._counts_at_start:
            raise SimulationError("bodies or connections were added or removed: go to the start frame and record anew")
        return self._world.bind(depsgraph)

    def _object_counts(self) -> tuple[int, int]:
        world = self.scene.rigidbody_world
        return len(world.collection.all_objects), len(world.constraints.all_objects) if world.constraints else 0

    def _record(self, state: WorldState, held: bool) -> None:
        if state is WorldState.ABSENT:
            return
        substep = self._world.take_substep()
        if state is WorldState.NEW:
            self._begin()
            # The solver of a new world names a default step before it has taken any.
            self._record_step(0.0 if held else substep, forces_known=held)
        elif substep > 0.0:
            self._record_step(substep, forces_known=True)
            self._world.let_broken_collide()
        # Without a step Blender played the frame back from its cache, and Bullet stands where it stood.

    def _begin(self) -> None:
        """Note what stays the same throughout, and start the logs."""
        self._steps.clear()
        self._elapsed = 0.0
        self._names = [body.name for body in self._bodies]
        self._kinds = [kind_of(body).value for body in self._bodies]
        active = np.array([body.rigid_body.type == "ACTIVE" for body in self._bodies])
        self._masses = np.where(active, [body.rigid_body.mass for body in self._bodies], 0.0)
        self._connection_names = [connection.name for connection in self._connections]
        self._pairs = self._paired_bodies()
        self._measured_side = np.where(self._masses[self._pairs[:, 0]] > 0.0, 0, 1)
        self._feedback_side = np.where(self._world.first_is_body_a(), self._measured_side, 1 - self._measured_side)
        self._measured_bodies = np.take_along_axis(self._pairs, self._measured_side[:, None], axis=1)[:, 0]
        self._local_points = self._points_in_measured_bodies()
        self._logs = (
            BodyLog(self.folder / "force_log.csv", FORCE_COLUMNS, self._names),
            BodyLog(self.folder / "debris_log.csv", DEBRIS_COLUMNS, self._names),
        )

    def _paired_bodies(self) -> np.ndarray:
        index = {body: number for number, body in enumerate(self._bodies)}
        pairs = []
        for connection in self._connections:
            constraint = connection.rigid_body_constraint
            if constraint.object1 not in index or constraint.object2 not in index:
                raise SimulationError(f"connection {connection.name!r} lacks a body: give it two, or delete it")
            pairs.append((index[constraint.object1], index[constraint.object2]))
        return np.array(pairs, int).reshape(-1, 2)

    def _points_in_measured_bodies(self) -> np.ndarray:
        """Points of the connections (m, 3) in the axes of the bodies their loads are measured on."""
        points = np.array([connection.matrix_world.translation for connection in self._connections]).reshape(-1, 3)
        centres, rotations = self._world.places()
        bodies = self._measured_bodies
        return np.einsum("mji,mj->mi", rotations[bodies], points - centres[bodies])

    def _record_step(self, substep_s: float, forces_known: bool) -> None:
        self._elapsed += substep_s * self.scene.rigidbody_world.substeps_per_frame
        places, rotations = self._world.places()
        force, moment = self._connection_loads(places, rotations)
        if not forces_known:  # a step was taken before we could ask for its forces
            force, moment = np.full_like(force, np.nan), np.full_like(moment, np.nan)
        step = {
            "frames": self.scene.frame_current,
            "times_s": self._elapsed,
            "substep_s": substep_s,
            "places_m": places,
            "rotations": rotations,
            "velocities_m_s": self._world.velocities(),
            "connection_forces_n": force,
            "connection_moments_nm": moment,
            "intact": self._world.intact(),
        }
        self._steps.append(step)
        self._write_forces(step)
        if len(self._steps) == 1:
            self._write_debris(step)

    def _connection_loads(self, places: np.ndarray, rotations: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Force (m, 3) on the first body of each connection, and moment (m, 3) about the connection's point.

        They are measured on a body that can move: of a hinge on a fixed body, Bullet leaves out a part of the torque
        on that body.
        """
        bodies, rows = self._measured_bodies, np.arange(len(self._pairs))
        feedback = self._world.joint_feedback().reshape(-1, 2, 2, 3)[rows, self._feedback_side]
        force, torque = feedback[:, 0], feedback[:, 1]
        points = forces.carried_points(self._local_points, bodies, places, rotations)
        moment = forces.moments_at(points, force, torque, places[bodies])
        on_first = np.where(self._measured_side == 0, 1.0, -1.0)[:, None]
        return on_first * force, on_first * moment

    def _write_forces(self, step: dict) -> None:
        force, count = step["connection_forces_n"], len(self._bodies)
        values = np.column_stack(
            (forces.resultants(self._pairs, force, count), forces.magnitude_sums(self._pairs, force, count))
        )
        self._logs[0].write(step["frames"], step["times_s"], values)

    def _write_debris(self, step: dict) -> None:
        first, last = self._steps[0]["places_m"], step["places_m"]
        self._logs[1].write(
            step["frames"], step["times_s"], np.column_stack((last, travel(first, last), throw(first, last)))
        )
