"""Parts that a crane took away in a run: what still held them, and what they weigh."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...engineering.units import STANDARD_GRAVITY_M_S2
from ..lifts import Pick


def held_parts_text(summary: Mapping[str, Any]) -> str:
    """Return what the events of a summary say of them, as a sentence without a full stop; empty for nothing."""
    held = [event for event in summary.get("events", ()) if event.get("held_by")]
    if not held:
        return ""
    parts = ", and ".join(f"lift {event['lift']!r} by {', '.join(event['held_by'])}" for event in held)
    return (
        f"Parts were still held when the crane lifted them away: {parts}. The run took them out nevertheless; a crane "
        "cannot. Cut them free before, or lift later"
    )


def pick_texts(summary: Mapping[str, Any]) -> tuple[str, ...]:
    """Return which parts weigh otherwise by their volume, by a summary, as sentences without full stops."""
    masses_kg = (
        (lift["name"], *(lift[key] / STANDARD_GRAVITY_M_S2 for key in ("weight_N", "volume_weight_N")))
        for lift in summary.get("lifts", ())
        if "volume_weight_N" in lift  # earlier versions did not say
    )
    return tuple(filter(None, (Pick(*values).warning for values in masses_kg)))
