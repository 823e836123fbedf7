"""Drawing of key figures, history, debris and limit. Nothing here changes any data, and nothing raises."""

from __future__ import annotations

from dataclasses import dataclass

import blf
import bpy
import gpu
import numpy as np

from ...display.ground_lines import cross_lines
from ...display.history_curves import HistoryCurve
from ..view_drawing import FONT_PX, PANEL_COLOUR, ViewDrawing, draw_lines, draw_rectangle, write, write_at
from ..viewport import covered_px
from . import shown

_DEBRIS, _LIMIT = (1.0, 0.65, 0.2, 1.0), (1.0, 0.15, 0.1, 1.0)
_CURVE, _AXIS, _NOW, _PEAK = (0.4, 0.75, 1.0, 1.0), (0.6, 0.6, 0.6, 1.0), (1.0, 1.0, 1.0, 1.0), (1.0, 0.6, 0.0, 1.0)
_WIDTH_PX, _LIMIT_PX, _AXIS_PX = 2.0, 3.0, 1.0
_CROSS_M = 0.5

_LINE, _FOOT_PX, _CHART_PX, _LEAST_PX, _MARK_PX = 1.5, 40.0, 70.0, 240.0, 3.5
"""Height of a line of text over that of its letters; where the panel begins; its chart; its width; half a mark."""

_FONT = 0


@dataclass(frozen=True, slots=True)
class _Layout:
    """Where the panel is, px from the lower left of the view."""

    left: float
    foot: float
    width: float
    line: float
    edge: float
    chart: float
    lines: int

    @property
    def panel(self) -> tuple[float, float, float, float]:
        """Left, bottom, right and top of the background."""
        high = self.foot + self.chart + (self.lines + 1) * self.line + 3.0 * self.edge
        return self.left, self.foot, self.left + self.width, high

    def in_chart(self, points: np.ndarray) -> np.ndarray:
        """Return points (j, 2) of the square from 0 to 1 on the screen, (j, 3)."""
        size = np.array((self.width - 2.0 * self.edge, self.chart))
        on_screen = np.array((self.left + self.edge, self.foot + self.edge)) + size * points
        return np.column_stack((on_screen, np.zeros(len(points))))

    def height_of(self, line: int) -> float:
        """Return where a line of text stands, counted from the chart upwards."""
        return self.foot + self.chart + 2.0 * self.edge + line * self.line


def _layout(context: bpy.types.Context, texts: tuple[str, ...]) -> _Layout:
    scale = context.preferences.system.ui_scale
    blf.size(_FONT, FONT_PX * scale)
    edge = FONT_PX * scale
    width = max(_LEAST_PX * scale, *(blf.dimensions(_FONT, text)[0] for text in texts)) + 2.0 * edge
    right = context.region.width - covered_px(context, "UI") - edge
    line = _LINE * FONT_PX * scale
    return _Layout(right - width, _FOOT_PX * scale, width, line, edge, _CHART_PX * scale, len(texts) - 1)


def _draw_in_space(context: bpy.types.Context) -> None:
    view = shown.in_view(context)
    if view is None:
        return
    draw_lines(context, view.limit_lines, _LIMIT, _LIMIT_PX)
    draw_lines(context, view.debris_lines, _DEBRIS, _WIDTH_PX)
    if view.farthest_m is not None:
        draw_lines(context, cross_lines(view.farthest_m, _CROSS_M), _DEBRIS, _WIDTH_PX)


def _draw_on_screen(context: bpy.types.Context) -> None:
    view = shown.in_view(context)
    if view is None:
        return
    for lines, text in ((view.limit_lines, view.limit_text), (view.debris_lines, view.debris_text)):
        if len(lines):
            write_at(context, tuple(lines[int(lines[:, 0].argmax())].tolist()), text)
    texts = (view.force_text, *reversed(view.lines))
    layout = _layout(context, texts)
    draw_rectangle(*layout.panel, PANEL_COLOUR)
    for number, text in enumerate(texts):
        write(context, layout.left + layout.edge, layout.height_of(number), text)
    _draw_chart(context, layout, view.curve)


def _draw_chart(context: bpy.types.Context, layout: _Layout, curve: HistoryCurve) -> None:
    gpu.state.blend_set("ALPHA")
    now = curve.now_share
    axes = np.array(((0.0, 0.0), (1.0, 0.0), (0.0, 0.0), (0.0, 1.0), (now, 0.0), (now, 1.0)))
    draw_lines(context, layout.in_chart(axes), _AXIS, _AXIS_PX)
    draw_lines(context, layout.in_chart(curve.lines), _CURVE, _WIDTH_PX)
    gpu.state.blend_set("NONE")
    half = _MARK_PX * context.preferences.system.ui_scale
    for point, colour in ((curve.peak, _PEAK), (curve.now, _NOW)):
        if point is not None:
            x, y, _ = layout.in_chart(point[None])[0].tolist()
            draw_rectangle(x - half, y - half, x + half, y + half, colour)


drawing = ViewDrawing(_draw_in_space, _draw_on_screen, forget=shown.forget)
