"""The add-on's own collections in a scene, found by a mark, so that the user may rename them."""

from __future__ import annotations

import bpy

_ROLE = "bda_role"


def find_collection(scene: bpy.types.Scene, role: str) -> bpy.types.Collection | None:
    """Return the scene's collection for a role, None where there is none."""
    return next((child for child in scene.collection.children if child.get(_ROLE) == role), None)


def collection_for(scene: bpy.types.Scene, role: str) -> bpy.types.Collection:
    """Return the scene's collection for a role; a new one is named after the role."""
    collection = find_collection(scene, role)
    if collection is None:
        collection = bpy.data.collections.new(role)
        collection[_ROLE] = role
        scene.collection.children.link(collection)
    return collection
