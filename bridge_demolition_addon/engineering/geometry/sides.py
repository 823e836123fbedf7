"""Names of the axes and of the sides of a box."""

AXES = ("x", "y", "z")

SIDES = {"start": (0, -1), "end": (0, 1), "right": (1, -1), "left": (1, 1), "bottom": (2, -1), "top": (2, 1)}
"""Axis across each side, and whether the side is where that is lowest or highest."""
