"""What the 3D view shows when it is to show the whole bridge."""

import bpy

from ..scene.bodies import Kind, bodies_of, kind_of
from .viewport import look_at_selected, select_only


def shards_in_view(context: bpy.types.Context) -> list[bpy.types.Object]:
    """Return the shards that are in the view layer: Blender selects no others."""
    in_layer = set(context.view_layer.objects)
    return [body for body in bodies_of(context.scene) if kind_of(body) == Kind.SHARD and body in in_layer]


def look_at_shards(context: bpy.types.Context) -> None:
    """Let the view show all shards, and leave selected what is: the ground is too large for Blender's View All."""
    selected = list(context.selected_objects)
    select_only(context, shards_in_view(context))
    look_at_selected(context)
    select_only(context, selected)
