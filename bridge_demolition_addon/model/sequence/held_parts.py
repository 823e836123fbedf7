"""Parts that a crane took away in a run although something still held them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


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
