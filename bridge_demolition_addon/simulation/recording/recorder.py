"""Recording a simulation while Blender's timeline runs: loads, motion and breaking, frame by frame."""

from __future__ import annotations

import logging
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from ...bullet.time_control import time_stands_still
from ...bullet.world import BulletWorld, WorldState
from ...engineering.core.library import missing_core
from ...errors import CoreError, LayoutError, NotFiniteError, OutputError, SimulationError
from ...model.results.extremes import BarsOfRun, BearingExtreme
from ...model.results.frames import BallHistory, ContactHistory, Frame, Inventory
from ...model.schema import given
from ...scene.as_built import build_of, changed_bodies, check_start
from ...scene.bodies import bodies_of
from ...scene.connections.constraints import connections_of, rewrite_thresholds
from ...scene.connections.elasticity import is_elastic, named_bearings_of
from ...scene.run_setup import RunSetup, run_setup_of
from ...scene.tools.ball import begin_lifts, lifts_of
from ...scene.tools.cables import hide_cables
from ...scene.world import time_step_at
from .bars import RecordedBars
from .bearings import RecordedBearings
from .blast import Blast, check_blast
from .bullet_reader import BulletReader
from .elastic_connections import RestingState
from .loads import Loads
from .logs import LogFiles, Logs
from .motion_reader import READING as READING_OF_MOTION
from .motion_reader import MomentumReader, check_motion_is_enough
from .pulls import Pulls
from .recordable import check_recordable
from .recorded_frames import RecordedFrames
from .run_timing import RunTiming
from .tendons import Tendons

_CONSOLE = logging.getLogger(__name__)

WITHOUT_LOADS = "motion and breaking, without loads"


