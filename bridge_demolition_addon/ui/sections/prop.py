"""Settings of the section through the pile, kept in the scene as part of ``scene.bda``."""

from bpy.props import BoolProperty, EnumProperty, FloatProperty

from ...model.debris.pile_sections import Direction
from ..viewport import redraw_views

_DIRECTIONS = (
    (Direction.ACROSS.name, "Across Bridge", "An upright plane across the bridge, at a position x"),
    (Direction.ALONG.name, "Along Bridge", "An upright plane along the bridge, at a position y"),
)


class SectionProperties:
    """Part of the settings of a scene."""

    show_section: BoolProperty(
        name="Show Section",
        description="Draw what an upright plane cuts of debris and bridge in the frame that is shown, with a scale of "
        "heights",
        default=False,
        update=redraw_views,
    )
    section_direction: EnumProperty(
        name="Plane", description="Which way the plane of the section runs", items=_DIRECTIONS, update=redraw_views
    )
    section_place_m: FloatProperty(
        name="Position",
        description="Where the plane is: x of one across the bridge, y of one along it, such as 6.5 m",
        default=0.0,
        soft_min=-1000.0,
        soft_max=1000.0,
        step=10,
        unit="LENGTH",
        update=redraw_views,
    )
