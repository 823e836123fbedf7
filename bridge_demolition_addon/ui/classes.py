"""All operators, lists and panels of the sidebar, in the order in which Blender gets and shows them."""

from __future__ import annotations

from functools import cache

import bpy

from ..simulation import handlers
from . import (
    explosion,
    frame_change,
    last_recording,
    own_objects,
    post_processing,
    redraw,
    removal_operators,
    report_panel,
    results_panel,
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
        *table_lists.CLASSES,
        *scenario_panels.panels(),
        *explosion.CLASSES,
        *frame_change.CLASSES,
        *post_processing.CLASSES,
        *results_panel.CLASSES,
        *report_panel.CLASSES,
        *scenario_panels.inner_panels(),
    )


def register() -> None:
    """Make them known to Blender."""
    for each in classes():
        bpy.utils.register_class(each)


def unregister() -> None:
    """End a recording that runs, and take all of them away."""
    handlers.stop()
    redraw.unregister()
    last_recording.forget()
    for each in reversed(classes()):
        bpy.utils.unregister_class(each)
