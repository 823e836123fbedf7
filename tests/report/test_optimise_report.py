# SPDX-License-Identifier: GPL-3.0-or-later
"""The report of an optimisation: the chosen candidate on fresh runs, all candidates, and what to beware of."""

import csv

import pytest
from support.optimised_folders import optimised

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.model.optimise.conclusions import best_of

REACH = ('objective = "charge"', 'objective = "reach"')


def page_of(folder):
    assert main(["report", str(folder), "--quiet"]) == 0
    return (folder / "report" / "report.html").read_text(encoding="utf-8")


def table(folder, name):
    return list(csv.DictReader((folder / "report" / "tables" / f"{name}.csv").open(encoding="utf-8")))


def test_the_report_has_the_winner_on_fresh_runs_the_candidates_and_the_trade_off(tmp_path):
    folder, planner = optimised(tmp_path, REACH)
    page, best = page_of(folder), best_of(planner.ensemble, planner.table)
    assert f"Candidate {best.candidate} of 20 did best:" in page and "fresh runs" in page
    assert "Report of an optimisation with 42 simulated demolitions" in page
    rounds = table(folder, "chosen_candidate")
    assert [(row["round"], row["runs"]) for row in rounds] == [("search", "1"), ("final", "3"), ("confirmation", "16")]
    assert float(rounds[-1]["objective"]) == pytest.approx(best.confirmed.value)
    candidates = table(folder, "candidates")
    assert len(candidates) == 20 and {row["remark"] for row in candidates} >= {"chosen", "fails too often"}
    holding = [float(row["objective"]) for row in candidates if row["remark"] != "fails too often"]
    assert holding == sorted(holding)
    assert "Charge and debris distance of all candidates" in page
    assert len(table(folder, "farthest_draws")) == 42
    assert (folder / "report" / "report.pdf").read_bytes().startswith(b"%PDF-")


@pytest.mark.long
def test_luck_of_the_search_is_warned_of(tmp_path):
    folder, planner = optimised(tmp_path, REACH)
    assert best_of(planner.ensemble, planner.table).looked_better_by > 0.0
    assert "Winner&#x27;s curse: in the search the chosen candidate looked better by" in page_of(folder)


@pytest.mark.long
def test_a_candidate_that_is_not_confirmed_is_warned_of(tmp_path):
    folder, _ = optimised(tmp_path, fails_at_last=True)
    assert "The chosen candidate is not confirmed" in page_of(folder)


@pytest.mark.long
def test_an_optimisation_that_goes_on_says_how_far_it_is(tmp_path):
    folder, _ = optimised(tmp_path, REACH, most=7)
    page = page_of(folder)
    assert "7 of up to 42 runs are there: the optimisation states nothing before" in page
    assert len(table(folder, "candidates")) == 7 and "Winner" not in page


def test_a_damaged_table_is_refused(tmp_path, capfd):
    folder, _ = optimised(tmp_path, REACH, most=7)
    trials = folder / "trials.csv"
    trials.write_text(trials.read_text(encoding="utf-8").replace("in.round", "in.circle"), encoding="utf-8")
    assert main(["report", str(folder), "--quiet"]) == 2
    assert "trials.csv is damaged" in capfd.readouterr().err and not (folder / "report").exists()
