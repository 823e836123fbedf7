"""What keeps Blender from crashing."""
