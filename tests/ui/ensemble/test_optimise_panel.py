# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel Optimise: an optimisation that runs beside Blender, is stopped, goes on, and shows its result."""

import json
import sys
from dataclasses import replace

import pytest
from support.ensemble_panels import drawn, look_in_until
from support.scenarios import SHORT_RUN

from bridge_demolition_addon.model.scenario import BlastSettings, Charge
from bridge_demolition_addon.model.study.runs_table import read_runs
from bridge_demolition_addon.ui.ensemble import optimise as sidebar
from bridge_demolition_addon.ui.ensemble.optimise import WORK, shown_optimisation
from bridge_demolition_addon.ui.scenario.values import show_scenario

CHARGE = Charge(name="one", position_m=(6.0, 0.0, 1.0), mass_kg=20.0)
VERY_SHORT = replace(
    SHORT_RUN,
    ball=None,
    charges=(CHARGE,),
    blast=BlastSettings(start_s=0.05),
    time=replace(SHORT_RUN.time, duration_s=0.1),
)


@pytest.fixture
def panel(extension, tmp_path):
    """The settings of a scene that shows an optimisation of twelve runs."""
    settings = extension.context.scene.bda
    show_scenario(settings, VERY_SHORT)
    settings.optimise_directory, settings.study_jobs = str(tmp_path / "optimised"), 1
    asked = settings.optimise
    asked.quantile = asked.probability = asked.confidence = 0.5
    asked.candidates, asked.runs_each = 10, 1
    asked.finalists = asked.finalist_runs = asked.confirmation_runs = 1
    quantity = asked.quantities.add()
    quantity.key, quantity.lowest, quantity.highest = "charges.mass_kg", 1.0, 40.0
    return settings


@pytest.mark.long
def test_an_optimisation_is_stopped_goes_on_and_shows_its_result(blender, panel, tmp_path):
    ops, folder = blender.ops.bda, tmp_path / "optimised"
    assert {"bda.start_optimise", "objective", "candidates", "optimise_criterion"} <= set(drawn(blender, sidebar))
    assert not ops.stop_optimise.poll() and not ops.open_tradeoff.poll()
    assert ops.start_optimise() == {"FINISHED"}
    assert not ops.start_optimise.poll()
    running = drawn(blender, sidebar)
    assert "bda.stop_optimise" in running and "0 of 12 runs" in running
    look_in_until(WORK, lambda: WORK.session.planner.done >= 1)
    assert ops.stop_optimise() == {"FINISHED"}
    kept = read_runs(folder / "trials.csv")
    assert WORK.session is None and len(kept) >= 1

    assert ops.start_optimise() == {"FINISHED"}
    look_in_until(WORK)
    table = read_runs(folder / "trials.csv")
    assert len(table) == 12 and [row.inputs for row in table.rows[: len(kept)]] == [row.inputs for row in kept.rows]
    best = json.loads((folder / "optimise.json").read_text(encoding="utf-8"))
    assert 1.0 <= best["values"]["charges.mass_kg"] <= 40.0
    found = drawn(blender, sidebar)
    assert f"Candidate {best['candidate']} of 10 did best:" in found and "bda.open_tradeoff" in found
    assert WORK.result.picture == folder / "tradeoff.png" and ops.open_tradeoff.poll()


def test_the_button_is_greyed_with_a_reason_where_optuna_is_missing(blender, panel, monkeypatch):
    monkeypatch.setitem(sys.modules, "optuna", None)
    assert not blender.ops.bda.start_optimise.poll()
    with pytest.raises(RuntimeError, match="An optimisation needs Optuna, which this Blender's Python does not have"):
        blender.ops.bda.start_optimise()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda panel: panel.optimise.quantities.clear(), r"at least one table \[\[quantities\]\]"),
        (
            lambda panel: setattr(panel.optimise, "confidence", 0.99),
            "optimise.confirmation_runs is 1: expected at least",
        ),
        (lambda panel: setattr(panel, "optimise_criterion", "AS_IN_STUDY"), r"at least one table \[\[criteria\]\]"),
    ],
)
def test_an_optimisation_that_cannot_run_is_refused_with_a_sentence(blender, panel, tmp_path, change, message):
    change(panel)
    with pytest.raises(RuntimeError, match=message):
        blender.ops.bda.start_optimise()
    assert WORK.session is None and not (tmp_path / "optimised").exists()


def test_an_optimisation_file_is_shown_with_its_scenario(blender, panel, tmp_path):
    asked = shown_optimisation(panel)
    (tmp_path / "optimise.toml").write_text(asked.text, encoding="utf-8")
    (tmp_path / "scenario_as_run.toml").write_text(asked.scenario_text, encoding="utf-8")
    panel.optimise_path, panel.optimise.candidates = str(tmp_path / "optimise.toml"), 30
    panel.optimise.quantities.clear()
    assert blender.ops.bda.load_optimise() == {"FINISHED"}
    assert shown_optimisation(panel).text == asked.text
