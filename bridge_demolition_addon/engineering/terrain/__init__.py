"""Surfaces of the ground: rasters, triangles, contour lines."""
