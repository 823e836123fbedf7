"""Scenarios to start from: those made for the sidebar, and all examples, each with a picture."""

from __future__ import annotations

from pathlib import Path

import bpy
import bpy.utils.previews

from .prop import PRESETS

_PACKAGE = Path(__file__).parents[2]
_EXAMPLES = (_PACKAGE / "examples", _PACKAGE.parent / "examples")
"""Where the examples are: in the extension, or beside the package in a checkout."""

_REPORT_2019 = "report_2019"
"""Folder of the examples with the settings of the 2019 report."""

_EARLIER_NAMES = {"one_span_wrecking_ball": "span_of_2019_ball", "one_span_explosives": "span_of_2019_explosives"}
"""Presets that were renamed, by the names that scripts may still have."""

_SUFFIX, _PICTURE_SUFFIX = ".toml", ".jpg"
_COLUMNS = 5
_PICTURE_SCALE = 5.0
_COLUMN_UNITS = 9.0

_pictures: list[bpy.utils.previews.ImagePreviewCollection] = []
"""One collection, once the menu was opened."""


class BDA_MT_presets(bpy.types.Menu):
    """Scenarios to start from."""

    bl_label = "Presets"

    def draw(self, _context: bpy.types.Context) -> None:
        pictures, files = loaded_pictures(), list(preset_files())
        row = self.layout.row()
        for number in range(_COLUMNS):
            column = row.column()
            column.ui_units_x = _COLUMN_UNITS
            for name in files[number::_COLUMNS]:
                column.template_icon(pictures[name].icon_id, scale=_PICTURE_SCALE)
                column.operator("bda.load_preset", text=label_of_preset(name)).preset = name


def preset_files() -> dict[str, Path]:
    """Return the file of each preset by its name: those made for the sidebar, examples, and those of 2019."""
    examples = next((folder for folder in _EXAMPLES if folder.is_dir()), None)
    folders = (PRESETS, examples, examples / _REPORT_2019) if examples else (PRESETS,)
    return {path.stem: path for folder in folders for path in sorted(folder.glob("*" + _SUFFIX))}


def preset_file(name: str) -> Path:
    """Return the file of a preset, also by the name that it had before."""
    name = _EARLIER_NAMES.get(name, name)
    return preset_files().get(name, PRESETS / (name + _SUFFIX))


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
