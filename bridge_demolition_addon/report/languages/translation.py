"""Look-up of the texts of a report in the table of a language.

Texts are looked up where they are put on the page, with their values in them. So a text is read backwards: as the
pattern of the table that has most fixed letters, whose values are looked up in the same way.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import cached_property
from itertools import chain

from .patterns import PLACE, Pattern
from .table import ENGLISH, ReportTexts, language_table

_SENTENCE_ENDS = re.compile(r"(?<=[.:;!?]) +(?=\S)")
_NUMBERED = re.compile(r"(\d+) ([A-Z].*)")
"""The number and title of a section."""

_LETTERS = re.compile(r"[^\W\d_]{2,}")
_WORD = re.compile(r"[^\W\d_]{3,}|\b(?:as|at|by|if|in|is|it|no|of|on|or|to|up)\b")
_NO_WORDS = re.compile(
    r"\S*[\w\]\[*>][._/=\\]\w\S*"  # keys, files and places of files
    r"|\b[A-Z][A-Z0-9_]{2,}\b"  # choices in files
    r"|--\S+|\[\[?\w+\]?\]"  # options of commands and tables of scenarios
    r"|\b(?:kPa|MPa|kNm|rad|mrad|TNT|USBM|ASCE|MOP|DIN|DGUV|CFR|CDM|HSE|ANFO|Wilks|Clopper|Pearson|Guba|Makai|Pál"
    r"|Lundborg|McKenzie|Zhou|Hertz|Neyer|Bullet|Blender|Bridge Demolition Add-on|CoP|Hong Kong|SprengV|Regel)\b"
)
"""What stays as it is in every language: units, sources, and what users write into files."""

_FEW_LETTERS = 8
"""A pattern with fewer fixed letters, such as ``{} of {}``, is taken only where nothing in it stays English."""

_Reading = tuple[str, tuple[str, ...]]
"""A text in the language, and the parts of it that stayed English."""


class Translation:
    """Texts of one report in a language, and those that the table of the language does not have.

    `kept` are names that are the user's, or of bodies in the scene: they stay as they are.
    """

    def __init__(self, table: ReportTexts, kept: Iterable[str] = ()) -> None:
        self.table = table
        self.missing: list[str] = []
        """Texts that stayed English, as they are asked for, each once."""

        self._kept = frozenset(kept)
        self._found: dict[str, _Reading] = {}
        self._single: dict[str, _Reading] = {}

    @classmethod
    def into(cls, language: str, kept: Iterable[str] = ()) -> Translation:
        """Return the translation into a language by its name."""
        return cls(language_table(language), kept)

    @property
    def is_english(self) -> bool:
        """Whether nothing is to be translated."""
        return self.table.name == ENGLISH

    def text(self, english: str) -> str:
        """Return a text in the language; what the table does not have stays English, and is noted."""
        if self.is_english:
            return english
        own, missing = self._best(english)
        self.missing += [text for text in missing if text not in self.missing]
        return own

    def pattern(self, english: str) -> str:
        """Return the translation of a pattern with its places, for values that are put in elsewhere."""
        return self.table.texts.get(english, english)

    def unit(self, symbol: str) -> str:
        """Return what the language calls a unit: symbols are the same in all, names of several words are not."""
        return self.pattern(symbol) if " " in symbol else symbol

    @cached_property
    def _patterns(self) -> list[Pattern]:
        patterns = [Pattern.of(english) for english in self.table.texts if PLACE in english]
        return sorted(patterns, key=lambda pattern: -pattern.letters)

    def _best(self, text: str) -> _Reading:
        """Return a text in the language, and the parts of it that stayed English: as few letters as can be."""
        if text not in self._found:
            bare = text.strip()
            self._found[text] = self._looked_up(text) if bare in ("", text) else self._within(text, bare)
        return self._found[text]

    def _within(self, text: str, bare: str) -> _Reading:
        """Return a text with blanks at its ends."""
        own, missing = self._best(bare)
        return text.replace(bare, own), missing

    def _looked_up(self, text: str) -> _Reading:
        return self._as_it_is(text) or _fewest(chain(self._by_sentences(text), self._by_parts(text)), _left(text))

    def _as_it_is(self, text: str) -> _Reading | None:
        """Return a text that needs no patterns: a name, a number, or a line of the table; None for others."""
        if text in self._kept or not _LETTERS.search(text):
            return text, ()
        return (self.table.texts[text], ()) if text in self.table.texts else None

    def _by_parts(self, text: str) -> Iterator[_Reading]:
        """Yield a text without its number or its full stop, which no table has to have, and by all patterns."""
        if numbered := _NUMBERED.fullmatch(text):
            own, missing = self._best(numbered[2])
            yield f"{numbered[1]} {own}", missing
        if text.endswith("."):
            own, missing = self._best(text[:-1])
            yield f"{own}{self.table.full_stop}", missing
        yield from self._by_patterns(text)

    def _by_patterns(self, text: str) -> Iterator[_Reading]:
        """Yield a text by all patterns that it reads as."""
        for pattern in self._patterns:
            for values in pattern.readings(text):
                parts = [self._best(value) for value in values]
                own = self.table.texts[pattern.english].format(*(part for part, _ in parts))
                missing = tuple(text for _, each in parts for text in each)
                if not missing or pattern.letters >= _FEW_LETTERS:
                    yield own, missing

    def _by_sentences(self, text: str) -> Iterator[_Reading]:
        """Yield a text cut after one of its sentences, as many as can be; the rest is cut in the same way."""
        for end in reversed(list(_SENTENCE_ENDS.finditer(text))):
            head, rest = text[: end.start()], text[end.end() :]
            (first, first_missing), (own, missing) = self._one(head), self._best(rest)
            yield f"{first} {own}", (*first_missing, *missing)

    def _one(self, text: str) -> _Reading:
        """Return a text that is not cut into sentences."""
        if text not in self._single:
            self._single[text] = self._as_it_is(text) or _fewest(self._by_parts(text), _left(text))
        return self._single[text]


def _left(text: str) -> _Reading:
    """Return a text that stays English, and is missing where it has words."""
    return text, (text,) if _WORD.search(_NO_WORDS.sub(" ", text)) else ()


def _fewest(readings: Iterable[_Reading], otherwise: _Reading) -> _Reading:
    """Return the first reading that leaves nothing in English, or that which leaves least."""
    best = otherwise
    for reading in readings:
        if not reading[1]:
            return reading
        if _letters(reading[1]) < _letters(best[1]):
            best = reading
    return best


def _letters(texts: Iterable[str]) -> int:
    return sum(map(len, texts))


IN_ENGLISH = Translation.into(ENGLISH)
"""Leaves all texts as they are."""
