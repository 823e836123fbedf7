# SPDX-License-Identifier: GPL-3.0-or-later
"""Box girders in shards, on two bearings under each axis: what each carries, against plates by OpenSees, and at which
load they come down, against plastic theory."""

import csv

import numpy as np
import pytest
from support.checkout import ROOT

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.stages.stability import stability_of
from bridge_demolition_addon.model.structure.bearings import shards_at
from bridge_demolition_addon.model.structure.equilibrium import at_rest, held_motions, inertias_of, loads_of
from bridge_demolition_addon.model.structure.member_layers import layers_of_members
from bridge_demolition_addon.model.structure.model import build_model

TEXT = """
[scenario]
title = "box girder"
seed = {seed}
[time]
duration_s = 1.0
[bridge]
density_kg_m3 = 2500
span_lengths_m = {spans}
[bridge.deck]
width_m = {width}
thickness_m = 0.25
overhang_m = 0.5
[bridge.box_girder]
width_m = 5.0
depth_m = {deep}
web_thickness_m = 0.4
bottom_thickness_m = 0.25
[bridge.piers]
columns = 2
column_length_m = 0.8
column_width_m = 2.5
height_m = 5.0
{tables}
[[supports]]
member = "pier"
[[fracture.members]]
member = "pier"
shards = 1
[fracture]
shards = {shards}
[connections]
type = "FIXED"
method = "face"
material = "reinforced concrete slab"
stiffness = "elastic"
[shards]
start_deactivated = false
"""
BEARING = """
[[bearings]]
members = ["deck", "pier {axis} column {column}"]
kind = "{kind}"
tension = true
positions_m = [{across}]
stiffness_mn_m = 12000
"""
BOXES = {
    "25 + 30 + 25 m": {"spans": [25.0, 30.0, 25.0], "width": 10.0, "deep": 1.5},
    "12 + 16 + 12 m": {"spans": [12.0, 16.0, 12.0], "width": 9.0, "deep": 1.3},
}
DESIGNED = '[bridge.reinforcement]\ndesigned_for = "LM1"\n[bridge.bearings]\n'


def planned(box, shards, seed):
    """On bearings below the middles of both webs, 2.3 m from the axis: columns are 2.5 m wide each."""
    tables = "".join(
        BEARING.format(axis=axis, column=column, kind="pinned" if axis == 1 else "rocker", across=across)
        for axis in range(1, len(box["spans"]) + 2)
        for column, across in ((1, -1.05), (2, 1.05))
    )
    plan = scenario_from_text(TEXT.format(**box, shards=shards, seed=seed, tables=tables))
    return plan, build_model(plan)


def carried_kn(plan, model, loads=None):
    masses, held = np.where(model.fixed, 0.0, model.masses_kg), held_motions(model, plan.joints)
    rest = at_rest(
        *(model.connections, model.stiffness, masses, inertias_of(model), model.centres_m, held),
        loads=loads,
        pads=model.bearings.springs,
    )
    return 1e-3 * np.array([bearing.force_n[2] for bearing in model.bearings.forces(loads_of(model, rest))])


def parts_of_machine(box, plan, model):
    """Parts of 50 t on 1 m along the road in the middle of the bridge, 0.7 m from the edge of its cantilever."""
    slab = np.flatnonzero(model.member_of_shard == [member.kind for member in model.members].index("deck"))
    along = sum(box["spans"]) / 2.0 + (np.arange(8) + 0.5) / 8.0 - 0.5
    places = np.column_stack((along, np.full(8, box["width"] / 2.0 - 0.7), np.full(8, box["deep"] + 5.24)))
    loads, force = np.zeros((6, len(model.shards))), np.array([0.0, 0.0, -50e3 * STANDARD_GRAVITY_M_S2 / 8.0])
    for place, shard in zip(places, shards_at(places, slab, model.shards), strict=True):
        loads[:, shard] += np.concatenate((force, np.cross(place - model.centres_m[shard], force)))
    return (carried_kn(plan, model, loads) - carried_kn(plan, model)) / (50.0 * STANDARD_GRAVITY_M_S2)


def by_plates(load):
    with (ROOT / "docs" / "data" / "boxes_by_opensees.csv").open(encoding="utf-8") as file:
        return np.array([float(row["value"]) for row in csv.DictReader(file) if row["load"] == load])


@pytest.mark.parametrize("name", BOXES)
@pytest.mark.parametrize(("shards", "seed"), [(60, 1), (100, 29), (400, 3)])
def test_each_bearing_carries_what_it_does_below_plates(name, shards, seed):
    plan, model = planned(BOXES[name], shards, seed)
    assert carried_kn(plan, model) == pytest.approx(by_plates(f"weight of {name}"), rel=0.04)


@pytest.mark.parametrize("name", BOXES)
@pytest.mark.parametrize(("shards", "seed", "off"), [(60, 1, 0.09), (100, 29, 0.035), (400, 3, 0.035)])
def test_a_machine_on_one_cantilever_twists_it_as_plates(name, shards, seed, off):
    """Pieces are stiff against twist: in few of them a machine twists the bridge up to half a piece beside it."""
    box = BOXES[name]
    parts = parts_of_machine(box, *planned(box, shards, seed))
    assert parts == pytest.approx(by_plates(f"50 t on a cantilever of {name}"), abs=off)
    # Statics: all of it, and its moment about the axis of the bridge.
    assert parts.sum() == pytest.approx(1.0, abs=1e-3)
    twisting = (parts * np.tile([-2.3, 2.3], 4)).sum()
    assert twisting == pytest.approx(box["width"] / 2.0 - 0.7, rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize(("shards", "seed"), [(60, 3), (160, 3)])
def test_its_webs_resist_shear_by_their_links_so_that_it_comes_down_by_hinges(shards, seed):
    """The middle span has hinges over both piers and in its middle: 8 (M + M') / (w L²). Cracks between its plates, and
    shear beside, take up to a fifth; without links across cuts that are square it came down at 0.4 of that."""
    box = BOXES["12 + 16 + 12 m"]
    keys = {**box, "shards": shards, "seed": seed, "tables": DESIGNED}
    plan = scenario_from_text(TEXT.format(**keys))
    model = build_model(plan)
    compression_pa = float(plan.joints[0].strength.compression_pa)
    deck = next(member for member in model.members if member.kind == "deck")
    along = [group for group in layers_of_members(model.layers, model.members) if group.axes[:2] == (0, 2)]
    sagging, hogging = (
        next(g for g in along if g.between_m[0] <= at < g.between_m[1]).section(compression_pa).moments_nm()[side]
        for at, side in ((20.0, 0), (12.0, 1))
    )
    weight_n_m = deck.mass_kg * STANDARD_GRAVITY_M_S2 / 41.0
    theory = 8.0 * (sagging + hogging) / (weight_n_m * 16.0**2)
    factor = stability_of(plan, model, with_factor=True).load_factor
    assert 0.8 * theory <= factor <= 1.05 * theory
