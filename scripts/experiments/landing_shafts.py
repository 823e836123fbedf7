# SPDX-License-Identifier: GPL-3.0-or-later
"""Map where a blasted column lands and stands, or comes down, in runs and by energy.

A column of 1 x 1 m, with four bars of 25 mm at each of two sides, carries a block of 1.75 MN that nothing else holds:
5 % of what crushes it. Its height, that of its zones, their number and how it is cut vary. One zone begins 0.5 m above
the ground, a second one is in the middle of what is above it.

Usage: landing_shafts.py writes docs/data/landing_shafts.csv, half an hour of one core; landing_shafts.py --table prints
what engineering/drilled_charges/README.md says of it.
"""

from __future__ import annotations

import csv
import math
import sys
import tempfile
from collections.abc import Iterator
from itertools import product
from pathlib import Path

from bridge_demolition_addon.engineering.drilled_charges.landing import LandingShaft
from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2 as G
from bridge_demolition_addon.model.bridge.member import Member
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.structure.model import build_model

FILE = Path(__file__).resolve().parents[2] / "docs" / "data" / "landing_shafts.csv"
HEIGHTS_M, ZONES_M, NUMBERS = (4.0, 6.0, 8.0, 11.0, 16.0), (1.0, 2.0, 3.0), (1, 2)
CUTS = {"across": "[100.0, 100.0, 1.0]", "irregular": "[1.0, 1.0, 1.0]"}
SIDE_M, STUB_M, LOAD_N, DENSITY_KG_M3, BLOCK_M = 1.0, 0.5, 1.75e6, 2400.0, 2.0
STRENGTH_PA = 35e6
STANDS_WITHIN_M = 0.5
COLUMNS = ("cut", "height_m", "zones", "zone_m", "shaft_m", "tips_from_m", "crushed_m", "fallen_m", "aside_m", "stands")

_SCENARIO = """\
[scenario]
title = "A column that lands"
seed = {seed}

[time]
duration_s = 4.0
substeps_per_frame = 10
farthest_per_substep_m = 0.05

[bridge]
mass_kg = 100000
span_lengths_m = [10.0]
deck = {{ width_m = 4.0, thickness_m = 0.5 }}
piers = {{ columns = 1, column_length_m = 0.7, column_width_m = 0.7, height_m = 4.0 }}

[fracture]
shards = {shards}

[[fracture.members]]
member = "column"
stretch = {stretch}

[[fracture.members]]
member = "block"
shards = 1

[connections]
type = "FIXED"
method = "face"
material = "reinforced concrete column"
stiffness = "elastic"

[shards]
use_deactivation = false
start_deactivated = false

[blast]
start_s = 0.3
"""
_ZONE = """
[[blast_zones]]
name = "zone {number}"
member = "column"
side = "{side}"
middle_m = {middle_m}
height_m = {zone_m}
rows = 2
holes_a_row = {holes}
spacing_m = 0.3
depth_m = 0.65
stemming_m = 0.3
charge_g = {charge_g}
explosive = "emulsion"
delay_ms = {delay_ms}
"""
_BARS = """
[[reinforcement]]
members = ["column"]
side = "{side}"
along = "z"
depth_m = 0.06
area_mm2 = 1963.0
diameter_mm = 25.0
"""


def main(arguments: list[str]) -> int:
    """Run the columns, or print the table; the exit status."""
    if arguments == ["--table"]:
        print("\n".join(table()))
        return 0
    with FILE.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for cut, number, height_m, zone_m in product(CUTS, NUMBERS, HEIGHTS_M, ZONES_M):
            if shaft_m(height_m, zone_m, number) >= SIDE_M:
                writer.writerow(_row(cut, number, height_m, zone_m))
                file.flush()
    return 0


def shaft_m(height_m: float, zone_m: float, number: int) -> float:
    """Length of what is above the lowest zone, up to the next one."""
    above_m = height_m - STUB_M - zone_m
    return above_m if number == 1 else (above_m - zone_m) / 2.0


def shaft(height_m: float, zone_m: float, number: int) -> LandingShaft:
    """What lands."""
    length_m, area_m2 = shaft_m(height_m, zone_m, number), SIDE_M * SIDE_M
    own_n = length_m * area_m2 * DENSITY_KG_M3 * G
    rest_n = 0.0 if number == 1 else own_n
    return LandingShaft(length_m, SIDE_M, SIDE_M, LOAD_N + rest_n + own_n, own_n, STRENGTH_PA)


