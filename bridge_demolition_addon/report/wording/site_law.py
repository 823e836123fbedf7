"""What a report says of the law of a site, by which its ground carries vibration."""

from __future__ import annotations

from ...engineering.blast.site_law import CONFIDENCE, SiteLaw
from ...model.blast.vibration_laws import OF_CHARGES
from ...texts import Text

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
