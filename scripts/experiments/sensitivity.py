# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure which inputs of a demolition carry the spread of its outcome, by the elementary effects of Morris (1991).

Two demolitions: one span by drilled charges, convergence_span.toml beside this script, and a reinforced deck under a
ball, examples/two_spans_13m_ball.toml, both in few shards. Each input goes over the range within which a user may know
it before a look at the site. How the bridge is cut into shards is an input as well: one with less effect than it is
lost in chance. Samples and effects are SALib's (Iwanaga, Usher, Herman 2022), of the extra [sensitivity].

Usage: sensitivity.py DEMOLITION [RUNS_AT_ONCE] writes docs/data/sensitivity/DEMOLITION.csv, and goes on where it
stopped; sensitivity.py DEMOLITION --one RUN prints one row; sensitivity.py DEMOLITION --table prints what
README.md says of it. DEMOLITION is drilled or ball.
"""

from __future__ import annotations

import csv
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from convergence import LOW_M, Quantity, fallen_shares, largest_reaction, time_of
from SALib.analyze import morris as effects
from SALib.sample import morris as design

from bridge_demolition_addon import read_scenario, run
from bridge_demolition_addon.model.results.arrays import Results
from bridge_demolition_addon.model.run_folder.summary import RunSummary, read_summary
from bridge_demolition_addon.model.scenario import Scenario
from bridge_demolition_addon.model.study.keys import changed, keys_named
from bridge_demolition_addon.model.study.outcome import evaluate

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
TRAJECTORIES, LEVELS, SEED = 6, 4, 36
"""Walks through the space of inputs, each of which changes every input once; levels of each input; of their draw."""

STEP = LEVELS / (2.0 * (LEVELS - 1.0))
"""Part of its range by which an input changes in a walk."""

CUT = "how it is cut into shards"


@dataclass(frozen=True)
class Input:
    """An input: its key, its words, the least and the largest that it may be, and whether that is times its own."""

    key: str
    words: str
    least: float
    largest: float
    is_factor: bool = False

    def value(self, drawn: float, own: float) -> float:
        """Return the value of the key for a drawn number."""
        return drawn * own if self.is_factor else drawn


@dataclass(frozen=True)
class Demolition:
    """A demolition: its scenario, its shards, its inputs and what is measured of a run."""

    scenario: Path
    shards: int
    inputs: tuple[Input, ...]
    outputs: tuple[Quantity, ...]
    measures: Callable[[Scenario, RunSummary, Results], dict[str, float]]

    @property
    def problem(self) -> dict[str, object]:
        """Return the inputs as SALib has them; the last is the cut, one of as many as there are levels."""
        ranges = [[known.least, known.largest] for known in self.inputs] + [[1.0, float(LEVELS)]]
        names = [known.words for known in self.inputs] + [CUT]
        return {"num_vars": len(names), "names": names, "bounds": ranges}

    @property
    def keys(self) -> list[str]:
        """Return the names of the inputs in the rows."""
        return [f"in.{known.key}" for known in self.inputs] + ["in.scenario.seed"]

    def samples(self) -> np.ndarray:
        """Return the inputs (r, i) of all runs; another version of SALib draws others."""
        return design.sample(self.problem, TRAJECTORIES, num_levels=LEVELS, seed=SEED)


def of_collapse(scenario: Scenario, summary: RunSummary, results: Results) -> dict[str, float]:
    """What is measured of a span that comes down."""
    outputs = evaluate(results, summary, scenario).outputs
    fallen = fallen_shares(results)
    return {
        "reach_m": outputs["reach_m"],
        "fallen_share": float(fallen[-1]),
        "collapse_s": time_of(results, fallen > 0.5 * fallen[-1]),
        "reaction_over_weight": largest_reaction(results),
    }


def of_dent(_scenario: Scenario, _summary: RunSummary, results: Results) -> dict[str, float]:
    """What is measured of a deck under a ball: as in reinforced_deck.py, how far its middle has gone down."""
    frames, inventory = results.frames, results.inventory
    near = (inventory.body_members == "span 1 deck") & (abs(frames.positions_m[0, :, 0] - 6.5) < 1.3)
    lower_m = frames.positions_m[0, near, 2] - frames.positions_m[-1, near, 2]
    return {
        "sag_m": float(np.median(lower_m)),
        "down": float(np.median(lower_m) >= LOW_M),
        "largest_throw_m": float(np.linalg.norm((frames.positions_m[-1] - frames.positions_m[0])[near], axis=1).max()),
        "broken": float(frames.intact[0].sum() - frames.intact[-1].sum()),
    }


STRENGTH = Input("connections.strength_factor", "strength of the concrete, × 0.7 to 1.4", 0.7, 1.4)
MASS = Input("bridge.mass_kg", "mass of the bridge, ± 8 %", 0.92, 1.08, is_factor=True)
RUPTURE = Input("connections.ductile_elongation_m", "opening at which bars rupture, 20 to 60 mm", 0.02, 0.06)
TRAFFIC = Input("bridge.reinforcement.traffic_kn_m2", "bars: designed for 3 to 12 kN/m² of traffic", 3.0, 12.0)

DEMOLITIONS = {
    "drilled": Demolition(
        HERE / "convergence_span.toml",
        50,
        (
            STRENGTH,
            MASS,
            TRAFFIC,
            RUPTURE,
            Input("blast_zones.throw_kg_m3", "specific charge that throws, 0.6 to 0.95 kg/m³", 0.6, 0.95),
            Input('blast_zones."P1.1".delay_ms', "delay of the second pier, 150 to 450 ms", 150.0, 450.0),
            Input("contacts.ground.friction", "friction on the ground, 0.35 to 0.7", 0.35, 0.7),
            Input("contacts.shards.friction", "friction of debris, 0.5 to 0.7", 0.5, 0.7),
        ),
        (
            Quantity("reach_m", "debris distance, m"),
            Quantity("collapse_s", "half of it down after, s", digits=2),
            Quantity("reaction_over_weight", "largest reaction over weight"),
        ),
        of_collapse,
    ),
    "ball": Demolition(
        ROOT / "examples" / "two_spans_13m_ball.toml",
        100,
        (
            STRENGTH,
            MASS,
            TRAFFIC,
            RUPTURE,
            Input("ball.mass_kg", "mass of the ball, ± 5 %", 0.95, 1.05, is_factor=True),
            Input("ball.drop_height_m", "height that it falls, ± 10 %", 0.9, 1.1, is_factor=True),
            Input("ball.target_m.1", "where it hits along the span, ± 0.5 m", 6.0, 7.0),
        ),
        (
            Quantity("down", "steps that decide whether it comes down", factor=STEP, digits=2),
            Quantity("broken", "cracked connections", digits=0),
        ),
        of_dent,
    ),
}

LIKE = {'blast_zones."P1.1".delay_ms': ('blast_zones."P1.2".delay_ms',)}
"""Keys that have the value of another."""


def main(arguments: list[str]) -> int:
    """Measure one row, all that are not there yet, or print the table; the exit status."""
    name, *rest = arguments
    if rest[:1] == ["--one"]:
        print(json.dumps(measured(DEMOLITIONS[name], int(rest[1]))), flush=True)
        os._exit(0)  # Blender's own end may hang.
    if rest[:1] == ["--table"]:
        print("\n".join(table(name)))
        return 0
    measure_missing(name, int(rest[0]) if rest else 1)
    return 0


def path_of(name: str) -> Path:
    """Where the runs of a demolition are kept."""
    return ROOT / "docs" / "data" / "sensitivity" / f"{name}.csv"


def measure_missing(name: str, at_once: int) -> None:
    """Run what the table has not, each in a process of its own, and write it after each."""
    demolition = DEMOLITIONS[name]
    samples = demolition.samples()
    done = rows(name) if path_of(name).exists() else []

    def alone(number: int) -> dict[str, str]:
        command = [sys.executable, __file__, name, "--one", str(number)]
        environment = os.environ | {"OPENBLAS_NUM_THREADS": "1"}
        answer = subprocess.run(command, capture_output=True, text=True, check=True, env=environment).stdout
        found = json.loads(answer.splitlines()[-1])
        drawn = dict(zip(demolition.keys, samples[number].tolist(), strict=True))
        return {key: f"{value:.10g}" for key, value in ({"run": number} | drawn | found).items()}

    with ThreadPoolExecutor(at_once) as threads:
        for row in threads.map(alone, range(len(done), len(samples))):
            done.append(row)
            write(name, done)


def write(name: str, done: Sequence[Mapping[str, str]]) -> None:
    """Write the runs that are done."""
    path_of(name).parent.mkdir(exist_ok=True)
    with path_of(name).open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(done[0]))
        writer.writeheader()
        writer.writerows(done)


def rows(name: str) -> list[dict[str, str]]:
    """Runs that are done."""
    with path_of(name).open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def measured(demolition: Demolition, number: int) -> dict[str, float]:
    """Run once with the inputs of a number, and return what is measured."""
    scenario = scenario_with(demolition, demolition.samples()[number])
    with tempfile.TemporaryDirectory() as folder:
        results = run(scenario, Path(folder, "run"))
        return demolition.measures(scenario, read_summary(Path(folder, "run")), results)


def scenario_with(demolition: Demolition, drawn: Sequence[float]) -> Scenario:
    """Return the scenario with drawn inputs (i,), the last of which is the cut."""
    scenario = read_scenario(demolition.scenario)
    bridge = replace(
        scenario.bridge, reinforcement=replace(scenario.bridge.reinforcement, designed_for=None, traffic_kn_m2=6.0)
    )
    scenario = replace(
        scenario,
        bridge=bridge,
        fracture=replace(scenario.fracture, shards=demolition.shards),
        connections=replace(scenario.connections, strength_factor=1.0, ductile_elongation_m=0.04),
        seed=round(drawn[-1]),
    )
    values = {}
    for known, number in zip(demolition.inputs, drawn[:-1], strict=True):
        for name in (known.key, *LIKE.get(known.key, ())):
            for key in keys_named(scenario, name):
                values[key] = known.value(float(number), own_value(scenario, key.steps))
    return changed(scenario, values)


def own_value(scenario: Scenario, steps: Sequence[str | int]) -> float:
    """Return what the scenario has at the steps of a key."""
    value: object = scenario
    for step in steps:
        value = getattr(value, step) if isinstance(step, str) else value[step]
    return float(value or 0.0)


def drawn_of(name: str) -> np.ndarray:
    """Return the inputs (r, i) of the runs that are done."""
    return np.array([[float(row[key]) for key in DEMOLITIONS[name].keys] for row in rows(name)])


def effects_of(name: str, output: str) -> dict[str, np.ndarray]:
    """Return SALib's effects of all inputs on an output: `mu_star`, its confidence `mu_star_conf`, and `sigma`."""
    demolition = DEMOLITIONS[name]
    values = np.array([float(row[output]) for row in rows(name)])
    whole = len(values) - len(values) % (len(demolition.inputs) + 2)
    return effects.analyze(
        demolition.problem,
        drawn_of(name)[:whole],
        values[:whole],
        num_levels=LEVELS,
        num_resamples=1000,
        seed=SEED,
    )


def table(name: str) -> list[str]:
    """Lines of a table: the mean size of the effect of each input on each output, with its confidence of 95 %."""
    demolition = DEMOLITIONS[name]
    heads = [output.words for output in demolition.outputs]
    lines = [f"| input | {' | '.join(heads)} |", "| --- " * (len(heads) + 1) + "|"]
    found = [effects_of(name, output.key) for output in demolition.outputs]
    for number, words in enumerate(demolition.problem["names"]):
        cells = [
            f"{output.factor * one['mu_star'][number]:.{output.digits}f} "
            f"± {output.factor * one['mu_star_conf'][number]:.{output.digits}f}"
            for output, one in zip(demolition.outputs, found, strict=True)
        ]
        lines.append(f"| {words} | {' | '.join(cells)} |")
    return lines


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
