"""Blast loads in a simulation: every body gets the exact integral of its pressure in every step."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace

import bpy
import numpy as np

from ...bullet.bodies import BodyTable
from ...bullet.field_filter import ignore_fields, let_fields_act
from ...bullet.world import BulletWorld
from ...engineering.geometry.vectors import length
from ...errors import LayoutError, SimulationError
from ...model.blast.explosion import Explosion, StepLoads, no_loads, sum_of_loads
from ...model.blast.settings import Apply
from ...model.schema import given
from ...scene.blast.charges import blast_of, charges_of
from ...scene.blast.force_fields import FieldReach, ForceFields, fields_of, has_other_fields, isolating_reaches
from ...scene.run_setup import RunSetup
from .drivers import Driver


class FieldBlast:
    """Loads through force-field empties: in each frame one steady force per body, whose impulse is exact.

    The bodies (n,) are those that can be pushed. `lost_loads` counts how often a body has left its field within a
    frame, and lost a part of its load.
    """

    def __init__(self, scene: bpy.types.Scene, bodies: Sequence[bpy.types.Object], explosion: Explosion):
        self.lost_loads = 0
        self._scene = scene
        self._fields = ForceFields(scene, bodies)
        self._explosion = explosion
        self._loads = no_loads()
        self._pushed = np.zeros(0, int)
        self._directions = np.zeros((0, 3))
        self._reaches: FieldReach | None = None
        self._positions_m: np.ndarray | None = None

    def before_frame(self, start_s: float, frame_s: float, positions_m: np.ndarray, rotations: np.ndarray) -> None:
        """Aim and load the fields for a frame with a begin and a length, and the bodies at positions (n, 3)."""
        self._fields.rest()
        let_fields_act(self._scene)
        self._loads, self._pushed = no_loads(), np.zeros(0, int)
        if frame_s > 0.0 and not self._explosion.is_quiet(start_s, start_s + frame_s):
            self._loads = self._explosion.loads(start_s, start_s + frame_s, positions_m, rotations)
        if len(self._loads):
            self._push(frame_s, positions_m)
        elif not has_other_fields(self._scene):
            with suppress(LayoutError):  # it only takes longer
                ignore_fields(self._scene)

    def _push(self, frame_s: float, positions_m: np.ndarray) -> None:
        impulses = self._loads.vectors(len(positions_m))
        sizes = length(impulses)
        self._pushed = np.flatnonzero(sizes > 0.0)
        self._directions = impulses[self._pushed] / sizes[self._pushed, None]
        self._reaches = isolating_reaches(self._pushed, self._directions, positions_m)
        self._positions_m = positions_m
        forces = sizes[self._pushed] / frame_s
        self._fields.push(self._pushed, forces, self._directions, positions_m[self._pushed], self._reaches)

    def after_frame(self, positions_m: np.ndarray) -> StepLoads:
        """Return the loads of the frame, after which the bodies are at positions (n, 3)."""
        if not self._fields.still_push():
            raise SimulationError(
                "a force field was changed or deleted while it pushed: leave them alone while the blast goes on"
            )
        if len(self._pushed):
            displacements = (positions_m - self._positions_m)[self._pushed]
            self.lost_loads += int((~given(self._reaches).contain(displacements, self._directions)).sum())
        return self._loads

    def rest(self) -> None:
        """Push nothing any more."""
        self._fields.rest()
        with suppress(LayoutError):  # until Blender makes its evaluated copy again
            let_fields_act(self._scene)


class DirectBlast:
    """Loads as forces in Bullet, set again in every sub-step, on the bodies (n,) that can be pushed."""

    def __init__(self, bodies: BodyTable, rows: np.ndarray, explosion: Explosion):
        self._bodies, self._rows, self._explosion = bodies, rows, explosion
        self._elapsed_s = 0.0
        self._loads: list[StepLoads] = []

    def begin_frame(self, start_s: float) -> None:
        """Set the time at which the coming frame begins."""
        self._elapsed_s = start_s

    def before_substep(self, substep_s: float) -> None:
        """Push the bodies in the coming sub-step."""
        start_s, self._elapsed_s = self._elapsed_s, self._elapsed_s + substep_s
        if self._explosion.is_quiet(start_s, self._elapsed_s):
            return
        positions_m, rotations = self._bodies.positions()
        loads = self._explosion.loads(start_s, self._elapsed_s, positions_m[self._rows], rotations[self._rows])
        if not len(loads):
            return
        pushed = np.flatnonzero(np.bincount(loads.bodies, minlength=len(self._rows)))
        forces = loads.vectors(len(self._rows))[pushed] / substep_s
        self._bodies.push(self._rows[pushed], forces)
        self._loads.append(loads)

    def after_frame(self) -> StepLoads:
        """Return the loads of the frame."""
        loads, self._loads = sum_of_loads(self._loads), []
        return loads


class Blast(Driver):
    """The explosion of a scene while it is simulated; the world is None where Bullet's memory is not to be trusted."""

    def __init__(self, scene: bpy.types.Scene, setup: RunSetup, world: BulletWorld | None):
        explosion = setup.explosion()
        self._rows, self._count = setup.pushed_rows, len(setup.bodies)
        self._fields: FieldBlast | None = None
        self._direct: DirectBlast | None = None
        if setup.blast.apply == Apply.FIELDS:
            self._fields = FieldBlast(scene, [setup.bodies.objects[row] for row in self._rows], explosion)
        elif world is not None:
            self._direct = DirectBlast(world.bodies, self._rows, explosion)
        else:
            raise SimulationError(
                "blast cannot be applied directly, as Bullet's memory is not as expected: apply it by force fields"
            )

    @property
    def lost_loads(self) -> int:
        """How often a body has left its field within a frame, and lost a part of its load."""
        return self._fields.lost_loads if self._fields else 0

    def before_frame(self, start_s: float, frame_s: float, positions_m: np.ndarray, rotations: np.ndarray) -> None:
        """Prepare a frame with a begin and a length, and all bodies at positions (n, 3)."""
        if self._fields:
            self._fields.before_frame(start_s, frame_s, positions_m[self._rows], rotations[self._rows])
        elif self._direct:
            self._direct.begin_frame(start_s)

    def before_substep(self, elapsed_s: float, substep_s: float) -> None:
        """Push the bodies in a sub-step of a length in s, where forces do."""
        if self._direct:
            self._direct.before_substep(substep_s)

    def after_frame(self, positions_m: np.ndarray) -> tuple[StepLoads, np.ndarray]:
        """Return the loads of the frame, after which all bodies are at these positions, and their impulses (n, 3)."""
        positions_m = positions_m[self._rows]
        loads = self._fields.after_frame(positions_m) if self._fields else given(self._direct).after_frame()
        loads = replace(loads, bodies=self._rows[loads.bodies])
        return loads, loads.vectors(self._count)

    def rest(self) -> None:
        """Push nothing any more."""
        if self._fields:
            self._fields.rest()


def check_blast(scene: bpy.types.Scene, bodies: Sequence[bpy.types.Object]) -> None:
    """Check the charges and force fields of a scene, before anything is simulated."""
    if goes_off(scene) and blast_of(scene).apply == Apply.FIELDS:
        fields_of(scene, [body for body in bodies if body.rigid_body.type == "ACTIVE"])


def goes_off(scene: bpy.types.Scene) -> bool:
    """Return whether anything explodes in a scene: the explosion is asked for, and some charge has a mass."""
    return blast_of(scene).explosion and any(charge.mass_kg > 0.0 for charge in charges_of(scene))
