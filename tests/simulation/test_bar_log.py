# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run says of its bars, in log, summary, report and panel, held against statics of a beam with one crack."""

import csv
import json
import re
import sys

import numpy as np
import pytest
from support.checkout import ROOT

from bridge_demolition_addon.model.run_folder.summary import RunSummary

sys.path.insert(1, str(ROOT / "validation"))

from beams import Beam
from case import RIGID_BODIES, simulated

from bridge_demolition_addon.display.contour_quantities import ContourQuantity
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.results.collapse import ConnectionCounts
from bridge_demolition_addon.report.run_folder import read_run
from bridge_demolition_addon.report.sections.reinforcement import bar_blocks
from bridge_demolition_addon.ui.results.shown_run import lines_of

SPAN_M, HEIGHT_M, WIDTH_M, LEVER_M = 4.0, 0.3, 0.3, 0.25
WEIGHT_MOMENT_NM = 2400.0 * SPAN_M * HEIGHT_M * WIDTH_M * STANDARD_GRAVITY_M_S2 * SPAN_M / 8.0
ELONGATION_M, AT_YIELD_M = 0.05, 0.0025
"""Bars rupture at a strain of 5 % and yield at 0.25 %: 500 N/mm² by 200,000 N/mm²."""


def cracked_beam(folder, share, duration_s):
    """Run a beam whose bars resist so many times the moment of its weight; return its results."""
    width = WIDTH_M * 30e6
    moment = share * WEIGHT_MOMENT_NM
    area_mm2 = width * (LEVER_M - (LEVER_M**2 - 2.0 * moment / width) ** 0.5) / 500.0
    beam = Beam(SPAN_M, WIDTH_M, HEIGHT_M, 2.0, "bottom", LEVER_M, area_mm2, 500.0, 30.0, 0.05, AT_YIELD_M)
    assert beam.moment_nm == pytest.approx(moment)
    # The beam of the validation does not rupture so early.
    tables, found = re.subn(
        r"ductile_elongation_m = \S+\n(.*\n)ductile_rupture_strain = \S+\n",
        rf"ductile_elongation_m = {ELONGATION_M}\n\1",
        beam.scenario,
    )
    assert found == 1
    scenario = f"""
[scenario]
title = "beam on its bars"

[time]
duration_s = {duration_s}
stop_at_rest = false
substeps_per_frame = 20
solver_iterations = 50
{tables}
{RIGID_BODIES.format(shards=0.25, ground=0.25)}"""
    return simulated(folder, "beam", scenario, beam.solids)


def log_of(folder):
    with (folder / "beam" / "run" / "bar_log.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def summary_of(folder):
    return json.loads((folder / "beam" / "run" / "summary.json").read_text(encoding="utf-8"))


@pytest.mark.long
def test_bars_that_stand_are_logged_with_the_force_of_statics(blender, tmp_path):
    results = cracked_beam(tmp_path, 1.3, 2.0)
    logged, summary = log_of(tmp_path), summary_of(tmp_path)
    assert {(line["first_member"], line["second_member"]) for line in logged} == {("beam", "beam")}
    assert len({line["connection"] for line in logged}) == 1
    # Elastic again after it overshot: bars at the lower corners alone are in tension, by M / h about the pressed edge.
    # Measured 0.1 %; it swings on them still.
    mean_n = np.mean([float(line["force_N"]) for line in logged[-12:]])
    assert mean_n == pytest.approx(WEIGHT_MOMENT_NM / HEIGHT_M, rel=0.02)
    uses = np.array([float(line["rupture_strain_share"]) for line in logged])
    openings = np.array([float(line["opening_m"]) for line in logged])
    np.testing.assert_allclose(uses, openings / ELONGATION_M, rtol=1e-6)
    bars = summary["reinforcement"]
    assert (bars["cracked"], bars["held_at_end"], bars["yielded"], bars["ruptured"]) == (1, 1, 1, 0)
    connections = summary["connections"]
    assert (connections["cracked"], connections["yielded"], connections["torn"]) == (1, 1, 0)
    counts = [ConnectionCounts.of_results(results, row) for row in range(len(results.frames))]
    assert (counts[0].cracked, counts[0].torn) == (0, 0) and {count.torn for count in counts} == {0}
    assert sorted({count.yielded for count in counts}) == [0, 1]
    assert bars["largest_use"]["share"] == pytest.approx(uses.max())
    assert bars["largest_use"]["time_s"] == pytest.approx(float(logged[int(uses.argmax())]["time_s"]))
    use = results.frames.loads.body_bar_use.max(axis=1)
    assert use.max() == pytest.approx(uses.max(), rel=1e-6)
    assert results.frames.time_s[use.argmax()] == pytest.approx(bars["largest_use"]["time_s"])


@pytest.mark.long
def test_a_beam_that_bars_let_go_is_said_to_have_ruptured(blender, tmp_path):
    results = cracked_beam(tmp_path, 0.9, 0.8)
    summary = summary_of(tmp_path)
    bars = summary["reinforcement"]
    # The layer at 5/6 of the height has 1/6 of its force at the upper corners, where the folded beam is closed.
    assert (bars["cracked"], bars["held_at_end"], bars["ruptured"], bars["ruptured_in_part"]) == (1, 1, 0, 1)
    assert bars["largest_use"]["share"] == bars["by_kind"][0]["largest_use_share"] == 1.0
    assert float(log_of(tmp_path)[-1]["ruptured_share"]) == pytest.approx(5.0 / 6.0)
    # Work by hand: bars at the lower corners yield until they rupture, those at the upper ones as far at most.
    # Those at the lower corners resist M about the upper edge: F h = M.
    lower_n = 0.9 * WEIGHT_MOMENT_NM / HEIGHT_M
    lower_j, upper_j = (force_n * (ELONGATION_M - AT_YIELD_M) for force_n in (lower_n, lower_n / 5.0))
    assert 0.98 * lower_j < summary["energy"]["dissipated_by_bars_J"] < 1.02 * (lower_j + upper_j)
    assert (
        RunSummary.of(summary).reinforcement.text
        == f"1 of {bars['with_bars']} connections with bars cracked, 1 yielded, 0 ruptured, 1 in part"
    )
    assert any(line.startswith("Bars: 1 of ") for line in lines_of(RunSummary.of(summary)))
    table = bar_blocks(read_run(tmp_path / "beam" / "run"))[0]
    # What depends on the length of sub-steps is given nowhere as a margin.
    assert list(table.rows[0]) == ["beam", 1, 1, 0, 1, 1]
    assert not any("rupture strain" in line for line in lines_of(RunSummary.of(summary)))
    frame, shards = results.frames[-1], results.inventory.of_kind("shard")
    uses = [
        ContourQuantity.BAR_USE.mean(results.frames[row], frame)[shards].max() for row in range(len(results.frames))
    ]
    assert max(uses) == 1.0 and uses[-1] < 1.0


def test_a_run_without_bars_says_nothing_of_them():
    assert RunSummary.of({"reinforcement": None}).reinforcement is RunSummary().reinforcement is None
