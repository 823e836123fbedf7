# SPDX-License-Identifier: GPL-3.0-or-later
"""A crane lifts a part away in a run: what still held it then is said."""

from dataclasses import replace

from support.steelwork import bar, node, steel_scenario

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.model.run_folder.summary import RunSummary
from bridge_demolition_addon.model.sequence.lifts import held_parts_text
from bridge_demolition_addon.simulation.run import run_scenario

LIFT = """
[shards]
start_deactivated = false

[[lifts]]
name = "pick"
members = ["arm", "tip"]
from_s = 0.0
lift_s = 0.4
capacity_kg = 2000.0
"""

CUT = """
[[saw_cuts]]
members = ["arm"]
point_m = [0.5, 0.0, 5.0]
normal = [1.0, 0.0, 0.0]
time_s = 0.2
"""


def lifted(tables, folder):
    """Return the summary of a cantilever whose arm a crane lifts away."""
    nodes = [node("wall", 0.0, 5.0, support="fixed"), node("tip", 2.0, 5.0)]
    scenario = steel_scenario(nodes, [bar("arm", "wall", "tip", "HEA 100")], tables, pieces=4)
    scenario = replace(scenario, time=replace(scenario.time, duration_s=0.6))
    return run_scenario(scenario, folder / "run", overwrite=False, pictures=False, progress=Silence())


def test_a_part_that_is_still_held_is_lifted_away_and_that_is_said(tmp_path):
    summary = lifted(LIFT, tmp_path)
    (event,) = summary["events"]
    assert event["kind"] == "lifting away" and event["lift"] == "pick" and event["held_by"] == ["wall"]
    assert held_parts_text(RunSummary.of(summary).events).startswith(
        "Parts were still held when the crane lifted them away: lift 'pick' by wall."
    )


def test_a_part_that_was_cut_free_before_is_held_by_nothing(tmp_path):
    box = "lowest_corner_m = [0.5, -1.0, 4.0]\nhighest_corner_m = [3.0, 1.0, 6.0]\n"
    summary = lifted(LIFT.replace("from_s", f"{box}from_s") + CUT, tmp_path)
    assert [event["kind"] for event in summary["events"]] == ["saw cut", "lifting away"]
    assert summary["events"][1]["held_by"] == [] and held_parts_text(RunSummary.of(summary).events) == ""
