"""What makes the outcome of a run doubtful, as its summary has it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..results.moving import moving_text
from .bare_bars import bare_bars_text
from .held_parts import held_parts_text, pick_texts
from .undisturbed import self_collapse_text


def doubts_of_run(summary: Mapping[str, Any]) -> tuple[str, ...]:
    """Return all that is doubtful as sentences without full stops."""
    of_parts = held_parts_text(summary), *pick_texts(summary)
    texts = self_collapse_text(summary), *of_parts, bare_bars_text(summary), moving_text(summary)
    return tuple(text for text in texts if text)
