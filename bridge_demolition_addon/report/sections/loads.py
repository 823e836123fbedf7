"""Loads and pulls in a report of a run: their impulse and work, and the largest force in each cable."""

from __future__ import annotations

from ...texts import Text
from ..document.blocks import Column, DataTable, Paragraph, Section
from ..run_folder import ReportedRun

_KILO = 1000.0

_LOAD_COLUMNS = (
    Column("Load", "load", "", lambda load: load.name),
    Column("largest force", "largest_kN", ".1f", lambda load: load.largest_force_n / _KILO),
    Column("at", "at_s", ".3f", lambda load: load.largest_force_s),
    *(
        Column(
            f"impulse along {axis}",
            f"impulse_{axis}_kNs",
            ".2f",
            lambda load, row=row: load.impulse_ns[row] / _KILO,
            unit="kN·s",
        )
        for row, axis in enumerate("xyz")
    ),
    Column("work", "work_kJ", ".1f", lambda load: load.work_j / _KILO),
)


def load_section(run: ReportedRun) -> Section | None:
    """Return the section; None without loads."""
    loads = run.summary.loads if run.summary else ()
    return (
        Section("Loads", (DataTable.of("loads", "Loads that acted in this run", _LOAD_COLUMNS, loads),))
        if loads
        else None
    )


_DANGER = Text(
    "A cable that breaks whips back, and kills. Keep everybody off its line, and farther from both of its ends "
    "than it is long, as long as it has force; protect the one who works the winch. What is pulled over may fall "
    "farther than it is high. The cable is straight here, has no weight, and touches nothing."
)

_PULL_COLUMNS = (
    Column("Cable", "cable", "", lambda pull: pull.name),
    Column("largest force", "largest_kN", ".1f", lambda pull: pull.largest_force_n / _KILO),
    Column("at", "at_s", ".3f", lambda pull: pull.largest_force_s),
    Column("paid out from", "paid_out_s", ".3f", lambda pull: pull.paid_out_s),
    Column("work", "work_kJ", ".1f", lambda pull: pull.work_j / _KILO),
    Column("ended", "ended", "", lambda pull: Text(pull.ended or "held to the end")),
    Column("then", "ended_s", ".3f", lambda pull: pull.ended_s),
    Column(Text("let go", context="energy"), "let_go_kJ", ".1f", lambda pull: _in_thousands(pull.let_go_j)),
)

_HOOKS = (
    Column("Lift", "lift", "", lambda lift: lift.name),
    Column("weight", "weight_kN", ".1f", lambda lift: lift.weight_n / _KILO),
    Column("by volume", "volume_weight_kN", ".1f", lambda lift: _in_thousands(lift.volume_weight_n)),
    Column("largest load on the hook", "largest_hook_kN", ".1f", lambda lift: lift.largest_hook_n / _KILO),
    Column("by its weight", "by_weight", ".2f", lambda lift: lift.largest_hook_n / lift.weight_n),
    Column("at", "at_s", ".3f", lambda lift: lift.largest_hook_s),
)


def _in_thousands(value: float | None) -> float | None:
    return None if value is None else value / _KILO


def pull_section(run: ReportedRun) -> Section | None:
    """Return the section; None without cables."""
    pulls = run.summary.pulls if run.summary else ()
    if not pulls:
        return None
    table = DataTable.of("pulls", "Cables that pulled in this run", _PULL_COLUMNS, pulls)
    lifts = run.summary.lifts if run.summary else ()
    hooks = [DataTable.of("lifts", "Loads on the hooks of cranes in this run", _HOOKS, lifts)] if lifts else []
    return Section("Pulls", (Paragraph(_DANGER, is_notice=True), table, *hooks))
