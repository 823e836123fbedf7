# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw what a study says, for the documents: its plan, and how its runs reach how far.

Usage: study_picture.py DIR, the folder of the study in examples/studies. Its table of runs and what it says are kept in
docs/data/studies, so that a test can hold the documents against them.
"""

import shutil
import sys
from pathlib import Path

from matplotlib.figure import Figure

from bridge_demolition_addon.charts.study_charts import reach_distribution
from bridge_demolition_addon.charts.study_plan import study_plan
from bridge_demolition_addon.model.study.files import CONCLUSIONS_FILE, RUNS_FILE
from bridge_demolition_addon.report.ensemble.study_runs import StudyRuns, read_study_runs
from bridge_demolition_addon.report.wording.numbers import percent, rounded_up

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
DATA, PICTURE = DOCS / "data" / "studies", DOCS / "pictures" / "study_i235_one_span.png"
RUNS, CONCLUSIONS = DATA / "i235_one_span.csv", DATA / "i235_one_span.json"


def main(arguments: list[str]) -> int:
    """Draw the study of a folder, and keep its numbers."""
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    folder = Path(arguments[0])
    DATA.mkdir(parents=True, exist_ok=True)
    shutil.copy(folder / RUNS_FILE, RUNS)
    shutil.copy(folder / CONCLUSIONS_FILE, CONCLUSIONS)
    drawn(read_study_runs(folder)).savefig(PICTURE)
    return 0


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
    sys.exit(main(sys.argv[1:]))
