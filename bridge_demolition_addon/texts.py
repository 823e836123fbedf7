"""Texts for people, made of a pattern and of what stands in it: words and units go in last, for a language.

Each is an English string with SI units, too, so that files, messages and the window show it as it is. A report is put
into its language and its units from what it is made of. What is a plain string there is a name or a number, and stays.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from functools import reduce
from typing import Any

from .engineering.unit_systems import DOWN, NEAREST, UP, Quantity, Rounding, Unit, distance_to_keep

__all__ = [
    "DOWN",
    "NEAREST",
    "UP",
    "Quantity",
    "Text",
    "Unit",
    "distance_to_keep",
    "joined",
    "of_stored",
    "point_text",
    "read",
    "stored",
]


class Text(str):
    """A text: its English pattern, as tables of languages have it, and the values for its places, ``{}``.

    `context` tells two meanings of an English text apart.
    """

    __slots__ = ("context", "pattern", "values")

    context: str
    pattern: str
    values: tuple[str, ...]

    def __new__(cls, pattern: str, *values: object, context: str = "") -> Text:
        """Put values into a pattern: texts, quantities, and what is written as it is, such as names and numbers.

        A text without values stays what it is.
        """
        if isinstance(pattern, Text) and not values:
            return pattern
        texts = tuple(value if isinstance(value, str) else str(value) for value in values)
        text = super().__new__(cls, pattern.format(*texts) if values else pattern)
        text.pattern, text.values, text.context = str.__str__(pattern), texts, context
        return text

    def __str__(self) -> str:
        """Return itself, so that it stays what it is in tables and drawings."""
        return self

    def __getnewargs_ex__(self) -> tuple[tuple[Any, ...], dict[str, Any]]:
        """Return what it is made of, for copies."""
        return (self.pattern, *self.values), {"context": self.context}

    @property
    def capital(self) -> Text:
        """Return it with a capital at its beginning."""
        return Text(f"{self.pattern[:1].upper()}{self.pattern[1:]}", *self.values, context=self.context)

    @property
    def key(self) -> str:
        """Return what tables of languages know it by."""
        return f"{self.context}|{self.pattern}" if self.context else self.pattern


def joined(pattern: str, texts: Iterable[str]) -> str:
    """Return texts side by side, each two of them by a pattern, such as ``{}, {}``; empty without any."""
    each = list(texts)
    return reduce(lambda first, second: Text(pattern, first, second), each) if each else ""


def point_text(position_m: Sequence[float], form: str = "g") -> Text:
    """Return a point by its coordinates in m, such as ``(13, 0, 1) m``."""
    coordinates = [Quantity(value, "m", form, shown=False) for value in position_m]
    return Text(f"({', '.join('{}' for _ in coordinates)}) {{}}", *coordinates, Unit("m"))


def read(text: str, patterns: Iterable[str]) -> Text:
    """Return a text that a file holds by the first of the patterns by which it may have been written."""
    for pattern in patterns:
        if found := re.fullmatch("(.+?)".join(map(re.escape, pattern.split("{}"))), text):
            return Text(pattern, *found.groups())
    return Text(text)


def stored(text: str) -> Any:
    """Return what a text is made of, ready for JSON."""
    match text:
        case Text():
            return {"pattern": text.pattern, "values": list(map(stored, text.values))}
        case Quantity():
            return {"number": text.number, "unit": text.unit, "rounding": text.rounding.name, "shown": text.shown}
    return text


def of_stored(parts: Any) -> str:
    """Return what `stored` gave, maybe after JSON."""
    match parts:
        case {"pattern": str(pattern), "values": list(values)}:
            return Text(pattern, *map(of_stored, values))
        case {"number": str(number), "unit": str(unit), "rounding": rounding, "shown": shown}:
            return Quantity(number, unit, "", Rounding[rounding], shown=shown)
    return str(parts)
