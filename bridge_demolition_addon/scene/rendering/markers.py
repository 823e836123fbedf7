"""Marks of a run: its events on the timeline; blast zones in pictures until they fire, and a flash as they do.

They are objects that only renders show: the 3D view draws zones itself.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import bpy
import numpy as np

from ...display.colour_scale import linear
from ...display.zone_boxes import delay_colours, flash_of, zone_rods
from ...engineering.geometry.mesh import TriangleMesh
from ...model.scenario.kept import values_text
from ...model.structure.blast_zones import PlacedZone
from ..bodies import mesh_of
from ..collections import ROLE, collection_for, remove_marked
from ..custom_properties import keep, kept_values
from .materials import new_nodes

_OURS = "bda_markers"
"""Property of a scene: frames and names of the add-on's markers, as markers have no properties."""

_LOCKED = "bda_markers_locked"
"""Property of a scene whose markers the add-on has locked."""


def mark_moments(scene: bpy.types.Scene, moments: Iterable[tuple[int, str]]) -> None:
    """Mark frames by name, in place of the markers of the run before.

    Where the user has no markers, they are locked: in a low timeline they cover the ruler, and a drag along it would
    move one of them.
    """
    clear_markers(scene)
    if not scene.timeline_markers and not scene.tool_settings.lock_markers:
        scene.tool_settings.lock_markers = scene[_LOCKED] = True
    made = [[frame, name] for frame, name in moments]
    for frame, name in made:
        scene.timeline_markers.new(name, frame=frame)
    scene[_OURS] = values_text(made)


def clear_markers(scene: bpy.types.Scene) -> None:
    """Remove the add-on's markers that are still where they were put."""
    ours = kept_values(scene, _OURS, [])
    for marker in list(scene.timeline_markers):
        if [marker.frame, marker.name] in ours:
            scene.timeline_markers.remove(marker)
    keep(scene, _OURS, None)
    if _LOCKED in scene:
        scene.tool_settings.lock_markers = False
        del scene[_LOCKED]


_ZONES = "Blast zones"
_FLASH_COLOUR = (1.0, 0.75, 0.1)
_HIDDEN = "hide_render"


@dataclass(frozen=True, slots=True)
class ShownZone:
    """A zone, the frame in which it has fired, and that in which its flash is over; None for one that never fires."""

    placed: PlacedZone
    fired_in: int | None
    flashes_until: int | None = None


def show_zones(scene: bpy.types.Scene, zones: Sequence[ShownZone]) -> None:
    """Show zones in pictures, in place of those that there were; they take no part in the simulation."""
    remove_zones(scene)
    if not zones:
        return
    collection = collection_for(scene, _ZONES)
    for shown, colour in zip(zones, delay_colours([shown.placed for shown in zones]), strict=True):
        name = str(shown.placed.zone.name)
        rods = _object(collection, name, zone_rods(shown.placed), linear(colour))
        if shown.fired_in is None:
            continue
        _hide(rods, ((0, False), (shown.fired_in, True)))
        flash = _object(collection, f"{name} fires", flash_of(shown.placed), _FLASH_COLOUR)
        _hide(flash, ((0, True), (shown.fired_in, False), (shown.flashes_until or shown.fired_in + 1, True)))


def remove_zones(scene: bpy.types.Scene) -> int:
    """Remove all of them, and return how many objects there were."""
    return remove_marked(scene, _ZONES)


def _object(
    collection: bpy.types.Collection, name: str, solid: TriangleMesh, colour: Iterable[float] | np.ndarray
) -> bpy.types.Object:
    made = bpy.data.objects.new(name, mesh_of(name, solid))
    made[ROLE] = _ZONES
    made.color = (*(float(part) for part in colour), 1.0)
    made.data.materials.append(_material(name, tuple(made.color)))
    made.hide_viewport = made.hide_select = True
    collection.objects.link(made)
    return made


def _material(name: str, colour: tuple[float, ...]) -> bpy.types.Material:
    """Return a material that has its colour in the shade as well."""
    material = bpy.data.materials.new(name)
    material.diffuse_color = colour
    emission, output = new_nodes(material, "ShaderNodeEmission", "ShaderNodeOutputMaterial")
    emission.inputs["Color"].default_value = colour
    material.node_tree.links.new(emission.outputs[0], output.inputs["Surface"])
    return material


def _hide(made: bpy.types.Object, frames: Iterable[tuple[int, bool]]) -> None:
    for frame, hidden in frames:
        made.hide_render = hidden
        made.keyframe_insert(_HIDDEN, frame=frame)
