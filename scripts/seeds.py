# SPDX-License-Identifier: GPL-3.0-or-later
"""Run examples with many seeds of their fracture, and print the range and the median of what is measured.

A demolition is chaotic: another draw of shards breaks and throws differently. What is claimed of an example has to hold
for any draw, and its limits come from here. What is measured stands in `tests/support/example_measures.py`.
"""

import argparse
import csv
import json
import os
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
sys.path.insert(1, str(Path(__file__).resolve().parent.parent / "tests"))

from support.checkout import SEEDED
from support.example_claims import CLAIMS, beyond_claims
from support.example_runs import BEGINNINGS, MEASURED_S, VERSIONS, example

DIGESTS = ("motion", "beginning")
"""Of all of a run, and of as much of it as tests run."""


def main() -> int:
    """Run what is asked for and print a table for each example; the exit status."""
    options = arguments()
    if options.begin:
        print_beginning(options.names[0])
    if options.measure is not None:
        print_measured(options.names[0], options.measure, options.duration, options.shards)
    if options.beginnings:
        with ThreadPoolExecutor(options.at_once) as threads:
            found = dict(zip(options.names, threads.map(beginning_alone, options.names), strict=True))
        for name, beginning in found.items():
            note_version(VERSIONS, name, beginning)
        return 0
    if options.own:
        return any([is_another(name) for name in options.names])  # all of them, also after one that is
    seeds = range(options.first, options.first + options.seeds)
    for name in options.names:
        duration_s = options.duration or MEASURED_S.get(name)
        rows = list(measured(name, seeds, duration_s, options.at_once, options.shards))
        print(table(name, rows), flush=True)
        if options.csv:
            keep(options.csv / f"{name}.csv", rows)
            own = run_alone(name, example(name).seed, duration_s, options.shards)
            # Claims are of the example as it is.
            if not options.shards and name in CLAIMS and (beyond := beyond_claims(name, own)):
                sys.exit(f"seeds: {name} with its own seed: {'; '.join(beyond)}")
            note_version(options.csv / VERSIONS.name, name, {part: own[part] for part in DIGESTS if own[part]})
    return 0


