"""Scenarios to start from: those made for the sidebar, and all examples, by their pictures or by their names."""

import tomllib
from functools import cache
from pathlib import Path

import bpy
import bpy.utils.previews
from bpy.props import EnumProperty

from ...model.scenario.file import read_scenario
from ..languages.words import translated
from ..messages import messages_of, note
from .prop import PRESETS

_PACKAGE = Path(__file__).parents[2]
_EXAMPLES = (_PACKAGE / "examples", _PACKAGE.parent / "examples")
"""Where the examples are: in the extension, or beside the package in a checkout."""

_ARCHES, _STEEL, _PRESTRESSED, _REPORT_2019 = "arches_and_frames", "steel", "prestressed", "report_2019"
"""Folders of examples, and of presets for the sidebar, beside the bridges of concrete."""

_EARLIER_NAMES = {"one_span_wrecking_ball": "span_of_2019_ball", "one_span_explosives": "span_of_2019_explosives"}
"""Presets that were renamed, by the names that scripts may still have."""

_SUFFIX, _PICTURE_SUFFIX = ".toml", ".jpg"
_COLUMNS = 2
_SHOWN_SCALE = 5.0
"""Height of the picture in the panel, over that of a line."""
_PICTURE_SCALE = 4.5
"""Of those to choose from, of which 8 are beside each other: all fit below it in a window of 1280 x 800."""

_BELOW_PICTURE = {
    "reinforced_span_ball": "RC span, ball",
    "reinforced_spans_pier_removed": "RC, no pier",
    "span_of_2019_ball": "2019, ball",
    "span_of_2019_explosives": "2019, blast",
    "three_span_box_girder": "Box girder",
    "two_spans_13m_ball": "2 x 13 m, ball",
    "frame_leg_blasted": "Frame, blast",
    "deck_truss_severed": "Deck truss",
    "rolled_beams_severed": "Rolled beams",
    "steel_box_girder_dropped": "Steel box",
    "composite_span_dropped": "Composite",
    "tower_pulled_over": "Tower pulled",
    "beam_cut_in_stages": "Beam in cuts",
    "i235_one_span": "I-235 single",
    "i235_three_spans_between_decks": "I-235 decks",
    "i235_three_spans_mid_span": "I-235 middle",
    "i235_three_spans_near_end": "I-235 end",
    "i235_three_spans_neighbouring_deck": "I-235 next",
    "i235_two_spans": "I-235 double",
    "jackhammer_dismantling": "Jackhammers",
    "single_span_awake": "Span awake",
    "single_span_explosives": "Span, blast",
    "two_spans_13m_explosives": "2 x 13 m, blast",
    "two_spans_20m_at_once": "2 x 20 m, once",
    "two_spans_20m_delays": "2 x 20 m, then",
}
"""Names of presets whose own are too long below their picture, where Blender cuts them off."""

_NO_ICON = "FILE_BLANK"
_BUTTON, _REFUSED = "bda.load_preset", "poll()"
"""The button of a preset, and what Blender says before its reason why that cannot work now."""

_pictures: list[bpy.utils.previews.ImagePreviewCollection] = []
"""One collection, once the menu was opened."""


class BDA_MT_presets(bpy.types.Menu):
    """Scenarios to start from."""

    bl_label = "Presets"

    def draw(self, _context: bpy.types.Context) -> None:
        of_2019 = presets_of_2019()
        _draw_names(self.layout, [name for name in preset_files() if name not in of_2019])
        if of_2019:
            self.layout.separator()
            self.layout.menu(BDA_MT_presets_of_2019.__name__)


class BDA_MT_presets_of_2019(bpy.types.Menu):
    """Scenarios with the settings of the report of 2019: of plain concrete, and without bearings."""

    bl_label = "Settings of the Report of 2019"

    def draw(self, _context: bpy.types.Context) -> None:
        _draw_names(self.layout, presets_of_2019())


class PresetProperties:
    """The preset that the panels began from, as a picture which opens those of all presets when it is clicked."""

    preset: EnumProperty(
        name="Presets",
        description="Click to choose a scenario to start from, by its picture. There road, banks, figures, machines, "
        "dust and bars are for looks only",
        items=lambda settings, context: _items(settings, context),
        get=lambda settings: _shown_number(settings),
        set=lambda _, number: _load(number),
    )


