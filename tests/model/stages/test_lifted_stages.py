# SPDX-License-Identifier: GPL-3.0-or-later
"""Lifts in the stages of a demolition, by hand statics: a crane lifts the middle out of a beam held at both ends."""

import math

import numpy as np
import pytest
from support.long_cases import long_but
from support.steelwork import bar, node, steel_scenario

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario import Lift
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.sequence.lifts import placed_lifts
from bridge_demolition_addon.model.stages.lifted import GONE, HANGS, HELD, lift_rows
from bridge_demolition_addon.model.stages.reactions import supports_of
from bridge_demolition_addon.model.stages.stages import stages_of
from bridge_demolition_addon.model.stages.standing import StandingBridge
from bridge_demolition_addon.model.stages.tables import stage_row, stage_sentences

pytestmark = pytest.mark.slow

SPAN_M, PART_M = 12.0, (4.0, 8.0)
KEYS = {
    "name": "middle",
    "members": ("beam",),
    "lowest_corner_m": (4.0, -1.0, 4.0),
    "highest_corner_m": (8.0, 1.0, 6.0),
    "from_s": 0.1,
    "lift_s": 0.6,
    "capacity_kg": 1000.0,
    "sling_points_m": ((4.6, 0.0, 5.2), (7.0, 0.0, 5.2)),
}


def cut(time_s, along_m):
    return f"""
[[saw_cuts]]
time_s = {time_s}
members = ["beam"]
point_m = [{along_m}, 0.0, 5.0]
normal = [1.0, 0.0, 0.0]
"""


def beam(tables):
    """Return a beam of 12 m in 12 pieces, held at both ends, with further tables."""
    nodes = [node("A", 0.0, 5.0, support="fixed"), node("B", SPAN_M, 5.0, support="fixed")]
    return steel_scenario(nodes, [bar("beam", "A", "B", "HEB 300")], tables, pieces=12)


def lift_text(**keys):
    """Return a table of a lift; the keys that are not None."""
    lines = [f"{name} = {_value(value)}" for name, value in (KEYS | keys).items() if value is not None]
    return "\n".join(["", "[[lifts]]", *lines, ""])


def _value(value):
    if isinstance(value, tuple):
        return f"[{', '.join(map(_value, value))}]"
    return f'"{value}"' if isinstance(value, str) else repr(value)


def staged(tables):
    scenario = beam(tables)
    bridge = StandingBridge(checked_model(scenario), scenario.joints)
    return stages_of(scenario, bridge, lambda done, total: None), bridge


def reactions_of(bridge, stage):
    """Return upright force and moment about y of each support."""
    found = [support.reaction(stage.standing.loads) for support in supports_of(bridge.model)]
    return [(force[2], moment[1]) for force, moment in found]


def weights_n(bridge):
    """Weight of the beam between its cuts, and of all that moves."""
    model = bridge.model
    along = model.centres_m[:, 0]
    part = (along > PART_M[0]) & (along < PART_M[1])
    moves = ~model.fixed
    return tuple(STANDARD_GRAVITY_M_S2 * float(model.masses_kg[rows].sum()) for rows in (part, moves))


CUTS = cut(0.3, 4.0) + cut(0.4, 8.0)


def test_the_middle_of_a_beam_is_taken_up_cut_free_and_lifted_away():
    stages, bridge = staged(lift_text() + CUTS)
    assert [stage.step for stage in stages] == [
        "as it was built",
        "slings of middle take up 100%",
        "saw cut of 1 connections",
        "saw cut of 1 connections",
        "middle is lifted away",
    ]
    assert [[part.state for part in stage.lifts] for stage in stages] == [[], [HELD], [HELD], [HANGS], [GONE]]
    part_n, all_n = weights_n(bridge)
    for stage in stages:
        # What stands is held by supports and hooks together.
        up_n = math.fsum(force for force, _ in reactions_of(bridge, stage))
        hook_n = math.fsum(part.hook_n for part in stage.lifts if part.state == HELD)
        gone_n = part_n if stage.lifts and not stage.lifts[0].held_by else 0.0
        assert up_n + hook_n + gone_n == pytest.approx(all_n, rel=1e-3)
        assert not stage.loose.any()
    for stage in stages[1:]:
        (part,) = stage.lifts
        assert part.hook_n == pytest.approx(part_n, rel=1e-3)
        assert part.used == pytest.approx(part_n / STANDARD_GRAVITY_M_S2 / 1000.0, rel=1e-3)
        # The centre of gravity is 1.4 m from one sling and 1.0 m from the other.
        (placed,) = placed_lifts(beam(lift_text()).lifts, bridge.model)
        slopes = (placed.hook_m[2] - 5.2) / np.linalg.norm(placed.hook_m - placed.points_m, axis=1)
        upright = part.forces_n * slopes
        np.testing.assert_allclose(upright / part_n, (1.0 / 2.4, 1.4 / 2.4), rtol=1e-3)
        assert part.tilt_rad == pytest.approx(0.0, abs=1e-6)


