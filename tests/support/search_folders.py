# SPDX-License-Identifier: GPL-3.0-or-later
"""Folders of searches as `bda search` leaves them, made without runs."""

import json

import numpy as np
from support.scenarios import I235

from bridge_demolition_addon.model.search.file import search_of
from bridge_demolition_addon.model.search.settings import SearchSettings
from bridge_demolition_addon.model.study.criteria import Criterion
from bridge_demolition_addon.model.study.runs_table import RunRow, RunsTable, write_runs


def search_folder(folder):
    """The folder of a search of which one trial was lost."""
    settings = SearchSettings(
        scenario="scenario_as_run.toml",
        key="ball.mass_kg",
        lowest=100.0,
        highest=10_000.0,
        logarithmic=True,
        trials=20,
        criteria=(Criterion(name="down", kind="collapsed"),),
    )
    search = search_of(settings, I235)
    folder.mkdir()
    (folder / search.file_name).write_text(search.text, encoding="utf-8")
    (folder / "scenario_as_run.toml").write_text(search.scenario_text, encoding="utf-8")
    masses = np.geomspace(200.0, 8000.0, 20)
    met = masses > 1500.0
    met[[8, 13]] = True, False
    rows = [
        RunRow(number, "done", {"ball.mass_kg": float(mass)}, {"success": bool(success)})
        for number, (mass, success) in enumerate(zip(masses, met, strict=True), start=1)
    ]
    rows[-1] = RunRow(20, "crashed", {"ball.mass_kg": 8000.0}, {})
    write_runs(RunsTable(tuple(rows)), folder / "trials.csv")
    (folder / "versions.json").write_text(json.dumps({"blender": "of tests"}), encoding="utf-8")
    return folder, int(met.sum()) - 1
