"""All operators, lists and panels of the sidebar, in the order in which Blender gets and shows them."""

from __future__ import annotations

from functools import cache

import bpy

from ..simulation import handlers
from . import (
    contour_operators,
    contour_panel,
    explosion,
    frame_change,
    last_recording,
    own_objects,
    post_processing,
    redraw,
    removal_operators,
    report_panel,
    results_panel,
    run_operator,
    running,
    scenario_operators,
    scenario_panels,
    table_lists,
)


@cache
def classes() -> tuple[type, ...]:
    """Panels come in the order of the work, and each after the one that it stands in."""
    return (
        *scenario_operators.CLASSES,
        *removal_operators.CLASSES,
        *own_objects.CLASSES,
        *run_operator.CLASSES,
        *contour_operators.CLASSES,
        *table_lists.CLASSES,
        *scenario_panels.panels(),
        *explosion.CLASSES,
        *frame_change.CLASSES,
        *post_processing.CLASSES,
        *contour_panel.CLASSES,
        *results_panel.CLASSES,
        *report_panel.CLASSES,
        *scenario_panels.inner_panels(),
    )


def register() -> None:
    """Make them known to Blender."""
    for each in classes():
        bpy.utils.register_class(each)


def unregister() -> None:
    """End a run or recording that goes on, and take all of them away."""
    running.end(bpy.context)
    handlers.stop()
    redraw.unregister()
    last_recording.forget()
    for each in reversed(classes()):
        bpy.utils.unregister_class(each)