def test_both_cantilevers_that_stay_have_the_reactions_of_statics():
    """w L and w L² / 2 at their ends, with L = 4 m; 1 % for what the beam sags."""
    stages, bridge = staged(lift_text() + CUTS)
    model = bridge.model
    each = ~model.fixed & (model.centres_m[:, 0] < 4.0)
    own_n = STANDARD_GRAVITY_M_S2 * model.masses_kg[each]
    force_n = float(own_n.sum())
    arms = model.centres_m[each, 0]
    for stage in stages[-2:]:
        for force, moment in reactions_of(bridge, stage):
            assert force == pytest.approx(force_n, rel=1e-3)
            assert abs(moment) == pytest.approx(float((own_n * arms).sum()), rel=0.01)


@pytest.mark.parametrize("pretension", long_but([0.5], [0.0, 0.5, 1.0]))
def test_pretension_relieves_the_supports_by_its_share(pretension):
    stages, bridge = staged(lift_text(pretension=pretension) + CUTS)
    part_n, _ = weights_n(bridge)
    before, after = (math.fsum(force for force, _ in reactions_of(bridge, stage)) for stage in stages[:2])
    assert before - after == pytest.approx(pretension * part_n, rel=1e-3, abs=1.0)


def test_what_is_still_held_is_not_lifted_away_and_its_holders_are_named():
    stages, bridge = staged(lift_text(lift_s=0.35) + CUTS)
    held = stages[3]
    (part,) = held.lifts
    assert held.time_s == 0.35 and part.state == HELD and part.overdue
    sentences = stage_sentences(held, stage_row(4, held, bridge))
    assert any("cannot be lifted away at 0.35 s: it still holds to beam; cut it first" in line for line in sentences)
    assert not held.removed.any()
    # It is lifted away as soon as it is free.
    assert stages[-1].time_s == 0.4 and stages[-1].lifts[0].state == GONE


def test_a_part_that_is_too_heavy_or_hangs_askew_is_said_to():
    stages, bridge = staged(
        lift_text(capacity_kg=300.0, sling_points_m=((6.5, 0.0, 5.2),), hook_m=(6.5, 0.0, 9.0)) + CUTS
    )
    hangs = stages[3]
    assert hangs.lifts[0].tilt_rad == pytest.approx(math.atan(0.5 / 0.2), rel=1e-3)
    sentences = " ".join(stage_sentences(hangs, stage_row(4, hangs, bridge)))
    assert "is too heavy for the crane" in sentences and "middle turns by 68°" in sentences


def test_what_no_sling_holds_is_said_to_fall():
    stages, bridge = staged(lift_text(lowest_corner_m=(6.0, -1.0, 4.0), sling_points_m=None) + CUTS + cut(0.5, 6.0))
    last = stages[-1]
    row = stage_row(len(stages), last, bridge)
    part_n, _ = weights_n(bridge)
    assert row["not_held_kg"] == pytest.approx(0.5 * part_n / STANDARD_GRAVITY_M_S2, rel=0.05)
    assert any("held by no connection and by no sling" in sentence for sentence in stage_sentences(last, row))


def test_tables_have_a_row_for_each_part_on_a_hook():
    stages, _ = staged(lift_text(crane_m=(6.0, 9.0)) + CUTS)
    rows = list(lift_rows(stages))
    assert [(row["stage"], row["state"]) for row in rows] == [(2, HELD), (3, HELD), (4, HANGS), (5, GONE)]
    assert {row["lift"] for row in rows} == {"middle"}
    assert rows[0]["radius_m"] == pytest.approx(9.0, abs=0.01)


def test_slings_of_a_run_take_up_the_pretension():
    scenario = beam(lift_text(pretension=0.5))
    model = checked_model(scenario)
    (placed,) = placed_lifts(scenario.lifts, model)
    slings = placed.slings()
    assert [sling.name for sling in slings] == ["middle, sling 1", "middle, sling 2"]
    forces = np.array([sling.largest_force_n for sling in slings])
    assert placed.vertical_n(forces) == pytest.approx(0.5 * STANDARD_GRAVITY_M_S2 * placed.pick.shards_kg, rel=1e-6)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"lift_s": 0.1}, r"lifts\.lift_s is 0\.1: expected more than lifts\.from_s"),
        (
            {"members": None, "lowest_corner_m": None, "highest_corner_m": None},
            "lifts.members .*expected it, or the two",
        ),
        ({"sling_points_m": ()}, "sling_points_m is a list of length 0: expected a list of one or more"),
        ({"hook_m": (6.0, 0.0, 5.0)}, r"sling_points_m\.1 is .*expected a point below the hook"),
        ({"pretension": 1.2}, "lifts.pretension is 1.2"),
        ({"capacity_kg": 0.0}, "lifts.capacity_kg is 0"),
    ],
)
def test_what_is_no_lift_is_refused(keys, message):
    with pytest.raises(ScenarioError, match=message):
        Lift(**(KEYS | keys))


def test_a_lift_of_nothing_is_refused():
    with pytest.raises(ScenarioError, match="lifts 'middle': no shard that can move is there"):
        checked_model(
            beam(lift_text(sling_points_m=None, lowest_corner_m=(4.0, 3.0, 4.0), highest_corner_m=(8.0, 4.0, 6.0)))
        )


def test_each_lift_has_a_name_of_its_own():
    with pytest.raises(ScenarioError, match=r'number 1 and \[\[lifts\]\] number 2 have one name, "middle"'):
        beam(lift_text() + lift_text())
