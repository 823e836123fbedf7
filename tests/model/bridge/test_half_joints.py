# SPDX-License-Identifier: GPL-3.0-or-later
"""Half-joints: volumes and contacts of their nibs by hand, reactions of Gerber girders by statics, what is refused."""

from dataclasses import replace

import numpy as np
import pytest
from support.meshes import is_closed
from test_alignments import contact_areas

from bridge_demolition_addon.engineering.geometry.solids import union
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.bridge import bridge_members
from bridge_demolition_addon.model.scenario import (
    Abutments,
    Alignment,
    Bridge,
    Deck,
    Girders,
    HalfJoint,
    Haunches,
    Piers,
)
from bridge_demolition_addon.model.scenario.bridge_parts import BridgeBearings
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.standing import StandingBridge

pytestmark = pytest.mark.slow

FIRST = HalfJoint(span=2, at_m=6, length_m=1.0, gap_m=0.05)
LAST = HalfJoint(span=2, at_m=18, length_m=1.0, gap_m=0.05, carried="before", pinned=False)
PLAIN = Bridge(
    density_kg_m3=2500,
    span_lengths_m=[15, 24, 15],
    deck=Deck(width_m=8, thickness_m=0.8, overhang_m=0.5),
    piers=Piers(columns=2, column_length_m=0.8, column_width_m=0.8, height_m=6),
    abutments=Abutments(length_m=1.0, width_m=8),
    bearings=BridgeBearings(),
)
ON_GIRDERS = replace(
    PLAIN, girders=Girders(number=2, width_m=0.6, depth_m=1.2), deck=replace(PLAIN.deck, thickness_m=0.3)
)
BRIDGES = {
    "slab": PLAIN,
    "girders": ON_GIRDERS,
    "slab, skewed": replace(PLAIN, skew_deg=20),
    "girders, skewed, on a crest": replace(
        ON_GIRDERS, skew_deg=20, alignment=Alignment(grade_percent=4, end_grade_percent=-3, crossfall_percent=2)
    ),
    "slab with haunches": replace(PLAIN, haunches=Haunches(length_m=4, depth_m=0.5)),
}


@pytest.mark.parametrize("name", BRIDGES)
def test_nibs_are_half_as_deep_and_touch_between_their_gaps(name):
    plain = {member.name: member.volume_m3 for member in bridge_members(BRIDGES[name])}
    members = bridge_members(replace(BRIDGES[name], half_joints=(LAST, FIRST)))
    assert all(is_closed(member.solid) for member in members)
    whole = sum(member.volume_m3 for member in members)
    assert union([member.solid for member in members]).volume == pytest.approx(whole, rel=1e-9)
    for member in members:
        if member.parts:
            assert sum(part.volume for part in member.parts) == pytest.approx(member.volume_m3, rel=1e-9)
    # Each half-joint takes its gap off, half of the depth before either nib. A slab on girders ends with the upper one.
    lost = {"slab": 8 * 0.8 * 0.05, "girder": 0.6 * 1.2 * 0.05}
    kinds = {kind: sum(member.volume_m3 for member in members if member.kind == kind) for kind in ("deck", "girder")}
    of_slab = 8 * 0.3 * 0.05 if "girders" in name else lost["slab"]
    assert kinds["deck"] == pytest.approx(plain["deck"] - 2 * of_slab, rel=1e-9)
    if "girders" in name:
        girders = plain["girder 1"] + plain["girder 2"]
        assert kinds["girder"] == pytest.approx(girders - 4 * lost["girder"], rel=1e-9)
    names = ["girder 1", "girder 2"] if "girders" in name else ["deck"]
    width = 0.6 if "girders" in name else 8
    areas = contact_areas(members)
    for kind in names:
        for below in (1, 3):
            assert areas.pop((f"part 2 {kind}", f"part {below} {kind}")) == pytest.approx(width * 0.9, rel=1e-6)
    assert not any(above.startswith("part 2") for above, below in areas if below.startswith("p") and "pier" in below)


TEXT = """
[scenario]
title = "Gerber girder"
[time]
duration_s = 1
[bridge]
density_kg_m3 = 2500
span_lengths_m = [15, 24, 15]
{joints}
[bridge.deck]
width_m = 8
thickness_m = {thickness_m}
overhang_m = 0.5
{girders}
[bridge.piers]
columns = 2
column_length_m = 0.8
column_width_m = 0.8
height_m = 6
[bridge.abutments]
length_m = 1.0
width_m = 8
[bridge.bearings]
[connections]
method = "face"
type = "FIXED"
material = "reinforced concrete slab"
stiffness = "elastic"
strength_factor = 50
[fracture]
shards = {shards}
"""
DROP_IN = """
[[bridge.half_joints]]
span = 2
at_m = 6
length_m = 1.0
[[bridge.half_joints]]
span = 2
at_m = 18
length_m = 1.0
carried = "before"
pinned = false
"""
ONE = """
[[bridge.half_joints]]
span = 1
at_m = 11
length_m = 1.0
carried = "before"
"""


