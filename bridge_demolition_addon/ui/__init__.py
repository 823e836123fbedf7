"""Sidebar of the 3D view: properties, operators and panels."""
