"""What makes the outcome of a run doubtful, as its summary has it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..results.moving import gone_text, moving_text
from ..results.solver_energy import much_made_text
from .bare_bars import bare_bars_text
from .ending import Ending
from .held_parts import held_parts_text, pick_texts
from .undisturbed import self_collapse_text


def doubts_of_run(summary: Mapping[str, Any]) -> tuple[str, ...]:
    """Return all that is doubtful as sentences without full stops, what has to be said before any result first."""
    of_parts = held_parts_text(summary), *pick_texts(summary)
    texts = *first_doubts(summary), self_collapse_text(summary), *of_parts, bare_bars_text(summary)
    return tuple(text for text in texts if text)


def first_doubts(summary: Mapping[str, Any]) -> tuple[str, ...]:
    """Return what has to be said before any result: no loads, no outcome, still moving, or energy gained."""
    energy, stability = summary.get("energy"), summary.get("stability") or {}
    made = energy["made_by_solver"]["share_of_dissipated"] if energy else 0.0
    texts = (
        only_motion_text(summary),
        gone_text(summary),
        much_made_text(made),
        Ending.of(summary).text,
        moving_text(summary),
        *stability.get("unusual", ()),
    )
    return tuple(text for text in texts if text)


def only_motion_text(summary: Mapping[str, Any]) -> str:
    """Return that no loads are known, as a sentence without a full stop, with the reason; empty where they are."""
    reason = summary.get("only_motion_because")
    return (
        f"Only motion was recorded: what connections carry, and which broke, is not known. {reason}" if reason else ""
    )
