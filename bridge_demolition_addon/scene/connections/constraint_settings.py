"""Connections as Blender simulates them: between which bodies, of which kind, and when they break."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from .breaking_settings import kept_breaking_force
from .constraints import connections_of

_CONSTRAINT = ("type", "enabled", "use_breaking", "breaking_threshold", "disable_collisions")
"""Blender's properties of a constraint that decide how it holds."""


@dataclass(frozen=True, slots=True, eq=False)
class ConstraintSettings:
    """The m connections of a scene's rigid-body world.

    Attributes
    ----------
    bodies
        Names of the two bodies of each, empty for one that it lacks.
    constraint
        Properties of the constraints by Blender's names.
    iterations
        Iterations of the solver that each has of its own, 0 for none.
    breaking_forces_n
        The force that each breaks at, where one is kept.
    """

    objects: tuple[bpy.types.Object, ...]
    names: tuple[str, ...]
    bodies: Sequence[tuple[str, str]]
    positions_m: np.ndarray
    constraint: Mapping[str, Sequence[Any]]
    iterations: Sequence[int]
    breaking_forces_n: Sequence[float | None]

    def __len__(self) -> int:
        return len(self.objects)

    def breaks_at(self) -> list[float]:
        """Return the breaking force, N, of each, or its threshold, N·s, with a minus sign where no force is kept."""
        thresholds = self.constraint["breaking_threshold"]
        return [-own if kept is None else kept for kept, own in zip(self.breaking_forces_n, thresholds, strict=True)]


def constraint_settings_of(scene: bpy.types.Scene) -> ConstraintSettings:
    """Read the connections of a scene."""
    connections = connections_of(scene)
    constraints = [connection.rigid_body_constraint for connection in connections]
    return ConstraintSettings(
        objects=tuple(connections),
        names=tuple(connection.name for connection in connections),
        bodies=[(_name(constraint.object1), _name(constraint.object2)) for constraint in constraints],
        positions_m=np.array([connection.matrix_basis.translation for connection in connections], float),
        constraint={name: [getattr(constraint, name) for constraint in constraints] for name in _CONSTRAINT},
        iterations=[
            constraint.solver_iterations if constraint.use_override_solver_iterations else 0
            for constraint in constraints
        ],
        breaking_forces_n=[kept_breaking_force(connection) for connection in connections],
    )


def _name(body: bpy.types.Object | None) -> str:
    return body.name if body else ""
