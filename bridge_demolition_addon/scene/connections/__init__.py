"""Connections as Blender's rigid-body constraints."""
