"""``bda charge`` of a zone with drill holes: grams a hole from a specific charge and back, and what follows from it."""

import argparse
import math
from collections.abc import Iterator
from dataclasses import dataclass

from ..engineering.blast.vibration import FREE_FACE_AVERAGE, GROUNDS, peak_particle_velocity
from ..engineering.drilled_charges.drill_holes import HolesByRule, hole_capacity_kg, holes_by_rule, zone_height_m
from ..engineering.drilled_charges.neighbours import air_pressure_pa, decibels
from ..engineering.drilled_charges.specific_charge import DrilledElement, charge_a_hole_kg
from ..engineering.geometry.solids import box
from ..errors import BlastError
from ..model.actions import Fact
from ..model.blast.blast_zones import DRILLED_EXPLOSIVES, KG_PER_G, BlastZone, DrilledExplosive
from ..model.bridge.member import Member
from ..model.structure.blast_zones import POSSIBLE_G_T, RECORDED_G_T, PlacedZone, placed_zone
from ..model.structure.zone_fragments import NO_SAFETY_DISTANCE, flyrock_of
from .arguments import quantity

DISTANCES_M = (10.0, 20.0, 50.0, 100.0, 200.0)

DENSITY_KG_M3 = 2400.0
_MEMBER = "member"
_MM_PER_M = 1000.0
_KG_PER_T = 1000.0
_MOST_HOLES = 1000


@dataclass(frozen=True, slots=True)
class _Size:
    """Sizes of a zone, m."""

    thickness: float  # along the holes
    width: float  # across them
    height: float  # along the member


def add_to(parser: argparse.ArgumentParser, task: argparse._MutuallyExclusiveGroup) -> None:
    """Add the task and its options to ``bda charge``."""
    task.add_argument(
        "--zone-m",
        nargs=3,
        type=quantity,
        metavar=("THICKNESS", "WIDTH", "HEIGHT"),
        help="sizes of a zone with drill holes: along the holes, across them, and along the member",
    )
    group = parser.add_argument_group("drill holes", "with --zone-m; by default the rules of blasting manuals say them")
    amount = group.add_mutually_exclusive_group()
    amount.add_argument("--specific-kg-m3", type=quantity, metavar="Q", help="specific charge that is wanted")
    amount.add_argument("--charge-g", type=quantity, metavar="G", help="explosive in each hole")
    group.add_argument("--rows", type=_count, metavar="N", help="rows of holes, each along the member")
    group.add_argument("--holes-a-row", type=_count, metavar="N", help="holes in each row")
    group.add_argument("--spacing-m", type=quantity, metavar="A", help="distance of holes in a row")
    group.add_argument("--depth-m", type=quantity, metavar="D", help="depth of the holes")
    group.add_argument("--stemming-m", type=quantity, metavar="S", help="stemming in each hole")
    group.add_argument("--hole-diameter-mm", type=quantity, default=38.0, metavar="MM", help="of the holes (38)")
    elements = [element.value for element in DrilledElement]
    group.add_argument(
        "--element", choices=elements, default=DrilledElement.BEAM_OR_COLUMN.value, help="what is drilled"
    )
    group.add_argument("--bars", type=_count, metavar="N", help="bars along the member that stay")
    group.add_argument("--bar-diameter-mm", type=quantity, metavar="MM", help="diameter of these bars")
    group.add_argument("--cover-factor", type=quantity, default=1.0, metavar="F", help="on the speed of fragments (1)")
    group.add_argument("--zones", type=_count, default=1, metavar="N", help="number of such zones in the structure (1)")
    group.add_argument("--structure-t", type=quantity, metavar="T", help="mass of the structure, in t")


OPTIONS = (
    "specific_kg_m3",
    "charge_g",
    "rows",
    "holes_a_row",
    "spacing_m",
    "depth_m",
    "stemming_m",
    "bars",
    "bar_diameter_mm",
    "structure_t",
)
"""Options that only a zone takes, and that have no default."""


