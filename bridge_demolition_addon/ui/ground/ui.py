"""Panel Ground and Air: drawings there, zones by the mouse, and a site plan under the bridge."""

import bpy

from ..sidebar import SidebarPanel, draw_sentence
from . import decorator
from .prop import RINGS


class BDA_PT_ground_and_air(SidebarPanel, bpy.types.Panel):
    """Drawings on the ground and in the air."""

    bl_label = "Ground and Air"

    def draw(self, context: bpy.types.Context) -> None:
        settings, layout = context.scene.bda, self.layout
        if error := decorator.drawing.error:
            draw_sentence(layout, context, error)
        layout.column(align=True).prop(settings, "overlays")
        if RINGS in settings.overlays:
            row = layout.row(align=True)
            row.prop(settings, "distance_spacing_m")
            row.prop(settings, "distance_count")
        layout.operator("bda.draw_zone", icon="GREASEPENCIL")
        column = layout.column()
        column.use_property_split, column.use_property_decorate = True, False
        for name in ("plan_picture", "plan_width_m", "plan_bearing_deg", "plan_origin"):
            column.prop(settings, name)
        layout.operator("bda.lay_site_plan")
        dust = layout.row(align=True)
        dust.operator("bda.raise_dust")
        dust.operator("bda.settle_dust", text="", icon="X")
