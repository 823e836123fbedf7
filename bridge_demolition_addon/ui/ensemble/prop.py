"""Settings of the panels Study, Search and Optimise, apart from the keys of their files, which come from the schema."""

import logging
import os

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from ..sidebar import path_property
from ..viewport import redraw_views

_CONSOLE = logging.getLogger(__name__)

CHARGES, BALL_MASS, DROP_HEIGHT, ANOTHER_KEY = "CHARGES", "BALL_MASS", "DROP_HEIGHT", "ANOTHER_KEY"
KEYS = {CHARGES: "charges.mass_kg", BALL_MASS: "ball.mass_kg", DROP_HEIGHT: "ball.drop_height_m"}
"""Keys of the quantities that are searched along most."""

COLLAPSED, SPAN_DOWN, AS_IN_STUDY = "COLLAPSED", "SPAN_DOWN", "AS_IN_STUDY"

_QUANTITIES = (
    (CHARGES, "Factor on All Charges", "How many times as heavy all charges are as in the panels"),
    (BALL_MASS, "Mass of Ball", "Mass of the ball, kg"),
    (DROP_HEIGHT, "Drop Height", "Height that the ball drops from, m"),
    (ANOTHER_KEY, "Another Key", "Any number of the scenario, by its key"),
)
_CRITERIA = (
    (COLLAPSED, "Collapsed", "The shards' common centre of mass loses half of its height"),
    (SPAN_DOWN, "Span Down", "The centre of mass of one span loses half of its height"),
    (AS_IN_STUDY, "As in Study", "All criteria of the panel Study"),
)
_EARLIER_NAMES = ("lowest", "highest", "probability", "confidence", "trials")
"""Keys of a search that were properties of the scene itself, as ``search_lowest``; saved files still have them."""


def read_earlier_names(settings: bpy.types.PropertyGroup, _context: bpy.types.Context | None = None) -> None:
    """Move values that are set under an earlier name to the present one."""
    for name in _EARLIER_NAMES:
        if settings.is_property_set(f"search_{name}"):
            _CONSOLE.warning("scene.bda.search_%s is scene.bda.search.%s now", name, name)
            setattr(settings.search, name, getattr(settings, f"search_{name}"))
            settings.property_unset(f"search_{name}")


@bpy.app.handlers.persistent
def read_earlier_files(*_arguments: object) -> None:
    """Called by Blender when a file is loaded."""
    for scene in bpy.data.scenes:
        read_earlier_names(scene.bda)


def _folder(kind: str) -> object:
    return path_property(
        "Folder",
        f"Folder of the {kind}: made if new; in a folder that was begun it goes on, with more runs too",
        "DIR_PATH",
    )


class EnsembleProperties:
    """Part of the settings of a scene."""

    study_path: path_property("Study", "Study file (TOML) to load, with the scenario that it varies")
    search_path: path_property("Search", "Search file (TOML) to load, with the scenario that it changes")
    optimise_path: path_property("Optimisation", "Optimisation file (TOML) to load, with the scenario that it changes")
    study_directory: _folder("study")
    search_directory: _folder("search")
    optimise_directory: _folder("optimisation")
    study_jobs: IntProperty(
        name="Runs at a Time",
        description="How many runs go on at a time, each in a Blender of its own; such as 1 less than processors",
        default=max((os.cpu_count() or 1) - 1, 1),
        min=1,
        max=1000,
    )
    show_study: BoolProperty(
        name="Show Map and Limit",
        description="Show on the ground how likely debris gets to a position, and the limit as a line",
        default=True,
        update=redraw_views,
    )
    search_quantity: EnumProperty(name="Quantity", description="What is changed from run to run", items=_QUANTITIES)
    search_criterion: EnumProperty(name="Criterion", description="What a success is", items=_CRITERIA)
    search_span: IntProperty(
        name="Span", description="Number of the span, from 1, along the road", default=1, min=1, max=10_000
    )
    optimise_criterion: EnumProperty(name="Criterion", description="What has to hold", items=_CRITERIA)
    optimise_span: IntProperty(
        name="Span", description="Number of the span, from 1, along the road", default=1, min=1, max=10_000
    )

    search_lowest: FloatProperty(options={"HIDDEN"}, update=read_earlier_names)
    search_highest: FloatProperty(options={"HIDDEN"}, update=read_earlier_names)
    search_probability: FloatProperty(options={"HIDDEN"}, update=read_earlier_names)
    search_confidence: FloatProperty(options={"HIDDEN"}, update=read_earlier_names)
    search_trials: IntProperty(options={"HIDDEN"}, update=read_earlier_names)
