"""Charges as empties that can be moved about, with what they are made of as properties."""

from __future__ import annotations

from collections.abc import Iterable

import bpy

from ..core.blast.charges import Charge
from ..core.errors import BlastError
from .collections import collection_for

_ROLE = "Charges"
_MASS, _EXPLOSIVE, _DELAY, _BURST = "bda_mass_kg", "bda_explosive", "bda_delay_s", "bda_burst"
_SYMBOL_SIZE_M = 0.3


def create_charges(scene: bpy.types.Scene, charges: Iterable[Charge]) -> list[bpy.types.Object]:
    """One empty per charge, at its place."""
    return [_create(collection_for(scene, _ROLE), charge) for charge in charges]


def charge_objects(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """All objects that stand for charges, in the order of their names."""
    return sorted((each for each in scene.objects if _MASS in each), key=lambda each: each.name)


def charges_of(scene: bpy.types.Scene) -> tuple[Charge, ...]:
    """The charges as they are now.

    Raises
    ------
    BlastError
        A property of one was set to what no charge can have.
    """
    return tuple(_charge(each) for each in charge_objects(scene))


def _create(collection: bpy.types.Collection, charge: Charge) -> bpy.types.Object:
    empty = bpy.data.objects.new(charge.name, None)
    empty.empty_display_type, empty.empty_display_size = "SPHERE", _SYMBOL_SIZE_M
    empty.location = charge.place_m
    empty[_MASS], empty[_EXPLOSIVE] = charge.mass_kg, charge.explosive
    empty[_DELAY], empty[_BURST] = charge.delay_s, charge.burst.value
    collection.objects.link(empty)
    return empty


def _charge(empty: bpy.types.Object) -> Charge:
    missing = [name for name in (_EXPLOSIVE, _DELAY, _BURST) if name not in empty]
    if missing:
        raise BlastError(f"charge {empty.name!r} lacks the property {missing[0]}: delete it and add it anew")
    return Charge(
        name=empty.name,
        place_m=tuple(empty.matrix_world.translation),
        mass_kg=empty[_MASS],
        explosive=empty[_EXPLOSIVE],
        delay_s=empty[_DELAY],
        burst=empty[_BURST],
    )
