"""Properties of the charge that is chosen in the list of the sidebar."""

from typing import Any

import bpy
from bpy.props import EnumProperty, IntProperty, StringProperty

from ...engineering.blast.wave import Burst
from ...model.blast.charges import EXPLOSIVES
from ...scene.blast.charges import BURST, EXPLOSIVE, charge_collection, is_charge
from ..viewport import select_only

_EXPLOSIVES = [
    (
        name,
        name,
        f"1 kg has the impulse of {explosive.tnt_by_impulse:g} kg of TNT, and the peak overpressure of "
        f"{explosive.tnt_by_pressure:g} kg",
    )
    for name, explosive in EXPLOSIVES.items()
]
_BURSTS = [
    (Burst.AIR.value, "Air", "It detonates in the air"),
    (Burst.SURFACE.value, "Surface", "It detonates on the ground, which throws the wave back"),
]


def shown_charge(scene: bpy.types.Scene) -> bpy.types.Object | None:
    """Return the charge that is chosen in the list, if there is one."""
    collection = charge_collection(scene)
    objects = collection.objects if collection else ()
    index = scene.bda.charge_index
    return objects[index] if index < len(objects) and is_charge(objects[index]) else None


def select_shown(settings: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """Select the charge that was chosen in the list, and nothing else, so that it can be moved at once."""
    charge = shown_charge(settings.id_data)
    if charge is None or context.mode != "OBJECT" or charge.name not in context.view_layer.objects:
        return
    select_only(context, [charge])
    context.view_layer.objects.active = charge


def choice_of_charge(key: str, items: list[tuple[str, str, str]], name: str, description: str) -> Any:
    """Return a property that shows and sets one of a few values that the chosen charge keeps under a key."""
    identifiers = [item[0] for item in items]

    def shown(settings: bpy.types.PropertyGroup) -> int:
        charge = shown_charge(settings.id_data)
        value = charge.get(key) if charge else None
        return identifiers.index(value) if value in identifiers else 0

    def choose(settings: bpy.types.PropertyGroup, number: int) -> None:
        if charge := shown_charge(settings.id_data):
            charge[key] = identifiers[number]
            charge.update_tag()

    return EnumProperty(name=name, description=description, items=items, get=shown, set=choose)


class ChargeProperties:
    """The part of the scene's settings on its charges."""

    charge_index: IntProperty(
        name="Charge",
        description="The charge whose properties are shown below the list",
        min=0,
        update=select_shown,
    )
    charge_explosive: choice_of_charge(EXPLOSIVE, _EXPLOSIVES, "Explosive", "What the charge is made of")
    charge_burst: choice_of_charge(
        BURST,
        _BURSTS,
        "Burst",
        "Whether the charge detonates in the air, or on the ground, which throws the wave back",
    )
    charges_given: StringProperty(options={"HIDDEN"}, description="Charges as they were loaded, in JSON")
    total_mass: StringProperty(options={"HIDDEN"}, description="Mass of all active bodies but the ball")
