# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure what a ball leaves of a reinforced deck, by shards, seed, sub-step and rupture of its bars.

The bridge is examples/two_spans_13m_ball.toml: decks of 3.7 m x 0.6 m over spans of 13 m, with bars by rule. What is
measured is how far the middle of the first span has gone down at the end: the median of the shards within 1.3 m of it.

By rigid-plastic theory a ball of 10 t that falls by 5 m leaves 0.10 m: M_p = A f_y (d - a / 2) = 6.3 MN·m, a hinge at
mid-span resists with 4 M_p / L less half the weight of the deck and that of the ball, 1.49 MN, and a third of the
deck's mass goes along after a plastic impact.

Usage: reinforced_deck.py [MOST_SEEDS] writes docs/data/reinforced_deck.csv, and goes on where it stopped;
reinforced_deck.py --one BALL_KG SHARDS SEED FINER RUPTURE_M BARS prints one row; reinforced_deck.py --table prints
what README.md says of all.
"""

from __future__ import annotations

import csv
import json
import os
import resource
import subprocess
import sys
import tempfile
from itertools import product
from pathlib import Path

import numpy as np

from bridge_demolition_addon import read_scenario, run
from bridge_demolition_addon.model.results.arrays import Results

ROOT = Path(__file__).resolve().parents[2]
TABLE = ROOT / "docs" / "data" / "reinforced_deck.csv"
KEYS = ("ball_kg", "shards", "seed", "finer", "rupture_m", "bars")
"""What a row is of: `finer` times as many sub-steps, bars that rupture at an opening, 0 for the one that follows."""

MEASURES = ("sag_m", "largest_throw_m", "broken", "made_by_connections_kj", "made_by_contacts_kj", "dissipated_kj")
COLUMNS = (*KEYS, *MEASURES, "processor_s")
MIDDLE_M, NEAR_M = 6.5, 1.3
_SUBSTEPS = {0.5: "twice as long", 1.0: "as they are", 2.0: "half as long"}
NO_BARS = '[bridge.reinforcement]\ndesigned_for = "none"'


def cases(most_seeds: int) -> list[tuple[float, ...]]:
    """All rows that the page has, seed by seed: so that what is done says something of all of them."""
    variants = [
        (10000, 100, 1, 0.0, 1),
        (10000, 200, 1, 0.0, 1),
        (10000, 200, 1, 0.02, 1),
        (10000, 200, 1, 0.05, 1),
        (10000, 200, 0.5, 0.0, 1),
        (1500, 200, 1, 0.0, 1),
        (30000, 200, 1, 0.0, 1),
        (10000, 200, 2, 0.0, 1),
        (10000, 400, 1, 0.0, 1),
        (10000, 200, 1, 0.0, 0),
    ]
    return [
        (ball, shards, seed, finer, rupture, bars)
        for seed, (ball, shards, finer, rupture, bars) in product(range(1, 1 + most_seeds), variants)
    ]


def main(arguments: list[str]) -> int:
    """Measure one row, or all that are not there yet."""
    if arguments[:1] == ["--one"]:
        print(json.dumps(measured(*(float(text) for text in arguments[1:]))), flush=True)
        os._exit(0)  # Blender's own end may hang.
    if arguments[:1] == ["--table"]:
        print("\n".join(summary(rows())))
        return 0
    done = rows() if TABLE.exists() else []
    known = {tuple(float(row[key]) for key in KEYS) for row in done}
    for case in cases(int(arguments[0]) if arguments else 12):
        if tuple(map(float, case)) in known:
            continue
        command = [sys.executable, __file__, "--one", *map(str, case)]
        answer = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()[-1]
        done.append(dict(zip(KEYS, case, strict=True)) | json.loads(answer))
        with TABLE.open("w", newline="", encoding="utf-8") as file:
            table = csv.DictWriter(file, COLUMNS)
            table.writeheader()
            table.writerows(done)
    return 0


def rows() -> list[dict[str, str]]:
    """Rows that were measured."""
    with TABLE.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def summary(measured_rows: list[dict[str, str]]) -> list[str]:
    """Lines of a table: median and range over the seeds of each variant."""
    lines = [
        "| ball | shards | sub-steps | bars rupture at | seeds | deflection, median (range) | made by solver | time |",
        "| --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    variants: dict[tuple[str, ...], list[dict[str, str]]] = {}
    for row in measured_rows:
        variants.setdefault(tuple(row[key] for key in KEYS if key != "seed"), []).append(row)
    for (ball, shards, finer, rupture, bars), own in sorted(variants.items(), key=_order):
        sags = [float(row["sag_m"]) for row in own]
        made = [100.0 * made_share(row) for row in own]
        seconds = [float(row["processor_s"]) for row in own]
        opening = f"{1e3 * float(rupture):.0f} mm" if float(rupture) else "by steel and bond"
        lines.append(
            f"| {float(ball) / 1e3:g} t | {shards} | {_SUBSTEPS[float(finer)]} | "
            f"{opening if float(bars) else 'no bars'} | {len(own)} | "
            f"{np.median(sags):.3f} m ({min(sags):.3f} to {max(sags):.3f}) | "
            f"{np.median(made):.1f} % ({min(made):.1f} to {max(made):.1f}) | {np.median(seconds):.0f} s |"
        )
    return lines


def made_share(row: dict[str, str]) -> float:
    """Energy that the solver made over what was dissipated."""
    made_kj = float(row["made_by_connections_kj"]) + float(row["made_by_contacts_kj"])
    return made_kj / float(row["dissipated_kj"])


def _order(variant: tuple[tuple[str, ...], list[dict[str, str]]]) -> tuple[float, ...]:
    ball, shards, finer, rupture, bars = map(float, variant[0])
    return -bars, ball, shards, finer, rupture


def measured(
    ball_kg: float, shards: float, seed: float, finer: float, rupture_m: float, bars: float
) -> dict[str, float]:
    """Return what is measured in a run."""
    rupture = f"ductile_elongation_m = {rupture_m}" if rupture_m and bars else ""
    text = f"""
