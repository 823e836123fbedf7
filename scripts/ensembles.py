# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the studies, searches and optimisations that the documents tell of, and keep their tables and pictures.

Runs go to runs/ensembles/NAME: what is there already is not made again. With --results DIR nothing is run, and the
results in that folder are kept. Tables of runs and answers go to docs/data/ensembles, so that tests hold the documents
against them, pictures to docs/pictures.
"""

import argparse
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from matplotlib.figure import Figure

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from bridge_demolition_addon.charts.study_charts import reach_distribution
from bridge_demolition_addon.charts.study_plan import study_plan
from bridge_demolition_addon.report.ensemble.study_runs import StudyRuns, read_study_runs
from bridge_demolition_addon.report.wording.numbers import percent, rounded_up

ROOT = Path(__file__).resolve().parent.parent
DATA, PICTURES = ROOT / "docs" / "data" / "ensembles", ROOT / "docs" / "pictures"


@dataclass(frozen=True)
class Ensemble:
    """An example that makes many runs: its command, its folder, and the files of its results."""

    command: str
    folder: str
    table: str
    answer: str
    picture: str  # beside these, or empty where it is drawn here


ENSEMBLES = {
    "i235_one_span": Ensemble("study", "studies", "runs.csv", "study.json", ""),
    "drilled_two_spans": Ensemble("study", "studies", "runs.csv", "study.json", ""),
    "lightest_ball": Ensemble("search", "searches", "trials.csv", "search.json", "curve.png"),
    "least_charge": Ensemble("optimise", "optimisations", "trials.csv", "optimise.json", "tradeoff.png"),
}
"""By the names of their examples."""


def main() -> int:
    """Make an ensemble, and keep what it says; the exit status."""
    parser = argparse.ArgumentParser(prog="ensembles", description=__doc__.splitlines()[0])
    parser.add_argument("name", choices=ENSEMBLES, metavar="NAME", help=f"example: {', '.join(ENSEMBLES)}")
    parser.add_argument("--results", type=Path, metavar="DIR", help="keep these results, and run nothing")
    options = parser.parse_args()
    ensemble, results = ENSEMBLES[options.name], options.results
    if results is None:
        results = ROOT / "runs" / "ensembles" / options.name
        example = ROOT / "examples" / ensemble.folder / f"{options.name}.toml"
        command = ("-m", "bridge_demolition_addon", ensemble.command, str(example), "--output", str(results))
        subprocess.run([sys.executable, *command], cwd=ROOT, check=True)
    keep(options.name, results)
    return 0


def keep(name: str, results: Path) -> None:
    """Copy tables, and copy or draw the picture."""
    ensemble = ENSEMBLES[name]
    DATA.mkdir(parents=True, exist_ok=True)
    shutil.copy(results / ensemble.table, runs_table(name))
    shutil.copy(results / ensemble.answer, answer(name))
    if ensemble.picture:
        shutil.copy(results / ensemble.picture, picture(name))
    else:
        drawn(read_study_runs(results)).savefig(picture(name))


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
