"""The groups of the tab, each a panel that holds others, and the panels Advanced in them."""

from __future__ import annotations

import bpy

from .panel_places import tables_below
from .scenario.built import has_changed
from .scenario.ui import CHANGED
from .sidebar import SidebarPanel


class _Holder(SidebarPanel):
    """Base of panels that hold others, and draw nothing themselves but a sign that a value in them has changed."""

    def draw_header(self, context: bpy.types.Context) -> None:
        """Show what a closed panel would hide."""
        if has_changed(context.scene.bda, tables_below(type(self).__name__)):
            self.layout.label(icon=CHANGED)

    def draw(self, _context: bpy.types.Context) -> None:
        """Draw nothing: its sub-panels have everything."""


class BDA_PT_group_bridge(_Holder, bpy.types.Panel):
    """The bridge by its sizes or as a model of your own, its site, and what it is made of."""

    bl_label = "Bridge"


class BDA_PT_advanced_bridge(_Holder, bpy.types.Panel):
    """How the bridge is cut, what holds it together, and what it stands on."""

    bl_label = "Advanced"


class BDA_PT_group_demolition(_Holder, bpy.types.Panel):
    """What brings the bridge down: ball, charges, cuts and machines, each at its time."""

    bl_label = "Demolition"


class BDA_PT_advanced_demolition(_Holder, bpy.types.Panel):
    """Actions that few demolitions have: weakenings, tendon cuts, loads, equipment and ground motion."""

    bl_label = "Advanced"


class BDA_PT_group_run_and_results(_Holder, bpy.types.Panel):
    """Run the demolition, look at what came of it, and make a report, pictures and films."""

    bl_label = "Run and Results"
    bl_options = set()  # open, as results come into it when a run has ended


class BDA_PT_advanced_run_and_results(_Holder, bpy.types.Panel):
    """Time and cameras, vectors, earlier runs, recording by hand and its files."""

    bl_label = "Advanced"


class BDA_PT_group_planning(_Holder, bpy.types.Panel):
    """Whether the bridge stands between its stages, and many runs: studies, searches and optimisations."""

    bl_label = "Planning"
