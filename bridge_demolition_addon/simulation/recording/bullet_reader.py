"""Frames read from Bullet's memory: loads of all sub-steps, motion and breaking."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import bpy
import numpy as np

from ...bullet.world import BulletWorld
from ...engineering.elasticity.crack_state import CrackAccumulator, FrameCracks
from ...engineering.mechanics.bearing_loads import BearingAccumulator, BearingLoads, BearingPads
from ...engineering.mechanics.carried_sections import MemberSections, kinds_of
from ...engineering.mechanics.frame_loads import FrameLoads
from ...engineering.mechanics.overloads import Overloads
from ...engineering.mechanics.work import FrameWork, Motion, WorkAccumulator
from ...errors import LayoutError, SimulationError
from ...model.results.frames import BallHistory, ContactHistory, Frame
from ...model.schema import given
from ...scene.connections.elasticity import named_bearings_of
from ...scene.run_setup import RunSetup
from ...scene.tools.ground_motion import rows_on_moving_ground
from .blast import Blast
from .breaking import Breaker, Breaks, CoreStep, Resistance
from .drivers import LastSubstepLoads, ThresholdScale, WarmUp
from .elastic_connections import ElasticConnections, RestingState, SupportSprings
from .events import AppliedEvent, Events
from .fall_beds import FallBeds
from .frame_sums import FrameSums
from .ground_drive import GroundDrive
from .loads import Loads
from .meter import Meter
from .motion_reader import unknown_loads
from .pulls import Pulls
from .ruptured_bars import bars_that_rupture
from .substeps import SubstepRecorder, in_order
from .tendons import Tendons
from .torques import Torques


class BulletReader:
    """Reads the frames of one simulation in a world that was bound just now, before any time passes.

    Parameters
    ----------
    every_substep
        Whether loads are read after every sub-step, or only after the last one of each frame.
    loads
        Whether loads and work are read at all.

    Attributes
    ----------
    resting_state : RestingState or None
        How the bridge deforms under its own weight; None where connections are rigid.
    have_bars : (m,) bool or None
        Connections across whose cracks bars are followed; None where they are not.
    tendons : Tendons or None
        What presses bodies together; None without tendons, or where connections are rigid.
    loads : Loads or None
        Loads that push bodies; None without any.
    pulls : Pulls or None
        Cables that pull bodies; None without any.
    rigid_because : LayoutError or None
        Why connections that should be elastic are rigid.
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
        self._scene, self._setup, self._world, self._every_substep = scene, setup, world, every_substep
        self._inventory, self._substeps_of_frame = setup.inventory, scene.rigidbody_world.substeps_per_frame
        self.rigid_because: LayoutError | None = None
        self._built_positions_m, self._built_rotations = world.bodies.positions()
        elastic = self._elastic_connections(setup) if setup.elasticity and len(setup.connections) else None
        self.resting_state = elastic.resting_state if elastic else None
        self._named_bearings = named_bearings_of(setup.connections.objects)
        self._last_loads = None if every_substep else LastSubstepLoads(world.constraints)
        self._sums: FrameSums | None = None
        self._no_loads = None if loads else unknown_loads(setup.inventory)
        self._no_work = FrameWork.unknown(len(setup.inventory.masses_kg))
        self._substeps = self._substep_recorder(elastic, blast, loads)
        self.have_bars = elastic.have_bars if elastic and loads else None
        world.call_around_substeps(
            self._substeps.before_substep, self._substeps.after_substep if every_substep else None
        )

    def _substep_recorder(
        self, elastic: ElasticConnections | None, blast: Blast | None, loads: bool
    ) -> SubstepRecorder:
        """Return the recorder that Bullet calls, with all drivers in order."""
        setup, world, inventory = self._setup, self._world, self._inventory
        breaking, constraints = setup.breaking, world.constraints
        self.tendons = tendons = _tendons_of(setup, world, elastic)
        self.loads = loads_of_run = Loads(world.bodies, setup.placed_loads) if setup.loads else None
        self.pulls = pulls = Pulls(world.bodies, setup.placed_pulls, inventory.masses_kg) if setup.pulls else None
        self._events = events = Events(
            world,
            inventory.pairs,
            inventory.masses_kg,
            setup.events,
            elastic,
            tendons,
            _lifting_off(setup, self.resting_state),
        )
        if setup.elasticity is None and breaking.ductility and np.any(breaking.ductility.strength_share):
            raise SimulationError(
                "the connections of this scene are rigid and have bars by ductile_share: expected elastic ones, as "
                "bars between rigid bodies would make energy; build the scene again from its scenario"
            )
        holding = elastic if breaking.is_reinforced else None
        if holding:
            holding.reinforce(breaking, events.remaining_bars)
        warm_up = WarmUp(world, self._free_shards(), breaking, release=elastic is None)
        meter = Meter(world, inventory, elastic)
        overloads = self._overloads(elastic, events.compression_factors)
        ruptured = bars_that_rupture(breaking.bars, inventory, world.bodies.motion())
        resistance = Resistance(overloads, events.remaining_strength, elastic, holding, ruptured)
        breaker = Breaker(constraints, meter, resistance, warm_up)
        torques = Torques(np.array(setup.bodies.rigid["angular_damping"]))
        core = CoreStep(world, elastic, breaker, meter, torques)
        drivers = in_order(
            (
                self._last_loads,
                warm_up,
                self._ground_drive(),
                events,
                ThresholdScale(constraints, setup.time.step.substep_s),
                blast,
                loads_of_run,
                pulls,
                self._fall_beds(),
                tendons,
                core,
            )
        )
        if loads:
            bearings = BearingAccumulator(pads) if (pads := self._bearing_pads()) else None
            have_bars = elastic.have_bars if elastic else None
            cracks = None if have_bars is None else CrackAccumulator(have_bars)
            self._sums = FrameSums(meter, inventory, self._work(), bearings, cracks, every_substep=self._every_substep)
        elif not breaker.uses_strength:
            constraints.write_loads(wanted=False)  # nothing reads them
        return SubstepRecorder(constraints, drivers, core, breaker, warm_up, self._sums)

    def before_frame(self, substeps: int) -> None:
        """Set how many sub-steps the coming frame has."""
        self._substeps_of_frame = substeps
        if self._last_loads:
            self._last_loads.before_frame(substeps)

    def close(self) -> None:
        """Read nothing any more, once the thread has ended."""
        if self._sums:
            self._sums.close()

    def _fall_beds(self) -> FallBeds | None:
        beds, gravity_m_s2 = self._setup.fall_beds, float(-self._setup.gravity_m_s2[2])
        return FallBeds(self._world.bodies, beds, self._inventory, gravity_m_s2) if beds else None

    def _free_shards(self) -> np.ndarray:
        """Shards (s,) that can move."""
        return np.flatnonzero((self._inventory.body_kinds == "shard") & self._inventory.moves)

    def _elastic_connections(self, setup: RunSetup) -> ElasticConnections | None:
        """Return the connections; None if they cannot be elastic, as Bullet's memory is not as expected."""
        bodies, elasticity = setup.bodies.objects, given(setup.elasticity)
        stiffness, ratio = elasticity.stiffness, elasticity.damping_ratio
        try:
            springs = SupportSprings(setup.soil, setup.bearings.springs if setup.bearings else None, setup.tendons)
            return ElasticConnections(self._scene, self._world, self._inventory, bodies, stiffness, ratio, springs)
        except LayoutError as error:
            self.rigid_because = error
            return None

    def _ground_drive(self) -> GroundDrive | None:
        """Return the driver of the ground, None where it rests."""
        setup = self._setup
        if setup.ground_motion is None:
            return None
        rows = rows_on_moving_ground(setup.bodies.objects)
        return GroundDrive(self._world.bodies, rows, self._free_shards(), setup.ground_motion)

    def _overloads(self, elastic: ElasticConnections | None, pressed: np.ndarray | None) -> Overloads | None:
        """Return the criterion of strength; elastic connections are judged by whole sections of built members.

        Events keep up to date by how much more strength each connection (m,) has left in compression.
        """
        strength, inventory, sections = self._setup.breaking.strength, self._inventory, None
        if not strength:
            return None
        if elastic:
            kinds = kinds_of(inventory.body_members[inventory.pairs])
            thicknesses_m = given(self._setup.elasticity).thicknesses_m
            sections = MemberSections(inventory.faces, self._built_positions_m, inventory.moves, kinds, thicknesses_m)
        tendons, friction = self._setup.tendons, None
        if tendons and elastic:
            friction = tendons.friction(inventory.body_members[inventory.pairs])
        return Overloads(inventory.faces, inventory.moves, strength, sections, pressed, friction)

    def _bearing_pads(self) -> BearingPads | None:
        """Return the connections at pads of bearings; None without any."""
        named, inventory, elastic = self._named_bearings, self._inventory, self._setup.bearings
        if named is None:
            return None
        sideways_n_m = np.full((len(inventory.pairs), 2), np.inf)
        if elastic and self.resting_state:
            sideways_n_m[elastic.springs.rows] = elastic.springs.sideways_of_connections()
        return BearingPads.as_built(
            named.rows,
            named.bearings,
            inventory.pairs[named.rows],
            inventory.points_m[named.rows],
            inventory.areas_m2[named.rows],
            sideways_n_m[named.rows],
            _lifting_off(self._setup, self.resting_state)[named.rows],
            self._built_positions_m,
            self._built_rotations,
        )

    def _work(self) -> WorkAccumulator:
        """Return the sum of work in each frame, which begins with the present motion."""
        bodies, rigid = self._world.bodies, self._setup.bodies.rigid
        return WorkAccumulator(
            self._inventory.masses_kg,
            np.array(rigid["linear_damping"]),
            np.array(rigid["angular_damping"]),
            self._setup.gravity_m_s2,
            Motion(bodies.positions()[0][None], bodies.velocities()[None], bodies.angular_velocities()[None]),
        )

    @property
    def applied_events(self) -> Sequence[AppliedEvent]:
        """Removals, saw cuts and weakenings so far."""
        return self._events.applied

    @property
    def bearing_loads(self) -> BearingLoads | None:
        """Forces of bearings in the frame that was read last; None where they are not known."""
        return self._sums.bearing_loads if self._sums else None

    @property
    def crack_loads(self) -> FrameCracks:
        """What bars across cracks did in the frame that was read last; of no crack where it is not known."""
        return self._sums.crack_loads if self._sums else FrameCracks.none()

    def take_ball_history(self) -> BallHistory:
        """Return the hits of the balls since the last call."""
        return self._sums.take_ball_history() if self._sums else BallHistory.unknown()

    def take_contacts(self, frame: int) -> ContactHistory:
        """Return the contacts in the last sub-step of a frame."""
        contacts = self._sums.take_last_contacts() if self._sums else None
        if contacts is None:
            return ContactHistory.none()
        impulses = contacts.normal_impulses_ns, contacts.tangential_impulses_ns
        frames = np.full(len(contacts), frame)
        return ContactHistory(frames, contacts.pairs, contacts.positions_m, contacts.normals, *impulses)

    @property
    def seconds(self) -> float:
        """Wall time that reading has taken so far."""
        return self._substeps.seconds

    @property
    def elapsed_s(self) -> float:
        """Simulated time before the sub-step of now."""
        return self._substeps.elapsed_s

    def read_first_frame(self, substep_s: float) -> Frame:
        """Return the first frame: no time has passed in it, or its loads are unknown.

        Where connections are elastic, and have put the bodies at rest, it shows them as they were built.
        """
        self._substeps.skip(substep_s * self._scene.rigidbody_world.substeps_per_frame)
        loads, work, _ = self._finish_frame()
        if substep_s > 0.0:
            loads, work = loads.unknown(), self._no_work
        frame = self._frame(substep_s, loads, work)
        if self.resting_state is None or substep_s > 0.0:
            return frame
        return replace(frame, positions_m=self._built_positions_m, rotations=self._built_rotations)

    def read_frame(self, substep_s: float) -> tuple[Frame, list[Breaks]]:
        """Return the frame whose sub-steps have this length, without blast, and the breaks in it."""
        if not self._every_substep:
            self._substeps.after_substep(substep_s)
            self._substeps.skip(substep_s * (self._substeps_of_frame - 1))
        if self._substeps.error:
            raise self._substeps.error
        loads, work, breaks = self._finish_frame()
        if not self._every_substep:
            work = self._no_work
        return self._frame(substep_s, loads, work), breaks

    def _finish_frame(self) -> tuple[FrameLoads, FrameWork, list[Breaks]]:
        """Return loads and work of the frame, unknown where loads are not read, and the breaks in it."""
        if self._sums:
            return self._sums.finish_frame()
        return given(self._no_loads), self._no_work, []

    def _frame(self, substep_s: float, loads: FrameLoads, work: FrameWork) -> Frame:
        bodies = self._world.bodies
        positions_m, rotations = bodies.positions()
        return Frame(
            number=self._scene.frame_current,
            time_s=self._substeps.elapsed_s,
            substep_s=substep_s,
            positions_m=positions_m,
            rotations=rotations,
            velocities_m_s=bodies.velocities(),
            angular_velocities_rad_s=bodies.angular_velocities(),
            asleep=bodies.asleep(),
            intact=self._world.constraints.intact(),
            blast_impulses_ns=self._events.take_impulses_ns(),
            loads=loads,
            work=work,
        )


def _tendons_of(setup: RunSetup, world: BulletWorld, elastic: ElasticConnections | None) -> Tendons | None:
    """Return the tendons; None without any, and where connections are rigid."""
    if setup.tendons is None or elastic is None or elastic.tendons is None:
        return None
    return Tendons(world.bodies, setup.tendons, elastic.tendons)


def _lifting_off(setup: RunSetup, resting_state: RestingState | None) -> np.ndarray:
    """Return which connections (m,) are bearings that hold nothing that is lifted: none where all are rigid."""
    lifts_off = np.zeros(len(setup.inventory.pairs), bool)
    if setup.bearings and resting_state:
        lifts_off[setup.bearings.springs.rows] = ~setup.bearings.springs.pulls
    return lifts_off
