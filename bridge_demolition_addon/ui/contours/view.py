"""Contours as the sidebar's settings ask for them, and the 3D views that show them."""

from collections.abc import Iterator

import bpy

from ...display.colour_scale import ColourMap
from ...display.contour_quantities import ContourQuantity
from ...display.contour_ranges import ContourSettings, RangeKind
from ...errors import DemolitionError
from ...scene.rendering.body_colours import SHADED_LIGHT
from ...simulation.blender_events import contours_of, shown_results

_COLOURS_BEFORE = "bda_colours_before"

_refusals: dict[int, str] = {}
"""Why settings cannot be shown, by scenes."""


def settings_of(scene: bpy.types.Scene) -> ContourSettings:
    """Return what the sidebar's settings ask for."""
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
    redraw()


def trouble(scene: bpy.types.Scene) -> str:
    """Return why contours cannot be shown as asked for; empty where they can."""
    contours = contours_of(scene)
    shown = contours.settings
    if shown and shown.quantity is ContourQuantity.UTILISATION and contours.stages is None:
        return "Utilisation at rest is that of stages: check them first, in the panel Stages"
    return _refusals.get(scene.session_uid) or (str(contours.error) if contours.error else shown_results(scene).missing)


def follow_later(scene: bpy.types.Scene) -> None:
    """Follow settings that were undone, redone or loaded, once Blender has finished its present drawing."""
    if scene.bda.contours != contours_of(scene).is_shown and scene.session_uid not in _refusals:
        _schedule()


def redraw() -> None:
    """Redraw the 3D views."""
    for area in _views(None):
        area.tag_redraw()


def register() -> None:
    """Nothing is shown until the box is ticked."""


def unregister() -> None:
    """Show everything as it was, in all scenes."""
    if bpy.app.timers.is_registered(_follow_all):
        bpy.app.timers.unregister(_follow_all)
    for scene in bpy.data.scenes:
        contours_of(scene).hide()
        shown_results(scene).forget()
        _show_materials_in_views(scene)
    _refusals.clear()


def _schedule() -> None:
    if not bpy.app.timers.is_registered(_follow_all):
        bpy.app.timers.register(_follow_all, first_interval=0.0)


def _follow_all() -> None:
    for scene in bpy.data.scenes:
        if scene.bda.contours != contours_of(scene).is_shown:
            follow(scene)


def _show_colours_in_views(scene: bpy.types.Scene) -> None:
    """Make solid 3D views show the objects' colours, flat if asked for; each screen keeps what was set before."""
    for area in _views(scene):
        screen, number = area.id_data, str(list(area.id_data.areas).index(area))
        before = screen.get(_COLOURS_BEFORE, {})
        before = before if isinstance(before, dict) else before.to_dict()
        shading = area.spaces.active.shading
        if number not in before:
            screen[_COLOURS_BEFORE] = {**before, number: [shading.color_type, shading.light]}
        shading.color_type, shading.light = "OBJECT", SHADED_LIGHT if scene.bda.contour_shaded else "FLAT"


def _show_materials_in_views(scene: bpy.types.Scene) -> None:
    for area in _views(scene):
        screen, number = area.id_data, str(list(area.id_data.areas).index(area))
        before = screen[_COLOURS_BEFORE].to_dict() if _COLOURS_BEFORE in screen else {}
        if number in before:
            shading = area.spaces.active.shading
            shading.color_type, shading.light = before.pop(number)
        if before:
            screen[_COLOURS_BEFORE] = before
        elif _COLOURS_BEFORE in screen:
            del screen[_COLOURS_BEFORE]


def _views(scene: bpy.types.Scene | None) -> Iterator[bpy.types.Area]:
    """Return the 3D views that show a scene, or all of them for None."""
    for manager in bpy.data.window_managers:
        for window in manager.windows:
            if scene is None or window.scene == scene:
                yield from (area for area in window.screen.areas if area.type == "VIEW_3D")
