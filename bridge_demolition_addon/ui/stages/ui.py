"""The panel Stages: a table of stages, one of them in full, and which members hold the bridge."""

from __future__ import annotations

import math

import bpy

from ..languages.words import translated
from ..sidebar import SidebarPanel, draw_of_one_cut, draw_sentence
from ..task_progress import draw_task_progress, going_on
from .operator import BDA_OT_check_stages
from .shown import checked_in, why_not_shown

_MOST_TIMES = 64
"""Up to which load factor the collapse is looked for."""

_UNITS = {"force": "kN", "moment": "kNm"}
_HEADS = {
    "support": {"force": "Reactions, kN", "moment": "Moments, kN·m"},
    "bearing": {"force": "Bearings, kN", "moment": "Bearings, kN·m"},
}


class BDA_PT_stages(SidebarPanel, bpy.types.Panel):
    """How the bridge stands between the steps of its demolition, by its stiffness and without a simulation."""

    bl_label = "Stages"

    def draw(self, context: bpy.types.Context) -> None:
        layout, settings = self.layout, context.scene.bda
        layout.prop(settings, "stages_directory", text="", placeholder=translated("Folder for tables"))
        layout.operator("bda.check_stages")
        if progress := going_on(BDA_OT_check_stages.task):
            draw_task_progress(layout, context, progress)
        checked = checked_in(context.scene)
        if checked is None:
            return
        if reason := why_not_shown(context.scene):
            draw_sentence(layout, context, reason)
            return
        grid = layout.column(align=True)
        for row in [{}, *checked.rows]:
            line = grid.row(align=True)
            for text in cells_of(row):
                line.label(text=text, translate=False)
        layout.operator("bda.show_utilisation")
        layout.prop(settings, "stage_shown")
        shown = min(settings.stage_shown, len(checked.rows)) - 1
        if carried := carried_text(checked.rows[shown]):
            draw_sentence(layout, context, carried, icon="NONE")
        for sentence in (*checked.sentences[shown], *checked.members):
            draw_sentence(layout, context, sentence, icon="NONE")
        for kind, rows in (("support", checked.reactions[shown]), ("bearing", checked.bearings[shown])):
            for quantity in _HEADS[kind] if rows else ():
                grid = layout.column(align=True)
                for row in [{}, *rows]:
                    line = grid.row(align=True)
                    for text in reaction_cells_of(row, quantity, kind):
                        line.label(text=text, translate=False)
        if checked.bearings[shown]:
            draw_of_one_cut(layout, context)


def reaction_cells_of(row: dict, quantity: str, kind: str) -> tuple[str, ...]:
    """Return what the tables say of a support or bearing: its force or moment; the head of the table for no row."""
    if not row:
        return translated(_HEADS[kind][quantity]), "x", "y", "z"
    return row[kind], *(f"{row[f'{quantity}_{axis}_{_UNITS[quantity]}']:.1f}" for axis in "xyz")


def carried_text(row: dict) -> str:
    """Return in a sentence how many times its weight the bridge carries in a stage; empty where it is not held."""
    factor = row["collapse_factor"]
    if math.isnan(factor):
        return ""
    if math.isinf(factor):
        return translated("Carries more than {} times its weight").format(_MOST_TIMES)
    return translated("Carries {} times its weight").format(f"{factor:.2f}")


def cells_of(row: dict) -> tuple[str, ...]:
    """Return what the table says of a stage; its head for no row."""
    if not row:
        return tuple(map(translated, ("Stage", "From", "Used", "Carries, × weight")))
    used, factor = row["largest_utilisation"], row["collapse_factor"]
    return (
        str(row["stage"]),
        f"{row['time_s']:g} s",
        "" if used is None else f"{used:.0%}",
        translated("not held") if math.isnan(factor) else f"> {_MOST_TIMES}" if math.isinf(factor) else f"{factor:.2f}",
    )
