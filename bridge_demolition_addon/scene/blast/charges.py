"""Charges as empties that the user can move, with custom properties, and the settings of the blast in the scene."""

from __future__ import annotations

from collections.abc import Iterable
from numbers import Real
from typing import Any

import bpy
from mathutils import Matrix, Vector

from ...engineering.geometry.solids import sphere
from ...errors import BlastError, DemolitionError, ScenarioError
from ...model.blast.charges import EXPLOSIVES, MS_PER_S, Charge, explosive_named
from ...model.blast.settings import BlastSettings
from ...model.scenario.kept import table_from_values, table_values
from ..bodies import mesh_of
from ..collections import collection_for, find_collection
from ..custom_properties import edited
from ..rendering.materials import SurfaceMaterial, material_of
from ..tools.keyframes import curves_of

MASS, EXPLOSIVE, DELAY, BURST = "bda_mass_kg", "bda_explosive", "bda_delay_s", "bda_burst"
"""Properties of an empty that stands for a charge."""

_OF_BLAST = "bda_blast_"
_NO_VALUE = -1.0
"""Stands for a decay that each pulse has of its own: a property of Blender is never empty."""

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
    """Make an empty for each charge, at its position."""
    return [_create(collection_for(scene, _ROLE), charge) for charge in charges]


def replace_charges(scene: bpy.types.Scene, charges: Iterable[Charge]) -> list[bpy.types.Object]:
    """Make an empty for each charge, at its position, in place of the scene's charges."""
    bpy.data.batch_remove(charge_objects(scene))
    return create_charges(scene, charges)


def charge_objects(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """Return all objects that stand for charges, in the order in which they came into the scene."""
    return [obj for obj in scene.objects if is_charge(obj)]


def is_charge(obj: bpy.types.Object) -> bool:
    """Return whether an object stands for a charge."""
    return MASS in obj


def charge_collection(scene: bpy.types.Scene) -> bpy.types.Collection | None:
    """Return the collection of charges; None where there was no charge yet."""
    return find_collection(scene, _ROLE)


def charges_of(scene: bpy.types.Scene) -> tuple[Charge, ...]:
    """Return the charges as they are now."""
    return tuple(map(_charge, charge_objects(scene)))


def keep_blast(scene: bpy.types.Scene, settings: BlastSettings) -> None:
    """Keep whether and how charges go off in a scene, which is saved with it."""
    for name, value in table_values(settings).items():
        scene[_OF_BLAST + name] = _NO_VALUE if value is None else value


def blast_of(scene: bpy.types.Scene) -> BlastSettings:
    """Return the settings that a scene keeps; nothing goes off in a scene without settings."""
    if _OF_BLAST + "explosion" not in scene:
        return BlastSettings(explosion=False)
    names = [name for name in table_values(BlastSettings()) if scene.get(_OF_BLAST + name, _NO_VALUE) != _NO_VALUE]
    kept = {name: scene[_OF_BLAST + name] for name in names}
    for name, value in kept.items():
        try:
            table_from_values(BlastSettings, {name: value})
        except ScenarioError as error:
            raise edited(scene, _OF_BLAST + name, f"a value of its key ({error})") from error
    return table_from_values(BlastSettings, kept)


def show_until(charge: bpy.types.Object, frame: int) -> None:
    """Show a charge as a red ball in pictures of the frames before its detonation."""
    show_never(charge)
    charge.instance_type, charge.instance_collection = "COLLECTION", _symbol()
    for hidden, key_frame in ((True, frame), (False, 0)):
        charge.hide_render = hidden
        charge.keyframe_insert(_HIDDEN, frame=key_frame)


def show_never(charge: bpy.types.Object) -> None:
    """Show a charge in no picture any more."""
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
    """Return a red ball for all charges, as pictures show no empties; only they bring it into a scene."""
    for collection in bpy.data.collections:
        if collection.get(_SYMBOL_MARK) and not collection.library:
            return collection
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
    empty.matrix_world = Matrix.Translation(charge.position_m)  # valid at once, unlike a location
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
            position_m=tuple(_position_of(empty)),
            mass_kg=empty[MASS],
            explosive=explosive_named(empty[EXPLOSIVE]).name,
            delay_ms=_in_ms(empty[DELAY]),
            burst=empty[BURST],
        )
    except DemolitionError as error:
        raise BlastError(f"{empty.name}: {error}") from error


def _position_of(empty: bpy.types.Object) -> Vector:
    """Return where a charge is; after undo Blender knows its matrix in the world only once it has drawn it."""
    is_held = empty.parent or len(empty.constraints)
    return (empty.matrix_world if is_held else empty.matrix_basis).translation


def _in_ms(delay_s: float) -> float:
    """Return a delay in ms, as the decimal that it had before it was divided to get s."""
    return float(f"{MS_PER_S * delay_s:.15g}") if isinstance(delay_s, Real) else delay_s
