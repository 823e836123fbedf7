"""Texts in lines that fit into their room."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator

from ..languages.letters import pieces
from .page import Font, width_mm


def wrapped(text: str, room_mm: float, font: Font) -> Iterator[str]:
    """Yield lines that fit; a word that is longer than a line is cut."""
    line = text[: len(text) - len(text.lstrip())]
    room_mm += 1e-6
    for blank, word in pieces(text):
        longer = f"{line}{blank}{word}" if line.strip() else line + word
        if width_mm(longer, font) <= room_mm:
            line = longer
            continue
        if line.strip():
            yield line
        while width_mm(word, font) > room_mm and len(word) > 1:
            cut = max(1, _fitting(word, room_mm, font))
            yield word[:cut]
            word = word[cut:]
        line = word
    if line.strip():
        yield line


def shortened(text: str, room_mm: float, font: Font) -> str:
    if width_mm(text, font) <= room_mm:
        return text
    return text[: _fitting(text, room_mm - width_mm("…", font), font)] + "…"


def _fitting(text: str, room_mm: float, font: Font) -> int:
    """Return how many letters of a text fit."""
    return bisect_right(range(1, len(text) + 1), room_mm, key=lambda count: width_mm(text[:count], font))
