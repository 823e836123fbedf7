"""Charges as empties that can be moved about, with what they are made of as properties."""

from __future__ import annotations

from collections.abc import Iterable
from numbers import Real
from typing import Any

import bpy
from mathutils import Matrix, Vector

from ...engineering.geometry.solids import sphere
from ...errors import BlastError, DemolitionError
from ...model.blast.charges import EXPLOSIVES, MS_PER_S, Charge, explosive_named
from ..bodies import mesh_of
from ..collections import collection_for, find_collection
from ..rendering.materials import SurfaceMaterial, material_of
from ..tools.keyframes import curves_of

MASS, EXPLOSIVE, DELAY, BURST = "bda_mass_kg", "bda_explosive", "bda_delay_s", "bda_burst"
"""Properties of an empty that stands for a charge."""

_HIDDEN = "hide_render"
_ROLE = "Charges"
_SYMBOL_SIZE_M = 0.3
_SYMBOL_SEGMENTS = 16
_SYMBOL_MARK = "bda_charge_symbol"

_SHOWN: dict[str, dict[str, Any]] = {
    MASS: {"min": 0.0, "description": "Mass of the explosive itself, in kg; with 0 nothing goes off"},
    EXPLOSIVE: {"description": "What it is made of: " + ", ".join(EXPLOSIVES)},
    DELAY: {
        "min": 0.0,
        "precision": 3,
        "subtype": "TIME_ABSOLUTE",
        "description": "Time from the start of the blasting to its detonation, in s",
    },
    BURST: {"description": "Whether it detonates in the air or on the surface of the ground"},
}
"""Limits, units and tooltips of the properties, as Blender shows them."""


def create_charges(scene: bpy.types.Scene, charges: Iterable[Charge]) -> list[bpy.types.Object]:
    """One empty per charge, at its place."""
    return [_create(collection_for(scene, _ROLE), charge) for charge in charges]


def replace_charges(scene: bpy.types.Scene, charges: Iterable[Charge]) -> list[bpy.types.Object]:
    """One empty per charge, at its place, instead of all charges that there were."""
    bpy.data.batch_remove(charge_objects(scene))
    return create_charges(scene, charges)


def charge_objects(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """All objects that stand for charges, in the order in which they came into the scene."""
    return [obj for obj in scene.objects if is_charge(obj)]


def is_charge(found: bpy.types.Object) -> bool:
    """Whether an object stands for a charge."""
    return MASS in found


def charge_collection(scene: bpy.types.Scene) -> bpy.types.Collection | None:
    """The collection that charges are put into, once there was one."""
    return find_collection(scene, _ROLE)


def charges_of(scene: bpy.types.Scene) -> tuple[Charge, ...]:
    """The charges as they are now.

    Raises
    ------
    BlastError
        A property of one was set to what no charge can have.
    """
    return tuple(_charge(charge_object) for charge_object in charge_objects(scene))


def show_until(charge: bpy.types.Object, frame: int) -> None:
    """Show a charge in pictures, as a red ball, of the frames before the one in which it has gone off."""
    show_never(charge)
    charge.instance_type, charge.instance_collection = "COLLECTION", _symbol()
    for hidden, key_frame in ((True, frame), (False, 0)):
        charge.hide_render = hidden
        charge.keyframe_insert(_HIDDEN, frame=key_frame)


def show_never(charge: bpy.types.Object) -> None:
    """Take back that a charge is shown in pictures."""
    if charge.instance_type == "COLLECTION":
        charge.instance_type = "NONE"
    animation = charge.animation_data
    curves = curves_of(animation) if animation and animation.action else []
    frames = [point.co.x for curve in curves if curve.data_path == _HIDDEN for point in curve.keyframe_points]
    for frame in frames:
        charge.keyframe_delete(_HIDDEN, frame=frame)
    if frames:
        charge.hide_render = False


def _symbol() -> bpy.types.Collection:
    """A red ball for all charges, as pictures show no empties; it is in no scene but by way of them."""
    found = next((each for each in bpy.data.collections if each.get(_SYMBOL_MARK) and not each.library), None)
    if found:
        return found
    solid = sphere(_SYMBOL_SIZE_M, _SYMBOL_SEGMENTS)
    ball = bpy.data.objects.new("Charge symbol", mesh_of("Charge symbol", solid))
    ball.data.materials.append(material_of(SurfaceMaterial.CHARGE))
    collection = bpy.data.collections.new("Charge symbol")
    collection[_SYMBOL_MARK] = True
    collection.objects.link(ball)
    return collection


def _create(collection: bpy.types.Collection, charge: Charge) -> bpy.types.Object:
    empty = bpy.data.objects.new(charge.name, None)
    empty.empty_display_type, empty.empty_display_size = "SPHERE", _SYMBOL_SIZE_M
    empty.show_in_front = True  # charges mostly sit where concrete hides them
    empty.matrix_world = Matrix.Translation(charge.place_m)  # which holds at once, as a location does not
    empty[MASS], empty[EXPLOSIVE] = charge.mass_kg, charge.explosive
    empty[DELAY], empty[BURST] = charge.delay_s, charge.burst
    for name, shown in _SHOWN.items():
        empty.id_properties_ui(name).update(**shown)
    collection.objects.link(empty)
    return empty


def _charge(empty: bpy.types.Object) -> Charge:
    missing = [name for name in (EXPLOSIVE, DELAY, BURST) if name not in empty]
    if missing:
        raise BlastError(f"charge {empty.name!r} lacks the property {missing[0]}: delete it and add it again")
    try:
        return Charge(
            name=empty.name,
            place_m=tuple(_place_of(empty)),
            mass_kg=empty[MASS],
            explosive=explosive_named(empty[EXPLOSIVE]).name,
            delay_ms=_in_ms(empty[DELAY]),
            burst=empty[BURST],
        )
    except DemolitionError as error:
        raise BlastError(f"{empty.name}: {error}") from error


def _place_of(empty: bpy.types.Object) -> Vector:
    """Return where a charge is; after undo Blender knows the place of one in the world only once it has drawn it."""
    hangs_on_something = empty.parent or len(empty.constraints)
    return (empty.matrix_world if hangs_on_something else empty.matrix_basis).translation


def _in_ms(delay_s: float) -> float:
    """Return a delay in ms, as the decimal that was divided to get it in s."""
    return float(f"{MS_PER_S * delay_s:.15g}") if isinstance(delay_s, Real) else delay_s
