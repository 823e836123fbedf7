"""All operators, lists and panels of the sidebar, in the order in which Blender gets and shows them."""

from __future__ import annotations

from functools import cache

import bpy

from ..simulation.recording import handlers
from .blast import operator as explosion
from .contours import operator as contour_operators
from .contours import ui as contour_panel
from .recording import (
    last_recording,
    redraw,
    running,
)
from .recording import (
    log_paths as post_processing,
)
from .recording import (
    operator as frame_change,
)
from .recording import (
    run as run_operator,
)
from .results import report as report_panel
from .results import ui as results_panel
from .scenario import (
    operator as scenario_operators,
)
from .scenario import (
    removal as removal_operators,
)
from .scenario import (
    table_list as table_lists,
)
from .scenario import (
    ui as scenario_panels,
)
from .scenario import (
    user_meshes as own_objects,
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
