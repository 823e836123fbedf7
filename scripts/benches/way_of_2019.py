# SPDX-License-Identifier: GPL-3.0-or-later
"""What the add-on of 2019 did in every frame, to compare with: forces and colours, and blast by force fields."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import bpy
import numpy as np

from bridge_demolition_addon.scene.bodies import bodies_of

LEVELS = 200
"""Materials for colours."""


@contextmanager
def _after_frames(function: Callable) -> Iterator[None]:
    bpy.app.handlers.frame_change_post.append(function)
    yield
    bpy.app.handlers.frame_change_post.remove(function)


def forces_and_colours(log: Path):
    """Go through all objects in Python, log a line per body and give each body one of many materials.

    The force of a connection, which only a patched Blender of its time gave, is replaced by a number that any Blender
    has; it costs the same to read.
    """
    materials = [bpy.data.materials.new(f"Level {level}") for level in range(LEVELS)]

    def after(scene: bpy.types.Scene, _depsgraph: bpy.types.Depsgraph) -> None:
        forces: dict[str, float] = {}
        for body in bpy.data.objects:
            constraint = body.rigid_body_constraint
            if constraint:
                first, second, force = constraint.object1.name, constraint.object2.name, constraint.breaking_threshold
                forces[first] = forces.get(first, 0.0) + force
                forces[second] = forces.get(second, 0.0) - force
        with log.open("a", encoding="utf-8") as file:
            for name, force in forces.items():
                file.write(f"{name}:{force}\n")
        for number, name in enumerate(forces):
            slots = bpy.data.objects[name].data.materials
            material = materials[(number + scene.frame_current) % LEVELS]
            if slots:
                slots[0] = material
            else:
                slots.append(material)

    return _after_frames(after)


@contextmanager
def blast_by_fields(scene: bpy.types.Scene, source_m: np.ndarray) -> Iterator[None]:
    """Keep three tube fields for each body switched on, and add up its area by a loop over its faces."""
    shards = [body for body in bodies_of(scene) if body.rigid_body.type == "ACTIVE"]
    bpy.ops.object.effector_add(type="FORCE")
    template = bpy.context.object
    template.field.falloff_type, template.field.use_max_distance, template.field.use_radial_max = "TUBE", True, True
    template.field.distance_max, template.field.radial_max, template.field.strength = 5.0, 2.0, 1e-9
    fields = [template.copy() for _ in shards for _ in range(3)]
    collection = bpy.data.collections.new("Fields")
    for field in fields:
        collection.objects.link(field)
    scene.collection.children.link(collection)

    def before(_scene: bpy.types.Scene, _depsgraph: bpy.types.Depsgraph | None = None) -> None:
        for row, body in enumerate(shards):
            position = np.array(body.matrix_world.translation)
            direction = (position - source_m) / np.linalg.norm(position - source_m)
            area = 0.0
            for polygon in body.data.polygons:
                area += 0.5 * abs(float(np.array(polygon.normal) @ direction)) * polygon.area
            for field in fields[3 * row : 3 * row + 3]:
                field.location, field.field.strength = position, 1e-9 * area

    bpy.app.handlers.frame_change_pre.append(before)
    yield
    bpy.app.handlers.frame_change_pre.remove(before)
