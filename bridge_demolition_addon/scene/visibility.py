"""Showing and hiding the empties that stand for connections and forces."""

from __future__ import annotations

from collections.abc import Iterator

import bpy

from .blast.force_fields import force_collection


def symbols_are_hidden(layer: bpy.types.ViewLayer, scene: bpy.types.Scene) -> bool:
    """Return whether all of these empties are hidden; False where there are none."""
    if not has_symbols(layer, scene):
        return False
    of_collections = (collection.hide_viewport for collection in _collections(layer, scene))
    return all(of_collections) and all(empty.hide_get(view_layer=layer) for empty in _loose(layer, scene))


def has_symbols(layer: bpy.types.ViewLayer, scene: bpy.types.Scene) -> bool:
    """Return whether there are such empties."""
    return any(_collections(layer, scene)) or any(_loose(layer, scene))


def hide_symbols(layer: bpy.types.ViewLayer, scene: bpy.types.Scene, hidden: bool) -> None:
    """Hide the connections and force fields from view, or show them; they work all the same."""
    for collection in _collections(layer, scene):
        collection.hide_viewport = hidden
    for empty in _loose(layer, scene):
        empty.hide_set(hidden, view_layer=layer)


def _collections(layer: bpy.types.ViewLayer, scene: bpy.types.Scene) -> Iterator[bpy.types.LayerCollection]:
    world = scene.rigidbody_world
    wanted = [collection for collection in (world and world.constraints, force_collection(scene)) if collection]
    return (shown for shown in _all(layer.layer_collection) if shown.collection in wanted)


def _loose(layer: bpy.types.ViewLayer, scene: bpy.types.Scene) -> Iterator[bpy.types.Object]:
    """Return empties of connections whose collection is not in the scene, as with Blender's own buttons."""
    constraints = scene.rigidbody_world and scene.rigidbody_world.constraints
    if not constraints or any(shown.collection == constraints for shown in _all(layer.layer_collection)):
        return
    yield from (obj for obj in constraints.objects if obj.type == "EMPTY" and obj.name in layer.objects)


def _all(layer_collection: bpy.types.LayerCollection) -> Iterator[bpy.types.LayerCollection]:
    yield layer_collection
    for child in layer_collection.children:
        yield from _all(child)
