"""Bridge into the Bullet world that Blender keeps in memory."""
