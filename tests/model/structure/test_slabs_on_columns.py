# SPDX-License-Identifier: GPL-3.0-or-later
"""Forces of single columns below slabs, at any seed and number of shards, against plates by OpenSees."""

import csv

import numpy as np
import pytest
from support.checkout import ROOT

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.structure.bearings import shards_at
from bridge_demolition_addon.model.structure.equilibrium import at_rest, held_motions, inertias_of, loads_of
from bridge_demolition_addon.model.structure.model import build_model

TEXT = """
[scenario]
title = "slab on columns"
seed = {seed}
[time]
duration_s = 1.0
[bridge]
density_kg_m3 = 2500
span_lengths_m = {spans}
skew_deg = {skew}
[bridge.deck]
width_m = {width}
thickness_m = {slab}
overhang_m = 0.4
{abutments}
[bridge.piers]
columns = {columns}
column_length_m = {column}
column_width_m = {column}
height_m = 6.0
[bridge.bearings]
tension = true
{held}
[fracture]
shards = {shards}
[connections]
type = "FIXED"
method = "face"
material = "reinforced concrete slab"
stiffness = "elastic"
strength_factor = 50.0
[shards]
start_deactivated = false
{more}
"""
HELD = '[[supports]]\nmember = "{}"\n'
FOUR = {"spans": [12.0, 12.0], "width": 10.0, "slab": 0.7, "columns": 4, "column": 0.8}
SLABS = {
    "two spans on four columns": FOUR,
    "two spans on three columns": {"spans": [9.0, 9.0], "width": 12.0, "slab": 0.5, "columns": 3, "column": 0.6},
    "three spans on two columns": {"spans": [12.0, 15.0, 12.0], "width": 9.0, "slab": 0.8, "columns": 2, "column": 1.0},
    "wide on four columns": {"spans": [8.0, 8.0], "width": 16.0, "slab": 0.45, "columns": 4, "column": 0.5},
    "deep on five columns": {"spans": [14.0, 14.0], "width": 12.0, "slab": 0.9, "columns": 5, "column": 0.8},
    "one span on two rows of four": {"spans": [10.0], "width": 10.0, "slab": 0.6, "columns": 4, "column": 0.8},
    "on columns that shorten": FOUR,
    "ten columns": {**FOUR, "columns": 10, "column": 0.5},
    "skew of 15°": {**FOUR, "skew": 15.0},
    "skew of 25°": {**FOUR, "skew": 25.0},
}


def by_opensees(slab):
    """What bearings carry by `scripts/experiments/slabs_by_opensees.py`."""
    with (ROOT / "docs" / "data" / "slabs_by_opensees.csv").open(encoding="utf-8") as file:
        return {row["bearing"]: float(row["value"]) for row in csv.DictReader(file) if row["slab"] == slab}


def planned(name, shards, seed, more=""):
    keys = {"skew": 0.0, **SLABS[name]}
    ends = name != "one span on two rows of four"
    held = (HELD.format("abutment") if ends else "") + ("" if "shorten" in name else HELD.format("pier"))
    abutments = f"[bridge.abutments]\nlength_m = 0.8\nwidth_m = {keys['width']}" if ends else ""
    plan = scenario_from_text(TEXT.format(**keys, shards=shards, seed=seed, held=held, abutments=abutments, more=more))
    return plan, build_model(plan)


def bearings_kn(plan, model, loads=None):
    """Upward forces of bearings under the bridge's own weight, and loads (6, n) on shards."""
    masses, held = np.where(model.fixed, 0.0, model.masses_kg), held_motions(model, plan.joints)
    rest = at_rest(
        *(model.connections, model.stiffness, masses, inertias_of(model), model.centres_m, held),
        loads=loads,
        pads=model.bearings.springs,
    )
    forces = model.bearings.forces(loads_of(model, rest))
    return {force.name.removeprefix("deck on "): 1e-3 * float(force.force_n[2]) for force in forces}


@pytest.mark.parametrize(("shards", "seed"), [(60, 1), (150, 7), pytest.param(400, 3, marks=pytest.mark.long)])
@pytest.mark.parametrize("name", [name for name in SLABS if name != "ten columns"])
def test_each_column_has_its_share(name, shards, seed):
    """Within 5 %; at 25° the lattice is so skewed that triangles of points are no more acute, and a plate not even."""
    most = 0.06 if name == "skew of 25°" else 0.05
    assert bearings_kn(*planned(name, shards, seed)) == pytest.approx(by_opensees(name), rel=most)


