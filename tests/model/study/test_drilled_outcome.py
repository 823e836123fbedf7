# SPDX-License-Identifier: GPL-3.0-or-later
"""Outcomes of runs with drilled charges: what they do at neighbours, and how heavy they are."""

from dataclasses import replace

import pytest
from support.checkout import EXAMPLES
from support.moving_boxes import moving_boxes

from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.optimise.file import total_charge_kg
from bridge_demolition_addon.model.run_folder.summary import RunSummary
from bridge_demolition_addon.model.scenario import Neighbour
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.study.outcome import evaluate

pytestmark = pytest.mark.slow

DRILLED = replace(
    read_scenario(EXAMPLES / "drilled" / "two_spans.toml"),
    neighbours=(Neighbour(name="house", position_m=(13.0, 40.0, 1.5)),),
)
SUMMARY = {"largest_resultant": None, "energy": None, "connections": {"count": 20, "broken": 7}, "came_to_rest_s": 2.5}


def outputs_of(scenario):
    still = moving_boxes([0, 1], [(10, 4, 1), (1, 1, 1)], [[(0, 0, 5), (0, 0, 6)]] * 2)
    return evaluate(still, RunSummary.of(SUMMARY), scenario).outputs


def test_drilled_charges_shake_neighbours():
    """Both columns of the mid pier fire within 8 ms: 1.47 kg, as if all of it were in the nearer column."""
    members = {member.name: member.solid.bounds for member in prepared_members(DRILLED).members}
    distance_m = 40.0 - max(members[f"pier 2 column {column}"][1, 1] for column in (1, 2))
    outputs = outputs_of(DRILLED)
    assert outputs["neighbours.house.vibration_mm_s"] == pytest.approx(1140.0 * (distance_m / 1.47**0.5) ** -1.6)
    assert outputs["neighbours.house.pressure_kPa"] == pytest.approx(20.0 * (distance_m / 1.47 ** (1 / 3)) ** -1.45)


def test_misfires_and_runs_without_explosion_are_silent():
    silent = replace(DRILLED, blast=replace(DRILLED.blast, explosion=False))
    failed = replace(DRILLED, blast_zones=[replace(zone, fires=False) for zone in DRILLED.blast_zones])
    for scenario in (silent, failed):
        assert outputs_of(scenario)["neighbours.house.vibration_mm_s"] == 0.0


def test_mass_of_all_charges_counts_those_in_drill_holes():
    assert total_charge_kg(DRILLED) == pytest.approx(4.41)
    assert total_charge_kg(replace(DRILLED, blast=replace(DRILLED.blast, explosion=False))) == 0.0
