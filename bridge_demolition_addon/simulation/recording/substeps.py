"""What is recorded after every sub-step: loads, breaking, and the hits of the ball."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from ...bullet.world import BulletWorld
from ...core.arithmetic import power
from ...core.mechanics.frame_loads import FrameLoads, LoadAccumulator, SubstepLoads
from ...core.mechanics.section_cuts import SectionCuts, worst_around
from ...core.mechanics.section_forces import SectionForces, section_forces
from ...core.mechanics.strength import rectangular_sections, strength_at, utilisation
from ...core.mechanics.work import FrameWork, Motion, PairImpulses, WorkAccumulator
from ...core.results.frames import BallHistory
from ...core.results.inventory import Inventory
from ...scene.connections.breaking_settings import Breaking
from .blast import Blast
from .events import Events
from .load_reader import LoadReader
from .reinforcement import Reinforcement

_SINGLE_PRECISION = 1e-6


@dataclass(frozen=True, slots=True)
class Breaks:
    """Connections that broke in one sub-step.

    Attributes
    ----------
    time_s : float
        Simulated time at its end.
    connections : (b,) int
        Which connections.
    loads : SectionForces
        What they broke under, in their own axes.
    """

    time_s: float
    connections: np.ndarray
    loads: SectionForces


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
    threshold_step_s : float
        Length of the sub-steps that Blender's breaking thresholds, impulses in a sub-step, were made for.
    work : WorkAccumulator
        Adds up the work in each frame.

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
        threshold_step_s: float,
        work: WorkAccumulator,
    ):
        self.elapsed_s = 0.0
        self.seconds = 0.0
        self.error: Exception | None = None
        self._world, self._inventory, self._breaking = world, inventory, breaking
        self._events, self._work = events, work
        self._blast, self._threshold_step_s = blast, threshold_step_s
        self._sections = rectangular_sections(inventory.areas_m2, inventory.second_moments_m4)
        self._reinforcement = None
        if breaking.ductility:
            remaining = events.remaining_strength
            self._reinforcement = Reinforcement(
                world, inventory, breaking.ductility, breaking.strength.tension_pa, remaining
            )
        self._is_warming_up = breaking.warm_up_s > 0.0
        if self._is_warming_up:
            world.hold_connections()
        can_move = inventory.masses_kg > 0.0
        self._reader = LoadReader(world, inventory.pairs, can_move, inventory.points_m, inventory.normals)
        self._cuts = SectionCuts.between(inventory.pairs, inventory.normals, inventory.areas_m2, can_move)
        self._frame = LoadAccumulator(inventory.pairs, inventory.volumes_m3, self._reader.normals)
        self._intact = world.intact()
        self._breaks: list[Breaks] = []
        self._shards = np.flatnonzero((inventory.body_kinds == "shard") & can_move)
        self._balls = np.flatnonzero(inventory.body_kinds == "ball")
        self._hits: list[tuple[float, np.ndarray, np.ndarray]] = []

    def before_substep(self, substep_s: float) -> None:
        """Prepare a sub-step of a length in s. Called by Bullet: keeps an error instead of raising it."""
        if self.error:
            return
        try:
            if self._is_warming_up and self._breaking.warm_up_damping:
                # As Bullet's own damping: a share of the velocity in a second, whatever the step.
                self._world.slow_down(self._shards, float(power(1.0 - self._breaking.warm_up_damping, substep_s)))
            self._events.before_substep(self.elapsed_s, substep_s)
            self._world.scale_thresholds(self._threshold_factor(substep_s))
            if self._reinforcement:
                self._reinforcement.before_substep(substep_s)
            if self._blast:
                self._blast.before_substep(substep_s)
        except Exception as error:  # whoever follows the frames raises it there
            self.error = error

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
            self._record(substep_s)
        except Exception as error:  # whoever follows the frames raises it there
            self.error = error
        self.seconds += time.perf_counter() - began

    def skip(self, duration_s: float) -> None:
        """Let time pass of which nothing is known."""
        self.elapsed_s += duration_s

    def finish_frame(self) -> tuple[FrameLoads, FrameWork, list[Breaks]]:
        """Return loads and work of the frame and what broke in it, and begin the next frame."""
        loads, work, breaks = self._frame.finish(), self._work.finish(), self._breaks
        self._frame.begin()
        self._breaks = []
        return loads, work, breaks

    def ball_history(self) -> BallHistory:
        """Return the hits of the balls in every sub-step so far."""
        if not self._hits:
            return BallHistory.unknown()
        times, impulses, velocities = map(np.array, zip(*self._hits, strict=True))
        return BallHistory(self._balls, times, impulses, velocities)

    def _record(self, substep_s: float) -> None:
        self.elapsed_s += substep_s
        loads = self._reader.read(substep_s)
        if self._reinforcement:
            loads.connection_forces_n[:] += self._reinforcement.forces_n
        self._add_work(loads, self._frame.add(loads))
        self._break_overloaded(loads)
        self._note_breaks(loads)
        self._world.let_broken_collide()
        if len(self._balls):
            self._note_balls(loads)

    def _add_work(self, loads: SubstepLoads, resultants_n: np.ndarray) -> None:
        motion = Motion(loads.centres_m, self._world.velocities(), self._world.angular_velocities())
        if self._is_warming_up:
            self._work.pass_over(motion)
            return
        of_connections = PairImpulses(
            self._inventory.pairs,
            loads.substep_s * loads.connection_forces_n,
            loads.connection_points_m,
            loads.substep_s * loads.connection_moments_nm,
        )
        of_contacts = PairImpulses(loads.contact_pairs, loads.contact_impulses_ns, loads.contact_points_m)
        resultants_ns = loads.substep_s * resultants_n
        self._work.add(motion, self._world.can_move(), of_connections, of_contacts, resultants_ns, loads.substep_s)

    def _break_overloaded(self, loads: SubstepLoads) -> None:
        """Break what its strength does not bear; Bullet's own threshold has been at work within the sub-step."""
        if self._is_warming_up:
            if self.elapsed_s < self._breaking.warm_up_s:
                return
            self._is_warming_up = False
            self._world.release_connections()
        if self._breaking.strength:
            rows = self._overloaded(loads)
            self._world.break_connections(rows)
            if self._reinforcement and len(rows):
                self._reinforcement.add(rows, loads.connection_points_m[rows])

    def _overloaded(self, loads: SubstepLoads) -> np.ndarray:
        """Return the connections (k,) to break: overloaded alone and as parts of their cuts, and each the worst around.

        When one breaks, its neighbours take over its load: they are judged again after the next sub-step.
        """
        strength, inventory, left = self._breaking.strength, self._inventory, self._events.remaining_strength
        forces = self._section_forces(loads, np.arange(len(self._intact)))
        rows = np.flatnonzero((utilisation(forces, self._sections, strength) > left) & self._intact)
        if not len(rows):
            return rows
        cut_loads, areas, second_moments = self._cuts.sections(
            rows,
            self._intact,
            loads.connection_forces_n,
            loads.connection_moments_nm,
            loads.connection_points_m,
            self._reader.section_axes(loads.rotations, rows),
            inventory.areas_m2,
            inventory.second_moments_m4,
        )
        of_both_cuts = strength_at(strength, np.concatenate((rows, rows)))
        used = utilisation(cut_loads, rectangular_sections(areas, second_moments), of_both_cuts)
        used = used.reshape(2, -1).mean(axis=0) / left[rows]
        return rows[(used > 1.0) & worst_around(inventory.pairs[rows], used, inventory.masses_kg > 0.0)]

    def _section_forces(self, loads: SubstepLoads, rows: np.ndarray) -> SectionForces:
        """Loads of some connections (r,) in their own axes."""
        axes = self._reader.section_axes(loads.rotations, rows)
        return section_forces(axes, loads.connection_forces_n[rows], loads.connection_moments_nm[rows])

    def _note_breaks(self, loads: SubstepLoads) -> None:
        intact = self._world.intact()
        rows = np.flatnonzero(self._intact & ~intact)
        self._intact = intact
        if len(rows):
            self._breaks.append(Breaks(self.elapsed_s, rows, self._section_forces(loads, rows)))

    def _note_balls(self, loads: SubstepLoads) -> None:
        (first, second), each = loads.contact_pairs.T, loads.contact_impulses_ns
        impulses = [each[first == ball].sum(axis=0) - each[second == ball].sum(axis=0) for ball in self._balls]
        # A ball that is lifted moves as animation says: what it pushes off does not hit it.
        free = self._world.can_move()[self._balls, None]
        self._hits.append((self.elapsed_s, np.where(free, impulses, 0.0), self._world.velocities()[self._balls]))
