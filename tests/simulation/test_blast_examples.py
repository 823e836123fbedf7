"""The examples by explosives: stand without their charges, come down with them."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.core.results import load_results
from bridge_demolition_addon.core.scenario.file import read_scenario
from bridge_demolition_addon.simulation.run import run_scenario

EXAMPLES = Path(__file__).parents[2] / "examples"


def run(scenario, folder):
    summary = run_scenario(scenario, folder, overwrite=True, pictures=False, progress=Silence())
    return summary, load_results(folder / "results.npz")


def shortened(name, duration_s):
    scenario = read_scenario(EXAMPLES / name)
    return replace(scenario, time=replace(scenario.time, duration_s=duration_s))


@pytest.mark.parametrize(("name", "spans_m", "sag_m"), [("single_span", 13.0, 0.04), ("two_spans", 40.0, 0.03)])
def test_bridge_stands_until_its_charges_go_off(blender, tmp_path, name, spans_m, sag_m):
    scenario = shortened(f"{name}_explosives.toml", 1.5)
    quiet = replace(scenario, blast=replace(scenario.blast, explosion=False))
    summary, results = run(quiet, tmp_path / "quiet")
    shards = results.of_kind("shard")
    assert summary["connections"]["broken"] <= 0.03 * summary["connections"]["count"]  # slivers between members
    assert (results.places_m[0, shards, 2] - results.places_m[-1, shards, 2]).max() < sag_m
    assert summary["charges"] is summary["blast"] is None

    summary, results = run(scenario, tmp_path / "loud")
    before = results.times_s < scenario.blast.start_s
    assert (~results.intact[before]).sum(axis=1).max() <= 0.03 * summary["connections"]["count"]
    assert summary["connections"]["broken"] > 0.1 * summary["connections"]["count"]
    deck = shards[results.places_m[0, shards, 2] > results.places_m[0, shards, 2].max() - 0.5]
    inner = deck[abs(results.places_m[0, deck, 0] - spans_m / 2.0) < 0.4 * spans_m]
    fallen = (results.places_m[0, inner, 2] - results.places_m[-1, inner, 2]) / results.places_m[0, inner, 2]
    assert np.median(fallen) > 0.3
    # Every charge is below the deck: each shard of it gets its blast upwards, and away from the nearest charge.
    impulses = results.blast_impulses_ns.sum(axis=0)[deck]
    assert (impulses[:, 2] > 0.0).all()
    assert summary["charges"]["mass_kg"] == sum(charge.mass_kg for charge in scenario.charges)
    assert (tmp_path / "loud" / "explosion_log.csv").stat().st_size > 1000


def test_fields_and_direct_loads_agree_where_nothing_breaks(blender, tmp_path):
    scenario = shortened("two_spans_explosives.toml", 0.6)
    scenario = replace(scenario, connections=replace(scenario.connections, breaking_force_n=1e12))
    totals = []
    for apply in ("fields", "direct"):
        _, results = run(replace(scenario, blast=replace(scenario.blast, apply=apply)), tmp_path / apply)
        totals.append(results.blast_impulses_ns.sum(axis=0))
    sizes = np.linalg.norm(totals[0], axis=1)
    # The bridge moves by millimetres before the second charges go off, a little differently either way.
    np.testing.assert_array_less(np.linalg.norm(totals[0] - totals[1], axis=1), 0.002 * sizes.max())


def test_delays_load_one_after_the_other(blender, tmp_path):
    scenario = shortened("two_spans_explosives.toml", 0.6)
    scenario = replace(scenario, blast=replace(scenario.blast, apply="direct"))
    together = replace(scenario, charges=tuple(replace(charge, delay_ms=0.0) for charge in scenario.charges))
    spans = []
    for each, name in ((scenario, "delays"), (together, "together")):
        summary, _ = run(each, tmp_path / name)
        detonations = [charge["detonation_s"] for charge in summary["charges"]["charges"]]
        assert detonations == pytest.approx([0.425, 0.4, 0.425] if name == "delays" else [0.4, 0.4, 0.4])
        assert summary["charges"]["largest_mass_at_once_kg"] == (2000.0 if name == "delays" else 3000.0)
        spans.append(summary["blast"]["last_load"]["time_s"] - summary["blast"]["first_load"]["time_s"])
    assert spans[0] >= spans[1]
