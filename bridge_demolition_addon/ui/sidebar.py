"""Parts that all panels and settings of the sidebar share: the tab, sentences on several lines, and paths."""

from __future__ import annotations

import textwrap
from typing import Any
from unicodedata import east_asian_width

import bpy
from bpy.props import StringProperty

from .languages.words import translated
from .panel_places import order_of, parent_of

_LETTER_PX = 6.5
_EDGES_PX = 75
"""Width that a line of text does not have, at 100 %: tabs, the margins of a panel and an icon."""

_LETTERS_OF_WIDE = 2
"""Width of a letter of Chinese."""

_RELATIVE_PATHS = {"PATH_SUPPORTS_BLEND_RELATIVE"} if bpy.app.version >= (5, 0, 0) else set()


def tooltip(text: str) -> str:
    """Return a description on one line, without backticks, nor its full stop, which Blender adds."""
    return " ".join(text.replace("`", "").split()).rstrip(".")


class SidebarPanel:
    """Base of all panels in the tab BDA of the 3D view's sidebar; their docstrings are their tooltips.

    They stand where `panel_places` says; those that it does not place name the panel that they stand in themselves.
    """

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "BDA"
    bl_options = {"DEFAULT_CLOSED"}

    def __init_subclass__(cls, **keywords: object) -> None:
        super().__init_subclass__(**keywords)
        cls.bl_description = tooltip(cls.__doc__ or "")
        parent = parent_of(cls.__name__)
        if parent is not None:
            cls.bl_order = order_of(cls.__name__)
        if parent:
            cls.bl_parent_id = parent


def letters_of(context: bpy.types.Context) -> int:
    """Return how many letters fit into a line of the sidebar."""
    width = context.region.width / context.preferences.system.ui_scale
    return max(int((width - _EDGES_PX) / _LETTER_PX), 10)


def draw_sentence(layout: bpy.types.UILayout, context: bpy.types.Context, text: str, icon: str = "ERROR") -> None:
    """Draw a sentence, translated where it is in the tables, on as many lines as it needs, as Blender cuts them off."""
    column, below = layout.column(align=True), "NONE" if icon == "NONE" else "BLANK1"
    for number, line in enumerate(wrap(translated(text), letters_of(context))):
        column.label(text=line, icon=below if number else icon, translate=False)


def draw_of_one_cut(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """Draw how much is known of bearings that carry an axis together, below what they carry."""
    text = translated(
        "Single bearings are of this one cut: each seed shares what an axis carries otherwise, and bda check --cuts 5 "
        "says by how much."
    )
    draw_sentence(layout, context, text, icon="INFO")


def wrap(text: str, letters: int) -> list[str]:
    """Wrap a text at a width in letters; those of Chinese are twice as wide as others."""
    return textwrap.wrap(text, max(letters * len(text) // max(width_of(text), 1), 1))


def width_of(text: str) -> int:
    """Return how many Latin letters a text is wide."""
    return sum(_LETTERS_OF_WIDE if east_asian_width(letter) in "WF" else 1 for letter in text)


def redraw_sidebars(context: bpy.types.Context) -> None:
    """Have the sidebars of all 3D views drawn again."""
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            for region in area.regions:
                if area.type == "VIEW_3D" and region.type == "UI":
                    region.tag_redraw()


def path_property(name: str, description: str, subtype: str = "FILE_PATH") -> Any:
    """Return a property for a path, which may be relative to the saved file."""
    return StringProperty(name=name, description=description, subtype=subtype, options=_RELATIVE_PATHS)