class Recording(RecordedFrames):
    """Records one scene from its start frame on; a simulation that starts again is recorded from its beginning.

    All that decides the run is read from the scene when its simulation begins: up to then the scene can be edited.

    Parameters
    ----------
    folder
        For the frames and the logs; has to exist when the simulation begins.
    every_substep
        Whether loads are read after every sub-step, or only after the last one of each frame.
    log_files
        Logs that do not go to the folder; all do by default.
    loads
        Whether loads and work are recorded and logs written. Without them a run takes less time, and motion and
        breaking have the same bits.
    contacts
        Whether the contacts of the last sub-step of each frame are kept, where loads are.

    Attributes
    ----------
    scene_uid : int
        Number of the scene as long as Blender runs, also when the scene is gone.
    build : str
        Which building of a demolition it is of; empty where none was built.
    changed_bodies : list of str
        Which bodies are missing, were added or moved since the scene was built, in sentences.
    error : Exception or None
        Why the recording ended early.
    layout_error : LayoutError, CoreError or None
        Why Bullet's memory is not read: it is not as expected, or there is no core that reads it. Then only the motion
        of bodies is recorded, and the net force on each from its change of momentum.
    setup : RunSetup or None
        All that decides the run; None before the first frame.
    substeps : int
        Sub-steps of the frame played last.
    tendons : Tendons or None
        What each tendon let go so far; None without any.
    pulls : Pulls or None
        What each cable pulled with so far; None without any.
    """

    def __init__(
        self,
        scene: bpy.types.Scene,
        folder: Path,
        *,
        every_substep: bool = True,
        log_files: LogFiles | None = None,
        loads: bool = True,
        contacts: bool = False,
    ):
        super().__init__()
        check_recordable(scene)
        self.changed_bodies = changed_bodies(scene)
        for text in self.changed_bodies:
            _CONSOLE.warning("%s: %s", scene.name, text)
        rewrite_thresholds(scene)  # the step may have changed since the scene was built
        self.scene = scene
        self.scene_uid = scene.session_uid
        self.build = build_of(scene)
        self.folder = folder
        self.error: Exception | None = None
        self.layout_error: LayoutError | CoreError | None = missing_core()
        self._every_substep = every_substep
        self._log_files, self.has_loads = log_files or LogFiles(), loads
        self._has_contacts = contacts and loads
        self._seconds = 0.0
        bodies = bodies_of(scene)
        check_blast(scene, bodies)
        self.world = BulletWorld(scene, bodies, connections_of(scene))
        self.setup: RunSetup | None = None
        self._timing = RunTiming(scene)
        self._lifted: list[bpy.types.Object] = []
        self._reader: BulletReader | None = None
        self.tendons: Tendons | None = None
        self.pulls: Pulls | None = None
        self.loads: Loads | None = None
        self._momentum: MomentumReader | None = None
        self._logs: Logs | None = None
        self._blast: Blast | None = None
        self._bearings: RecordedBearings | None = None
        self._bars: RecordedBars | None = None
        self.substeps = 0

    def before_frame(self) -> None:
        """Set the time that passes in the coming frame, and its blast loads."""
        try:
            self._timing.set_time(holds_first=self.layout_error is None)
        except LayoutError as error:
            self.layout_error = error
        coming = self.scene.frame_current
        last = self.last if self.last and coming == self.last.number + 1 else None
        if self._blast and last:
            frame_s = time_step_at(self.scene, coming).frame_s
            self._blast.before_frame(last.time_s, frame_s, last.positions_m, last.rotations)
        elif self._blast:
            self._blast.rest()
        self.substeps = self._timing.set_substeps(None if self.layout_error else last)
        if self._reader:
            self._reader.before_frame(self.substeps)

    def after_frame(self, depsgraph: bpy.types.Depsgraph) -> None:
        """Record the frame."""
        began = time.perf_counter()
        try:
            if not self.layout_error:
                self._follow_bullet(depsgraph)
            if self.layout_error:
                self._follow_motion(depsgraph)
            begin_lifts(self._lifted, self.scene.frame_current, depsgraph)
        except NotFiniteError as error:
            inventory = given(self.setup).inventory
            names = inventory.body_names.tolist(), inventory.connection_names.tolist()
            raise error.named(*names, self._reader.elapsed_s if self._reader else 0.0) from error
        finally:
            self._seconds += time.perf_counter() - began

    def fail(self, error: Exception) -> None:
        """End the recording for a reason."""
        self.error = error
        self.close()

    def close(self) -> None:
        """Take our buffers out of Blender's world and close the logs; the frames stay."""
        if self._blast:
            self._blast.rest()
        self.world.release()
        if self._reader:
            self._reader.close()
        logs, self._logs = self._logs, None
        if logs:
            try:
                logs.close(self.last)
            except OutputError as error:
                self.error = self.error or error  # a full disk, which may have ended the recording

    @property
    def lost_blast_loads(self) -> int:
        """How often a body has left its force field within a frame, and lost a part of its load."""
        return self._blast.lost_loads if self._blast else 0

    @property
    def applied_events(self) -> list[dict[str, Any]]:
        """Changes to the structure so far, ready for JSON: shards that no longer carry, connections concerned."""
        names = self.inventory.body_names if self.inventory else ()
        return [
            {
                "time_s": event.time_s,
                "kind": event.change.kind,
                "shards": [str(names[body]) for body in event.bodies],
                "connections": len(event.connections),
                **event.change.recorded(),
                **event.bars_so_far(),
                **({"held_by": _members_of(event.held_by, given(self.inventory))} if event.change.by_crane else {}),
            }
            for event in (self._reader.applied_events if self._reader else ())
        ]

    @property
    def resting_state(self) -> RestingState | None:
        """How the bridge deforms under its own weight; None where its connections are rigid."""
        return self._reader.resting_state if self._reader else None

    @property
    def bearings(self) -> list[BearingExtreme]:
        """The largest and least that each bearing carried so far."""
        return self._bearings.extremes if self._bearings else []

    @property
    def reinforcement(self) -> BarsOfRun | None:
        """What bars across cracks did so far; None where they are not followed."""
        return self._bars.so_far() if self._bars else None

    @property
    def only_motion_because(self) -> str:
        """Why only motion is recorded; empty where loads are."""
        if isinstance(self.layout_error, LayoutError):
            return f"Blender's memory is not as expected: {self.layout_error}"
        return str(self.layout_error or "")

    @property
    def rigid_because(self) -> LayoutError | None:
        """Why connections that should be elastic are rigid."""
        if isinstance(self.layout_error, LayoutError) and is_elastic(self.scene):
            return self.layout_error
        return self._reader.rigid_because if self._reader else None

    @property
    def seconds(self) -> float:
        """Wall time that recording has taken so far."""
        # The one sub-step that is read of a frame is in the frame's own time.
        return self._seconds + (self.reading_seconds if self._every_substep else 0.0)

    @property
    def reading_seconds(self) -> float:
        """The part of it in Bullet's sub-steps: copying its state, and breaking connections by their strength."""
        return self._reader.seconds if self._reader else 0.0

    def _follow_bullet(self, depsgraph: bpy.types.Depsgraph) -> None:
        """Record the frame from Bullet's memory, or note why that is not as expected."""
        try:
            if self.scene.frame_current > self.scene.rigidbody_world.point_cache.frame_start:
                self._record(self.world.bind(depsgraph), time_stands_still(depsgraph))
        except LayoutError as error:
            if self.last:  # recorded from it
                raise
            self.layout_error = error
        finally:
            self._timing.release()

    def _follow_motion(self, depsgraph: bpy.types.Depsgraph) -> None:
        """Record the frame from the positions of the bodies."""
        number = self.scene.frame_current
        begins = number == self.scene.rigidbody_world.point_cache.frame_start
        if begins or not self._momentum:
            setup = run_setup_of(self.scene, with_connections=False)
            assert self.layout_error is not None
            needs = {"contacts": self._has_contacts, "elastic": is_elastic(self.scene)}
            check_motion_is_enough(setup, self.layout_error, **needs)
            self._momentum = MomentumReader(self.scene, setup.bodies.objects, setup.inventory)
            self._begin(setup, None)
        elif self.last is None or number != self.last.number + 1:
            return  # not a step forward in time, but a frame that was recorded already or will be
        frame = self._momentum.read_frame(depsgraph)
        if begins:
            check_start(given(self.setup), frame.positions_m)
        self._keep(frame, BallHistory.unknown())

    def _record(self, state: WorldState, held: bool) -> None:
        if state is WorldState.ABSENT:
            return
        substep = self.world.take_substep()
        if state is WorldState.NEW:
            reader = self._begin_with_bullet(held)
            # The solver of a new world names a default step before it has taken any.
            self._keep(reader.read_first_frame(0.0 if held else substep), BallHistory.unknown())
        elif substep > 0.0:
            reader = given(self._reader)
            frame, breaks = reader.read_frame(substep)
            contacts = reader.take_contacts(frame.number) if self._has_contacts else None
            self._keep(frame, reader.take_ball_history(), contacts)
            if self._logs:
                self._logs.write_breaks(frame.number, breaks)
        # Without a step Blender played the frame back from its cache, and Bullet stands where it stood.

    def _begin_with_bullet(self, held: bool) -> BulletReader:
        """Begin with the first frame of a new world, in which time was held, or not."""
        if self._reader:  # of an earlier world
            self._reader.close()
        setup = run_setup_of(self.scene)
        if held:
            check_start(setup, self.world.bodies.positions()[0])
        _begin_motion(setup, self.world, held)
        self._begin(setup, self.world)
        self._reader = BulletReader(
            self.scene, setup, self.world, self._blast, every_substep=self._every_substep, loads=self.has_loads
        )
        self.tendons, self.pulls, self.loads = self._reader.tendons, self._reader.pulls, self._reader.loads
        if self._logs and self._reader.have_bars is not None:
            self._bars = RecordedBars(setup.inventory, self._reader.have_bars)
            self._logs.begin_bars()
        return self._reader

    def _begin(self, setup: RunSetup, world: BulletWorld | None) -> None:
        """Prepare blast, frames and logs; the world is None where it cannot be read."""
        if self._blast:
            self._blast.rest()
        self.setup = setup
        self._bars = None
        self._lifted = [body for body in setup.bodies.objects if lifts_of(body)]
        self._blast = Blast(self.scene, setup, world) if setup.goes_off else None
        load_sampling = "every sub-step" if self._every_substep else "last sub-step of each frame"
        if self.layout_error:
            load_sampling = READING_OF_MOTION
        elif not self.has_loads:
            load_sampling = WITHOUT_LOADS
        self._begin_frames(self.folder, load_sampling, setup.inventory, contacts=self._has_contacts)
        if self.has_loads:
            charges = [given(charge.name) for charge in setup.charges] if self._blast else []
            named = named_bearings_of(setup.connections.objects) if world else None
            self._bearings = RecordedBearings(named, setup.inventory.pairs, setup.breaking.warm_up_s) if named else None
            bearings = self._bearings.names if self._bearings else ()
            self._logs = Logs(self.folder, setup.inventory, charges, bearings, self._log_files)

    def _keep(self, frame: Frame, balls: BallHistory, contacts: ContactHistory | None = None) -> None:
        """Keep and log a frame, with its blast loads, hits of the balls and contacts."""
        _check_finite(frame)
        frame_s = frame.time_s - (self.last.time_s if self.last else 0.0)
        blast_loads = None
        if self._blast is not None and frame_s > 0.0:
            blast_loads, impulses = self._blast.after_frame(frame.positions_m)
            frame = replace(frame, blast_impulses_ns=frame.blast_impulses_ns + impulses)
        self._append(frame, balls, contacts)
        if self.loads:
            self.loads.note(frame.time_s)
        if self.pulls:
            self.pulls.note(frame.time_s)
            hide_cables(self.scene, [cable.pull.name for cable in self.pulls.cables if cable.ended])
        if self._logs:
            self._logs.write_frame(frame)
            self._write_bearings(self._logs, frame)
            if self._bars and self._reader:
                self._logs.write_bars(frame, *self._bars.note(frame, self._reader.crack_loads))
            if blast_loads is not None:
                self._logs.write_blast(frame, blast_loads, frame_s)

    def _write_bearings(self, logs: Logs, frame: Frame) -> None:
        """Log the forces of bearings, and note the largest of them."""
        loads = self._reader.bearing_loads if self._reader else None
        if self._bearings and loads:
            logs.write_bearings(frame, self._bearings.note(frame, loads))


