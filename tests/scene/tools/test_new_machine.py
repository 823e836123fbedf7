# SPDX-License-Identifier: GPL-3.0-or-later
"""A new machine is a table, its maker in the scene, and a line of registration for each of them."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
import pytest
from support.checkout import I235_FILE

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.display.camera_targets import points_to_see
from bridge_demolition_addon.errors import GeometryError, ScenarioError
from bridge_demolition_addon.model.actions import PlannedAction
from bridge_demolition_addon.model.scenario import Scenario, file
from bridge_demolition_addon.model.schema import key
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.sequence.ending import first_event_s, last_event_s


@dataclass(frozen=True, slots=True, kw_only=True)
class Ram(PlannedAction):
    """A ball of steel that a machine pushes along a line."""

    table: ClassVar[str] = "rams"

    start_time_s: float = key("When it begins to move.", unit="s", at_least=0)
    end_time_s: float = key("When it stops.", unit="s", above=0)
    from_m: tuple[float, float, float] = key("Its middle before.", unit="m")
    to_m: tuple[float, float, float] = key("Its middle at the end.", unit="m")
    diameter_m: float = key("Diameter.", default=0.8, unit="m", above=0)

    @property
    def held_by_machine(self):
        return self.table

    def positions(self, times_s):
        share = np.clip((times_s - self.start_time_s) / (self.end_time_s - self.start_time_s), 0.0, 1.0)
        return np.array(self.from_m) + share[:, None] * (np.array(self.to_m) - self.from_m)

    def begins_s(self, plan):
        return self.start_time_s

    def ends_s(self, plan):
        return self.end_time_s

    def scaled_in_time(self, factor):
        return replace(self, start_time_s=self.start_time_s * factor, end_time_s=self.end_time_s * factor)

    def points_of_interest(self, height_at) -> Iterator[tuple[float, float, float]]:
        yield self.from_m

    def facts(self, site):
        yield f"{self.start_time_s:.3f} s", f"ram until {self.end_time_s:g} s"

    def check_plan(self, plan):
        if self.end_time_s > plan.time.duration_s:
            raise self.unexpected("end_time_s", "a time within the run")

    def check_model(self, site):
        if member := site.member_within(self.from_m, self.diameter_m / 2.0):
            raise GeometryError(f"The ram begins within {member}.")


def create_ram(site, ram):
    from bridge_demolition_addon.engineering.geometry.solids import sphere
    from bridge_demolition_addon.scene.bodies import Kind, create_body, mesh_of
    from bridge_demolition_addon.scene.tools.keyframes import key_values

    body = create_body(site.world, mesh_of("Ram", sphere(ram.diameter_m / 2.0, 16)), Kind.TOOL, "SPHERE")
    body.rigid_body.type, body.rigid_body.kinematic = "PASSIVE", True
    frames, times_s = site.frames_and_times()
    body.location = ram.from_m
    key_values(body, "location", frames, ram.positions(times_s))


@dataclass(frozen=True, slots=True, kw_only=True)
class ScenarioWithRams(Scenario):
    """A scenario with the field that registers the machine."""

    rams: tuple[Ram, ...] = ()


TABLES = """
[scenario]
based_on = '{base}'
without = ["ball"]
[time]
duration_s = 0.75
[fracture]
shards = 30
[[rams]]
start_time_s = 0.25
end_time_s = 0.625
from_m = [6.5, -6.0, 5.3]
to_m = [6.5, -3.0, 5.3]
"""


@pytest.fixture
def path(tmp_path, monkeypatch):
    """File of a scenario with a ram that is pushed against the side of the deck, where rams are registered."""
    monkeypatch.setattr(file, "Scenario", ScenarioWithRams)
    path = tmp_path / "rammed.toml"
    path.write_text(TABLES.format(base=I235_FILE), encoding="utf-8")
    return path


def test_it_begins_ends_and_is_seen(path):
    scenario = file.read_scenario(path)
    assert file.scenario_from_text(file.scenario_text(scenario)) == scenario
    assert (first_event_s(scenario), last_event_s(scenario)) == (0.25, 0.625)
    assert first_event_s(replace(scenario, rams=())) == math.inf
    points = points_to_see(scenario, checked_model(scenario).members)
    assert (6.5, -6.0, 5.3) in map(tuple, points.tolist())


def test_it_is_described_and_checked(path, capsys):
    assert main(["check", str(path)]) == 0
    lines = [" ".join(line.split()) for line in capsys.readouterr().out.splitlines()]
    assert lines[lines.index("Sequence") + 1] == "0.250 s ram until 0.625 s"
    scenario = file.read_scenario(path)
    (ram,) = scenario.rams
    with pytest.raises(ScenarioError, match=r"rams.end_time_s is 2.0: expected a time within the run"):
        replace(scenario, rams=[replace(ram, end_time_s=2.0)])
    with pytest.raises(GeometryError, match="The ram begins within deck"):
        checked_model(replace(scenario, rams=[replace(ram, from_m=ram.to_m)]))


def test_it_is_built_pushes_and_is_scaled_in_time(blender, path, tmp_path, monkeypatch):
    from bridge_demolition_addon.scene import demolition
    from bridge_demolition_addon.scene.run_setup import run_setup_of
    from bridge_demolition_addon.simulation.motion_run import motion_run

    monkeypatch.setitem(demolition.TOOLS, Ram, create_ram)
    scenario = file.read_scenario(path)
    (ram,) = scenario.rams
    with motion_run(scenario, checked_model(scenario), tmp_path) as (results, summary):
        frames = results.frames
        (row,) = results.inventory.of_kind("tool")
        np.testing.assert_allclose(frames.positions_m[:, row], ram.positions(frames.time_s), atol=1e-4)
        shards = results.inventory.of_kind("shard")
        moved_m = frames.positions_m[-1, shards, 1] - frames.positions_m[0, shards, 1]
        assert moved_m.max() > 0.5
        assert summary["fell_by_itself"] is None
    scene = blender.context.scene
    scene.render.fps *= 2
    as_run, unsaid = run_setup_of(scene).effective_scenario(scenario)
    assert unsaid == []
    assert as_run.rams == (replace(ram, start_time_s=0.125, end_time_s=0.3125),)
