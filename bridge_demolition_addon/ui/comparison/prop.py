"""Settings of another run beside the one that is shown, kept in the scene as part of ``scene.bda``."""

from bpy.props import BoolProperty, FloatProperty, StringProperty

from ..sidebar import path_property
from ..viewport import redraw_views


class ComparisonProperties:
    """Part of the settings of a scene."""

    compared_directory: path_property(
        "Other Run", "Folder of another run, of this scenario or of another one, to show beside this one", "DIR_PATH"
    )
    compared_folder: StringProperty(options={"HIDDEN"}, description="Folder of the run that is shown beside this one")
    show_compared: BoolProperty(
        name="Show Other Run",
        description="Draw the bodies of the other run at the simulated time of the frame that is shown. They are only "
        "drawn: nothing is simulated with them",
        default=True,
        update=redraw_views,
    )
    compared_shift_m: FloatProperty(
        name="Beside By",
        description="How far beside this run the other one is drawn, along y: 0 m lays it over this one, and it is "
        "seen through then",
        default=0.0,
        soft_min=-1000.0,
        soft_max=1000.0,
        step=100,
        unit="LENGTH",
        update=redraw_views,
    )
