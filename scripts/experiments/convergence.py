# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure what a demolition says by how finely it is cut, by sub-steps and by iterations of the solver.

The demolition is convergence_span.toml beside this script. Each setting is run with several seeds, which cut the bridge
otherwise: what differs between settings by less than between seeds is no trend.

Usage: convergence.py [RUNS_AT_ONCE] writes docs/data/convergence.csv, and goes on where it stopped, an hour of one
core; convergence.py --one SHARDS FARTHEST_M ITERATIONS SEED prints one row; convergence.py --table prints what
README.md says of all.
"""

from __future__ import annotations

import csv
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bridge_demolition_addon import read_scenario, run
from bridge_demolition_addon.model.results.arrays import Results
from bridge_demolition_addon.model.run_folder.summary import RunSummary, read_summary
from bridge_demolition_addon.model.scenario import Scenario
from bridge_demolition_addon.model.study.outcome import evaluate

ROOT = Path(__file__).resolve().parents[2]
SCENARIO, TABLE = Path(__file__).with_name("convergence_span.toml"), ROOT / "docs" / "data" / "convergence.csv"
KEYS = ("shards", "farthest_m", "iterations", "seed")
MEASURES = ("reach_m", "fallen_share", "collapse_s", "reaction_over_weight", "made_share")
COLUMNS = (*KEYS, *MEASURES, "processor_s")

GRAVITY_M_S2 = 9.81
HALF = 0.5
LOW_M = 2.0
"""A shard of the deck that is so much lower has fallen."""

SEEDS = {
    (50, 0.02, 20): 6,
    (100, 0.02, 20): 5,
    (200, 0.02, 20): 5,
    (400, 0.02, 20): 4,
    (800, 0.02, 20): 1,
    (1600, 0.02, 20): 1,
    (100, 0.04, 20): 5,
    (100, 0.01, 20): 5,
    (100, 0.005, 20): 5,
    (400, 0.005, 20): 2,
    (100, 0.02, 10): 5,
    (100, 0.02, 50): 5,
    (100, 0.02, 100): 5,
}
"""How many seeds of each: shards, farthest way of a body in a sub-step (m), iterations of the solver."""

OWN = (100, 0.02, 20)
"""As the span is set."""

FINER_SHARDS = 400
"""Shards with which short sub-steps were tried as well."""


@dataclass(frozen=True)
class Quantity:
    """What the page says of a measure: its name in the rows, its words, and how it is written."""

    key: str
    words: str
    factor: float = 1.0
    digits: int = 1
    unit: str = ""


QUANTITIES = (
    Quantity("reach_m", "debris distance", digits=1, unit=" m"),
    Quantity("fallen_share", "deck that fell", factor=100.0, digits=0, unit=" %"),
    Quantity("collapse_s", "half of it down after", digits=2, unit=" s"),
    Quantity("reaction_over_weight", "largest reaction over weight", digits=1),
    Quantity("made_share", "made by solver", factor=100.0, digits=1, unit=" %"),
)


def main(arguments: list[str]) -> int:
    """Measure one row, all that are not there yet, or print the tables; the exit status."""
    if arguments[:1] == ["--one"]:
        shards, farthest_m, iterations, seed = arguments[1:]
        print(json.dumps(measured(int(shards), float(farthest_m), int(iterations), int(seed))), flush=True)
        os._exit(0)  # Blender's own end may hang.
    if arguments[:1] == ["--table"]:
        print("\n".join(tables()))
        return 0
    measure_missing(int(arguments[0]) if arguments else 1)
    return 0


def cases() -> Iterator[tuple[float, ...]]:
    """All runs, seed by seed: so that what is done says something of every setting."""
    for seed in range(1, 1 + max(SEEDS.values())):
        yield from ((*setting, seed) for setting, seeds in SEEDS.items() if seed <= seeds)


def measure_missing(at_once: int) -> None:
    """Run what the table has not, each in a process of its own, and write it after each."""
    done = rows() if TABLE.exists() else []
    known = {case_of(row) for row in done}

    def measured_alone(case: tuple[float, ...]) -> dict[str, float]:
        command = [sys.executable, __file__, "--one", *map(str, case)]
        environment = os.environ | {"OPENBLAS_NUM_THREADS": "1"}
        answer = subprocess.run(command, capture_output=True, text=True, check=True, env=environment).stdout
        return dict(zip(KEYS, case, strict=True)) | json.loads(answer.splitlines()[-1])

    with ThreadPoolExecutor(at_once) as threads:
        for row in threads.map(measured_alone, [case for case in cases() if case not in known]):
            done.append({key: f"{value:.5g}" for key, value in row.items()})
            write(done)


def write(found: Sequence[dict[str, str]]) -> None:
    """Write the table, in the order of settings and seeds."""
    with TABLE.open("w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, COLUMNS)
        table.writeheader()
        table.writerows(sorted(found, key=case_of))


def rows() -> list[dict[str, str]]:
    """Rows that were measured."""
    with TABLE.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def case_of(row: dict[str, str]) -> tuple[float, ...]:
    """What a row is of."""
    return tuple(float(row[key]) for key in KEYS)


def measured(shards: int, farthest_m: float, iterations: int, seed: int) -> dict[str, float]:
    """Run once, and return what is measured."""
    text = f"""
