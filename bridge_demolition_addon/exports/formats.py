"""Formats that a run can be exported in."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Format:
    """A format.

    Attributes
    ----------
    name
        What users call it.
    what
        What is written, in a few words.
    ending
        Of the file; empty for a format of many files, which have a folder.
    """

    name: str
    what: str
    ending: str = ""


PARAVIEW = Format("paraview", "a folder with series of all bodies, centres and connections")
XLSX = Format("xlsx", "all tables in one workbook", ".xlsx")
GLTF = Format("gltf", "an animated model, which browsers show", ".glb")
USD = Format("usd", "an animated stage, in double precision", ".usdc")
ALEMBIC = Format("alembic", "an animated scene, by Blender", ".abc")

FORMATS = {each.name: each for each in (PARAVIEW, XLSX, GLTF, USD, ALEMBIC)}
"""All formats by their names."""
