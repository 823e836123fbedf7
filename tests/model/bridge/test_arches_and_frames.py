# SPDX-License-Identifier: GPL-3.0-or-later
"""Arch bridges and frames by their sizes: volumes by hand, faces that lie on each other, and what is refused."""

import math

import numpy as np
import pytest
from support.arches_and_frames import ARCH, ARCH_SPANS, DENSITY_KG_M3, FRAME, FRAME_SPANS, scenario_of
from support.meshes import is_closed

from bridge_demolition_addon.engineering.geometry.overlap import hulls, overlaps
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.bridge import bridge_members
from bridge_demolition_addon.model.structure.model import build_model

RIBS = ARCH.replace("width_m = 5.0\nblock", "width_m = 1.2\nribs = 2\nblock").replace(
    'kind = "wall"\ncolumn_length_m = 0.4\ncolumn_width_m = 5.0',
    "columns = 2\ncolumn_length_m = 0.4\ncolumn_width_m = 1.0",
)
HAUNCHES = FRAME + "haunch_length_m = 2.0\nhaunch_depth_m = 0.4\n"
SLANTED = FRAME + "lean_m = 3.0\n"
ON_ABUTMENTS = SLANTED + "[bridge.abutments]\nlength_m = 1.2\nwidth_m = 2.0\n[bridge.bearings]\n"
WALL = "width_m = 2.0\nlean_m"


def members_of(tables, spans):
    """The members of a bridge by their names."""
    return {member.name: member for member in bridge_members(scenario_of(tables, spans).bridge)}


def shoelace(outline_m):
    """Area of a polygon by its corners."""
    x, z = np.array(outline_m).T
    return 0.5 * abs(math.fsum(x * np.roll(z, -1) - np.roll(x, -1) * z))


def test_an_arch_has_the_volumes_of_its_parts_by_hand():
    members = members_of(ARCH, ARCH_SPANS)
    assert list(members) == [
        "deck", "arch", "thrust block 1", "thrust block 2", *(f"pier {number}" for number in range(1, 9))
    ]  # fmt: skip
    assert members["deck"].volume_m3 == pytest.approx(37.8 * 6.0 * 0.4)
    # Parabola with s = 4 f / L = 0.8 at its springings: L/2 (√(1 + s²) + asinh(s) / s) long. Level seats below columns
    # add wedges.
    length = 17.5 * (math.hypot(1.0, 0.8) + math.asinh(0.8) / 0.8)
    arch = members["arch"]
    assert length * 0.7 * 5.0 < arch.volume_m3 < 1.06 * length * 0.7 * 5.0
    # The section at a springing is square to the axis: 0.35 m to either side along (∓s, 1) / √(1 + s²).
    half = 0.35 / math.hypot(1.0, 0.8)
    inside, outside = 1.0 + 0.8 * half, 1.0 + 0.8 * half - 3.0
    block = [(outside, 0.0), (inside, 0.0), (inside, 1.0 - half), (1.0 - 0.8 * half, 1.0 + half), (outside, 1.0 + half)]
    for number in (1, 2):
        assert members[f"thrust block {number}"].volume_m3 == pytest.approx(shoelace(block) * 5.0)
    # Columns stand where the top of the arch is at the higher side of their feet; those of the ends on the blocks.
    assert members["pier 1"].volume_m3 == pytest.approx(0.4 * 5.0 * (9.5 - 1.0 - half))
    seat = members["pier 4"].solid.bounds[0, 2]
    top = 1.0 + 7.0 * (1.0 - (2.3 / 17.5) ** 2) + 0.35  # of the axis over the inner side, and half of the thickness
    assert seat == pytest.approx(top, abs=0.01)
    assert members["pier 4"].mass_kg == pytest.approx(DENSITY_KG_M3 * 0.4 * 5.0 * (9.5 - seat))
    assert all(is_closed(member.solid) for member in members.values())


