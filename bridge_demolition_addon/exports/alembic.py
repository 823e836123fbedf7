"""A run as Alembic, by Blender's own exporter, which takes it from objects with keyframes."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import bpy
import numpy as np

from ..engineering.geometry.mesh import TriangleMesh
from ..errors import MissingLibraryError
from ..model.results.arrays import Results
from ..scene.tools.keyframes import key_values
from .shapes import body_meshes, frame_rate, quaternions


def write_alembic(results: Results, path: Path, tell: Callable[[int, int, str], None]) -> None:
    """Write a run from a new Blender file: a frame for each recorded one, however long it lasted.

    `tell` gets how many frames are written, of how many, and a text.
    """
    if not bpy.app.build_options.alembic:
        raise MissingLibraryError(
            f"this Blender, {bpy.app.version_string}, was built without Alembic: use one from blender.org"
        )
    # Not the factory's preferences too: with them Blender deletes the libraries of the user's extensions.
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene, numbers = bpy.context.scene, results.frames.number
    _set_rate(scene, results)
    named = zip(results.inventory.body_names.tolist(), body_meshes(results.inventory), strict=True)
    for body, (name, mesh) in enumerate(named):
        _add(scene, name, mesh, numbers, results.frames.positions_m[:, body], results.frames.rotations[:, body])
    left = numbers.tolist()

    def count(shown: bpy.types.Scene, _: bpy.types.Depsgraph) -> None:
        if shown.frame_current in left:  # once: Blender looks at some twice, and goes back to where it was
            left.remove(shown.frame_current)
            tell(len(numbers) - len(left), len(numbers), "frames written")

    bpy.app.handlers.frame_change_post.append(count)
    bpy.ops.wm.alembic_export(
        filepath=str(path),
        start=int(numbers[0]),
        end=int(numbers[-1]),
        uvs=False,
        normals=False,
        face_sets=False,
        export_hair=False,
        export_particles=False,
        as_background_job=False,
    )


def _set_rate(scene: bpy.types.Scene, results: Results) -> None:
    per_second = frame_rate(results)
    scene.render.fps = max(1, round(per_second))
    scene.render.fps_base = scene.render.fps / per_second
    scene.frame_start, scene.frame_end = int(results.frames.number[0]), int(results.frames.number[-1])


def _add(
    scene: bpy.types.Scene,
    name: str,
    solid: TriangleMesh,
    numbers: np.ndarray,
    positions_m: np.ndarray,
    rotations: np.ndarray,
) -> None:
    """Add a body with a key in every frame, and with its origin at its centre of mass."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(solid.vertices, [], solid.triangles.tolist())
    body = bpy.data.objects.new(name, mesh)
    scene.collection.objects.link(body)
    body.rotation_mode = "QUATERNION"
    key_values(body, "location", numbers, positions_m)
    key_values(body, "rotation_quaternion", numbers, quaternions(rotations))
