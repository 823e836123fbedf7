"""Operators that make a scenario of the user's own objects: meshes become members, and paint says where to cut finer.

Both write files that the scenario names, so that it can be saved, sent and run without the objects.
"""

import re
from pathlib import Path

import bpy
from bpy.props import BoolProperty, FloatProperty, StringProperty

from ...errors import GeometryError, OutputError
from ...model.bridge.mesh_files import exported
from ...model.structure.point_files import paint_text
from ...scene.user_meshes import painted_points, solid_of_object
from ..operators import FileWriter, UndoableAction, absolute, write_file
from ..recording.session import new_folder
from ..sidebar import path_property
from .preset_menu import name_own_model

_CONCRETE_KG_M3 = 2400.0
_MESH_SUFFIX, _PAINT_SUFFIX = ".ply", ".csv"


_FOLDER = "members"
"""Folders of meshes are called so, with a number."""


def _selected_meshes(context: bpy.types.Context) -> list[bpy.types.Object]:
    return [chosen for chosen in context.selected_objects if chosen.type == "MESH"]


def _no_mesh_selected(context: bpy.types.Context) -> str | None:
    return None if _selected_meshes(context) else "Select the meshes that are to be members first"


class BDA_OT_add_selected_members(UndoableAction, bpy.types.Operator):
    """Add the selected meshes to the scenario as members, each in a file of a new folder, and hide them"""

    bl_label = "Add Selected Meshes"
    changes_objects = True
    blocked_by = (_no_mesh_selected,)

    directory: path_property("Folder", "Folder that the meshes are written to; a new one if none is given", "DIR_PATH")
    density_kg_m3: FloatProperty(
        name="Density", description="Density of all of them, kg/m³", default=_CONCRETE_KG_M3, min=1e-3
    )
    with_bridge: BoolProperty(
        name="Keep Bridge Too",
        description="Build the bridge of the panel Sizes as well; otherwise it is switched off there, and only the "
        "meshes are built",
        default=False,
    )

    def act(self, context: bpy.types.Context) -> str:
        scenario, selected = context.scene.bda.scenario, _selected_meshes(context)
        tables = scenario.geometry
        solids = {member.name: solid_of_object(member) for member in selected}
        folder = absolute(self.directory) if self.directory else new_folder(_FOLDER)
        files = _new_files(folder, list(solids), {absolute(table.file) for table in tables})
        for name, path in files.items():
            write_file(path, exported(solids[name].solid, _MESH_SUFFIX), new_folder=True)
        for name, path in files.items():  # only now, as writing may fail
            table = next((table for table in tables if table.name == name), None) or tables.add()
            table.name, table.file = name, str(path)
            table.use_density_kg_m3, table.density_kg_m3, table.use_mass_kg = True, self.density_kg_m3, False
        for member in selected:
            member.hide_set(True)
        scenario.geometry_index = len(tables) - 1
        switched_off = scenario.use_bridge and not self.with_bridge
        scenario.use_bridge = scenario.use_bridge and self.with_bridge
        name_own_model(context.scene.bda)
        for name, repaired in solids.items():
            for repair in repaired.repairs:
                self.report({"INFO"}, f"{name}: {repair}")
        done = f"{len(files)} members added from the selected meshes, which are hidden now"
        if others := [chosen.name for chosen in context.selected_objects if chosen.type != "MESH"]:
            done += f"; no meshes, and left out: {', '.join(others)}"
        return f"{done}; the panel Sizes is switched off" if switched_off else done


def _no_paint(context: bpy.types.Context) -> str | None:
    body = context.active_object
    is_painted = body is not None and body.type == "MESH" and body.vertex_groups
    return None if is_painted else "Choose a mesh with a vertex group first, such as one that was painted with weights"


class BDA_OT_use_paint(UndoableAction, FileWriter, bpy.types.Operator):
    """Cut the bridge finer where the active mesh is painted: its active vertex group is written to a file"""

    bl_label = "Cut Finer Where Painted"
    blocked_by = (_no_paint,)

    filename_ext = _PAINT_SUFFIX
    filter_glob: StringProperty(default="*" + _PAINT_SUFFIX, options={"HIDDEN"})

    def usual_path(self, context: bpy.types.Context) -> str:
        return f"{_file_name(context.active_object.name)} painted{_PAINT_SUFFIX}"

    def act(self, context: bpy.types.Context) -> str:
        body, fracture = context.active_object, context.scene.bda.scenario.fracture
        group = body.vertex_groups.active.name
        if not self.filepath:
            raise OutputError("no file for the paint was given: choose one")
        path = absolute(bpy.path.ensure_ext(self.filepath, _PAINT_SUFFIX))
        points, weights = painted_points(body, group)
        if not weights.any():
            raise GeometryError(f"{body.name}: nothing is painted in vertex group {group!r}; paint where to cut finer.")
        write_file(path, paint_text(points, weights).encode(), new_folder=True)
        fracture.use_painted_file, fracture.painted_file = True, str(path)
        return f"{int((weights > 0.0).sum())} of {len(weights)} vertices are painted in {group!r}"


def _new_files(folder: Path, names: list[str], ours: set[Path]) -> dict[str, Path]:
    """Return a file for each name; a file that is there already has to be one of the scenario's own."""
    files = {name: folder / (_file_name(name) + _MESH_SUFFIX) for name in names}
    if len(set(files.values())) < len(files):
        raise OutputError("two of the objects would have the same file name: rename one of them")
    for path in files.values():
        if path.exists() and path not in ours:
            raise OutputError(f"{path}: exists already; choose another folder, or rename the object")
    return files


def _file_name(name: str) -> str:
    return re.sub(r"[^\w .()+-]", "_", name)
