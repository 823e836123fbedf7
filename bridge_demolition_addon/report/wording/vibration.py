"""What a report says of vibration: the law of a site, and limits of codes that are reached."""

from __future__ import annotations

from ...engineering.blast.site_law import CONFIDENCE, SiteLaw
from ...model.blast.vibration_laws import OF_CHARGES
from ...model.debris.vibration_limits import FREQUENCIES_HZ, LIMITS, reached
from ...texts import Text, joined
from ..document.blocks import Column, DataTable


def limits_text(velocity_m_s: float, frequency_hz: float) -> str:
    """Return the buildings whose limits a velocity reaches at a frequency."""
    return joined("{}, {}", [limit.building for limit in reached(velocity_m_s, frequency_hz)]) or Text("none")


def limit_table() -> DataTable:
    """Return the limits of every kind of building by frequency."""
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


_MM_PER_M = 1e3
_PERCENT = 100.0


def site_law_text(law: SiteLaw, of: str) -> Text:
    """Return what a law says, what it was fitted to, and what its band is for."""
    size, unit = (Text("Q the kg within 8 ms"), "m/√kg") if of == OF_CHARGES else (Text("Q its energy in kJ"), "m/√kJ")
    return Text(
        "Vibration by the law of this site, v = {} mm/s (R/√Q)^-{} with {}, fitted to {} events that were measured at "
        "scaled distances of {} to {} {}. What is held against limits is the upper line of the band in which {} % of "
        "new events lie.",
        f"{_MM_PER_M * law.velocity_m_s:.4g}",
        f"{law.exponent:.3g}",
        size,
        law.events,
        f"{law.nearest:.3g}",
        f"{law.farthest:.3g}",
        unit,
        f"{_PERCENT * CONFIDENCE:g}",
    )


def extrapolated_text(neighbour: str) -> Text:
    """Return that the law was measured at other scaled distances than a neighbour's."""
    return Text(
        "{}: its scaled distance is outside those that were measured, so that the law of the site is extrapolated.",
        neighbour,
    )