def zone_lines(arguments: argparse.Namespace, explosive: DrilledExplosive) -> Iterator[str]:
    """Yield lines on a zone with drill holes."""
    size = _Size(*arguments.zone_m)
    rule = holes_by_rule(size.thickness, size.width)
    placed = _placed(arguments, explosive, size, rule)
    for name, value in _facts(arguments, placed, rule):
        yield f"{name:<24}{value}"
    yield ""
    yield from _neighbours(arguments, placed)


def _placed(arguments: argparse.Namespace, explosive: DrilledExplosive, size: _Size, rule: HolesByRule) -> PlacedZone:
    rows, spacing_m = arguments.rows or rule.rows, arguments.spacing_m or sum(rule.spacing_m) / 2.0
    fitting = max(1, math.floor((size.height - (spacing_m / 2.0 if rows > 1 else 0.0)) / spacing_m))
    holes_a_row = arguments.holes_a_row or min(fitting, _MOST_HOLES)
    depth_m, stemming_m = arguments.depth_m or rule.depth_m, arguments.stemming_m or rule.stemming_m
    if stemming_m >= depth_m:
        raise BlastError(f"stemming is {stemming_m:g} m: expected less than the depth of the holes, {depth_m:g} m")
    capacity_kg = hole_capacity_kg(depth_m, stemming_m, arguments.hole_diameter_mm / _MM_PER_M, explosive.density_kg_m3)
    volume_m3 = size.thickness * size.width * size.height
    if arguments.charge_g:
        charge_kg = KG_PER_G * arguments.charge_g
    else:
        charge_kg = float(charge_a_hole_kg(arguments.specific_kg_m3, volume_m3, rows * holes_a_row))
    if charge_kg > capacity_kg:
        raise BlastError(
            f"each hole would have {charge_kg / KG_PER_G:.1f} g: expected at most {capacity_kg / KG_PER_G:.1f} g of "
            f"{explosive.name}, which it holds in {depth_m - stemming_m:.3g} m below its stemming; take more holes, or "
            "larger ones"
        )
    zone = BlastZone(
        name="zone",
        member=_MEMBER,
        middle_m=size.height / 2.0,
        height_m=size.height,
        rows=rows,
        holes_a_row=holes_a_row,
        spacing_m=spacing_m,
        depth_m=depth_m,
        stemming_m=stemming_m,
        hole_diameter_mm=arguments.hole_diameter_mm,
        charge_g=charge_kg / KG_PER_G,
        explosive=explosive.name,
        element=arguments.element,
        cover_factor=arguments.cover_factor,
        bars=arguments.bars or 0,
        bar_diameter_mm=arguments.bar_diameter_mm,
    )
    solid = box((size.thickness, size.width, size.height), (0.0, 0.0, size.height / 2.0))
    return placed_zone(zone, [Member(_MEMBER, "pier", solid, DENSITY_KG_M3)])


