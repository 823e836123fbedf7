# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the studies, searches and optimisations that the documents tell of, and keep their tables and pictures.

Runs go to runs/ensembles/NAME: what is there already is not made again. With --results DIR nothing is run, and the
results in that folder are kept. Tables of runs and answers go to docs/data/ensembles, so that tests hold the documents
against them, pictures to docs/pictures. With --again a kept run is made again, the one that came to rest first: outputs
that differ are of another version.
"""

import argparse
import math
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

from matplotlib.figure import Figure

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from bridge_demolition_addon.charts.ensemble_charts import reach_distribution, study_plan
from bridge_demolition_addon.engineering.units import rounded_up
from bridge_demolition_addon.model.ensemble.folder import ensemble_of_file
from bridge_demolition_addon.model.scenario.file import scenario_text
from bridge_demolition_addon.model.study.file import SEED, Ensemble
from bridge_demolition_addon.model.study.keys import changed, keys_named
from bridge_demolition_addon.model.study.runs_table import DONE, RESTED, RunRow, RunsTable, read_runs, write_runs
from bridge_demolition_addon.report.ensemble.reported_ensemble import StudyRuns, read_study_runs
from bridge_demolition_addon.report.wording.numbers import percent
from bridge_demolition_addon.studies.run_process import RunLimits, RunProcess
from bridge_demolition_addon.studies.run_program import run_program_command
from bridge_demolition_addon.studies.versions import installed_blender, versions_with

ROOT = Path(__file__).resolve().parent.parent
DATA, PICTURES = ROOT / "docs" / "data" / "ensembles", ROOT / "docs" / "pictures"


@dataclass(frozen=True)
class Example:
    """An example that makes many runs: its command, its folder, and the files of its results."""

    command: str
    folder: str
    table: str
    answer: str
    picture: str  # beside these, or empty where it is drawn here
    file: str = ""  # of its settings; by default that of its name


ENSEMBLES = {
    "i235_one_span": Example("study", "studies", "runs.csv", "study.json", ""),
    "drilled_two_spans": Example("study", "studies", "runs.csv", "study.json", ""),
    "drilled_two_spans_longer_zones": Example("study", "studies", "runs.csv", "study.json", ""),
    "lillebruen": Example("study", "studies", "runs.csv", "study.json", ""),
    "overbridge": Example("study", "overbridge", "runs.csv", "study.json", "", "study.toml"),
    "lightest_ball": Example("search", "searches", "trials.csv", "search.json", "curve.png"),
    "least_charge": Example("optimise", "optimisations", "trials.csv", "optimise.json", "tradeoff.png"),
}
"""By the names of their examples."""

OF_THE_PLANNER = ("candidate", "round", "charge_kg")
"""Inputs and outputs of optimisations that no run has."""


def main() -> int:
    """Make an ensemble, and keep what it says; the exit status."""
    parser = argparse.ArgumentParser(prog="ensembles", description=__doc__.splitlines()[0])
    parser.add_argument("name", choices=ENSEMBLES, metavar="NAME", help=f"example: {', '.join(ENSEMBLES)}")
    parser.add_argument("--results", type=Path, metavar="DIR", help="keep these results, and run nothing")
    parser.add_argument("--again", action="store_true", help="make a kept run again, and name outputs that differ")
    options = parser.parse_args()
    if options.again:
        if differing := outputs_that_differ(options.name):
            print(f"{options.name} is of another version: {', '.join(differing)}")
        return bool(differing)
    results = options.results
    if results is None:
        results = ROOT / "runs" / "ensembles" / options.name
        command = ENSEMBLES[options.name].command
        words = ("-m", "bridge_demolition_addon", command, str(settings_file(options.name)), "--output", str(results))
        subprocess.run([sys.executable, *words], cwd=ROOT, check=True)
    keep(options.name, results)
    return 0


def keep(name: str, results: Path) -> None:
    """Copy tables, and copy or draw the picture."""
    example = ENSEMBLES[name]
    DATA.mkdir(parents=True, exist_ok=True)
    shutil.copy(results / example.table, runs_table(name))
    shutil.copy(results / example.answer, answer(name))
    if example.picture:
        shutil.copy(results / example.picture, picture(name))
    else:
        drawn(read_study_runs(results)).savefig(picture(name))


def outputs_that_differ(name: str) -> list[str]:
    """Make the run again that came to rest first, and return which of its outputs are others than those that are kept.

    Raises SystemExit where it does not finish.
    """
    ensemble, table = ensemble_of_file(settings_file(name)), read_runs(runs_table(name))
    done = [row for row in table.rows if row.status == DONE]
    row = min(done, key=lambda row: row.outputs[RESTED] or ensemble.scenario.time.duration_s)
    again = row_again(ensemble, row)
    of_runs = [output for output in table.outputs if output not in OF_THE_PLANNER]
    return [output for output in of_runs if is_another(row.outputs[output], again.outputs.get(output))]


def is_another(kept: object, again: object) -> bool:
    """Return whether outputs differ by more than rounding in single precision, of which sums of work are made.

    Versions of numpy add these in another order, by 1e-7 of an energy. That decides no run; where a run is another one,
    a collapse has made much more of it.
    """
    if isinstance(kept, float) and isinstance(again, float):
        return not math.isclose(kept, again, rel_tol=1e-6)
    return kept != again


def row_again(ensemble: Ensemble, row: RunRow) -> RunRow:
    """Return a row as it becomes by running its inputs once more, written and read as tables are."""
    scenario = ensemble.scenario
    varied = {name: value for name, value in row.inputs.items() if name not in (SEED, *OF_THE_PLANNER)}
    changes = {key: value for name, value in varied.items() for key in keys_named(scenario, name)}
    scenario = replace(changed(scenario, changes), seed=row.inputs[SEED])
    request = {"scenario": scenario_text(scenario), "study": ensemble.settings.shared_text}
    limits = RunLimits.of(ensemble.settings)
    process = RunProcess(run_program_command(), versions_with(installed_blender()), limits)
    with tempfile.TemporaryDirectory() as folder:
        try:
            outcome = process.play(request, Path(folder) / "run")
        finally:
            process.close()
        if outcome.reason:
            sys.exit(f"ensembles: run {row.number} did not finish: {outcome.reason}")
        path = Path(folder) / "runs.csv"
        write_runs(RunsTable((replace(row, outputs=outcome.outputs),)), path)
        return read_runs(path).rows[0]


def settings_file(name: str) -> Path:
    """Return the file of its settings."""
    example = ENSEMBLES[name]
    return ROOT / "examples" / example.folder / (example.file or f"{name}.toml")


def runs_table(name: str) -> Path:
    """Return the table of all runs."""
    return DATA / f"{name}.csv"


def answer(name: str) -> Path:
    """Return what it says."""
    return DATA / f"{name}.json"


def picture(name: str) -> Path:
    """Return its picture."""
    return PICTURES / f"{ENSEMBLES[name].command}_{name}.png"


def drawn(runs: StudyRuns) -> Figure:
    """Plan and distribution beside each other."""
    figure = Figure(figsize=(11.0, 4.6), dpi=120, layout="constrained")
    plan, distribution = figure.subfigures(1, 2, width_ratios=(5, 4))
    settings, limits = runs.ensemble.settings, runs.limits
    likely = {f"probability above {percent(level)}": area for level, area in runs.likely.items()}
    named = {f"{name}, {rounded_up(far_m, '0.1')} m": area for name, (far_m, area) in limits.items()}
    study_plan(plan, runs.bridge, likely, named, runs.ensemble.scenario.zones)
    limit_m = limits["limit"][0]
    reach_distribution(distribution, runs.distances_m, (limit_m, f"{rounded_up(limit_m, '0.1')} m"), settings.quantile)
    return figure


if __name__ == "__main__":
    sys.exit(main())
