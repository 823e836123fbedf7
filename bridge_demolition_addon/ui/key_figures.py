"""Key figures, the history of a force, debris and limit of a run, and their drawing over the 3D view."""

from collections.abc import Iterator
from dataclasses import dataclass

import blf
import bpy
import gpu
import numpy as np
from bpy.props import BoolProperty
from manifold3d import CrossSection

from ..display.ground_lines import cross_lines, draped, outline_lines, planned_zone
from ..display.key_figures import ForceHistory, FrameFigures, HistoryCurve, RunFigures, history_curve
from ..model.results.collapse import ShardRest
from ..model.scenario import Exclusion
from ..simulation.blender_events import shown_results
from .languages.words import translated
from .results.shown_run import LargestValue, counts_line, shown_run
from .scenario.built import shown_exclusion
from .scene_units import area_text, force_text, length_text, mass_text, units_of_texts
from .view_drawing import FONT_PX, PANEL_COLOUR, ViewDrawing, draw_lines, draw_rectangle, write, write_at
from .viewport import covered_px, redraw_views

CURVE_POINTS = 200
"""Points that the chart can tell apart: it is about so many pixels wide."""

_runs: dict[tuple[int, int], RunFigures] = {}
"""The run that is shown, by the scene and the number of its results."""

_shown: "dict[tuple, InView]" = {}
"""What was drawn last, by all that it depends on: views are drawn many times a second."""


@dataclass(frozen=True, slots=True, eq=False)
class InView:
    """What is drawn of a frame.

    Attributes
    ----------
    lines
        Key figures as texts, from top to bottom.
    force_text, curve
        What the chart of force shows: its name and numbers, and its lines in a square from 0 to 1.
    debris_lines, limit_lines : (2 k, 3), (2 l, 3) float
        Outlines on the ground of the debris and of the exclusion zone as planned, m; none where there is none.
    debris_text, limit_text
        Texts next to these, at the position of their corner with the largest x.
    farthest_m : (3,) float or None
        Corner of the farthest debris.
    """

    lines: tuple[str, ...]
    force_text: str
    curve: HistoryCurve
    debris_lines: np.ndarray
    limit_lines: np.ndarray
    debris_text: str
    limit_text: str
    farthest_m: np.ndarray | None


def in_view(context: bpy.types.Context) -> InView | None:
    """Return what is drawn of the frame that a scene shows; None without results, and while a run goes on."""
    scene = context.scene
    run = run_of(scene) if scene.bda.figures_in_view else None
    row = row_of(scene, run) if run else None
    if run is None or row is None:
        return None
    name, exclusion = selected_name(context), shown_exclusion(scene.bda)
    texts_are = (bpy.app.translations.locale, units_of_texts())
    key = (*next(iter(_runs)), row, name, exclusion, texts_are)
    if key not in _shown:
        _shown.clear()
        _shown[key] = _worked_out(run, row, name, exclusion)
    return _shown[key]


def run_of(scene: bpy.types.Scene) -> RunFigures | None:
    """Return the figures of the run that a scene shows; None where it shows none, and while one goes on."""
    shown = shown_results(scene)
    results = shown.results
    if results is None or not len(results.frames) or not len(results.inventory.of_kind("shard")):
        forget()  # which lets go of the files of a run that is not shown any more
        return None
    key = (scene.session_uid, shown.number)
    if key not in _runs:
        forget()
        run = shown_run(scene)
        _runs[key] = RunFigures(results, run.summary.rested if run else None)
    return _runs[key]


def row_of(scene: bpy.types.Scene, run: RunFigures) -> int | None:
    """Return the recorded row of the frame that a scene shows."""
    current = shown_results(scene).current_row
    return None if current is None else min(current[1], len(run) - 1)


def selected_name(context: bpy.types.Context) -> str:
    """Return the name of the active object where it is selected; empty for none."""
    layer = context.view_layer
    active = layer.objects.active
    return active.name if active is not None and active.select_get(view_layer=layer) else ""


def peak_of_selected(context: bpy.types.Context) -> tuple[str, LargestValue] | None:
    """Return the name and the peak of the selected shard or connection; None where none of the run is selected."""
    run = run_of(context.scene) if context.scene.bda.figures_in_view else None
    history = run.history(selected_name(context)) if run else None
    if run is None or history is None or not history.name or history.peak_row is None:
        return None
    peak_n = float(history.forces_n[history.peak_row])
    return history.name, LargestValue(force_text(peak_n), history.name, run.frame_of(history.peak_row))


