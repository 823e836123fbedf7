# SPDX-License-Identifier: GPL-3.0-or-later
"""Changes find the shards and connections that they mean, and are refused where they mean nothing."""

from dataclasses import replace

import numpy as np
import pytest
from support.scenarios import I235

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.as_built import Structure
from bridge_demolition_addon.model.changes.change import schedule
from bridge_demolition_addon.model.scenario import Removal, SawCut, Support, Weakening
from bridge_demolition_addon.model.scenario.file import scenario_from_text, scenario_text
from bridge_demolition_addon.model.sequence.lifts import model_structure
from bridge_demolition_addon.model.structure.model import build_model

# Two piers of two blocks each, 10 m apart, with a deck of one block on top; the last body is the ground.
STRUCTURE = Structure(
    centres_m=np.array([(0, 0, 1), (0, 0, 3), (10, 0, 1), (10, 0, 3), (5, 0, 4.5), (0, 0, -1)], float),
    masses_kg=np.array([1000.0] * 5 + [0.0]),
    member_names=np.array(["pier 1", "pier 1", "pier 2", "pier 2", "deck", ""]),
    member_kinds=np.array(["pier"] * 4 + ["deck", ""]),
    is_shard=np.array([True] * 5 + [False]),
    held=np.zeros(6, bool),
    pairs=np.array([(0, 1), (2, 3), (1, 4), (3, 4), (0, 5), (2, 5)]),
    points_m=np.array([(0, 0, 2), (10, 0, 2), (0, 0, 4), (10, 0, 4), (0, 0, 0), (10, 0, 0)], float),
    normals=np.tile((0.0, 0.0, 1.0), (6, 1)),
    bearings=np.zeros(0, int),
    boxes_m=np.zeros((6, 2, 3)),
)


@pytest.mark.parametrize(
    "change, bodies, connections",
    [
        (Removal(time_s=1, members=["pier 1"]), [0, 1], [0, 2, 4]),
        (Removal(time_s=1, members=["pier"]), [0, 1, 2, 3], [0, 1, 2, 3, 4, 5]),
        (Removal(time_s=1, members=["pier"], lowest_corner_m=(9, -1, 2), highest_corner_m=(11, 1, 9)), [3], [1, 3]),
        (Removal(time_s=1, lowest_corner_m=(-1, -1, -9), highest_corner_m=(1, 1, 2)), [0], [0, 4]),
        (Weakening(time_s=1, factor=0.5), [], [0, 1, 2, 3, 4, 5]),
        (Weakening(time_s=1, factor=0.5, members=["deck"]), [], [2, 3]),
        (SawCut(time_s=1, point_m=(0, 0, 2), normal=(0, 0, 3)), [], [0, 1]),
        (SawCut(time_s=1, point_m=(0, 0, 2), normal=(0, 0, -1), members=["pier 2"]), [], [1]),
        # The ground's own centre, at 0 and -1, would put it on the wrong side of a vertical plane.
        (SawCut(time_s=1, point_m=(5.5, 0, 0), normal=(1, 0, 0)), [], [3]),
        (SawCut(time_s=1, point_m=(0, 0, 0.1), normal=(0, 0, 1)), [], [4, 5]),
    ],
)
def test_changes_find_what_they_mean(change, bodies, connections):
    (event,) = schedule([change], STRUCTURE)
    assert event.bodies.tolist() == bodies
    assert event.connections.tolist() == connections
    assert event.factor == (0.5 if isinstance(change, Weakening) else 0.0)


@pytest.mark.parametrize(
    ("members", "normals", "bearings", "cut"),
    [
        (None, (0, 0, 1), [], [3]),  # a contact of a deck and a girder that end on the two sides
        (None, (0, 0, 1), [3], []),
        (["deck", "pier"], (0, 0, 1), [3], []),
        (["deck"], (0, 0, 1), [], []),
        (["deck"], (1, 0, 0.1), [3], [3]),  # its face, such as that of an end wall, lies in the plane
        (["pier"], (-1, 0, 0), [], [3]),
    ],
)
def test_a_saw_cut_leaves_bearings_and_neighbours_alone_unless_it_runs_along_their_faces(
    members, normals, bearings, cut
):
    """The plane at 5.5 m has the middles of deck and pier 2 on its two sides, and the bearing 4.5 m away."""
    structure = replace(
        STRUCTURE, normals=np.tile(normals, (6, 1)) / np.linalg.norm(normals), bearings=np.array(bearings, int)
    )
    saw = SawCut(time_s=1, point_m=(5.5, 0, 0), normal=(1, 0, 0), members=members)
    if not cut:
        with pytest.raises(ScenarioError, match="no connection of the bridge is there"):
            schedule([saw], structure)
        return
    (event,) = schedule([saw], structure)
    assert event.connections.tolist() == cut


def test_events_are_in_order_of_time():
    changes = [Weakening(time_s=time, factor=0.5) for time in (3, 1, 2)]
    assert [event.time_s for event in schedule(changes, STRUCTURE)] == [1, 2, 3]


@pytest.mark.parametrize(
    "change, text",
    [
        (
            Removal(time_s=1, members=["pier 3"]),
            'removals.members names "pier 3": expected names or kinds of members, ',
        ),
        (Removal(time_s=1, members=["pier 3"]), "which are deck, pier, pier 1, pier 2"),
        (
            Removal(time_s=1, lowest_corner_m=(2, 0, 0), highest_corner_m=(3, 1, 1)),
            "removals at 1 s: no shard of the bridge is there",
        ),
        (
            SawCut(time_s=1, point_m=(0, 0, 9), normal=(0, 0, 1)),
            "saw_cuts at 1 s: no connection of the bridge is there",
        ),
    ],
)
def test_what_concerns_nothing_is_refused(change, text):
    with pytest.raises(ScenarioError, match=text.replace("[", r"\[")):
        schedule([change], STRUCTURE)


