# SPDX-License-Identifier: GPL-3.0-or-later
"""Reactions of each support, held against statics of beams and frames, and how they are tabled."""

import csv
import re
from dataclasses import replace

import numpy as np
import pytest
from support.bearing_decks import PINNED_AND_ROCKERS, deck_text
from support.bearing_decks import WEIGHT_N_M as DECK_N_M
from support.scenarios import I235
from support.stage_beams import (
    BLOCK_M,
    DENSITY_KG_M3,
    DEPTH_M,
    HEIGHT_M,
    SCENARIO,
    WEIGHT_N_M,
    WIDTH_M,
    add_block,
    beam_file,
    beam_of_blocks,
    staged,
)

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.scenario import Equipment, Support
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.reactions import supports_of
from bridge_demolition_addon.model.stages.stages import stages_of
from bridge_demolition_addon.model.stages.standing import StandingBridge, made_elastic

pytestmark = pytest.mark.slow

EXACT = 1e-3
"""Of the weight: loads are in the axes of shards that have turned a little as the beam deflected."""


def reactions(bridge, stage):
    """Force and moment (3,) of each support on the bridge by its name, N and N·m."""
    return {support.name: support.reaction(stage.standing.loads) for support in supports_of(bridge.model)}


def test_a_simple_beam_has_half_its_weight_at_each_bearing_and_no_moment(tmp_path):
    blocks = 10
    [stage], bridge = staged(beam_of_blocks(tmp_path, blocks))
    own_n, length_m = WEIGHT_N_M * blocks * BLOCK_M, blocks * BLOCK_M
    for x_m, (force_n, moment_nm), support in zip(
        (0.0, length_m), reactions(bridge, stage).values(), supports_of(bridge.model), strict=True
    ):
        assert force_n == pytest.approx([0.0, 0.0, own_n / 2.0], abs=EXACT * own_n)
        assert moment_nm == pytest.approx(np.zeros(3), abs=EXACT * own_n * length_m)
        assert support.point_m == pytest.approx([x_m, 0.0, HEIGHT_M])


def test_a_beam_with_an_overhang_lifts_off_its_bearing(tmp_path):
    """Of length l on a prop at a: w l² / 2a there, and the rest, which is uplift for a < l / 2, at its start."""
    blocks, prop = 12, 4
    [stage], bridge = staged(beam_of_blocks(tmp_path, blocks, prop=prop, with_end=False))
    length_m, at_m = blocks * BLOCK_M, (prop + 0.5) * BLOCK_M
    own_n = WEIGHT_N_M * length_m
    on_prop_n = own_n * length_m / (2.0 * at_m)
    found = reactions(bridge, stage)
    assert found["prop"][0] == pytest.approx([0.0, 0.0, on_prop_n], abs=EXACT * on_prop_n)
    assert found["start"][0] == pytest.approx([0.0, 0.0, own_n - on_prop_n], abs=EXACT * on_prop_n)
    assert found["start"][0][2] < 0.0


