# SPDX-License-Identifier: GPL-3.0-or-later
"""Decks on bearings at rest, against statics and OpenSees, however long their supports are and finely they are cut."""

import numpy as np
import pytest
from support.bearing_decks import OVERHANG_M, TOP_M, WEIGHT_N_M, deck_text, standing_deck

from bridge_demolition_addon.cli.check import scenario_facts
from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.stages import stages_of
from bridge_demolition_addon.model.stages.standing import StandingBridge
from bridge_demolition_addon.model.stages.tables import bearing_rows
from bridge_demolition_addon.model.structure.bearings import shards_at

pytestmark = pytest.mark.slow

SPANS_M = (10.0, 15.0)
WHOLE_N = WEIGHT_N_M * (sum(SPANS_M) + 2.0 * OVERHANG_M)
OPENSEES_KN, OPENSEES_HOGGING_KNM, OPENSEES_MM, OPENSEES_HZ = (171.8, 829.2, 337.6), -1120.0, 7.20, 5.935
"""Of 520 beams of Timoshenko on three knife edges: reactions, moment over the middle one, deflection, frequency."""


def kn(forces):
    return [forces[f"pier {number}"].force_n[2] / 1e3 for number in range(1, 1 + len(forces))]


def on_axes(support_m):
    """Bearings over the ends of the spans, also where the deck ends before its supports do."""
    beside = max(0.0, (0.5 * support_m - OVERHANG_M) / 2.0)
    return (
        ("pier 1", f'kind = "pinned"\noffset_m = {-beside}'),
        ("pier 2", 'kind = "rocker"'),
        ("pier 3", f'kind = "rocker"\noffset_m = {beside}'),
    )


@pytest.fixture(scope="module")
def continuous():
    """How the deck stands on supports of several lengths, by these, m."""
    return {
        support_m: standing_deck(deck_text(on_axes(support_m), shards=200, seed=2, support_m=support_m))
        for support_m in (0.05, 0.6, 1.2)
    }


def test_a_continuous_deck_stands_as_on_knife_edges(continuous):
    for _, standing, forces in continuous.values():
        reactions = kn(forces)
        assert reactions == pytest.approx(OPENSEES_KN, rel=0.02)
        assert sum(reactions) == pytest.approx(WHOLE_N / 1e3, rel=1e-6)
        hogging = 10.0 * reactions[0] - WEIGHT_N_M * 10.5**2 / 2e3
        assert hogging == pytest.approx(OPENSEES_HOGGING_KNM, rel=0.05)
        # Those of the cut: a knife edge gives the same.
        assert 1e3 * standing.sag_m == pytest.approx(OPENSEES_MM, rel=0.08)
        assert standing.frequency_hz == pytest.approx(OPENSEES_HZ, rel=0.04)


def test_it_does_not_matter_how_long_a_support_is(continuous):
    short, *longer = (kn(forces) for _, _, forces in continuous.values())
    for reactions in longer:
        assert reactions == pytest.approx(short, rel=1e-3)


def test_it_turns_freely_about_its_axis(continuous):
    for _, _, forces in continuous.values():
        for number, axis_m in enumerate((0.0, 10.0, 25.0), start=1):
            bearing = forces[f"pier {number}"]
            assert bearing.axis_m == pytest.approx([axis_m, 0.0, 1.0], abs=1e-6)
            assert abs(bearing.moment_nm[1]) < 1e-3 * abs(bearing.force_n[2])


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_it_is_coarse_cuts_that_share_loads_otherwise_not_supports(seed):
    reactions = kn(standing_deck(deck_text(on_axes(1.2), seed=seed, support_m=1.2))[2])
    assert reactions[1] == pytest.approx(OPENSEES_KN[1], rel=0.03)
    assert reactions == pytest.approx(OPENSEES_KN, rel=0.08)


def test_a_heavy_load_on_one_span_lifts_the_far_end():
    """On two of three supports the deck is determinate: moments about the middle one."""
    load_n, at_m = 2e6, 17.5
    heavy = (0.0, 0.0, -load_n), (at_m, 0.0, TOP_M)
    reactions = kn(standing_deck(deck_text(), *heavy)[2])
    last = (WHOLE_N * 2.5 + load_n * 7.5) / 15.0
    assert reactions == pytest.approx([0.0, (WHOLE_N + load_n - last) / 1e3, last / 1e3], rel=1e-5)
    held = (("pier 1", 'kind = "pinned"\ntension = true'), ("pier", 'kind = "rocker"'))
    assert kn(standing_deck(deck_text(held), *heavy)[2])[0] < -100.0


