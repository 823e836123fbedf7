"""Drawing over the 3D view: colour bar, force vectors, charges and their stand-off rings.

Nothing here changes any data, and nothing raises: the sidebar says what cannot be drawn.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from ...display.colour_scale import colours
from ...display.contours import ContourFrame, ContourSettings, colour_bar
from ...display.force_arrows import arrows, body_forces, connection_forces, contact_forces
from ...model.blast.charges import Charge
from ...model.blast.receptors import THRESHOLDS, ring_radii
from ...scene.blast.charges import blast_of, charges_of
from ...simulation.blender_events import contours_of, shown_results
from ..languages.words import translated
from ..scene_units import length_text, units_of_texts
from ..view_drawing import (
    FONT_PX,
    PANEL_COLOUR,
    TEXT_COLOUR,
    ViewDrawing,
    draw_lines,
    draw_rectangle,
    write,
    write_at,
)
from ..viewport import covered_px
from . import view as contour_view

_LINE_PX = 17.0
_MARGIN_PX = 16.0
_BAR_PX = (18.0, 240.0)
_PANEL_PX = 172.0
_BOTTOM_PX = 40.0
_TICK_PX = 5.0
_STEPS = 64
_RING_POINTS = 128
_RING_COLOUR = (1.0, 0.35, 0.1, 0.9)
_VECTOR_COLOURS = {
    "BODIES": (1.0, 0.6, 0.0, 1.0),
    "CONNECTIONS": (0.0, 0.75, 1.0, 1.0),
    "CONTACTS": (1.0, 0.2, 0.8, 1.0),
}
_VECTOR_WIDTH_PX = 2.0
_LEAST_SHARE = 0.02
"""Arrows shorter than this share of the longest are left out, as they would be dots."""

_rings: dict[tuple, np.ndarray] = {}


def vector_lines(scene: bpy.types.Scene) -> dict[str, np.ndarray]:
    """Return the lines of the arrows, (6 k, 3) float, m, for each kind of force that is shown."""
    settings, series = scene.bda, shown_results(scene).series
    row = series.row_at(scene.frame_current) if series else None
    if not settings.show_vectors or row is None:
        return {}
    frame, first = series.magnified(row, contours_of(scene).magnification), series.frame(0)
    frame_s = float(series.times_s[row] - series.times_s[row - 1]) if row else 0.0
    forces = {
        "BODIES": lambda: (part[series.moves] for part in body_forces(frame)),
        "CONNECTIONS": lambda: connection_forces(frame, first, series.pairs, series.points_m),
        "CONTACTS": lambda: (part[series.moves] for part in contact_forces(frame, frame_s)),
    }
    shown = {name: tuple(work_out()) for name, work_out in forces.items() if name in settings.vectors}
    lengths = [np.linalg.norm(force, axis=1) for _, force in shown.values()]
    largest = max((np.nanmax(length, initial=0.0) for length in lengths), default=0.0)
    if largest <= 0.0:
        return {}
    longest_m = settings.vector_length_m
    return {
        name: arrows(starts, force, longest_m / largest, _LEAST_SHARE * longest_m)
        for name, (starts, force) in shown.items()
    }


def ring_lines(scene: bpy.types.Scene) -> list[tuple[np.ndarray, float]]:
    """Return for each charge whose damage gets to height 0 a ring there, lines (2 p, 3) float, m, and its radius, m."""
    charges, number = charges_of(scene), int(scene.bda.ring_damage)
    factor = blast_of(scene).pressure_factor
    key = (charges, number, factor)
    if key not in _rings:
        _rings.clear()
        _rings[key] = ring_radii(charges, 0.0, [THRESHOLDS[number]], pressure_factor=factor)[0]
    angles = np.linspace(0.0, 2.0 * math.pi, _RING_POINTS + 1)
    circle = np.column_stack((np.cos(angles), np.sin(angles), np.zeros_like(angles)))
    rings = []
    for charge, radius in zip(charges, _rings[key].tolist(), strict=True):
        if radius > 0.0:
            points = np.array((charge.position_m[0], charge.position_m[1], 0.0)) + radius * circle
            rings.append((np.stack((points[:-1], points[1:]), axis=1).reshape(-1, 3), radius))
    return rings


def _draw_in_space(context: bpy.types.Context) -> None:
    scene = context.scene
    contour_view.follow_later(scene)
    for name, lines in vector_lines(scene).items():
        draw_lines(context, lines, _VECTOR_COLOURS[name], _VECTOR_WIDTH_PX)
    if scene.bda.show_rings:
        for lines, _ in ring_lines(scene):
            draw_lines(context, lines, _RING_COLOUR, _VECTOR_WIDTH_PX)


def _draw_on_screen(context: bpy.types.Context) -> None:
    scene = context.scene
    settings = contours_of(scene).settings
    shown = contours_of(scene).shown_frame() if settings and scene.bda.colour_bar else None
    if shown:
        _draw_colour_bar(context, settings, shown[0])
    if scene.bda.show_charges:
        for charge in charges_of(scene):
            write_at(context, charge.position_m, charge_text(charge), dot=_RING_COLOUR)
    if scene.bda.show_rings:
        damage = THRESHOLDS[int(scene.bda.ring_damage)].damage
        for lines, radius in ring_lines(scene):
            write_at(context, lines[0], f"{translated(damage)}: {length_text(radius, '.1f')}")


@dataclass(frozen=True, slots=True)
class _BarLayout:
    """Where the parts of the colour bar are, px from the lower left of the view."""

    left: float
    bottom: float
    scale: float
    heading_lines: int

    @property
    def line(self) -> float:
        """Height of a line of text."""
        return _LINE_PX * self.scale

    @property
    def margin(self) -> float:
        """Room around the parts."""
        return _MARGIN_PX * self.scale

    @property
    def bar(self) -> tuple[float, float, float, float]:
        """Left, bottom, width and height of the colours."""
        width, height = (size * self.scale for size in _BAR_PX)
        return self.left, self.bottom + self.margin + 2.0 * self.line, width, height

    @property
    def top(self) -> float:
        """Upper end of the colours."""
        _, foot, _, height = self.bar
        return foot + height

    @property
    def panel(self) -> tuple[float, float, float, float]:
        """Left, bottom, right and top of the background."""
        high = self.top + 1.5 * self.margin + self.heading_lines * self.line
        return self.left - self.margin / 2.0, self.bottom, self.left + _PANEL_PX * self.scale, high


def _draw_colour_bar(context: bpy.types.Context, settings: ContourSettings, frame: ContourFrame) -> None:
    scale = context.preferences.system.ui_scale
    bar = colour_bar(settings, frame, units_of_texts())
    heading = [*filter(None, (translated(bar.title), bar.subtitle)), bar.unit]
    layout = _BarLayout(covered_px(context, "TOOLS") + _MARGIN_PX * scale, _BOTTOM_PX * scale, scale, len(heading))
    left, foot, width, height = layout.bar
    draw_rectangle(*layout.panel, PANEL_COLOUR)
    _draw_gradient(left, foot, width, height, settings)
    tick = _TICK_PX * scale
    for share, text in zip(bar.tick_shares, bar.tick_texts, strict=True):
        y = foot + share * height
        draw_rectangle(left + width, y - 0.5, left + width + tick, y + 0.5, TEXT_COLOUR)
        write(context, left + width + 2.0 * tick, y - 0.35 * FONT_PX * scale, text)
    for number, text in enumerate(reversed(heading)):
        write(context, left, layout.top + layout.margin + number * layout.line, text)
    for number, text in enumerate((bar.time, bar.frame)):
        write(context, left, layout.bottom + layout.margin / 2.0 + number * layout.line, text)


def charge_text(charge: Charge) -> str:
    """Return the name, mass and delay of a charge as text."""
    return f"{charge.name}: {charge.mass_kg:g} kg {charge.explosive}, {charge.delay_ms:g} ms"


def _draw_gradient(left: float, bottom: float, width: float, height: float, settings: ContourSettings) -> None:
    levels = np.linspace(0.0, 1.0, _STEPS + 1)
    edges = bottom + height * levels
    strip = np.column_stack((np.tile((left, left + width), _STEPS + 1), np.repeat(edges, 2))).astype(np.float32)
    screen = np.column_stack((colours(settings.colour_map, levels), np.ones(_STEPS + 1)))
    shader = gpu.shader.from_builtin("SMOOTH_COLOR")
    content = {"pos": strip, "color": np.repeat(screen, 2, axis=0).astype(np.float32)}
    batch_for_shader(shader, "TRI_STRIP", content).draw(shader)


drawing = ViewDrawing(_draw_in_space, _draw_on_screen, forget=_rings.clear)
