# SPDX-License-Identifier: GPL-3.0-or-later
"""What a study costs over what Blender itself needs, what two jobs win, and what it costs to schedule a draw.

Blender's own time is taken in a process that builds each draw and plays it with nothing recorded: once as Blender plays
it by itself, where pieces that broke apart still pass through each other, and once with only what changes the outcome,
in turns with the same draws as a study makes them. Blender has one thread there, as in processes of a study. A study of
the same draws is taken as a user starts it: the command line with its start, that of Blender, building, recording
and writing included. Draws that do nothing show what is left where Blender takes no time.

Candidates of an optimisation have the same seeds, so that their runs share models: they are made with and without that.
"""

import json
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from bridge_demolition_addon.model.study.file import read_study
from bridge_demolition_addon.studies.engine import LocalProcesses
from bridge_demolition_addon.studies.run_process import RunLimits
from bridge_demolition_addon.studies.session import EnsembleSession

ROOT = Path(__file__).resolve().parents[2]

SCENARIO, DRAWS, NOTHING = ROOT / "examples" / "report_2019" / "i235_one_span.toml", 16, 1000
SMALLEST = ROOT / "tests" / "gui" / "small.toml", 1, 20
"""Scenario, how many draws of it, and how many that do nothing."""
BARE, SHARED = (Path(__file__).with_name(name) for name in ("bare_study.py", "shared_runs.py"))
CANDIDATES, SEEDS = 4, 3
"""Candidates of an optimisation, and runs of each."""

VERSIONS = {"program": "that does nothing"}
LIMITS = RunLimits()

WITH_ONE_THREAD = """
import runpy, sys
from bridge_demolition_addon.system.processor import load_on_one_core
load_on_one_core("bpy")
del sys.argv[0]
runpy.run_path(sys.argv[0], run_name="__main__")
"""
"""Runs a script, whose arguments follow it, in a process like that of a study's runs."""

DOES_NOTHING = """
import sys
print('bda-draw {"versions": {"program": "that does nothing"}}', flush=True)
for line in sys.stdin:
    print('bda-draw {"status": "done", "outputs": {"reach_m": 1.0}, "fingerprint": {}}', flush=True)
"""
"""A program of draws without anything of ours in it."""


