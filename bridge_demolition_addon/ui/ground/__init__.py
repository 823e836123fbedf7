"""Drawings on the ground and in the air of the 3D view."""
