"""The button that makes a scenario of a bridge in an IFC file."""

from pathlib import Path

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from ...errors import IfcError
from ...ifc.folder import REPORT_FILE, SCENARIO_FILE
from ...ifc.import_process import Imported, import_bridge
from ...ifc.library import missing_reason
from ...ifc.settings import UNITS, ImportSettings
from ...model.scenario.file import read_scenario
from ..operators import UndoableAction, absolute
from ..scenario.values import show_scenario
from ..sidebar import path_property

_UNIT_OF_FILE = "FILE"
_UNIT_NAMES = {"m": "Metres", "cm": "Centimetres", "mm": "Millimetres", "ft": "Feet", "in": "Inches"}


class BDA_OT_import_ifc(UndoableAction, ImportHelper, bpy.types.Operator):
    """Make a scenario of a bridge in an IFC file, with a mesh for each element, and show it in the panels"""

    bl_label = "Import IFC"
    blocked_by = (lambda _context: missing_reason(),)
    changes_objects = True

    filename_ext = ".ifc"
    filter_glob: StringProperty(default="*.ifc", options={"HIDDEN"})
    filepath: path_property("File", "IFC file of a bridge")
    material: StringProperty(
        name="Material",
        description="Material of elements without one, or with one that the table does not know; none refuses them",
        default="concrete",
    )
    materials: path_property("Materials", "Table of materials by name, as bda import --write-materials writes it")
    unit: EnumProperty(
        name="Unit",
        description="Unit of length of the file",
        items=(
            (_UNIT_OF_FILE, "As in the File", "That the file gives"),
            *((unit, _UNIT_NAMES[unit], "In place of that of the file") for unit in UNITS),
        ),
    )
    own_ground: BoolProperty(
        name="Own Ground", description="Set the height of the ground; otherwise it is that of the lowest underside"
    )
    ground_m: FloatProperty(name="Ground", description="Height of the ground in the file", unit="LENGTH", precision=3)
    shards: IntProperty(name="Shards", description="Into how many shards the bridge is cut", default=300, min=1)
    without: StringProperty(
        name="Without", description="Elements to leave out, by name, class or kind, with * for anything and ; between"
    )
    kinds: StringProperty(
        name="Kinds", description="What elements are, as in Proxy*=deck;IfcPlate=girder, where the file does not say it"
    )

    def draw(self, _context: bpy.types.Context) -> None:
        """Draw the choices beside the files."""
        layout = self.layout
        layout.use_property_split = True
        for name in ("material", "materials", "unit", "own_ground"):
            layout.prop(self, name)
        row = layout.row()
        row.enabled = self.own_ground
        row.prop(self, "ground_m")
        for name in ("shards", "without", "kinds"):
            layout.prop(self, name)

    def act(self, context: bpy.types.Context) -> str:
        if not self.filepath:
            raise IfcError("no IFC file was given: choose one")
        path = absolute(self.filepath)
        folder = _new_folder(path)
        imported = import_bridge(path, folder, self._settings())
        settings = context.scene.bda
        show_scenario(settings, read_scenario(folder / SCENARIO_FILE))
        settings.scenario_path = settings.loaded_path = str(folder / SCENARIO_FILE)
        return _done(imported, folder)

    def _settings(self) -> ImportSettings:
        return ImportSettings(
            materials=absolute(self.materials) if self.materials else None,
            material=self.material.strip() or None,
            unit=None if self.unit == _UNIT_OF_FILE else self.unit,
            ground_m=self.ground_m if self.own_ground else None,
            shards=self.shards,
            without=_parts(self.without),
            kinds=tuple(_kind(part) for part in _parts(self.kinds)),
        )


def _parts(text: str) -> tuple[str, ...]:
    return tuple(part.strip() for part in text.split(";") if part.strip())


def _kind(text: str) -> tuple[str, str]:
    name, equals, kind = text.rpartition("=")
    if not equals:
        raise IfcError(f'kinds has "{text}": expected NAME=KIND')
    return name.strip(), kind.strip()


def _new_folder(path: Path) -> Path:
    """Return a folder beside the IFC file that is not there yet."""
    folders = (path.with_name(f"{path.stem}_scenario{ending}") for ending in ("", *(f"_{n}" for n in range(2, 10_000))))
    return next(folder for folder in folders if not folder.exists())


def _done(imported: Imported, folder: Path) -> str:
    return (
        f"Imported {imported.title}: {imported.members} members, {imported.connections} bearings, "
        f"{imported.left_out} elements left out; {folder / REPORT_FILE} says why"
    )
