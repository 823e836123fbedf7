"""Drawing on the ground and in the air of the 3D view: zones, distances, neighbours, flashes, the chosen shard.

Nothing here changes any data, and nothing raises: the sidebar says what cannot be drawn.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import bpy
import numpy as np
from bpy.props import EnumProperty, FloatProperty, FloatVectorProperty, IntProperty
from manifold3d import CrossSection

from ...display.ground_lines import (
    cross_lines,
    distance_rings,
    draped,
    flash_lines,
    flash_share,
    outline_lines,
    planned_zone,
    way_lines,
    zone_lines,
)
from ...display.zone_boxes import box_lines, delay_colours, hole_lines
from ...engineering.geometry.plan_areas import outlines, united
from ...engineering.geometry.vectors import transformed
from ...engineering.terrain.surface import RecordedGround
from ...errors import GeometryError, ScenarioError
from ...model.bridge.preparation import prepared_members
from ...model.debris.footprint import footprint
from ...model.debris.zones import ExclusionZone, exclusion_zone
from ...model.results.arrays import Results
from ...model.scenario import BlastZone, Exclusion
from ...model.scenario.file import scenario_from_text
from ...model.structure.blast_zones import PlacedZone, placed_zones
from ...scene.blast.charges import blast_of, charges_of
from ...scene.bodies import Kind, bodies_of, is_uneven_ground, kind_of, triangle_mesh
from ...scene.rendering.ground import ground_of as ground_in
from ...scene.world import FIRST_STEP_FRAME, simulated_time_s
from ...simulation.blender_events import shown_results
from ..languages.words import translated
from ..preview.zone_handles import zones_shown
from ..scenario.built import shown_site
from ..scene_units import area_text, length_text
from ..sidebar import path_property
from ..view_drawing import ViewDrawing, draw_lines, write_at
from ..viewport import redraw_views

EXCLUSION, ZONES, DEBRIS, RINGS = "EXCLUSION", "ZONES", "DEBRIS", "RINGS"
NEIGHBOURS, WAY, FLASHES, NAMES = "NEIGHBOURS", "WAY", "FLASHES", "NAMES"
BLAST_ZONES = "BLAST_ZONES"
_OVERLAYS = (
    (EXCLUSION, "Exclusion Zone", "The exclusion zone: of the last run, or as it is planned before there is one"),
    (ZONES, "Zones", "The zones of Scenario, with their names"),
    (DEBRIS, "Debris", "What the debris of the last run covers when it ends"),
    (RINGS, "Distances", "How far from the plan of the bridge the ground is"),
    (NEIGHBOURS, "Neighbours", "The neighbours of Scenario, with their names"),
    (WAY, "Path of Ball", "The path of the ball in the last run"),
    (FLASHES, "Flashes", "A flash where a charge goes off"),
    (NAMES, "Chosen Shard", "Outline and name of the body that is selected"),
    (BLAST_ZONES, "Blast Zones", "Blast zones with their drill holes, coloured by their delays, until they fire"),
)


class GroundProperties:
    """Part of the settings of a scene."""

    overlays: EnumProperty(
        name="Show",
        description="What is drawn on the ground and in the air of the 3D view",
        items=_OVERLAYS,
        options={"ENUM_FLAG"},
        default={ZONES, NEIGHBOURS, FLASHES, NAMES, BLAST_ZONES},
        update=redraw_views,
    )
    distance_spacing_m: FloatProperty(
        name="Every",
        description="Distance from ring to ring, such as 10 m",
        default=10.0,
        min=0.5,
        max=1000.0,
        unit="LENGTH",
        update=redraw_views,
    )
    distance_count: IntProperty(
        name="Rings", description="How many rings of distance, such as 5", default=5, min=1, max=20, update=redraw_views
    )
    plan_picture: path_property("Site Plan", "Picture of a site plan, or one from the air, to lie under the bridge")
    plan_width_m: FloatProperty(
        name="Width",
        description="Width of the picture on the ground, such as 200 m",
        default=200.0,
        min=1.0,
        max=1e5,
        unit="LENGTH",
    )
    plan_bearing_deg: FloatProperty(
        name="Bearing",
        description="Direction of the road's x axis, clockwise from the upward direction of the picture: 90° for a "
        "picture with north up and a road from west to east",
        default=90.0,
        min=-360.0,
        max=360.0,
    )
    plan_origin: FloatVectorProperty(
        name="Origin",
        description="Where the origin of the scenario lies in the picture, from its left and from its foot: 0.5 and "
        "0.5 for its middle",
        size=2,
        default=(0.5, 0.5),
        min=-10.0,
        max=10.0,
    )


_kept: dict[str, tuple[tuple, Any]] = {}
"""Results that were worked out last, with the keys that they depend on."""


def forget() -> None:
    """Forget these results."""
    _kept.clear()


def results_of(scene: bpy.types.Scene) -> Results | None:
    """Return the results that are shown in a scene; None where there are none, and while a run goes on."""
    return shown_results(scene).results


def plan_of(scene: bpy.types.Scene) -> CrossSection | None:
    """Return the area that the bridge covers in plan at first; None where there is no bridge."""
    results = results_of(scene)
    if results is not None and len(results.inventory.of_kind("shard")):
        return _cached("plan", _key(scene), lambda: footprint(results, results.inventory.of_kind("shard"), 0))
    world = scene.rigidbody_world
    if not world or not world.collection:
        return None
    shards = [body for body in bodies_of(scene) if kind_of(body) == Kind.SHARD]
    key = (scene.session_uid, len(shards), scene.bda.built_scenario)
    return _cached("plan", key, lambda: _plan_as_built(shards)) if shards else None


def rings_of(scene: bpy.types.Scene, spacing_m: float, number: int) -> list[tuple[float, np.ndarray]]:
    """Return rings of distance around the plan, as `distance_rings` does; none without a bridge."""
    plan = plan_of(scene)
    if plan is None:
        return []
    return _cached("rings", (_kept["plan"][0], spacing_m, number), lambda: distance_rings(plan, spacing_m, number))


def debris_of(scene: bpy.types.Scene) -> CrossSection | None:
    """Return the area that shards cover in plan when the last run ends; None without a run."""
    results = results_of(scene)
    if results is None or not len(shards := results.inventory.of_kind("shard")):
        return None
    return _cached("debris", _key(scene), lambda: footprint(results, shards, len(results.frames) - 1))


def zone_of(scene: bpy.types.Scene, settings: Exclusion) -> ExclusionZone | None:
    """Return the exclusion zone of the last run, or the planned one before a run; None without a bridge."""
    results, plan = results_of(scene), plan_of(scene)
    if plan is None:
        return None
    if results is None or not len(results.inventory.of_kind("shard")):
        return planned_zone(plan, settings)
    return _cached("zone", (*_key(scene), settings), lambda: exclusion_zone(results, settings))


def blast_zones_of(scene: bpy.types.Scene) -> tuple[PlacedZone, ...]:
    """Return the blast zones that a scene was built with; none where their members are not known any more."""
    text = scene.bda.built_scenario
    if f"[[{BlastZone.table}]]" not in text:
        return ()

    def placed() -> tuple[PlacedZone, ...]:
        try:
            scenario = scenario_from_text(text)
            return placed_zones(scenario, prepared_members(scenario).members)
        except (GeometryError, ScenarioError):
            return ()

    return _cached("blast zones", (text,), placed)


def planned_blast_zones_of(scene: bpy.types.Scene) -> tuple[PlacedZone, ...]:
    """Return the blast zones that the panels show, where they lie in their members; none where that is not known."""
    try:
        return tuple(placed for placed in zones_shown(scene.bda) if placed is not None)
    except (GeometryError, ScenarioError):
        return ()


def ground_of(scene: bpy.types.Scene) -> RecordedGround:
    """Return the ground of a scene, as it was built."""
    world = scene.rigidbody_world
    bodies = bodies_of(scene) if world and world.collection else []
    built = [(body.name, len(body.data.vertices)) for body in bodies if is_uneven_ground(body)]
    key = (scene.session_uid, tuple(built), scene.bda.built_scenario)
    return _cached("ground", key, lambda: ground_in(scene))


def path_of_ball(scene: bpy.types.Scene) -> list[np.ndarray]:
    """Return the positions (k, 3) float, m, of each ball of the last run."""
    results = results_of(scene)
    if results is None:
        return []
    return [np.asarray(results.frames.positions_m[:, ball], float) for ball in results.inventory.of_kind("ball")]


def _key(scene: bpy.types.Scene) -> tuple[int, int]:
    return scene.session_uid, shown_results(scene).number


def _plan_as_built(shards: list[bpy.types.Object]) -> CrossSection:
    plans = []
    for shard in shards:
        matrix = np.array(shard.matrix_basis, float)
        corners = transformed(matrix[:3, :3], triangle_mesh(shard.data).vertices) + matrix[:3, 3]
        plans.append(CrossSection.hull_points(corners[:, :2]))
    return united(plans)


def _cached(name: str, key: tuple, work_out: Callable[[], Any]) -> Any:
    if name not in _kept or _kept[name][0] != key:
        _kept[name] = (key, work_out())
    return _kept[name][1]


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
            yield replace(part, lines=draped(part.lines, ground_of(scene))) if name in _ON_GROUND else part


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
    zone = zone_of(scene, settings) if settings else None
    if zone is not None:
        is_run = results_of(scene) is not None
        text = "Exclusion zone of the last run" if is_run else "Exclusion zone as planned, without debris"
        yield _outlined(zone.whole, EXCLUSION, translated(text))


def _debris(scene: bpy.types.Scene, _layer: bpy.types.ViewLayer) -> Iterator[Drawn]:
    if (area := debris_of(scene)) is not None:
        yield _outlined(area, DEBRIS, translated("Debris: {}").format(area_text(area.area(), ".0f")))


def _rings(scene: bpy.types.Scene, _layer: bpy.types.ViewLayer) -> Iterator[Drawn]:
    for distance, lines in rings_of(scene, scene.bda.distance_spacing_m, scene.bda.distance_count):
        yield Drawn(lines, _COLOURS[RINGS], 1.0, length_text(distance, "g"), tuple(lines[int(lines[:, 0].argmax())]))


def _path(scene: bpy.types.Scene, _layer: bpy.types.ViewLayer) -> Iterator[Drawn]:
    for positions in path_of_ball(scene):
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

    Where nothing is built, and as time begins, the zones are the panels', which may have changed since.
    """
    start_s = blast_of(scene).start_s
    now_s = simulated_time_s(scene, FIRST_STEP_FRAME) if scene.rigidbody_world else 0.0
    zones = blast_zones_of(scene) if now_s > 0.0 else planned_blast_zones_of(scene)
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


drawing = ViewDrawing(_draw_lines, _draw_texts, forget=forget)