def forget() -> None:
    """Forget the run and what was drawn of it."""
    _runs.clear()
    _shown.clear()


def _worked_out(run: RunFigures, row: int, name: str, exclusion: Exclusion | None) -> InView:
    figures, history = run.at(row), run.history(name)
    limit = planned_zone(run.plan, exclusion).whole if exclusion else CrossSection()
    farthest = None
    if figures.farthest is not None:
        place = figures.farthest.position_m
        height = 0.0 if run.ground.is_flat else float(np.nan_to_num(run.ground.heights_at(place[None])[0]))
        farthest = np.array((*place, height))
    return InView(
        lines=tuple(figure_lines(figures, run.rest, exclusion)),
        force_text=history_text(run, history, row),
        curve=history_curve(history, row, CURVE_POINTS),
        debris_lines=draped(outline_lines(figures.area), run.ground),
        limit_lines=draped(outline_lines(limit), run.ground),
        debris_text=translated("Debris: {}").format(area_text(figures.area.area(), ".0f")),
        limit_text=translated("Exclusion zone as planned, without debris"),
        farthest_m=farthest,
    )


def figure_lines(figures: FrameFigures, rest: ShardRest, exclusion: Exclusion | None) -> Iterator[str]:
    """Yield the key figures of a frame as texts."""
    yield translated("Frame {}, {} s").format(figures.number, f"{figures.time_s:.2f}")
    yield counts_line(figures.connections)
    yield translated("Debris: {} of {}").format(mass_text(figures.debris_kg), mass_text(figures.bridge_kg))
    if figures.farthest is not None:
        yield _farthest_text(figures.farthest.distance_m, exclusion)
    yield _rest_text(rest)


def history_text(run: RunFigures, history: ForceHistory, row: int) -> str:
    """Return what the chart shows: on what the force acts, the force in the shown row, and its peak."""
    name = history.name or translated("Largest on a shard")
    now_n = float(history.forces_n[row])
    now = force_text(now_n) if np.isfinite(now_n) else translated("not known")
    if history.peak_row is None:
        return f"{name}: {now}"
    peak_n, peak_s = float(history.forces_n[history.peak_row]), float(history.times_s[history.peak_row])
    text = translated("{}: {}, peak {} at {} s").format(name, now, force_text(peak_n), f"{peak_s:.2f}")
    return text if history.name else f"{text} ({run.largest_loaded(history.peak_row)})"


def _farthest_text(distance_m: float, exclusion: Exclusion | None) -> str:
    far = length_text(distance_m, ".2f")
    if exclusion is None:
        return translated("Debris up to {} from the bridge").format(far)
    limit_m = exclusion.designed_drop_m + exclusion.buffer_m
    within = translated("Debris up to {} from the bridge, zone planned to {}")
    beyond = translated("Debris up to {} from the bridge: beyond the zone, planned to {}")
    return (within if distance_m <= limit_m else beyond).format(far, length_text(limit_m, ".2f"))


def _rest_text(rest: ShardRest) -> str:
    if rest.first_motion_s is None:
        return translated("Nothing moves in the whole run")
    if rest.at_rest_s is None and not rest.moving_at_end:
        return translated("Not all rested for long enough before the end")
    if rest.at_rest_s is None:
        return translated("Still moving at the end: {} shards").format(rest.moving_at_end)
    return translated("At rest from {} s on").format(f"{rest.at_rest_s:.2f}")


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
    view = in_view(context)
    if view is None:
        return
    draw_lines(context, view.limit_lines, _LIMIT, _LIMIT_PX)
    draw_lines(context, view.debris_lines, _DEBRIS, _WIDTH_PX)
    if view.farthest_m is not None:
        draw_lines(context, cross_lines(view.farthest_m, _CROSS_M), _DEBRIS, _WIDTH_PX)


def _draw_on_screen(context: bpy.types.Context) -> None:
    view = in_view(context)
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


drawing = ViewDrawing(_draw_in_space, _draw_on_screen, forget=forget)


class KeyFigureProperties:
    """Part of the settings of a scene."""

    figures_in_view: BoolProperty(
        name="Key Figures in View",
        description="Draw over the 3D view what has come of the run by the frame that is shown: key figures, the force "
        "on the selected shard or in the selected connection over time with its peak, else the largest on any shard, "
        "and on the ground the debris with the edge of the exclusion zone as planned",
        default=False,
        update=redraw_views,
    )
