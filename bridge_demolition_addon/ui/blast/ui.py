"""The panel Charges in the Open, with the list of charges."""

from __future__ import annotations

import bpy

from ...scene.blast.charges import DELAY, EXPLOSIVE, MASS, charge_collection, is_charge
from ..languages.words import CONTEXT, translated
from ..sidebar import SidebarPanel, letters_of
from .prop import shown_charge

_LETTERS_FOR_POSITIONS = 65
_LETTERS_FOR_ALL = 90
"""Width of the sidebar from which a row of the list shows more than name and mass."""
_SHARE_OF_NAME = 0.35
"""Of a row of the list: the rest is for numbers."""


class BDA_UL_charges(bpy.types.UIList):
    """The charges of the scene, one row for each."""

    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index) -> None:
        """Name and mass always, the rest where the sidebar is wide enough for it."""
        letters = letters_of(context)
        halves = layout.split(factor=_SHARE_OF_NAME, align=True)
        halves.prop(item, "name", text="", emboss=False, icon="EMPTY_AXIS")
        row = halves.row(align=True)
        if not is_charge(item):
            row.label(text=translated("no charge"))
            return
        if letters >= _LETTERS_FOR_POSITIONS:
            for axis in range(3):
                row.prop(item, "location", index=axis, text="")
        row.prop(item, f'["{MASS}"]', text="kg", translate=False)
        if letters >= _LETTERS_FOR_ALL:
            row.prop(item, f'["{DELAY}"]', text="")
            row.label(text=str(item.get(EXPLOSIVE, "")))


class BDA_PT_explosion(SidebarPanel, bpy.types.Panel):
    """Charges that lie bare, and whether they go off; called Explosion in 2019."""

    bl_label = "Charges in the Open"

    def draw(self, context: bpy.types.Context) -> None:
        layout, settings = self.layout, context.scene.bda
        layout.prop(settings.scenario.blast, "explosion", text="Explosion")
        collection = charge_collection(context.scene)
        if collection:
            layout.template_list("BDA_UL_charges", "", collection, "objects", settings, "charge_index", rows=3)
        row = layout.row(align=True)
        row.operator("bda.add_source_point")
        row.operator("bda.delete_source_point")
        charge = shown_charge(context.scene)
        if charge:
            self._draw_charge(settings, charge)
        layout.operator("bda.build_force_objects")
        layout.operator("bda.show_total_mass")
        if settings.total_mass:
            layout.label(text=translated("Total mass: {}").format(settings.total_mass), translate=False)

    def _draw_charge(self, settings: bpy.types.PropertyGroup, charge: bpy.types.Object) -> None:
        column = self.layout.column(align=True)
        for axis, name in enumerate("XYZ"):
            column.prop(charge, "location", index=axis, text=name)
        column.prop(charge, f'["{MASS}"]', text=translated("Mass") + " (kg)", translate=False)
        column.prop(charge, f'["{DELAY}"]', text="Delay", text_ctxt=CONTEXT)
        column.prop(settings, "charge_explosive")
        column.prop(settings, "charge_burst")
