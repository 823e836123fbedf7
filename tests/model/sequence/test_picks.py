# SPDX-License-Identifier: GPL-3.0-or-later
"""What picks of a crane weigh, by hand: the volume in the box of a lift, by its density."""

import math

import numpy as np
import pytest
from support.stage_folders import with_stages

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.lifts import Pick
from bridge_demolition_addon.model.run_folder.summary import RunSummary
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.sequence.checked_model import ModelWorksite, checked_model
from bridge_demolition_addon.model.sequence.ending import doubts_of_run
from bridge_demolition_addon.model.sequence.lifts import model_structure, placed_lifts, volume_kg
from bridge_demolition_addon.model.stages.lifted import LIFT_COLUMNS
from bridge_demolition_addon.model.stages.stages import stages_of
from bridge_demolition_addon.model.stages.standing import StandingBridge
from bridge_demolition_addon.model.stages.tables import stage_row, stage_sentences
from bridge_demolition_addon.report.sections.stages import stages_section

DENSITY_KG_M3 = 2500.0
BRIDGE = """
[scenario]
title = "Picks"
seed = {seed}
[time]
duration_s = 5.0
[bridge]
density_kg_m3 = 2500.0
span_lengths_m = [12.0]
skew_deg = {skew}
[bridge.deck]
width_m = 4.0
thickness_m = 0.5
[bridge.girders]
number = 2
width_m = 0.4
depth_m = 0.8
[bridge.abutments]
length_m = 1.0
width_m = 4.0
height_m = 3.0
[[supports]]
member = "abutment"
[fracture]
shards = {shards}
[connections]
type = "FIXED"
method = "face"
material = "reinforced concrete slab"
stiffness = "elastic"
"""
DECK_Z = (3.8, 4.3)


def model_with(tables, seed=1, shards=60, skew=0.0):
    scenario = scenario_from_text(BRIDGE.format(seed=seed, shards=shards, skew=skew) + tables)
    return scenario, checked_model(scenario)


def lift(name, members, low, high, capacity_kg=20000.0):
    return (
        f'[[lifts]]\nname = "{name}"\nmembers = {members}\nlowest_corner_m = {low}\nhighest_corner_m = {high}\n'
        f"from_s = 0.5\nlift_s = 3.0\ncapacity_kg = {capacity_kg}\n"
    ).replace("'", '"')


@pytest.mark.parametrize("seed", [3, 8])
@pytest.mark.parametrize(
    ("members", "low", "high", "volume_m3"),
    [
        (["deck"], [3.0, -1.0, 3.0], [7.0, 1.0, 5.0], 4.0 * 2.0 * 0.5),
        (["deck"], [6.0, -9.0, 0.0], [99.0, 9.0, 9.0], 6.0 * 4.0 * 0.5),  # sticks out beyond its end, at 12 m
        (["girder"], [3.0, -9.0, 0.0], [7.0, 9.0, 9.0], 2 * 4.0 * 0.4 * 0.8),
        (["deck", "girder"], [3.0, 0.0, 3.0], [7.0, 9.0, 9.0], 4.0 * (2.0 * 0.5 + 0.4 * 0.8)),
        (["deck", "girder"], [3.0, 0.0, 3.4], [7.0, 9.0, 4.0], 4.0 * (2.0 * 0.2 + 0.4 * 0.4)),
        # Abutments are held: nothing of them is lifted.
        (["deck", "abutment"], [-9.0, -9.0, 0.0], [2.0, 9.0, 9.0], 2.0 * 4.0 * 0.5),
    ],
)
def test_a_pick_weighs_what_is_in_its_box(seed, members, low, high, volume_m3):
    scenario, model = model_with(lift("pick", members, low, high), seed)
    found = volume_kg(scenario.lifts[0], model, model_structure(model))
    assert found == pytest.approx(DENSITY_KG_M3 * volume_m3, rel=1e-9)
    (placed,) = placed_lifts(scenario.lifts, model)
    assert placed.pick.shards_kg == pytest.approx(found, rel=1e-9)  # shards end at the box
    assert float(model.masses_kg.sum()) == pytest.approx(sum(member.mass_kg for member in model.members), rel=1e-9)


