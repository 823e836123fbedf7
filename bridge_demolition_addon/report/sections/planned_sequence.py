"""The planned sequence in a report: what is done to the bridge, where and when."""

from __future__ import annotations

import math

from ...model.scenario import Scenario
from ...texts import Text
from ..document.blocks import Column, DataTable, Paragraph, Section
from ..wording.sequence import planned_steps

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
