# SPDX-License-Identifier: GPL-3.0-or-later
"""Forces of bearings below girders that share a slab, in coarse shards and by any seed, against a grillage of beams and
against meshes of bricks (OpenSees)."""

import csv
import itertools

import numpy as np
import pytest
from reference.grillage import Grillage
from support.checkout import ROOT

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.structure.bearings import shards_at
from bridge_demolition_addon.model.structure.equilibrium import at_rest, held_motions, inertias_of, loads_of
from bridge_demolition_addon.model.structure.model import build_model

TEXT = """
[scenario]
title = "girders under a slab"
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
[bridge.girders]
number = {number}
width_m = {web}
depth_m = {deep}
[bridge.abutments]
length_m = 0.8
width_m = {width}
{height}
[bridge.bearings]
tension = true
[[supports]]
member = "abutment"
[fracture]
shards = {shards}
[[fracture.members]]
member = "abutment"
shards = 1
{of_piers}
[connections]
type = "FIXED"
method = "face"
material = "reinforced concrete slab"
stiffness = "elastic"
strength_factor = 50.0
[shards]
start_deactivated = false
"""
PIERS = "[bridge.piers]\ncolumns = {}\ncolumn_length_m = 0.8\ncolumn_width_m = 1.0\nheight_m = 4.0"
OF_PIERS = '[[supports]]\nmember = "pier"\n[[fracture.members]]\nmember = "pier"\nshards = 1'
FOUR = {"spans": [16.0], "width": 8.0, "slab": 0.25, "number": 4, "web": 0.4, "deep": 0.9}
THREE = {"spans": [25.0, 25.0], "width": 15.0, "slab": 0.4, "number": 3, "web": 1.5, "deep": 1.6}

FIVE = {**THREE, "spans": [24.5, 28.0, 29.0, 28.0, 24.5]}


def planned(bridge, shards, seed, skew=0.0):
    height, of_piers = (
        ("height_m = 4.0", "") if len(bridge["spans"]) == 1 else (PIERS.format(bridge["number"]), OF_PIERS)
    )
    keys = {**bridge, "shards": shards, "seed": seed, "height": height, "of_piers": of_piers, "skew": skew}
    plan = scenario_from_text(TEXT.format(**keys))
    return plan, build_model(plan)


def bearings_kn(bridge, plan, model, loads=None):
    """Upward forces (supports, girders) under its own weight, and loads (6, n) on shards."""
    masses, held = np.where(model.fixed, 0.0, model.masses_kg), held_motions(model, plan.joints)
    rest = at_rest(
        *(model.connections, model.stiffness, masses, inertias_of(model), model.centres_m, held),
        loads=loads,
        pads=model.bearings.springs,
    )
    supports = ["abutment 1", *(f"pier {number}" for number in range(1, len(bridge["spans"]))), "abutment 2"]
    found = np.zeros((len(supports), bridge["number"]))
    for force in model.bearings.forces(loads_of(model, rest)):
        girder, support = force.name.split(" on ")
        row = next(row for row, name in enumerate(supports) if support.startswith(name))
        found[row, int(girder.split()[-1]) - 1] = 1e-3 * force.force_n[2]
    return found


def shares_of_machine(bridge, plan, model, place_m):
    """Part of 50 t on 1 m × 0.4 m that each girder carries (g,)."""
    spread = (np.arange(8) + 0.5) / 8 - 0.5
    at, aside = (grid.ravel() for grid in np.meshgrid(place_m[0] + spread, place_m[1] + 0.4 * spread))
    decks = [row for row, member in enumerate(model.members) if member.kind == "deck"]
    slab = np.flatnonzero(np.isin(model.member_of_shard, decks))
    places = np.column_stack((at, aside, np.full(at.size, model.members[decks[0]].solid.bounds[1, 2] - 0.01)))
    loads, force = np.zeros((6, len(model.shards))), np.array([0.0, 0.0, -50e3 * STANDARD_GRAVITY_M_S2 / at.size])
    for place, shard in zip(places, shards_at(places, slab, model.shards), strict=True):
        loads[:, shard] += np.concatenate((force, np.cross(place - model.centres_m[shard], force)))
    more = bearings_kn(bridge, plan, model, loads) - bearings_kn(bridge, plan, model)
    return more.sum(axis=0) / (50.0 * STANDARD_GRAVITY_M_S2)


def by_bricks(case):
    """Parts (4,) of 50 t, by `scripts/experiments/bridges_by_opensees.py`."""
    with (ROOT / "docs" / "data" / "bridges_by_opensees.csv").open(encoding="utf-8") as file:
        found = {row["quantity"]: float(row["value"]) for row in csv.DictReader(file)}
    return np.array([found[f"{case}: girder {girder}"] for girder in range(1, 5)])


