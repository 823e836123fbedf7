"""Recording a simulation while Blender's timeline runs: loads, motion and breaking, frame by frame."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import astuple, fields, replace
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from ...bullet.time_control import release_time, set_substeps, set_time_scale, time_stands_still
from ...bullet.world import BulletWorld, WorldState
from ...engineering.geometry.vectors import dot
from ...errors import LayoutError, OutputError, SimulationError
from ...model.results.arrays import Results
from ...model.results.fingerprint import built_digest
from ...model.results.frames import BallHistory, ContactHistory, Frame
from ...model.results.inventory import Inventory
from ...model.results.stream import FrameStream
from ...scene.bodies import bodies_of
from ...scene.connections.breaking_settings import breaking_of
from ...scene.connections.breaking_thresholds import rewrite_thresholds
from ...scene.connections.constraints import connections_of
from ...scene.connections.elasticity import damping_ratio_of, is_elastic, stiffness_of, thicknesses_of
from ...scene.connections.soil import soil_of
from ...scene.inventory import take_inventory
from ...scene.start_motion import start_motion_of
from ...scene.structural_changes import changes_of, loads_of, placed_loads_of
from ...scene.time_scale import time_is_animated, time_step_at
from ...scene.tools.ball import lift_from, lifts_of
from ...scene.tools.ground_motion import ground_motion_of
from ...scene.world import farthest_per_substep_of
from .blast import Blast, check_blast, goes_off
from .bullet_reader import BulletReader
from .elastic_connections import Elasticity
from .logs import LogFiles, Logs
from .motion_reader import READING as READING_OF_MOTION
from .motion_reader import MomentumReader
from .recordable import check_recordable

WITHOUT_LOADS = "motion and breaking, without loads"


class Recording:
    """Records one scene from its start frame on; a simulation that starts again is recorded from its beginning.

    Parameters
    ----------
    scene : bpy.types.Scene
        Scene with a rigid-body world.
    folder : Path
        Folder for the frames and the logs, which has to exist once it is recorded.
    every_substep : bool
        Whether loads are read after every sub-step, or only after the last one of each frame.
    log_files : LogFiles or None
        Logs that do not go to the folder; all do by default.
    loads : bool
        Whether loads and work are recorded and logs written. Without them a run takes less time and comes to the same:
        motion and breaking have the same bits.
    contacts : bool
        Whether the contacts of the last sub-step of each frame are kept, where loads are.

    Raises
    ------
    BlastError, SimulationError
        The scene, a charge or the force objects are not as they should be.

    Attributes
    ----------
    scene, folder
        As given.
    scene_uid : int
        Number of the scene as long as Blender runs, also when the scene is gone.
    error : Exception or None
        Why the recording ended before its time.
    distrust : LayoutError or None
        Why Bullet's memory is not read. Then only the motion of bodies is recorded, and the net force on each
        from its change of momentum.
    has_loads : bool
        Whether loads are recorded, as given.
    world : BulletWorld
        The world that is recorded.
    inventory : Inventory or None
        The bodies and connections; None before the first frame.
    substeps : int
        Sub-steps of the frame played last.
    built_digest : str
        Digest of what was built; empty before the first frame.
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
        check_recordable(scene)
        rewrite_thresholds(scene)  # the step may have changed since the scene was built
        self.scene = scene
        self.scene_uid = scene.session_uid
        self.folder = folder
        self.error: Exception | None = None
        self.distrust: LayoutError | None = None
        self._every_substep = every_substep
        self._log_files, self.has_loads = log_files or LogFiles(), loads
        self._has_contacts = contacts and loads
        self._seconds = 0.0
        self._bodies, self._connections = bodies_of(scene), connections_of(scene)
        check_blast(scene, self._bodies)
        self._lifted = [body for body in self._bodies if lifts_of(body)]
        self.world = BulletWorld(scene, self._bodies, self._connections)
        self.inventory: Inventory | None = None
        self._reader: BulletReader | None = None
        self._momentum: MomentumReader | None = None
        self._logs: Logs | None = None
        self._blast: Blast | None = None
        self._stream: FrameStream | None = None
        self._last: Frame | None = None
        self._has_set_substeps = False
        self.substeps = 0
        self.built_digest = ""

    def before_frame(self) -> None:
        """Set how much time passes in the coming frame, and what explodes in it.

        Raises
        ------
        SimulationError
            Time is animated and cannot be set.
        """
        self._set_time()
        self._prepare_blast()
        self.substeps = self._set_substeps()
        if self._reader:
            self._reader.before_frame(self.substeps)

    def after_frame(self, depsgraph: bpy.types.Depsgraph) -> None:
        """Record the frame.

        Raises
        ------
        LayoutError, SimulationError
            The world cannot be read any more.
        """
        began = time.perf_counter()
        try:
            if not self.distrust:
                self._follow_bullet(depsgraph)
            if self.distrust:
                self._follow_motion(depsgraph)
            self._lift_balls(depsgraph)
        finally:
            self._seconds += time.perf_counter() - began

    def fail(self, error: Exception) -> None:
        """End the recording for a reason."""
        self.error = error
        self.close()

    def close(self) -> None:
        """Take everything of ours out of Blender's world and close the logs. What was recorded stays."""
        if self._blast:
            self._blast.rest()
        self.world.release()
        if self._reader:
            self._reader.close()
        logs, self._logs = self._logs, None
        if logs:
            try:
                logs.close(self._last)
            except OutputError as error:
                self.error = self.error or error  # a full disk, which may be what the recording ended for

    @property
    def frames(self) -> Sequence[Frame]:
        """Frames recorded so far, as they are kept: each is read from the disk when it is asked for."""
        return () if self._stream is None else self._stream

    @property
    def recorded_frames(self) -> int:
        """Frames recorded so far."""
        return len(self.frames)

    @property
    def last(self) -> Frame | None:
        """The last frame recorded; None before the first."""
        return self._last

    @property
    def last_frame(self) -> int | None:
        """Number of the last frame recorded; None before the first."""
        return self._last.number if self._last else None

    def has_frame(self, frame: int) -> bool:
        """Whether a frame was recorded, or lies before those that are."""
        return frame <= (self._last.number if self._last else self._start_frame)

    def motion(self) -> tuple[float, np.ndarray, np.ndarray, np.ndarray]:
        """Time in s of the last frame, and positions (n, 3), rotations (n, 3, 3) and sleep (n,) of its bodies.

        They are those that are kept, so that whoever reads the results finds the same rest.
        """
        last = self.frames[-1]
        return last.time_s, last.positions_m, last.rotations, last.asleep

    @property
    def broken(self) -> int:
        """Connections broken by now."""
        return int((~self._last.intact).sum()) if self._last else 0

    @property
    def lost_blast_loads(self) -> int:
        """How often a body has left the reach of its force field within a frame, and lost a part of its load."""
        return self._blast.left if self._blast else 0

    @property
    def applied_events(self) -> list[dict[str, Any]]:
        """Removals, saw cuts and weakenings so far, ready for JSON: shards removed, connections concerned."""
        names = self.inventory.body_names if self.inventory else ()
        return [
            {
                "time_s": each.time_s,
                "kind": each.kind,
                "shards": [str(names[body]) for body in each.bodies],
                "connections": len(each.connections),
            }
            for each in (self._reader.applied_events if self._reader else ())
        ]

    @property
    def elasticity(self) -> Elasticity | None:
        """How the bridge gives way under its own weight; None where its connections are rigid."""
        return self._reader.elasticity if self._reader else None

    @property
    def rigid_because(self) -> LayoutError | None:
        """Why connections that are meant to be elastic are rigid."""
        if self.distrust and is_elastic(self.scene):
            return self.distrust
        return self._reader.rigid_because if self._reader else None

    @property
    def seconds(self) -> float:
        """Wall time that recording has taken so far."""
        # Read once a frame, the sub-step is read within the frame's own time.
        return self._seconds + (self.reading_seconds if self._every_substep else 0.0)

    @property
    def reading_seconds(self) -> float:
        """The part of it in Bullet's sub-steps: copying what it holds, and judging it where strength breaks."""
        return self._reader.seconds if self._reader else 0.0

    def results(self) -> Results:
        """Everything recorded, mapped from the disk: only what is looked at is read.

        Raises
        ------
        SimulationError
            Nothing was recorded.
        """
        if not self.recorded_frames:
            raise SimulationError("nothing was recorded: play the timeline from its start frame")
        return self._stream.results()

    def remove_stream(self) -> None:
        """Take away the files with the frames, as the results are kept by now.

        What was recorded can be read as before, as long as the recording is there.
        """
        self._stream.remove()

    def forget(self) -> None:
        """Let go of all that was recorded, and of its files, of which Windows replaces none that is open."""
        self._last = None
        if self._stream is not None:
            self._stream.discard()
            self._stream = None

    @property
    def _start_frame(self) -> int:
        return self.scene.rigidbody_world.point_cache.frame_start

    @property
    def _load_sampling(self) -> str:
        if self.distrust:
            return READING_OF_MOTION
        if not self.has_loads:
            return WITHOUT_LOADS
        return "every sub-step" if self._every_substep else "last sub-step of each frame"

    def _follow_bullet(self, depsgraph: bpy.types.Depsgraph) -> None:
        """Record the frame from Bullet's memory, or note why that cannot be trusted."""
        try:
            if self.scene.frame_current > self._start_frame:
                self._record(self.world.bind(depsgraph), time_stands_still(depsgraph))
        except LayoutError as error:
            if self._last:  # it was trusted, and parts of it are recorded
                raise
            self.distrust = error
        finally:
            release_time(self.scene)
            if self._has_set_substeps:
                set_substeps(self.scene, self.scene.rigidbody_world.substeps_per_frame)
                self._has_set_substeps = False

    def _follow_motion(self, depsgraph: bpy.types.Depsgraph) -> None:
        """Record the frame from where the bodies are."""
        frame = self.scene.frame_current
        if frame == self._start_frame or not self._momentum:
            self._begin_with_motion()
        elif frame != self._last.number + 1:
            return  # not a step forward in time, but a frame that was recorded already or will be
        self._keep(self._momentum.read_frame(depsgraph), BallHistory.unknown())

    def _begin_with_motion(self) -> None:
        if self._start_motion():
            raise SimulationError(
                "velocities and spins to begin with need Blender's memory, which is not as expected "
                f"({self.distrust}): take them out of the scenario, or run it in another Blender"
            )
        if loads_of(self.scene):
            raise SimulationError(
                f"loads need Blender's memory, which is not as expected ({self.distrust}): take them out of the "
                "scenario, or run it in another Blender"
            )
        if ground_motion_of(self.scene):
            raise SimulationError(
                "a ground that moves needs Blender's memory, which is not as expected "
                f"({self.distrust}): take ground_motion out of the scenario, or run it in another Blender"
            )
        if changes_of(self.scene):
            raise SimulationError(
                "removals, saw cuts and weakenings need Blender's memory, which is not as expected "
                f"({self.distrust}): take them out of the scenario, or run it in another Blender"
            )
        if self._has_contacts:
            raise SimulationError(
                f"contacts need Blender's memory, which is not as expected ({self.distrust}): switch "
                "recording.contacts off in the scenario, or run it in another Blender"
            )
        self.inventory = take_inventory(self._bodies, ())
        self._momentum = MomentumReader(self.scene, self._bodies, self.inventory)
        self._begin_blast(None)

    def _begin_blast(self, world: BulletWorld | None) -> None:
        """Set up what explodes, the frames, and the logs of all."""
        if self._blast:
            self._blast.rest()
        self.forget()
        self._blast = Blast(self.scene, self._bodies, self.inventory, world) if goes_off(self.scene) else None
        self.built_digest = self._digest()
        self._stream = FrameStream(self.folder, self._load_sampling, self.inventory, contacts=self._has_contacts)
        if self.has_loads:
            charges = [charge.name for charge in self._blast.charges] if self._blast else ()
            self._logs = Logs(self.folder, self.inventory, charges, self._log_files)

    def _digest(self) -> str:
        """Digest of all that decides what will happen: bodies, connections, what breaks them, and loads."""
        breaking = breaking_of(self.scene, self._connections)
        strength, ductility = (astuple(each) if each else () for each in (breaking.strength, breaking.ductility))
        thresholds = [each.rigid_body_constraint.breaking_threshold for each in self._connections]
        step, farthest_m = time_step_at(self.scene, self._start_frame), farthest_per_substep_of(self.scene)
        elastic = {}
        if is_elastic(self.scene):
            stiffness = stiffness_of(self._connections)
            elastic = {each.name: getattr(stiffness, each.name) for each in fields(stiffness)}
            elastic["damping_ratio"] = damping_ratio_of(self.scene)
            elastic["thicknesses_m"] = thicknesses_of(self._connections)
            if soil := soil_of(self._connections):
                elastic |= {f"soil {each.name}": getattr(soil, each.name) for each in fields(soil)}
            if breaking.ductility:
                elastic["steel"] = np.array(astuple(breaking.steel))
        if breaking.bars:
            elastic["bars"] = np.column_stack((breaking.bars.yield_n, breaking.bars.offsets_m))
        matrices = np.array([body.matrix_world for body in self._bodies], float)
        places, rotations = matrices[:, :3, 3], matrices[:, :3, :3]
        return built_digest(
            self.inventory,
            positions_m=places,
            rotations=rotations,
            thresholds_ns=thresholds,
            breaks=[each.rigid_body_constraint.use_breaking for each in self._connections],
            strength_pa=np.array(strength, float),
            ductility=np.array(ductility, float),
            blast_impulses_ns=self._blast.whole_impulses(places, rotations) if self._blast else np.zeros(0),
            **self._start_motion(),
            **self._loads(),
            **self._ground_motion(),
            step=[step.frame_s, step.substep_s, *([] if farthest_m is None else [farthest_m])],
            **elastic,
        )

    def _start_motion(self) -> dict[str, np.ndarray]:
        """Velocities and spins with which bodies begin, where any does."""
        motion = np.column_stack(start_motion_of(self._bodies))
        return {"start_motion": motion} if motion.any() else {}

    def _loads(self) -> dict[str, np.ndarray]:
        """Loads that grow with time, and what bears them."""
        parts = {}
        for number, each in enumerate(placed_loads_of(self.scene, self._bodies, self.inventory)):
            load = each.load
            course = np.array((*load.direction, *load.times_s, *load.forces_n, *(load.point_m or ())))
            parts |= {f"load {number}": course, f"load {number} bears": np.stack((each.bodies, each.shares))}
        return parts

    def _ground_motion(self) -> dict[str, np.ndarray]:
        """How the ground moves, where it does."""
        motion = ground_motion_of(self.scene)
        if motion is None:
            return {}
        times = motion.start_s + motion.record.times_s
        return {"ground_motion": np.column_stack((times, motion.record.accelerations_m_s2))}

    def _set_time(self) -> None:
        """Hold time in the frame in which Blender makes its world, and have it go as it is animated in all others."""
        coming, animated = self.scene.frame_current, time_is_animated(self.scene)
        world_is_made = coming == self._start_frame + 1 and not self.distrust
        if not world_is_made and not animated:
            return
        try:
            set_time_scale(self.scene, 0.0 if world_is_made else time_step_at(self.scene, coming).time_scale)
        except LayoutError as error:
            if animated:
                raise SimulationError(f"an animated time scale cannot be followed, as {error}: remove it") from error
            self.distrust = error

    def _set_substeps(self) -> int:
        """Give the coming frame as many sub-steps as its bodies are fast, where the scene says so; return how many."""
        coming, farthest_m = self.scene.frame_current, farthest_per_substep_of(self.scene)
        step = time_step_at(self.scene, coming)
        if farthest_m is None or self._last is None or coming != self._last.number + 1 or self.distrust:
            return step.substeps_per_frame
        velocities = self._last.velocities_m_s
        speed_m_s = float(np.sqrt(dot(velocities, velocities).max()))
        gravity = np.array(self.scene.gravity, float) if self.scene.use_gravity else np.zeros(3)
        substeps = step.substeps_within(farthest_m, speed_m_s, float(np.sqrt(dot(gravity, gravity))))
        set_substeps(self.scene, substeps)
        self._has_set_substeps = True
        return substeps

    def _prepare_blast(self) -> None:
        """Load the coming frame, if it follows on the last one recorded."""
        if not self._blast:
            return
        last, coming = self._last, self.scene.frame_current
        if last is None or coming != last.number + 1:
            self._blast.rest()
            return
        frame_s = time_step_at(self.scene, coming).frame_s
        self._blast.before_frame(last.time_s, frame_s, last.positions_m, last.rotations)

    def _lift_balls(self, depsgraph: bpy.types.Depsgraph) -> None:
        """Have a ball that is lifted from the next frame on go up from where it is."""
        for ball in self._lifted:
            for lift_frame, shares, end in lifts_of(ball):
                if self.scene.frame_current == lift_frame - 1:
                    lift_from(ball, lift_frame, shares, end, ball.evaluated_get(depsgraph).matrix_world)

    def _record(self, state: WorldState, held: bool) -> None:
        if state is WorldState.ABSENT:
            return
        substep = self.world.take_substep()
        if state is WorldState.NEW:
            self._begin(held)
            # The solver of a new world names a default step before it has taken any.
            self._keep(self._reader.read_first_frame(0.0 if held else substep), BallHistory.unknown())
        elif substep > 0.0:
            frame, breaks = self._reader.read_frame(substep)
            contacts = self._reader.take_contacts(frame.number) if self._has_contacts else None
            self._keep(frame, self._reader.take_ball_history(), contacts)
            if self._logs:
                self._logs.write_breaks(frame.number, breaks)
        # Without a step Blender played the frame back from its cache, and Bullet stands where it stood.

    def _begin(self, held: bool) -> None:
        """Begin with the first frame of a new world, in which time was held or not."""
        if self._reader:  # of an earlier world
            self._reader.close()
        self._set_moving(held)
        if ground_motion_of(self.scene) and not held:
            raise SimulationError("a ground that moves needs the timeline played from its start frame")
        self.inventory = take_inventory(self._bodies, self._connections)
        self._begin_blast(self.world)
        self._reader = BulletReader(
            self.scene,
            self._bodies,
            self._connections,
            self.world,
            self.inventory,
            self._blast,
            every_substep=self._every_substep,
            loads=self.has_loads,
        )

    def _set_moving(self, held: bool) -> None:
        """Give bodies the velocities and spins with which they begin."""
        velocities, spins = start_motion_of(self._bodies)
        moving = np.flatnonzero(velocities.any(axis=1) | spins.any(axis=1))
        if len(moving) and not held:
            raise SimulationError("bodies that begin with a velocity need the timeline played from its start frame")
        self.world.bodies.set_velocities(moving, velocities[moving], spins[moving])

    def _keep(self, frame: Frame, balls: BallHistory, contacts: ContactHistory | None = None) -> None:
        """Keep and log a frame, with what exploded, what hit the balls and what touched in it."""
        frame_s = frame.time_s - (self._last.time_s if self._last else 0.0)
        exploded = self._blast is not None and frame_s > 0.0
        if exploded:
            blast_loads, impulses = self._blast.after_frame(frame.positions_m)
            frame = replace(frame, blast_impulses_ns=impulses)
        self._stream.append(frame, balls, contacts)
        self._last = frame
        if self._logs:
            self._logs.write_frame(frame)
            if exploded:
                self._logs.write_blast(frame, blast_loads, frame_s)
