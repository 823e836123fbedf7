"""What the sidebar shows of the charge that is chosen in its list."""

import bpy

from ...core.blast.charges import EXPLOSIVES
from ...core.blast.wave import Burst
from ...scene.blast.charges import BURST, EXPLOSIVE, charge_collection, is_charge
from ..viewport import select_only

EXPLOSIVE_ITEMS = [
    (
        name,
        name,
        f"1 kg has the impulse of {each.tnt_by_impulse:g} kg of TNT, and the peak overpressure of "
        f"{each.tnt_by_pressure:g} kg",
    )
    for name, each in EXPLOSIVES.items()
]
BURST_ITEMS = [
    (Burst.AIR.value, "Air", "It detonates in the air"),
    (Burst.SURFACE.value, "Surface", "It detonates on the ground, which throws the wave back"),
]


def shown_charge(scene: bpy.types.Scene) -> bpy.types.Object | None:
    """The charge that is chosen in the list, if there is one."""
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


def shown_explosive(settings: bpy.types.PropertyGroup) -> int:
    """Number of the chosen charge's explosive among the items."""
    return _shown(settings, EXPLOSIVE, EXPLOSIVE_ITEMS)


def set_explosive(settings: bpy.types.PropertyGroup, number: int) -> None:
    """Give the chosen charge an explosive."""
    _set(settings, EXPLOSIVE, EXPLOSIVE_ITEMS[number][0])


def shown_burst(settings: bpy.types.PropertyGroup) -> int:
    """Number of the chosen charge's burst among the items."""
    return _shown(settings, BURST, BURST_ITEMS)


def set_burst(settings: bpy.types.PropertyGroup, number: int) -> None:
    """Say where the chosen charge detonates."""
    _set(settings, BURST, BURST_ITEMS[number][0])


def _shown(settings: bpy.types.PropertyGroup, name: str, items: list[tuple[str, str, str]]) -> int:
    charge = shown_charge(settings.id_data)
    identifiers = [each[0] for each in items]
    value = charge.get(name) if charge else None
    return identifiers.index(value) if value in identifiers else 0


def _set(settings: bpy.types.PropertyGroup, name: str, value: str) -> None:
    charge = shown_charge(settings.id_data)
    if charge:
        charge[name] = value
        charge.update_tag()