def main(smallest: bool, runs: int | None = None) -> dict[str, float]:
    """Print all ratios, and return those of a study of so many runs over Blender's own steps, and of shared models."""
    scenario, count, empty = SMALLEST if smallest else (SCENARIO, runs or DRAWS, NOTHING)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        ratios = draws(folder, _study_file(folder / "study.toml", scenario, count), count)
        seeds = 1 if smallest else SEEDS
        ratios |= shared_models(_study_file(folder / "optimisation.toml", scenario, seeds), seeds)
        scheduling(folder, empty)
        scheduling_on_dask(folder, max(empty // 5, 20))
    return ratios


def draws(folder: Path, study: Path, count: int) -> dict[str, float]:
    """Compare a study with Blender's own time for the same draws; two jobs take two of them at least."""
    ratios, bare = {}, (sys.executable, "-c", WITH_ONE_THREAD, BARE)
    alone = _times_of(*bare, "alone", study)
    one = _times_of(*_study_command(study, folder / "one", 1))
    in_turns = _times_of(*bare, "turns", study)
    same, of_runs = in_turns[:2], in_turns[2:]
    times = {"steps as Blender plays them by itself": alone, "steps as they are": same, "study with one job": one}
    if count > 1:
        times["study with two jobs"] = _times_of(*_study_command(study, folder / "two", 2))
    print(f"{count} draws, in seconds of the clock and of the processors")
    for name, (wall_s, processor_s) in times.items():
        print(f"{name:>40}{wall_s:>8.1f}{processor_s:>8.1f}")
    for name, bare in (("as Blender plays them by itself", alone), ("as they are", same)):
        print(f"study with one job over steps {name}: {one[0] / bare[0]:.2f} and {one[1] / bare[1]:.2f}")
        ratios[f"study with one job over steps {name}"] = one[0] / bare[0]
    print(f"its runs over these steps, by turns: {of_runs[0] / same[0]:.2f} and {of_runs[1] / same[1]:.2f}")
    ratios["runs over steps as they are, by turns"] = of_runs[0] / same[0]
    if count > 1:
        shorter = one[0] / times["study with two jobs"][0]
        print(f"two jobs over one: {shorter:.2f} times as fast")
        ratios["study with two jobs over one"] = 1.0 / shorter
    return ratios


def shared_models(study: Path, seeds: int) -> dict[str, float]:
    """Compare runs of candidates on the same seeds with models that are kept, and with each building its own."""
    shared_s, of_kept_s, own_s, of_own_s = _times_of(sys.executable, SHARED, study, CANDIDATES)
    print(f"{CANDIDATES} candidates on {seeds} seeds, models kept over own ones, by processor time:")
    print(f"whole runs {shared_s / own_s:.3f}, their models alone {of_kept_s / of_own_s:.3f}")
    print(f"models are {of_own_s / own_s:.3f} of runs that build their own")
    return {"runs that share models over runs with their own": shared_s / own_s}


def scheduling(folder: Path, count: int) -> None:
    """Time draws that do nothing, here."""
    engine = LocalProcesses(1, LIMITS, [sys.executable, "-c", DOES_NOTHING], VERSIONS)
    seconds = _play(folder / "nothing", engine, count)
    print(f"scheduling a draw here: {1e3 * seconds / count:.1f} ms")
    memory_mb = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3
    print(f"most memory of the parent after {count} draws: {memory_mb:.0f} MB")


def scheduling_on_dask(folder: Path, count: int) -> None:
    """Time draws that do nothing on two workers of a cluster on this machine, each with a process that stays warm."""
    from distributed import LocalCluster

    from bridge_demolition_addon.studies.dask_cluster import DaskCluster

    with LocalCluster(2, threads_per_worker=1, dashboard_address=None) as cluster:
        command = [sys.executable, "-S", "-c", DOES_NOTHING]
        engine = DaskCluster(cluster.scheduler_address, LIMITS, command, VERSIONS)
        seconds = _play(folder / "dask", engine, count)
    print(f"scheduling a draw on Dask: {1e3 * seconds / count:.1f} ms")


def _play(output: Path, engine, count: int) -> float:
    study = read_study(_study_file(output.with_suffix(".toml"), SCENARIO, count))
    run = EnsembleSession(study, output, engine)
    began = time.perf_counter()
    while not run.planner.is_finished:
        run.step(1.0)
    seconds = time.perf_counter() - began
    run.finish()
    return seconds


def _study_command(study: Path, output: Path, jobs: int) -> list[str]:
    module = [sys.executable, "-m", "bridge_demolition_addon"]
    return [*module, "study", str(study), "--output", str(output), "--quiet", "--jobs", str(jobs)]


def _times_of(*command: object) -> tuple[float, ...]:
    """Seconds of the clock and of the processors that a command takes, or those that it prints."""
    before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    done = subprocess.run([*map(str, command)], check=True, capture_output=True, text=True, cwd=ROOT)
    seconds, after = time.perf_counter() - began, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.stdout:
        return tuple(json.loads(done.stdout.splitlines()[-1]))
    return seconds, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def _study_file(path: Path, scenario: Path, runs: int) -> Path:
    settings = f"runs = {runs}\nquantile = 0.5\nconfidence = 0.5\nrank = 1\n"
    vary = '[[vary]]\nkey = "ball.drop_height_m"\ndistribution = "uniform"\nlowest = 4.5\nhighest = 5.5\n'
    path.write_text(f"[study]\nscenario = {str(scenario)!r}\n{settings}\n{vary}", encoding="utf-8")
    return path
