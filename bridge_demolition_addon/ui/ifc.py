"""Bridges of IFC files in the sidebar: their elements, and the buttons that import them."""

import json
from pathlib import Path

import bpy
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, FloatProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from ..errors import IfcError
from ..ifc.folder import REPORT_FILE, SCENARIO_FILE, folder_beside, read_left_out
from ..ifc.import_process import Imported, import_bridge, list_elements
from ..ifc.library import missing_reason
from ..ifc.settings import KINDS, UNITS, ImportSettings
from ..model.scenario.file import read_scenario
from ..scene.user_meshes import show_left_out
from .languages.words import translated
from .modal_task import ModalTask, SteppedThread, Work
from .operators import Action, UndoableAction, absolute
from .scenario.values import show_scenario
from .sidebar import SidebarPanel, draw_sentence, path_property

LEFT_OUT = "left out"

BARS = "Steel as Bars"
BARS_HINT = "Make bars of [steelwork] of straight steel, with nodes where they meet, instead of cutting it into shards"


def _label(kind: str) -> str:
    """Return a kind as the list shows it; Bearing alone is a direction in other panels, and one word in a language."""
    return "Bridge Bearing" if kind == "bearing" else kind.title()


class BDA_PG_ifc_element(bpy.types.PropertyGroup):
    """An element of the file that was looked into."""

    title: StringProperty(name="Element", description="Its name in the file")
    ifc_class: StringProperty(name="Class", description="Its class in the file")
    global_id: StringProperty(name="GlobalId", description="What names it in the file for good")
    kind: EnumProperty(
        name="Kind",
        description="What the element becomes",
        items=[(LEFT_OUT, "Left Out", "It becomes no member"), *((kind, _label(kind), "") for kind in KINDS)],
    )
    kind_of_file: StringProperty(options={"HIDDEN"}, description="What the add-on took it for")
    material: StringProperty(
        name="Material", description="Name in the table of materials, such as concrete, steel, masonry or wood"
    )
    material_of_file: StringProperty(options={"HIDDEN"}, description="What the add-on took its material for")
    why: StringProperty(name="Note", description="Why it is left out, or what was assumed of its material")


class IfcProperties:
    """The file that was looked into, and its elements."""

    ifc_path: path_property("IFC File", "IFC file whose elements are listed")
    ifc_only: StringProperty(
        name="Only", description="Bridge that is taken of a file with several; none for the one with the most members"
    )
    ifc_bars: BoolProperty(name=BARS, description=BARS_HINT, default=True)
    ifc_elements: CollectionProperty(type=BDA_PG_ifc_element, description="Elements of the file")
    ifc_element_index: IntProperty(options={"HIDDEN"}, description="The chosen element")


class BDA_UL_ifc_elements(bpy.types.UIList):
    """Elements of an IFC file: name, kind and material."""

    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index) -> None:
        """Draw a row; what is left out is greyed."""
        row = layout.row(align=True)
        name = row.row()
        name.active = item.kind != LEFT_OUT
        name.label(text=item.title, translate=False)
        row.prop(item, "kind", text="", emboss=False)
        material = row.row()
        material.active = item.kind not in (LEFT_OUT, "bearing")
        material.prop(item, "material", text="", emboss=False)


class BDA_PT_ifc_elements(SidebarPanel, bpy.types.Panel):
    """What the elements of an IFC file become."""

    bl_label = "IFC Elements"
    bl_options = set()  # open, and up there with its button: it is there only once a file was looked into

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return bool(context.scene.bda.ifc_elements)

    def draw(self, context: bpy.types.Context) -> None:
        layout, settings = self.layout, context.scene.bda
        layout.template_list("BDA_UL_ifc_elements", "", settings, "ifc_elements", settings, "ifc_element_index", rows=8)
        index = settings.ifc_element_index
        if 0 <= index < len(settings.ifc_elements):
            element = settings.ifc_elements[index]
            why = element.why or translated("as the file says")
            draw_sentence(layout, context, f"{element.ifc_class}, {why}", icon="INFO")
            layout.operator("bda.ifc_alike", icon="SORTALPHA")
        layout.prop(settings, "ifc_only")
        layout.prop(settings, "ifc_bars")
        layout.operator("bda.import_ifc_elements", icon="IMPORT")


