"""Frames read from Bullet's memory: loads of all sub-steps, motion and breaking."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import bpy
import numpy as np

from ...bullet.bodies import BodyTable
from ...bullet.world import BulletWorld
from ...engineering.mechanics.frame_loads import FrameLoads
from ...engineering.mechanics.member_sections import MemberSections, kinds_of
from ...engineering.mechanics.work import FrameWork, Motion, WorkAccumulator
from ...errors import LayoutError
from ...model.results.frames import BallHistory, ContactHistory, Frame
from ...scene.run_setup import RunSetup
from ...scene.tools.ground_motion import rows_on_moving_ground
from .blast import Blast
from .elastic_connections import ElasticConnections
from .events import AppliedEvent, Events
from .ground_drive import GroundDrive
from .loads import Loads
from .substeps import Breaks, SubstepRecorder


class BulletReader:
    """Reads the frames of one simulation.

    Parameters
    ----------
    scene : bpy.types.Scene
    setup : RunSetup
        All that decides the run.
    world : BulletWorld
        Its world, bound just now, before any time passes.
    blast : Blast or None
        What explodes.
    every_substep : bool
        Whether loads are read after every sub-step, or only after the last one of each frame.
    loads : bool
        Whether loads and work are read at all.

    Attributes
    ----------
    elasticity : Elasticity or None
        How the bridge gives way; None where connections are rigid.
    rigid_because : LayoutError or None
        Why connections that are meant to be elastic are rigid.
    """

    def __init__(
        self,
        scene: bpy.types.Scene,
        setup: RunSetup,
        world: BulletWorld,
        blast: Blast | None,
        *,
        every_substep: bool,
        loads: bool,
    ):
        self._scene, self._world, self._every_substep = scene, world, every_substep
        inventory, breaking = setup.inventory, setup.breaking
        self._inventory, self._substeps_of_frame = inventory, scene.rigidbody_world.substeps_per_frame
        self.rigid_because: LayoutError | None = None
        self._built_positions_m, self._built_rotations = world.bodies.positions()
        elastic = self._elastic_connections(setup) if setup.elasticity and len(setup.connections) else None
        self.elasticity = elastic.elasticity if elastic else None
        self._events = Events(world, inventory.pairs, setup.events)
        work = WorkAccumulator(
            inventory.masses_kg,
            np.array(setup.bodies.rigid["linear_damping"]),
            np.array(setup.bodies.rigid["angular_damping"]),
            setup.gravity_m_s2,
            _motion(world.bodies),
        )
        self._substeps = SubstepRecorder(
            world,
            inventory,
            breaking,
            self._events,
            blast,
            Loads(world, setup.placed_loads),
            setup.time.step.substep_s,
            work,
            elastic,
            self._member_sections(setup.elasticity.thicknesses_m) if elastic and breaking.strength else None,
            self._ground_drive(setup),
            every_substep=every_substep,
            loads=loads,
        )
        world.call_around_substeps(
            self._substeps.before_substep, self._substeps.after_substep if every_substep else None
        )

    def before_frame(self, substeps: int) -> None:
        """Know how many sub-steps the coming frame has."""
        self._substeps_of_frame = substeps
        self._substeps.before_frame(substeps)

    def close(self) -> None:
        """Read nothing any more; what is still worked out is waited for."""
        self._substeps.close()

    def _elastic_connections(self, setup: RunSetup) -> ElasticConnections | None:
        """Return the connections, None where Bullet's memory does not let them be elastic."""
        bodies, soil = setup.bodies.objects, setup.soil
        stiffness, ratio = setup.elasticity.stiffness, setup.elasticity.damping_ratio
        try:
            return ElasticConnections(self._scene, self._world, self._inventory, bodies, stiffness, ratio, soil)
        except LayoutError as error:
            self.rigid_because = error
            return None

    def _ground_drive(self, setup: RunSetup) -> GroundDrive | None:
        """Return what moves the ground, None where it rests."""
        if setup.ground_motion is None:
            return None
        moves = (self._inventory.body_kinds == "shard") & (self._inventory.masses_kg > 0.0)
        rows = rows_on_moving_ground(setup.bodies.objects)
        return GroundDrive(self._world, rows, np.flatnonzero(moves), setup.ground_motion)

    def _member_sections(self, thicknesses_m: np.ndarray) -> MemberSections:
        """Return the sections across members, as they were built, that connections are judged by."""
        inventory = self._inventory
        return MemberSections(
            inventory.faces,
            self._built_positions_m,
            inventory.moves,
            kinds_of(inventory.body_members[inventory.pairs]),
            thicknesses_m,
        )

    @property
    def applied_events(self) -> Sequence[AppliedEvent]:
        """Removals, saw cuts and weakenings so far."""
        return self._events.applied

    def take_ball_history(self) -> BallHistory:
        """Return what hit the balls since this was asked last."""
        return self._substeps.take_ball_history()

    def take_contacts(self, frame: int) -> ContactHistory:
        """Return the contacts in the last sub-step since this was asked last, which is that of a frame."""
        contacts = self._substeps.take_last_contacts()
        if contacts is None:
            return ContactHistory.none()
        return ContactHistory(
            np.full(len(contacts), frame),
            contacts.pairs,
            contacts.places_m,
            contacts.normals,
            contacts.normal_impulses_ns,
            contacts.tangential_impulses_ns,
        )

    @property
    def seconds(self) -> float:
        """Wall time that reading has taken so far."""
        return self._substeps.seconds

    def read_first_frame(self, substep_s: float) -> Frame:
        """Return a frame in which no time passed, or else one whose loads were not asked for in time.

        Where connections are elastic, and have put the bodies where they rest, it shows them as they were built.
        """
        self._substeps.skip(substep_s * self._scene.rigidbody_world.substeps_per_frame)
        loads, work, _ = self._substeps.finish_frame()
        if substep_s > 0.0:
            loads, work = loads.unknown(), FrameWork.unknown(len(self._inventory.masses_kg))
        frame = self._frame(substep_s, loads, work)
        if self.elasticity is None or substep_s > 0.0:
            return frame
        return replace(frame, positions_m=self._built_positions_m, rotations=self._built_rotations)

    def read_frame(self, substep_s: float) -> tuple[Frame, list[Breaks]]:
        """Return the frame whose sub-steps have this length, without blast, and what broke in it."""
        if not self._every_substep:
            self._substeps.after_substep(substep_s)
            self._substeps.skip(substep_s * (self._substeps_of_frame - 1))
        if self._substeps.error:
            raise self._substeps.error
        loads, work, breaks = self._substeps.finish_frame()
        if not self._every_substep:
            work = FrameWork.unknown(len(self._inventory.masses_kg))
        return self._frame(substep_s, loads, work), breaks

    def _frame(self, substep_s: float, loads: FrameLoads, work: FrameWork) -> Frame:
        positions, rotations = self._world.bodies.positions()
        return Frame(
            number=self._scene.frame_current,
            time_s=self._substeps.elapsed_s,
            substep_s=substep_s,
            positions_m=positions,
            rotations=rotations,
            velocities_m_s=self._world.bodies.velocities(),
            angular_velocities_rad_s=self._world.bodies.angular_velocities(),
            asleep=self._world.bodies.asleep(),
            intact=self._world.constraints.intact(),
            blast_impulses_ns=np.zeros_like(positions),
            loads=loads,
            work=work,
        )


def _motion(bodies: BodyTable) -> Motion:
    """How bodies move now, as of one sub-step."""
    return Motion(bodies.positions()[0][None], bodies.velocities()[None], bodies.angular_velocities()[None])
