"""Collections of our own in a scene, found by a mark, so that they may be renamed."""

from __future__ import annotations

import bpy

_ROLE = "bda_role"


def find_collection(scene: bpy.types.Scene, role: str) -> bpy.types.Collection | None:
    """The scene's collection for a role, if there is one."""
    return next((each for each in scene.collection.children if each.get(_ROLE) == role), None)


def collection_for(scene: bpy.types.Scene, role: str) -> bpy.types.Collection:
    """The scene's collection for a role, made where there is none yet; the role is its first name."""
    collection = find_collection(scene, role)
    if collection is None:
        collection = bpy.data.collections.new(role)
        collection[_ROLE] = role
        scene.collection.children.link(collection)
    return collection
