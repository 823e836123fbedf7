"""The switch of previews that run beside Blender; it is of this session, and no file holds it."""

import bpy
from bpy.props import BoolProperty

from ..viewport import redraw_views
from .run_beside import beside


def _switch(_settings: bpy.types.PropertyGroup, wanted: bool) -> None:
    beside.is_on = wanted
    redraw_views()


class PreviewRunProperties:
    """Part of the settings of a scene."""

    preview_run: BoolProperty(
        name="Preview While Dragging",
        description="While you drag the ball, a charge or a blast zone, or change a value, run the scenario of the "
        "panels in some 50 to 80 shards in a process of its own, and show the outline of its debris, what falls and "
        "what stands. It is one coarse run and no forecast, takes a processor and about 0.5 GB of memory, and changes "
        "nothing in the file. Off again with the next file",
        get=lambda _settings: beside.is_on,
        set=_switch,
        options={"SKIP_SAVE"},
    )
