"""Settings of contours, vectors and films, and the 3D views that follow them."""

from collections.abc import Iterator

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from ...display.colour_scale import ColourMap
from ...display.contour_quantities import ContourQuantity
from ...display.contours import ContourSettings, RangeKind
from ...errors import DemolitionError
from ...model.blast.receptors import THRESHOLDS
from ...scene.rendering.body_colours import SHADED_LIGHT
from ...simulation.blender_events import contours_of, shown_results
from ...simulation.display.film import FilmKind
from ..sidebar import path_property
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


_QUANTITIES = tuple((quantity.name, quantity.title, quantity.tooltip) for quantity in ContourQuantity)
_RANGES = (
    (RangeKind.RUN.name, "Whole Run", "From the lowest to the highest value of all frames recorded so far"),
    (RangeKind.FRAME.name, "Each Frame", "From the lowest to the highest value of each frame by itself"),
    (RangeKind.FIXED.name, "Fixed", "The range given below"),
)
_MAPS = (
    (ColourMap.BLUE_TO_RED.name, "2019", "Blue for low, over green, to red for high"),
    (ColourMap.VIRIDIS.name, "Viridis", "Even to the eye, from violet over green to yellow"),
    (ColourMap.CIVIDIS.name, "Cividis", "Even to the eye, also for colour-blind people"),
    (ColourMap.INFERNO.name, "Inferno", "Even to the eye, from black over red to yellow"),
)
_VECTORS = (
    ("BODIES", "Bodies", "Resultant of all connections and contacts of each body, without gravity"),
    ("CONNECTIONS", "Connections", "Force of each connection that holds, on its first body"),
    ("CONTACTS", "Contacts", "Mean force of all contacts of each body"),
)
_DAMAGES = tuple(
    (str(number), threshold.damage, f"{threshold.overpressure_pa / 1e3:g} kPa, {threshold.source}")
    for number, threshold in enumerate(THRESHOLDS)
)
_KINDS = (
    (FilmKind.FILM.name, "Film", "One MP4 film"),
    (FilmKind.PICTURES.name, "Pictures", "One PNG picture for each recorded frame"),
)


def _follow(settings: bpy.types.PropertyGroup, _context: bpy.types.Context) -> None:
    follow(settings.id_data)


class ContourProperties:
    """The part of the scene's settings on contours, vectors and films."""

    contours: BoolProperty(
        name="Contours",
        description="Colour the bodies by their forces or stresses while the timeline plays and afterwards",
        default=False,
        update=_follow,
    )
    contour_quantity: EnumProperty(
        name="Quantity", description="What the bodies are coloured by", items=_QUANTITIES, update=_follow
    )
    contour_peak: BoolProperty(
        name="Peak So Far",
        description="Show the largest value up to the frame: of forces the peak of all sub-steps, as in Results. In an "
        "impact that is many times the mean over its frame",
        update=_follow,
    )
    contour_whole_run: BoolProperty(
        name="Of Whole Run",
        description="Show the largest value of all frames in every frame: at the start, where the bridge will be "
        "loaded most",
        update=_follow,
    )
    contour_range: EnumProperty(
        name="Range", description="What the lowest and highest colour stand for", items=_RANGES, update=_follow
    )
    contour_low: FloatProperty(
        name="Lowest",
        description="Low end of the fixed range, kN, N/mm², mm or %, such as 1",
        default=1.0,
        update=_follow,
    )
    contour_high: FloatProperty(
        name="Highest",
        description="High end of the fixed range, kN, N/mm², mm or %, such as 1000 kN",
        default=1000.0,
        update=_follow,
    )
    contour_logarithmic: BoolProperty(
        name="Logarithmic",
        description="Equal steps of colour stand for equal ratios, so that weight and impact can be seen in one "
        "picture; signs are left out",
        default=True,
        update=_follow,
    )
    contour_decades: FloatProperty(
        name="Decades",
        description="Powers of ten from the lowest to the highest value of an automatic logarithmic range, such as 3",
        default=3.0,
        min=0.5,
        max=12.0,
        update=_follow,
    )
    contour_percentile: FloatProperty(
        name="Percentile",
        description="Share of the values other than 0 that lie within an automatic range, such as 98; the few beyond "
        "it have the colour of its end",
        default=100.0,
        min=50.0,
        max=100.0,
        subtype="PERCENTAGE",
        update=_follow,
    )
    contour_map: EnumProperty(
        name="Colours", description="Colour map", items=_MAPS, default=ColourMap.VIRIDIS.name, update=_follow
    )
    contour_shaded: BoolProperty(
        name="Shaded",
        description="Make faces darker the more they look away from the light; without it each colour is exactly "
        "that of the bar",
        default=True,
        update=_follow,
    )
    contour_magnification: FloatProperty(
        name="Magnify Shape",
        description="How many times as far as they are displaced bodies are shown, once the recording has ended: 1 "
        "as it is, 100 for displacements of millimetres",
        default=1.0,
        min=1.0,
        max=1e6,
        soft_max=1000.0,
        update=_follow,
    )
    colour_bar: BoolProperty(
        name="Colour Bar", description="Show the colour bar in the 3D view", default=True, update=redraw_views
    )
    results_path: path_property("Kept Results", "File results.npz of an earlier recording, or its folder")
    show_vectors: BoolProperty(
        name="Force Vectors", description="Show forces as arrows in the 3D view", default=False, update=redraw_views
    )
    vectors: EnumProperty(
        name="Vectors",
        description="Which forces",
        items=_VECTORS,
        options={"ENUM_FLAG"},
        default={"BODIES"},
        update=redraw_views,
    )
    vector_length_m: FloatProperty(
        name="Longest",
        description="Length of the arrow of the largest force of the frame, over all kinds of vectors, such as 2 m",
        default=2.0,
        min=0.01,
        unit="LENGTH",
        update=redraw_views,
    )
    show_charges: BoolProperty(
        name="Charges",
        description="Show names and masses of the charges in the 3D view",
        default=False,
        update=redraw_views,
    )
    show_rings: BoolProperty(
        name="Stand-off Rings",
        description="Show how far from each charge a kind of damage reaches, on the ground at height 0",
        default=False,
        update=redraw_views,
    )
    ring_damage: EnumProperty(
        name="Damage", description="What the rings stand for", items=_DAMAGES, default="1", update=redraw_views
    )
    film_directory: path_property("Film", "Folder for the pictures or the film; it is made if new", "DIR_PATH")
    film_kind: EnumProperty(name="Make", description="What is rendered", items=_KINDS)
    film_slowness: FloatProperty(
        name="Slower By",
        description="Seconds of film for a second of the simulation: 1 is real time",
        default=1.0,
        min=0.01,
        max=1000.0,
    )
    film_rate: IntProperty(
        name="Pictures a Second", description="Pictures in a second of the film, such as 25", default=25, min=1, max=120
    )
    film_width: IntProperty(
        name="Width", description="Width of the film, even, such as 1280", default=1280, min=320, subtype="PIXEL"
    )
    film_height: IntProperty(
        name="Height", description="Height of the film, even, such as 720", default=720, min=180, subtype="PIXEL"
    )
