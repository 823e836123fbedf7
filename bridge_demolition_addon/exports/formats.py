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
    title
        What a menu calls it.
    what
        What is written, in a few words.
    ending
        Of the file; empty for a format of many files, which have a folder.
    """

    name: str
    title: str
    what: str
    ending: str = ""


PARAVIEW = Format("paraview", "ParaView", "a folder with series of bodies, centres, connections and contacts")
XLSX = Format("xlsx", "Spreadsheet (XLSX)", "all tables in one workbook", ".xlsx")
GLTF = Format("gltf", "Animated Model (glTF)", "an animated model, which browsers show", ".glb")
USD = Format("usd", "USD", "an animated stage, in double precision", ".usdc")
ALEMBIC = Format("alembic", "Alembic", "an animated scene, by Blender", ".abc")
MAT = Format("mat", "MATLAB", "all arrays in one file, for MATLAB and Octave", ".mat")

FORMATS = {each.name: each for each in (PARAVIEW, XLSX, GLTF, USD, ALEMBIC, MAT)}
"""All formats by their names."""
