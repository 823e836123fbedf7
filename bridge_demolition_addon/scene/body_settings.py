"""Bodies as Blender simulates them: which there are, where they are, and how they move and touch."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from .bodies import Kind, bodies_of, is_marked, kind_of, member_of
from .tools.ball import lifts_of
from .tools.keyframes import curves_of, keyframes_of

_RIGID = (
    *("type", "collision_shape", "enabled", "mass", "friction", "restitution", "linear_damping", "angular_damping"),
    *("use_deactivation", "use_start_deactivated", "deactivate_linear_velocity", "deactivate_angular_velocity"),
    *("use_margin", "collision_margin"),
)
"""Blender's properties of a rigid body that decide how it moves."""


@dataclass(frozen=True, slots=True, eq=False)
class BodySettings:
    """The n bodies of a scene's rigid-body world.

    Attributes
    ----------
    is_marked : (n,) bool
        Whether the add-on made a body.
    matrices, own_matrices : (n, 4, 4) float
        Where a body is in the frame in which this was read, and where its own location and rotation put it.
    boxes_m : (n, 8, 3) float
        Corners of its bounding box, in its own axes.
    layers : sequence of tuple of bool
        Collision collections.
    rigid : mapping of str to list
        Properties of its rigid body by Blender's names.
    keys : (k,) float
        Keyframes of the bodies except balls that are lifted: a run lifts these from where they lie.
    """

    objects: tuple[bpy.types.Object, ...]
    names: tuple[str, ...]
    kinds: tuple[Kind, ...]
    members: tuple[str, ...]
    is_marked: np.ndarray
    is_animated: np.ndarray
    matrices: np.ndarray
    own_matrices: np.ndarray
    boxes_m: np.ndarray
    vertex_counts: np.ndarray
    layers: Sequence[tuple[bool, ...]]
    rigid: Mapping[str, Sequence[Any]]
    keys: np.ndarray

    def __len__(self) -> int:
        return len(self.objects)

    @property
    def positions_m(self) -> np.ndarray:
        """Positions (n, 3) of their origins."""
        return self.matrices[:, :3, 3]

    @property
    def rotations(self) -> np.ndarray:
        """Rotations (n, 3, 3), scaled as the bodies are."""
        return self.matrices[:, :3, :3]

    def of_kind(self, kind: Kind) -> list[int]:
        """Return the rows of bodies of a kind."""
        return [row for row, other in enumerate(self.kinds) if other == kind]

    def common(self, name: str, rows: Sequence[int]) -> list[Any]:
        """Return the different values that bodies have of a property."""
        return list({self.rigid[name][row] for row in rows})


def body_settings_of(scene: bpy.types.Scene) -> BodySettings:
    """Read the bodies of a scene."""
    bodies = bodies_of(scene)
    return BodySettings(
        objects=tuple(bodies),
        names=tuple(body.name for body in bodies),
        kinds=tuple(map(kind_of, bodies)),
        members=tuple(member_of(body)[0] for body in bodies),
        is_marked=np.array([is_marked(body) for body in bodies], bool),
        is_animated=np.array([bool(body.animation_data) for body in bodies], bool),
        matrices=np.array([body.matrix_world for body in bodies], float).reshape(-1, 4, 4),
        own_matrices=np.array([body.matrix_basis for body in bodies], float).reshape(-1, 4, 4),
        boxes_m=np.array([body.bound_box for body in bodies], float).reshape(-1, 8, 3),
        vertex_counts=np.array([len(body.data.vertices) for body in bodies], int),
        layers=[tuple(body.rigid_body.collision_collections) for body in bodies],
        rigid={name: [getattr(body.rigid_body, name) for body in bodies] for name in _RIGID},
        keys=np.concatenate([np.zeros(0), *map(_keys, bodies)]),
    )


def _keys(body: bpy.types.Object) -> np.ndarray:
    if not (body.animation_data and body.animation_data.action) or lifts_of(body):
        return np.zeros(0)
    return np.concatenate([np.zeros(0), *(keyframes_of(curve).ravel() for curve in curves_of(body.animation_data))])
