"""The ground of a scene as it is looked at: what the mouse is over, a site plan, and a survey of the debris."""

from __future__ import annotations

import math
from pathlib import Path

import bpy
import numpy as np
from mathutils import Vector

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.vectors import transformed, turn_in_plane
from ...engineering.terrain.surface import NamedSurface, RecordedGround, Surface
from ...errors import OutputError
from ...model.debris.survey import SurveyComparison
from ..bodies import bodies_of, is_uneven_ground, member_of, triangle_mesh
from ..collections import ROLE, collection_for, remove_marked
from .materials import new_nodes

_SITE_PLAN = "Site plan"
_ABOVE_M = 0.01
"""Above the ground, so that the two do not flicker."""

_PARTS = 128
"""Parts of a side where the ground is not flat, which the picture then follows."""


def ground_of(scene: bpy.types.Scene) -> RecordedGround:
    """Return the ground that was built in a scene, where it lies now."""
    terrain, surfaces = None, []
    for body in filter(is_uneven_ground, bodies_of(scene)):
        mesh, matrix = triangle_mesh(body.data), np.array(body.matrix_world, float)
        surface = Surface(TriangleMesh(transformed(matrix[:3, :3], mesh.vertices) + matrix[:3, 3], mesh.triangles))
        name, kind = member_of(body)
        if name:
            surfaces.append(NamedSurface(name, kind, surface))
        else:
            terrain = surface
    return RecordedGround(terrain, tuple(surfaces))


def terrain_under(scene: bpy.types.Scene, eye: Vector, ray: Vector) -> Vector | None:
    """Return where a ray meets the terrain of a scene, or a surface on it; None where it meets none."""
    points = []
    for body in filter(is_uneven_ground, bodies_of(scene)):
        back = body.matrix_world.inverted_safe()
        if body.visible_get():
            is_met, point, _, _ = body.ray_cast(back @ eye, back.to_3x3() @ ray)
            points += [body.matrix_world @ point] if is_met else []
    return min(points, key=lambda point: (point - eye).length, default=None)


def lay_site_plan(
    scene: bpy.types.Scene, path: Path, width_m: float, bearing_deg: float, origin: tuple[float, float]
) -> tuple[float, float]:
    """Lay a picture on the ground in place of the one that was there, and return its width and height there, m.

    It takes no part in the simulation.

    Parameters
    ----------
    bearing_deg
        Direction of the x axis, clockwise from the upward direction of the picture.
    origin
        Where the origin of the scene lies in it, as shares of its width and height, from its left and its foot.
    """
    image = _loaded(path)
    height_m = width_m * image.size[1] / image.size[0]
    remove_marked(scene, _SITE_PLAN)
    left, low = -origin[0] * width_m, -origin[1] * height_m
    ground, turn = ground_of(scene), turn_in_plane(math.radians(bearing_deg - 90.0))
    parts = 1 if ground.is_flat else _PARTS
    shares = np.stack(np.meshgrid(*2 * (np.linspace(0.0, 1.0, parts + 1),)), -1).reshape(-1, 2)
    points = shares * (width_m, height_m) + (left, low)
    corners = np.column_stack((points, ground.heights_at(transformed(turn, points))))
    first = (np.arange(parts)[:, None] * (parts + 1) + np.arange(parts)).ravel()
    faces = np.column_stack((first, first + 1, first + parts + 2, first + parts + 1))
    mesh = bpy.data.meshes.new("Site plan")
    mesh.from_pydata(corners.tolist(), [], faces.tolist())
    layer = mesh.uv_layers.new(name="Picture")
    for loop, share in zip(layer.data, shares[faces.ravel()].tolist(), strict=True):
        loop.uv = share
    mesh.materials.append(_material(image))
    plan = bpy.data.objects.new("Site plan", mesh)
    plan[ROLE] = _SITE_PLAN
    # The picture's upward direction lies at a bearing of 0, and the x axis so far clockwise from it.
    plan.location, plan.rotation_euler = (0.0, 0.0, _ABOVE_M), (0.0, 0.0, math.radians(bearing_deg - 90.0))
    plan.hide_select = True
    collection_for(scene, _SITE_PLAN).objects.link(plan)
    return width_m, height_m


def _loaded(path: Path) -> bpy.types.Image:
    try:
        image = bpy.data.images.load(str(path), check_existing=True)
    except RuntimeError as error:
        raise OutputError(f"{path}: Blender cannot read this picture; choose a PNG, JPEG or TIFF file") from error
    if not all(image.size):
        if not image.users:
            bpy.data.images.remove(image)
        raise OutputError(f"{path}: is no picture that Blender can read; choose a PNG, JPEG or TIFF file")
    return image


def _material(image: bpy.types.Image) -> bpy.types.Material:
    material = bpy.data.materials.new("Site plan")
    kinds = ("ShaderNodeTexImage", "ShaderNodeBsdfPrincipled", "ShaderNodeOutputMaterial")
    picture, shader, output = new_nodes(material, *kinds)
    picture.image = image
    shader.inputs["Roughness"].default_value = 1.0
    material.node_tree.links.new(picture.outputs["Color"], shader.inputs["Base Color"])
    material.node_tree.links.new(shader.outputs["BSDF"], output.inputs["Surface"])
    return material


SURVEY_ROLE = "Survey"

STEPS_M = (-1.0, -0.25, 0.25, 1.0)
"""Survey less forecast at which one colour ends and the next begins."""

_NAMES_AND_COLOURS = (
    ("Survey, more than 1 m lower", (0.02, 0.09, 0.40, 1.0)),
    ("Survey, 0.25 to 1 m lower", (0.15, 0.40, 0.75, 1.0)),
    ("Survey, as foreseen", (0.55, 0.55, 0.50, 1.0)),
    ("Survey, 0.25 to 1 m higher", (0.85, 0.35, 0.20, 1.0)),
    ("Survey, more than 1 m higher", (0.45, 0.02, 0.05, 1.0)),
)


def show_survey(scene: bpy.types.Scene, comparison: SurveyComparison, ground_m: np.ndarray) -> bpy.types.Object:
    """Show a survey over ground at heights (j, i), in place of one that was shown before; nothing is simulated with it.

    Cells without points have no face, and those without debris by either are as foreseen.
    """
    remove_marked(scene, SURVEY_ROLE)
    rows, columns = np.nonzero(np.isfinite(comparison.survey_m))
    heights = (comparison.survey_m + ground_m)[rows, columns]
    half = np.array([comparison.xs_m[1] - comparison.xs_m[0], comparison.ys_m[1] - comparison.ys_m[0]]) / 2.0
    middles = np.column_stack((comparison.xs_m[columns], comparison.ys_m[rows]))
    corners = [middles + half * np.array(way) for way in ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))]
    vertices = np.stack([np.column_stack((corner, heights)) for corner in corners], axis=1).reshape(-1, 3)
    mesh = bpy.data.meshes.new(SURVEY_ROLE)
    mesh.from_pydata(vertices.tolist(), [], np.arange(len(vertices)).reshape(-1, 4).tolist())
    for name, colour in _NAMES_AND_COLOURS:
        material = bpy.data.materials.new(name)
        material.diffuse_color = colour
        mesh.materials.append(material)
    off = np.nan_to_num(comparison.difference_m[rows, columns])
    mesh.polygons.foreach_set("material_index", np.searchsorted(STEPS_M, off).astype(np.int32))
    shown = bpy.data.objects.new(SURVEY_ROLE, mesh)
    shown[ROLE] = SURVEY_ROLE
    shown.hide_select = True
    collection_for(scene, SURVEY_ROLE).objects.link(shown)
    return shown