def test_ribs_stand_below_the_columns_and_share_their_blocks():
    members, one = members_of(RIBS, ARCH_SPANS), members_of(ARCH, ARCH_SPANS)
    ribs = [member for member in members.values() if member.kind == "arch"]
    assert [rib.name for rib in ribs] == ["arch rib 1", "arch rib 2"]
    for rib, across in zip(ribs, (-1.5, 1.5), strict=True):
        assert rib.solid.bounds[:, 1] == pytest.approx([across - 0.6, across + 0.6])
        assert rib.volume_m3 == pytest.approx(one["arch"].volume_m3 * 1.2 / 5.0)
    assert members["thrust block 1"].volume_m3 == pytest.approx(one["thrust block 1"].volume_m3 * 4.2 / 5.0)


def test_a_frame_has_the_volumes_of_its_parts_by_hand():
    members = members_of(HAUNCHES, FRAME_SPANS)
    # Over each leg 0.8 m of haunch, and a triangle over 2 m inside of it; the deck ends at the outer faces.
    assert members["deck"].volume_m3 == pytest.approx(2.0 * (15.8 * 0.7 + 2.0 * (0.8 * 0.4 + 0.5 * 2.0 * 0.4)))
    assert [members[f"leg {number}"].volume_m3 for number in (1, 2)] == pytest.approx([2.0 * 0.8 * 5.1] * 2)
    slanted = members_of(SLANTED, FRAME_SPANS)
    assert slanted["leg 1"].volume_m3 == pytest.approx(2.0 * 0.8 * 5.5)
    assert slanted["leg 1"].solid.bounds[:, 0] == pytest.approx([-3.4, 0.4])
    assert slanted["leg 2"].solid.bounds[:, 0] == pytest.approx([14.6, 18.4])
    assert slanted["deck"].volume_m3 == pytest.approx(2.0 * 15.8 * 0.7)


def test_a_frame_of_three_spans_has_legs_between_abutments():
    scenario = scenario_of(ON_ABUTMENTS.replace("overhang_m = 0.4", "overhang_m = 0.6"), [8.0, 15.0, 8.0])
    names = [member.name for member in bridge_members(scenario.bridge)]
    assert names == ["deck", "abutment 1", "abutment 2", "leg 1", "leg 2"]
    assert [(table.members, table.kind) for table in scenario.bridge.bearing_tables] == [
        (("deck", "abutment 1"), "rocker"),
        (("deck", "abutment 2"), "rocker"),
    ]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("tables", "spans"),
    [
        (ARCH, ARCH_SPANS),
        (ARCH + 'axis = "circle"\n', ARCH_SPANS),
        (RIBS, ARCH_SPANS),
        (HAUNCHES, FRAME_SPANS),
        (HAUNCHES, [12.0, 15.0, 12.0]),
        (SLANTED, FRAME_SPANS),
        (FRAME.replace("leg_width_m = 2.0", "leg_width_m = 0.6\nlegs = 2"), FRAME_SPANS),
    ],
)
def test_parts_fill_members_neighbours_lie_on_each_other_and_shards_are_convex(tables, spans):
    more = "[[reinforcement]]\nmembers = ['deck', 'arch', 'leg']\nspread_mm2_m2 = 5000.0\n"
    more = more.replace("'arch', ", "") if "arch]" not in tables else more.replace(", 'leg'", "")
    scenario = scenario_of(tables, spans, shards=90, more=more)
    members = bridge_members(scenario.bridge)
    for member in members:
        if member.parts:
            assert math.fsum(part.volume for part in member.parts) == pytest.approx(member.volume_m3, rel=1e-12)
    assert len(overlaps([member.solid for member in members]).pairs) == 0
    model = build_model(scenario)
    assert model.masses_kg.sum() == pytest.approx(math.fsum(member.mass_kg for member in members), rel=1e-9)
    assert len(overlaps(hulls(model.shards), 1e-6).pairs) == 0
    # The faces between an arch and its blocks are its sections, and those between legs and the deck are the legs' tops.
    kinds = np.array([*(model.members[index].kind for index in model.member_of_shard), "ground"])
    pairs = np.sort(kinds[model.connections.pairs % len(kinds)], axis=1)
    expected = {"arch": ("arch", "thrust block"), "leg": ("deck", "leg")}
    for kind, pair in expected.items():
        found = model.connections.areas[(pairs == pair).all(axis=1)]
        ends = [member for member in members if member.kind == kind]
        sections = {"arch": 2.0 * 0.7, "leg": 0.8}[kind]
        widths = math.fsum(float(np.ptp(member.solid.vertices[:, 1])) for member in ends)
        assert found.sum() == pytest.approx(sections * widths, rel=1e-6)


