"""Settings of the sidebar, kept in the scene as ``scene.bda``."""

import bpy
from bpy.props import BoolProperty, PointerProperty, StringProperty

from ..model.scenario import Scenario
from .blast import ChargeProperties
from .comparison.ui import ComparisonProperties
from .contours.view import ContourProperties
from .ensemble.panel import EnsembleProperties, read_earlier_files
from .ground.decorator import GroundProperties
from .ifc import BDA_PG_ifc_element, IfcProperties
from .key_figures import KeyFigureProperties
from .languages.words import in_own_context
from .preview.run_beside import PreviewRunProperties
from .results.operator import ReportProperties
from .scenario import prop as scenario_properties
from .scenario.earlier import mark_defaults, read_earlier_bodies, read_earlier_defaults, read_earlier_keys
from .scenario.preset_menu import PresetProperties
from .sections import SectionProperties
from .sidebar import path_property, tooltip
from .stages import StageProperties
from .viewport import redraw_views

_READERS = (read_earlier_files, read_earlier_keys, read_earlier_bodies, read_earlier_defaults)
"""What reads values of files of earlier versions."""


class BDA_PG_settings(
    ContourProperties,
    ChargeProperties,
    GroundProperties,
    EnsembleProperties,
    StageProperties,
    IfcProperties,
    PreviewRunProperties,
    ComparisonProperties,
    SectionProperties,
    KeyFigureProperties,
    ReportProperties,
    PresetProperties,
    bpy.types.PropertyGroup,
):
    """Settings that the panels show; those from the schema are added when they are made."""

    scenario_path: path_property(
        "Scenario", "Scenario file (TOML) to load or to save; Build Scenario loads one that was not loaded yet"
    )
    loaded_path: StringProperty(options={"HIDDEN"}, description="Scenario file that was loaded or saved last")
    built_scenario: StringProperty(options={"HIDDEN"}, description="The scenario that the scene was built from")
    built_values: StringProperty(options={"HIDDEN"}, description="What the panels showed when the scene was built")
    defaults_of: StringProperty(
        options={"HIDDEN"}, description="Preset that the values are of which the file does not hold"
    )
    output_directory: path_property(
        "Results",
        "Folder for the logs and results of the recording. Without one, each run makes a folder beside the saved file, "
        "or in your documents, named after the scenario and counted up",
        "DIR_PATH",
    )
    overwrite: BoolProperty(
        name="Overwrite",
        description="Replace the results of an earlier recording in that folder, and log files that are there",
        default=False,
    )
    pictures_of_run: BoolProperty(
        name="Pictures",
        description="Render pictures when a run has ended: before it, at the moment that shows most, and at its end, "
        "with the camera and size of Pictures in Scenario",
        default=True,
    )
    show_preview: BoolProperty(
        name="Preview",
        description="While this tab is open, draw bridge and ball as the panels would build them, where nothing is "
        "built or other values were, and show handles to drag the ball's target and the charges",
        default=True,
        update=redraw_views,
    )
    show_bars: BoolProperty(
        name="Show Bars",
        description="Draw the reinforcing bars of what is built as lines, where it was built; at most 40 of a layer",
        default=False,
        update=redraw_views,
    )
    debris_log_path: path_property("Debris Log", "File for the debris log; none for the folder of the results")
    force_log_path: path_property("Force Log", "File for the force log; none for the folder of the results")


def register() -> None:
    """Give every scene its settings."""
    scenario_properties.register()
    for name, table in {"scenario": Scenario, **scenario_properties.ENSEMBLES}.items():
        group = scenario_properties.registered_group(scenario_properties.group_name(table))
        BDA_PG_settings.__annotations__[name] = PointerProperty(type=group, description=tooltip(table.__doc__))
    for group in (BDA_PG_ifc_element, BDA_PG_settings):
        bpy.utils.register_class(in_own_context(group))
    bpy.types.Scene.bda = PointerProperty(type=BDA_PG_settings)
    for read in _READERS:
        bpy.app.handlers.load_post.append(read)
    bpy.app.handlers.save_pre.append(mark_defaults)


def unregister() -> None:
    """Take the settings from all scenes."""
    for read in _READERS:
        bpy.app.handlers.load_post.remove(read)
    bpy.app.handlers.save_pre.remove(mark_defaults)
    del bpy.types.Scene.bda
    bpy.utils.unregister_class(BDA_PG_settings)
    bpy.utils.unregister_class(BDA_PG_ifc_element)
    scenario_properties.unregister()
