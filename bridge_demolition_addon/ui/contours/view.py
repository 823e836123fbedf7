"""Contours as the sidebar's settings ask for them, and the 3D views that show them."""

from collections.abc import Iterator

import bpy

from ...display.colour_scale import ColourMap
from ...display.contour_quantities import ContourQuantity
from ...display.contour_ranges import ContourSettings, RangeKind
from ...errors import DemolitionError
from ...scene.rendering.body_colours import SHADED_LIGHT
from ...simulation.blender_events import contours_of, shown_results
from ..viewport import redraw_views

_COLOURS_BEFORE = "bda_colours_before"

_refusals: dict[int, str] = {}
"""Why settings cannot be shown, by scenes."""


def settings_of(scene: bpy.types.Scene) -> ContourSettings:
    """Return the contours that the sidebar's settings ask for."""
    settings = scene.bda
    quantity = ContourQuantity[settings.contour_quantity]
    size = quantity.units.of_range.size
    return ContourSettings(
        quantity=quantity,
        peak=settings.contour_peak,
        range_kind=RangeKind[settings.contour_range],
        low=settings.contour_low * size,
        high=settings.contour_high * size,
        logarithmic=settings.contour_logarithmic,
        decades=settings.contour_decades,
        whole_run=settings.contour_whole_run,
        percentile=settings.contour_percentile,
        shaded=settings.contour_shaded,
        colour_map=ColourMap[settings.contour_map],
        magnification=settings.contour_magnification,
    )


def follow(scene: bpy.types.Scene) -> None:
    """Show contours, or stop showing them, as the scene's settings are now."""
    _refusals.pop(scene.session_uid, None)
    if scene.bda.contours:
        try:
            contours_of(scene).show(settings_of(scene))
        except DemolitionError as error:
            _refusals[scene.session_uid] = str(error)
        _show_colours_in_views(scene)
    else:
        contours_of(scene).hide()
        _show_materials_in_views(scene)
    redraw_views()


def refusal(scene: bpy.types.Scene) -> str:
    """Return why contours cannot be shown as asked for; empty where they can."""
    contours = contours_of(scene)
    shown = contours.settings
    if shown and shown.quantity is ContourQuantity.UTILISATION and contours.stages is None:
        return "Utilisation at rest is that of stages: check them first, in the panel Stages"
    return _refusals.get(scene.session_uid) or (str(contours.error) if contours.error else shown_results(scene).missing)


def follow_later(scene: bpy.types.Scene) -> None:
    """Follow settings that were undone, redone or loaded, once Blender has finished its present drawing."""
    is_late = scene.bda.contours != contours_of(scene).is_shown and scene.session_uid not in _refusals
    if is_late and not bpy.app.timers.is_registered(_follow_all):
        bpy.app.timers.register(_follow_all, first_interval=0.0)


def unregister() -> None:
    """Show everything as it was, in all scenes."""
    if bpy.app.timers.is_registered(_follow_all):
        bpy.app.timers.unregister(_follow_all)
    for scene in bpy.data.scenes:
        contours_of(scene).hide()
        shown_results(scene).forget()
        _show_materials_in_views(scene)
    _refusals.clear()


def _follow_all() -> None:
    for scene in bpy.data.scenes:
        if scene.bda.contours != contours_of(scene).is_shown:
            follow(scene)


def _show_colours_in_views(scene: bpy.types.Scene) -> None:
    """Make solid 3D views show the objects' colours, flat if asked for; each screen keeps its settings before."""
    for screen, number, before, shading in _shadings(scene):
        if number not in before:
            screen[_COLOURS_BEFORE] = {**before, number: [shading.color_type, shading.light]}
        shading.color_type, shading.light = "OBJECT", SHADED_LIGHT if scene.bda.contour_shaded else "FLAT"


def _show_materials_in_views(scene: bpy.types.Scene) -> None:
    for screen, number, before, shading in _shadings(scene):
        if number in before:
            shading.color_type, shading.light = before.pop(number)
        if before:
            screen[_COLOURS_BEFORE] = before
        elif _COLOURS_BEFORE in screen:
            del screen[_COLOURS_BEFORE]


def _shadings(scene: bpy.types.Scene) -> Iterator[tuple[bpy.types.Screen, str, dict, bpy.types.View3DShading]]:
    """Give screen, number, settings that were kept, and shading of each 3D view that shows a scene."""
    windows = (window for manager in bpy.data.window_managers for window in manager.windows)
    for screen in (window.screen for window in windows if window.scene == scene):
        for number, area in enumerate(screen.areas):
            if area.type == "VIEW_3D":
                before = screen[_COLOURS_BEFORE].to_dict() if _COLOURS_BEFORE in screen else {}
                yield screen, str(number), before, area.spaces.active.shading
