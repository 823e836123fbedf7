"""What the 3D view shows when it is to show the whole bridge."""

import bpy

from ..scene.bodies import Kind, bodies_of, kind_of
from .viewport import look_at_selected, select_only


def look_at_shards(context: bpy.types.Context) -> None:
    """Let the view show all shards, and leave selected what is: the ground is too large for Blender's View All."""
    selected = list(context.selected_objects)
    select_only(context, [body for body in bodies_of(context.scene) if kind_of(body) == Kind.SHARD])
    look_at_selected(context)
    select_only(context, selected)
