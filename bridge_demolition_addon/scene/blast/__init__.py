"""Charges and force fields as Blender objects."""
