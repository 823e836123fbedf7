# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of the site: taken as they are meant, and refused with a sentence where they cannot be."""

from dataclasses import replace

import pytest
from support.scenarios import I235

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario import Exclusion, Neighbour, Site, Zone
from bridge_demolition_addon.model.scenario.file import scenario_from_text, scenario_text

SQUARE = [[0, 0], [4, 0], [4, 4], [0, 4]]


def test_a_site_is_written_and_read_without_loss():
    scenario = replace(
        I235,
        zones=(Zone(name="A", corners_m=SQUARE), Zone(name="B", kind="road", corners_m=SQUARE, bottom_m=0.1, top_m=2)),
        exclusion=Exclusion(buffer_m=1 / 3),
        site=Site(latitude_deg=41.6, longitude_deg=-93.6, bearing_deg=12.5),
        neighbours=(Neighbour(name="House", position_m=(1, 2, 3)),),
    )
    assert scenario_from_text(scenario_text(scenario)) == scenario
    assert scenario.zones[0].corners_m == ((0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0))


def test_without_them_nothing_changes():
    bare = replace(I235, zones=(), exclusion=None)
    text = scenario_text(bare)
    assert not any(f"[{name}]" in text for name in ("zones", "exclusion", "site", "neighbours"))
    assert scenario_from_text(text) == bare


@pytest.mark.parametrize(
    "corners, message",
    [
        ([[0, 0], [1, 0]], "has 2 positions: expected at least 3"),
        ([[0, 0], [1, 0], [1]], r"corners_m.3 is a list of length 1: expected a list of one or more lists of 2"),
        ([[0, 0], [1, 0], [1, "a"]], r'corners_m.3.2 is "a"'),
        ([[0, 0], [1, 0], 5], r"corners_m.3 is 5"),
        ([], "is a list of length 0"),
        (7, "is 7"),
        ([[0, 0], [4, 4], [4, 0], [0, 4]], "sides cross or touch"),
        ([[0, 0], [1, 0], [2, 0]], "sides cross or touch"),
        ([[0, 0], [4, 0], [4, 4], [2, 0], [0, 4]], "sides cross or touch"),
        ([[0, 0], [4, 0], [float("nan"), 4]], r"corners_m.3.1 is nan"),
    ],
)
def test_corners_that_are_no_area_are_refused(corners, message):
    with pytest.raises(ScenarioError, match=message):
        Zone(name="A", corners_m=corners)


@pytest.mark.parametrize("corners", [SQUARE, SQUARE[::-1], [[0, 0], [4, 0], [4, 4], [2, 1], [0, 4]], SQUARE[:3]])
def test_areas_are_taken_whichever_way_round_and_with_notches(corners):
    assert len(Zone(name="A", corners_m=corners).corners_m) == len(corners)


def test_a_zone_has_a_height():
    with pytest.raises(ScenarioError, match=r"zones\.top_m is 2\.0: expected more than zones.bottom_m, 2.0"):
        Zone(name="A", corners_m=SQUARE, bottom_m=2, top_m=2)


def test_a_file_names_the_zone_that_is_wrong():
    text = scenario_text(replace(I235, zones=[Zone(name=name, corners_m=SQUARE) for name in "AB"]))
    wrong = 'kind = "railroad"'.join(text.rsplit('kind = "other"', 1))
    with pytest.raises(
        ScenarioError, match=r'\[\[zones\]\] number 2: zones.kind is "railroad": expected one of "road"'
    ):
        scenario_from_text(wrong)
