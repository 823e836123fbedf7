"""Drawing on the ground and in the air of the 3D view: zones, distances, neighbours, flashes, the chosen shard.

Nothing here changes any data, and nothing raises: the sidebar says what cannot be drawn.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import bpy
import numpy as np
from manifold3d import CrossSection

from ...display.ground_lines import cross_lines, draped, flash_lines, flash_share, outline_lines, way_lines, zone_lines
from ...display.zone_boxes import box_lines, delay_colours, hole_lines
from ...engineering.geometry.plan_areas import outlines
from ...scene.blast.charges import blast_of, charges_of
from ...scene.bodies import Kind, kind_of
from ...scene.time_scale import simulated_time_s
from ...scene.world import FIRST_STEP_FRAME
from ..languages.words import translated
from ..scenario.built import shown_site
from ..scene_units import area_text, length_text
from ..view_drawing import ViewDrawing, draw_lines, write_at
from . import areas
from .prop import BLAST_ZONES, DEBRIS, EXCLUSION, FLASHES, NAMES, NEIGHBOURS, RINGS, WAY, ZONES

_COLOURS = {
    EXCLUSION: (1.0, 0.15, 0.1, 1.0),
    DEBRIS: (1.0, 0.65, 0.2, 1.0),
    RINGS: (0.9, 0.9, 0.9, 0.6),
    NEIGHBOURS: (0.3, 0.7, 1.0, 1.0),
    WAY: (1.0, 1.0, 0.3, 0.9),
    NAMES: (1.0, 1.0, 1.0, 1.0),
}
_ZONE_COLOURS = {
    "road": (0.85, 0.85, 0.9, 1.0),
    "railway": (0.8, 0.5, 1.0, 1.0),
    "power line": (1.0, 0.9, 0.2, 1.0),
    "pipeline": (1.0, 0.6, 0.1, 1.0),
    "building": (1.0, 0.45, 0.6, 1.0),
    "water": (0.25, 0.6, 1.0, 1.0),
    "other": (0.6, 0.9, 0.6, 1.0),
}
_FLASH = (1.0, 0.9, 0.5)
_FLASH_M = 3.0
_NEIGHBOUR_M = 1.0
_WIDTHS_PX = {EXCLUSION: 3.0, WAY: 2.5, NAMES: 2.5, FLASHES: 3.0}
_WIDTH_PX = 2.0

_texts: list[tuple[tuple[float, float, float], str]] = []
"""Positions, m, and texts of the view that is drawn now."""


@dataclass(frozen=True, slots=True)
class Drawn:
    """Lines (2 k, 3) float, m, with their colour and width, and a text at a position, which may be empty."""

    lines: np.ndarray
    colour: tuple[float, float, float, float]
    width_px: float = _WIDTH_PX
    text: str = ""
    position_m: tuple[float, float, float] = (0.0, 0.0, 0.0)


def drawn(scene: bpy.types.Scene, layer: bpy.types.ViewLayer) -> Iterator[Drawn]:
    """Give all that is drawn of a scene, as its settings ask for it."""
    for name, parts in _PARTS.items():
        if name not in scene.bda.overlays:
            continue
        for part in parts(scene, layer):
            yield replace(part, lines=draped(part.lines, areas.ground_of(scene))) if name in _ON_GROUND else part


def _zones(scene: bpy.types.Scene, _layer: bpy.types.ViewLayer) -> Iterator[Drawn]:
    for zone in shown_site(scene.bda)["zones"]:
        lines = zone_lines(zone)
        yield Drawn(
            lines, _ZONE_COLOURS[zone.kind], text=f"{zone.name} ({translated(zone.kind)})", position_m=tuple(lines[0])
        )


def _neighbours(scene: bpy.types.Scene, _layer: bpy.types.ViewLayer) -> Iterator[Drawn]:
    for neighbour in shown_site(scene.bda)["neighbours"]:
        position = neighbour.position_m
        yield Drawn(cross_lines(position, _NEIGHBOUR_M), _COLOURS[NEIGHBOURS], text=neighbour.name, position_m=position)


def _exclusion(scene: bpy.types.Scene, _layer: bpy.types.ViewLayer) -> Iterator[Drawn]:
    settings = shown_site(scene.bda)["exclusion"]
    zone = areas.zone_of(scene, settings) if settings else None
    if zone is not None:
        is_run = areas.results_of(scene) is not None
        text = "Exclusion zone of the last run" if is_run else "Exclusion zone as planned, without debris"
        yield _outlined(zone.whole, EXCLUSION, translated(text))


def _debris(scene: bpy.types.Scene, _layer: bpy.types.ViewLayer) -> Iterator[Drawn]:
    if (area := areas.debris_of(scene)) is not None:
        yield _outlined(area, DEBRIS, translated("Debris: {}").format(area_text(area.area(), ".0f")))


def _rings(scene: bpy.types.Scene, _layer: bpy.types.ViewLayer) -> Iterator[Drawn]:
    for distance, lines in areas.rings_of(scene, scene.bda.distance_spacing_m, scene.bda.distance_count):
        yield Drawn(lines, _COLOURS[RINGS], 1.0, length_text(distance, "g"), tuple(lines[int(lines[:, 0].argmax())]))


def _path(scene: bpy.types.Scene, _layer: bpy.types.ViewLayer) -> Iterator[Drawn]:
    for positions in areas.path_of_ball(scene):
        yield Drawn(way_lines(positions), _COLOURS[WAY], _WIDTHS_PX[WAY])


def _flashes(scene: bpy.types.Scene, _layer: bpy.types.ViewLayer) -> Iterator[Drawn]:
    settings = blast_of(scene)
    if not settings.explosion or not scene.rigidbody_world:
        return
    now_s = simulated_time_s(scene, FIRST_STEP_FRAME)
    for charge in charges_of(scene):
        share = flash_share(now_s - settings.start_s - charge.delay_s) if charge.mass_kg > 0.0 else 0.0
        if share > 0.0:
            lines = flash_lines(charge.position_m, _FLASH_M * share)
            yield Drawn(lines, (*_FLASH, share), _WIDTHS_PX[FLASHES], charge.name, charge.position_m)


def _blast_zones(scene: bpy.types.Scene, _layer: bpy.types.ViewLayer) -> Iterator[Drawn]:
    """Zones before they fire, with the time at which they do; a flash as they do so.

    Where nothing is built, and as time begins, they are those of the panels, which may have changed since.
    """
    start_s = blast_of(scene).start_s
    now_s = simulated_time_s(scene, FIRST_STEP_FRAME) if scene.rigidbody_world else 0.0
    zones = areas.blast_zones_of(scene) if now_s > 0.0 else areas.planned_blast_zones_of(scene)
    for placed, colour in zip(zones, delay_colours(zones).tolist(), strict=True):
        zone = placed.zone
        fires_s = zone.row_times_s()[-1] + start_s
        top = placed.box_m.mean(axis=0)
        top[2] = placed.box_m[1, 2]
        if not (zone.goes_off and now_s > fires_s):
            text = f"{zone.name}: {zone.delay_ms:g} ms" if zone.goes_off else f"{zone.name}: {translated('misfires')}"
            yield Drawn(box_lines(placed.box_m), (*colour, 1.0), _WIDTHS_PX[NAMES], text, tuple(top.tolist()))
            yield Drawn(hole_lines(placed), (*colour, 0.8))
        share = flash_share(now_s - fires_s) if zone.goes_off else 0.0
        if share > 0.0:
            lines = flash_lines(placed.box_m.mean(axis=0).tolist(), _FLASH_M * share)
            yield Drawn(lines, (*_FLASH, share), _WIDTHS_PX[FLASHES])


def _chosen(scene: bpy.types.Scene, layer: bpy.types.ViewLayer) -> Iterator[Drawn]:
    body = layer.objects.active
    world = scene.rigidbody_world
    if body is None or not body.select_get(view_layer=layer) or not world or not world.collection:
        return
    if body.rigid_body is None or body.name not in world.collection.all_objects or kind_of(body) == Kind.GROUND:
        return
    matrix = np.array(body.evaluated_get(layer.depsgraph).matrix_world, float)
    edges = np.empty(2 * len(body.data.edges), np.int32)
    body.data.edges.foreach_get("vertices", edges)
    corners = np.empty(3 * len(body.data.vertices), np.float32)
    body.data.vertices.foreach_get("co", corners)
    lines = corners.reshape(-1, 3)[edges] @ matrix[:3, :3].T + matrix[:3, 3]
    yield Drawn(lines, _COLOURS[NAMES], _WIDTHS_PX[NAMES], body.name, tuple(matrix[:3, 3]))


def _outlined(area: CrossSection, name: str, text: str) -> Drawn:
    corners = np.concatenate([np.zeros((0, 2)), *outlines(area)])
    position = corners[corners[:, 0].argmax()] if len(corners) else (0.0, 0.0)
    return Drawn(outline_lines(area), _COLOURS[name], _WIDTHS_PX.get(name, _WIDTH_PX), text, (*position, 0.0))


_ON_GROUND = (EXCLUSION, ZONES, DEBRIS, RINGS)

_PARTS = {
    EXCLUSION: _exclusion,
    ZONES: _zones,
    DEBRIS: _debris,
    RINGS: _rings,
    NEIGHBOURS: _neighbours,
    WAY: _path,
    FLASHES: _flashes,
    NAMES: _chosen,
    BLAST_ZONES: _blast_zones,
}


def _draw_lines(context: bpy.types.Context) -> None:
    _texts.clear()
    for part in drawn(context.scene, context.view_layer):
        draw_lines(context, part.lines, part.colour, part.width_px)
        if part.text:
            _texts.append((part.position_m, part.text))


def _draw_texts(context: bpy.types.Context) -> None:
    """Write the texts of the lines, which Blender has drawn in the same view just before."""
    for position, text in _texts:
        write_at(context, position, text)


drawing = ViewDrawing(_draw_lines, _draw_texts, forget=areas.forget)
