"""The programme of works: a bar chart by tasks, and what is late."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from matplotlib.figure import FigureBase

from ...charts.style import plain
from ...engineering.timing.shifts import DAY_H, clock
from ...model.scenario import Scenario
from ...model.scenario.programme import Possession, ScheduledTask
from ...texts import Quantity, Text
from ..document.blocks import Block, Column, DataTable, Paragraph, Picture, Section

_TITLE = Text("Programme of works")
_BAR = 0.6
_ROW_MM, _FRAME_MM = 6.0, 22.0

_COLUMNS = (
    Column("task", "task", "", lambda row: row.task.name),
    Column("machine", "machine", "", lambda row: row.task.machine),
    Column(Text("from", context="time"), "from", "", lambda row: _when(row.begins_h)),
    Column("to", "to", "", lambda row: _when(row.ends_h)),
    Column("possession", "possession", "", lambda row: row.task.possession),
    Column("too late by", "late_h", ".1f", lambda row: row.late_h or None, unit="h"),
)


def programme_section(scenario: Scenario) -> Section | None:
    """Return the programme of works of a scenario; None where it has none."""
    programme = scenario.programme
    if programme is None or not programme.tasks:
        return None
    rows = programme.scheduled(scenario.machines)
    late = [row for row in rows if row.late_h > 0.0]
    blocks: list[Block] = [Paragraph(_late_text(row), is_notice=True) for row in late]
    draw = partial(programme_chart, rows=rows, possessions=programme.possessions)
    blocks.append(Picture(draw, _TITLE, _FRAME_MM + _ROW_MM * (len(rows) + len(programme.possessions))))
    blocks.append(DataTable.of("programme", _TITLE, _COLUMNS, rows))
    return Section(_TITLE, tuple(blocks))


def programme_chart(figure: FigureBase, rows: Sequence[ScheduledTask], possessions: Sequence[Possession]) -> None:
    """Draw a bar for each possession and each task over days; what is late in red."""
    axes = figure.subplots()
    names = [*(possession.name for possession in possessions), *(row.task.name for row in rows)]
    spans = [*((one.from_h, one.to_h) for one in possessions), *((row.begins_h, row.ends_h) for row in rows)]
    colours = [*("0.8" for _ in possessions), *("#b2182b" if row.late_h > 0.0 else "#2166ac" for row in rows)]
    for number, ((begins, ends), colour) in enumerate(zip(spans, colours, strict=True)):
        axes.barh(number, (ends - begins) / DAY_H, left=begins / DAY_H + 1.0, height=_BAR, color=colour)
    axes.set_yticks(range(len(names)), [plain(name) for name in names])
    axes.invert_yaxis()
    axes.set_xlabel(Text("day"))
    axes.grid(visible=True, axis="x", linewidth=0.4)


def _when(hour: float) -> Text:
    day, time = clock(hour)
    return Text("day {}, {}", day, time)


def _late_text(row: ScheduledTask) -> Text:
    return Text("{} ends {} too late for {}.", row.task.name, Quantity(row.late_h, "h", ".1f"), row.task.possession)