@pytest.mark.parametrize("seed", [2, 11])
def test_another_seed_cuts_otherwise_and_shares_alike(seed):
    (first, one), (plan, other) = (
        planned("two spans on four columns", 60, 1),
        planned("two spans on four columns", 60, seed),
    )
    assert not np.array_equal(one.centres_m, other.centres_m)
    assert bearings_kn(plan, other) == pytest.approx(bearings_kn(first, one), rel=0.03)


@pytest.mark.parametrize(("name", "place_m"), [("over an outer column", (12.0, 3.75)), ("in a span", (6.0, 3.75))])
def test_columns_share_a_machine(name, place_m):
    """50 t on 1 m × 1 m, within 0.03 of it."""
    plan, model = planned("two spans on four columns", 100, 5)
    spread = (np.arange(8) + 0.5) / 8 - 0.5
    at, aside = (grid.ravel() for grid in np.meshgrid(place_m[0] + spread, place_m[1] + spread))
    deck = [member.name for member in model.members].index("deck")
    top_m = model.members[deck].solid.bounds[1, 2]
    places = np.column_stack((at, aside, np.full(at.size, top_m - 0.01)))
    loads, force = np.zeros((6, len(model.shards))), np.array([0.0, 0.0, -50e3 * STANDARD_GRAVITY_M_S2 / at.size])
    below = shards_at(places, np.flatnonzero(model.member_of_shard == deck), model.shards)
    for place, shard in zip(places, below, strict=True):
        loads[:, shard] += np.concatenate((force, np.cross(place - model.centres_m[shard], force)))
    own, loaded = bearings_kn(plan, model), bearings_kn(plan, model, loads)
    shares = {bearing: (loaded[bearing] - own[bearing]) / (50.0 * STANDARD_GRAVITY_M_S2) for bearing in own}
    assert shares == pytest.approx(by_opensees(f"50 t {name}"), abs=0.03)


def test_a_lift_takes_what_its_box_holds_of_such_a_slab():
    """A box of 3.1 m × 2.3 m × 0.7 m beside the lattice weighs 2500 kg for each m³."""
    lift = (
        '[[lifts]]\nname = "strip"\nmembers = ["deck"]\nlowest_corner_m = [4.0, -1.0, 6.0]\n'
        "highest_corner_m = [7.1, 1.3, 7.0]\nfrom_s = 0.2\nlift_s = 0.5\ncapacity_kg = 20000\ncrane_m = [5.0, 9.0]\n"
        "sling_points_m = [[4.5, 0.0, 6.6], [6.5, 0.0, 6.6]]\n"
    )
    _, model = planned("two spans on four columns", 100, 1, more=lift)
    low, high = np.array([4.0, -1.0]) - 1e-6, np.array([7.1, 1.3]) + 1e-6
    within = [(shard.bounds[0, :2] > low).all() and (shard.bounds[1, :2] < high).all() for shard in model.shards]
    assert model.masses_kg[within].sum() == pytest.approx(2500.0 * 3.1 * 2.3 * 0.7, rel=1e-3)
    assert model.masses_kg.sum() == pytest.approx(sum(2500.0 * member.volume_m3 for member in model.members))


def test_columns_that_are_very_close_do_not_make_very_many_shards():
    """Ten columns on 10 m, a point every 0.5 m: 900 in a lattice, which is not taken for 100."""
    _, model = planned("ten columns", 100, 1)
    assert not model.has_lattices and len(model.shards) == 100
    _, model = planned("two spans on four columns", 100, 1)
    assert model.has_lattices


def test_rigid_ones_are_cut_as_before():
    _, elastic = planned("two spans on four columns", 60, 1)
    text = TEXT.format(**{"skew": 0.0, **FOUR}, shards=60, seed=1, held=HELD.format("pier"), abutments="", more="")
    rigid = build_model(scenario_from_text(text.replace('"elastic"', '"rigid"')))
    assert len(rigid.shards) == 60
    assert len(elastic.shards) > 60
