"""Loads that grow with time, put into Bullet's world as forces before each sub-step."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...bullet.world import BulletWorld
from ...core.geometry.vectors import cross, transformed, transformed_back
from ...core.sequence.loads import PlacedLoad


class Loads:
    """All loads of a world that was bound just now, before any time passes.

    Parameters
    ----------
    world : BulletWorld
    loads : sequence of PlacedLoad
        On its bodies.
    """

    def __init__(self, world: BulletWorld, loads: Sequence[PlacedLoad]):
        self._world, self._loads = world, loads
        self._directions = [np.array(each.load.unit_direction) for each in loads]
        self._arms: list[np.ndarray | None] = []  # in the axes of the bodies
        rotations = world.positions()[1] if loads else None
        for each in loads:
            arm = each.arm_m
            self._arms.append(None if arm is None else transformed_back(rotations[each.bodies], arm[None]))
        self._begins_s = 0.0

    def before_substep(self, elapsed_s: float, substep_s: float) -> None:
        """Push with each load's mean in a sub-step of a length in s; simulated time is known once a frame at least.

        What was removed bears nothing, and its part of the load is gone with it.
        """
        if not self._loads:
            return
        self._begins_s = max(self._begins_s, elapsed_s)
        middle_s = self._begins_s + substep_s / 2.0
        self._begins_s += substep_s
        for load, direction, arm in zip(self._loads, self._directions, self._arms, strict=True):
            stays = ~self._world.removed[load.bodies]
            bodies, force_n = load.bodies[stays], load.load.force_n(middle_s)
            if not len(bodies) or force_n == 0.0:
                continue
            forces = force_n * load.shares[stays, None] * direction
            torques = None
            if arm is not None:
                torques = cross(transformed(self._world.positions()[1][bodies], arm), forces)
            self._world.wake(bodies)
            self._world.add_forces(bodies, forces, torques)
