"""Patterns of texts: an English text with places for values, ``{}``, and how a text reads as one."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice

PLACE = "{}"
"""Stands in a pattern for a value that the program fills in."""

_MOST_READINGS = 40
"""Ways to read a text as one pattern that are looked at: a value may hold the words between two values, too."""


@dataclass(frozen=True, slots=True)
class Pattern:
    """An English text with places for values, cut at them: one more part than places."""

    english: str
    parts: tuple[str, ...]

    @classmethod
    def of(cls, english: str) -> Pattern:
        """Cut a text at its places."""
        return cls(english, tuple(english.split(PLACE)))

    @property
    def letters(self) -> int:
        """How much of it is fixed: the more, the more a text that reads as it has to be it."""
        return sum(map(len, self.parts))

    def readings(self, text: str) -> Iterator[tuple[str, ...]]:
        """Yield the values with which a text reads as this pattern, short ones at the left first; none is empty."""
        first, last = self.parts[0], self.parts[-1]
        if len(text) < len(first) + len(last) or not (text.startswith(first) and text.endswith(last)):
            return
        inner = text[len(first) : len(text) - len(last)]
        if all(part in inner for part in self.parts[1:-1]):
            yield from islice(_values(inner, self.parts[1:-1]), _MOST_READINGS)


def _values(text: str, between: tuple[str, ...]) -> Iterator[tuple[str, ...]]:
    if not between:
        if text:
            yield (text,)
        return
    at = text.find(between[0], 1)
    while at > 0:
        for values in _values(text[at + len(between[0]) :], between[1:]):
            yield (text[:at], *values)
        at = text.find(between[0], at + 1)
