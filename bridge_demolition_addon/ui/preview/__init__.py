"""Outlines in the 3D view of the bridge that the panels would build, and handles there for points in the panels."""
