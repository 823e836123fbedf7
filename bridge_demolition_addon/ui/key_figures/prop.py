"""Setting of the key figures over the 3D view, kept in the scene as part of ``scene.bda``."""

from bpy.props import BoolProperty

from ..viewport import redraw_views


class KeyFigureProperties:
    """Part of the settings of a scene."""

    figures_in_view: BoolProperty(
        name="Key Figures in View",
        description="Draw over the 3D view what has come of the run by the frame that is shown: key figures, the force "
        "on the selected shard or in the selected connection over time with its peak, else the largest on any shard, "
        "and on the ground the debris with the edge of the exclusion zone as planned",
        default=False,
        update=redraw_views,
    )
