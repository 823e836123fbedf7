"""Sections through the pile in the 3D view."""
