"""Blender data without user interface: bodies, connections, ball, pictures."""