STRIPS = [lift(f"strip {y}", ["deck"], [3.0, y, 3.0], [9.0, y + 1.0, 5.0]) for y in (-2.0, -1.0, 0.0, 1.0)]
SAW = "[[saw_cuts]]\ntime_s = 1.0\nmembers = ['deck']\npoint_m = [3.0, 0.0, 4.0]\nnormal = [1.0, 0.0, 0.0]\n"


@pytest.mark.parametrize(("seed", "shards", "skew"), [(1, 30, 0.0), (2, 90, 15.0)])
def test_strips_weigh_the_same_in_any_order_at_any_seed_and_number_of_shards(seed, shards, skew):
    for tables in (STRIPS, [SAW, *STRIPS[::-1]]):
        scenario, model = model_with("".join(tables), seed, shards, skew)
        for placed in placed_lifts(scenario.lifts, model):
            assert placed.pick.shards_kg == pytest.approx(DENSITY_KG_M3 * 3.0, rel=1e-9) and not placed.pick.warning
            assert placed.centre_m[:2] == pytest.approx((6.0, float(placed.lift.name.split()[1]) + 0.5), abs=1e-9)


def test_what_no_box_meets_is_cut_as_without_lifts():
    _, plain = model_with("")
    for scenario_lift in (
        lift("whole", ["deck"], [-9.0, -9.0, 0.0], [99.0, 9.0, 9.0]),
        lift("by 5 mm", ["deck"], [-9.0, -9.0, 0.0], [11.995, 9.0, 9.0]),  # thinner slices are not cut off
    ):
        scenario, model = model_with(scenario_lift)
        assert all(np.array_equal(*pair) for pair in zip(plain.centres_m, model.centres_m, strict=True))
    own_points = "".join(f"[[fracture.points]]\nplace_m = [{x}, 0.0, 4.0]\n" for x in (1.0, 5.0, 11.0))
    scenario, model = model_with(own_points + lift("pick", ["deck"], [0.0, -9.0, 3.0], [6.0, 9.0, 9.0]))
    (placed,) = placed_lifts(scenario.lifts, model)
    # Cells of points at 1, 5 and 11 m: their middles at 3 and 8 m; the shards of the first two weigh 8 m of 12 m.
    assert placed.pick.shards_kg == pytest.approx(DENSITY_KG_M3 * 8.0 * 2.0) and "by the volume" in placed.pick.warning


def test_a_skewed_deck_in_a_box_weighs_what_lies_in_it():
    """Each strip of a parallelogram is as long as the box, which lies within its ends."""
    scenario, model = model_with(lift("pick", ["deck"], [4.0, -1.0, 3.0], [8.0, 1.0, 5.0]), skew=20.0)
    assert placed_lifts(scenario.lifts, model)[0].pick.volume_kg == pytest.approx(DENSITY_KG_M3 * 4.0, rel=1e-9)


@pytest.mark.parametrize(("seed", "shards", "skew"), [(3, 40, 20.0), (5, 90, -35.0)])
def test_a_turned_box_takes_a_strip_of_a_skewed_deck_along_its_joints(seed, shards, skew):
    """3 m across the joints, right through the deck of 4 by 0.5 m."""
    across = 3.0 * math.cos(math.radians(skew))
    strip = lift("strip", ["deck"], [6.0 - across / 2.0, -9.0, 3.0], [6.0 + across / 2.0, 9.0, 5.0])
    scenario, model = model_with(strip + f"skew_deg = {skew}\n", seed, shards, skew)
    (placed,) = placed_lifts(scenario.lifts, model)
    assert placed.pick.volume_kg == pytest.approx(DENSITY_KG_M3 * 3.0 * 4.0 * 0.5, rel=1e-9)
    assert placed.pick.shards_kg == pytest.approx(placed.pick.volume_kg, rel=1e-9)
    assert placed.centre_m[:2] == pytest.approx((6.0, 0.0), abs=1e-9)


