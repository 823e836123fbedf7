"""Tendons in a report of a run: the energy in each, and what it let go at once as it was cut or ruptured."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ...texts import Text, joined
from ..document.blocks import Column, DataTable, Paragraph, Section
from ..run_folder import ReportedRun

_KILO = 1000.0

_DANGER = Text(
    "Energy of tendons is let go at once and hurts people: strands and anchorages fly out along the line of a "
    "tendon. Keep everybody off that line and away from both anchorages from before a cut until all of them are "
    "known to be without force. How far parts fly is not simulated."
)

_COLUMNS = (
    Column("Tendon", "tendon", "", lambda tendon: tendon["name"]),
    Column("in", "member", "", lambda tendon: tendon["member"]),
    Column("force", "force_kN", ".0f", lambda tendon: tendon["force_N"] / _KILO),
    Column("energy", "stored_kJ", ".1f", lambda tendon: tendon["stored_J"] / _KILO),
    Column(Text("let go", context="energy"), "released_kJ", ".1f", lambda tendon: _released_j(tendon) / _KILO),
    Column("at", "first_s", ".3f", lambda tendon: tendon["released"][0]["time_s"] if tendon["released"] else None),
    Column("how", "how", "", lambda tendon: _how(tendon)),
)


def tendon_section(run: ReportedRun) -> Section | None:
    """Return the section; None without tendons."""
    tendons = run.summary.tendons if run.summary else []
    if not tendons:
        return None
    table = DataTable.of("tendons", "Tendons, and the energy that they let go in this run", _COLUMNS, tendons)
    return Section("Tendons", (Paragraph(_DANGER, is_notice=True), table))


def _how(tendon: Mapping[str, Any]) -> str:
    return joined("{}, {}", [Text(how) for how in dict.fromkeys(part["how"] for part in tendon["released"])])


def _released_j(tendon: Mapping[str, Any]) -> float:
    return math.fsum(part["energy_J"] for part in tendon["released"])
