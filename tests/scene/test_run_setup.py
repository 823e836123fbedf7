# SPDX-License-Identifier: GPL-3.0-or-later
"""All that decides a run is a field of its setup, and the digest, manual edits and scenario follow from the fields."""

from collections import Counter
from dataclasses import dataclass, fields, replace

import pytest
from support.checkout import SMALL

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.scene.run_setup import RunSetup, decides, run_setup_of
from bridge_demolition_addon.simulation.recording.recorder import Recording

FEW_FRAMES_S = 4 / 24


@pytest.fixture
def scenario():
    scenario = read_scenario(SMALL)
    return replace(scenario, ball=None, time=replace(scenario.time, duration_s=FEW_FRAMES_S))


@pytest.fixture
def scene(blender, scenario):
    from bridge_demolition_addon.scene.demolition import build_demolition

    build_demolition(blender.context.scene, scenario, checked_model(scenario))
    return blender.context.scene


def wind_is_in_no_scenario(wind_n, scenario):
    if wind_n:
        raise ScenarioError("wind")
    return scenario


@dataclass(frozen=True, eq=False)
class WindySetup(RunSetup):
    wind_n: float = decides(
        hashed=lambda setup: {"wind_n": setup.wind_n},
        compared={"wind": lambda setup: {"wind_n": setup.wind_n}},
        written=(wind_is_in_no_scenario,),
    )


def test_one_more_field_is_in_the_digest_in_what_is_compared_and_in_the_scenario(scene, scenario):
    setup = run_setup_of(scene)
    known = {item.name: getattr(setup, item.name) for item in fields(setup)}
    still, storm = WindySetup(**known, wind_n=0.0), WindySetup(**known, wind_n=5e3)
    assert len({setup.digest, still.digest, storm.digest}) == 3
    assert {name for name, digest in storm.compared().items() if still.compared()[name] != digest} == {"wind"}
    assert still.effective_scenario(scenario) == (scenario, [])
    assert storm.effective_scenario(scenario) == (scenario, ["wind"])


@pytest.mark.parametrize("item", fields(RunSetup), ids=lambda item: item.name)
def test_a_field_says_what_follows_from_it_or_why_nothing_does(item):
    for use in ("hashed", "compared", "written"):
        said = item.metadata[use]
        assert said and (len(said.split()) > 1 if isinstance(said, str) else True)


def test_no_field_hides_what_another_has_in_the_digest(scene):
    setup = run_setup_of(scene)
    uses = [item.metadata["hashed"] for item in fields(setup)]
    names = Counter(name for hashed in uses if callable(hashed) for name in hashed(setup))
    assert [name for name, count in names.items() if count > 1] == []


def test_a_recording_has_the_setup_that_its_scene_has_when_it_begins(scene, tmp_path):
    from bridge_demolition_addon.simulation.playback import play_alone

    recording = Recording(scene, tmp_path)
    scene.gravity.z = -1.62
    play_alone(recording)
    assert recording.setup.gravity_m_s2[2] == pytest.approx(-1.62)
    assert recording.setup.digest == run_setup_of(scene).digest
