"""Net force on every body from its change of momentum: the fallback where Bullet's memory is not to be trusted."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np

from ...core.mechanics.frame_loads import FrameLoads
from ...core.results.motion import turn
from ...scene.inventory import Inventory
from ...scene.time_scale import time_step_at

READING = "change of momentum between frames"


class MomentumReader:
    """Follows bodies by their places alone, frame by frame.

    Connections are not seen: not their forces, nor whether they hold. Of a body, only the mean of all forces on it
    but gravity is known, and that one frame late in its velocity: a force of one frame is spread over two.

    Parameters
    ----------
    scene, bodies
        The scene and its bodies.
    inventory
        The same bodies, without connections.
    """

    def __init__(self, scene: bpy.types.Scene, bodies: Sequence[bpy.types.Object], inventory: Inventory):
        self.elapsed_s = 0.0
        self._scene, self._bodies, self._inventory = scene, bodies, inventory
        self._places: np.ndarray | None = None
        self._velocities = np.zeros((len(bodies), 3))
        self._rotations: np.ndarray | None = None
        self._spins = np.zeros((len(bodies), 3))

    def read_frame(self, depsgraph: bpy.types.Depsgraph) -> dict[str, np.ndarray | float]:
        """The frame just evaluated, one on from the last."""
        step = time_step_at(self._scene, self._scene.frame_current)
        matrices = np.array([body.evaluated_get(depsgraph).matrix_world for body in self._bodies])
        places = matrices[:, :3, 3]
        rotations = matrices[:, :3, :3] / np.linalg.norm(matrices[:, :3, :3], axis=1)[:, None]
        loads = self._no_loads()
        substep = 0.0
        if self._places is not None and step.frame_s > 0.0:
            substep = step.substep_s
            self.elapsed_s += step.frame_s
            velocities = (places - self._places) / step.frame_s
            acceleration = (velocities - self._velocities) / step.frame_s - np.array(self._scene.gravity)
            force = self._inventory.masses_kg[:, None] * acceleration
            loads |= {"body_forces_n": force, "body_peaks_n": np.linalg.norm(force, axis=1)}
            self._velocities = velocities
            self._spins = turn(self._rotations, rotations) / step.frame_s
        self._places, self._rotations = places, rotations
        return {
            "frames": self._scene.frame_current,
            "times_s": self.elapsed_s,
            "substep_s": substep,
            "places_m": places,
            "rotations": rotations,
            "velocities_m_s": self._velocities,
            "spins_rad_s": self._spins,
            "asleep": np.zeros(len(self._bodies), bool),
            "intact": np.zeros(0, bool),
            **loads,
        }

    def _no_loads(self) -> dict[str, np.ndarray]:
        """All that a frame holds of loads, unknown."""
        nothing = FrameLoads(self._inventory.pairs, self._inventory.volumes_m3, lambda _: np.zeros((0, 3))).finish()
        return {name: np.full_like(values, np.nan) for name, values in nothing.items()}
