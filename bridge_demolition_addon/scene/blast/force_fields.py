"""Force-field empties that push one body each, and how far a field acts.

The loads of a frame are written into Blender's evaluated copies of the empties. The strength of the empties stays 0: so
no undo, crash or saved file leaves one switched on, and the frames that Blender has cached stay valid.

A field pushes along one direction, within a cylinder about it. The body has to stay inside while it moves in a frame,
and every other body outside; so the radius and both ends are a part of the way to the nearest body.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import bpy
import numpy as np
from mathutils import Matrix, Vector

from ...engineering.geometry.vectors import dot, length
from ...errors import SimulationError
from ..collections import collection_for, find_collection

SHARE_OF_WAY = 0.45
"""Part of the way to a neighbour over which a field acts: less than half, as the neighbour may come nearer too."""

WIDEST_M = 5.0
LONGEST_M = 20.0
"""Limits where no neighbour is near: more than a body moves in a frame."""

_PAIRS_AT_ONCE = 2_000_000


@dataclass(frozen=True, eq=False, slots=True)
class FieldReach:
    """Cylinders about the centres of k bodies: radii (k,), lengths (k,) along the direction and against it."""

    radii_m: np.ndarray
    ahead_m: np.ndarray
    behind_m: np.ndarray

    def contain(self, moves_m: np.ndarray, directions: np.ndarray) -> np.ndarray:
        """Return whether bodies moved by (k, 3), m, are still inside their cylinders about directions (k, 3)."""
        along = dot(moves_m, directions)
        across = length(moves_m - along[:, None] * directions)
        return (across < self.radii_m) & (along < self.ahead_m) & (along > -self.behind_m)


def isolating_reaches(bodies: np.ndarray, directions: np.ndarray, centres: np.ndarray) -> FieldReach:
    """Return cylinders about k bodies; none contains the centre of another body.

    Each of the bodies (k,) is pushed along a unit vector (k, 3); all n bodies have centres of mass (n, 3), m.
    """
    reaches = FieldReach(*(np.full(len(bodies), limit_m) for limit_m in (WIDEST_M, LONGEST_M, WIDEST_M)))
    rows = max(1, _PAIRS_AT_ONCE // max(1, len(centres)))
    for first in range(0, len(bodies), rows):
        block = slice(first, first + rows)
        between = centres[None] - centres[bodies[block], None]
        squares = dot(between, between)
        squares[np.arange(len(squares)), bodies[block]] = np.inf
        along = dot(between, directions[block, None])
        radii = np.minimum(WIDEST_M, SHARE_OF_WAY * np.sqrt(squares.min(axis=1, initial=np.inf)))
        in_line = squares - np.square(along) < np.square(2.0 * radii[:, None])
        # It may come nearer from the side as well.
        ahead = np.where(in_line & (along > 0.0), along, np.inf).min(axis=1, initial=np.inf)
        behind = np.where(in_line & (along <= 0.0), -along, np.inf).min(axis=1, initial=np.inf)
        reaches.radii_m[block] = radii
        reaches.ahead_m[block] = np.minimum(LONGEST_M, SHARE_OF_WAY * ahead)
        reaches.behind_m[block] = np.minimum(WIDEST_M, SHARE_OF_WAY * behind)
    return reaches


_ROLE = "Force objects"
_BODY = "bda_pushed_body"
_SYMBOL_SIZE_M = 0.2
_FLOAT32 = 1e-6


@dataclass(frozen=True, slots=True)
class BuildCount:
    """How many force fields were made, kept and removed."""

    made: int
    kept: int
    removed: int


def build_force_objects(scene: bpy.types.Scene, bodies: Iterable[bpy.types.Object]) -> BuildCount:
    """Give each body one force field, and remove the fields of bodies that are gone."""
    pushed = [body for body in bodies if body.rigid_body.type == "ACTIVE"]
    if not pushed:
        raise SimulationError("no active body to push: give the bridge's shards an active rigid body first")
    existing = force_objects(scene)
    wanted = set(pushed)
    gone = [field for body, field in existing.items() if body not in wanted] + _orphans(scene)
    bpy.data.batch_remove(gone)
    missing = [body for body in pushed if body not in existing]
    _make(scene, missing)
    return BuildCount(len(missing), len(pushed) - len(missing), len(gone))


def force_collection(scene: bpy.types.Scene) -> bpy.types.Collection | None:
    """Return the collection of force fields, if there is one."""
    return find_collection(scene, _ROLE)


def force_objects(scene: bpy.types.Scene) -> dict[bpy.types.Object, bpy.types.Object]:
    """Return the force field of each body that has one."""
    return {field[_BODY]: field for field in _all(scene) if isinstance(field[_BODY], bpy.types.Object)}


def has_other_fields(scene: bpy.types.Scene) -> bool:
    """Return whether anything else in a scene may push bodies: a field of the user's own, or particles."""
    ours = set(_all(scene))
    return any(
        (obj.field and obj.field.type != "NONE" and obj not in ours) or obj.particle_systems for obj in scene.objects
    )