def by_grillage_kn(bridge):
    supports, spacing = np.cumsum([0.0, *bridge["spans"]]), bridge["width"] / bridge["number"]
    within = (np.linspace(*ends, 33)[1:] for ends in itertools.pairwise(supports))
    stations = np.concatenate(([-0.4, 0.0], *within, [supports[-1] + 0.4]))
    girders = spacing * (np.arange(bridge["number"]) - (bridge["number"] - 1) / 2.0)
    widths = np.full(bridge["number"], spacing)
    grillage = Grillage(girders, stations, bridge["slab"], (bridge["web"], bridge["deep"]), widths, 33e9, 33e9 / 2.4)
    grillage.put_weight(2500.0 * STANDARD_GRAVITY_M_S2)
    return 1e-3 * grillage.reactions_n(supports)


def test_the_grillage_shares_an_eccentric_load_as_rigid_cross_beams_do():
    """Guyon, Massonnet and Bareš: with cross beams that hardly bend, girder i has 1/n + α e y_i / Σ y², where α is 1
    over 1 + G ΣJ L² / (12 E Σ I y²), supports hold the twist, and the load is at mid-span."""
    girders = np.array([-3.0, -1.0, 1.0, 3.0])
    grillage = Grillage(girders, np.linspace(0.0, 16.0, 33), 0.5, (0.4, 0.9), np.full(4, 2.0), 30e9, 12.5e9)
    bending, torsion = grillage.girder(0)
    alpha = 1.0 / (1.0 + 12.5e9 * 4.0 * torsion * 16.0**2 / (12.0 * 30e9 * bending * (girders @ girders)))
    grillage.put(8.0, 3.0, 1.0)
    shares = grillage.reactions_n([0.0, 16.0]).sum(axis=0)
    assert shares == pytest.approx(0.25 + alpha * 3.0 * girders / (girders @ girders), abs=0.05)


@pytest.mark.parametrize(("shards", "seed"), [(60, 1), (100, 11), (140, 47)])
def test_each_girder_of_four_has_its_share(shards, seed):
    assert bearings_kn(FOUR, *planned(FOUR, shards, seed)) == pytest.approx(by_grillage_kn(FOUR), rel=0.03)


@pytest.mark.parametrize(("shards", "seed"), [(70, 5), (100, 1), (160, 2)])
def test_three_girders_over_two_spans_have_theirs(shards, seed):
    """Beams of this depth shear, which the grillage has not: their end supports carry 1 to 2 % more."""
    found = bearings_kn(THREE, *planned(THREE, shards, seed))
    assert found == pytest.approx(by_grillage_kn(THREE), rel=0.05)
    assert found == pytest.approx(found[:, ::-1], rel=0.02)  # as symmetric as the bridge is


@pytest.mark.parametrize(("shards", "seed"), [(60, 1), (100, 2)])
def test_girders_have_two_pieces_in_each_of_five_spans_by_few_shards_too(shards, seed):
    plan, model = planned(FIVE, shards, seed)
    assert bearings_kn(FIVE, plan, model) == pytest.approx(by_grillage_kn(FIVE), rel=0.05)
    # 6 above supports and 10 between them, each of 3 shards and 3 below; what stands below is 14 more.
    assert len(model.shards) >= 6 * 16 + 14


@pytest.mark.slow
@pytest.mark.parametrize(("bridge", "shards", "seed"), [(FOUR, 300, 3), (FOUR, 400, 4), (THREE, 300, 3)])
def test_fine_ones_have_theirs_too(bridge, shards, seed):
    assert bearings_kn(bridge, *planned(bridge, shards, seed)) == pytest.approx(by_grillage_kn(bridge), rel=0.05)


@pytest.mark.parametrize(("shards", "seed"), [(60, 1), (100, 29), pytest.param(200, 2, marks=pytest.mark.long)])
def test_girders_share_a_machine_as_bricks_do(shards, seed):
    plan, model = planned(FOUR, shards, seed)
    for case, place_m in (
        ("outer", (8.0, 3.0)),
        ("inner", (8.0, 1.0)),
        ("outer, at a quarter of the span", (4.0, 3.0)),
    ):
        assert shares_of_machine(FOUR, plan, model, place_m) == pytest.approx(by_bricks(case), abs=0.035), case


@pytest.mark.parametrize(("shards", "seed"), [(60, 3), pytest.param(100, 11, marks=pytest.mark.long)])
def test_skewed_girders_share_weight_and_a_machine_as_bricks_do(shards, seed):
    """The same mesh of bricks carries 381, 321, 324 and 390 kN of the weight."""
    plan, model = planned(FOUR, shards, seed, skew=25.0)
    own = bearings_kn(FOUR, plan, model)
    assert own == pytest.approx(np.array([[144.1, 166.1, 168.1, 230.2], [237.4, 154.7, 156.3, 160.1]]), rel=0.08)
    assert own.sum() == pytest.approx(1416.9, rel=1e-3)
    place_m = (8.0 + 3.0 * np.tan(np.radians(25.0)), 3.0)
    shares = shares_of_machine(FOUR, plan, model, place_m)
    assert shares == pytest.approx(by_bricks("outer, skew of 25°"), abs=0.045)
