# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure how far bridges with elastic connections are off, by their number of shards, for its README.

They rest under their weight as in `bda check`, without a simulation, and are compared with what OpenSees calculates
for the same bridges (`bridges_by_opensees.py`).

Usage: elastic_bridges.py measure [SEEDS] writes docs/data/elastic_bridges.csv, of seeds 1 to 5 by default;
elastic_bridges.py table prints the medians over the seeds for its README.
"""

from __future__ import annotations

import csv
import re
import statistics
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import trimesh

from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.stages.standing import Standing, StandingBridge, made_elastic
from bridge_demolition_addon.model.structure.model import Model, build_model

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "docs" / "data"
MEASURED, REFERENCES = DATA / "elastic_bridges.csv", DATA / "bridges_by_opensees.csv"
SHARDS = (40, 100, 200, 600)
AIMS = {"frequency": 0.03, "moment": 0.05, "deflection": 0.05, "": 0.02}
"""Largest deviation aimed at, of quantities with a word in their name; the last for all others."""

STRONG = """
[[materials]]
name = "strong"
compression_n_mm2 = 1e4
tension_n_mm2 = 1e4
shear_n_mm2 = 1e4
torsion_n_mm2 = 1e4
bending_n_mm2 = 1e4
elastic_modulus_n_mm2 = 30000
poisson_ratio = 0.2
[connections]
type = "FIXED"
method = "face"
material = "strong"
stiffness = "elastic"
limit_per_shard = 1000
"""
PORTAL = """
[scenario]
title = "portal"
seed = {seed}
[time]
duration_s = 0.5
[[geometry]]
name = "portal"
file = "portal.stl"
density_kg_m3 = 2500
[fracture]
shards = {shards}
"""
TWO_SPANS = """
[scenario]
title = "two spans"
seed = {seed}
[time]
duration_s = 0.5
[bridge]
density_kg_m3 = 2500
span_lengths_m = [10.0, 15.0]
[bridge.deck]
width_m = 3.0
thickness_m = 0.7
overhang_m = 0.5
[bridge.piers]
kind = "wall"
column_length_m = {wall}
column_width_m = 3.0
height_m = 1.0
[[supports]]
member = "pier"
[fracture]
shards = {more_shards}
[[fracture.members]]
member = "pier"
shards = 1
"""
TWO_SPANS_BEARINGS = """
[[connections.between]]
members = ["deck", "pier 1"]
type = "GENERIC"
free = ["turn y"]
[[connections.between]]
members = ["deck", "pier"]
type = "GENERIC"
free = ["move x", "turn y"]
"""
ON_BEARINGS = """
[[bearings]]
members = ["deck", "pier 1"]
kind = "pinned"
offset_m = -0.05
[[bearings]]
members = ["deck", "pier 2"]
kind = "rocker"
[[bearings]]
members = ["deck", "pier 3"]
kind = "rocker"
offset_m = 0.05
"""
"""Axes at the ends of the spans: the deck ends 0.1 m before its end supports do."""
SINGLE_SPAN = """
[scenario]
title = "single span"
seed = {seed}
[time]
duration_s = 0.5
[bridge]
density_kg_m3 = 2500
span_lengths_m = [{span}]
skew_deg = {skew}
[bridge.deck]
width_m = 8.0
thickness_m = {thickness}
overhang_m = 0.0
{girders}
[bridge.abutments]
length_m = {abutment}
width_m = 8.0
height_m = 2.0
[[supports]]
member = "abutment"
[fracture]
shards = {more_shards}
[[fracture.members]]
member = "abutment"
shards = 1
"""
GIRDERS = """
[bridge.girders]
number = 4
width_m = 0.4
depth_m = 0.9
spacing_m = 2.0
"""
SINGLE_SPAN_BEARINGS = """
[[connections.between]]
members = ["{on_bearings}", "abutment 1"]
type = "GENERIC"
free = [{turns}]
[[connections.between]]
members = ["{on_bearings}", "abutment 2"]
type = "GENERIC"
free = [{slides}, {turns}]
"""
SINGLE_SPAN_ON_BEARINGS = """
[[bearings]]
members = ["{on_bearings}", "abutment 1"]
kind = "pinned"
[[bearings]]
members = ["{on_bearings}", "abutment 2"]
kind = {slides}
"""
NO_BEARINGS = """
[[connections.between]]
members = ["deck", "abutment"]
none = true
"""


class Resting:
    """A bridge under its weight, and the forces that its supports take."""

    def __init__(self, model: Model, standing: Standing):
        self._model, self._standing = model, standing
        self._fixed = np.append(model.fixed, True)

    def reaction(
        self, chosen: Callable[[str, np.ndarray], bool], about_m: tuple[float, float, float] = (0.0, 0.0, 0.0)
    ) -> np.ndarray:
        """Forces, kN, and moments, kN·m, (6,) on moving shards whose member and face, by its point, are chosen."""
        model, loads, total = self._model, self._standing.loads, np.zeros(6)
        for row, (first, second) in enumerate(model.connections.pairs.tolist()):
            if self._fixed[first] == self._fixed[second]:
                continue
            moving, sign = (first, 1.0) if self._fixed[second] else (second, -1.0)
            held = second if moving == first else first
            names = [model.members[model.member_of_shard[shard]].name for shard in (moving, held) if shard >= 0]
            point = loads.points_m[row]
            if chosen(" on ".join(names), point):
                force, moment = loads.forces_n[row], loads.moments_nm[row]
                total += sign * np.concatenate((force, moment + np.cross(point - about_m, force)))
        return total / 1e3

    @property
    def common(self) -> dict[str, float]:
        """Deflection, mm, and first frequency, Hz."""
        return {"deflection": 1e3 * self._standing.sag_m, "first frequency": self._standing.frequency_hz}


def portal(bridge: Resting) -> dict[str, float]:
    """Means of both feet."""
    feet = [
        bridge.reaction(lambda name, point, x=x: abs(point[0] - x) < 3.0, (x, 0.0, 0.0))  # type: ignore[misc]
        for x in (0.0, 12.0)
    ]
    thrust, moment = (float(np.mean([abs(foot[row]) for foot in feet])) for row in (0, 4))
    return {"thrust": thrust, "moment at a foot": moment} | bridge.common


def example_frame(bridge: Resting) -> dict[str, float]:
    """Means of the four columns."""
    feet = [
        bridge.reaction(
            lambda name, point, x=x, y=y: abs(point[0] - x) < 2.0 and abs(point[1] - y) < 2.0,  # type: ignore[misc]
            (x, y, 0.0),
        )
        for x in (0.0, 13.0)
        for y in (-2.125, 2.125)
    ]
    reaction, thrust, moment = (float(np.mean([abs(foot[row]) for foot in feet])) for row in (2, 0, 4))
    return {"reaction": reaction, "thrust": thrust, "moment at a foot": moment} | bridge.common


def two_spans(bridge: Resting) -> dict[str, float]:
    """Of each support."""
    reactions = [bridge.reaction(lambda name, point, x=x: abs(point[0] - x) < 1.0)[2] for x in (0.0, 10.0, 25.0)]  # type: ignore[misc]
    weight_kn_m = 2500.0 * 3.0 * 0.7 * 9.80665e-3
    hogging = weight_kn_m * 10.5**2 / 2.0 - float(reactions[0]) * 10.0  # statics of the first span
    named = {f"reaction {row}": float(reaction) for row, reaction in enumerate(reactions, 1)}
    return named | {"hogging moment": hogging} | bridge.common


def grillage(bridge: Resting) -> dict[str, float]:
    """Means of the outer and of the inner girders."""
    girders = [
        bridge.reaction(lambda name, point, y=y: abs(point[1] - y) < 0.9)[2]  # type: ignore[misc]
        for y in (-3.0, -1.0, 1.0, 3.0)
    ]
    outer, inner = (girders[0] + girders[3]) / 2.0, (girders[1] + girders[2]) / 2.0
    return {"outer girders": float(outer), "inner girders": float(inner)} | bridge.common


def skewed_slab(bridge: Resting) -> dict[str, float]:
    """Reactions of a quarter of the width at the corners; the deflection is largest at an edge, beside all centres."""
    obtuse, acute = (
        bridge.reaction(lambda name, point, s=s: s * point[1] * (1.0 if "1" in name else -1.0) > 2.0)[2]  # type: ignore[misc]
        for s in (1.0, -1.0)
    )
    frequency = bridge.common["first frequency"]
    return {
        "quarter at an obtuse corner": float(obtuse) / 2.0,
        "quarter at an acute corner": float(acute) / 2.0,
        "first frequency": frequency,
    }


@dataclass(frozen=True, slots=True)
class Bridge:
    """A bridge: its scenario, shards that it has beside those of its number, and what is measured."""

    text: str
    results: Callable[[Resting], dict[str, float]]
    whole_members: int = 0
    values: tuple[tuple[str, object], ...] = ()
    reference: str | None = None
    """Bridge of OpenSees that it is compared with, where that has another name."""

    def scenario(self, shards: int, seed: int) -> str:
        """Text of the scenario."""
        values = {"seed": seed, "shards": shards, "more_shards": shards + self.whole_members} | dict(self.values)
        return self.text.format(**values)


def example_text() -> str:
    """The example, with places for seed and shards."""
    text = (ROOT / "examples" / "report_2019" / "single_span_explosives.toml").read_text(encoding="utf-8")
    text = text.replace("{", "{{").replace("}", "}}")
    text = re.sub(r"(?m)^seed = \d+", "seed = {seed}", text)
    return re.sub(r"(?m)^shards = \d+", "shards = {shards}", text)


SHORT = 0.02
"""Length, m, of abutments under bearings, whose axes are in the middle of what of it is below the deck: a half."""

FOUR_GIRDERS = (
    ("span", 16.0),
    ("skew", 0.0),
    ("thickness", 0.25),
    ("girders", GIRDERS),
    ("on_bearings", "girder"),
    ("slides", '"move x"'),
    ("turns", '"turn y"'),
)
SKEWED_SLAB = (
    ("span", 12.0),
    ("skew", 40.0),
    ("thickness", 0.6),
    ("girders", ""),
    ("on_bearings", "deck"),
    ("slides", '"move x", "move y"'),
    ("turns", '"turn x", "turn y"'),
)

BRIDGES = {
    "portal": Bridge(PORTAL + STRONG, portal),
    "frame of an example": Bridge(example_text(), example_frame),
    "deck over two spans": Bridge(TWO_SPANS + STRONG + TWO_SPANS_BEARINGS, two_spans, 3, (("wall", 0.05),)),
    "deck on bearings": Bridge(TWO_SPANS + STRONG + ON_BEARINGS, two_spans, 3, (("wall", 1.2),), "deck over two spans"),
    "four girders": Bridge(
        SINGLE_SPAN + STRONG + SINGLE_SPAN_BEARINGS + NO_BEARINGS, grillage, 2, (*FOUR_GIRDERS, ("abutment", 0.1))
    ),
    "girders on bearings": Bridge(
        SINGLE_SPAN + STRONG + SINGLE_SPAN_ON_BEARINGS + NO_BEARINGS,
        grillage,
        2,
        (*FOUR_GIRDERS, ("abutment", SHORT), ("slides", '"rocker"')),
        "four girders",
    ),
    "skewed slab": Bridge(
        SINGLE_SPAN + STRONG + SINGLE_SPAN_BEARINGS, skewed_slab, 2, (*SKEWED_SLAB, ("abutment", 0.1))
    ),
    "skewed on bearings": Bridge(
        SINGLE_SPAN + STRONG + SINGLE_SPAN_ON_BEARINGS,
        skewed_slab,
        2,
        (*SKEWED_SLAB, ("abutment", SHORT), ("slides", '"sliding"\nfriction = 0.0')),
        "skewed slab",
    ),
}


def measured(bridge: Bridge, shards: int, seed: int) -> dict[str, float]:
    """What is measured of a bridge in so many shards."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        outline = np.array(
            [(-0.3, 0), (0.3, 0), (0.3, 7.7), (11.7, 7.7), (11.7, 0), (12.3, 0), (12.3, 8.3), (-0.3, 8.3)]
        )
        boxes = [(outline[0], outline[2]), (outline[4], outline[5] + (0, 7.7)), (outline[7] - (0, 0.6), outline[6])]
        solids = []
        for low, high in boxes:
            solid = trimesh.creation.box((*(high - low), 2.0))
            solid.apply_translation((*(low + high) / 2.0, 0.0))
            solid.apply_transform([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])
            solids.append(solid)
        trimesh.boolean.union(solids, engine="manifold").export(folder / "portal.stl")
        path = folder / "bridge.toml"
        path.write_text(bridge.scenario(shards, seed), encoding="utf-8")
        scenario = made_elastic(read_scenario(path))
        model = build_model(scenario)
    every = np.ones(len(model.connections))
    standing = StandingBridge(model, scenario.joints).rest(
        every > 0.0, every, np.zeros((6, len(model.shards))), every_section=False
    )
    return bridge.results(Resting(model, standing))


