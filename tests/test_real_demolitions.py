# SPDX-License-Identifier: GPL-3.0-or-later
"""Real demolitions: one set of settings for all, a forecast that stays, and what is measured of a run."""

import tomllib
from types import SimpleNamespace

import blind
import numpy as np
import pytest
import real_demolitions
from real_demolitions import DEMOLITIONS, FOLDER, piers_that_stand, spans_down, time_down_s
from support.moving_boxes import moving_boxes

from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.study.file import read_study

NAMES = [demolition.name for demolition in DEMOLITIONS]
OF_A_CASE = {"scenario", "bridge", "dead_loads", "tendons", "ground", "blast", "blast_zones", "cuts", "exclusion"}
"""What a case may say of itself; all else, such as time, fineness, strengths and contacts, is that of all."""

SCENARIO = SimpleNamespace(
    bridge=SimpleNamespace(span_lengths_m=(10.0, 10.0, 10.0)), blast=SimpleNamespace(start_s=0.5)
)


def document(name):
    return tomllib.loads((FOLDER / f"{name}.toml").read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", NAMES)
def test_a_case_has_nothing_but_its_bridge_its_ground_and_its_charges(name):
    own = document(name)
    assert own["scenario"]["based_on"] == "defaults.toml"
    assert set(own) <= OF_A_CASE and set(own["ground"]) == {"profile_m"} and set(own["blast"]) == {"start_s"}
    assert not [key for zone in own["blast_zones"] for key in zone if key in ("throw_kg_m3", "break_kg_m3")]
    planned, shared = read_scenario(FOLDER / f"{name}.toml"), read_scenario(FOLDER / f"{NAMES[0]}.toml")
    for table in ("time", "fracture", "connections", "shards", "contacts", "materials"):
        assert getattr(planned, table) == getattr(shared, table)


def test_studies_draw_what_is_guessed_and_the_same_otherwise():
    studies = [document(f"{name}_study") for name in NAMES]
    assert all(study["study"]["runs"] == 3 for study in studies)
    for key in ("connections.strength_factor", "contacts.ground.friction"):
        assert all(
            [vary for vary in study["vary"] if vary["key"] == key]
            == [vary for vary in studies[0]["vary"] if vary["key"] == key]
            != []
            for study in studies
        )
    for name in NAMES:
        read_study(FOLDER / f"{name}_study.toml")


def test_the_forecast_stays_and_the_page_says_what_became_of_it():
    outcome, forecast = blind.kept_outcome("real_demolitions"), blind.kept_forecast("real_demolitions")
    assert blind.digest("real_demolitions") == outcome.forecast_sha256
    asked = [f"{one.place}: {quantity}" for one in DEMOLITIONS for quantity, _, _ in one.asked]
    assert [row.quantity for row in forecast.foreseen] == asked
    page = real_demolitions.DOCUMENT.read_text(encoding="utf-8")
    assert page == real_demolitions.page(), "run: scripts/validate --page"
    hits = sum(row.has(measured) for row, measured in zip(forecast.foreseen, outcome.measured, strict=True))
    assert f"**{hits} of {len(asked)} quantities" in page and page.count("**missed**") == len(asked) - hits


def falling_deck(drops_m):
    """Three pieces of a deck, 9.5 m above the ground, of which each falls freely from 1 s on, for a height."""
    times = np.arange(0.0, 4.0, 0.01)
    positions = np.zeros((len(times), 3, 3))
    positions[..., 0] = [6.0, 16.0, 24.0]
    fallen = np.minimum(0.5 * 9.81 * np.clip(times - 1.0, 0.0, None)[:, None] ** 2, drops_m)
    positions[..., 2] = 9.5 - fallen
    return moving_boxes(times, np.full((3, 3), 1.0), positions, body_member_kinds=np.array(["deck"] * 3))


@pytest.mark.parametrize("drops_m, down", [((9.0, 9.0, 9.0), 3), ((0.0, 9.0, 4.0), 1), ((0.0, 0.0, 0.0), 0)])
def test_spans_are_down_with_half_of_their_height(drops_m, down):
    assert spans_down(falling_deck(drops_m), SCENARIO) == down


@pytest.mark.parametrize(
    "drops_m, stand", [((0, 0, 0), 2), ((9, 0, 0), 1), ((0, 9, 0), 1), ((9, 0, 9), 0), ((0.4, 0, 0.9), 2)]
)
def test_piers_stand_where_the_deck_is_as_high_as_it_was(drops_m, stand):
    """From half of a span to half of the next: a piece at 6 m above the pier at 10 m, two above that at 20 m."""
    assert piers_that_stand(falling_deck(drops_m), SCENARIO) == stand


def test_the_deck_is_down_when_it_fell_19_of_20_parts():
    """√(2 · 0.95 · 9 / 9.81) = 1.320 s of free fall, which begins 0.5 s after the first charge."""
    assert time_down_s(falling_deck((9.0, 9.0, 9.0)), SCENARIO) == pytest.approx(0.5 + 1.320, abs=0.011)
