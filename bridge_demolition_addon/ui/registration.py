"""All operators, lists and panels of the sidebar, in the order in which Blender gets and shows them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from functools import cache
from types import ModuleType

import bpy

from . import chart_pictures, messages, modal_task, panel_groups, workspace
from .blast import operator as blast_operator
from .blast import ui as blast_ui
from .comparison import operator as comparison_operator
from .comparison import ui as comparison_ui
from .contours import operator as contour_operator
from .contours import ui as contour_ui
from .contours import view as contour_view
from .ensemble import optimise, search, study
from .ensemble import session as ensemble_session
from .ground import operator as ground_operator
from .ground import ui as ground_ui
from .ifc import operator as ifc_operator
from .ifc import ui as ifc_ui
from .languages.words import in_own_context
from .preview import gizmos
from .preview import operator as preview_operator
from .recording import beside, paths, run, session
from .recording import operator as recording_operator
from .recording import ui as recording_ui
from .results import operator as results_operator
from .results import placed, shown_run
from .results import ui as results_ui
from .scenario import hints, number_rows, preset_menu, table_list, user_meshes
from .scenario import operator as scenario_operator
from .scenario import stability as scenario_stability
from .scenario import ui as scenario_ui
from .sections import operator as section_operator
from .sections import ui as section_ui
from .stages import operator as stages_operator
from .stages import shown as shown_stages
from .stages import ui as stages_ui

_OPERATORS = (
    *(scenario_operator, ifc_operator, preset_menu, number_rows, messages, hints, workspace, chart_pictures),
    *(user_meshes, table_list, scenario_stability),
    *(recording_operator, run, beside, paths, blast_operator, contour_operator, ground_operator),
    *(results_operator, stages_operator, preview_operator, gizmos, comparison_operator, section_operator),
)
_PANELS = (
    *(panel_groups, scenario_ui, ifc_ui, blast_ui, recording_ui, contour_ui, ground_ui, results_ui, stages_ui),
    *(comparison_ui, section_ui, study, search, optimise),
)
"""Where they stand in the tab is in `panel_places`."""


def classes_of(module: ModuleType) -> tuple[type, ...]:
    """Return the classes that a module has for Blender, in their order."""
    ours = (item for name, item in vars(module).items() if name.startswith("BDA_"))
    return tuple(cls for cls in ours if cls.__module__ == module.__name__)


@cache
def classes() -> tuple[type, ...]:
    """Return all classes; a panel comes after the one that it stands in."""
    drawn = [cls for module in _PANELS for cls in classes_of(module)]
    panels = [*(cls for cls in drawn if issubclass(cls, bpy.types.Panel)), *scenario_ui.table_panels()]
    return (
        *(cls for module in _OPERATORS for cls in classes_of(module)),
        *(cls for cls in drawn if not issubclass(cls, bpy.types.Panel)),
        *outer_first(panels),
    )


def outer_first(panels: Sequence[type[bpy.types.Panel]]) -> list[type[bpy.types.Panel]]:
    """Return panels from the outermost to the innermost, those of a panel in the order in which it shows them."""
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
    shown_stages.unregister()
    modal_task.unregister()
    workspace.unregister()
    beside.unregister()
    session.unregister()
    ground_operator.unregister()
    for cls in reversed(classes()):
        bpy.utils.unregister_class(cls)
    preset_menu.unregister()
    shown_run.forget_shown()
    messages.clear_all()
    placed.unregister()
    contour_view.unregister()