@pytest.mark.parametrize(
    "change, text",
    [
        (
            Removal(time_s=1, members=["pier 1"]),
            r"removals at 1 s: pier 1 cannot be taken away, as \[\[supports\]\] hold all .*"
            r"cut off what rests on it with \[\[saw_cuts\]\], .*connections.foundation",
        ),
        (Removal(time_s=1, lowest_corner_m=(-1, -1, 0), highest_corner_m=(1, 1, 4)), "pier 1 cannot be taken away"),
        (SawCut(time_s=1, point_m=(0, 0, 2), normal=(0, 0, 1), members=["pier 1"]), "pier 1 has no connection there"),
        (
            Weakening(time_s=1, factor=0.5, lowest_corner_m=(-1, -1, 0), highest_corner_m=(1, 1, 3.5)),
            "pier 1 has no connection there, as",
        ),
        # Everywhere, as here, is not in a member that is held.
        (SawCut(time_s=1, point_m=(0, 0, 9), normal=(0, 0, 1)), "no connection of the bridge is there"),
    ],
)
def test_a_member_that_supports_hold_is_there_but_cannot_be_changed(change, text):
    held = np.array([True, True, False, False, False, False])
    rows = [1, 2, 3]  # no connection lies between two that are held, as between pier 1 and the ground
    pairs, points = STRUCTURE.pairs[rows], STRUCTURE.points_m[rows]
    normals, is_shard = STRUCTURE.normals[rows], STRUCTURE.is_shard & ~held
    fixed = replace(STRUCTURE, is_shard=is_shard, held=held, pairs=pairs, points_m=points, normals=normals)
    with pytest.raises(ScenarioError, match=text):
        schedule([change], fixed)


def test_check_and_run_refuse_to_take_away_what_supports_hold():
    """By the model, before a run, as by what is recorded in it."""
    column = "pier 1 column 1"
    model = build_model(replace(I235, supports=[Support(member=column)]))
    with pytest.raises(ScenarioError, match=f"{column} cannot be taken away"):
        schedule([Removal(time_s=1, members=[column])], model_structure(model))


def test_a_plane_beside_what_is_held_is_judged_by_where_that_lies():
    """As in the model, so in a run: the held block at 3 m lies on the same side of the plane at 2.9 m as the deck."""
    held = np.array([False, True, False, False, False, False])
    fixed = replace(STRUCTURE, is_shard=STRUCTURE.is_shard & ~held, held=held)
    (event,) = schedule([SawCut(time_s=1, point_m=(0, 0, 2.9), normal=(0, 0, 1), members=["pier 1"])], fixed)
    assert event.connections.tolist() == [0]


@pytest.mark.parametrize(
    "make, text",
    [
        (lambda: Removal(time_s=1), "removals.members is missing: expected it, or the two corners of a box"),
        (lambda: Removal(time_s=1, members=[]), "members is a list of length 0: expected a list of one or more texts"),
        (lambda: Removal(time_s=1, members=["deck", 3]), r"removals.members.2 is 3: expected a list of one or more"),
        (
            lambda: Removal(time_s=1, lowest_corner_m=(0, 0, 0)),
            "removals.highest_corner_m is missing: expected it with removals.lowest_corner_m",
        ),
        (
            lambda: Removal(time_s=1, lowest_corner_m=(0, 0, 0), highest_corner_m=(1, 0, 1)),
            r"removals.highest_corner_m.2 is 0.0: expected more than that of the lowest corner, 0.0 \(m\)",
        ),
        (lambda: SawCut(time_s=1, point_m=(0, 0, 0), normal=(0, 0, 0)), "saw_cuts.normal is a list of length 3, all 0"),
        (lambda: Weakening(time_s=1, factor=0), "weakenings.factor is 0: expected a number above 0 and up to 1"),
        (lambda: Weakening(time_s=-1, factor=1), "weakenings.time_s is -1: expected a number of at least 0"),
        (lambda: replace(I235, removals=[Removal(time_s=5, members=["deck"])]), "removals.time_s is 5.0: expected at "),
        (
            lambda: replace(
                I235,
                connections=replace(I235.connections, warm_up_s=1),
                weakenings=[Weakening(time_s=0.5, factor=0.5)],
            ),
            "weakenings.time_s is 0.5: expected at least connections.warm_up_s, 1.0",
        ),
    ],
)
def test_wrong_changes_are_refused(make, text):
    with pytest.raises(ScenarioError, match=text):
        make()


def test_changes_are_written_without_loss():
    box = {"lowest_corner_m": (0.1, -9, 0), "highest_corner_m": (13, 9, 0.3)}
    scenario = replace(
        I235,
        removals=[Removal(time_s=1, members=["pier 1", 'odd "name"']), Removal(time_s=0.1 + 0.2, **box)],
        saw_cuts=[SawCut(time_s=1, point_m=(6.5, 0, 5), normal=(1, 0, 0), members=["deck"])],
        weakenings=[Weakening(time_s=2, factor=0.3, **box)],
    )
    assert scenario_from_text(scenario_text(scenario)) == scenario


def test_removed_pier_of_a_model_is_all_of_its_shards():
    model = build_model(I235)
    names = [member.name for member in model.members]
    (event,) = schedule([Removal(time_s=1, members=["pier 1 column 1"])], model_structure(model))
    expected = np.flatnonzero(model.member_of_shard == names.index("pier 1 column 1"))
    assert event.bodies.tolist() == expected.tolist()
    pairs = model.connections.pairs
    assert event.connections.tolist() == np.flatnonzero(np.isin(pairs, expected).any(axis=1)).tolist()