def draw_presets(layout: bpy.types.UILayout, settings: bpy.types.PropertyGroup) -> None:
    """Draw the picture of the preset that is shown, which opens all others."""
    layout.template_icon_view(settings, "preset", show_labels=True, scale=_SHOWN_SCALE, scale_popup=_PICTURE_SCALE)


def _items(
    settings: bpy.types.PropertyGroup, _context: bpy.types.Context | None
) -> list[tuple[str, str, str, int, int]]:
    """Return all presets as Blender takes them, and one more where none of them is shown."""
    items = _preset_items(bpy.app.translations.locale)
    return items if _shown_number(settings) else _with_none(bpy.app.translations.locale)


@cache
def _preset_items(_locale: str) -> list[tuple[str, str, str, int, int]]:
    """Return them with their numbers, which count from 1; a list that stays, as Blender keeps none of its texts."""
    pictures = loaded_pictures()
    return [
        (name, label_below_picture(name), described_preset(name), pictures[name].icon_id, number)
        for number, name in enumerate(preset_files(), start=1)
    ]


@cache
def _with_none(locale: str) -> list[tuple[str, str, str, int | str, int]]:
    """Return them after one that stands for a scenario of the user's own."""
    none = ("NONE", translated("No Preset"), translated("The title of the scenario is that of no preset"), _NO_ICON, 0)
    return [none, *_preset_items(locale)]


@cache
def _numbers_by_title() -> dict[str, int]:
    """Return the number of each preset by the title of its scenario; no two have the same."""
    return {_title_in(path): number for number, path in enumerate(preset_files().values(), start=1)}


def _title_in(path: Path) -> str:
    return str(tomllib.loads(path.read_text(encoding="utf-8"))["scenario"]["title"])


def _shown_number(settings: bpy.types.PropertyGroup) -> int:
    return _numbers_by_title().get(settings.scenario.title, 0)


def name_own_model(settings: bpy.types.PropertyGroup) -> None:
    """Replace the title of a preset by the name of the file where the panels show no longer what that is of.

    Folders, results and reports have that title.
    """
    shown, number = settings.scenario, _shown_number(settings)
    if not number:
        return
    preset = read_scenario(list(preset_files().values())[number - 1])
    of_preset = (preset.bridge is not None, preset.steelwork is not None, [table.name for table in preset.geometry])
    if (shown.use_bridge, shown.use_steelwork, [table.name for table in shown.geometry]) != of_preset:
        shown.title = Path(bpy.data.filepath).stem or translated("Own model")


def _load(number: int) -> None:
    """Load the preset of a number as its button does; Blender makes the step of undo."""
    if not number:
        return
    try:
        bpy.ops.bda.load_preset("INVOKE_DEFAULT", preset=list(preset_files())[number - 1])
    except RuntimeError as error:  # refused: a reason that the button has kept itself is there already
        scene, reason = bpy.context.scene, str(error).rpartition(_REFUSED)[2].strip()
        if all(message.text not in reason for message in messages_of(scene)):
            note(scene, _BUTTON, "ERROR", reason)


def _draw_names(layout: bpy.types.UILayout, names: list[str]) -> None:
    """Show presets in columns of buttons that load them, each with a small picture."""
    pictures = loaded_pictures()
    grid = layout.grid_flow(columns=_COLUMNS, even_columns=True)
    for name in names:
        picture = pictures[name].icon_id
        grid.operator("bda.load_preset", text=label_of_preset(name), icon_value=picture).preset = name


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


def label_below_picture(name: str) -> str:
    """Return what a preset is called below its picture."""
    return _BELOW_PICTURE.get(name) or label_of_preset(name)


def unregister() -> None:
    """Remove the pictures, and what names them."""
    for kept in (_preset_items, _with_none, _numbers_by_title):
        kept.cache_clear()
    while _pictures:
        bpy.utils.previews.remove(_pictures.pop())


def loaded_pictures() -> bpy.utils.previews.ImagePreviewCollection:
    """Pictures of the presets, which Blender loads once."""
    if not _pictures:
        _pictures.append(bpy.utils.previews.new())
        for name in preset_files():
            _pictures[0].load(name, str(picture_of_preset(name)), "IMAGE")
    return _pictures[0]
