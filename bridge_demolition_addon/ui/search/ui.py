"""The panel Search: what is looked for, how far the search is, and what it came to."""

from __future__ import annotations

import bpy

from ..sidebar import SidebarPanel, draw_sentence
from . import session
from .prop import CHARGES, SPAN_DOWN


class BDA_PT_search(SidebarPanel, bpy.types.Panel):
    """The smallest charge, ball or drop with which the demolition succeeds as often as it has to."""

    bl_label = "Search"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        layout, settings, at_work = self.layout, context.scene.bda, session.search_at_work()
        layout.prop(settings, "search_directory", text="", placeholder="Folder of the search")
        column = layout.column()
        column.use_property_split, column.use_property_decorate = True, False
        column.enabled = at_work is None
        column.prop(settings, "search_quantity")
        ends = column.column(align=True)
        unit = {CHARGES: "", "BALL_MASS": ", kg"}.get(settings.search_quantity, ", m")
        ends.prop(settings, "search_lowest", text=f"Lowest{unit}")
        ends.prop(settings, "search_highest", text=f"Highest{unit}")
        column.prop(settings, "search_criterion")
        if settings.search_criterion == SPAN_DOWN:
            column.prop(settings, "search_span")
        column.prop(settings, "search_probability")
        column.prop(settings, "search_confidence")
        column.prop(settings, "search_trials")
        column.prop(settings, "study_jobs", text="Trials at a Time")
        if at_work:
            done, total = at_work.run.done, at_work.run.total
            layout.progress(factor=done / total, text=at_work.path.name)
            layout.operator("bda.stop_search", text="Stop")
            layout.label(text=f"{done} trials of at most {total}")
        else:
            layout.operator("bda.start_search")
        if why := session.why_ended():
            draw_sentence(layout, context, why)
        if found := session.found_by_search():
            for sentence in found.sentences:
                draw_sentence(layout, context, sentence, icon="NONE")
            layout.operator("bda.open_search_curve")


CLASSES = (BDA_PT_search,)
