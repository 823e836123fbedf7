"""All operators, lists and panels of the sidebar, in the order in which Blender gets and shows them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from functools import cache
from types import ModuleType

import bpy

from . import blast, chart_pictures, ifc, messages, modal_task, sections, stages, workspace
from .comparison import ui as comparison_ui
from .contours import ui as contour_ui
from .contours import view as contour_view
from .ensemble import optimise, search, study
from .ensemble import session as ensemble_session
from .ground import ui as ground_ui
from .languages.words import in_own_context
from .preview import handles
from .recording import operator as recording_operator
from .recording import session
from .recording import ui as recording_ui
from .results import operator as results_operator
from .results import shown_run
from .results import ui as results_ui
from .scenario import hints, number_rows, preset_menu, table_list, user_meshes
from .scenario import operator as scenario_operator
from .scenario import ui as scenario_ui

_MODULES = (
    *(scenario_operator, preset_menu, number_rows, messages, hints, workspace, chart_pictures, user_meshes, table_list),
    *(recording_operator, session, results_operator, handles, scenario_ui, ifc, blast, recording_ui, contour_ui),
    *(ground_ui, results_ui, stages, comparison_ui, sections, study, search, optimise),
)
"""Where their panels stand in the tab is in `panel_places`."""


def classes_of(module: ModuleType) -> tuple[type, ...]:
    """Return the classes that a module has for Blender, but groups of settings, which go with the scene."""
    ours = (item for name, item in vars(module).items() if name.startswith("BDA_") and not name.startswith("BDA_PG_"))
    return tuple(cls for cls in ours if cls.__module__ == module.__name__)


@cache
def classes() -> tuple[type, ...]:
    """Return all classes; a panel comes after the one that it stands in."""
    found = [cls for module in _MODULES for cls in classes_of(module)]
    panels = [*filter(_is_panel, found), *scenario_ui.table_panels()]
    return (*(cls for cls in found if not _is_panel(cls)), *outer_first(panels))


def _is_panel(cls: type) -> bool:
    return issubclass(cls, bpy.types.Panel)


def outer_first(panels: Sequence[type[bpy.types.Panel]]) -> list[type[bpy.types.Panel]]:
    """Return panels from the outermost to the innermost, subpanels in the order in which their panel shows them."""
    inside = defaultdict(list)
    for panel in panels:
        inside[getattr(panel, "bl_parent_id", "")].append(panel)
    ordered, outer = [], [""]
    for name in outer:
        shown = sorted(inside[name], key=lambda panel: getattr(panel, "bl_order", 0))
        ordered += shown
        outer += [panel.__name__ for panel in shown]
    return ordered


def register() -> None:
    """Register all classes with Blender."""
    for cls in classes():
        bpy.utils.register_class(in_own_context(cls))


def unregister() -> None:
    """End a run, recording, study or search that goes on, and unregister all classes."""
    ensemble_session.unregister()
    stages.unregister()
    modal_task.unregister()
    workspace.unregister()
    recording_ui.unregister()
    session.unregister()
    ground_ui.unregister()
    for cls in reversed(classes()):
        bpy.utils.unregister_class(cls)
    preset_menu.unregister()
    shown_run.forget_shown()
    messages.clear_all()
    shown_run.unregister()
    contour_view.unregister()
