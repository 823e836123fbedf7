# SPDX-License-Identifier: GPL-3.0-or-later
"""What is far from all that is usual is said, and what can have no meaning is refused."""

from dataclasses import replace

import pytest
from support.scenarios import I235

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.run_folder.summary import RunSummary
from bridge_demolition_addon.model.scenario import BlastZone, Charge, Equipment, Load, MemberCut, Neighbour
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.sequence.ending import first_doubts, unusable_texts
from bridge_demolition_addon.model.sequence.unusual import unusual_texts
from bridge_demolition_addon.report.languages.translation import Translation

# The bridge has 107 t, and so a weight of 1049 kN.
SMALL = replace(I235, fracture=replace(I235.fracture, shards=12), ball=None)
WEIGHT_N = 107_000 * 9.80665


def load(force_n, **values):
    return Load(members=("deck",), times_s=(0.0, 1.0), forces_n=(0.0, force_n), **values)


def charge(z_m=1.0, x_m=6.5, mass_kg=1.0):
    return Charge(position_m=(x_m, 0.0, z_m), mass_kg=mass_kg)


def zone(charge_g):
    return BlastZone(
        member="pier 1 column 1",
        middle_m=1.5,
        height_m=1.5,
        holes_a_row=5,
        depth_m=0.5,
        stemming_m=0.1,
        charge_g=charge_g,
    )


def machine(mass_kg):
    return Equipment(name="crane", mass_kg=mass_kg, position_m=(6.5, 0.0), footprint_m=(4.0, 3.0))


def cut(mass_kg):
    return MemberCut(member="pier 1 column 1", position_m=2.0, mass_kg=mass_kg)


UNUSUAL = (
    ({"loads": (load(10.0 * WEIGHT_N),)}, "Load 1 is 10 times the weight of the bridge (is it in N?)"),
    ({"ball": replace(I235.ball, mass_kg=1e6)}, "The ball of 1e+06 kg and 1.34 m has 7.94e+05 kg/m³; steel has 7850"),
    ({"ball": replace(I235.ball, mass_kg=1e6)}, "The ball is 9.35 times as heavy as the bridge"),
    (
        {"charges": (charge(5.4),)},
        "Charge 1 lies in deck: it counts as a bare charge in air; [[blast_zones]] have",
    ),
    ({"charges": (charge(-0.5),)}, "Charge 1 lies 0.5 m below the ground: it counts as a bare charge in air"),
    (
        {"charges": (charge(x_m=1013.5),)},
        "Charge 1 is 1000 m from the bridge: beyond 40 m its blast hardly",
    ),
    # 0.735 g in five holes of 0.7 m x 0.7 m x 1.5 m, where 73.5 g were meant.
    (
        {"blast_zones": (zone(0.0735),)},
        "Zone 1 has 0.0005 kg of explosive a m³ of concrete, blasting manuals and",
    ),
    ({"charges": (charge(mass_kg=735.0),)}, "735 kg of explosive beside drill holes are 6869 g a tonne of the bridge"),
    ({"cuts": (cut(735.0),)}, "735 kg of explosive beside drill holes are 6869 g a tonne of the bridge, recorded jobs"),
    (
        {"neighbours": (Neighbour(name="crane", position_m=(6.5, 0.0, 5.4)),)},
        "crane lies in deck, as no neighbour does",
    ),
    (
        {"charges": (charge(),), "neighbours": (Neighbour(name="house", position_m=(6.5, 0.0, 1.3)),)},
        "house is 0.3 m from Charge 1, as no neighbour is",
    ),
    ({"equipment": (machine(2_140_000.0),)}, "crane is 20 times as heavy as the bridge (is it in kg?)"),
)

USUAL = {
    "loads": (load(WEIGHT_N),),
    "ball": I235.ball,
    "charges": (charge(),),
    "blast_zones": (zone(73.5),),
    "cuts": (replace(cut(0.5), member="pier 2 column 1"),),
    "neighbours": (Neighbour(name="house", position_m=(6.5, 0.0, 3.0)),),
    "equipment": (machine(30_000.0),),
}


@pytest.mark.parametrize(("values", "text"), UNUSUAL, ids=[text[:20] for _, text in UNUSUAL])
def test_what_is_unusual_is_said_in_every_language(values, text):
    scenario = replace(SMALL, **values)
    said = unusual_texts(scenario, checked_model(scenario))
    assert any(sentence.startswith(text) for sentence in said), said
    for language in ("de", "es", "fr", "zh_hans"):
        translation = Translation.into(language)
        assert all(translation.text(sentence) != sentence for sentence in said) and not translation.missing


def doubts_of(values):
    return first_doubts(RunSummary.of(values))


def unusable(values):
    return unusable_texts(RunSummary.of(values))


def test_a_run_whose_shards_left_by_kilometres_is_not_to_be_used():
    thrown = {"largest_throw": {"throw_m": 1057e3, "body": "Shard 3"}, "moving_at_end": None, "simulated_s": 1.0}
    rising = {"fastest_m_s": 4947.0, "body": "Shard 3", "member": "deck", "shards": 1, "of_shards": 8, "mass_kg": 1e3}
    assert doubts_of(thrown)[0].startswith("This run is not to be used: Shard 3 flew 1057.0 km")
    assert doubts_of({"moving_at_end": rising})[0].startswith(
        "This run is not to be used: Shard 3 still moves at 4947 m/s"
    )
    assert doubts_of(thrown | {"largest_throw": {"throw_m": 160.0, "body": "Shard 3"}}) == ()
    for language in ("de", "es", "fr", "zh_hans"):
        translation = Translation.into(language)
        assert translation.text(doubts_of(thrown)[0]) and not translation.missing


def test_what_makes_a_run_unusable_is_said_of_quiet_runs_too():
    made = {"energy": {"made_by_solver": {"share_of_dissipated": 0.592}}, "moving_at_end": None, "simulated_s": 1.0}
    thrown = made | {"largest_throw": {"throw_m": 1057e3, "body": "Shard 3"}}
    starts = [text.split(":")[0] for text in unusable(thrown)]
    assert starts == ["This run is not to be used", "This run is not to be used for distances"]
    assert "59.2 %" in unusable(made | {"largest_throw": {"throw_m": 1.0, "body": "Shard 3"}})[0]
    less = {"energy": {"made_by_solver": {"share_of_dissipated": 0.049}}}
    assert unusable(thrown | less | {"largest_throw": {"throw_m": 1.0, "body": "Shard 3"}}) == ()


@pytest.mark.parametrize("name", USUAL)
def test_what_is_usual_is_not_said(name):
    scenario = replace(SMALL, **{name: USUAL[name]})
    assert unusual_texts(scenario, checked_model(scenario)) == ()


@pytest.mark.parametrize(
    ("values", "text"),
    [
        (
            {"loads": (load(1e12),)},
            r"loads\.forces_n\.2 is 1e\+12: expected at most 1\.05e\+10 \(N\), 10000 t",
        ),
        (
            {"charges": (charge(-50.0),)},
            r"charges\.position_m\.3 of Charge 1 is -50: expected a charge in air, this one",
        ),
    ],
)
def test_what_can_have_no_meaning_is_refused(values, text):
    with pytest.raises(ScenarioError, match=text):
        checked_model(replace(SMALL, **values))
