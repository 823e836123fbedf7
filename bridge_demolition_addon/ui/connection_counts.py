"""Connections that cracked, yielded or tore, as a line of a panel."""

from __future__ import annotations

from ..model.results.connection_counts import ConnectionCounts
from .languages.words import translated


def counts_line(counts: ConnectionCounts) -> str:
    """Return the line, as `ConnectionCounts.text` has it."""
    count = counts.connections
    if counts.cracked is None:
        return translated("Cracked or torn: {} of {} connections").format(counts.broken, count)
    if not counts.cracked:
        return translated("Torn: {} of {} connections").format(counts.torn, count)
    if counts.yielded is None:
        text = translated("Cracked (bars hold): {}; torn: {} of {} connections")
        return text.format(counts.cracked, counts.torn, count)
    text = translated("Cracked (bars hold): {}, of these yielded: {}; torn: {} of {} connections")
    return text.format(counts.cracked, counts.yielded, counts.torn, count)
