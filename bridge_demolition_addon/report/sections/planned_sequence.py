"""The planned sequence of a scenario: what is done to the bridge, where and when."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ...engineering.units import mass_text
from ...model.actions import PlannedAction, PlannedStep, counted
from ...model.scenario import Equipment, Scenario
from ...texts import Text, joined, point_text
from ..document.blocks import Column, DataTable, Paragraph, Section


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


TITLE = Text("Planned sequence")


def _known(time_s: float) -> float | None:
    return time_s if math.isfinite(time_s) else None


_WORDS = Text(
    "Times are on the clock of the run. What is planned not to happen, such as a charge that does not fire, and "
    "what lasts to the end has no time. Charges are at the times of their delays."
)
_COLUMNS = (
    Column(Text("from", context="time"), "from_s", ".3f", lambda step: _known(step.begins_s)),
    Column("to", "to_s", ".3f", lambda step: _known(step.ends_s)),
    Column("what", "what", "", lambda step: step.what),
    Column("where", "where", "", lambda step: step.where or None),
)


def sequence_section(scenario: Scenario) -> Section:
    """Return what is planned, in order of time."""
    steps = planned_steps(scenario)
    if not steps:
        return Section(TITLE, (Paragraph("Nothing is done to the bridge."),))
    return Section(TITLE, (Paragraph(_words(scenario)), DataTable.of("sequence", TITLE, _COLUMNS, steps)))


def _words(scenario: Scenario) -> str:
    first_s = scenario.detonation_s(0.0)
    fires = (scenario.blast_zones or scenario.cuts or scenario.charges) and math.isfinite(first_s)
    return Text("{} The first possible detonation is at {} s.", _WORDS, f"{first_s:.3f}") if fires else _WORDS