@pytest.mark.parametrize(
    ("skew", "along", "is_exact"), [(0.0, "box", True), (25.0, "box", True), (0.0, "faces", False)]
)
def test_what_is_removed_weighs_what_its_box_holds(skew, along, is_exact):
    across = 2.0 * math.cos(math.radians(skew))
    removal = (
        f'[[removals]]\ntime_s = 1.0\nmembers = ["deck"]\nalong = "{along}"\nskew_deg = {skew}\n'
        f"lowest_corner_m = [{5.0 - across / 2.0}, -9.0, 3.0]\nhighest_corner_m = [{5.0 + across / 2.0}, 9.0, 5.0]\n"
    )
    scenario, model = model_with(removal, seed=7)
    gone = scenario.removals[0].in_box(model.centres_m) & (model.masses_kg > 0.0)
    gone &= np.array([model.members[number].name == "deck" for number in model.member_of_shard])
    weighs = float(model.masses_kg[gone].sum()) == pytest.approx(DENSITY_KG_M3 * 2.0 * 4.0 * 0.5, rel=1e-9)
    assert weighs == is_exact


def test_a_box_that_is_not_there_is_not_turned():
    with pytest.raises(ScenarioError, match=r"removals\.skew_deg"):
        model_with('[[removals]]\ntime_s = 1.0\nmembers = ["deck"]\nskew_deg = 10.0\n')


def test_check_says_the_centre_of_gravity_and_what_slings_carry():
    """2 m of deck, 10 t, on two slings 0.5 and 1.5 m from its middle: upright 3/4 and 1/4, by the lever rule."""
    weight_kn = 9.80665 * DENSITY_KG_M3 * 2.0 * 4.0 * 0.5 / 1e3
    table = lift("pick", ["deck"], [5.0, -9.0, 3.0], [7.0, 9.0, 5.0])
    for slings, forces in (
        ("", [weight_kn]),
        (
            "sling_points_m = [[6.0, -0.5, 4.3], [6.0, 1.5, 4.3]]\nhook_m = [6.0, 0.0, 12.3]\n",
            [0.75 * weight_kn * np.hypot(1.0, 0.5 / 8.0), 0.25 * weight_kn * np.hypot(1.0, 1.5 / 8.0)],
        ),
    ):
        scenario, model = model_with(table + slings)
        (placed,) = placed_lifts(scenario.lifts, model)
        assert placed.pick.centre_m == pytest.approx((6.0, 0.0, 4.05), abs=1e-9)
        assert [force / 1e3 for force in placed.pick.slings_n] == pytest.approx(forces, rel=1e-6)


def test_the_crane_is_judged_by_the_larger_mass_and_both_are_said():
    pick = Pick("strip", 50734.0, 66406.0)
    assert pick.heavier_by == pytest.approx(66406.0 / 50734.0) and Pick("strip", 88134.0, 66406.0).heavier_by == 1.0
    assert pick.masses == "66.4 t by volume, 50.7 t in shards"
    assert "66.4 t by the volume in its box, but 50.7 t by the shards" in pick.warning
    assert Pick("strip", 67100.0, 66406.0).warning == ""


def test_picks_that_differ_are_said_in_report_and_summary(tmp_path):
    hook = {"largest_hook_N": 1e6, "largest_hook_s": 2.0}
    part = hook | {"name": "strip", "weight_N": 9.80665 * 88134.0, "volume_weight_N": 9.80665 * 66406.0}
    (said,) = doubts_of_run(RunSummary.of({"lifts": [part]}))
    assert said == Pick("strip", 88134.0, 66406.0).warning
    earlier = hook | {"name": "strip", "weight_N": 864_300.0}
    assert doubts_of_run(RunSummary.of({"lifts": [earlier]})) == ()
    folder = with_stages(tmp_path / "stages")
    values = dict.fromkeys(LIFT_COLUMNS, "1") | {"lift": "strip", "part_kg": "88134", "volume_kg": "66406"}
    for columns, times in ((LIFT_COLUMNS, 1), (LIFT_COLUMNS[:-1], 0)):  # earlier versions did not say
        line = ",".join(values[name] for name in columns)
        (folder / "lifts.csv").write_text(f"{','.join(columns)}\n{line}\n{line}\n", encoding="utf-8")
        texts = [getattr(block, "text", "") for block in stages_section(folder).blocks]
        assert texts.count(f"{said}.") == times