def measure(seeds: int) -> None:
    """Write what is measured of all bridges."""
    rows = []
    for name, bridge in BRIDGES.items():
        for shards in SHARDS:
            for seed in range(1, seeds + 1):
                found = measured(bridge, shards, seed)
                rows += [(name, shards, seed, quantity, f"{value:.5g}") for quantity, value in found.items()]
            print(name, shards, flush=True)
    with MEASURED.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([("bridge", "shards", "seed", "quantity", "value"), *rows])


def deviations() -> dict[tuple[str, str], dict[int, list[float]]]:
    """Deviations from the references, by bridge and quantity, of all seeds by number of shards."""
    with REFERENCES.open(encoding="utf-8") as file:
        references = {(row["bridge"], row["quantity"]): float(row["value"]) for row in csv.DictReader(file)}
    off: dict[tuple[str, str], dict[int, list[float]]] = {}
    with MEASURED.open(encoding="utf-8") as file:
        for row in csv.DictReader(file):
            bridge, quantity, shards = row["bridge"], row["quantity"], int(row["shards"])
            expected = references[BRIDGES[bridge].reference or bridge, quantity]
            of_seeds = off.setdefault((bridge, quantity), {}).setdefault(shards, [])
            of_seeds.append(float(row["value"]) / expected - 1.0)
    return off


def aim(quantity: str) -> float:
    """Deviation of a quantity that is aimed at."""
    return next(share for word, share in AIMS.items() if word in quantity)


def table() -> None:
    """Print the medians over the seeds, bold where they miss the aim with 100 shards or more."""
    counts = sorted({count for off in deviations().values() for count in off})
    print("| bridge | quantity | " + " | ".join(f"{count} shards" for count in counts) + " |")
    print("| --- " * (2 + len(counts)) + "|")
    for (bridge, quantity), off in deviations().items():
        cells = []
        for count in counts:
            median = statistics.median(off[count])
            text = f"{100.0 * median:+.0f} %"
            is_missed = count >= 100 and abs(median) > aim(quantity)
            cells.append(f"**{text}**" if is_missed else text)
        print(f"| {bridge} | {quantity} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    if sys.argv[1:2] == ["table"]:
        table()
    else:
        measure(int(sys.argv[2]) if len(sys.argv) > 2 else 5)
        table()
