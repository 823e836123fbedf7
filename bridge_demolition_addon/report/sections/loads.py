"""Loads and pressures that acted in a run: the largest force of each, its impulse and its work."""

from __future__ import annotations

from ..document.blocks import Column, DataTable, Section
from ..run_folder import ReportedRun

_KILO = 1000.0

_COLUMNS = (
    Column("Load", "load", "", lambda load: load["name"]),
    Column("largest force", "largest_kN", ".1f", lambda load: load["largest_force_N"] / _KILO),
    Column("at", "at_s", ".3f", lambda load: load["largest_force_s"]),
    *(
        Column(
            f"impulse along {axis}",
            f"impulse_{axis}_kNs",
            ".2f",
            lambda load, row=row: load["impulse_Ns"][row] / _KILO,
            unit="kN·s",
        )
        for row, axis in enumerate("xyz")
    ),
    Column("work", "work_kJ", ".1f", lambda load: load["work_J"] / _KILO),
)


def load_section(run: ReportedRun) -> Section | None:
    """Return the section; None without loads."""
    loads = run.summary.loads if run.summary else []
    return (
        Section("Loads", (DataTable.of("loads", "Loads that acted in this run", _COLUMNS, loads),)) if loads else None
    )
