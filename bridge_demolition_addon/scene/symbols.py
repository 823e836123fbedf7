"""Showing and hiding the empties that stand for connections and forces."""

from __future__ import annotations

from collections.abc import Iterator

import bpy

from .force_fields import force_collection


def symbols_are_hidden(layer: bpy.types.ViewLayer, scene: bpy.types.Scene) -> bool:
    """Whether all that there are of these empties are hidden; False where there are none."""
    found = list(_collections(layer, scene))
    return bool(found) and all(each.hide_viewport for each in found)


def has_symbols(layer: bpy.types.ViewLayer, scene: bpy.types.Scene) -> bool:
    """Whether there are such empties."""
    return any(True for _ in _collections(layer, scene))


def hide_symbols(layer: bpy.types.ViewLayer, scene: bpy.types.Scene, hidden: bool) -> None:
    """Hide the connections and force objects from view, or show them; they work all the same."""
    for each in _collections(layer, scene):
        each.hide_viewport = hidden


def _collections(layer: bpy.types.ViewLayer, scene: bpy.types.Scene) -> Iterator[bpy.types.LayerCollection]:
    world = scene.rigidbody_world
    wanted = [each for each in (world and world.constraints, force_collection(scene)) if each]
    return (each for each in _all(layer.layer_collection) if each.collection in wanted)


def _all(layer_collection: bpy.types.LayerCollection) -> Iterator[bpy.types.LayerCollection]:
    yield layer_collection
    for child in layer_collection.children:
        yield from _all(child)
