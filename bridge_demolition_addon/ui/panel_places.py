"""Where each panel stands in the tab: the head and four groups, what is in each group, and in which order.

What most people need stands in a group itself, and everything else in its closed panel *Advanced*. Tables within a
table, such as the deck in the bridge, stand in its panel.
"""

from __future__ import annotations

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
        *("BDA_PT_equipment", "BDA_PT_fall_beds", "BDA_PT_ground_motion"),
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
