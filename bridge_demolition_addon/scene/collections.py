"""The add-on's own collections in a scene, known by a mark, so that the user may rename them."""

from __future__ import annotations

import bpy

ROLE = "bda_role"
"""Property that marks what the add-on made, with what it is for."""


def find_collection(scene: bpy.types.Scene, role: str) -> bpy.types.Collection | None:
    """Return the scene's collection for a role, None where there is none."""
    return next((child for child in scene.collection.children if child.get(ROLE) == role), None)


def collection_for(scene: bpy.types.Scene, role: str) -> bpy.types.Collection:
    """Return the scene's collection for a role; a new one is named after the role."""
    collection = find_collection(scene, role)
    if collection is None:
        collection = bpy.data.collections.new(role)
        collection[ROLE] = role
        scene.collection.children.link(collection)
    return collection


def remove_marked(scene: bpy.types.Scene, role: str) -> int:
    """Remove the objects that are marked with the role of their collection, and return how many there were.

    What only they used goes too: their data, materials and animation, and the collection where it is empty then.
    """
    collection = find_collection(scene, role)
    if collection is None:
        return 0
    ours = [obj for obj in collection.objects if obj.get(ROLE) == role]
    data = {our.data for our in ours}
    actions = {our.animation_data.action for our in ours if our.animation_data}
    materials = {slot.material for our in ours for slot in our.material_slots}
    bpy.data.batch_remove(ours)
    for group in (data | actions, materials):
        bpy.data.batch_remove([part for part in group if part and not part.users])
    if not collection.objects and not collection.children:
        bpy.data.collections.remove(collection)
    return len(ours)
