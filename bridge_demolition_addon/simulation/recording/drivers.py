"""Drivers, which act in Bullet's world around each sub-step; `substeps` writes down their order."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from ...bullet.constraints import ConstraintTable
from ...bullet.world import BulletWorld
from ...engineering.arithmetic import power
from ...errors import SimulationError
from ...scene.connections.constraints import Breaking

_SINGLE_PRECISION = 1e-6


class Driver(Protocol):
    """Acts in a world that was bound just now, before any time passes."""

    def before_substep(self, elapsed_s: float, substep_s: float) -> None:
        """Act before a sub-step of a length in s; the simulated time before it is known once a frame at least."""

    def after_substep(self) -> None:
        """Act after the sub-step, before anything is measured; most do nothing then."""
        return


class LastSubstepLoads(Driver):
    """Has Bullet write loads in the last sub-step of each frame alone: they are read after that one."""

    def __init__(self, constraints: ConstraintTable):
        self._constraints, self._are_written = constraints, True
        self._expected, self._begun = 0, 0

    def before_frame(self, substeps: int) -> None:
        """Set how many sub-steps Blender takes in the coming frame."""
        self._expected, self._begun = substeps, 0

    def before_substep(self, elapsed_s: float, substep_s: float) -> None:
        """Have loads written, or not, in this sub-step."""
        self._begun += 1
        wanted = self._begun >= self._expected
        if wanted != self._are_written:
            self._constraints.write_loads(wanted=wanted)
            self._are_written = wanted

    def after_substep(self) -> None:
        """Check that the sub-step after which loads are read was the last one."""
        if not self._are_written:
            raise SimulationError(
                f"a frame had {self._begun} sub-steps instead of {self._expected}: "
                "do not animate sub-steps per frame, or record every sub-step"
            )


class WarmUp(Driver):
    """Lets nothing break, and slows down the shards (s,), until the structure has settled under its own weight.

    With `release` Bullet's own thresholds hold afterwards.
    """

    def __init__(self, world: BulletWorld, shards: np.ndarray, breaking: Breaking, *, release: bool):
        self.is_over = breaking.warm_up_s <= 0.0
        self._world, self._shards, self._breaking, self._release = world, shards, breaking, release
        if not self.is_over:
            world.constraints.hold_thresholds(held=True)

    def before_substep(self, elapsed_s: float, substep_s: float) -> None:
        """Slow the shards down."""
        if not self.is_over and self._breaking.warm_up_damping:
            # As Bullet's own damping: a share of the velocity in a second, with any step.
            left = float(power(1.0 - self._breaking.warm_up_damping, substep_s))
            self._world.bodies.slow_down(self._shards, left)

    def end_when_due(self, elapsed_s: float) -> None:
        """End it after a sub-step, if that much simulated time has passed."""
        if not self.is_over and elapsed_s >= self._breaking.warm_up_s:
            self.is_over = True
            if self._release:
                self._world.constraints.hold_thresholds(held=False)


class ThresholdScale(Driver):
    """Scales Blender's breaking thresholds, impulses in sub-steps of one length, to the length of each sub-step."""

    def __init__(self, constraints: ConstraintTable, made_for_s: float):
        self._constraints, self._made_for_s = constraints, made_for_s

    def before_substep(self, elapsed_s: float, substep_s: float) -> None:
        """Scale them by the impulse of a steady force in this sub-step."""
        factor = substep_s / self._made_for_s
        # Blender calculates steps in single precision.
        self._constraints.scale_thresholds(1.0 if abs(factor - 1.0) < _SINGLE_PRECISION else factor)
