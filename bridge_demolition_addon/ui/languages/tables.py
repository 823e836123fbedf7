"""The languages' tables, handed to Blender while the add-on is switched on."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import bpy

from ...report.languages.translation import texts_of_kinds
from ..scenario.key_tooltips import tooltip_of, translated_tooltip
from ..scenario.prop import all_tables, label_of, shown_keys, title_of, unit_in_label
from .words import CONTEXT

FOLDER = Path(__file__).parent

Translations = dict[tuple[str, str], str]
"""Texts by context and English text, as Blender takes them."""

_PARTS = ("labels", "sentences", "tooltips")

_ALL = "*"
"""Blender's context of tooltips: an add-on cannot give them one of their own."""


@dataclass(frozen=True, slots=True)
class LanguageTable:
    """The table of a language, ``ui/languages/NAME.toml``.

    Attributes
    ----------
    locales
        Names that versions of Blender have for the language.
    labels, sentences, tooltips
        Translations by English text. The patterns in the sentences have places for values, such as ``{}``.
    """

    locales: tuple[str, ...]
    labels: dict[str, str]
    sentences: dict[str, str]
    tooltips: dict[str, str]

    @classmethod
    def read(cls, path: Path) -> LanguageTable:
        """Read the table of a language."""
        parts = tomllib.loads(path.read_text(encoding="utf-8"))
        of_kinds = texts_of_kinds(path.stem)
        labels, sentences, tooltips = (parts[name] | of_kinds("window", name) for name in _PARTS)
        return cls(tuple(parts["locales"]), labels, sentences, tooltips)

    def translations(self) -> Translations:
        """Return all texts that Blender may ask for, texts of a scenario's keys put together."""
        return {
            **{(CONTEXT, english): own for english, own in (self.sentences | self.labels).items()},
            **{(_ALL, english): own for english, own in self.tooltips.items()},
            **dict(self._of_keys()),
        }

    def _of_keys(self) -> Iterator[tuple[tuple[str, str], str]]:
        """Give the labels with units, and the tooltips that have names and limits of keys in them."""
        for table_class in all_tables():
            for item in shown_keys(table_class):
                if label := self.labels.get(title_of(item)):
                    yield (CONTEXT, label_of(table_class, item)), label + unit_in_label(item)
                if tooltip := translated_tooltip(table_class, item, self.tooltips):
                    yield (_ALL, tooltip_of(table_class, item)), tooltip


def table_files() -> list[Path]:
    """Return the languages' files."""
    return sorted(FOLDER.glob("*.toml"))


def register() -> None:
    """Hand all tables to Blender."""
    bpy.app.translations.register(__name__, _texts())


@cache
def _texts() -> dict[str, Translations]:
    """Return all texts by locale, put together once: the add-on may be switched off and on."""
    tables = map(LanguageTable.read, table_files())
    return {
        locale: translations for table in tables if (translations := table.translations()) for locale in table.locales
    }


def unregister() -> None:
    """Take them back."""
    bpy.app.translations.unregister(__name__)
