"""Parts that all panels and settings of the sidebar share: the tab, sentences on several lines, and paths.

Each panel has its place: in the head or one of four groups. What most people need stands in a group itself, and
everything else in its closed panel *Advanced*; tables within a table, such as the deck in the bridge, in its panel.
"""

from __future__ import annotations

import textwrap
from typing import Any
from unicodedata import east_asian_width

import bpy
from bpy.props import StringProperty

from .languages.words import translated

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
    """Wrap a text at a width in letters; Chinese ones are twice as wide as others."""
    return textwrap.wrap(text, max(letters * len(text) // max(width_of(text), 1), 1))


def width_of(text: str) -> int:
    """Return how many Latin letters a text is wide."""
    return sum(_LETTERS_OF_WIDE if east_asian_width(letter) in "WF" else 1 for letter in text)


def redraw_sidebars(context: bpy.types.Context) -> None:
    """Have every 3D view's sidebar drawn again."""
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            for region in area.regions:
                if area.type == "VIEW_3D" and region.type == "UI":
                    region.tag_redraw()


def path_property(name: str, description: str, subtype: str = "FILE_PATH") -> Any:
    """Return a property for a path, which may be relative to the saved file."""
    return StringProperty(name=name, description=description, subtype=subtype, options=_RELATIVE_PATHS)


PREFIX = "BDA_PT_"
"""Of the names of all panels; that of a table of the scenario has the name of the table behind it."""

HEAD = "BDA_PT_scenario"
BRIDGE, DEMOLITION, RUN, PLANNING = (
    f"BDA_PT_group_{name}" for name in ("bridge", "demolition", "run_and_results", "planning")
)
HEAD_ADVANCED, BRIDGE_ADVANCED, DEMOLITION_ADVANCED, RUN_ADVANCED = (
    f"BDA_PT_advanced_{name}" for name in ("scenario", "bridge", "demolition", "run_and_results")
)

TREE: dict[str, tuple[str, ...]] = {
    "": (HEAD, BRIDGE, DEMOLITION, RUN, PLANNING),
    HEAD: ("BDA_PT_ifc_elements", HEAD_ADVANCED),
    BRIDGE: (
        *("BDA_PT_bridge", "BDA_PT_geometry", "BDA_PT_steelwork"),
        *("BDA_PT_site", "BDA_PT_zones", "BDA_PT_neighbours", "BDA_PT_exclusion"),
        BRIDGE_ADVANCED,
    ),
    BRIDGE_ADVANCED: (
        *("BDA_PT_fracture", "BDA_PT_materials", "BDA_PT_reinforcement", "BDA_PT_tendons"),
        *("BDA_PT_connections", "BDA_PT_bearings", "BDA_PT_supports", "BDA_PT_foundations"),
        "BDA_PT_dead_loads",
        *("BDA_PT_ground", "BDA_PT_vibration_laws", "BDA_PT_shards", "BDA_PT_contacts"),
    ),
    "BDA_PT_geometry": ("BDA_PT_geometry_reinforcement",),
    DEMOLITION: (
        *("BDA_PT_ball", "BDA_PT_blast_zones", "BDA_PT_explosion", "BDA_PT_cuts"),
        *("BDA_PT_jackhammers", "BDA_PT_saw_cuts", "BDA_PT_removals", "BDA_PT_lifts", "BDA_PT_pulls"),
        DEMOLITION_ADVANCED,
    ),
    DEMOLITION_ADVANCED: (
        *("BDA_PT_weakenings", "BDA_PT_tendon_cuts", "BDA_PT_loads", "BDA_PT_pressures"),
        *("BDA_PT_equipment", "BDA_PT_machines", "BDA_PT_programme", "BDA_PT_fall_beds", "BDA_PT_ground_motion"),
    ),
    "BDA_PT_explosion": ("BDA_PT_blast",),
    RUN: (
        *("BDA_PT_run", "BDA_PT_results", "BDA_PT_report", "BDA_PT_contours", "BDA_PT_film"),
        *("BDA_PT_compare", "BDA_PT_section", "BDA_PT_ground_and_air"),
        RUN_ADVANCED,
    ),
    "BDA_PT_report": ("BDA_PT_document",),
    RUN_ADVANCED: (
        *("BDA_PT_time", "BDA_PT_pictures", "BDA_PT_overlay", "BDA_PT_earlier_run"),
        *("BDA_PT_handler", "BDA_PT_post_processing", "BDA_PT_recording"),
    ),
    PLANNING: ("BDA_PT_stages", "BDA_PT_study", "BDA_PT_search", "BDA_PT_optimise"),
}
"""Panels by the one that they stand in, from top to bottom; those of the tab itself by no name."""

_PARENTS = {panel: parent for parent, panels in TREE.items() for panel in panels}


def tables_below(panel: str) -> tuple[str, ...]:
    """Return the names of the scenario's tables whose panels stand in a panel, or in one of those in it."""
    below = TREE.get(panel, ())
    names = (name for inner in below for name in (inner.removeprefix(PREFIX), *tables_below(inner)))
    return tuple(name for name in names if name)


def parent_of(panel: str) -> str | None:
    """Return the panel that a panel stands in: empty for one of the tab itself, None where this does not place it."""
    return _PARENTS.get(panel)


def order_of(panel: str) -> int:
    """Return which panel of its parent this is, from the top; one that is not placed comes last."""
    parent = parent_of(panel)
    return len(_PARENTS) if parent is None else TREE[parent].index(panel)
