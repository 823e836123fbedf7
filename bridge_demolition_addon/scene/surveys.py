"""A survey of the debris in the 3D view: a surface of cells at their heights, coloured by survey less forecast."""

from __future__ import annotations

import bpy
import numpy as np

from ..model.debris.survey import SurveyComparison
from .collections import ROLE, collection_for, remove_marked

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
