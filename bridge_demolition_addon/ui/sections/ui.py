"""Panel of the section through the pile."""

import bpy

from ..languages.words import translated
from ..scene_units import area_text, length_text
from ..sidebar import SidebarPanel, draw_sentence
from .decorator import drawing, section_of
from .operator import no_section


class BDA_PT_section(SidebarPanel, bpy.types.Panel):
    """A section through the pile, along or across the bridge, in the frame that is shown."""

    bl_label = "Section"

    def draw(self, context: bpy.types.Context) -> None:
        settings, layout = context.scene.bda, self.layout
        layout.prop(settings, "show_section")
        layout.row().prop(settings, "section_direction", expand=True)
        layout.prop(settings, "section_place_m")
        row = layout.row(align=True)
        row.operator("bda.section_at_shard")
        row.operator("bda.section_at_cursor")
        if reason := no_section(context) or drawing.error:
            draw_sentence(layout, context, reason, icon="INFO")
        elif settings.show_section:
            self._draw_figures(context)
        layout.operator("bda.look_at_section", icon="VIEW_ORTHO")
        layout.operator("bda.write_section", icon="EXPORT")

    def _draw_figures(self, context: bpy.types.Context) -> None:
        section = section_of(context.scene)
        if section.is_empty:
            draw_sentence(self.layout, context, "The plane cuts nothing here: move it", icon="INFO")
            return
        if section.debris.is_empty():
            draw_sentence(self.layout, context, "The plane cuts no debris in this frame", icon="INFO")
            return
        column = self.layout.column(align=True)
        for line in (
            translated("Debris: {}").format(area_text(section.debris_area_m2, ".1f")),
            translated("Width: {}").format(length_text(section.debris_width_m, ".2f")),
            translated("Height above the ground: {}").format(length_text(section.debris_height_m, ".2f")),
        ):
            column.label(text=line, translate=False)
