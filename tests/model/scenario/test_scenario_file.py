# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenario files: read strictly, written without loss."""

import os
import tomllib
from dataclasses import replace

import numpy as np
import pytest
from support.checkout import DEMOLITIONS
from support.scenarios import I235

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.bridge import bridge_density, bridge_members
from bridge_demolition_addon.model.scenario import (
    Bridge,
    ConnectionSettings,
    Deck,
    FractureSettings,
    Piers,
    Scenario,
    TimeSettings,
)
from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_from_text, scenario_text

BARE = Scenario(
    title='A "quoted" back\\slash, Brücke, 다리, 🌉',
    time=TimeSettings(duration_s=0.1),
    bridge=Bridge(
        density_kg_m3=1e5,
        span_lengths_m=[13, 0.1 + 0.2, 1e3 / 3, 1e-3 + 1e-16],
        deck=Deck(width_m=8.5, thickness_m=0.25),
        piers=Piers(column_length_m=1e-3, column_width_m=1, height_m=1e-3),
    ),
    fracture=FractureSettings(shards=1),
    connections=ConnectionSettings(method="face", breaking_force_n=1e-7, foundation=False),
)


@pytest.mark.parametrize("path", DEMOLITIONS.values(), ids=lambda path: path.name)
def test_examples_are_read_and_written_without_loss(path):
    scenario = read_scenario(path)
    assert scenario_from_text(scenario_text(scenario)) == scenario


def test_old_paths_of_the_examples_of_2019_lead_to_where_they_are_now(tmp_path, caplog):
    (tmp_path / "report_2019").mkdir()
    moved = tmp_path / "report_2019" / "bare.toml"
    moved.write_text(scenario_text(BARE), encoding="utf-8")
    (tmp_path / "deeper").mkdir()
    variant = tmp_path / "deeper" / "variant.toml"
    variant.write_text('[scenario]\nbased_on = "../bare.toml"\n', encoding="utf-8")
    assert read_scenario(tmp_path / "bare.toml") == read_scenario(variant) == BARE
    assert [record.getMessage() for record in caplog.records] == [f"{tmp_path / 'bare.toml'} is now {moved}"] * 2
    # A file that is where it is asked for comes first, and what is nowhere is missed where it was asked for.
    other = replace(BARE, title="other")
    (tmp_path / "bare.toml").write_text(scenario_text(other), encoding="utf-8")
    assert read_scenario(tmp_path / "bare.toml") == read_scenario(variant) == other
    assert len(caplog.records) == 2
    with pytest.raises(ScenarioError, match=r"none\.toml: no such file"):
        read_scenario(tmp_path / "none.toml")


def test_what_is_left_out_stays_left_out():
    text = scenario_text(BARE)
    assert scenario_from_text(text) == BARE
    keys = {"span_lengths_m", "density_kg_m3", "skew_deg", "merge", "deck", "piers"}
    assert set(tomllib.loads(text)["bridge"]) == keys
    assert "ball" not in tomllib.loads(text)


@pytest.mark.slow
def test_any_number_is_written_without_loss():
    random = np.random.default_rng(235)
    for mass, friction, radius in np.exp(random.uniform(-80, (20, 4, 13), (200, 3))):
        scenario = replace(
            I235,
            seed=int(random.integers(2**31)),
            bridge=replace(I235.bridge, mass_kg=mass),
            connections=replace(I235.connections, search_radius_m=radius),
            ground=replace(I235.ground, friction=friction),
        )
        assert scenario_from_text(scenario_text(scenario)) == scenario


def test_bytes_that_windows_editors_add_are_no_error(tmp_path):
    path = tmp_path / "windows.toml"
    path.write_bytes(b"\xef\xbb\xbf" + scenario_text(BARE).replace("\n", "\r\n").encode())
    assert read_scenario(path) == BARE
    assert read_scenario(os.fspath(path)) == BARE
    path.write_bytes(scenario_text(BARE).replace("\n", "\r").encode())  # as programs of old Macintoshes end lines
    assert read_scenario(path) == BARE


def test_the_error_names_the_path_as_given(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ScenarioError, match=r"^missing\.toml: no such file"):
        read_scenario("missing.toml")


def test_i235_weighs_what_the_2019_report_says():
    members = bridge_members(I235.bridge)
    density = bridge_density(I235.bridge, members)
    mass = {member.name: member.volume_m3 * density for member in members}
    # 107 t for one span and 196 t for two leave 71 t for a deck and 18 t for a pier; the sizes give it within 0.1 t.
    assert sum(mass.values()) == pytest.approx(107_000)
    assert mass["deck"] == pytest.approx(71_000, abs=100)
    assert sum(mass[name] for name in mass if name.startswith("pier 1")) == pytest.approx(18_000, abs=100)
    assert density == pytest.approx(2390, abs=5)


def test_i235_has_the_parameters_of_the_2019_report():
    assert I235.fracture.shards == 200
    assert I235.ball.mass_kg == 10_000
    assert I235.ball.density_kg_m3 == pytest.approx(7850, rel=0.02)  # steel
    connections = I235.connections
    assert (connections.type, connections.method, connections.limit_per_shard) == ("HINGE", "vertex", 50)
    assert (connections.search_radius_m, connections.breaking_force_kgf) == (1.0, 10_000)


def test_a_default_strength_is_written_with_what_ran():
    connections = ConnectionSettings(method="face")
    large = replace(I235, connections=connections, fracture=FractureSettings(shards=1000))
    assert 'material = "reinforced concrete slab"' in scenario_text(large)
    assert scenario_from_text(scenario_text(large)) == large