def test_a_continuous_beam_of_two_spans_has_ten_eighths_of_a_span_on_its_prop(tmp_path):
    """3/8, 10/8 and 3/8 of the weight of a span by beam theory.

    That has no shear, which takes 2 % off the prop at a depth of a tenth of the span (S. P. Timoshenko's beam).
    """
    blocks = 21
    [stage], bridge = staged(beam_of_blocks(tmp_path, blocks, prop=blocks // 2))
    on_span_n = WEIGHT_N_M * blocks * BLOCK_M / 2.0
    shares = {name: force_n[2] / on_span_n for name, (force_n, _) in reactions(bridge, stage).items()}
    assert [shares["start"], shares["end"]] == pytest.approx([3.0 / 8.0] * 2, abs=0.02)
    assert shares["prop"] == pytest.approx(10.0 / 8.0, abs=0.04)
    assert sum(shares.values()) == pytest.approx(2.0, rel=EXACT)


CRANE = """
[[equipment]]
name = "crane"
mass_kg = 2000.0
position_m = [1.25, 0.75]
footprint_m = [0.4, 0.4]
from_s = 0.5
"""


def test_an_eccentric_load_on_a_bracket_is_a_moment_at_the_foot_of_its_column(tmp_path):
    """A column of 1 m × 1 m × 4 m, held at its bottom, with a bracket of 1 m × 2 m × 0.5 m beside its top."""
    text = SCENARIO.format(shards=40) + CRANE
    text += add_block(tmp_path, "column", (1.0, 1.0, 4.0), (0.0, 0.0, 2.0))
    text += add_block(tmp_path, "bracket", (1.0, 2.0, 0.5), (1.0, 0.0, 3.75))
    text += '[[supports]]\nmember = "column"\nface = "bottom"\n'
    path = tmp_path / "bracket.toml"
    path.write_text(text, encoding="utf-8")
    (before, after), bridge = staged(path)
    [support] = supports_of(bridge.model)
    assert support.point_m == pytest.approx([0.0, 0.0, 0.0], abs=1e-9) and support.name == "column"
    density_n = DENSITY_KG_M3 * STANDARD_GRAVITY_M_S2
    column_n, bracket_n, crane_n = 4.0 * density_n, density_n, 2000.0 * STANDARD_GRAVITY_M_S2
    held = bridge.model.fixed
    held_n = STANDARD_GRAVITY_M_S2 * bridge.model.masses_kg[held]
    assert support.own_weight_n == pytest.approx(held_n.sum())
    # What is held carries itself: its weight is neither in the force, nor, where it is not above the point, the moment.
    held_nm = (bridge.model.centres_m[held, :2] * held_n[:, None]).sum(axis=0)
    for stage, crane in ((before, 0.0), (after, crane_n)):
        force_n, moment_nm = support.reaction(stage.standing.loads)
        down_n = column_n - held_n.sum() + bracket_n + crane
        assert force_n == pytest.approx([0.0, 0.0, down_n], abs=EXACT * down_n)
        # A weight W at (x, y) has the moment (-y W, x W, 0) about the foot, and the support resists it.
        about_y = 1.0 * bracket_n + 1.25 * crane - held_nm[0]
        about_x = 0.75 * crane - held_nm[1]
        assert moment_nm == pytest.approx([about_x, -about_y, 0.0], abs=2.0 * EXACT * (bracket_n + crane_n))


@pytest.mark.parametrize("by_supports", [False, True])
def test_reactions_of_a_bridge_are_in_balance_with_its_weight_and_a_machine_at_its_edge(by_supports):
    machine = Equipment(name="crane", mass_kg=20_000.0, position_m=(3.0, 3.0), footprint_m=(2.0, 2.0), from_s=0.0)
    scenario = replace(
        I235,
        ball=None,
        fracture=replace(I235.fracture, shards=40),
        connections=replace(
            I235.connections, type="FIXED", method="face", search_radius_m=None, foundation=not by_supports
        ),
        supports=[Support(member="pier", face="bottom")] if by_supports else [],
        equipment=(machine,),
    )
    elastic = made_elastic(scenario)
    bridge = StandingBridge(checked_model(elastic), elastic.joints)
    [stage] = stages_of(elastic, bridge, lambda done, total: None)
    supports = supports_of(bridge.model)
    assert {support.name for support in supports} == {
        f"pier {pier} column {column}" for pier in "12" for column in "12"
    }
    assert {support.kind for support in supports} == {"support" if by_supports else "foundation"}
    moving = ~bridge.model.fixed
    weights_n = STANDARD_GRAVITY_M_S2 * bridge.model.masses_kg[moving]
    machine_n = STANDARD_GRAVITY_M_S2 * machine.mass_kg
    down_n = weights_n.sum() + machine_n
    force_n, moment_nm = np.zeros(3), np.zeros(3)
    for support in supports:
        force, moment = support.reaction(stage.standing.loads)
        assert support.point_m[2] == pytest.approx(0.0, abs=1e-9)
        assert force[2] > 0.0
        force_n, moment_nm = force_n + force, moment_nm + moment + np.cross(support.point_m, force)
    assert force_n == pytest.approx([0.0, 0.0, down_n], abs=EXACT * down_n)
    x, y = (weights_n[:, None] * bridge.model.centres_m[moving, :2]).sum(axis=0) + machine_n * np.array(
        machine.position_m
    )
    assert moment_nm == pytest.approx([y, -x, 0.0], abs=EXACT * down_n * 13.0)


def test_the_faces_of_a_member_are_supports_of_their_own(tmp_path):
    more = '[[supports]]\nmember = "beam"\nface = "end"\n[[supports]]\nmember = "beam"\nface = "start"\n'
    [stage], bridge = staged(beam_file(tmp_path, 4.0, held=(), more=more))
    found = reactions(bridge, stage)
    assert set(found) == {"beam, end", "beam, start"}
    moving_n = STANDARD_GRAVITY_M_S2 * bridge.model.masses_kg[~bridge.model.fixed].sum()
    assert sum(force_n[2] for force_n, _ in found.values()) == pytest.approx(moving_n, rel=EXACT)
    points = {support.name: support.point_m for support in supports_of(bridge.model)}
    assert points["beam, start"] == pytest.approx([0.0, 0.0, HEIGHT_M])
    assert points["beam, end"] == pytest.approx([4.0, 0.0, HEIGHT_M])


def test_the_table_has_a_row_for_each_stage_and_support_whose_sums_are_those_of_the_stages(tmp_path, capfd):
    more = CRANE.replace("1.25, 0.75", "2.0, 0.0")
    path, output = beam_of_blocks(tmp_path, 10), tmp_path / "out"
    path.write_text(path.read_text(encoding="utf-8") + more, encoding="utf-8")
    assert main(["stages", str(path), "--output", str(output)]) == 0
    own_kn, crane_kn = 1e-3 * WEIGHT_N_M * 10 * BLOCK_M, 2.0 * STANDARD_GRAVITY_M_S2
    said = capfd.readouterr().out
    # 2 m from the start of a span of 5 m.
    least, most = own_kn / 2.0 + 0.4 * crane_kn, own_kn / 2.0 + 0.6 * crane_kn
    assert f"supports carry {least:.1f} kN (end) to {most:.1f} kN (start)" in said
    rows = list(csv.DictReader((output / "reactions.csv").open(encoding="utf-8")))
    assert [(row["stage"], row["support"]) for row in rows] == [(s, name) for s in "12" for name in ("start", "end")]
    weight_kn = DENSITY_KG_M3 * STANDARD_GRAVITY_M_S2 * BLOCK_M * WIDTH_M * DEPTH_M / 1e3
    assert [float(row["own_weight_kN"]) for row in rows] == pytest.approx([weight_kn] * 4, rel=1e-5)
    stages = list(csv.DictReader((output / "stages.csv").open(encoding="utf-8")))
    for stage in stages:
        for axis in "xyz":
            forces = [float(row[f"force_{axis}_kN"]) for row in rows if row["stage"] == stage["stage"]]
            assert sum(forces) == pytest.approx(float(stage[f"reaction_{axis}_kN"]), abs=1e-3)


@pytest.mark.long
def test_bearings_are_beside_supports_and_no_part_of_their_sum(tmp_path, capfd):
    """Walls of 4.5 t stand on the ground; the deck that they carry is held down at one end when it loses a wall."""
    bearings = (("pier 1", 'kind = "pinned"\ntension = true'), PINNED_AND_ROCKERS[1])
    removal = '[[removals]]\nmembers = ["pier 3"]\ntime_s = 0.1\n'
    path, output = tmp_path / "deck.toml", tmp_path / "out"
    path.write_text(deck_text(bearings, shards=12, are_held=False, more=removal), encoding="utf-8")
    assert main(["stages", str(path), "--output", str(output)]) == 0
    deck_kn = 1e-3 * DECK_N_M * 26.0
    wall_kn = 1e-3 * 2500.0 * STANDARD_GRAVITY_M_S2 * 0.6 * 3.0 * 1.0
    said = capfd.readouterr().out
    [*_, of_ends] = re.findall(
        r"bearings carry ([-0-9.]+) kN \(deck on pier 1\) to ([0-9.]+) kN \(deck on pier 2\)", said
    )
    assert list(map(float, of_ends)) == pytest.approx([-0.25 * deck_kn, 1.25 * deck_kn], abs=1.0)
    assert "held down against uplift: deck on pier 1" in said
    assert "gone: deck on pier 3" in said
    reactions, of_bearings, stages = (
        list(csv.DictReader((output / name).open(encoding="utf-8")))
        for name in ("reactions.csv", "bearings.csv", "stages.csv")
    )
    assert [row["support"] for row in reactions[:3]] == ["pier 1", "pier 2", "pier 3"]
    assert [row["bearing"] for row in of_bearings[:3]] == [f"deck on pier {number}" for number in (1, 2, 3)]
    for stage, walls in zip(stages, (3, 2), strict=True):
        mine = [
            [float(row["force_z_kN"]) for row in rows if row["stage"] == stage["stage"]]
            for rows in (reactions, of_bearings)
        ]
        assert sum(mine[0]) == pytest.approx(deck_kn + walls * wall_kn, rel=EXACT)
        assert sum(mine[0]) == pytest.approx(float(stage["reaction_z_kN"]), rel=1e-5)
        assert sum(mine[1]) == pytest.approx(deck_kn, rel=EXACT)
        there = slice(0, walls)
        assert mine[0][there] == pytest.approx([force + wall_kn for force in mine[1][there]], abs=EXACT * deck_kn)
    last = of_bearings[3:]
    assert [float(row["force_z_kN"]) for row in last] == pytest.approx(
        [-0.25 * deck_kn, 1.25 * deck_kn, 0.0], abs=EXACT * deck_kn
    )
    assert [float(row["left_share"]) for row in last] == [1.0, 1.0, 0.0]
    assert main(["report", str(output), "--quiet"]) == 0
    page = (output / "report.html").read_text(encoding="utf-8")
    [uplift_kn] = re.findall(r"Stage 2: deck on pier 1 is held down with ([0-9.]+) kN against uplift", page)
    assert float(uplift_kn) == pytest.approx(0.25 * deck_kn, rel=EXACT)
    tabled = list(csv.DictReader((output / "tables" / "bearing_forces.csv").open(encoding="utf-8")))
    assert [row["least_force_z_kN_in_stage"] for row in tabled] == ["2", "1", "1"]
    assert float(tabled[0]["least_force_z_kN"]) == pytest.approx(-0.25 * deck_kn, rel=EXACT)
    assert float(tabled[2]["largest_force_z_kN"]) == float(of_bearings[2]["force_z_kN"])
