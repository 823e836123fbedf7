# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars and nodes without which a truss comes down: against OpenSees, and against its mirror image."""

import csv
from dataclasses import replace

import numpy as np
import pytest
from support.checkout import EXAMPLES, ROOT
from support.steelwork import bar, node, steel_scenario

from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.stages.stages import criticality
from bridge_demolition_addon.model.stages.standing import StandingBridge
from bridge_demolition_addon.model.structure.model import build_model

pytestmark = pytest.mark.slow

FILE = EXAMPLES / "steel" / "truss_severed.toml"
TABLE = ROOT / "docs" / "data" / "lost_bars_by_opensees.csv"

SECOND_ORDER = 0.08
"""Bars are cut in three pieces here, and into 8 beams there, which makes moments of bars fixed at both ends larger
(docs/steel.md). Nodes have plates here, and are points there."""

DOUBTFUL = 0.01
"""About 1, where either program may be on either side."""


def truss(deck_kg_m):
    scenario = read_scenario(FILE)
    (span,) = scenario.steelwork.trusses
    return replace(scenario, steelwork=replace(scenario.steelwork, trusses=(replace(span, deck_kg_m=deck_kg_m),)))


def without(bridge, name):
    """Return which connections (m,) are intact without a member."""
    model = bridge.model
    own = [number for number, member in enumerate(model.members) if member.name == name]
    gone = np.flatnonzero(np.isin(model.member_of_shard, own))
    return ~np.isin(model.connections.pairs, gone).any(axis=1)


def bridge_of(scenario):
    return StandingBridge(build_model(scenario), scenario.joints)


@pytest.mark.long
@pytest.mark.parametrize("deck_kg_m", [5000.0, 7500.0])
def test_without_each_bar_the_others_are_used_as_opensees_says(deck_kg_m):
    """Second order, elastic: docs/data/lost_bars_by_opensees.csv. A bar above 1 is above its plastic resistance."""
    with TABLE.open(encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if float(row["deck_kg_m"]) == deck_kg_m]
    bridge = bridge_of(truss(deck_kg_m))
    overloads, by_opensees = set(), set()
    for row in rows:
        used = float(np.nanmax(bridge.unbroken(without(bridge, row["lost"])).alone))
        expected = float(row["utilisation_2nd_order"])
        assert used == pytest.approx(expected, rel=SECOND_ORDER), row["lost"]
        if abs(expected - 1.0) > DOUBTFUL:
            overloads |= {row["lost"]} if used > 1.0 else set()
            by_opensees |= {row["lost"]} if expected > 1.0 else set()
    assert len(rows) == 93 and 15 < len(by_opensees) < 80
    assert overloads == by_opensees


@pytest.fixture(scope="module")
def example():
    return bridge_of(read_scenario(FILE))


def falls_kg(bridge, name):
    whole = np.ones(len(bridge.model.connections))
    nothing = np.zeros((6, len(bridge.model.shards)))
    return float(bridge.model.masses_kg[bridge.comes_down(without(bridge, name), whole, nothing, 1.0)].sum())


@pytest.mark.long
def test_without_a_node_at_either_side_the_truss_comes_down_at_the_same_load(example):
    """But for the bracing, which ends in the right nodes, both are mirror images."""
    whole, nothing = np.ones(len(example.model.connections)), np.zeros((6, len(example.model.shards)))
    left, right = (
        example.collapse_factor(without(example, name), whole, nothing) for name in ("span L0 left", "span L0 right")
    )
    assert left == pytest.approx(right, rel=0.03)
    assert max(left, right) < 1.0


def mirrored():
    """Return the truss with its left on the right and its bracing turned round: each bar and node has its name."""
    steelwork = read_scenario(FILE).steelwork
    nodes = []
    for table in steelwork.all_nodes:
        x, y, z = table.position_m
        held = {"support": table.support} if table.support else {}
        nodes.append(node(table.name, x, z, -y, mass_kg=table.mass_kg, **held))
    members = [bar(table.name, *table.nodes, table.section, kind=table.kind) for table in steelwork.all_members]
    return steel_scenario(nodes, members, grade=steelwork.grade, pieces=steelwork.pieces)


@pytest.fixture(scope="module")
def mirror_image():
    return bridge_of(mirrored())


@pytest.mark.long
@pytest.mark.parametrize("name", ["span L0 left", "span L0 right"])
def test_the_mirror_image_of_a_truss_loses_as_much(example, mirror_image, name):
    """What comes down depends on the bracing, not on the side: symmetry."""
    assert falls_kg(mirror_image, name) == pytest.approx(falls_kg(example, name), rel=0.02)


def test_what_a_bar_carries_falls_to_those_beside_it():
    """Three ties hold a stiff beam; without the middle one those at the ends carry half of the weight each."""
    nodes = [node(f"top {number}", 2.0 * number, 9.0, support="fixed") for number in range(3)]
    nodes += [node(f"hook {number}", 2.0 * number, 4.0, mass_kg=10_000.0) for number in range(3)]
    ties = [bar(f"tie {number}", f"top {number}", f"hook {number}", "FLAT 60x20", pieces=2) for number in range(3)]
    beams = [bar(f"beam {number}", f"hook {number}", f"hook {number + 1}", "HEB 400", pieces=4) for number in range(2)]
    bridge = bridge_of(steel_scenario(nodes, [*ties, *beams], grade="S235"))
    found = {effect.member: effect for effect in criticality(bridge, lambda done, total: None)}
    weight_n = 9.80665 * 30_000.0
    plastic_n = 235e6 * 0.06 * 0.02
    # The beams themselves weigh 2 % of the load, and ties bend a little.
    assert found["tie 1"].used == pytest.approx(0.5 * weight_n / plastic_n, rel=0.1)
    assert found["tie 1"].falls_kg == 0.0