[scenario]
based_on = "{(ROOT / "examples" / "two_spans_13m_ball.toml").as_posix()}"
title = "Ball on a reinforced deck"
seed = {int(seed)}
[time]
duration_s = 1.8
stop_at_rest = false
substeps_per_frame = {round(10 * finer)}
farthest_per_substep_m = {0.01 / finer}
[fracture]
shards = {int(shards)}
[ball]
mass_kg = {ball_kg}
diameter_m = 1.34
release_time_s = 0.1
[connections]
{rupture}
{"" if bars else NO_BARS}"""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "deck.toml").write_text(text, encoding="utf-8")
        results = run(read_scenario(folder / "deck.toml"), folder / "run")
        return measures(results) | {"processor_s": round(resource.getrusage(resource.RUSAGE_SELF).ru_utime, 1)}


def measures(results: Results) -> dict[str, float]:
    """Return sag, throw, breaks and energies of a run."""
    frames, inventory = results.frames, results.inventory
    first, last = frames.positions_m[0], frames.positions_m[-1]
    near = (inventory.body_members == "span 1 deck") & (abs(first[:, 0] - MIDDLE_M) < NEAR_M)
    are_shards = inventory.body_kinds == "shard"
    throws = np.linalg.norm((last - first)[are_shards, :2], axis=1)
    work = frames.work
    values = (
        float(np.median((first - last)[near, 2])),
        float(throws.max()),
        float(frames.intact[0].sum() - frames.intact[-1].sum()),
        *(
            float(np.nansum(energy)) / 1000.0
            for energy in (work.made_by_connections_j, work.made_by_contacts_j, work.dissipated_j)
        ),
    )
    return dict(zip(MEASURES, (round(value, 4) for value in values), strict=True))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
