# SPDX-License-Identifier: GPL-3.0-or-later
"""What `[[tendons]]` and `[[tendon_cuts]]` refuse, in a sentence with the key, the value and what is expected."""

import pytest
from support.prestressed_beam import MIDDLE_M, beam_text, tendon

from bridge_demolition_addon.engineering.geometry.turned_boxes import TurnedBox
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario import Tendon, TendonCut
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.sequence.checked_model import checked_model

STRAIGHT = "eccentricities_m = [0.3, 0.3, 0.3]"
KEYS = {"name": "a", "member": "deck", "area_mm2": 1500.0, "prestress_n_mm2": 1000.0}
LINE = ((0.0, 0.0, 1.0), (10.0, 0.0, 1.0))
BOX = "lowest_corner_m = [9.0, -1.0, 3.0]\nhighest_corner_m = [11.0, 1.0, 4.0]\n"


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({}, "tendons has no points_m or eccentricities_m: give one of them"),
        ({"points_m": LINE, "eccentricities_m": (0, 0, 0)}, "are given together"),
        ({"points_m": LINE[:1]}, "tendons.points_m is a list of length 1: expected two points or more"),
        ({"points_m": (LINE[0], LINE[0])}, "tendons.points_m.2 is where the one before is"),
        (
            {"points_m": LINE, "prestress_n_mm2": 1900.0},
            r"tendons.prestress_n_mm2 is 1900.0: expected less than tendons.strength_n_mm2, 1860 \(N/mm²\)",
        ),
        ({"points_m": LINE, "area_mm2": 0.0}, r"tendons.area_mm2 is 0.0: expected a number above 0 \(mm²\)"),
        ({"points_m": LINE, "bonded": False, "anchored": False}, "expected true without bond"),
        ({"points_m": LINE, "beside_m": 0.1}, "tendons.beside_m is 0.1: expected none without"),
    ],
)
def test_refused_tables(keys, message):
    with pytest.raises(ScenarioError, match=message):
        Tendon(**(KEYS | keys))


def test_forces_are_area_times_stress():
    table = Tendon(**KEYS, points_m=LINE)
    assert (table.force_n, table.rupture_n) == (1.5e6, 2.79e6)


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (tendon(STRAIGHT) + tendon(STRAIGHT), r'number 1 and \[\[tendons\]\] number 2 have one name, "tendon"'),
        (f"[[tendon_cuts]]\ntime_s = 0.5\n{BOX}", r"tendon_cuts is given: expected none without \[\[tendons\]\]"),
        (
            tendon(STRAIGHT) + f'[[tendon_cuts]]\ntime_s = 0.5\ntendons = ["b"]\n{BOX}',
            'tendon_cuts.tendons has "b": expected names of .* tendon$',
        ),
        (tendon(STRAIGHT) + "[[tendon_cuts]]\ntime_s = 2.0\n", "tendon_cuts.time_s is 2.0: expected"),
    ],
)
def test_refused_scenarios(more, message):
    with pytest.raises(ScenarioError, match=message):
        scenario_from_text(beam_text(more))


def test_rigid_connections_are_refused():
    text = beam_text(tendon(STRAIGHT)).replace("elastic", "rigid").replace("damping_ratio = 0.02\n", "")
    text = text[: text.index("[[bearings]]")] + text[text.index("[fracture]") :]
    with pytest.raises(ScenarioError, match=r'connections.stiffness is "rigid": expected "elastic" with'):
        scenario_from_text(text)


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (
            tendon(f"points_m = [[0, 0, {MIDDLE_M}], [21, 0, {MIDDLE_M}]]"),
            r"tendons 'tendon' leaves deck at \(20.000, 0.000, 3.500\) m: expected all of its line within the member",
        ),
        (tendon(STRAIGHT).replace('"deck"', '"beam"'), 'tendons.member is "beam": expected the name of a member, one'),
        (
            tendon(STRAIGHT) + "[[tendon_cuts]]\ntime_s = 0.5\n",
            'tendon_cuts.lowest_corner_m is missing: expected both corners of a box, as "tendon" is bonded',
        ),
        (
            tendon(STRAIGHT) + "[[tendon_cuts]]\ntime_s = 0.5\n" + BOX.replace("3.0]", "3.9]"),
            "tendon_cuts at 0.5 s: no tendon is there",
        ),
    ],
)
def test_refused_models(more, message):
    with pytest.raises(ScenarioError, match=message):
        checked_model(scenario_from_text(beam_text(more)))


def test_a_cut_in_a_box_is_in_the_middle_of_it():
    scenario = scenario_from_text(beam_text(tendon(STRAIGHT) + "[[tendon_cuts]]\ntime_s = 0.5\n" + BOX))
    assert isinstance(scenario.tendon_cuts[0], TendonCut)
    model = checked_model(scenario)
    assert model.tendons.within_box(0, TurnedBox((9.0, -1.0, 3.0), (11.0, 1.0, 4.0))) == pytest.approx(10.0)
    assert model.tendons.within_box(0, TurnedBox((9.0, -1.0, 3.9), (11.0, 1.0, 4.0))) is None
    # Turned by a right angle it is 2 m long across the road, and as wide along it.
    turned = TurnedBox((9.5, -1.0, 3.0), (11.5, 1.0, 4.0), 90.0)
    assert model.tendons.within_box(0, turned) == pytest.approx(10.5)
