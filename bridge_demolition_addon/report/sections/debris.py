"""Debris in a report: map, footprint, throws, pile, zones, and the exclusion zone of one run."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

import numpy as np

from ...charts.histories import throw_distribution
from ...charts.plan_maps import OnPlan, debris_map, exclusion_map, map_height_mm, pile_map
from ...engineering.geometry.plan_areas import outlines
from ...engineering.geometry.vectors import length
from ...engineering.units import mass_text, rounded_down, rounded_up, volume_text
from ...model.debris.throws import (
    PERCENTS,
    PILES_NOTE,
    Debris,
    HeightMap,
    bodies_under_ground,
    debris_on_surfaces,
    height_map,
    percentiles_by_mass,
)
from ...model.debris.zones import ExclusionZone, exclusion_zone, watch_zone
from ...model.results.arrays import Results
from ...model.results.energy import throws_of
from ...model.results.motion import MOVED_M, relative_to_ground, without_removed
from ...model.results.moving import still_moving_note
from ...model.scenario import Zone
from ...model.schema import given
from ...model.structure.zone_fragments import NO_SAFETY_DISTANCE
from ...model.terrain.built import terrain_summary
from ...texts import DOWN, UP, Quantity, Text, distance_to_keep
from ..document.blocks import Block, Column, DataTable, Paragraph, Picture, Section, facts
from ..run_folder import ReportedRun
from .cover import first_doubts_notice

_ZONE = Text("Exclusion zone of one run")

NAMED = 10
"""Largest throws in the table."""


def debris_section(run: ReportedRun, debris: Debris, *, trajectories: bool) -> Section:
    """Return where the debris went."""
    results, zones = run.recorded, run.scenario.zones if run.scenario else ()
    words = Text(
        "Debris is every shard that ended more than {} from where it began. The throw is the horizontal distance "
        "between the first and the last position of its centre of mass; its debris distance is how far it ends "
        "outside the bridge's first outline in plan.",
        distance_to_keep(MOVED_M, "g"),
    )
    blocks: list[Block] = [Paragraph(words)]
    blocks += first_doubts_notice(run)
    if len(debris.bodies):
        heights = height_map(results, debris.bodies)
        blocks.append(Paragraph(Text("{}.", PILES_NOTE), is_notice=True))
        on_plan: Sequence[OnPlan] = [*zones, *(run.scenario.fall_beds if run.scenario else ())]
        blocks += _debris_blocks(results, debris, heights, on_plan, trajectories)
    else:
        blocks.append(Paragraph("No shard moved that far: there is no debris.", is_notice=True))
    blocks += _zone_blocks(run, zones)
    return Section("Debris", tuple(blocks))


def exclusion_section(zone: ExclusionZone | None, run: ReportedRun, files: Sequence[str]) -> Section:
    """Return the exclusion zone, or why there is none."""
    if zone is None:
        words = Text(
            "The scenario gives no exclusion zone. Add the table [exclusion] with a buffer to "
            "scenario_as_run.toml in the folder of the run, or tick it in Blender's sidebar, and make the report "
            "again to have the zone here."
        )
        return Section(_ZONE, (Paragraph(words, is_notice=True),))
    settings = given(run.planned.exclusion)
    low_x, low_y, high_x, high_y = zone.bounds_m
    words = Text(
        "Plan area of the bridge, designed drop area, predicted debris area, and a buffer around all of them, as "
        "BS 6187 asks for. Predicted debris is the area that shards and balls covered at any time of this one "
        "run. The buffer of {} is the scenario's, not the simulation's. One run is no plan: another one throws "
        "farther. To fence off a site, take the limit of a study, with the buffer around it.",
        distance_to_keep(settings.buffer_m, "g"),
    )
    rows = [
        (Text("Buffer"), distance_to_keep(settings.buffer_m, "g")),
        (Text("Designed drop"), Text("{} around the bridge's plan", distance_to_keep(settings.designed_drop_m, "g"))),
        (Text("Plan area of the bridge"), Quantity(zone.plan.area(), "m²", ".1f")),
        (Text("Predicted debris area"), Quantity(zone.debris.area(), "m²", ".1f")),
        (_ZONE, Quantity(zone.whole.area(), "m²", ".1f")),
        (Text("Along the road"), _extent("x", low_x, high_x)),
        (Text("Across the road"), _extent("y", low_y, high_y)),
        (
            Text("Farthest from the bridge's plan"),
            _noted(run.recorded, "{}", "{}, {}", distance_to_keep(rounded_up(zone.largest_distance_m, "0.01"))),
        ),
    ]
    blocks: list[Block] = [
        Paragraph(words),
        Picture(
            partial(exclusion_map, zone=zone, zones=run.planned.zones, ground=run.recorded.ground()),
            _noted(
                run.recorded,
                "Exclusion zone of one run in plan, with its distance from the bridge to each side.",
                "Exclusion zone of one run in plan, with its distance from the bridge to each side, {}.",
            ),
            map_height_mm(zone.whole.bounds()),
        ),
        facts(_ZONE, rows, "exclusion_zone_of_one_run"),
        Paragraph(
            Text(
                "For the site plan: {}; the corners of the zone are in exclusion_corners_of_one_run.csv.",
                ", ".join(files),
            )
        ),
    ]
    if run.planned.charges:
        warning = Text("This zone leaves out the pressure of the charges: see the rings of damage for that.")
        blocks.insert(1, Paragraph(warning, is_notice=True))
    if run.planned.blast_zones:
        warning = Text(
            "This zone leaves out fragments that are smaller than shards: the site plan has areas of theirs, "
            "which are {}.",
            NO_SAFETY_DISTANCE,
        )
        blocks.insert(1, Paragraph(warning, is_notice=True))
    return Section(_ZONE, tuple(blocks))


def _extent(axis: str, low_m: float, high_m: float) -> str:
    """Return from where to where a zone reaches, no end of it rounded inwards."""
    low, high, size = rounded_down(low_m, "0.01"), rounded_up(high_m, "0.01"), rounded_up(high_m - low_m, "0.01")
    return Text(
        "from {} = {} to {}, {}",
        axis,
        Quantity(low, "m", rounding=UP if low_m < 0.0 else DOWN),
        Quantity(high, "m", rounding=DOWN if high_m < 0.0 else UP),
        distance_to_keep(size),
    )


def zone_of(run: ReportedRun) -> ExclusionZone | None:
    """Return the exclusion zone where the scenario asks for one."""
    if run.results is None or run.scenario is None or run.scenario.exclusion is None:
        return None
    if not len(run.results.inventory.of_kind("shard")):
        return None
    return exclusion_zone(run.results, run.scenario.exclusion)


def corner_table(zone: ExclusionZone) -> DataTable:
    """Return the corners of the exclusion zone, for its CSV file."""
    columns = (Column("ring", "ring"), Column("x", "x_m", ".3f"), Column("y", "y_m", ".3f"))
    rows = [
        (number, round(float(x), 4), round(float(y), 4))
        for number, ring in enumerate(outlines(zone.whole), start=1)
        for x, y in ring
    ]
    return DataTable("exclusion_corners_of_one_run", "Corners of the exclusion zone of one run", columns, rows)


def _debris_blocks(
    results: Results, debris: Debris, heights: HeightMap, zones: Sequence[OnPlan], trajectories: bool
) -> list[Block]:
    covered = debris.outline if debris.area.is_empty() else debris.area
    low, high = np.array(covered.bounds()).reshape(2, 2)
    footprint = Text(
        "{}, from x = {} to {}, y = {} to {}",
        Quantity(debris.area.area(), "m²", ".1f"),
        Quantity(low[0], "m", ".2f", shown=False),
        Quantity(high[0], "m", ".2f"),
        Quantity(low[1], "m", ".2f", shown=False),
        Quantity(high[1], "m", ".2f"),
    )
    mass = debris.masses_kg.sum()
    middle = debris.masses_kg @ results.frames.positions_m[-1, debris.bodies] / mass
    positions = results.frames.positions_m[-1, debris.bodies]
    above_m = float(debris.masses_kg @ (positions[:, 2] - debris.ground.heights_at(positions[:, :2])) / mass)
    solid = float(results.inventory.volumes_m3[debris.bodies].sum())
    shards = len(results.inventory.of_kind("shard"))
    rows = [
        (Text("Debris"), Text("{} of {} shards, {}", len(debris.bodies), shards, mass_text(mass, 2))),
        (
            Text("Footprint"),
            footprint if covered is debris.area else Quantity(debris.area.area(), "m²", ".1f"),
        ),
        (Text("Bridge before"), Text("{} in plan", Quantity(debris.outline.area(), "m²", ".1f"))),
        (
            Text("Centre of mass"),
            Text(
                "x = {}, y = {}, {} above the ground",
                Quantity(middle[0], "m", ".2f"),
                Quantity(middle[1], "m", ".2f"),
                Quantity(above_m, "m", ".2f"),
            ),
        ),
        (Text("Highest point of the pile"), Text("{} above the ground", Quantity(debris.highest_m, "m", ".2f"))),
        (
            Text("Volume of the pile"),
            Text("{} under its surface, {} of it solid", volume_text(heights.volume_m3, 1), volume_text(solid, 1)),
        ),
        (
            Text("Farthest beyond the bridge's outline"),
            _noted(results, "{}", "{}, {}", distance_to_keep(rounded_up(float(debris.reaches_m.max()), "0.01"))),
        ),
    ]
    bridge = np.array(debris.outline.bounds()).reshape(2, 2)
    bounds = (*np.minimum(low, bridge[0]), *np.maximum(high, bridge[1]))
    return [
        Picture(
            partial(debris_map, results=results, debris=debris, zones=zones, trajectories=trajectories),
            _noted(
                results,
                "Debris at the end in plan. Arrows and numbers: the largest throws, from where a shard was to "
                "where it lies.",
                "Debris at the end in plan, {}. Arrows and numbers: the largest throws, from where a shard was to "
                "where it lies.",
            ),
            map_height_mm(bounds),
        ),
        facts("Debris at the end", rows, "debris"),
        Picture(
            partial(pile_map, heights=heights, outline=debris.outline, ground=debris.ground),
            "Height of the debris.",
            85.0,
        ),
        _throw_table(results, debris),
        Picture(
            partial(throw_distribution, throws_m=debris.throws_m, masses_kg=debris.masses_kg),
            _noted(
                results,
                "How much of the debris was thrown farther than a distance.",
                "How much of the debris was thrown farther than a distance, {}.",
            ),
            75.0,
        ),
        _largest_throws(results, debris),
        *_doubts(results),
        *_on_surfaces(results, debris),
    ]


def terrain_section(run: ReportedRun) -> Section | None:
    """Return what the ground is; None where it is flat and nothing went through it."""
    results = without_removed(run.recorded)[0]
    under, ground = bodies_under_ground(results), results.ground()
    blocks: list[Block] = []
    if run.summary and run.summary.terrain:
        blocks.append(facts("Ground", terrain_summary(run.summary.terrain), "terrain"))
    if ground.surfaces:
        rows = [
            (
                surface.name,
                Text("{}, {} in plan", Text(surface.kind), Quantity(ground.shown(surface).area(), "m²", ".1f")),
            )
            for surface in ground.surfaces
        ]
        blocks.append(facts("Surfaces on the ground", rows, "surfaces"))
    if len(under):
        words = Text(
            "{} bodies went through the ground or off its edge, such as {}: their throws are wrong. Small fast "
            "bodies need more sub-steps: set time.farthest_per_substep_m to a part of the smallest shard.",
            len(under),
            results.inventory.body_names[under[0]],
        )
        blocks.append(Paragraph(words, is_notice=True))
    return Section("Terrain", tuple(blocks)) if blocks else None


def _on_surfaces(results: Results, debris: Debris) -> list[Block]:
    """Table of the debris on each surface of the ground."""
    surfaces = debris_on_surfaces(results, debris)
    if not surfaces:
        return []
    columns = (
        Column("surface", "surface", "", lambda surface: surface.name),
        Column("kind", "kind", "", lambda surface: Text(surface.kind)),
        Column("shards on it", "shards", "d", lambda surface: len(surface.bodies)),
        Column("mass", "mass_t", ".2f", significant=3, value=lambda surface: surface.mass_kg / 1e3),
        Column("covered", "covered_m2", ".1f", lambda surface: surface.covered_m2),
    )
    title = Text("Debris over each surface, by where its middle lies in plan")
    return [DataTable.of("debris_on_surfaces", title, columns, surfaces)]


def _doubts(results: Results) -> list[Block]:
    """Notice of throws that the energy of a real shard does not explain."""
    throws = throws_of(results)
    count = int(throws.doubtful.sum())
    if not count:
        return []
    farthest = int(np.flatnonzero(throws.doubtful)[0])
    name, throw_m = results.inventory.body_names[throws.bodies[farthest]], throws.throws_m[farthest]
    words = Text(
        "{} throws are doubtful: at least half of the shard's kinetic energy came from the solver, or, without "
        "charges, the throw is more than twice the height of fall, to which v²/2g counts for the speed v at the "
        "start and that of a ball. The farthest is {}, {}. Do not plan with these throws; make sub-steps shorter "
        "and run again.",
        count,
        name,
        distance_to_keep(throw_m, ".1f"),
    )
    return [Paragraph(words, is_notice=True)]


def _throw_table(results: Results, debris: Debris) -> DataTable:
    by_number = np.ones(len(debris.throws_m))
    columns = (
        Column("of the debris", "percent", "d", lambda percent, *_: percent, unit="%"),
        Column(
            "by mass, thrown up to", "throw_by_mass_m", ".2f", lambda _, by_mass_m, *__: float(by_mass_m), is_reach=True
        ),
        Column("by number, thrown up to", "throw_by_number_m", ".2f", lambda *row: float(row[2]), is_reach=True),
        Column(
            "by mass, beyond the outline up to", "reach_by_mass_m", ".2f", lambda *row: float(row[3]), is_reach=True
        ),
    )
    return DataTable.of(
        "throw_percentiles",
        _noted(
            results,
            "Throw and debris distance: share of the debris that stayed within",
            "Throw and debris distance: share of the debris that stayed within, {}",
        ),
        columns,
        PERCENTS,
        percentiles_by_mass(debris.throws_m, debris.masses_kg),
        percentiles_by_mass(debris.throws_m, by_number),
        percentiles_by_mass(debris.reaches_m, debris.masses_kg),
    )


def _largest_throws(results: Results, debris: Debris) -> DataTable:
    throws = throws_of(results)
    doubts = dict(zip(throws.bodies.tolist(), throws.doubtful.tolist(), strict=True))
    shares = dict(zip(throws.bodies.tolist(), throws.made_shares.tolist(), strict=True))
    inventory, bodies, last_m = results.inventory, debris.bodies, results.frames.positions_m[-1]
    speeds = length(np.asarray(relative_to_ground(results).frames.velocities_m_s[-1], float))
    columns = (
        Column("shard", "shard", "", lambda row: str(inventory.body_names[bodies[row]])),
        Column("of", "member", "", lambda row: str(inventory.body_members[bodies[row]])),
        Column("mass", "mass_kg", ".0f", significant=3, value=lambda row: float(debris.masses_kg[row])),
        Column("throw", "throw_m", ".2f", lambda row: float(debris.throws_m[row]), is_reach=True),
        Column("debris distance", "reach_m", ".2f", lambda row: float(debris.reaches_m[row]), is_reach=True),
        Column("to x", "x_m", ".2f", lambda row: float(last_m[bodies[row], 0])),
        Column("y", "y_m", ".2f", lambda row: float(last_m[bodies[row], 1])),
        Column("z", "z_m", ".2f", lambda row: float(last_m[bodies[row], 2])),
        Column("at the end", "end_speed_m_s", ".2f", lambda row: float(speeds[bodies[row]])),
        Column("by the solver", "made_by_solver_percent", ".0f", lambda row: 100.0 * shares[bodies[row]]),
        Column("doubtful", "doubtful", "", lambda row: Text("yes") if doubts[bodies[row]] else Text("no")),
    )
    farthest = np.argsort(-debris.throws_m, kind="stable")[:NAMED]
    title = _noted(
        results,
        "Largest throws. By the solver: energy that it made, over the shard's largest kinetic energy",
        "Largest throws, {}. By the solver: energy that it made, over the shard's largest kinetic energy",
    )
    return DataTable.of("largest_throws", title, columns, farthest)


def _noted(results: Results, final: str, not_final: str, *values: str) -> Text:
    """Return a text by one pattern, or by that which says at its end that shards still moved."""
    note = still_moving_note(results)
    return Text(not_final, *values, note) if note else Text(final, *values)


def _zone_blocks(run: ReportedRun, zones: Sequence[Zone]) -> list[Block]:
    if not zones:
        return [Paragraph("The scenario names no zones, such as a road or a power line, to be watched.")]
    results = run.recorded
    bodies = np.concatenate([results.inventory.of_kind("shard"), results.inventory.of_kind("ball")])
    watches = [watch_zone(results, zone, bodies) for zone in zones]
    names = results.inventory.body_names
    columns = (
        Column("zone", "zone", "", lambda watch, _: watch.zone.name),
        Column("kind", "kind", "", lambda watch, _: Text(watch.zone.kind)),
        Column("first entered", "first_entry_s", ".3f", lambda _, first: first and float(first.time_s)),
        Column("by", "first_body", "", lambda _, first: str(names[first.body]) if first else Text("no body")),
        Column("bodies that entered", "bodies_entered", "d", lambda watch, _: len(watch.entries)),
        Column(
            "mass within at the end",
            "mass_within_t",
            ".2f",
            significant=3,
            value=lambda watch, _: watch.mass_within_kg / 1e3,
        ),
        Column("there before", "bodies_there_before", "d", lambda watch, _: len(watch.there_before)),
    )
    first_entries = [watch.entries[0] if watch.entries else None for watch in watches]
    words = Text(
        "A zone is entered when the convex hull of a shard or ball first enters it, to a millisecond: between "
        "frames bodies are taken to move and rotate evenly. Bodies that were in a zone at the beginning are "
        "counted apart."
    )
    return [Paragraph(words), DataTable.of("zones", "Zones", columns, watches, first_entries)]
