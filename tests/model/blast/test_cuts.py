# SPDX-License-Identifier: GPL-3.0-or-later
"""Severed members in a scenario: times, names, and what is refused."""

from dataclasses import replace

import pytest
from support.drilled_columns import ZONE, column_model, column_scenario

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.changes.change import schedule
from bridge_demolition_addon.model.optimise.file import total_charge_kg
from bridge_demolition_addon.model.scenario import MemberCut
from bridge_demolition_addon.model.sequence.checked_model import check_actions
from bridge_demolition_addon.model.sequence.lifts import model_structure
from bridge_demolition_addon.model.study.file import variations_of

CUT = MemberCut(member="column", position_m=3.0, mass_kg=2.0, delay_ms=100.0)


def with_cuts(folder, *cuts, zones=()):
    return replace(column_scenario(folder, *zones), cuts=cuts)


def test_a_cut_is_a_plane_through_its_member_at_its_time(tmp_path):
    scenario = with_cuts(tmp_path, CUT)
    assert scenario.cuts[0].name == "Cut 1"
    model = column_model(scenario)
    check_actions(scenario, model)
    (event,) = schedule(scenario.changes, model_structure(model))
    assert (event.time_s, event.kind, event.factor) == (pytest.approx(0.4), "severed member", 0.0)
    # No shard lies across it, and all of the section is severed.
    points = model.connections.points[event.connections]
    assert points[:, 2] == pytest.approx(3.0, abs=1e-6)
    assert model.connections.areas[event.connections].sum() == pytest.approx(0.49)


def test_a_misfire_does_nothing_and_studies_sample_it(tmp_path):
    assert with_cuts(tmp_path, replace(CUT, fires=False)).changes == ()
    (variation,) = variations_of((), with_cuts(tmp_path, replace(CUT, probability_fires=0.9)))
    assert variation.key.name == 'cuts."Cut 1".fires'


def test_its_mass_counts(tmp_path):
    assert total_charge_kg(with_cuts(tmp_path, CUT, zones=(ZONE,))) == pytest.approx(2.735)


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"position_m": 5.0}, r"cuts.position_m is 5.0: expected a position in column, from 0 to 4 \(m\) along z"),
        ({"member": "pier"}, 'cuts.member is "pier": expected the name of one member, not a kind'),
        ({"member": "mast"}, 'cuts.member is "mast": expected the name or kind of a member'),
    ],
)
def test_cuts_beside_their_member_are_refused(tmp_path, values, text):
    scenario = with_cuts(tmp_path, replace(CUT, **values))
    with pytest.raises(ScenarioError, match=text):
        check_actions(scenario, column_model(scenario))


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"name": "zone"}, r'blast_zones\]\] number 1 and \[\[cuts\]\] number 1 have one name, "zone"'),
        ({"along": "x"}, 'along is "x": expected "z" as "zone" of column has'),
        ({"position_m": 1.5}, 'position_m is 1.5: expected a position outside "zone"'),
        ({"delay_ms": 5000.0}, "Cut 1 fires at 5.3 s"),
    ],
)
def test_cuts_beside_zones_and_out_of_time_are_refused(tmp_path, values, text):
    with pytest.raises(ScenarioError, match=text):
        with_cuts(tmp_path, replace(CUT, **values), zones=(ZONE,))
