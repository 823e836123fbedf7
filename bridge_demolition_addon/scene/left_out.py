"""Elements of a file that are no members, shown as wire: nothing is simulated with them."""

from __future__ import annotations

from collections.abc import Mapping

import bpy

from ..engineering.geometry.mesh import TriangleMesh
from .collections import ROLE, collection_for, remove_marked

LEFT_OUT_ROLE = "IFC Left Out"


def show_left_out(scene: bpy.types.Scene, meshes: Mapping[str, TriangleMesh]) -> list[bpy.types.Object]:
    """Show elements by their names as wire, in place of those that were shown before."""
    remove_marked(scene, LEFT_OUT_ROLE)
    shown = []
    for name, mesh in meshes.items():
        data = bpy.data.meshes.new(name)
        data.from_pydata(mesh.vertices.tolist(), [], mesh.triangles.tolist())
        wire = bpy.data.objects.new(name, data)
        wire[ROLE] = LEFT_OUT_ROLE
        wire.display_type, wire.hide_render, wire.hide_select = "WIRE", True, False
        collection_for(scene, LEFT_OUT_ROLE).objects.link(wire)
        shown.append(wire)
    return shown
