"""Settings of a search, kept in the scene as part of ``scene.bda``."""

from bpy.props import EnumProperty, FloatProperty, IntProperty

from ..sidebar import path_property

CHARGES, BALL_MASS, DROP_HEIGHT = "CHARGES", "BALL_MASS", "DROP_HEIGHT"
KEYS = {CHARGES: "charges.mass_kg", BALL_MASS: "ball.mass_kg", DROP_HEIGHT: "ball.drop_height_m"}
"""Keys of what may be searched along."""

COLLAPSED, SPAN_DOWN, AS_IN_STUDY = "COLLAPSED", "SPAN_DOWN", "AS_IN_STUDY"

_QUANTITIES = (
    (CHARGES, "Factor on All Charges", "How many times as heavy all charges are as in the panels"),
    (BALL_MASS, "Mass of Ball", "Mass of the ball, kg"),
    (DROP_HEIGHT, "Drop Height", "How far the ball drops, m"),
)
_CRITERIA = (
    (COLLAPSED, "Collapsed", "The shards' common centre of mass loses half of its height"),
    (SPAN_DOWN, "Span Down", "The centre of mass of one span loses half of its height"),
    (AS_IN_STUDY, "As in Study", "All criteria of the panel Study"),
)


class SearchProperties:
    """Part of the settings of a scene."""

    search_directory: path_property(
        "Folder", "Folder of the search: made if new; one that was stopped goes on where it was", "DIR_PATH"
    )
    search_quantity: EnumProperty(name="Quantity", description="What is changed from trial to trial", items=_QUANTITIES)
    search_lowest: FloatProperty(
        name="Lowest", description="Lowest value that is tried, such as a factor of 0.1", default=0.1, min=1e-6
    )
    search_highest: FloatProperty(
        name="Highest", description="Highest value that is tried, such as a factor of 4", default=4.0, min=1e-6
    )
    search_criterion: EnumProperty(name="Criterion", description="What a success is", items=_CRITERIA)
    search_span: IntProperty(
        name="Span", description="Number of the span, from 1, along the road", default=1, min=1, max=10_000
    )
    search_probability: FloatProperty(
        name="Probability",
        description="With which probability it has to succeed, such as 0.9",
        default=0.9,
        min=0.01,
        max=0.999,
    )
    search_confidence: FloatProperty(
        name="Confidence",
        description="Probability with which the limit that is given holds, such as 0.95",
        default=0.95,
        min=0.5,
        max=0.999,
    )
    search_trials: IntProperty(name="Trials", description="Most trials, such as 40", default=40, min=10, max=100_000)