@pytest.mark.parametrize(
    ("tables", "spans", "message"),
    [
        (ARCH.replace("rise_m = 7.0", "rise_m = 8.5"), ARCH_SPANS, "bridge.arch.rise_m is 8.5: expected less by"),
        (ARCH.replace("rise_m = 7.0", 'rise_m = 17.0\naxis = "circle"'), ARCH_SPANS, "at most 0.45 times"),
        (ARCH.replace("springing_m = 1.0", "springing_m = 0.2"), ARCH_SPANS, "bridge.arch.springing_m is 0.2"),
        (ARCH.replace("span_m = 35.0", "span_m = 36.9"), ARCH_SPANS, "piers stand beside it on its blocks"),
        (ARCH.replace("block_length_m = 3.0", "block_length_m = 1.0"), ARCH_SPANS, "bridge.arch.block_length_m is 1.0"),
        (ARCH.replace("width_m = 5.0\nblock", "width_m = 4.0\nblock"), ARCH_SPANS, "over what stands on it"),
        (ARCH + "ribs = 2\n", ARCH_SPANS, "1, or as many as bridge.piers.columns, 1"),
        (ARCH + "to_support = 12\n", ARCH_SPANS, "at most 8, the number of supports"),
        (ARCH, [37.0], "expected two spans at least with bridge.arch"),
        (FRAME.replace("overhang_m = 0.4", "overhang_m = 0.2"), FRAME_SPANS, "at most 2 × bridge.deck.overhang_m, 0.4"),
        (FRAME + "haunch_depth_m = 0.3\n", FRAME_SPANS, "both sizes of haunches go together"),
        (FRAME + "haunch_depth_m = 5.45\nhaunch_length_m = 1.0\n", FRAME_SPANS, "of legs"),
        (
            FRAME + "haunch_depth_m = 0.4\nhaunch_length_m = 7.2\n",
            FRAME_SPANS,
            "half of the least distance between legs",
        ),
        (FRAME + "legs = 2\n", FRAME_SPANS, "the legs fit into bridge.deck.width_m"),
        (FRAME + "[bridge.bearings]\n", FRAME_SPANS, "none with bridge.frame without abutments"),
        (FRAME + "[bridge.abutments]\nlength_m = 1.0\nwidth_m = 2.0\n", FRAME_SPANS, "or no leg is left"),
        (FRAME + "[bridge.girders]\nnumber = 2\nwidth_m = 0.3\ndepth_m = 1.0\n", FRAME_SPANS, "none with bridge.frame"),
    ],
)
def test_what_does_not_fit_is_refused_with_its_key(tables, spans, message):
    with pytest.raises(ScenarioError, match=message):
        scenario_of(tables, spans)


RATIOS = "[[bridge.reinforcement.ratios]]\nmember = '{}'\n{}\n"


@pytest.mark.slow
def test_frames_are_not_designed_and_over_arches_only_deck_and_piers_are():
    designed = "[bridge.reinforcement]\ndesigned_for = 'LM1'\n"
    with pytest.raises(ScenarioError, match=r"expected \[\[bridge.reinforcement.ratios\]\] with bridge.frame"):
        scenario_of(FRAME, FRAME_SPANS, more=designed)
    both = designed + RATIOS.format("arch", "top_percent = 0.5\nbottom_percent = 0.5")
    model = build_model(scenario_of(ARCH, ARCH_SPANS, shards=90, more=both))
    assert model.bars is not None
    with pytest.raises(ScenarioError, match="given together"):
        scenario_of(ARCH, ARCH_SPANS, more=both.replace("'arch'", "'deck'"))
