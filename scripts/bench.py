# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure how fast this is, as ratios taken in one run: ours against Blender's bare step and against plainer ways.

Each bench is a module of `scripts/benches` and runs in a process of its own. Its `main` may return ratios by their
names, of which less is better. `--keep` notes them with the commit (`bench_history`), and names those that have grown.
"""

import argparse
import importlib
import json
import os
import subprocess
import sys
import tempfile
import traceback
from collections.abc import Sequence
from pathlib import Path

import bench_history

from bridge_demolition_addon.system.processor import load_on_one_core

BENCHES = (
    "building",
    "fracture",
    "recording",
    "demolition",
    "strength",
    "blast",
    "contours",
    "panels",
    "report",
    "elastic",
    "truss",
    "studies",
)


def main() -> int:
    """Run the benches that are asked for; the exit status is 1 where one failed."""
    parser = argparse.ArgumentParser(prog="bench", description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="benches, all by default: " + ", ".join(BENCHES))
    parser.add_argument("--smallest", action="store_true", help="the smallest sizes, once: shows that benches work")
    parser.add_argument("--keep", action="store_true", help="note the ratios in docs/data/bench.csv, and draw them")
    parser.add_argument("--runs", type=int, metavar="N", help="runs of the study of the bench `studies`, by default 16")
    parser.add_argument("--ratios", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if unknown := set(options.names) - set(BENCHES):
        parser.error(f"no bench has the name {', '.join(sorted(unknown))}")
    if options.keep and options.smallest:
        parser.error("the smallest sizes say nothing of speed: keep ratios of whole benches")
    if options.runs and (options.names != ["studies"] or options.keep):
        parser.error("--runs is for the bench studies alone, and its ratios are not kept beside those of others")
    if options.ratios or (len(options.names) == 1 and not options.keep):
        return run(options.names[0], options.smallest, options.ratios, options.runs)
    with tempfile.TemporaryDirectory() as folder:
        return run_all(options.names or BENCHES, Path(folder), smallest=options.smallest, keep=options.keep)


def run_all(names: Sequence[str], folder: Path, *, smallest: bool, keep: bool) -> int:
    """Run benches one after another, each in a process of its own; the exit status is 1 where one failed."""
    status, found = 0, {}
    for name in names:
        print(f"== {name}", flush=True)
        ratios = folder / f"{name}.json"
        command = [sys.executable, __file__, name, "--ratios", str(ratios), *(["--smallest"] if smallest else [])]
        status |= subprocess.run(command, check=False).returncode != 0
        if ratios.exists():
            found[name] = json.loads(ratios.read_text(encoding="utf-8"))
    if keep and not status:
        bench_history.keep(found)
        for line in bench_history.grown():
            print(line)
    return status


def run(name: str, smallest: bool, ratios: Path | None, runs: int | None = None) -> int:
    """Run a bench in this process, maybe with a number of runs, and write its ratios where they are wanted.

    Blender has one thread, as in programs that make runs without pictures.
    """
    try:
        load_on_one_core("bpy")
        found = importlib.import_module(f"benches.{name}").main(smallest, **({"runs": runs} if runs else {}))
    except Exception:
        traceback.print_exc()
        return 1
    if ratios and found:
        ratios.write_text(json.dumps(found), encoding="utf-8")
    return 0


if __name__ == "__main__":
    status = main()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)  # Blender's own end may hang
