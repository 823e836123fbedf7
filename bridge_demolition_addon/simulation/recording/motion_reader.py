"""Net force on every body from its change of momentum: all there is without Bullet's memory or the compiled core."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import bpy
import numpy as np

from ...engineering.geometry.vectors import length, rotation_vectors
from ...engineering.mechanics.frame_loads import FrameLoads, LoadAccumulator
from ...engineering.mechanics.work import FrameWork
from ...errors import CoreError, LayoutError, SimulationError
from ...model.results.frames import Frame, Inventory
from ...scene.run_setup import RunSetup
from ...scene.world import time_step_at

READING = "change of momentum between frames"

_NEED_MEMORY: tuple[tuple[Callable[[RunSetup], Any], str, str], ...] = (
    (lambda setup: setup.start_motion.any(), "velocities to begin with need", "take them out of the scenario"),
    (lambda setup: setup.loads, "loads need", "take them out of the scenario"),
    (lambda setup: setup.pulls, "pulls need", "take them out of the scenario"),
    (lambda setup: setup.tendons, "tendons need", "take them out of the scenario"),
    (lambda setup: setup.ground_motion, "a ground that moves needs", "take ground_motion out of the scenario"),
    (
        lambda setup: setup.changes,
        "removals, saw cuts, weakenings and blast zones need",
        "take them out of the scenario",
    ),
)
"""Features of a run that need Blender's memory, and a remedy without it."""


def check_motion_is_enough(setup: RunSetup, reason: LayoutError | CoreError, *, contacts: bool, elastic: bool) -> None:
    """Refuse a run that needs more than the motion of its bodies, which is all that is known for a reason."""
    needs = [(subject, remedy) for is_needed, subject, remedy in _NEED_MEMORY if is_needed(setup)]
    if contacts:
        needs.append(("contacts need", "switch recording.contacts off in the scenario"))
    if isinstance(reason, CoreError):
        needs += [("elastic connections need", "")] * elastic + [("charges need", "")] * setup.goes_off
    for subject, remedy in needs:
        if isinstance(reason, CoreError):
            raise SimulationError(reason.needed_by(subject))
        raise SimulationError(
            f"{subject} Blender's memory, which is not as expected ({reason}): {remedy}, or run it in another Blender"
        )


class MomentumReader:
    """Follows bodies by their positions alone, frame by frame.

    Neither the forces of connections are known, nor whether they hold. Of a body, only the mean of all forces on it but
    gravity is known, and that one frame late in its velocity: a force of one frame is spread over two.
    """

    def __init__(self, scene: bpy.types.Scene, bodies: Sequence[bpy.types.Object], inventory: Inventory):
        self._scene, self._bodies, self._masses_kg = scene, bodies, inventory.masses_kg
        self._no_loads = unknown_loads(inventory)
        self._last: Frame | None = None

    def read_frame(self, depsgraph: bpy.types.Depsgraph) -> Frame:
        """Return the frame just evaluated, the next after the last, without the impulses of a blast."""
        matrices = np.array([body.evaluated_get(depsgraph).matrix_world for body in self._bodies], float)
        positions_m, axes = matrices[:, :3, 3], matrices[:, :3, :3]
        rotations = axes / length(np.swapaxes(axes, 1, 2))[:, None]
        last, step = self._last, time_step_at(self._scene, self._scene.frame_current)
        time_s, substep_s, loads = 0.0, 0.0, self._no_loads
        velocities = angular_velocities = np.zeros_like(positions_m)
        if last:
            time_s, velocities, angular_velocities = last.time_s, last.velocities_m_s, last.angular_velocities_rad_s
        if last and step.frame_s > 0.0:
            time_s, substep_s = time_s + step.frame_s, step.substep_s
            velocities = (positions_m - last.positions_m) / step.frame_s
            angular_velocities = rotation_vectors(last.rotations, rotations) / step.frame_s
            loads = self._loads((velocities - last.velocities_m_s) / step.frame_s)
        self._last = Frame(
            number=self._scene.frame_current,
            time_s=time_s,
            substep_s=substep_s,
            positions_m=positions_m,
            rotations=rotations,
            velocities_m_s=velocities,
            angular_velocities_rad_s=angular_velocities,
            asleep=np.zeros(len(positions_m), bool),
            intact=np.zeros(0, bool),
            blast_impulses_ns=np.zeros_like(positions_m),
            loads=loads,
            work=FrameWork.unknown(len(positions_m)),
        )
        return self._last

    def _loads(self, accelerations: np.ndarray) -> FrameLoads:
        """Net forces under accelerations (n, 3); everything else is unknown."""
        forces = self._masses_kg[:, None] * (accelerations - np.array(self._scene.gravity, float))
        return replace(self._no_loads, body_forces_n=forces, body_peaks_n=length(forces))


def unknown_loads(inventory: Inventory) -> FrameLoads:
    """Return loads that are unknown, nan throughout."""
    normals = np.zeros((len(inventory.pairs), 3))
    return LoadAccumulator(inventory.pairs, inventory.volumes_m3, lambda _: normals).finish().unknown()
