"""Settings of contours, vectors and films, kept in the scene as part of ``scene.bda``."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from ...display.colour_scale import ColourMap
from ...display.contour_quantities import ContourQuantity
from ...display.contour_ranges import RangeKind
from ...model.blast.damage import THRESHOLDS
from ...simulation.display.film import FilmKind
from ..sidebar import path_property
from ..viewport import redraw_views
from . import view as contour_view

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
    contour_view.follow(settings.id_data)


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