def _row(cut: str, number: int, height_m: float, zone_m: float) -> list[str]:
    landing, (fallen_m, aside_m) = shaft(height_m, zone_m, number), _run(cut, number, height_m, zone_m)
    all_m = number * zone_m
    stands = fallen_m < all_m + STANDS_WITHIN_M
    numbers = landing.length_m, landing.tips_from_m, landing.crushed_m(all_m)[1], fallen_m, aside_m
    return [cut, f"{height_m:g}", str(number), f"{zone_m:g}", *(f"{value:.2f}" for value in numbers), str(int(stands))]


def _run(cut: str, number: int, height_m: float, zone_m: float) -> tuple[float, float]:
    """How far the block fell and went aside in a run."""
    from bridge_demolition_addon.simulation.motion_run import motion_run

    side_m = math.sqrt(LOAD_N / G / DENSITY_KG_M3 / BLOCK_M)
    members = [
        Member("column", "pier", box([SIDE_M, SIDE_M, height_m], [0.0, 0.0, height_m / 2.0]), DENSITY_KG_M3),
        Member("block", "deck", box([side_m, side_m, BLOCK_M], [0, 0, height_m + BLOCK_M / 2.0]), DENSITY_KG_M3),
    ]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "column.toml")
        shards = 1 + round(height_m * (1.0 if cut == "across" else 3.0))
        text = _SCENARIO.format(seed=4, shards=shards, stretch=CUTS[cut])
        text += "".join(_BARS.format(side=side) for side in ("start", "end")) + "".join(
            _zones(number, height_m, zone_m)
        )
        file.write_text(text, encoding="utf-8")
        scenario = read_scenario(file)
        with motion_run(scenario, build_model(scenario, members), Path(folder)) as (results, _):
            (block,) = (results.inventory.body_members == "block").nonzero()[0]
            way_m = results.frames.positions_m[-1, block] - results.frames.positions_m[0, block]
    return -float(way_m[2]), math.hypot(*way_m[:2].tolist())


def _zones(number: int, height_m: float, zone_m: float) -> Iterator[str]:
    holes = max(2, round(zone_m / 0.3) - 1)
    for index, side in enumerate(("start", "end")[:number]):
        begin_m = STUB_M + index * (zone_m + shaft_m(height_m, zone_m, number))
        yield _ZONE.format(
            number=index + 1,
            side=side,
            middle_m=begin_m + zone_m / 2.0,
            zone_m=zone_m,
            holes=holes,
            charge_g=1.1e3 * zone_m / (2 * holes),
            delay_ms=100.0 * index,
        )


def table() -> list[str]:
    """What the page says, a line for each column."""
    with FILE.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    cases = list(dict.fromkeys((row["zones"], row["height_m"], row["zone_m"]) for row in rows))
    by_case = {(row["cut"], row["zones"], row["height_m"], row["zone_m"]): row for row in rows}
    lines = [
        "| zones | column | each zone | shaft | tips on an edge from | crushed at most | by energy | run, cut across "
        "| run, irregular shards |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for case in cases:
        row = by_case["across", *case]
        outcomes = (_outcome(by_case.get((cut, *case))) for cut in CUTS)
        lines.append(
            f"| {case[0]} | {case[1]} m | {case[2]} m | {row['shaft_m']} m | {row['tips_from_m']} m "
            f"| {row['crushed_m']} m | {by_energy(*case)} | {' | '.join(outcomes)} |"
        )
    return lines


def by_energy(zones: str, height_m: str, zone_m: str) -> str:
    """What the upper piece, which falls by all zones, does where it lands on an edge and nothing holds its head."""
    number, length_m = int(zones), shaft_m(float(height_m), float(zone_m), int(zones))
    own_n = length_m * SIDE_M * SIDE_M * DENSITY_KG_M3 * G
    upper = LandingShaft(length_m, SIDE_M, SIDE_M, LOAD_N + own_n, own_n, STRENGTH_PA)
    return "can tip" if number * float(zone_m) >= upper.tips_from_m else "can stand"


def _outcome(row: dict[str, str] | None) -> str:
    if row is None:
        return "-"
    return f"{'stands' if int(row['stands']) else 'down'}, {row['fallen_m']} m"


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
