"""The charge plan in a report: what is drilled and loaded, what fires when, and what that does around it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ...engineering.blast.vibration import FREE_FACE_AVERAGE
from ...engineering.drilled_charges.neighbours import BARE_KPA, STEMMED_KPA
from ...errors import GeometryError, ScenarioError
from ...model.bridge.preparation import prepared_members
from ...model.scenario import Scenario
from ...model.schema import given
from ...model.structure.blast_zones import POSSIBLE_G_T, RECORDED_G_T, PlacedZone
from ...model.structure.charge_plan import AtNeighbour, ChargePlan, Totals, charge_plan, zone_name
from ...model.structure.zone_fragments import NO_SAFETY_DISTANCE, FlyrockOfZone
from ...model.structure.zone_loads import ZoneFall, ZoneLoad, bars_used, zone_falls
from ..document.blocks import Block, Column, DataTable, Paragraph, Section, facts
from ..wording.clearance import CORDON, Flyrock, cordon_text, flyrock_of_plan

_TITLE = "Charge plan"
_MEGA = 1e6
_MS_PER_S = 1e3
_BY_WHOM = (
    "Charges are fixed by test shots and a licensed blaster. This plan says what follows from those that were entered. "
    "Thresholds of the specific charge are known within a factor of 2."
)
_BARS = (
    "Bars that stay resist this much once their concrete is gone, in compression by EN 1993-1-1, curve c: more may not "
    "be counted on. Straight ones, as in a run, resist up to yield or Euler's load: for the bridge to come down it has "
    "to overcome these. What comes upon bars at once, by the fall of what stood on them, presses them with up to twice "
    "its weight."
)
_SEVERED = (
    "Whether its explosive severs a member is for a licensed blaster to say: it counts for the ground, as bare for the "
    "air, and for the totals alone."
)
_SEQUENCE = (
    "Times are those that are planned, from the first possible detonation on. The mass within 8 ms is that of all rows "
    "that can fire within 8 ms from this one on, each two standard deviations of its detonator early or late."
)
_FLYING = (
    "Fragments smaller than a shard, sampled with drag and cover: parts of the mass in fragments above 0.1 kg. Beside "
    f"them the largest distances by two rules, as if nothing covered the holes. All of these are {NO_SAFETY_DISTANCE}."
)

_ZONE = (
    Column("zone", "zone", "", zone_name),
    Column("member", "member", "", lambda placed: placed.member.name),
    Column("from (m)", "from_m", ".2f", lambda placed: placed.zone.ends_along_m[0]),
    Column("to (m)", "to_m", ".2f", lambda placed: placed.zone.ends_along_m[1]),
    Column("along", "along", "", lambda placed: placed.zone.along),
)
_DRILLED = (
    *_ZONE,
    Column("side", "side", "", lambda placed: placed.zone.side),
    Column("rows", "rows", "d", lambda placed: placed.zone.rows),
    Column("holes", "holes", "d", lambda placed: placed.zone.holes),
    Column("Ø (mm)", "hole_diameter_mm", ".0f", lambda placed: placed.zone.hole_diameter_mm),
    Column("apart (m)", "spacing_m", ".2f", lambda placed: placed.zone.spacing_m),
    Column("rows apart (m)", "row_spacing_m", ".2f", lambda placed: placed.row_spacing_m),
    Column("deep (m)", "depth_m", ".2f", lambda placed: placed.zone.depth_m),
    Column("drilled (m)", "drilled_m", ".1f", lambda placed: placed.zone.drilled_m),
)
_LOADED = (
    Column("zone", "zone", "", zone_name),
    Column("explosive", "explosive", "", lambda placed: placed.zone.explosive),
    Column("a hole (g)", "charge_g", ".1f", lambda placed: placed.zone.charge_g),
    Column("mass (kg)", "mass_kg", ".2f", significant=3, value=lambda placed: placed.zone.mass_kg),
    Column("volume (m³)", "volume_m3", ".3f", lambda placed: placed.volume_m3),
    Column("kg/m³", "specific_charge_kg_m3", ".2f", lambda placed: placed.specific_kg_m3),
    Column("breaks from", "breaks_from_kg_m3", ".2f", lambda placed: placed.thresholds.break_kg_m3),
    Column("thrown out from", "thrown_out_from_kg_m3", ".2f", lambda placed: placed.thresholds.throw_kg_m3),
    Column("effect", "effect", "", lambda placed: placed.effect.value if placed.zone.fires else "misfires"),
    Column("burden (m)", "burden_m", ".3f", lambda placed: placed.burden_m),
    Column("stemming (m)", "stemming_m", ".2f", lambda placed: placed.zone.stemming_m),
    Column("over burden", "stemming_over_burden", ".2f", lambda placed: placed.zone.stemming_m / placed.burden_m),
    Column("bars in tension (MN)", "bars_tension_MN", ".2f", lambda placed: placed.cage_n[0] / _MEGA),
    Column("in compression (MN)", "bars_compression_MN", ".2f", lambda placed: placed.cage_n[1] / _MEGA),
    Column("straight ones (MN)", "bars_straight_compression_MN", ".2f", lambda placed: placed.straight_cage_n / _MEGA),
)
_FALLS_TEXT = (
    "What is above a zone whose concrete is thrown out falls by the height of the zone. Where its member has one such "
    "zone only, it can land upright on the stub below it and stand: a second zone lets it fold. What zones carry is "
    "that at rest, by statics, below 0 where they are pulled."
)
_FALLS = (
    Column("zone", "zone", "", lambda row: zone_name(row.placed)),
    Column("carries (MN)", "carries_MN", ".2f", lambda row: row.load and row.load.pressed_n / _MEGA),
    Column(
        "over what its bars may be counted on for",
        "carries_over_bars",
        ".2f",
        lambda row: row.load and row.placed.bars and bars_used(row.placed, row.load),
    ),
    Column("falls by (m)", "falls_m", ".2f", lambda row: row.fall.falls_m),
    Column("lands with (m/s)", "lands_m_s", ".1f", lambda row: row.fall.lands_m_s),
    Column("above it (m)", "above_m", ".2f", lambda row: row.fall.above_m),
    Column("stub (m)", "stub_m", ".2f", lambda row: row.fall.below_m),
    Column("can land and stand", "can_land_and_stand", "", lambda row: "yes" if row.fall.can_stand else "no"),
)
_CUTS = (
    Column("cut", "cut", "", lambda cut: cut.name),
    Column("member", "member", "", lambda cut: cut.member),
    Column("along", "along", "", lambda cut: cut.along),
    Column("at (m)", "position_m", ".2f", lambda cut: cut.position_m),
    Column("mass (kg)", "mass_kg", ".2f", significant=3, value=lambda cut: cut.mass_kg),
)
_FIRED = (
    Column("time (ms)", "time_ms", ".0f", lambda row: _MS_PER_S * row.time_s),
    Column("earlier or later (ms)", "spread_ms", ".1f", lambda row: _MS_PER_S * row.spread_s),
    Column("zone", "zone", "", lambda row: row.name),
    Column("row", "row", "d", lambda row: row.row),
    Column("detonators", "detonators", "d", lambda row: row.detonators),
    Column("kind", "detonator", "", lambda row: row.detonator),
    Column("mass (kg)", "mass_kg", ".2f", significant=3, value=lambda row: row.mass_kg),
    Column("within 8 ms (kg)", "mass_within_8_ms_kg", ".2f", significant=3, value=lambda row: row.together_kg),
)
_AROUND = (
    Column("neighbour", "neighbour", "", lambda at: at.neighbour.name),
    Column("distance (m)", "distance_m", ".1f", lambda at: at.distance_m),
    Column("ground (mm/s)", "peak_particle_velocity_mm_s", ".2f", lambda at: _MS_PER_S * at.velocity_m_s),
    Column("limit (mm/s)", "limit_mm_s", ".1f", lambda at: at.neighbour.limit_mm_s),
    Column("air (Pa)", "air_pressure_Pa", ".1f", lambda at: at.pressure_pa),
    Column("air (dB)", "air_level_dB", ".0f", lambda at: at.level_db),
    Column("limit (dB)", "limit_dB", ".0f", lambda at: at.neighbour.limit_db),
)
_FLOWN = (
    Column("zone", "zone", "", lambda placed, _: zone_name(placed)),
    Column("factor of its cover", "cover_factor", ".2f", lambda placed, _: placed.zone.cover_factor),
    Column("50 % (m)", "half_within_m", ".0f", lambda _, flown: flown.sampled.half_m),
    Column("99 % (m)", "most_within_m", ".0f", lambda _, flown: flown.sampled.most_m),
    Column("99.9 % (m)", "nearly_all_within_m", ".0f", lambda _, flown: flown.sampled.nearly_all_m),
    Column("farthest (m)", "farthest_m", ".0f", lambda _, flown: flown.sampled.largest_m),
    Column("Lundborg (m)", "lundborg_m", ".0f", lambda _, flown: flown.lundborg_m),
    Column("McKenzie (m)", "mckenzie_m", ".0f", lambda _, flown: flown.mckenzie_m),
)


@dataclass(frozen=True, slots=True)
class _Fall:
    """A zone that is thrown out, what it carries, if known, and how what is above it falls."""

    placed: PlacedZone
    load: ZoneLoad | None
    fall: ZoneFall


def known_plan(scenario: Scenario | None) -> ChargePlan | str | None:
    """Return the charge plan of a scenario; None without blast zones and cuts.

    Where a file of its members is not there any more, a text says so.
    """
    if scenario is None or not (scenario.blast_zones or scenario.cuts):
        return None
    try:
        return charge_plan(scenario, prepared_members(scenario).members)
    except (GeometryError, ScenarioError) as error:
        return str(error)


def flyrock_of(plan: ChargePlan | str | None) -> Flyrock | str | None:
    """Return how far fragments of a plan fly, or why it is not known; None without blast zones."""
    return flyrock_of_plan(plan) if isinstance(plan, ChargePlan) else plan


def charge_plan_section(
    scenario: Scenario, plan: ChargePlan | str | None, loads: Sequence[ZoneLoad] = ()
) -> Section | None:
    """Return the charge plan of a scenario, as `known_plan` has it; None without one. `loads` are what zones carry."""
    if not isinstance(plan, ChargePlan):
        return Section(_TITLE, (Paragraph(f"The charge plan is not known: {plan}.", True),)) if plan else None
    cordon_m = scenario.exclusion.cordon_m if scenario.exclusion else None
    return Section(_TITLE, tuple(plan_blocks(plan, loads, cordon_m)))


def planned_section(scenario: Scenario, loads: Sequence[ZoneLoad] = ()) -> Section:
    """Return the charge plan of a scenario with blast zones or cuts, all of whose files are there."""
    plan = charge_plan(scenario, prepared_members(scenario).members)
    return given(charge_plan_section(scenario, plan, loads))


def plan_blocks(plan: ChargePlan, loads: Sequence[ZoneLoad] = (), cordon_m: float | None = None) -> Iterator[Block]:
    """Yield the tables of a charge plan, with what they mean, and what is kept clear around the bridge."""
    yield Paragraph(_BY_WHOM)
    yield from _warnings(plan)
    if plan.zones:
        yield DataTable.of("drill_holes", "Drill holes", _DRILLED, plan.zones)
        yield DataTable.of("charge_table", "Charges and their effect", _LOADED, plan.zones)
    if any(placed.bars for placed in plan.zones):
        yield Paragraph(_BARS)
    carried, placed_of = {load.zone: load for load in loads}, {zone_name(placed): placed for placed in plan.zones}
    falls = [_Fall(placed_of[name], carried.get(name), fall) for name, fall in zone_falls(plan.zones).items()]
    if falls:
        yield Paragraph(_FALLS_TEXT)
        yield DataTable.of("zone_falls", "What is above the zones", _FALLS, falls)
    if plan.cuts:
        yield Paragraph(_SEVERED)
        yield DataTable.of("severed_members", "Severed members", _CUTS, plan.cuts)
    yield Paragraph(_SEQUENCE)
    yield DataTable.of("firing_sequence", "Firing sequence", _FIRED, plan.rows)
    yield facts("Totals", _totals(plan), "charge_totals")
    yield from _neighbours(plan.neighbours)
    flown = [(placed, of) for placed, of in zip(plan.zones, plan.flyrock, strict=True) if of is not None]
    if flown:
        distances = flyrock.distances if (flyrock := flyrock_of_plan(plan)) else []
        clear = "" if cordon_m is None else f" {CORDON}: {cordon_text(cordon_m, distances)}."
        yield Paragraph(_FLYING + clear)
        yield _fragments(flown)


def _warnings(plan: ChargePlan) -> Iterator[Block]:
    """Yield what a blaster would ask about; the same sentence on several zones only once, with their names."""
    by_text: dict[str, list[str]] = {}
    for placed in plan.zones:
        for text in placed.warnings():
            by_text.setdefault(text, []).append(zone_name(placed))
    for text, names in by_text.items():
        yield Paragraph(f"Look at {', '.join(names)}: {text}.", True)
    failed = [zone_name(placed) for placed in plan.zones if not placed.zone.fires]
    if failed := [*failed, *(given(cut.name) for cut in plan.cuts if not cut.fires)]:
        yield Paragraph(f"Planned not to fire: {', '.join(failed)}.", True)
    rate, (least, most) = plan.totals.grams_per_tonne, POSSIBLE_G_T
    if not least <= rate <= most:
        yield Paragraph(f"{rate:.1f} g/t are outside {least:g} to {most:g} g/t, which recorded jobs are within.", True)


def _totals(plan: ChargePlan) -> list[tuple[str, str]]:
    totals, (least, most) = plan.totals, RECORDED_G_T
    return [
        ("Explosive", f"{totals.mass_kg:.3g} kg"),
        *(_of_holes(totals) if totals.holes else ()),
        ("By mass of the bridge", f"{totals.grams_per_tonne:.1f} g/t; recorded jobs have {least:g} to {most:g} g/t"),
        ("Largest mass within 8 ms", f"{totals.together_kg:.3g} kg"),
        ("From the first row to the last", f"{_MS_PER_S * totals.lasts_s:.0f} ms"),
    ]


def _of_holes(totals: Totals) -> list[tuple[str, str]]:
    return [
        ("Holes, each with a detonator", f"{totals.holes}"),
        ("Drilled", f"{totals.drilled_m:.1f} m"),
        ("Concrete of all zones", f"{totals.volume_m3:.3f} m³"),
        ("Specific charge", f"{totals.specific_kg_m3:.2f} kg/m³"),
    ]


def _neighbours(at: Sequence[AtNeighbour]) -> Iterator[Block]:
    if not at:
        yield Paragraph(
            "The scenario has no neighbours: add tables [[neighbours]] for vibration and air pressure there."
        )
        return
    ground = FREE_FACE_AVERAGE
    yield Paragraph(
        f"Vibration by v = {1e3 * ground.velocity_m_s:g} mm/s (R/√Q)^-{ground.exponent:g} ({ground.name}), air "
        f"pressure by P = {STEMMED_KPA:g} kPa (R/Q^⅓)^-1.45 of stemmed holes, {BARE_KPA:g} kPa of what is bare "
        "(AS 2187.2), Q the mass within 8 ms and R the distance to its nearest part. The fall of the bridge often "
        "shakes the ground more."
    )
    for one in at:
        if one.is_above_limit:
            yield Paragraph(f"{one.neighbour.name}: a limit is not kept.", True)
    yield DataTable.of("charge_neighbours", "At the neighbours", _AROUND, at)


def _fragments(flown: Sequence[tuple[PlacedZone, FlyrockOfZone]]) -> DataTable:
    worst_first = sorted(flown, key=lambda pair: pair[1].sampled.largest_m, reverse=True)
    zones, distances = zip(*worst_first, strict=True)
    return DataTable.of("fragments", "How far fragments fly", _FLOWN, zones, distances)