_NO_LIBRARY = (lambda _context: missing_reason(),)

_UNIT_OF_FILE = "FILE"
_UNIT_NAMES = {"m": "Metres", "cm": "Centimetres", "mm": "Millimetres", "ft": "Feet", "in": "Inches"}


class BDA_OT_import_ifc(UndoableAction, ImportHelper, bpy.types.Operator):
    """Make a scenario of a bridge in an IFC file, with a mesh for each element, and show it in the panels"""

    bl_label = "Import IFC"
    blocked_by = _NO_LIBRARY
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
    bars: BoolProperty(name=BARS, description=BARS_HINT, default=True)
    _is_in_window = False
    kinds: StringProperty(
        name="Kinds", description="What elements are, as in Proxy*=deck;IfcPlate=girder, where the file does not say it"
    )

    def draw(self, _context: bpy.types.Context) -> None:
        """Draw the choices next to the files."""
        layout = self.layout
        layout.use_property_split = True
        for name in ("material", "materials", "unit", "own_ground"):
            layout.prop(self, name)
        row = layout.row()
        row.enabled = self.own_ground
        row.prop(self, "ground_m")
        for name in ("shards", "bars", "without", "kinds"):
            layout.prop(self, name)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        self._is_in_window = True
        return super().invoke(context, event)

    def act(self, context: bpy.types.Context) -> str | None:
        if not self.filepath:
            raise IfcError("no IFC file was given: choose one")
        path = absolute(self.filepath)
        settings = self._settings()
        if self._is_in_window:  # Blender goes on drawing meanwhile, and Esc stops it
            bpy.ops.bda.import_ifc_file("INVOKE_DEFAULT", path=str(path), settings=json.dumps(settings.as_json()))
            return None
        folder = folder_beside(path)
        return _shown(context, import_bridge(path, folder, settings), folder)

    def _settings(self) -> ImportSettings:
        return ImportSettings(
            materials=absolute(self.materials) if self.materials else None,
            material=self.material.strip() or None,
            unit=None if self.unit == _UNIT_OF_FILE else self.unit,
            ground_m=self.ground_m if self.own_ground else None,
            shards=self.shards,
            without=_parts(self.without),
            kinds=tuple(_kind(part) for part in _parts(self.kinds)),
            bars=self.bars,
        )


class BDA_OT_look_into_ifc(Action, ImportHelper, bpy.types.Operator):
    """List the elements of an IFC file, with their kinds and materials, to be corrected before anything is built"""

    bl_label = "Look into IFC"
    blocked_by = _NO_LIBRARY

    filename_ext = ".ifc"
    filter_glob: StringProperty(default="*.ifc", options={"HIDDEN"})
    filepath: path_property("File", "IFC file of a bridge")

    def act(self, context: bpy.types.Context) -> str:
        if not self.filepath:
            raise IfcError("no IFC file was given: choose one")
        listed = list_elements(absolute(self.filepath), ImportSettings())
        settings = context.scene.bda
        settings.ifc_path, settings.ifc_element_index = self.filepath, 0
        settings.ifc_elements.clear()
        for element in listed:
            row = settings.ifc_elements.add()
            row.title, row.ifc_class, row.global_id = element.name, element.ifc_class, element.global_id
            row.kind = row.kind_of_file = element.kind or LEFT_OUT
            row.material = row.material_of_file = element.material
            row.why = element.why or element.note
        bridges = list(dict.fromkeys(element.bridge for element in listed if element.bridge and element.kind))
        settings.ifc_only = ""
        several = f"; it has the bridges {', '.join(bridges)}: choose one in Only" if len(bridges) > 1 else ""
        members = sum(bool(element.kind) for element in listed)
        return (
            f"{len(listed)} elements, {members} of which become members or bearings: correct them in IFC Elements, "
            f"below these buttons{several}"
        )