def fields_of(scene: bpy.types.Scene, bodies: Sequence[bpy.types.Object]) -> list[bpy.types.Object]:
    """Return the force fields of bodies, in their order."""
    existing = force_objects(scene)
    lacking = [body.name for body in bodies if body not in existing]
    if lacking:
        more = f" and {len(lacking) - 1} more" if len(lacking) > 1 else ""
        raise SimulationError(f"body {lacking[0]!r}{more} has no force field: build the force fields again")
    return [existing[body] for body in bodies]


class ForceFields:
    """The force fields of n bodies, as they push in the coming frame."""

    def __init__(self, scene: bpy.types.Scene, bodies: Sequence[bpy.types.Object]):
        self._scene = scene
        self._fields = fields_of(scene, bodies)
        self._names = [field.name for field in self._fields]
        self._pushing: list[tuple[bpy.types.Object, float]] = []

    def push(
        self, rows: np.ndarray, forces_n: np.ndarray, directions: np.ndarray, centres: np.ndarray, reaches: FieldReach
    ) -> None:
        """Let the fields of k bodies push in the coming frame, and no other.

        Forces (k,), N, act along unit vectors (k, 3) on bodies with centres (k, 3), m.
        """
        self.rest()
        # Blender pushes a rigid body with the strength over the frame rate, whatever its base or the time scale.
        strengths = forces_n * self._scene.render.fps
        limits = np.column_stack((reaches.radii_m, reaches.ahead_m, reaches.behind_m)).tolist()
        columns = zip(rows.tolist(), strengths.tolist(), directions, centres, limits, strict=True)
        for row, strength, direction, centre, (radius, ahead, behind) in columns:
            matrix = _along(direction, centre - behind * direction)
            copies = self._evaluated(self._fields[row])
            if not copies:
                raise SimulationError(
                    f"force field {self._names[row]!r} is deleted, switched off or excluded from the view layer: "
                    "build the force fields again or switch it on, or apply the blast directly"
                )
            for evaluated in copies:
                evaluated.matrix_world = matrix
                evaluated.field.radial_max, evaluated.field.distance_max = radius, behind + ahead
                evaluated.field.strength = strength
            self._pushing.append((self._fields[row], strength))

    def still_push(self) -> bool:
        """Return whether the fields that were to push are there, and did so to the end of the frame."""
        return all(self._pushes(*push) for push in self._pushing)

    def rest(self) -> None:
        """Let no field push."""
        for field, _ in self._pushing:
            for evaluated in self._evaluated(field):
                evaluated.field.strength = 0.0
        self._pushing = []

    def _pushes(self, field: bpy.types.Object, strength: float) -> bool:
        copies = self._evaluated(field)
        return bool(copies) and all(abs(copy.field.strength - strength) <= _FLOAT32 * strength for copy in copies)

    def _evaluated(self, field: bpy.types.Object) -> list[bpy.types.Object]:
        """Return Blender's evaluated copies of a field; none where it was deleted."""
        graphs = [layer.depsgraph for layer in self._scene.view_layers if layer.depsgraph]
        try:
            copies = [field.evaluated_get(graph) for graph in graphs]
        except ReferenceError:
            return []
        return [copy for copy in copies if copy.is_evaluated]  # for an object that it leaves out, a graph returns it


def _all(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    collection = find_collection(scene, _ROLE)
    return [obj for obj in collection.objects if _BODY in obj] if collection else []


def _orphans(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """Return force fields without a body, or of a body that has another."""
    first = set(force_objects(scene).values())
    return [field for field in _all(scene) if field not in first]


def _make(scene: bpy.types.Scene, bodies: Sequence[bpy.types.Object]) -> None:
    if not bodies:
        return
    collection = collection_for(scene, _ROLE)
    template = _template(scene)
    scene.collection.children.unlink(collection)  # linking to a shown collection brings the scene up to date each time
    for body in bodies:
        field = template.copy()
        field.location = body.matrix_world.translation
        field[_BODY] = body
        collection.objects.link(field)
    scene.collection.children.link(collection)
    bpy.data.objects.remove(template)


def _template(scene: bpy.types.Scene) -> bpy.types.Object:
    """Return an empty whose field pushes along its own z, within a cylinder, and does not push yet."""
    if not bpy.ops.object.effector_add.poll():
        raise SimulationError("Blender makes no fields now: go to object mode first, or apply the blast directly")
    selected, active = list(bpy.context.selected_objects), bpy.context.view_layer.objects.active
    with bpy.context.temp_override(scene=scene):
        bpy.ops.object.effector_add(type="FORCE")  # the only way to an object with a field
    template = bpy.context.view_layer.objects.active
    template.select_set(False)  # its copies would be selected as well, to be moved or deleted by the next key
    for obj in selected:
        obj.select_set(True)
    bpy.context.view_layer.objects.active = active
    template.name = "Force object"
    template.empty_display_type, template.empty_display_size = "SINGLE_ARROW", _SYMBOL_SIZE_M
    field = template.field
    field.shape = "PLANE"
    field.falloff_type, field.z_direction = "TUBE", "POSITIVE"
    field.falloff_power = field.radial_falloff = 0.0
    field.use_max_distance = field.use_radial_max = True
    field.strength = field.flow = field.noise = 0.0
    return template


def _along(direction: np.ndarray, position: np.ndarray) -> Matrix:
    """Return axes at a position whose z lies along a direction."""
    matrix = Vector(direction).to_track_quat("Z", "Y").to_matrix().to_4x4()
    matrix.translation = position
    return matrix