@pytest.mark.long
def test_what_slings_relieve_of_its_bearings_hangs_on_them_and_what_is_not_held_has_no_load_factor():
    both = ["deck", "girder"]
    halves = "".join(lift(f"at {x}", both, [x, -9.0, 3.0], [x + 6.0, 9.0, 9.0]) for x in (0.0, 6.0))
    saw = SAW.replace("3.0", "6.0", 1).replace("['deck']", "['deck', 'girder']") + "[bridge.bearings]\npinned_at = 1\n"
    for tables, not_held in ((halves + saw, False), (saw, True)):
        scenario, model = model_with(tables, shards=40)
        bridge = StandingBridge(model, scenario.joints)
        stages = stages_of(scenario, bridge, lambda done, total: None)
        sawn = next(stage for stage in stages if stage.step.startswith("saw cut"))
        assert sawn.loose.any() == not_held
        if not_held:
            said = " ".join(stage_sentences(sawn, stage_row(2, sawn, bridge)))
            assert np.isnan(sawn.collapse_factor) and "of deck" in said and "times its load" not in said


def facts_of(tables):
    scenario, model = model_with(tables)
    site = ModelWorksite(scenario, model)
    return [fact for action in scenario.actions for fact in action.facts(site)]


def test_what_a_crane_cannot_lift_is_told_with_its_capacity_and_radius():
    """4 m x 4 m x 0.5 m of 2.5 t/m³ are 20 t, 6 m and 8 m from the crane."""
    pick = lift("pick", ["deck"], [4.0, -9.0, 3.0], [8.0, 9.0, 9.0], 16000.0) + "crane_m = [12.0, 8.0]\n"
    (_, masses), _, (_, heavier) = facts_of(pick)
    assert "125% of the 16.0 t that the crane lifts at 10.0 m" in masses and "heavier than the crane" in heavier


def test_boxes_that_reach_into_supports_or_each_other_are_told():
    """Of abutments nothing goes, as they are held; 2 m of 4 m x 0.5 m are in both boxes."""
    both = "".join(
        lift(name, ["deck"], [low, -9.0, 3.0], [high, 9.0, 9.0]) for name, low, high in (("a", -9, 6), ("b", 4, 12))
    )
    assert [text for name, text in facts_of(both) if name == "look at"] == [
        "10.00 t of it are in b as well: take the boxes apart",
        "10.00 t of it are in a as well: take the boxes apart",
    ]
    box = "lowest_corner_m = [-9.0, -9.0, 0.0]\nhighest_corner_m = [6.0, 9.0, 9.0]\n"
    (_, gone), (heading, stays) = facts_of(f"[[removals]]\ntime_s = 1.0\n{box}")
    # Deck and two girders of 6 m
    mass_kg = DENSITY_KG_M3 * 6.0 * (4.0 * 0.5 + 2 * 0.4 * 0.8)
    assert gone.endswith(f": {1e-3 * mass_kg:.1f} t of deck, girder 1, girder 2")
    assert heading == "look at" and stays.startswith("abutment 1: [[supports]] hold what is there, and it stays")


def test_slings_beside_their_part_are_refused():
    pick = lift("pick", ["deck"], [4.0, -9.0, 3.0], [8.0, 9.0, 9.0])
    with pytest.raises(
        ScenarioError, match=r"lifts\.sling_points_m\.2 is \[9, 0, 4\.3\]: expected a point above or in the box"
    ):
        model_with(pick + "sling_points_m = [[5.0, 0.0, 9.5], [9.0, 0.0, 4.3]]\n")
