"""Elements of an IFC file as the sidebar lists them, with kinds and materials that the user corrects."""

import bpy
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, IntProperty, StringProperty

from ...ifc.settings import KINDS
from ..sidebar import path_property

LEFT_OUT = "left out"

BARS = "Steel as Bars"
BARS_HINT = "Make bars of [steelwork] of straight steel, with nodes where they meet, instead of cutting it into shards"


def _label(kind: str) -> str:
    """Return a kind as the list shows it; Bearing alone is a direction in other panels, and one word in a language."""
    return "Bridge Bearing" if kind == "bearing" else kind.title()


class BDA_PG_ifc_element(bpy.types.PropertyGroup):
    """An element of the file that was looked into."""

    title: StringProperty(name="Element", description="Its name in the file")
    ifc_class: StringProperty(name="Class", description="Its class in the file")
    global_id: StringProperty(name="GlobalId", description="What names it in the file for good")
    kind: EnumProperty(
        name="Kind",
        description="What the element becomes",
        items=[(LEFT_OUT, "Left Out", "It becomes no member"), *((kind, _label(kind), "") for kind in KINDS)],
    )
    kind_of_file: StringProperty(options={"HIDDEN"}, description="What the add-on took it for")
    material: StringProperty(
        name="Material", description="Name in the table of materials, such as concrete, steel, masonry or wood"
    )
    material_of_file: StringProperty(options={"HIDDEN"}, description="What the add-on took its material for")
    why: StringProperty(name="Note", description="Why it is left out, or what was assumed of its material")


class IfcProperties:
    """The file that was looked into, and its elements."""

    ifc_path: path_property("IFC File", "IFC file whose elements are listed")
    ifc_only: StringProperty(
        name="Only", description="Bridge that is taken of a file with several; none for the one with the most members"
    )
    ifc_bars: BoolProperty(name=BARS, description=BARS_HINT, default=True)
    ifc_elements: CollectionProperty(type=BDA_PG_ifc_element, description="Elements of the file")
    ifc_element_index: IntProperty(options={"HIDDEN"}, description="The chosen element")
