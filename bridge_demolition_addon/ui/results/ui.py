"""The panels Results, what the last recording came to, and Report."""

from typing import Any

import bpy

from ...core.sequence.undisturbed import told_fall
from ..recording.session import last_recording
from ..sidebar import SidebarPanel, draw_sentence

_N_PER_KN = 1000.0
_MS_PER_S = 1000.0


class BDA_PT_results(SidebarPanel, bpy.types.Panel):
    """What the last recording came to."""

    bl_label = "Results"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        layout, last = self.layout, last_recording()
        if last is None:
            draw_sentence(layout, context, "Nothing was recorded yet: register the handler and play.", icon="INFO")
            return
        summary = last.summary
        draw_sentence(layout, context, summary["title"], icon="NONE")
        if fall := told_fall(summary):
            draw_sentence(layout, context, fall)
        column = layout.column(align=True)
        for line in lines_of(summary):
            column.label(text=line)
        self._draw_place("Peak force", summary["largest_resultant"], last_frame=None)
        if summary["largest_resultant"]:
            draw_sentence(layout, context, explained_peak(summary), icon="INFO")
        self._draw_place("Largest throw", summary["largest_throw"], last_frame=last.recording.last_frame)
        row = layout.row(align=True)
        row.operator("bda.open_results")
        row.operator("bda.draw_charts")

    def _draw_place(self, label: str, found: dict[str, Any] | None, last_frame: int | None) -> None:
        """Draw a largest value, with a button that leads to where and when it was."""
        if found is None:
            return
        value = f"{found['force_N'] / _N_PER_KN:,.0f} kN" if "force_N" in found else f"{found['throw_m']:.2f} m"
        frame = found.get("frame", last_frame)
        column = self.layout.column(align=True)
        column.label(text=f"{label}: {value}".replace(",", " "))
        go = column.operator("bda.go_to_body", text=f"{found['body']}, frame {frame}", icon="VIEWZOOM")
        go.body, go.frame = found["body"], frame


class BDA_PT_report(SidebarPanel, bpy.types.Panel):
    """What is handed over of a run."""

    bl_label = "Report"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.operator("bda.make_report")


CLASSES = (BDA_PT_results, BDA_PT_report)


def explained_peak(summary: dict[str, Any]) -> str:
    """Return in a sentence what the peak force is, and why the contours show another number."""
    return (
        f"The resultant on a shard in its worst sub-step, of {summary['substep_s'] * _MS_PER_S:.3g} ms. Contours show "
        "the frame mean, or with Peak So Far this peak"
    )


def lines_of(summary: dict[str, Any]) -> list[str]:
    """Return the totals of a summary, each in a few words."""
    connections = summary["connections"]
    return [
        f"Total mass: {summary['mass_kg']['shard']:,.0f} kg".replace(",", " "),
        f"Broken: {connections['broken']} of {connections['count']} connections",
        f"{summary['frames']} frames, {summary['simulated_s']:.2f} s",
    ]