class BDA_OT_ifc_alike(UndoableAction, bpy.types.Operator):
    """Give all elements of the same name kind and material of the chosen one"""

    bl_label = "Same for All of This Name"

    def act(self, context: bpy.types.Context) -> str:
        settings = context.scene.bda
        if not 0 <= settings.ifc_element_index < len(settings.ifc_elements):
            raise IfcError("no element is chosen: choose one in the list")
        chosen = settings.ifc_elements[settings.ifc_element_index]
        alike = [row for row in settings.ifc_elements if row.title == chosen.title]
        for row in alike:
            row.kind, row.material = chosen.kind, chosen.material
        return f"{len(alike)} elements are {chosen.kind} now"


class _ImportTask(ModalTask):
    """Base of imports that go on while Blender draws, with progress, until they are done or Esc stops them."""

    task, unit = "Importing", "elements"
    changes_objects = True

    def chosen(self, context: bpy.types.Context) -> tuple[Path, ImportSettings]:
        """Return the file, and what the user adds to it."""
        raise NotImplementedError

    def work(self, context: bpy.types.Context) -> Work:
        path, settings = self.chosen(context)
        self._folder = folder_beside(path)

        def imported(progress: SteppedThread) -> None:
            self._imported = import_bridge(path, self._folder, settings, progress)

        return imported

    def finish(self, context: bpy.types.Context) -> set[str]:
        super().finish(context)
        self.report({"INFO"}, _shown(context, self._imported, self._folder))
        return {"FINISHED"}


class BDA_OT_import_ifc_file(_ImportTask, bpy.types.Operator):
    """Make a scenario of the bridge in an IFC file that was chosen, and show it in the panels"""

    bl_label = "Import IFC File"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}
    blocked_by = _NO_LIBRARY

    path: StringProperty(name="Path", options={"HIDDEN"}, description="IFC file of a bridge")
    settings: StringProperty(name="Settings", options={"HIDDEN"}, description="What the user adds to it, as JSON")

    def chosen(self, _context: bpy.types.Context) -> tuple[Path, ImportSettings]:
        return Path(self.path), ImportSettings.from_json(json.loads(self.settings))


class BDA_OT_import_ifc_elements(_ImportTask, bpy.types.Operator):
    """Make a scenario of the listed elements as they are corrected here, and show it in the panels"""

    bl_label = "Import These Elements"
    blocked_by = (
        *_NO_LIBRARY,
        lambda context: None if context.scene.bda.ifc_elements else "Look into an IFC file first",
    )

    def chosen(self, context: bpy.types.Context) -> tuple[Path, ImportSettings]:
        settings = context.scene.bda
        return absolute(settings.ifc_path), corrected(settings)


def corrected(settings: bpy.types.PropertyGroup) -> ImportSettings:
    """Return the settings of an import with the corrections of the table."""
    changed = [row for row in settings.ifc_elements if row.kind != row.kind_of_file]
    return ImportSettings(
        without=tuple(row.global_id for row in changed if row.kind == LEFT_OUT),
        kinds=tuple((row.global_id, row.kind) for row in changed if row.kind != LEFT_OUT),
        materials_of=tuple(
            (row.global_id, row.material.strip())
            for row in settings.ifc_elements
            if row.kind not in (LEFT_OUT, "bearing") and row.material.strip() and row.material != row.material_of_file
        ),
        only=settings.ifc_only.strip() or None,
        bars=settings.ifc_bars,
    )


def _shown(context: bpy.types.Context, imported: Imported, folder: Path) -> str:
    """Show the scenario of an import in the panels, and return a sentence on it."""
    settings = context.scene.bda
    show_scenario(settings, read_scenario(folder / SCENARIO_FILE))
    settings.scenario_path = settings.loaded_path = str(folder / SCENARIO_FILE)
    show_left_out(context.scene, read_left_out(folder))
    return _done(imported, folder)


def _parts(text: str) -> tuple[str, ...]:
    return tuple(part.strip() for part in text.split(";") if part.strip())


def _kind(text: str) -> tuple[str, str]:
    name, equals, kind = text.rpartition("=")
    if not equals:
        raise IfcError(f'kinds has "{text}": expected NAME=KIND')
    return name.strip(), kind.strip()


def _done(imported: Imported, folder: Path) -> str:
    return (
        f"Imported {imported.title}: {imported.members} members, {imported.connections} bearings, "
        f"{imported.left_out} elements left out; {folder / REPORT_FILE} says why"
    )