@pytest.mark.parametrize("shards", [120, 240])
@pytest.mark.parametrize("girders", ["", "[bridge.girders]\nnumber = 2\nwidth_m = 0.6\ndepth_m = 1.2"])
def test_a_drop_in_span_lies_on_cantilevers_by_statics(girders, shards):
    """What is carried by hinges is statically determinate: no cut and no stiffness changes it."""
    found, slab, web = standing(DROP_IN, girders, shards)
    gap = 0.03
    # Nibs are half as deep, and a slab on girders ends with the upper one.
    half = (slab * (6.5 - gap) + web * 5.5 if girders else slab * 5.5) + (web if girders else slab) * (1 - gap) / 2
    nib, at_nib = (web if girders else slab) * (1 - gap) / 2, 5.5 + (1 - gap) / 2
    whole = slab + web
    end = (whole * (15.5**2 - 5.5**2) / 2 - nib * at_nib - half * 6) / 15
    pier = whole * 21 + nib + half - end
    wanted = {"abutment 1": end, "abutment 2": end, "pier 1": pier, "pier 2": pier, "part 1": half, "part 3": half}
    assert found == pytest.approx(wanted, rel=2e-3)


def test_a_hinge_in_an_end_span_leaves_a_beam_over_three_supports():
    """The end part lies on abutment and hinge by statics; what is beyond has the moment of its cantilever of 4 m."""
    found, weight, _ = standing(ONE, "", 240)
    nib = 0.97 / 2  # half as deep, its middle 15 mm before the hinge
    first = weight * (11 * 6 + nib * 0.015) / 11
    hinge = weight * (11 + nib) - first
    assert [found["abutment 1"], found["part 2"]] == pytest.approx([first, hinge], rel=2e-3)
    # M l + 2 m (l + L) + e L = w (l³ + L³) / 4, with m over pier 2 and e of the overhang of 0.5 m.
    cantilever = hinge * 4 + weight * 3.5**2 / 2 + weight * nib * 3.985
    over_pier = (weight * (24**3 + 15**3) / 4 - cantilever * 24 - weight * 0.5**2 / 2 * 15) / (2 * 39)
    assert found["abutment 2"] == pytest.approx((weight * 15.5**2 / 2 - over_pier) / 15, rel=0.03)


def standing(joints, girders, shards):
    thickness = 0.3 if girders else 0.8
    scenario = scenario_from_text(TEXT.format(joints=joints, girders=girders, thickness_m=thickness, shards=shards))
    model = checked_model(scenario)
    count = len(model.connections)
    loads = np.zeros((6, len(model.shards)))
    rest = StandingBridge(model, scenario.joints).rest(np.ones(count, bool), np.ones(count), loads)
    found = {}
    for bearing in model.bearings.forces(rest.loads):
        below = bearing.name.split(" on ")[1]
        axis = " ".join(below.split()[:2])
        found[axis] = found.get(axis, 0.0) + bearing.force_n[2]
    by_area = 2500 * STANDARD_GRAVITY_M_S2
    return found, by_area * 8 * thickness, by_area * (2 * 0.6 * 1.2 if girders else 0.0)


@pytest.mark.parametrize(
    ("joints", "message"),
    [
        ((replace(FIRST, at_m=0.7),), r"at_m is 0.7: expected from 1 to 23 \(m\)"),
        ((replace(FIRST, span=4),), "span is 4: expected at most 3"),
        ((FIRST, replace(FIRST, at_m=6.9)), r"at 21 and 21.9 m are 0.9 m apart: expected more than 1 \(m\)"),
        ((FIRST, replace(LAST, carried="behind")), "part 2 of the deck, from 21.5 to 32.5 m, is carried at 1 "),
        ((replace(FIRST, carried="before"), replace(LAST, carried="behind")), "part 2 of the deck, from 21.5 to 32.5"),
        ((replace(FIRST, pinned=False), LAST), "at 21 and 33 m are not pinned"),
    ],
)
def test_what_would_not_stand_is_refused_with_numbers(joints, message):
    with pytest.raises(ScenarioError, match=message):
        replace(PLAIN, half_joints=joints)
    with pytest.raises(ScenarioError, match=r"bridge\.bearings is missing"):
        replace(PLAIN, half_joints=(FIRST, LAST), bearings=None)
    with pytest.raises(ScenarioError, match=r"gap_m is 0\.3: expected at most a fourth"):
        replace(FIRST, gap_m=0.3)
