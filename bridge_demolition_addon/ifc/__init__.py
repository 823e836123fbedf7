"""Bridges from IFC: which elements are members, of what, where they stand, and the scenario they make. No Blender.

IfcOpenShell is imported where it is used, as it is no part of the installation.
"""