[scenario]
based_on = "{SCENARIO.as_posix()}"
title = "One span of 13 m, drilled charges"
seed = {seed}
[time]
farthest_per_substep_m = {farthest_m}
solver_iterations = {iterations}
[fracture]
shards = {shards}
"""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "scenario.toml")
        path.write_text(text, encoding="utf-8")
        scenario = read_scenario(path)
        results = run(scenario, Path(folder, "run"))
        return measures(scenario, read_summary(Path(folder, "run")), results)


def measures(scenario: Scenario, summary: RunSummary, results: Results) -> dict[str, float]:
    """What is measured in a run."""
    outputs = evaluate(results, summary, scenario).outputs
    fallen = fallen_shares(results)
    return {
        "reach_m": outputs["reach_m"],
        "fallen_share": float(fallen[-1]),
        "collapse_s": time_of(results, fallen > HALF * fallen[-1]),
        "reaction_over_weight": largest_reaction(results),
        "made_share": outputs["made_by_solver_share"],
        "processor_s": resource.getrusage(resource.RUSAGE_SELF).ru_utime,
    }


def fallen_shares(results: Results) -> np.ndarray:
    """Part of the deck's mass that is lower by `LOW_M` or more, at each recorded step (k,)."""
    deck = np.flatnonzero(results.inventory.body_member_kinds == "deck")
    masses = results.inventory.masses_kg[deck]
    lower_m = results.frames.positions_m[0, deck, 2] - results.frames.positions_m[:, deck, 2]
    return (lower_m >= LOW_M) @ masses / masses.sum()


def time_of(results: Results, begun: np.ndarray) -> float:
    """The first recorded time (s) at which something has begun."""
    return float(results.frames.time_s[begun.argmax()]) if begun.any() else float("nan")


def largest_reaction(results: Results) -> float:
    """The largest mean force of the ground over a frame, in multiples of the weight: by the change of momentum."""
    masses = results.inventory.masses_kg
    momenta = results.frames.velocities_m_s[:, :, 2] @ masses
    pushed = results.frames.blast_impulses_ns[1:, :, 2].sum(axis=1)
    forces = (np.diff(momenta) - pushed) / np.diff(results.frames.time_s)
    return float(forces.max() / (masses.sum() * GRAVITY_M_S2) + 1.0)


def tables() -> list[str]:
    """What the page says: a table by shards, two by sub-steps, one by iterations."""
    found = rows()
    of_shards = [setting for setting in SEEDS if setting[1:] == OWN[1:]]
    of_substeps = [setting for setting in SEEDS if setting[0] == OWN[0] and setting[2] == OWN[2]]
    of_finer = [setting for setting in SEEDS if setting[0] == FINER_SHARDS]
    of_iterations = [setting for setting in SEEDS if setting[:2] == OWN[:2]]
    return [
        *table("shards", [(f"{setting[0]}", setting) for setting in of_shards], found),
        "",
        *table("farthest way in a sub-step", [(f"{1e3 * s[1]:g} mm", s) for s in sorted(of_substeps)], found),
        "",
        *table(f"the same, {FINER_SHARDS} shards", [(f"{1e3 * s[1]:g} mm", s) for s in sorted(of_finer)], found),
        "",
        *table("iterations", [(f"{setting[2]}", setting) for setting in sorted(of_iterations)], found),
    ]


def table(name: str, settings: Sequence[tuple[str, tuple]], found: Sequence[dict[str, str]]) -> list[str]:
    """Lines of a table: median and range of each quantity over the seeds of each setting."""
    lines = [
        f"| {name} | seeds | {' | '.join(quantity.words for quantity in QUANTITIES)} | time |",
        "| --- " * (len(QUANTITIES) + 3) + "|",
    ]
    for words, setting in settings:
        own = [row for row in found if case_of(row)[:3] == setting]
        cells = [said(quantity, [float(row[quantity.key]) for row in own]) for quantity in QUANTITIES]
        seconds = statistics.median(float(row["processor_s"]) for row in own)
        lines.append(f"| {words} | {len(own)} | {' | '.join(cells)} | {seconds:.0f} s |")
    return lines


def said(quantity: Quantity, values: Sequence[float]) -> str:
    """Median and range of a quantity, or its one value."""
    figures = (min(values), statistics.median(values), max(values))
    low, middle, high = (f"{quantity.factor * value:.{quantity.digits}f}" for value in figures)
    return f"{middle}{quantity.unit}" + (f" ({low} to {high})" if len(values) > 1 else "")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