def _check_finite(frame: Frame) -> None:
    """See that bodies are somewhere: also where loads are not read after every sub-step."""
    for quantity, values in (("position", frame.positions_m), ("velocity", frame.velocities_m_s)):
        wrong = ~np.isfinite(values).all(axis=1)
        if wrong.any():
            raise NotFiniteError(quantity, int(wrong.argmax()))


def _begin_motion(setup: RunSetup, world: BulletWorld, held: bool) -> None:
    """Give bodies the velocities with which they begin, and refuse a motion whose beginning was not followed."""
    moving = np.flatnonzero(setup.start_motion.any(axis=1))
    if len(moving) and not held:
        raise SimulationError("bodies that begin with a velocity need the timeline played from its start frame")
    if setup.ground_motion and not held:
        raise SimulationError("a ground that moves needs the timeline played from its start frame")
    velocities, angular_velocities = setup.start_motion[moving, :3], setup.start_motion[moving, 3:]
    world.bodies.set_velocities(moving, velocities, angular_velocities)


def _members_of(bodies: np.ndarray, inventory: Inventory) -> list[str]:
    """Return the names of the members of bodies (b,), or of bodies that are of none, such as the ground."""
    members, names = inventory.body_members[bodies].tolist(), inventory.body_names[bodies].tolist()
    return sorted({str(member or name) for member, name in zip(members, names, strict=True)})
