"""Texts of one report, put into its language, by its table, and its units: the only place where either goes in."""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache, reduce
from pathlib import Path

from ...engineering.unit_systems import IMPERIAL, Conversion, UnitSystem
from ...errors import OutputError
from ...model.schema import given
from ...texts import Quantity, Text, Unit

ENGLISH = "en"
"""The language that reports are thought in: it has no table."""

FOLDER = Path(__file__).parent


@dataclass(frozen=True, slots=True, eq=False)
class ReportTexts:
    """The table of a language.

    Attributes
    ----------
    name
        Name of the file, by which users choose the language.
    tag
        What browsers call the language, such as ``zh-Hans``.
    chinese_letters
        Whether it is written in Chinese letters, which matplotlib's own font does not have.
    texts
        Translations by English text. Both may have places for values: ``{}`` in the same order, or in the translation
        ``{0}``, ``{1}`` in another one.
    """

    name: str
    tag: str
    chinese_letters: bool
    texts: dict[str, str]

    @property
    def full_stop(self) -> str:
        """What ends a sentence."""
        return "\u3002" if self.chinese_letters else "."


def language_names() -> tuple[str, ...]:
    """Return the names of the languages that reports can be in, English first."""
    return ENGLISH, *sorted(path.stem for path in FOLDER.glob("*.toml"))


def check_language(name: str) -> str:
    """Return the name of a language; an error names those that there are."""
    if name not in language_names():
        raise OutputError(f"language of the report is {name!r}: expected {', '.join(language_names())}")
    return name


@lru_cache
def language_table(name: str) -> ReportTexts:
    """Read the table of a language; the English table has no texts."""
    if check_language(name) == ENGLISH:
        return ReportTexts(ENGLISH, "en-GB", False, {})
    read = tomllib.loads((FOLDER / f"{name}.toml").read_text(encoding="utf-8"))
    own = texts_of_kinds(name)("report")
    return ReportTexts(name, read["tag"], read.get("chinese_letters", False), read["texts"] | own)


def texts_of_kinds(language: str) -> Callable[..., dict[str, str]]:
    """Return what gives the translations of every kind of action in a part of their files: the report, or the window.

    A kind has its texts in one file, ``kinds/NAME.toml``, in all languages.
    """
    files = [tomllib.loads(path.read_text(encoding="utf-8")) for path in sorted((FOLDER / "kinds").glob("*.toml"))]

    def texts(*part: str) -> dict[str, str]:
        parts = (reduce(lambda table, name: table.get(name, {}), part, file) for file in files)
        return {english: own[language] for found in parts for english, own in found.items() if language in own}

    return texts


_KINDS = "abutment, arch, beam, bearing, column, cross frame, deck, foundation, girder, ground, pier, pier cap, slab"
MEMBER_KINDS = frozenset(f"{_KINDS}, truss, wall, whole structure".split(", "))
"""Kinds of members, which are texts also where a member is called by its kind alone."""

_WORD = re.compile(r"[^\W\d_]{2,}")


class Translation:
    """Language and units of one report, and the texts that the table of the language does not have."""

    def __init__(self, table: ReportTexts, system: UnitSystem = UnitSystem.METRIC) -> None:
        self.table, self.system = table, system
        self.missing: list[str] = []
        """Patterns that stayed English, each once."""

    @classmethod
    def into(cls, language: str, system: UnitSystem = UnitSystem.METRIC) -> Translation:
        """Return the translation into a language by its name."""
        return cls(language_table(language), system)

    @property
    def converts(self) -> bool:
        """Whether the report has other units than its files."""
        return self.system is not UnitSystem.METRIC

    def text(self, text: str) -> str:
        """Return a text or a quantity as it is read; other strings, such as names, as they are."""
        match text:
            case Text():
                own = self.pattern(text.key)
                return own.format(*map(self.text, text.values)) if text.values else own
            case Quantity():
                conversion = self.conversion(text.unit)
                bare = text.number.replace(" ", "")
                is_converted = conversion is not None and math.isfinite(float(bare))
                number = given(conversion).number(bare, text.rounding) if is_converted else text.number
                return f"{number} {self.unit(text.unit)}" if text.shown else number
            case Unit():
                return self.unit(text)
        return self.pattern(text) if text in MEMBER_KINDS else text

    def label(self, text: str) -> str:
        """Return a heading, a title or a paragraph, which is a text as a plain string, too."""
        return self.text(text if isinstance(text, Quantity | Unit) else Text(text))

    def pattern(self, english: str) -> str:
        """Return the pattern of a text in the language, with its places; in English, and noted, where it is missing.

        A sentence may stand in the table without its full stop.
        """
        if self.table.name == ENGLISH or not _WORD.search(english):
            return self.table.texts.get(english, english.rpartition("|")[2])
        if english not in self.table.texts and english.endswith(".") and english[:-1] in self.table.texts:
            return f"{self.table.texts[english[:-1]]}{self.table.full_stop}"
        if english not in self.table.texts and english not in self.missing:
            self.missing.append(english)
        return self.table.texts.get(english, english.rpartition("|")[2])

    def conversion(self, unit: str) -> Conversion | None:
        """Return the conversion of a metric unit; None where it is the same in the report."""
        return IMPERIAL.get(unit) if self.converts else None

    def unit(self, metric: str) -> str:
        """Return the symbol of a unit in the report; names of several words follow the language."""
        conversion = self.conversion(metric)
        symbol = conversion.unit if conversion else metric
        return self.table.texts.get(symbol, symbol) if " " in symbol else symbol


IN_ENGLISH = Translation.into(ENGLISH)
"""Leaves all texts as they are."""
