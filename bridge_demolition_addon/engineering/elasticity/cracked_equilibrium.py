"""A structure at rest that has cracks, some held by bars: found by implicit steps in time that are very long.

A sub-step of `structure` is implicit: forces are those at its end. In a long one from rest, inertia M / dt² counts next
to nothing against stiffness, and what is left is the equilibrium of elastic connections, bars that yield, sides of
cracks that press and rub, and springs: Newton's method, with a little mass beside the stiffness. Bodies stop after each
step, so nothing swings. Where no equilibrium is near, bodies fall by metres in a step.

All arrays have their components first.
"""

from __future__ import annotations

from collections.abc import Callable
from copy import deepcopy
from dataclasses import dataclass

import numpy as np

from ..arithmetic import LARGEST_ANGLE
from ..arrays import BoolArray, FloatArray, IntArray
from ..geometry.vectors import rotated
from .bearings import Bearings
from .cracks import Cracks
from .equations import RigidBodies, connected_parts
from .equilibrium import Equilibrium
from .joint_rows import JointFrames, components_first, components_last, cross_products, turned, turned_back
from .structure import BareBarLaw, ElasticStep, ElasticStructure, StepInput, StoringLaw
from .tendons import TendonForces

_STEPS_S = (1.0, 0.25, 0.06)
"""Lengths of a step: in the first, what hangs by a thousandth of the stiffness of a bridge with 5 Hz still finds its
rest. In the last, what falls goes 35 mm."""

_LONGEST_M = 0.05
"""Motion from which on a shorter step is taken: bars that yield are as soft as they harden, and a long step with that
stiffness goes far beyond where the next cracks and bars would hold it."""

_AT_REST = 1e-4
"""Force that is left on a body, by its largest load, at which it rests."""

_MOST_STEPS = 60
_MOST_ROUNDS = 200
"""How often connections break one after another in one step, before the rest waits for the next."""

_REGRIPS = 2
"""How often sides of cracks rub by the pressing force that was found before, in one step."""

_FALLS_M = (0.2, 0.2, 0.02)
"""Motion in one step of what falls, by its length: what else breaks waits for the next, without what has come loose by
then."""

_FARTHEST_M = 0.5
"""Displacement from where it was built, beyond which a body has fallen."""

Overloaded = Callable[[FloatArray, BoolArray], IntArray]
"""Which connections (k,) break, of loads (6, m) on the first bodies about their points, and whether each is intact."""

Pause = Callable[[], None]
"""Lets others go on while something takes long; may raise to stop it."""

Tear = Callable[[Cracks, IntArray, FloatArray, FloatArray], None]
"""Adds cracks in place of connections (k,), with bodies at positions (3, n) in rotations (3, 3, n)."""


@dataclass(frozen=True, slots=True, eq=False)
class BuiltStructure:
    """What an `ElasticStructure` is made of, as it was built."""

    frames: JointFrames
    stiffness: FloatArray  # (6, 6, m)
    bodies: RigidBodies
    soil: StoringLaw | None = None
    bearings: Bearings | None = None


