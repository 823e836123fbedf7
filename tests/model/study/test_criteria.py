# SPDX-License-Identifier: GPL-3.0-or-later
"""Criteria: judged from outputs, and refused where they ask about nothing."""

from dataclasses import replace

import pytest
from support.scenarios import I235

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario import Neighbour
from bridge_demolition_addon.model.study.criteria import Criterion, check_criteria

SITE = replace(I235, neighbours=(Neighbour(name="house", position_m=(30.0, 0.0, 2.0)),))


@pytest.mark.parametrize(
    "keys, output, met, missed",
    [
        ({"kind": "collapsed"}, "collapsed_share", 0.5, 0.499),
        ({"kind": "collapsed", "share": 0.8}, "collapsed_share", 0.8, 0.799),
        ({"kind": "span down", "span": 2}, "spans.2.lost_share", 0.5, 0.499),
        ({"kind": "span stands", "span": 1}, "spans.1.most_lost_share", 0.1, 0.101),
        ({"kind": "span stands", "span": 1, "share": 0.02}, "spans.1.most_lost_share", 0.02, 0.021),
        ({"kind": "zone not entered", "zone": "Side road"}, 'zones."Side road".entered', False, True),
        ({"kind": "pressure below", "neighbour": "house", "limit_kpa": 2}, "neighbours.house.pressure_kPa", 1.99, 2.0),
        (
            {"kind": "vibration below", "neighbour": "house", "limit_mm_s": 5},
            "neighbours.house.vibration_mm_s",
            4.99,
            5.0,
        ),
        (
            {"kind": "touchdown below", "neighbour": "house", "limit_mm_s": 5},
            "neighbours.house.touchdown_mm_s",
            4.99,
            5.0,
        ),
    ],
)
def test_a_criterion_is_met_up_to_its_limit(keys, output, met, missed):
    criterion = Criterion(name="it", **keys)
    assert criterion.is_met({output: met})
    assert not criterion.is_met({output: missed})
    assert not criterion.is_met({output: None})
    assert not criterion.is_met({"another output": met})


@pytest.mark.parametrize(
    "keys, message",
    [
        ({"kind": "fallen"}, 'criteria.kind is "fallen": expected one of "collapsed", "span down"'),
        ({"kind": "span down"}, 'criteria.span is missing: expected it with kind "span down"'),
        ({"kind": "collapsed", "span": 1}, 'criteria.span is 1: expected none with kind "collapsed"'),
        ({"kind": "zone not entered", "zone": "Side road", "share": 0.5}, "criteria.share is 0.5: expected none with"),
        ({"kind": "pressure below", "neighbour": "house"}, "criteria.limit_kpa is missing: expected it with kind"),
        ({"kind": "collapsed", "share": 1.5}, "criteria.share is 1.5: expected a number above 0 and up to 1"),
    ],
)
def test_keys_that_do_not_go_together_are_refused(keys, message):
    with pytest.raises(ScenarioError) as refused:
        Criterion(name="it", **keys)
    assert str(refused.value).startswith(message)


@pytest.mark.parametrize(
    "keys, message",
    [
        ({"kind": "span down", "span": 2}, "criteria.span is 2: expected a whole number up to 1, as the scenario"),
        ({"kind": "zone not entered", "zone": "Track"}, 'criteria.zone is "Track": expected one of "Side road", '),
        ({"kind": "pressure below", "neighbour": "barn", "limit_kpa": 1}, 'criteria.neighbour is "barn": expected one'),
    ],
)
def test_criteria_about_nothing_are_refused_with_their_number(keys, message):
    good = Criterion(name="comes down", kind="collapsed")
    check_criteria((good,), SITE)
    with pytest.raises(ScenarioError) as refused:
        check_criteria((good, Criterion(name="it", **keys)), SITE)
    assert str(refused.value).startswith(f"[[criteria]] number 2: {message}")


def test_a_scenario_without_zones_says_so():
    bare = replace(I235, zones=())
    with pytest.raises(ScenarioError, match=r"expected none, as the scenario has no \[\[zones\]\]"):
        check_criteria((Criterion(name="it", kind="zone not entered", zone="Side road"),), bare)
