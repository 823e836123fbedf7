"""Sums over all sub-steps of a frame: loads, work, breaking, and the hits of the balls.

While Bullet waits, its state is only copied. The loads of many sub-steps are then evaluated at once, which takes a
fraction of the time: all those of a frame, or as many as fit into `BATCH_BYTES`. In larger models a thread of its own
does that while Bullet goes on with its next sub-steps: Blender releases Python while it simulates, and numpy does so in
long loops, so that each runs on a core of its own.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from ...bullet.contacts import Contacts
from ...bullet.snapshots import BodyHistory
from ...engineering.elasticity.crack_state import CrackAccumulator, FrameCracks
from ...engineering.mechanics.bearing_loads import BearingAccumulator, BearingLoads
from ...engineering.mechanics.frame_loads import FrameLoads, LoadAccumulator, SubstepLoads
from ...engineering.mechanics.work import FrameWork, Motion, PairImpulses, WorkAccumulator
from ...model.results.frames import BallHistory, Inventory
from ...model.schema import given
from .breaking import Breaks
from .elastic_connections import ElasticEnergy
from .meter import Meter, Reading

BATCH_BYTES = 1_000_000
"""Copies of sub-steps that are kept until they are evaluated; fewer take longer each, with more the end of a frame has
to wait longer."""

WORTH_HANDING_OVER_BYTES = 200_000
"""Handing over copies of fewer bytes takes longer than evaluating them."""

THREAD_NAME = "recording"
"""First part of the names of the threads."""


class BackgroundWork:
    """One thread that does one job at a time, in the order in which they come.

    A job must touch neither Blender's data nor Bullet's memory, but only data that no other code changes meanwhile.
    """

    def __init__(self) -> None:
        self._thread = ThreadPoolExecutor(max_workers=1, thread_name_prefix=THREAD_NAME)
        self._job: Future[None] | None = None

    def begin(self, job: Callable[[], None]) -> None:
        """Begin a job once the one before is done, and raise the error of that one."""
        self.finish()
        self._job = self._thread.submit(job)

    def finish(self) -> None:
        """Wait until the job is done, and raise its error."""
        job, self._job = self._job, None
        if job:
            job.result()

    def close(self) -> None:
        """Wait for the job that may still run, without raising its error, and end the thread for good."""
        self._thread.shutdown()
        self._job = None


@dataclass(frozen=True, slots=True)
class MeasuredSubstep:
    """A sub-step that is still to be evaluated: connections (b,) that broke in it, and others that broke before it.

    `elastic` is the energy in elastic connections at its end, with the state of their cracks.
    """

    reading: Reading
    broken: np.ndarray
    broken_before: Sequence[Breaks]
    elastic: ElasticEnergy | None


class FrameSums:
    """Adds up the sub-steps of each frame; the work of a frame is known only where every sub-step is measured."""

    def __init__(
        self,
        meter: Meter,
        inventory: Inventory,
        work: WorkAccumulator,
        bearings: BearingAccumulator | None,
        cracks: CrackAccumulator | None,
        *,
        every_substep: bool,
    ):
        self._meter, self._inventory, self._work, self._every_substep = meter, inventory, work, every_substep
        self._frame = LoadAccumulator(inventory.pairs, inventory.volumes_m3, meter.normals)
        self._bearings = bearings
        self._bearing_loads: BearingLoads | None = None
        self._cracks, self._crack_loads = cracks, FrameCracks.none()
        self._waiting: list[MeasuredSubstep] = []
        self._waiting_bytes = 0
        self._background = BackgroundWork()
        self._substeps, self._substeps_before = 0, 0
        self._work_counts = True
        self._breaks: list[Breaks] = []
        self._balls = np.flatnonzero(inventory.body_kinds == "ball")
        self._hits: list[tuple[float, np.ndarray, np.ndarray]] = []
        self._last: Reading | None = None

    def count_work(self, counts: bool) -> None:
        """Set whether the work of the sub-steps to come counts."""
        if counts != self._work_counts:
            self._evaluate_in_background()
            self._work_counts = counts

    def add(self, substep: MeasuredSubstep) -> None:
        """Take over a sub-step, and evaluate many of them when it is worth it."""
        self._substeps += 1
        self._last = substep.reading
        self._waiting.append(substep)
        self._waiting_bytes += substep.reading.snapshot.size
        if self._is_worth_handing_over():
            self._evaluate_in_background()

    def finish_frame(self) -> tuple[FrameLoads, FrameWork, list[Breaks]]:
        """Return loads, work and breaks of the frame, and begin the next frame."""
        self._background.finish()
        waiting = self._take_waiting()
        self.work_out(waiting, work_counts=self._work_counts)
        self._substeps, self._substeps_before = 0, self._substeps
        loads, work, breaks = self._frame.finish(), self._work.finish(), self._breaks
        self._frame.begin()
        self._breaks = []
        if self._bearings:
            self._bearing_loads = self._bearings.finish()
            self._bearings.begin()
        if self._cracks:
            self._crack_loads = self._cracks.finish()
            use = self._crack_loads.use_of_bodies(self._inventory.pairs, len(self._inventory.masses_kg))
            loads = replace(loads, body_bar_use=use)
        bars = self._cracks.bars if self._cracks else np.zeros(len(self._inventory.pairs))
        return replace(loads, connection_bars=bars), work, breaks

    @property
    def bearing_loads(self) -> BearingLoads | None:
        """Forces of bearings in the frame that was finished last; None where no time passed, or without bearings."""
        return self._bearing_loads

    @property
    def crack_loads(self) -> FrameCracks:
        """What bars across cracks did in the frame that was finished last; of no crack where it is not known."""
        return self._crack_loads

    def close(self) -> None:
        """Wait for the thread, and end it."""
        self._background.close()

    def take_ball_history(self) -> BallHistory:
        """Return the hits of the balls in every sub-step since the last call."""
        if not self._hits:
            return BallHistory.unknown()
        times, impulses, velocities = map(np.array, zip(*self._hits, strict=True))
        self._hits.clear()
        return BallHistory(self._balls, times, impulses, velocities)

    def take_last_contacts(self) -> Contacts | None:
        """Return the contacts in the last sub-step since the last call; None where there was no sub-step."""
        last, self._last = self._last, None
        return None if last is None else self._meter.contacts(last)

    def work_out(self, substeps: Sequence[MeasuredSubstep], *, work_counts: bool) -> None:
        """Add up loads and work of sub-steps, breaks and hits of balls; in one thread at a time, which reads copies."""
        if not substeps:
            return
        bodies, loads = self._meter.loads([substep.reading for substep in substeps])
        resultants_n = self._frame.add(loads)
        if self._bearings:
            self._bearings.add(loads)
        cracks = [substep.elastic.cracks for substep in substeps if substep.elastic and substep.elastic.cracks]
        for state in cracks if self._cracks else ():
            given(self._cracks).add(state)
        motion = Motion(bodies.positions_m, bodies.velocities_m_s, bodies.angular_velocities_rad_s)
        if self._every_substep and work_counts:
            resultants_ns = loads.substeps_s[:, None, None] * resultants_n
            of_connections, of_contacts = _impulses(self._inventory.pairs, loads, _stored_j(substeps))
            self._work.add(motion, bodies.can_move, of_connections, of_contacts, resultants_ns, loads.substeps_s)
            for state in cracks:
                self._work.add_in_cracks(float(state.yielding_j.sum()), float(state.rubbing_j.sum()))
        elif self._every_substep:
            self._work.pass_over(motion)
        for number, substep in enumerate(substeps):
            self._breaks += substep.broken_before
            if len(substep.broken):
                forces = self._meter.section_forces(loads.moment(number), substep.broken)
                self._breaks.append(Breaks(substep.reading.end_s, substep.broken, forces))
            if len(self._balls):
                self._note_balls(bodies, loads, number, substep.reading.end_s)

    def _is_worth_handing_over(self) -> bool:
        """Whether enough sub-steps wait, or as many as the frame probably has: Blender now moves its objects."""
        ends_frame = self._substeps == self._substeps_before
        return self._every_substep and self._waiting_bytes > (WORTH_HANDING_OVER_BYTES if ends_frame else BATCH_BYTES)

    def _evaluate_in_background(self) -> None:
        """Evaluate the sub-steps that wait in the background, while Blender goes on."""
        waiting = self._take_waiting()
        if waiting:
            self._background.begin(partial(self.work_out, waiting, work_counts=self._work_counts))

    def _take_waiting(self) -> list[MeasuredSubstep]:
        """Return the sub-steps that wait, and have none wait any more."""
        waiting, self._waiting, self._waiting_bytes = self._waiting, [], 0
        return waiting

    def _note_balls(self, bodies: BodyHistory, loads: SubstepLoads, substep: int, end_s: float) -> None:
        contacts = loads.contacts_of(substep)
        first, second = loads.contact_pairs[contacts].T
        points = np.ascontiguousarray(loads.contact_impulses_ns[contacts])  # sums follow the order in memory
        impulses = [points[first == ball].sum(axis=0) - points[second == ball].sum(axis=0) for ball in self._balls]
        # A ball that is lifted moves as animation says: bodies that it pushes aside do not hit it.
        free = bodies.can_move[substep, self._balls, None]
        self._hits.append((end_s, np.where(free, impulses, 0.0), bodies.velocities_m_s[substep, self._balls]))


def _stored_j(substeps: Sequence[MeasuredSubstep]) -> np.ndarray | None:
    """Energies (s, m) in elastic connections after sub-steps; None where they are rigid."""
    stored = [substep.elastic.stored_j for substep in substeps if substep.elastic is not None]
    return np.stack(stored) if stored else None


def _impulses(pairs: np.ndarray, loads: SubstepLoads, stored_j: np.ndarray | None) -> tuple[PairImpulses, PairImpulses]:
    """Impulses of connections between pairs (m, 2) of bodies in sub-steps, and those of contacts."""
    of_connections = PairImpulses(
        pairs,
        loads.connection_impulses_ns,
        loads.connection_points_m,
        loads.connection_angular_impulses_nms,
        stored_j=stored_j,
    )
    of_contacts = PairImpulses(
        loads.contact_pairs, loads.contact_impulses_ns, loads.contact_points_m, substeps=loads.contact_substeps
    )
    return of_connections, of_contacts
