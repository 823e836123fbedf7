"""What is recorded after every sub-step: loads, breaking, and the hits of the ball.

While Bullet waits, no more is done than copying what it holds and breaking what is overloaded. The loads of many
sub-steps are then worked out at once, which takes a fraction of the time: all those of a frame, or as many as fit into
`_BATCH_BYTES`. In larger models that is done beside Bullet, in a thread of its own. Where loads are not wanted, nothing
is copied that does not decide what breaks.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ...bullet.contacts import Contacts
from ...bullet.snapshots import BodyHistory, Snapshot
from ...bullet.world import BulletWorld
from ...engineering.arithmetic import power
from ...engineering.mechanics.frame_loads import FrameLoads, LoadAccumulator, Moment, SubstepLoads
from ...engineering.mechanics.member_sections import MemberSections
from ...engineering.mechanics.overloads import ConnectionLoads, Overloads
from ...engineering.mechanics.section_forces import SectionForces
from ...engineering.mechanics.work import FrameWork, Motion, PairImpulses, WorkAccumulator
from ...errors import SimulationError
from ...model.results.frames import BallHistory
from ...model.results.inventory import Inventory
from ...scene.connections.breaking_settings import Breaking
from .background import BackgroundWork
from .blast import Blast
from .elastic_connections import ElasticConnections
from .events import Events
from .ground_drive import GroundDrive
from .load_reader import LoadReader
from .loads import Loads
from .reinforcement import Reinforcement

_SINGLE_PRECISION = 1e-6

_MOST_ROUNDS = 20
"""How often connections break one after another in one sub-step, before the rest waits for the next."""

_BATCH_BYTES = 1_000_000
"""Copies of sub-steps that are kept until they are worked out; fewer take longer each, more leave more to wait for at
the end of a frame."""

_WORTH_HANDING_OVER_BYTES = 200_000
"""Copies of fewer bytes are worked out sooner than they are handed over."""


@dataclass(frozen=True, slots=True)
class Breaks:
    """Connections that broke in one sub-step.

    Attributes
    ----------
    time_s : float
        Simulated time at its end; at its beginning, of what broke before it.
    connections : (b,) int
        Which connections.
    loads : SectionForces
        What they broke under, in their own axes.
    """

    time_s: float
    connections: np.ndarray
    loads: SectionForces


@dataclass(frozen=True, slots=True)
class _Substep:
    """A sub-step that is still to be worked out.

    Attributes
    ----------
    snapshot : Snapshot or None
        What Bullet held after it; None where nobody needs it.
    substep_s, end_s : float
        Its length, and simulated time at its end.
    ties_n : (m, 3) float or None
        Forces of reinforcement in it, where there is any.
    broken : (b,) int
        Connections that broke in it.
    stored_j : (m,) float or None
        Energy in elastic connections at its end.
    foreseen : sequence of Breaks
        What broke before it.
    """

    snapshot: Snapshot | None
    substep_s: float
    end_s: float
    ties_n: np.ndarray | None
    broken: np.ndarray
    stored_j: np.ndarray | None = None
    foreseen: Sequence[Breaks] = ()


class SubstepRecorder:
    """Records a world sub-step by sub-step and adds up the loads of each frame.

    Parameters
    ----------
    world : BulletWorld
        Bound, before any time passes.
    inventory : Inventory
        Its bodies and connections.
    breaking : Breaking
        How connections break.
    events : Events
        Removals, saw cuts and weakenings.
    blast : Blast or None
        What explodes.
    loads_on_bridge : Loads
        What else pushes.
    threshold_step_s : float
        Length of the sub-steps that Blender's breaking thresholds, impulses in a sub-step, were made for.
    work : WorkAccumulator
        Adds up the work in each frame.
    elastic : ElasticConnections or None
        The connections, where they are elastic.
    member_sections : MemberSections or None
        Their sections, by which they are judged.
    ground : GroundDrive or None
        Moves the ground, where it moves.
    every_substep : bool
        Whether every sub-step is recorded: the work of a frame is known only then.
    loads : bool
        Whether loads and work are recorded. What comes to pass is the same without them.

    Attributes
    ----------
    elapsed_s : float
        Simulated time so far.
    seconds : float
        Wall time that recording has cost so far.
    error : Exception or None
        What went wrong in a sub-step; nothing is recorded after it.
    """

    def __init__(
        self,
        world: BulletWorld,
        inventory: Inventory,
        breaking: Breaking,
        events: Events,
        blast: Blast | None,
        loads_on_bridge: Loads,
        threshold_step_s: float,
        work: WorkAccumulator,
        elastic: ElasticConnections | None = None,
        member_sections: MemberSections | None = None,
        ground: GroundDrive | None = None,
        *,
        every_substep: bool,
        loads: bool,
    ):
        self.elapsed_s = 0.0
        self.seconds = 0.0
        self.error: Exception | None = None
        self._world, self._inventory, self._breaking = world, inventory, breaking
        self._events, self._work, self._elastic, self._ground = events, work, elastic, ground
        self._blast, self._threshold_step_s = blast, threshold_step_s
        self._loads_on_bridge = loads_on_bridge
        self._reinforcement = None
        remaining = events.remaining_strength
        if breaking.ductility and elastic:
            elastic.reinforce(breaking, remaining)
        elif breaking.ductility:
            self._reinforcement = Reinforcement(
                world, inventory, breaking.ductility, breaking.strength.tension_pa, remaining, breaking.bars
            )
        self._is_warming_up = breaking.warm_up_s > 0.0
        if self._is_warming_up:
            world.constraints.hold_thresholds()
        can_move = inventory.masses_kg > 0.0
        self._reader = LoadReader(world, inventory.pairs, can_move, inventory.points_m, inventory.normals)
        self._overloads = None
        if breaking.strength:
            self._overloads = Overloads(inventory.faces, can_move, breaking.strength, member_sections)
        self._frame = LoadAccumulator(inventory.pairs, inventory.volumes_m3, self._reader.normals)
        self._unknown = None if loads else (self._frame.finish().unknown(), FrameWork.unknown(len(inventory.masses_kg)))
        self._intact = world.constraints.intact()
        self._waiting: list[_Substep] = []
        self._background = BackgroundWork()
        self._substeps, self._substeps_before = 0, 0
        self._work_counts, self._every_substep = not self._is_warming_up, every_substep
        self._expected_substeps, self._begun_substeps = 0, 0
        self._loads_are_written = True
        self._breaks: list[Breaks] = []
        self._foreseen: list[Breaks] = []
        self._shards = np.flatnonzero((inventory.body_kinds == "shard") & can_move)
        self._balls = np.flatnonzero(inventory.body_kinds == "ball")
        self._hits: list[tuple[float, np.ndarray, np.ndarray]] = []
        self._last_snapshot: Snapshot | None = None

    def before_frame(self, substeps: int) -> None:
        """Know how many sub-steps Blender takes in the coming frame."""
        self._expected_substeps, self._begun_substeps = substeps, 0

    def before_substep(self, substep_s: float) -> None:
        """Prepare a sub-step of a length in s. Called by Bullet: keeps an error instead of raising it."""
        if self.error:
            return
        try:
            if not self._every_substep:
                self._have_last_loads_written()
            if self._is_warming_up and self._breaking.warm_up_damping:
                # As Bullet's own damping: a share of the velocity in a second, whatever the step.
                left = float(power(1.0 - self._breaking.warm_up_damping, substep_s))
                self._world.bodies.slow_down(self._shards, left)
            if self._ground:
                self._ground.before_substep(substep_s)
            self._events.before_substep(self.elapsed_s, substep_s)
            self._world.constraints.scale_thresholds(self._threshold_factor(substep_s))
            if self._reinforcement:
                self._reinforcement.before_substep(substep_s)
            if self._blast:
                self._blast.before_substep(substep_s)
            self._loads_on_bridge.before_substep(self.elapsed_s, substep_s)
            if self._elastic:
                self._predict(substep_s)
        except Exception as error:  # whoever follows the frames raises it there
            self.error = error

    def _have_last_loads_written(self) -> None:
        """Have Bullet write loads in the last sub-step of a frame: they are read after that one alone."""
        self._begun_substeps += 1
        wanted = self._begun_substeps >= self._expected_substeps
        if wanted != self._loads_are_written:
            self._world.constraints.write_loads(wanted=wanted)
            self._loads_are_written = wanted

    def _predict(self, substep_s: float) -> None:
        """Put elastic connections into the coming sub-step, without those that would break in it.

        Once a connection has borne more than its strength in a sub-step, it has given its bodies more than a real one.
        """
        self._elastic.begin_substep(substep_s)
        for _ in range(_MOST_ROUNDS):
            if not len(self._break_predicted(self._elastic.predict(), substep_s)):
                break
        else:
            self._elastic.predict()
        self._elastic.apply()

    def _break_predicted(self, both_sides: np.ndarray, substep_s: float) -> np.ndarray:
        """Break what would not bear predicted loads (2, 6, m) on the bodies of connections, and return it (b,)."""
        if self._is_warming_up or not self._overloads:
            return _NONE
        loads = np.where(self._reader.sides == 0, both_sides[0], both_sides[1])
        rows = self._perhaps_overloaded(loads)
        if not len(rows):
            return _NONE
        snapshot = replace(self._reader.snapshot(), loads=loads)
        moment = self._loads([_Substep(snapshot, substep_s, self.elapsed_s, None, _NONE)])[1].moment(0)
        rows = self._overloaded(rows, moment)
        if len(rows):
            self._foreseen.append(Breaks(self.elapsed_s, rows, self._reader.section_forces(moment, rows)))
            self._let_go(rows, moment)
            self._intact[rows] = False
            self._let_collide(self._intact)
        return rows

    def _let_go(self, rows: np.ndarray, loads: Moment) -> None:
        """Break connections (b,) under loads; their reinforcement holds on."""
        self._world.constraints.break_rows(rows)
        if not len(rows) or not self._breaking.ductility:
            return
        points_m, axes = loads.connection_points_m[rows], self._reader.section_axes(loads.rotations, rows)
        if self._elastic:
            self._elastic.tear(rows, points_m, axes)
        else:
            self._reinforcement.add(rows, points_m, axes)

    def _threshold_factor(self, substep_s: float) -> float:
        """Impulse of a steady force in this sub-step over that in the one that thresholds were made for."""
        factor = substep_s / self._threshold_step_s
        return 1.0 if abs(factor - 1.0) < _SINGLE_PRECISION else factor  # Blender calculates steps in single precision

    def after_substep(self, substep_s: float) -> None:
        """Record a sub-step of a length in s. Called by Bullet: keeps an error instead of raising it."""
        if self.error:
            return
        began = time.perf_counter()
        try:
            if not self._loads_are_written:
                raise SimulationError(
                    f"a frame had {self._begun_substeps} sub-steps instead of {self._expected_substeps}: "
                    "do not animate sub-steps per frame, or record every sub-step"
                )
            if self._ground:
                self._ground.after_substep()
            if self._unknown:
                self._follow(substep_s)
            else:
                self._record(substep_s)
            if self._is_worth_handing_over():
                self._hand_over()
        except Exception as error:  # whoever follows the frames raises it there
            self.error = error
        self.seconds += time.perf_counter() - began

    def skip(self, duration_s: float) -> None:
        """Let time pass of which nothing is known."""
        self.elapsed_s += duration_s

    def finish_frame(self) -> tuple[FrameLoads, FrameWork, list[Breaks]]:
        """Return loads and work of the frame and what broke in it, and begin the next frame.

        Raises
        ------
        LayoutError
            Bullet's memory was not as expected.
        """
        if self._unknown:
            return *self._unknown, []
        self._background.finish()
        waiting, self._waiting = self._waiting, []
        self._work_out(waiting, work_counts=self._work_counts)
        self._substeps, self._substeps_before = 0, self._substeps
        loads, work, breaks = self._frame.finish(), self._work.finish(), self._breaks
        self._frame.begin()
        self._breaks = []
        return loads, work, breaks

    def close(self) -> None:
        """Record nothing any more, and leave nothing that still works on what was recorded."""
        self._background.close()

    def take_ball_history(self) -> BallHistory:
        """Return the hits of the balls in every sub-step since this was asked last."""
        if not self._hits:
            return BallHistory.unknown()
        times, impulses, velocities = map(np.array, zip(*self._hits, strict=True))
        self._hits.clear()
        return BallHistory(self._balls, times, impulses, velocities)

    def take_last_contacts(self) -> Contacts | None:
        """Return the contacts in the last sub-step since this was asked last; None where there was none.

        Raises
        ------
        LayoutError
            Bullet's memory was not as expected.
        """
        snapshot, self._last_snapshot = self._last_snapshot, None
        return None if snapshot is None else self._reader.contacts(snapshot)

    def _record(self, substep_s: float) -> None:
        self.elapsed_s += substep_s
        self._substeps += 1
        if self._work_counts == self._is_warming_up:
            self._hand_over()
            self._work_counts = not self._is_warming_up
        snapshot = self._snapshot(substep_s)
        ties_n = self._tie_forces()
        intact = snapshot.intact.copy()
        intact[self._break_overloaded(_Substep(snapshot, substep_s, self.elapsed_s, ties_n, _NONE))] = False
        broken = np.flatnonzero(self._intact & ~intact)
        self._intact = intact
        stored_j = self._elastic.stored_j(intact) if self._elastic else None
        foreseen, self._foreseen = self._foreseen, []
        self._last_snapshot = snapshot
        self._waiting.append(_Substep(snapshot, substep_s, self.elapsed_s, ties_n, broken, stored_j, foreseen))
        self._let_collide(intact)

    def _follow(self, substep_s: float) -> None:
        """Break what is overloaded in a sub-step of which no loads are kept, and let go of what is broken."""
        self.elapsed_s += substep_s
        snapshot = self._snapshot(substep_s) if self._breaking.strength or self._elastic else None
        self._break_overloaded(_Substep(snapshot, substep_s, self.elapsed_s, self._tie_forces(), _NONE))
        self._foreseen = []
        self._intact = self._world.constraints.intact()
        self._let_collide(self._intact)

    def _let_collide(self, intact: np.ndarray) -> None:
        """Let bodies collide that no connection (m,) holds together, nor reinforcement in place of one."""
        self._world.constraints.let_broken_collide(self._elastic.holding(intact) if self._elastic else intact)

    def _tie_forces(self) -> np.ndarray | None:
        return self._reinforcement.forces_n.copy() if self._reinforcement else None

    def _snapshot(self, substep_s: float) -> Snapshot:
        """What Bullet holds, with the loads of elastic connections, of which it knows only what contacts change."""
        snapshot = self._reader.snapshot()
        if not self._elastic:
            return snapshot
        return replace(snapshot, loads=snapshot.loads + self._elastic.loads_on(self._reader.sides))

    def _is_worth_handing_over(self) -> bool:
        """Whether enough sub-steps wait, or as many as the frame probably has: Blender now moves its objects."""
        size = sum(each.snapshot.size for each in self._waiting)
        ends_frame = self._substeps == self._substeps_before
        return self._every_substep and size > (_WORTH_HANDING_OVER_BYTES if ends_frame else _BATCH_BYTES)

    def _hand_over(self) -> None:
        """Have the sub-steps that wait worked out beside what Blender does next."""
        waiting, self._waiting = self._waiting, []
        if waiting:
            self._background.begin(partial(self._work_out, waiting, work_counts=self._work_counts))

    def _work_out(self, substeps: Sequence[_Substep], *, work_counts: bool) -> None:
        """Add up loads and work of sub-steps, and note what broke and what hit the ball.

        Only one thread at a time does this, and it reads nothing but copies.
        """
        if not substeps:
            return
        bodies, loads = self._loads(substeps)
        resultants_n = self._frame.add(loads)
        if self._every_substep:
            stored_j = np.stack([each.stored_j for each in substeps]) if self._elastic else None
            self._add_work(bodies, loads, resultants_n, stored_j, work_counts=work_counts)
        for substep, each in enumerate(substeps):
            self._breaks += each.foreseen
            if len(each.broken):
                forces = self._reader.section_forces(loads.moment(substep), each.broken)
                self._breaks.append(Breaks(each.end_s, each.broken, forces))
            if len(self._balls):
                self._note_balls(bodies, loads, substep, each.end_s)

    def _loads(self, substeps: Sequence[_Substep]) -> tuple[BodyHistory, SubstepLoads]:
        """Return the states of all bodies after sub-steps, and the loads in these."""
        snapshots = [each.snapshot for each in substeps]
        bodies = BodyHistory.of(snapshots)
        loads = self._reader.loads(snapshots, bodies, np.array([each.substep_s for each in substeps]))
        for substep, each in enumerate(substeps):
            if each.ties_n is not None:
                loads.connection_forces_n[substep] += each.ties_n
        return bodies, loads

    def _add_work(
        self,
        bodies: BodyHistory,
        loads: SubstepLoads,
        resultants_n: np.ndarray,
        stored_j: np.ndarray | None,
        *,
        work_counts: bool,
    ) -> None:
        motion = Motion(bodies.positions, bodies.velocities, bodies.angular_velocities)
        if not work_counts:
            self._work.pass_over(motion)
            return
        substeps_s = loads.substeps_s[:, None, None]
        of_connections = PairImpulses(
            self._inventory.pairs,
            loads.connection_impulses_ns,
            loads.connection_points_m,
            loads.connection_angular_impulses_nms,
            stored_j=stored_j,
        )
        of_contacts = PairImpulses(
            loads.contact_pairs,
            loads.contact_impulses_ns,
            loads.contact_points_m,
            substeps=loads.contact_substeps,
        )
        resultants_ns = substeps_s * resultants_n
        self._work.add(motion, bodies.can_move, of_connections, of_contacts, resultants_ns, loads.substeps_s)

    def _break_overloaded(self, substep: _Substep) -> np.ndarray:
        """Break what its strength does not bear, and return it (b,).

        Bullet's own threshold has been at work within the sub-step.
        """
        if self._is_warming_up:
            if self.elapsed_s < self._breaking.warm_up_s:
                return _NONE
            self._is_warming_up = False
            if not self._elastic:
                self._world.constraints.release_thresholds()
        if not self._overloads:
            return _NONE
        rows = self._perhaps_overloaded(substep.snapshot.loads)
        if not len(rows):
            return _NONE
        loads = self._loads([substep])[1].moment(0)
        rows = self._overloaded(rows, loads)
        self._let_go(rows, loads)
        return rows

    def _perhaps_overloaded(self, loads: np.ndarray) -> np.ndarray:
        """Return the intact connections (k,) whose loads (6, m) are large enough for it, whatever they act on."""
        rows = self._overloads.candidates(loads, self._reader.lever_arms_m, self._events.remaining_strength)
        return rows[self._intact[rows]]

    def _overloaded(self, rows: np.ndarray, moment: Moment) -> np.ndarray:
        """Return which connections (r,) break (k,)."""
        loads = ConnectionLoads(moment.connection_forces_n, moment.connection_moments_nm, moment.connection_points_m)
        axes = self._reader.section_axes(moment.rotations, rows)
        parts = self._elastic.parts if self._elastic else None
        return self._overloads.breaking(rows, loads, axes, self._intact, self._events.remaining_strength, parts)

    def _note_balls(self, bodies: BodyHistory, loads: SubstepLoads, substep: int, end_s: float) -> None:
        contacts = loads.contacts_of(substep)
        first, second = loads.contact_pairs[contacts].T
        each = np.ascontiguousarray(loads.contact_impulses_ns[contacts])  # sums follow the order in memory
        impulses = [each[first == ball].sum(axis=0) - each[second == ball].sum(axis=0) for ball in self._balls]
        # A ball that is lifted moves as animation says: what it pushes off does not hit it.
        free = bodies.can_move[substep, self._balls, None]
        self._hits.append((end_s, np.where(free, impulses, 0.0), bodies.velocities[substep, self._balls]))


_NONE = np.zeros(0, int)
