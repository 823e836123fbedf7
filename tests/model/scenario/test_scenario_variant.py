# SPDX-License-Identifier: GPL-3.0-or-later
"""Variants of a scenario file: what they take over, change and leave out, and what is refused."""

import shutil
from dataclasses import replace

import pytest
from support.checkout import I235_FILE
from support.scenarios import I235

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_from_text


@pytest.fixture
def folder(tmp_path):
    shutil.copy(I235_FILE, tmp_path / "base.toml")
    return tmp_path


def variant(folder, heading="", rest="", name="variant.toml", base="base.toml"):
    path = folder / name
    path.write_text(f'[scenario]\nbased_on = "{base}"\n{heading}\n{rest}', encoding="utf-8")
    return path


def test_what_is_not_said_is_taken_over(folder):
    assert read_scenario(variant(folder)) == I235


def test_keys_are_merged_and_values_and_lists_of_tables_replaced(folder):
    rest = '[ball]\ntarget_m = [2.0, 1.0]\n[bridge.deck]\nthickness_m = 0.5\n[[zones]]\nname = "Path"\n'
    rest += 'kind = "other"\ncorners_m = [[0, 9], [5, 9], [5, 10]]\n'
    varied = read_scenario(variant(folder, 'title = "Other"\nseed = 1', rest))
    assert (varied.title, varied.seed, varied.time) == ("Other", 1, I235.time)
    assert varied.ball == replace(I235.ball, target_m=(2.0, 1.0))
    assert varied.bridge.deck == replace(I235.bridge.deck, thickness_m=0.5)
    assert [zone.name for zone in varied.zones] == ["Path"]


def test_tables_and_keys_are_left_out(folder):
    without = 'without = ["ball", "zones", "bridge.pier_caps", "bridge.mass_kg"]'
    varied = read_scenario(variant(folder, without, "[bridge]\ndensity_kg_m3 = 2400"))
    bridge = replace(I235.bridge, pier_caps=None, mass_kg=None, density_kg_m3=2400)
    assert varied == replace(I235, ball=None, zones=(), bridge=bridge)


def test_a_variant_of_a_variant(folder):
    variant(folder, 'title = "Second"\nseed = 2', "[ball]\ndrop_height_m = 7.0")
    varied = read_scenario(variant(folder, 'title = "Third"', name="third.toml", base="variant.toml"))
    assert varied == replace(I235, title="Third", seed=2, ball=replace(I235.ball, drop_height_m=7.0))


def test_paths_are_given_from_the_file_that_they_stand_in(folder):
    (folder / "inner").mkdir()
    variant(
        folder, rest='[[geometry]]\nname = "a"\nfile = "wall.stl"\nmass_kg = 1\n[fracture]\npoints_file = "points.csv"'
    )
    varied = read_scenario(variant(folder / "inner", base="../variant.toml"))
    assert varied.geometry[0].file == str(folder.resolve() / "wall.stl")
    assert varied.fracture.points_file == str(folder.resolve() / "points.csv")


@pytest.mark.parametrize(
    ("heading", "rest", "message"),
    (
        ('without = ["bal"]', "", 'scenario.without names "bal", which is not in the file it is based on'),
        ('without = ["bridge.deck.width_m.x"]', "", "scenario.without names"),
        ('without = "ball"', "", "expected a list of tables and keys"),
        ("without = [1]", "", "expected a list of tables and keys"),
        ('without = ["ball.mass_kg"]', "", "ball.mass_kg is missing"),
        ("", "[ball]\nmass = 1", "ball.mass is unknown: did you mean ball.mass_kg?"),
        ("", "[[ball]]\nmass_kg = 1", "ball is "),
    ),
)
def test_what_is_refused(folder, heading, rest, message):
    path = variant(folder, heading, rest)
    with pytest.raises(ScenarioError) as caught:
        read_scenario(path)
    assert message in str(caught.value) and str(path) in str(caught.value)


@pytest.mark.parametrize(
    ("base", "message"),
    (
        ("nowhere.toml", 'based on "nowhere.toml": no such file'),
        ("variant.toml", 'is based on "variant.toml", which is based on it in turn'),
        (" ", 'scenario.based_on is " ": expected the path of a scenario file'),
    ),
)
def test_a_base_that_cannot_be(folder, base, message):
    with pytest.raises(ScenarioError) as caught:
        read_scenario(variant(folder, base=base))
    assert message in str(caught.value)


def test_two_that_are_based_on_each_other(folder):
    variant(folder, name="first.toml", base="second.toml")
    with pytest.raises(ScenarioError, match="in turn"):
        read_scenario(variant(folder, name="second.toml", base="first.toml"))


def test_a_chain_of_variants_has_an_end(folder):
    for number in range(1500):
        variant(folder, name=f"{number}.toml", base=f"{number + 1}.toml")
    with pytest.raises(ScenarioError, match="at most 20 files that are based on each other"):
        read_scenario(folder / "0.toml")


def test_a_base_larger_than_any_scenario_is_not_read(folder):
    with (folder / "large.toml").open("wb") as file:
        file.truncate(10_000_001)
    with pytest.raises(ScenarioError, match=r"has 10\.0 MB: expected at most 10 MB"):
        read_scenario(folder / "large.toml")


def test_leaving_out_needs_a_base(folder):
    path = folder / "alone.toml"
    path.write_text(I235_FILE.read_text().replace("[scenario]", '[scenario]\nwithout = ["ball"]'))
    with pytest.raises(ScenarioError, match=r"scenario\.without needs scenario\.based_on"):
        read_scenario(path)


def test_a_text_without_a_place_is_based_on_nothing():
    with pytest.raises(ScenarioError, match=r"scenario\.based_on is unknown"):
        scenario_from_text('[scenario]\nbased_on = "base.toml"')
