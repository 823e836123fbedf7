"""The charge plan in a report: what is drilled and loaded, what fires when, and what that does around it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from ...engineering.blast.site_law import SiteLaw
from ...engineering.blast.vibration import FREE_FACE_AVERAGE
from ...engineering.drilled_charges.neighbours import BARE_KPA, STEMMED_KPA
from ...errors import GeometryError, ScenarioError
from ...model.blast.vibration_laws import OF_CHARGES
from ...model.bridge.preparation import prepared_members
from ...model.debris.vibration_limits import CHARGES_HZ
from ...model.results.stability import ZoneLoad
from ...model.scenario import Scenario
from ...model.schema import given
from ...model.structure.blast_zones import POSSIBLE_G_T, RECORDED_G_T, PlacedZone
from ...model.structure.charge_plan import AtNeighbour, ChargePlan, Totals, charge_plan, zone_name
from ...model.structure.firing_order import firing_pairs
from ...model.structure.zone_fragments import FlyrockOfZone
from ...model.structure.zone_loads import ZoneFall, bars_used, zone_falls
from ...texts import Quantity, Text, Unit, joined
from ..document.blocks import Block, Column, DataTable, Paragraph, Section, facts
from ..wording.verdict import CORDON, Flyrock, cordon_text, flyrock_of_plan
from ..wording.vibration import extrapolated_text, limit_table, limits_text, site_law_text

_TITLE = Text("Charge plan")
_MEGA = 1e6
_MS_PER_S = 1e3
_BY_WHOM = Text(
    "Charges are fixed by test shots and a licensed blaster. This plan says what follows from those that were "
    "entered. Thresholds of the specific charge are known within a factor of 2."
)
_BARS = Text(
    "Bars that stay resist this much once their concrete is gone, in compression by EN 1993-1-1, curve c: more "
    "may not be counted on. Straight ones, as in a run, resist up to yield or Euler's load: for the bridge to "
    "come down it has to overcome these. What comes upon bars at once, by the fall of what stood on them, presses "
    "them with up to twice its weight."
)
_SEVERED = Text(
    "Whether its explosive severs a member is for a licensed blaster to say: it counts for the ground, as bare "
    "for the air, and for the totals alone."
)
_SEQUENCE = Text(
    "Times are those that are planned, from the first possible detonation on. The mass within 8 ms is that of all "
    "rows that can fire within 8 ms from this one on, each two standard deviations of its detonator early or late."
)
_FLYING = Text(
    "Fragments smaller than a shard, sampled with drag and cover: parts of the mass in fragments above {}. Beside "
    "them the largest distances by two rules, as if nothing covered the holes. All of these are within a factor "
    "of 2, and no safety distance.",
    Quantity("0.1", "kg"),
)

_ZONE = (
    Column("zone", "zone", "", zone_name),
    Column("member", "member", "", lambda placed: placed.member.name),
    Column("from", "from_m", ".2f", lambda placed: placed.zone.ends_along_m[0]),
    Column("to", "to_m", ".2f", lambda placed: placed.zone.ends_along_m[1]),
    Column("along", "along", "", lambda placed: Text(placed.zone.along)),
)
_DRILLED = (
    *_ZONE,
    Column("side", "side", "", lambda placed: Text(placed.zone.side)),
    Column("rows", "rows", "d", lambda placed: placed.zone.rows),
    Column("holes", "holes", "d", lambda placed: placed.zone.holes),
    Column("Ø", "hole_diameter_mm", ".0f", lambda placed: placed.zone.hole_diameter_mm),
    Column("apart", "spacing_m", ".2f", lambda placed: placed.zone.spacing_m),
    Column("rows apart", "row_spacing_m", ".2f", lambda placed: placed.row_spacing_m),
    Column("deep", "depth_m", ".2f", lambda placed: placed.zone.depth_m),
    Column("drilled", "drilled_m", ".1f", lambda placed: placed.zone.drilled_m),
)
_LOADED = (
    Column("zone", "zone", "", zone_name),
    Column("explosive", "explosive", "", lambda placed: Text(placed.zone.explosive)),
    Column("a hole", "charge_g", ".1f", lambda placed: placed.zone.charge_g, unit="g"),
    Column("mass", "mass_kg", ".2f", significant=3, value=lambda placed: placed.zone.mass_kg),
    Column("volume", "volume_m3", ".3f", lambda placed: placed.volume_m3),
    Column(Unit("kg/m³"), "specific_charge_kg_m3", ".2f", lambda placed: placed.specific_kg_m3, unit=""),
    Column("breaks from", "breaks_from_kg_m3", ".2f", lambda placed: placed.thresholds.break_kg_m3),
    Column("thrown out from", "thrown_out_from_kg_m3", ".2f", lambda placed: placed.thresholds.throw_kg_m3),
    Column("effect", "effect", "", lambda placed: Text(placed.effect.value if placed.zone.fires else "misfires")),
    Column("burden", "burden_m", ".3f", lambda placed: placed.burden_m),
    Column("stemming", "stemming_m", ".2f", lambda placed: placed.zone.stemming_m),
    Column("over burden", "stemming_over_burden", ".2f", lambda placed: placed.zone.stemming_m / placed.burden_m),
    Column("bars in tension", "bars_tension_MN", ".2f", lambda placed: placed.cage_n[0] / _MEGA, unit="MN"),
    Column("in compression", "bars_compression_MN", ".2f", lambda placed: placed.cage_n[1] / _MEGA, unit="MN"),
    Column(
        "straight ones", "bars_straight_compression_MN", ".2f", lambda placed: placed.straight_cage_n / _MEGA, unit="MN"
    ),
)
_FALLS_TEXT = Text(
    "What is above a zone whose concrete is thrown out falls by the height of the zone. Where its member has one "
    "such zone only, it can land upright on the stub below it and stand: a second zone lets it fold. Pieces between "
    "several zones can land on each other and stand as well, where none tips over after its fall. By energy its end "
    "is crushed by so much at most, and where it lands on an edge and nothing holds its head it tips over from that "
    "fall on. These are bounds that no test of a blasted column confirms, and a run can bring down what stands by "
    "them. What zones carry is that at rest, by statics, below 0 where they are pulled."
)
_FALLS = (
    Column("zone", "zone", "", lambda row: zone_name(row.placed)),
    Column("carries", "carries_MN", ".2f", lambda row: row.load and row.load.pressed_n / _MEGA, unit="MN"),
    Column(
        "over what its bars may be counted on for",
        "carries_over_bars",
        ".2f",
        lambda row: row.load and row.placed.bars and bars_used(row.placed, row.load),
    ),
    Column("falls by", "falls_m", ".2f", lambda row: row.fall.falls_m),
    Column("lands with", "lands_m_s", ".1f", lambda row: row.fall.lands_m_s),
    Column("above it", "above_m", ".2f", lambda row: row.fall.above_m),
    Column("stub", "stub_m", ".2f", lambda row: row.fall.below_m),
    Column("crushed at most", "crushed_m", ".2f", lambda row: row.fall.crushed_m),
    Column("tips on an edge from", "tips_from_m", ".2f", lambda row: row.fall.shaft and row.fall.shaft.tips_from_m),
    Column("can land and stand", "can_land_and_stand", "", lambda row: Text("yes" if row.fall.can_stand else "no")),
)
_CUTS = (
    Column("cut", "cut", "", lambda cut: cut.name),
    Column("member", "member", "", lambda cut: cut.member),
    Column("along", "along", "", lambda cut: Text(cut.along)),
    Column("at", "position_m", ".2f", lambda cut: cut.position_m),
    Column("mass", "mass_kg", ".2f", significant=3, value=lambda cut: cut.mass_kg),
)
_FIRED = (
    Column("time", "time_ms", ".0f", lambda row: _MS_PER_S * row.time_s),
    Column("earlier or later", "spread_ms", ".1f", lambda row: _MS_PER_S * row.spread_s),
    Column("zone", "zone", "", lambda row: row.name),
    Column("row", "row", "d", lambda row: row.row),
    Column("detonators", "detonators", "d", lambda row: row.detonators),
    Column("kind", "detonator", "", lambda row: Text(row.detonator)),
    Column("mass", "mass_kg", ".2f", significant=3, value=lambda row: row.mass_kg),
    Column("within 8 ms", "mass_within_8_ms_kg", ".2f", significant=3, value=lambda row: row.together_kg),
)
_ORDER_TEXT = Text(
    "How likely one detonator of a planned time fires before one of the time ahead of it, by their scatter: "
    "Φ(-Δt / √(s₁² + s₂²)), with standard deviations of 2 % of the delay with shock tube and 0.34 ms if electronic."
)
_ORDER = (
    Column("earlier", "earlier", "", lambda pair: joined("{}, {}", pair.earlier)),
    Column("later", "later", "", lambda pair: joined("{}, {}", pair.later)),
    Column("apart", "apart_ms", ".0f", lambda pair: _MS_PER_S * pair.apart_s),
    Column("chance", "chance", ".2g", lambda pair: pair.chance),
)
_AROUND = (
    Column("neighbour", "neighbour", "", lambda at: at.neighbour.name),
    Column("distance", "distance_m", ".1f", lambda at: at.distance_m),
    Column("ground", "peak_particle_velocity_mm_s", ".2f", lambda at: _MS_PER_S * at.velocity_m_s),
    Column("limit", "limit_mm_s", ".1f", lambda at: at.neighbour.limit_mm_s),
    Column("reaches the limit for", "limits", "", lambda at: limits_text(at.at_most_m_s, CHARGES_HZ)),
    Column("air", "air_pressure_Pa", ".1f", lambda at: at.pressure_pa),
    Column("air", "air_level_dB", ".0f", lambda at: at.level_db),
    Column("limit", "limit_dB", ".0f", lambda at: at.neighbour.limit_db),
)
_BY_SITE_LAW = (
    *_AROUND[:3],
    Column("at most", "at_most_mm_s", ".2f", lambda at: _MS_PER_S * at.at_most_m_s),
    *_AROUND[3:],
)
_FLOWN = (
    Column("zone", "zone", "", lambda placed, _: zone_name(placed)),
    Column("factor of its cover", "cover_factor", ".2f", lambda placed, _: placed.zone.cover_factor),
    Column("50 %", "half_within_m", ".0f", lambda _, flown: flown.sampled.half_m, is_reach=True),
    Column("99 %", "most_within_m", ".0f", lambda _, flown: flown.sampled.most_m, is_reach=True),
    Column("99.9 %", "nearly_all_within_m", ".0f", lambda _, flown: flown.sampled.nearly_all_m, is_reach=True),
    Column("farthest", "farthest_m", ".0f", lambda _, flown: flown.sampled.largest_m, is_reach=True),
    Column("Lundborg", "lundborg_m", ".0f", lambda _, flown: flown.lundborg_m, is_reach=True),
    Column("McKenzie", "mckenzie_m", ".0f", lambda _, flown: flown.mckenzie_m, is_reach=True),
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
        return Section(_TITLE, (Paragraph(Text("The charge plan is not known: {}.", plan), True),)) if plan else None
    return Section(_TITLE, tuple(plan_blocks(plan, scenario, loads)))


def planned_section(scenario: Scenario, loads: Sequence[ZoneLoad] = ()) -> Section:
    """Return the charge plan of a scenario with blast zones or cuts, all of whose files are there."""
    plan = charge_plan(scenario, prepared_members(scenario).members)
    section = given(charge_plan_section(scenario, plan, loads))
    return replace(section, blocks=(*section.blocks, limit_table())) if scenario.neighbours else section


def plan_blocks(plan: ChargePlan, scenario: Scenario, loads: Sequence[ZoneLoad] = ()) -> Iterator[Block]:
    """Yield the tables of a charge plan, with what they mean, and what is kept clear around the bridge."""
    yield Paragraph(_BY_WHOM)
    yield from _warnings(plan)
    if plan.zones:
        yield DataTable.of("drill_holes", "Drill holes", _DRILLED, plan.zones)
        yield DataTable.of("charge_table", "Charges and their effect", _LOADED, plan.zones)
    if any(placed.bars for placed in plan.zones):
        yield Paragraph(_BARS)
    carried, placed_of = {load.zone: load for load in loads}, {zone_name(placed): placed for placed in plan.zones}
    of_zones = zone_falls(plan.zones, scenario, carried)
    falls = [_Fall(placed_of[name], carried.get(name), fall) for name, fall in of_zones.items()]
    if falls:
        yield Paragraph(_FALLS_TEXT)
        yield DataTable.of("zone_falls", "What is above the zones", _FALLS, falls)
    if plan.cuts:
        yield Paragraph(_SEVERED)
        yield DataTable.of("severed_members", "Severed members", _CUTS, plan.cuts)
    yield Paragraph(_SEQUENCE)
    yield DataTable.of("firing_sequence", "Firing sequence", _FIRED, plan.rows)
    if pairs := firing_pairs(plan.rows):
        yield Paragraph(_ORDER_TEXT)
        yield DataTable.of("firing_order", "Chance to fire the other way round", _ORDER, pairs)
    yield facts("Totals", _totals(plan), "charge_totals")
    yield from _neighbours(plan.neighbours, scenario.site_law(OF_CHARGES))
    flown = [(placed, of) for placed, of in zip(plan.zones, plan.flyrock, strict=True) if of is not None]
    if flown:
        cordon_m = scenario.exclusion.cordon_m if scenario.exclusion else None
        distances = flyrock.distances if (flyrock := flyrock_of_plan(plan)) else []
        clear = "" if cordon_m is None else Text(" {}: {}.", CORDON, cordon_text(cordon_m, distances))
        yield Paragraph(Text("{}{}", _FLYING, clear))
        yield _fragments(flown)


def _warnings(plan: ChargePlan) -> Iterator[Block]:
    """Yield what a blaster would ask about; the same sentence on several zones only once, with their names."""
    by_text: dict[str, list[str]] = {}
    for placed in plan.zones:
        for text in placed.warnings():
            by_text.setdefault(text, []).append(zone_name(placed))
    for text, names in by_text.items():
        yield Paragraph(Text("Look at {}: {}.", joined("{}, {}", names), text), True)
    failed = [zone_name(placed) for placed in plan.zones if not placed.zone.fires]
    if failed := [*failed, *(given(cut.name) for cut in plan.cuts if not cut.fires)]:
        yield Paragraph(Text("Planned not to fire: {}.", joined("{}, {}", failed)), True)
    rate, (least, most) = plan.totals.grams_per_tonne, POSSIBLE_G_T
    if not least <= rate <= most:
        yield Paragraph(
            Text(
                "{} are outside {} to {}, which recorded jobs are within.",
                Quantity(rate, "g/t", ".1f"),
                Quantity(least, "g/t", "g", shown=False),
                Quantity(most, "g/t", "g"),
            ),
            True,
        )


def _totals(plan: ChargePlan) -> list[tuple[str, str]]:
    totals, (least, most) = plan.totals, RECORDED_G_T
    return [
        (Text("Explosive"), Quantity(totals.mass_kg, "kg", ".3g")),
        *(_of_holes(totals) if totals.holes else ()),
        (
            Text("By mass of the bridge"),
            Text(
                "{}; recorded jobs have {} to {}",
                Quantity(totals.grams_per_tonne, "g/t", ".1f"),
                Quantity(least, "g/t", "g", shown=False),
                Quantity(most, "g/t", "g"),
            ),
        ),
        (Text("Largest mass within 8 ms"), Quantity(totals.together_kg, "kg", ".3g")),
        (Text("From the first row to the last"), Text("{} ms", f"{_MS_PER_S * totals.lasts_s:.0f}")),
    ]


def _of_holes(totals: Totals) -> list[tuple[str, str]]:
    return [
        (Text("Holes, each with a detonator"), f"{totals.holes}"),
        (Text("Drilled"), Quantity(totals.drilled_m, "m", ".1f")),
        (Text("Concrete of all zones"), Quantity(totals.volume_m3, "m³", ".3f")),
        (Text("Specific charge"), Quantity(totals.specific_kg_m3, "kg/m³", ".2f")),
    ]


def _neighbours(at: Sequence[AtNeighbour], law: SiteLaw | None) -> Iterator[Block]:
    if not at:
        yield Paragraph(
            "The scenario has no neighbours: add tables [[neighbours]] for vibration and air pressure there."
        )
        return
    if law is None:
        yield Paragraph(_general_text())
    else:
        yield Paragraph(site_law_text(law, OF_CHARGES))
        yield Paragraph(_air_text())
    for one in at:
        if one.is_above_limit:
            yield Paragraph(Text("{}: a limit is not kept.", one.neighbour.name), True)
        if one.is_extrapolated:
            yield Paragraph(extrapolated_text(one.neighbour.name), True)
    yield DataTable.of("charge_neighbours", "At the neighbours", _AROUND if law is None else _BY_SITE_LAW, at)


def _general_text() -> Text:
    ground = FREE_FACE_AVERAGE
    return Text(
        "Vibration by v = {} mm/s (R/√Q)^-{} ({}), air pressure by P = {} kPa (R/Q^⅓)^-1.45 of stemmed holes, "
        "{} kPa of what is bare (AS 2187.2), Q the mass within 8 ms and R the distance to its nearest part. "
        "The fall of the bridge often shakes the ground more.",
        f"{1e3 * ground.velocity_m_s:g}",
        f"{ground.exponent:g}",
        Text(ground.name),
        f"{STEMMED_KPA:g}",
        f"{BARE_KPA:g}",
    )


def _air_text() -> Text:
    return Text(
        "Air pressure by P = {} kPa (R/Q^⅓)^-1.45 of stemmed holes, {} kPa of what is bare (AS 2187.2).",
        f"{STEMMED_KPA:g}",
        f"{BARE_KPA:g}",
    )


def _fragments(flown: Sequence[tuple[PlacedZone, FlyrockOfZone]]) -> DataTable:
    worst_first = sorted(flown, key=lambda pair: pair[1].sampled.largest_m, reverse=True)
    zones, distances = zip(*worst_first, strict=True)
    return DataTable.of("fragments", "How far fragments fly", _FLOWN, zones, distances)
