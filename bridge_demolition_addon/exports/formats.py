"""Formats that a run can be exported in."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True, slots=True)
class Format:
    """A format: its name on the command line, its title in a menu, and what is written."""

    name: str
    title: str
    content: str
    ending: str = ""  # of the file; a format of many files has a folder and none


PARAVIEW = Format("paraview", "ParaView", "a folder with series of bodies, centres, connections and contacts")
XLSX = Format("xlsx", "Spreadsheet (XLSX)", "all tables in one workbook", ".xlsx")
GLTF = Format("gltf", "Animated Model (glTF)", "an animated model, which browsers show", ".glb")
USD = Format("usd", "USD", "an animated stage, in double precision", ".usdc")
ALEMBIC = Format("alembic", "Alembic", "an animated scene, by Blender", ".abc")
MAT = Format("mat", "MATLAB", "all arrays in one file, for MATLAB and Octave", ".mat")

FORMATS = {form.name: form for form in (PARAVIEW, XLSX, GLTF, USD, ALEMBIC, MAT)}
"""All formats by their names."""


def new_export(folder: Path, form: Format) -> Path:
    """Return a new file or folder for an export, in the folder of its run: ``export``, and counted up from 2."""
    names = (f"export{number}{form.ending}" for number in ("", *(f"_{n}" for n in range(2, 10_000))))
    return next(path for name in names if not (path := folder / name).exists())