class CrackedStructure:
    """Bodies, elastic connections, and the cracks in place of some, under loads that change little by little.

    `intact` (m,) are connections that are whole, with
    which it is at `rest` at first: springs that do not touch anything would not know where it rests. `left` (m,) is
    what `cracks` have as the shares of their bars. `bare_bars` stand where connections are gone. Tendons go with the
    bodies, whose inertia is about their own axes.
    """

    def __init__(
        self,
        built: BuiltStructure,
        cracks: Cracks,
        left: FloatArray,
        intact: BoolArray,
        rest: Equilibrium,
        bare_bars: BareBarLaw | None = None,
        tendons: TendonForces | None = None,
    ):
        self._built, self.cracks, self._left = built, cracks, left
        self._frames, self._bodies, self._step_s = built.frames, built.bodies, _STEPS_S[0]
        self._falls, self.bare_bars, self._tendons = False, bare_bars, tendons
        self.positions_m, self.rotations = rest.positions_m, rest.rotations
        self.intact, self.held = intact.copy(), rest.held.copy()
        self.loads = np.zeros(
            (6, len(built.frames))
        )  # on the first bodies about their points, in the axes of the world
        if bare_bars is not None:
            self._let_go()

    def copy(self) -> CrackedStructure:
        """Return one in the same state, that goes on by itself."""
        memo = {id(part): part for part in (self._frames, self._built.stiffness, self._bodies)}
        return deepcopy(self, memo)

    def load(
        self,
        accelerations: FloatArray,
        overloaded: Overloaded,
        tear: Tear,
        pause: Pause,
        is_enough: Callable[[], bool] = lambda: False,
    ) -> bool:
        """Let it come to rest under loads by mass (6, n), connections breaking one after another.

        Return whether it did. What falls, or goes on moving, is not held any more. `pause` is called before each
        solving. It ends where what is held already `is_enough`.
        """
        built = self._built
        structure = ElasticStructure(
            built.frames, built.stiffness, built.bodies, 0.0, self.cracks, built.soil, built.bearings, from_rest=True
        )
        if self.bare_bars is not None:
            structure.stand_bare(self.bare_bars)
        self._falls = False
        for _ in range(_MOST_STEPS):
            ruptured = structure.update_plastic_state(self.positions_m, self.rotations)
            self._let_go()
            if is_enough():
                return False
            broke, step = self._broken_in_step(structure, self._with_tendons(accelerations), overloaded, tear, pause)
            self.loads = self._loads_of(step)
            moving = self._moving(step)
            self.positions_m, self.rotations = self._moved(moving)
            structure.end_substep()
            rests = abs(moving[:3]).max(axis=0) <= _AT_REST * self._step_s * abs(accelerations[:3]).max()
            if rests.all() and not broke and not len(ruptured) and not self._tendons_rupture():
                return True
        self._let_go()
        self.held &= rests
        return False

    def _tendons_rupture(self) -> bool:
        """Cut tendons across cracks that are too wide at rest, and return whether there are some."""
        return self._tendons is not None and bool(
            self._tendons.update_plastic_state(self.positions_m, self.rotations).any()
        )

    def _with_tendons(self, accelerations: FloatArray) -> FloatArray:
        """Add to accelerations (6, n) those by the tendons that have not ruptured."""
        if self._tendons is None:
            return accelerations
        forces, moments = np.split(self._tendons.loads(self.positions_m, self.rotations), 2)
        masses, inertias = self._bodies.masses_kg, self._bodies.inertias_kg_m2[[0, 1, 2], [0, 1, 2]]
        own = turned_back(self.rotations, moments)
        turning = np.divide(own, inertias, out=np.zeros_like(own), where=inertias > 0.0)
        shifting = np.divide(forces, masses, out=np.zeros_like(forces), where=masses > 0.0)
        both: FloatArray = accelerations + np.concatenate((shifting, turned(self.rotations, turning)))
        return both

    def _broken_in_step(
        self, structure: ElasticStructure, accelerations: FloatArray, overloaded: Overloaded, tear: Tear, pause: Pause
    ) -> tuple[bool, ElasticStep]:
        """Whether anything broke in a step, and the step without that."""
        self._step_s = _STEPS_S[-1] if self._falls else _STEPS_S[0]
        step = self._short_step(structure, accelerations, pause)
        for number in range(_MOST_ROUNDS):
            self._falls = self._farthest_m(step) > _FALLS_M[_STEPS_S.index(self._step_s)]
            if self._falls:
                return True, step
            rows = overloaded(self._loads_of(step), self.intact)
            if not len(rows):
                return number > 0, step
            self.intact[rows] = False
            tear(self.cracks, rows, self.positions_m, self.rotations)
            step = self._short_step(structure, accelerations, pause)
        return True, step

    def _short_step(self, structure: ElasticStructure, accelerations: FloatArray, pause: Pause) -> ElasticStep:
        """Return a step in which nothing goes farther than `_LONGEST_M`, or the shortest; no longer than the last."""
        for step_s in _STEPS_S[_STEPS_S.index(self._step_s) :]:
            self._step_s = step_s
            free = np.where(self.held, self._step_s * accelerations, 0.0)
            start = StepInput(self.positions_m, self.rotations, free, ~self.held)
            step = self._with_friction(structure, start, pause)
            if self._farthest_m(step) <= _LONGEST_M:
                break
        return step

    def _farthest_m(self, step: ElasticStep) -> float:
        return self._step_s * float(abs(self._moving(step)[:3]).max())

    def _with_friction(self, structure: ElasticStructure, start: StepInput, pause: Pause) -> ElasticStep:
        """Return a step in which sides of cracks rub by how they are pressed in it."""
        pause()
        step = structure.step(start, self.intact, self._step_s)
        for _ in range(_REGRIPS if len(self.cracks) else 0):
            moving = self._moving(step)
            if not self.cracks.grip(*self._moved(moving)):
                break
            pause()
            step = structure.step(start, self.intact, self._step_s)
        return step

    def _moving(self, step: ElasticStep) -> FloatArray:
        """Velocities (6, n) of what is held, at the end of a step; what falls turns no more than can be measured."""
        moving: FloatArray = np.where(self.held & self._bodies.moves, step.velocities, 0.0)
        most = 0.25 * LARGEST_ANGLE / self._step_s
        moving[3:] = np.clip(moving[3:], -most, most)
        return moving

    def _loads_of(self, step: ElasticStep) -> FloatArray:
        """Forces, and moments about their points, (6, m) of all connections and cracks on their first bodies."""
        loads = np.zeros((6, len(self._frames)))
        loads[:, step.acting] = step.of_first / self._step_s
        loads[:, step.cracks] = step.of_cracks_on_first / self._step_s
        first = self._frames.first
        arms = turned(self.rotations[..., first], self._frames.first_points_m)
        loads[3:] -= cross_products(arms, loads[:3])
        return loads

    def _moved(self, moving: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Positions and rotations after a step with velocities (6, n)."""
        turned_on = rotated(components_last(self.rotations), components_last(self._step_s * moving[3:]))
        return self.positions_m + self._step_s * moving[:3], components_first(turned_on)

    def _let_go(self) -> None:
        """Take what has fallen, and what hangs by nothing any more, for gone."""
        moves, frames = self._bodies.moves, self._frames
        fallen = abs(self.positions_m - self._bodies.positions_m).max(axis=0) > _FARTHEST_M
        lost = moves & (fallen | ~self.held)
        of_lost = lost[frames.first] | lost[frames.second]
        self.intact &= ~of_lost
        self._left[of_lost] = 0.0  # its bars are gone as well
        if self._tendons is not None and lost.any():
            self._tendons.cut(self._tendons.passages.crossing(np.zeros(0, int), np.flatnonzero(lost)))
        holds = self.intact.copy()
        holds[self.cracks.rows[~of_lost[self.cracks.rows]]] = True
        first, second = frames.first[holds], frames.second[holds]
        if self.bare_bars is not None:
            self.bare_bars.let_go(np.flatnonzero(lost))
            first, second = (
                np.concatenate((ends, of_bars[self.bare_bars.holds]))
                for ends, of_bars in zip((first, second), self.bare_bars.ends, strict=True)
            )
        label = connected_parts(moves, first, second)
        supported = np.unique(np.concatenate((label[first[~moves[second]]], label[second[~moves[first]]])))
        self.held &= ~lost & (np.isin(label, supported[supported >= 0]) | ~moves)
