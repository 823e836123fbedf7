"""The planned sequence of a scenario: what is done to the bridge, where and when, one line each."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ...engineering.units import mass_text
from ...model.actions import PlannedAction, PlannedStep, counted
from ...model.scenario import Equipment, Scenario
from ...texts import Text, joined, point_text


def planned_steps(scenario: Scenario) -> list[PlannedStep]:
    """Return all that is planned, machines on the bridge included, in order of time."""
    steps = [step for action in scenario.actions for step in action.planned(scenario)]
    steps += [_standing(machine) for machine in scenario.equipment]
    return sorted(steps, key=lambda step: step.begins_s)


def means_text(scenario: Scenario) -> str:
    """Return by which means the bridge is brought down, in a few words."""
    return joined("{}; {}", filter(None, _means(scenario))) or Text("nothing is done to the bridge")


def _means(scenario: Scenario) -> Iterator[str]:
    kinds: dict[type[PlannedAction], None] = dict.fromkeys(map(type, scenario.actions))
    yield from (kind.means([action for action in scenario.actions if type(action) is kind]) for kind in kinds)
    if scenario.equipment:
        yield counted(len(scenario.equipment), "machine")


def _standing(machine: Equipment) -> PlannedStep:
    until_s = math.inf if machine.until_s is None else machine.until_s
    what = Text("{} of {} stands on the bridge", machine.name, mass_text(machine.mass_kg, 1))
    return PlannedStep(machine.from_s, until_s, what, point_text(machine.position_m))