def test_elastomeric_bearings_are_displaced_by_force_over_stiffness():
    """Three with 2 MN/m each under 300 kN along the road: by 50 mm."""
    keys = 'kind = "elastomeric"\nstiffness_mn_m = 1000.0\nshear_mn_m = 2.0'
    text = deck_text((("pier", keys),))
    scenario = scenario_from_text(text)
    model = checked_model(scenario)
    deck = model.member_of_shard == [member.name for member in model.members].index("deck")
    loads = np.zeros((6, len(model.shards)))
    loads[0, deck] = 3e5 * model.masses_kg[deck] / model.masses_kg[deck].sum()
    count = len(model.connections)
    bridge = StandingBridge(model, scenario.joints)
    forces = [
        np.array([bearing.force_n for bearing in model.bearings.forces(standing.loads)])
        for standing in (bridge.rest(np.ones(count, bool), np.ones(count), each) for each in (0.0 * loads, loads))
    ]
    assert (forces[1] - forces[0])[:, 0] == pytest.approx(-1e5, rel=0.01)
    moved = -(forces[1] - forces[0])[:, 0] / model.bearings.springs.sideways_n_m[:, 0].sum() * 3.0
    assert moved == pytest.approx(0.05, rel=0.01)


def test_an_elastomeric_bearing_resists_rotation_by_its_stiffness():
    """A span turns over its ends by θ = w L³ / (24 E I) - (M + w a² / 2) L / (2 E I), and M = k θ.

    Its overhangs are a long. It turns by less than lifts off one edge of the bearing.
    """
    stiffness_nm_rad = 5e6
    keys = 'kind = "elastomeric"\nstiffness_mn_m = 2000.0\nshear_mn_m = 0.1\nrotation_mnm_rad = 5.0'
    text = deck_text((("pier", keys),), spans=(16.0,), shards=150)
    _, _, forces = standing_deck(text)
    bending, span = 30e9 * 3.0 * 0.7**3 / 12.0, 16.0
    overhang_moment = WEIGHT_N_M * OVERHANG_M**2 / 2.0
    turn = (WEIGHT_N_M * span**3 / 24.0 - overhang_moment * span / 2.0) / (bending + stiffness_nm_rad * span / 2.0)
    moments = [abs(forces[f"pier {number}"].moment_nm[1]) for number in (1, 2)]
    assert moments == pytest.approx([stiffness_nm_rad * turn] * 2, rel=0.08)


def test_a_fixed_bearing_clamps_and_pads_are_at_their_positions():
    """A deck that sticks out by 10.5 m on one side of its only support, and by 0.5 m on the other.

    It is 3 m wide: pads 2 m apart are at ±1 m. Two rows of springs resist as a bed of 0.9 m does.
    """
    fixed = 'kind = "fixed"\ntension = true\npads = 2\nspacing_m = 2.0\npad_m = [0.9, 0.4]'
    none = '[[connections.between]]\nmembers = ["deck", "pier 2"]\nnone = true\n'
    text = deck_text((("pier 1", fixed),), spans=(10.0,), shards=12, support_m=1.0, more=none)
    model, standing, forces = standing_deck(text)
    assert standing.held[:12].all()
    # It hangs down, so that its weight has an arm that is shorter by less than a thousandth.
    assert forces["pier 1"].moment_nm[1] == pytest.approx(-WEIGHT_N_M * (10.5**2 - 0.5**2) / 2.0, rel=1e-3)
    places = model.bearings.springs.places_m
    assert np.abs(places[:, 1]).min() == pytest.approx(0.8 + 0.4 / 32.0, abs=1e-6)
    assert np.abs(places[:, 1]).max() == pytest.approx(1.2 - 0.4 / 32.0, abs=1e-6)
    shift = 0.9 / 12.0**0.5
    assert sorted({round(x, 6) for x in places[:, 0]}) == pytest.approx([-shift, shift], abs=1e-6)
    assert not standing_deck(text.replace("tension = true\n", ""))[1].held.any()


def test_friction_holds_what_would_slide_up_to_its_limit():
    """All bearings slide: along the road they hold 4 % of the weight with a friction of 5 %, and not 6 %."""
    sliding = deck_text((("pier", 'kind = "sliding"\nfriction = 0.05'),), spans=(10.0,), shards=12)
    weight_n = WEIGHT_N_M * 11.0
    middle = (5.0, 0.0, 1.35)
    _, standing, forces = standing_deck(sliding, (0.04 * weight_n, 0.0, 0.0), middle)
    assert standing.held[:12].all()
    assert sum(bearing.force_n[0] for bearing in forces.values()) == pytest.approx(-0.04 * weight_n, rel=1e-4)
    for bearing in forces.values():
        assert abs(bearing.force_n[0]) <= 0.05 * bearing.force_n[2] * (1.0 + 1e-4)
    assert not standing_deck(sliding, (0.06 * weight_n, 0.0, 0.0), middle)[1].held.any()


