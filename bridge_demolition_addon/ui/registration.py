"""All operators, lists and panels of the sidebar, in the order in which Blender gets and shows them."""

from __future__ import annotations

from functools import cache

import bpy

from . import first_help, messages, modal_task, workspace
from .blast import operator as blast_operator
from .blast import ui as blast_ui
from .contours import operator as contour_operator
from .contours import ui as contour_ui
from .ensemble import optimise, search, study
from .ensemble import session as ensemble_session
from .ground import operator as ground_operator
from .ground import ui as ground_ui
from .ifc import operator as ifc_operator
from .preview import gizmos
from .preview import operator as preview_operator
from .recording import log_paths, pictures, run, session
from .recording import operator as recording_operator
from .recording import ui as recording_ui
from .results import operator as results_operator
from .results import shown_run
from .results import ui as results_ui
from .scenario import number_rows, preset_menu, table_list, user_meshes
from .scenario import operator as scenario_operator
from .scenario import ui as scenario_ui
from .stages import checked as checked_stages
from .stages import operator as stages_operator
from .stages import ui as stages_ui

_OPERATORS = (
    *(scenario_operator, ifc_operator, preset_menu, number_rows, messages, first_help, workspace),
    *(user_meshes, table_list),
    *(recording_operator, run, pictures, log_paths, blast_operator, contour_operator, ground_operator),
    *(results_operator, stages_operator, preview_operator, gizmos),
)
_PANELS = (blast_ui, recording_ui, contour_ui, ground_ui, results_ui, stages_ui)
"""Below those of the scenario, in the order of the work."""

_ENSEMBLES = (study, search, optimise)


@cache
def classes() -> tuple[type, ...]:
    """Return all classes; a panel comes after the one that it stands in."""
    return (
        *(cls for module in _OPERATORS for cls in module.CLASSES),
        *(operator for kind in _ENSEMBLES for operator in kind.OPERATORS),
        *scenario_ui.panels(),
        *(cls for module in _PANELS for cls in module.CLASSES),
        *(panel for kind in _ENSEMBLES for panel in kind.PANELS),
        *scenario_ui.inner_panels(),
    )


def register() -> None:
    """Register all classes with Blender."""
    for cls in classes():
        bpy.utils.register_class(cls)


def unregister() -> None:
    """End a run, recording, study or search that goes on, and unregister all classes."""
    ensemble_session.unregister()
    checked_stages.unregister()
    modal_task.unregister()
    workspace.unregister()
    session.unregister()
    ground_operator.unregister()
    for cls in reversed(classes()):
        bpy.utils.unregister_class(cls)
    preset_menu.unregister()
    shown_run.forget_shown()
    messages.clear_all()
