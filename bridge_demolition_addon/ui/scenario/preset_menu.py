"""Scenarios to start from: those made for the sidebar, and all examples, each with a picture."""

from __future__ import annotations

from pathlib import Path

import bpy
import bpy.utils.previews

from ...model.scenario.file import read_scenario
from ..languages.words import translated
from .prop import PRESETS

_PACKAGE = Path(__file__).parents[2]
_EXAMPLES = (_PACKAGE / "examples", _PACKAGE.parent / "examples")
"""Where the examples are: in the extension, or beside the package in a checkout."""

_ARCHES, _STEEL, _PRESTRESSED, _REPORT_2019 = "arches_and_frames", "steel", "prestressed", "report_2019"
"""Folders of examples, and of presets for the sidebar, beside the bridges of concrete."""

_EARLIER_NAMES = {"one_span_wrecking_ball": "span_of_2019_ball", "one_span_explosives": "span_of_2019_explosives"}
"""Presets that were renamed, by the names that scripts may still have."""

_SUFFIX, _PICTURE_SUFFIX = ".toml", ".jpg"
_COLUMNS = 4
_PICTURE_SCALE = 5.0
_COLUMN_UNITS = 9.0

_pictures: list[bpy.utils.previews.ImagePreviewCollection] = []
"""One collection, once the menu was opened."""


class BDA_MT_presets(bpy.types.Menu):
    """Scenarios to start from."""

    bl_label = "Presets"

    def draw(self, _context: bpy.types.Context) -> None:
        of_2019 = presets_of_2019()
        _draw_pictures(self.layout, [name for name in preset_files() if name not in of_2019])
        if of_2019:
            self.layout.separator()
            self.layout.menu(BDA_MT_presets_of_2019.__name__)


class BDA_MT_presets_of_2019(bpy.types.Menu):
    """Scenarios with the settings of the report of 2019: of plain concrete, and without bearings."""

    bl_label = "Settings of the Report of 2019"

    def draw(self, _context: bpy.types.Context) -> None:
        _draw_pictures(self.layout, presets_of_2019())


def _draw_pictures(layout: bpy.types.UILayout, names: list[str]) -> None:
    """Show presets in columns, each a picture above a button that loads it."""
    pictures, row = loaded_pictures(), layout.row()
    for number in range(_COLUMNS):
        column = row.column()
        column.ui_units_x = _COLUMN_UNITS
        for name in names[number::_COLUMNS]:
            column.template_icon(pictures[name].icon_id, scale=_PICTURE_SCALE)
            column.operator("bda.load_preset", text=label_of_preset(name)).preset = name


def preset_files() -> dict[str, Path]:
    """Return the file of each preset by its name: those made for the sidebar, and examples."""
    examples = next((folder for folder in _EXAMPLES if folder.is_dir()), None)
    of_examples = [examples / name for name in ("", _ARCHES, _STEEL, _PRESTRESSED, _REPORT_2019)] if examples else []
    folders = (PRESETS, *of_examples[:2], PRESETS / _STEEL, *of_examples[2:])
    return {path.stem: path for folder in folders for path in sorted(folder.glob("*" + _SUFFIX))}


def presets_of_2019() -> list[str]:
    """Return the names of the presets with the settings of the report of 2019."""
    return [name for name, path in preset_files().items() if path.parent.name == _REPORT_2019]


def preset_file(name: str) -> Path:
    """Return the file of a preset, also by the name that it had before."""
    name = _EARLIER_NAMES.get(name, name)
    return preset_files().get(name, PRESETS / (name + _SUFFIX))


def described_preset(name: str) -> str:
    """Return in a sentence what a preset is: its title, how many shards it has, and how long it is simulated."""
    scenario = read_scenario(preset_file(name))
    sentence = translated("{}: {} shards, {} s. Show its values in the panels, and its charges in the scene")
    return sentence.format(scenario.title, scenario.fracture.shards, f"{scenario.time.duration_s:g}")


def picture_of_preset(name: str) -> Path:
    """Return the picture of a preset."""
    return PRESETS / (name + _PICTURE_SUFFIX)


def label_of_preset(name: str) -> str:
    """Return what a preset is called in the menu."""
    words = name.replace("_", " ").replace("i235", "I-235").replace("neighbouring", "next")
    return words[:1].upper() + words[1:]


def unregister() -> None:
    """Remove the pictures."""
    while _pictures:
        bpy.utils.previews.remove(_pictures.pop())


def loaded_pictures() -> bpy.utils.previews.ImagePreviewCollection:
    """Pictures of all presets, which Blender loads once."""
    if not _pictures:
        _pictures.append(bpy.utils.previews.new())
        for name in preset_files():
            _pictures[0].load(name, str(picture_of_preset(name)), "IMAGE")
    return _pictures[0]