def _facts(arguments: argparse.Namespace, placed: PlacedZone, rule: HolesByRule) -> Iterator[Fact]:
    zone, explosive = placed.zone, placed.zone.made_of
    sizes = " × ".join(f"{size:g}" for size in arguments.zone_m)
    yield "zone", f"{sizes} m, {placed.volume_m3:.3f} m³, {zone.element}"
    least_m, most_m = rule.spacing_m
    yield (
        "by rule",
        f"{_rows(rule.rows)}, {least_m:.3g} to {most_m:.3g} m apart, {rule.depth_m:.3g} m deep, "
        f"{rule.stemming_m:.3g} m of stemming at least",
    )
    yield (
        "holes",
        f"{zone.holes} in {_rows(zone.rows)}, {zone.hole_diameter_mm:g} mm, {zone.spacing_m:.3g} m apart, "
        f"{zone.depth_m:.3g} m deep, {zone.stemming_m:.3g} m of stemming, {zone.drilled_m:.1f} m drilled",
    )
    yield "burden", f"{placed.burden_m:.3g} m"
    yield "explosive", f"{explosive.name}, {explosive.density_kg_m3:g} kg/m³, strength {explosive.relative_strength:g}"
    yield "charge", f"{zone.charge_g:.1f} g in each hole, {zone.mass_kg:.3g} kg"
    limits = placed.thresholds
    yield "specific charge", f"{placed.specific_kg_m3:.2f} kg/m³: {placed.effect}"
    yield (
        "  of strength 100",
        f"{placed.effective_kg_m3:.2f} kg/m³; breaks from {limits.break_kg_m3:.2f}, is thrown out from "
        f"{limits.throw_kg_m3:.2f}",
    )
    if zone.bars:
        yield "bars", placed.cage_text
        by_rule = zone_height_m(max(arguments.zone_m[:2]), (zone.bar_diameter_mm or 0.0) / _MM_PER_M)
        yield "  height by rule", f"{by_rule:.2f} m: 1.5 × (larger side + 40 diameters)"
    flyrock = flyrock_of(placed)
    sampled = flyrock.sampled
    yield (
        "fragments",
        f"50, 99 and 99.9 % of the mass over 0.1 kg within {sampled.half_m:.0f}, {sampled.most_m:.0f} and "
        f"{sampled.nearly_all_m:.0f} m, the farthest {sampled.largest_m:.0f} m",
    )
    yield "  without a cover", f"Lundborg {flyrock.lundborg_m:.0f} m, McKenzie {flyrock.mckenzie_m:.0f} m"
    yield "", NO_SAFETY_DISTANCE
    yield from _structure(arguments, placed)
    for warning in placed.warnings():
        yield "look at", warning
    yield "", "charges are fixed by test shots and a licensed blaster"


def _structure(arguments: argparse.Namespace, placed: PlacedZone) -> Iterator[Fact]:
    mass_kg = arguments.zones * placed.zone.mass_kg
    if arguments.zones > 1:
        yield "all zones", f"{mass_kg:.3g} kg in {arguments.zones * placed.zone.holes} holes"
    if not arguments.structure_t:
        return
    rate = _KG_PER_T * mass_kg / arguments.structure_t
    (least, most), (lowest, highest) = RECORDED_G_T, POSSIBLE_G_T
    yield "by mass", f"{rate:.1f} g/t; recorded jobs have {least:g} to {most:g}"
    if not lowest <= rate <= highest:
        yield "look at", f"{rate:.1f} g/t are outside {lowest:g} to {highest:g}, which all recorded jobs are within"


def _neighbours(arguments: argparse.Namespace, placed: PlacedZone) -> Iterator[str]:
    """Yield what the zone, all its holes at once, does at distances."""
    ground = GROUNDS.get(arguments.ground, FREE_FACE_AVERAGE)
    yield f"All {placed.zone.mass_kg:.3g} kg within 8 ms: ground {ground.name}, air AS 2187.2, stemmed"
    yield f"  {'distance':<12}{'peak velocity':>16}{'air':>12}"
    for distance_m in DISTANCES_M:
        velocity = 1e3 * float(peak_particle_velocity(distance_m, placed.zone.mass_kg, ground))
        level = float(decibels(air_pressure_pa(distance_m, placed.zone.mass_kg)))
        yield f"  {f'{distance_m:g} m':<12}{f'{velocity:.3g} mm/s':>16}{f'{level:.0f} dB':>12}"


def _rows(rows: int) -> str:
    return "a row" if rows == 1 else f"{rows} rows"


def _count(text: str) -> int:
    try:
        number = int(text)
    except ValueError:
        number = 0
    if not 1 <= number <= _MOST_HOLES:
        raise argparse.ArgumentTypeError(f"{text!r} is wrong: expected a whole number from 1 to {_MOST_HOLES}")
    return number


def drilled_explosive(name: str) -> DrilledExplosive | None:
    """Return the explosive for drill holes of a name, in capitals or not; None where there is none."""
    named = {known.casefold(): explosive for known, explosive in DRILLED_EXPLOSIVES.items()}
    return named.get(name.strip().casefold())