def test_shards_above_a_bearing_are_clear_of_what_is_below():
    """Only pads touch both members: the rest is 10 mm apart, and keeps its mass."""
    model, _, _ = standing_deck(deck_text(support_m=1.2))
    without = checked_model(scenario_from_text(deck_text(()).replace("[[bearings]]", "")))
    deck = model.member_of_shard == [member.name for member in model.members].index("deck")
    for shard in np.flatnonzero(deck).tolist():
        low, high = model.shards[shard].bounds
        over = any(low[0] < axis + 0.6 and high[0] > axis - 0.6 for axis in (0.0, 10.0, 25.0))
        stood = without.shards[shard].bounds[0, 2] < 1.0 + 1e-6
        if over and stood:
            assert low[2] == pytest.approx(1.01, abs=1e-6)
    assert model.masses_kg[deck] == pytest.approx(without.masses_kg[deck])


def test_all_of_a_bearing_breaks_by_its_force():
    """A deck that is pushed with 0.9 and 1.1 times what its one bearing resists along the road."""
    pinned = 'kind = "pinned"\nbreaking_force_n = 4e5'
    text = deck_text((("pier 1", pinned), ("pier", 'kind = "rocker"')), spans=(10.0,), shards=12)
    for share, overloaded in ((0.9, False), (1.1, True)):
        model, standing, _ = standing_deck(text, (share * 4e5, 0.0, 0.0), (5.0, 0.0, 1.35))
        rows = model.bearings.rows_of(0)
        assert standing.used[rows] == pytest.approx([share] * len(rows), rel=0.01)
        assert (standing.used[rows] > 1.0).tolist() == [overloaded] * len(rows)
        assert not standing.used[model.bearings.rows_of(1)].any()


@pytest.mark.parametrize(("spans", "falls"), [((10.0, 8.0), False), ((8.0, 10.0), True)])
def test_a_stage_without_an_end_support(spans, falls):
    """With the longer span in the air the deck topples over its other support; with the shorter one it does not."""
    removal = '[[removals]]\nmembers = ["pier 3"]\ntime_s = 0.1\n'
    scenario = scenario_from_text(deck_text(spans=spans, shards=12, are_held=False, more=removal))
    bridge = StandingBridge(checked_model(scenario), scenario.joints)
    first, last = stages_of(scenario, bridge, lambda *_: None)
    forces = [bearing.force_n[2] for bearing in bridge.model.bearings.forces(first.standing.loads)]
    assert sum(forces) == pytest.approx(WEIGHT_N_M * 19.0, rel=1e-6)
    assert last.loose.sum() == (12 if falls else 0)
    rows = [row for row in bearing_rows([first, last], bridge.model) if row["stage"] == 1]
    assert [row["bearing"] for row in rows] == ["deck on pier 1", "deck on pier 2", "deck on pier 3"]
    assert [row["force_z_kN"] for row in rows] == pytest.approx([force / 1e3 for force in forces])
    assert [row["axis_x_m"] for row in rows] == pytest.approx([0.0, spans[0], 18.0], abs=1e-6)


def test_a_deck_without_any_bearing_left_is_not_held():
    """All its supports are taken away at once, with the pads on them."""
    removal = '[[removals]]\nmembers = ["pier"]\ntime_s = 0.1\n'
    scenario = scenario_from_text(deck_text(spans=(10.0,), shards=12, are_held=False, more=removal))
    bridge = StandingBridge(checked_model(scenario), scenario.joints)
    assert [stage.loose.sum() for stage in stages_of(scenario, bridge, lambda *_: None)] == [0, 12]


def test_a_pad_between_two_shards_is_on_one_of_them():
    """One pad in the middle of a deck of four equal boxes: the corners of all of them are there."""
    boxes = [box((1.0, 1.0, 1.0), (x, y, 0.5)) for x in (-0.5, 0.5) for y in (-0.5, 0.5)]
    points = np.array([[0.0, 0.0, 0.001], [0.0, 0.3, 0.001], [0.0, 1.0005, 0.001], [0.0, 1.1, 0.001]])
    found = shards_at(points, np.arange(4), boxes)
    assert (found[:3] >= 0).all()
    assert found[3] == -1


