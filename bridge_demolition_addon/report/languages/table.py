"""The table of a language for reports, ``report/languages/NAME.toml``: English texts and their translations."""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache, reduce
from pathlib import Path

from ...errors import OutputError

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
    """Return the names of all languages that reports can be in, English first."""
    return ENGLISH, *sorted(path.stem for path in FOLDER.glob("*.toml"))


def check_language(name: str) -> str:
    """Return the name of a language; an error names those that there are."""
    if name not in language_names():
        raise OutputError(f"language of the report is {name!r}: expected {', '.join(language_names())}")
    return name


@lru_cache
def language_table(name: str) -> ReportTexts:
    """Read the table of a language; that of English has no texts."""
    if check_language(name) == ENGLISH:
        return ReportTexts(ENGLISH, "en-GB", False, {})
    read = tomllib.loads((FOLDER / f"{name}.toml").read_text(encoding="utf-8"))
    own = texts_of_kinds(name)("report")
    return ReportTexts(name, read["tag"], read.get("chinese_letters", False), read["texts"] | own)


def texts_of_kinds(language: str) -> Callable[..., dict[str, str]]:
    """Return what gives the translations of all kinds of actions in a part of their files: the report, or the window.

    A kind has its texts in one file, ``kinds/NAME.toml``, in all languages.
    """
    files = [tomllib.loads(path.read_text(encoding="utf-8")) for path in sorted((FOLDER / "kinds").glob("*.toml"))]

    def texts(*part: str) -> dict[str, str]:
        parts = (reduce(lambda table, name: table.get(name, {}), part, file) for file in files)
        return {english: own[language] for found in parts for english, own in found.items() if language in own}

    return texts
