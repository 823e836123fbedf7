"""Meshes, solids, hulls and nearness. Knows no bridge."""
