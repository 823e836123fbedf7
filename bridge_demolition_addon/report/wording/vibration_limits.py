"""Limits of the ground's velocity by codes: which are reached, and the table of all."""

from __future__ import annotations

from ...model.debris.vibration_limits import FREQUENCIES_HZ, LIMITS, reached
from ...texts import Text, joined
from ..document.blocks import Column, DataTable

_MM_PER_M = 1e3


def limits_text(velocity_m_s: float, frequency_hz: float) -> str:
    """Return the buildings whose limits a velocity reaches at a frequency."""
    return joined("{}, {}", [limit.building for limit in reached(velocity_m_s, frequency_hz)]) or Text("none")


def limit_table() -> DataTable:
    """Return the limits of all kinds of buildings by frequency."""
    columns = (
        Column("building", "building", "", lambda limit: limit.building),
        *(_at(frequency_hz) for frequency_hz in FREQUENCIES_HZ),
        Column("source", "source", "", lambda limit: limit.source),
    )
    return DataTable.of("vibration_limits", "Limits of the ground's velocity, at the foundation", columns, LIMITS)


def _at(frequency_hz: float) -> Column:
    name = f"{frequency_hz:g}"
    return Column(
        Text("{} Hz", name), f"at_{name}_Hz_mm_s", ".1f", lambda limit: _MM_PER_M * limit.at_m_s(frequency_hz)
    )
