"""Settings of the drawings on the ground and in the air, kept in the scene as part of ``scene.bda``."""

from bpy.props import EnumProperty, FloatProperty, FloatVectorProperty, IntProperty

from ..sidebar import path_property
from ..viewport import redraw_views

EXCLUSION, ZONES, DEBRIS, RINGS = "EXCLUSION", "ZONES", "DEBRIS", "RINGS"
NEIGHBOURS, WAY, FLASHES, NAMES = "NEIGHBOURS", "WAY", "FLASHES", "NAMES"
BLAST_ZONES = "BLAST_ZONES"
_OVERLAYS = (
    (EXCLUSION, "Exclusion Zone", "The exclusion zone: of the last run, or as it is planned before there is one"),
    (ZONES, "Zones", "The zones of Scenario, with their names"),
    (DEBRIS, "Debris", "What the debris of the last run covers when it ends"),
    (RINGS, "Distances", "How far from the plan of the bridge the ground is"),
    (NEIGHBOURS, "Neighbours", "The neighbours of Scenario, with their names"),
    (WAY, "Path of Ball", "The path of the ball in the last run"),
    (FLASHES, "Flashes", "A flash where a charge goes off"),
    (NAMES, "Chosen Shard", "Outline and name of the body that is selected"),
    (BLAST_ZONES, "Blast Zones", "Blast zones with their drill holes, coloured by their delays, until they fire"),
)


class GroundProperties:
    """Part of the settings of a scene."""

    overlays: EnumProperty(
        name="Show",
        description="What is drawn on the ground and in the air of the 3D view",
        items=_OVERLAYS,
        options={"ENUM_FLAG"},
        default={ZONES, NEIGHBOURS, FLASHES, NAMES, BLAST_ZONES},
        update=redraw_views,
    )
    distance_spacing_m: FloatProperty(
        name="Every",
        description="Distance from ring to ring, such as 10 m",
        default=10.0,
        min=0.5,
        max=1000.0,
        unit="LENGTH",
        update=redraw_views,
    )
    distance_count: IntProperty(
        name="Rings", description="How many rings of distance, such as 5", default=5, min=1, max=20, update=redraw_views
    )
    plan_picture: path_property("Site Plan", "Picture of a site plan, or one from the air, to lie under the bridge")
    plan_width_m: FloatProperty(
        name="Width",
        description="Width of the picture on the ground, such as 200 m",
        default=200.0,
        min=1.0,
        max=1e5,
        unit="LENGTH",
    )
    plan_bearing_deg: FloatProperty(
        name="Bearing",
        description="Direction of the road's x axis, clockwise from the upward direction of the picture: 90° for a "
        "picture with north up and a road from west to east",
        default=90.0,
        min=-360.0,
        max=360.0,
    )
    plan_origin: FloatVectorProperty(
        name="Origin",
        description="Where the origin of the scenario lies in the picture, from its left and from its foot: 0.5 and "
        "0.5 for its middle",
        size=2,
        default=(0.5, 0.5),
        min=-10.0,
        max=10.0,
    )