def arguments() -> argparse.Namespace:
    """What the command line says."""
    examples = list(SEEDED)
    parser = argparse.ArgumentParser(prog="seeds", description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="+", choices=examples, metavar="NAME", help="examples: " + ", ".join(examples))
    parser.add_argument("--seeds", type=int, default=24, metavar="COUNT", help="how many seeds (24)")
    parser.add_argument("--first", type=int, default=1, metavar="SEED", help="the first of them (1)")
    parser.add_argument("--duration", type=float, metavar="S", help="simulate so many seconds (as its test does)")
    parser.add_argument("--shards", type=int, metavar="N", help="cut the bridge into so many (the example's own)")
    parser.add_argument("--at-once", type=int, default=2, metavar="N", help="runs side by side, each on a core (2)")
    parser.add_argument("--csv", type=Path, metavar="DIR", help="also keep a row for each run in DIR/NAME.csv")
    parser.add_argument("--own", action="store_true", help="run each once, as it is, and compare it with what was kept")
    parser.add_argument(
        "--beginnings", action="store_true", help="keep anew how each begins; its ranges stay of an earlier version"
    )
    parser.add_argument("--begin", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--measure", type=int, metavar="SEED", help="run this seed alone and print JSON")
    return parser.parse_args()


def is_another(name: str) -> bool:
    """Run an example with its own seed, print whether it is the run that was kept, and return whether it is not.

    Tests compare no more than the beginning.
    """
    own = run_alone(name, example(name).seed, MEASURED_S.get(name), None)
    kept = json.loads(VERSIONS.read_text(encoding="utf-8"))[name]
    found = [f"its {part} is another one" for part in DIGESTS if own[part] != kept[part]] + beyond_claims(name, own)
    print(f"{name}: {'; '.join(found) or 'as it was kept'}", flush=True)
    return bool(found)


def measured(
    name: str, seeds: Sequence[int], duration_s: float | None, at_once: int, shards: int | None
) -> Iterator[dict[str, float | None]]:
    """What was measured in the run of each seed, by what it is called and with the seed."""

    def run(seed: int) -> dict[str, float | None]:
        found = run_alone(name, seed, duration_s, shards)
        return {"seed": seed} | {quantity: value for quantity, value in found.items() if quantity not in DIGESTS}

    with ThreadPoolExecutor(at_once) as threads:
        for row in threads.map(run, seeds):
            print(f"{name}: seed {row['seed']} is run", file=sys.stderr, flush=True)
            yield row


def run_alone(name: str, seed: int, duration_s: float | None, shards: int | None) -> dict[str, Any]:
    """What was measured in the run of a seed, which has a process of its own, and the digests of its motion."""
    options = [*(["--duration", str(duration_s)] if duration_s else []), *(["--shards", str(shards)] if shards else [])]
    return in_own_process(name, *options, "--measure", str(seed))


def beginning_alone(name: str) -> dict[str, str]:
    """The digest of the beginning of an example, in a process of its own, where tests know how long it is."""
    return in_own_process(name, "--begin") if name in BEGINNINGS else {}


def in_own_process(name: str, *options: str) -> dict[str, Any]:
    """What this program prints of an example with options."""
    command = [sys.executable, __file__, name, *options]
    done = subprocess.run(command, env=os.environ | {"OPENBLAS_NUM_THREADS": "1"}, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"seeds: {name} {' '.join(options)} ended with status {done.returncode}:\n{done.stderr}")
    return json.loads(done.stdout.splitlines()[-1])


def print_beginning(name: str) -> None:
    """Run the beginning of an example in this process, print its digest, and end the process."""
    from support.example_runs import begun, motion_of_beginning

    with tempfile.TemporaryDirectory() as folder:
        print(json.dumps({"beginning": motion_of_beginning(name, begun(name, Path(folder)))}), flush=True)
    os._exit(0)  # Blender's own end may hang


def print_measured(name: str, seed: int, duration_s: float | None, shards: int | None) -> None:
    """Run an example with a seed in this process, print what was measured, and end the process."""
    from support.example_measures import measures_of
    from support.example_runs import example, motion_of, motion_of_beginning, run_example

    with tempfile.TemporaryDirectory() as folder:
        run = run_example(replace(example(name, duration_s, shards), seed=seed), Path(folder))
        digests = (motion_of(run), motion_of_beginning(name, run) if name in BEGINNINGS else None)
        print(json.dumps(measures_of(name, run) | dict(zip(DIGESTS, digests, strict=True))), flush=True)
    os._exit(0)  # Blender's own end may hang.


def table(name: str, rows: Sequence[dict[str, float | None]]) -> str:
    """Smallest, median and largest of each quantity, and in how many runs there was any."""
    lines = [f"\n{name}, {len(rows)} seeds", f"{'':36}{'smallest':>10}{'median':>10}{'largest':>10}{'runs':>6}"]
    for quantity in columns(rows)[1:]:
        values = [row[quantity] for row in rows if row.get(quantity) is not None]
        if values:
            figures = (min(values), statistics.median(values), max(values))
            lines.append(f"{quantity:36}" + "".join(f"{figure:10.4g}" for figure in figures) + f"{len(values):6}")
        else:
            lines.append(f"{quantity:36}{'':30}{0:6}")
    if moving := sum(bool(row.get("still_moving_shards")) for row in rows):
        lines.append(f"in {moving} of {len(rows)} runs shards still moved at the end: their throws are not final")
    return "\n".join(lines)


def columns(rows: Iterable[dict[str, float | None]]) -> list[str]:
    """Names of all quantities of any run, in their order."""
    return list(dict.fromkeys(quantity for row in rows for quantity in row))


def note_version(path: Path, name: str, digests: dict[str, str]) -> None:
    """Keep how the example moves with its own seed, by which its test finds that ranges are of an earlier version."""
    versions = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    kept = versions.get(name, {}) | digests
    text = json.dumps(versions | {name: kept}, indent=1, sort_keys=True) + "\n"
    path.write_text(text, encoding="utf-8", newline="\n")


def keep(path: Path, rows: Sequence[dict[str, float | None]]) -> None:
    """Write a row for each run, with four digits of each value."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns(rows))
        writer.writeheader()
        for row in rows:
            writer.writerow({name: "" if value is None else f"{value:.4g}" for name, value in row.items()})


if __name__ == "__main__":
    sys.exit(main())