def test_bearings_come_before_other_connections_of_their_members():
    rule = '[[connections.between]]\nmembers = ["deck", "pier"]\nnone = true\n'
    model, _, forces = standing_deck(deck_text(spans=(10.0,), shards=12, more=rule))
    assert kn(forces) == pytest.approx([WEIGHT_N_M * 5.5 / 1e3] * 2, rel=0.02)
    assert model.bearings.names == ("deck on pier 1", "deck on pier 2")


def test_names_may_be_patterns():
    model, _, _ = standing_deck(deck_text((("p* 2", 'kind = "pinned"'), ("pier *", 'kind = "rocker"')), shards=12))
    assert model.bearings.names == ("deck on pier 2", "deck on pier 1", "deck on pier 3")


@pytest.mark.parametrize(
    ("bearing", "said"),
    [
        (("pier 4", 'kind = "pinned"'), 'members has "pier 4": expected names or kinds of members, such as deck, pier'),
        (("deck", 'kind = "pinned"'), "expected the first to lie on the second"),
        (("pier 1", 'kind = "pinned"\noffset_m = 0.4'), "bearings.offset_m is 0.4: expected an axis where"),
        (
            ("pier 1", 'kind = "pinned"\npositions_m = [1.6]'),
            "a pad of the bearing deck on pier 1 lies beside the area",
        ),
        (
            ("pier 1", 'kind = "elastomeric"\nstiffness_mn_m = 10\nshear_mn_m = 1\nrotation_mnm_rad = 10'),
            "a pad of the bearing deck on pier 1 is longer than the area",
        ),
    ],
)
def test_bearings_that_do_not_fit(bearing, said):
    with pytest.raises(ScenarioError) as caught:
        checked_model(scenario_from_text(deck_text((bearing,), spans=(10.0,), shards=12)))
    assert said in str(caught.value)


def test_what_lies_below_is_not_taken_for_what_lies_above():
    text = deck_text((("pier", 'kind = "pinned"'),), spans=(10.0,), shards=12)
    with pytest.raises(ScenarioError, match="the first lies below: give it as the second"):
        checked_model(scenario_from_text(text.replace('["deck", "pier"]', '["pier", "deck"]')))


def test_check_says_how_bearings_are_and_what_they_carry():
    lines = "\n".join(scenario_facts(scenario_from_text(deck_text(spans=(10.0,), shards=12))))
    assert "deck on pier 1: pinned, in a line" in lines
    force = f"{WEIGHT_N_M * 5.5 / 1e3:.1f} kN up"
    assert lines.count(force) == 2


def test_check_says_that_faces_in_several_rows_clamp():
    rule = '[[connections.between]]\nmembers = ["deck", "pier"]\ntype = "GENERIC"\nfree = ["turn y"]\n'
    for support_m, clamps in ((1.2, True), (0.02, False)):
        text = deck_text((), spans=(10.0,), shards=40, support_m=support_m, more=rule)
        lines = "\n".join(scenario_facts(scenario_from_text(text)))
        assert ("[[bearings]] turn freely" in lines) is clamps


def test_rigid_connections_have_bearings_without_friction():
    kinds = [("pier 1", 'kind = "pinned"'), ("pier 2", 'kind = "sliding"\nfriction = 0.05'), ("pier", 'kind = "fixed"')]
    scenario = scenario_from_text(deck_text(kinds, stiffness="rigid").replace("elastic_modulus_n_mm2 = 30000\n", ""))
    model = checked_model(scenario)
    free = [scenario.joints[joint].free for joint in model.joint_of_connection[model.bearings.springs.rows]]
    assert set(free) == {
        ("turn x", "turn y", "turn z"),
        ("move x", "move y", "turn x", "turn y", "turn z"),
        (),
    }
    lines = "\n".join(scenario_facts(scenario))
    assert "with rigid connections they hold what is lifted, and slide without friction" in lines


@pytest.mark.parametrize(("shards", "seed"), [(60, 1), (200, 2)])
def test_a_deck_with_voids_stands_as_the_lighter_beam_that_it_is(shards, seed):
    text = deck_text(on_axes(0.6), shards=shards, seed=seed)
    voids = "[bridge.voids]\nnumber = 3\ndiameter_m = 0.45\n"
    reactions = kn(standing_deck(text.replace("[bridge.piers]", f"{voids}[bridge.piers]"))[2])
    share = 1.0 - 3.0 * np.pi * 0.45**2 / 4.0 / (3.0 * 0.7)
    assert sum(reactions) == pytest.approx(share * WHOLE_N / 1e3, rel=1e-6)
    assert reactions == pytest.approx([share * reaction for reaction in OPENSEES_KN], rel=0.05)
