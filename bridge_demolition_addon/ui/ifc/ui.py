"""Panel IFC Elements: a table of what the elements of a file become, to be corrected before anything is built."""

import bpy

from ..languages.words import translated
from ..sidebar import SidebarPanel, draw_sentence
from .prop import LEFT_OUT


class BDA_UL_ifc_elements(bpy.types.UIList):
    """Elements of an IFC file: name, kind and material."""

    def draw_item(self, context, layout, data, item, icon, active_data, active_property, index) -> None:
        """Draw a row; what is left out is greyed."""
        row = layout.row(align=True)
        name = row.row()
        name.active = item.kind != LEFT_OUT
        name.label(text=item.title, translate=False)
        row.prop(item, "kind", text="", emboss=False)
        material = row.row()
        material.active = item.kind not in (LEFT_OUT, "bearing")
        material.prop(item, "material", text="", emboss=False)


class BDA_PT_ifc_elements(SidebarPanel, bpy.types.Panel):
    """What the elements of an IFC file become."""

    bl_label = "IFC Elements"
    bl_options = set()  # open, and up there with its button: it is there only once a file was looked into

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return bool(context.scene.bda.ifc_elements)

    def draw(self, context: bpy.types.Context) -> None:
        layout, settings = self.layout, context.scene.bda
        layout.template_list("BDA_UL_ifc_elements", "", settings, "ifc_elements", settings, "ifc_element_index", rows=8)
        index = settings.ifc_element_index
        if 0 <= index < len(settings.ifc_elements):
            element = settings.ifc_elements[index]
            why = element.why or translated("as the file says")
            draw_sentence(layout, context, f"{element.ifc_class}, {why}", icon="INFO")
            layout.operator("bda.ifc_alike", icon="SORTALPHA")
        layout.prop(settings, "ifc_only")
        layout.prop(settings, "ifc_bars")
        layout.operator("bda.import_ifc_elements", icon="IMPORT")
