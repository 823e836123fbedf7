"""Reference of the files of studies, searches and optimisations, as pages and for a terminal.

``python -m bridge_demolition_addon.model.ensemble.reference docs`` writes them all to a folder.
"""

from __future__ import annotations

import re
import sys
import textwrap
from collections.abc import Iterator
from dataclasses import Field, dataclass, fields
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from ...errors import ScenarioError
from ..optimise.settings import OptimiseSettings
from ..scenario import Scenario
from ..scenario.reference import default_text, meaning, reference, value_text
from ..schema import Table, given, holds_many, key_fields, key_name, key_of, subtable_class
from ..search.settings import SearchSettings
from ..study.settings import EnsembleSettings, StudySettings

_FILES: dict[type[Table], str] = {  # most ask for keys of a scenario, so that is not said
    Scenario: "",
    StudySettings: "study",
    SearchSettings: "search",
    OptimiseSettings: "optimisation",
}

_WIDTH = 100
_MOST_SHOWN = 20
_LIKENESS = 0.7
_MOST_MEANT = 6


@dataclass(frozen=True, slots=True)
class _Entry:
    name: str  # dotted, such as ``ball.mass_kg``
    file: str
    table_class: type[Table]  # the table itself, or the key's
    key: Field[Any] | None = None  # None for a table
    many: bool = False

    def lines(self) -> Iterator[str]:
        if self.key is not None:
            yield f"{self.name}: {value_text(self.key)}; {_default(self.key)}"
            yield from _wrapped(key_of(self.key).description)
            return
        yield f"[[{self.name}]], as often as needed" if self.many else f"[{self.name}]"
        yield from _wrapped(meaning(self.table_class))
        for item in key_fields(self.table_class):
            yield f"  {item.name}: {value_text(item)}; {_default(item)}"


def explanation(name: str) -> list[str]:
    """Return what the reference says of a key or table, such as ``ball.mass_kg``, ``mass_kg`` or ``[[charges]]``.

    Numbers of elements and tables, as in messages, are left out: ``ball.target_m.1``.
    """
    wanted = ".".join(part for part in name.strip("[] ").split(".") if not part.isdigit())
    entries = [entry for root, file in _FILES.items() for entry in _entries(root, file, many=False)]
    found = [entry for entry in entries if entry.name == wanted]
    found = found or [entry for entry in entries if entry.name.rpartition(".")[2] == wanted]
    if not found:
        raise ScenarioError(f"{name} is no key or table of a file: {_advice(wanted, entries)}")
    if len(found) > _MOST_SHOWN:
        return [f"{wanted} is a key of many tables; name one of:", *(f"  {entry.name}" for entry in found)]
    files: dict[tuple[str, ...], list[str]] = {}
    for entry in found:
        files.setdefault(tuple(entry.lines()), []).append(entry.file)
    return [line for text, names in files.items() for line in (*_in_files(names), *text, "")][:-1]


def _in_files(names: list[str]) -> list[str]:
    return [f"In files of a {' or '.join(filter(None, names))}:"] if any(names) else []


def _entries(table_class: type[Table], file: str, *, many: bool) -> Iterator[_Entry]:
    yield _Entry(table_class.table, file, table_class, None, many)
    for item in fields(table_class):
        if inner := subtable_class(item):
            yield from _entries(given(inner), file, many=holds_many(item))
        else:
            yield _Entry(key_name(table_class, item), file, table_class, item)


def _default(item: Field[Any]) -> str:
    text = default_text(item).strip("`")
    return text if text == "required" else f"by default {text}"


def _advice(wanted: str, entries: list[_Entry]) -> str:
    names = [entry.name for entry in entries]
    last = {name.rpartition(".")[2]: name for name in reversed(names)}
    alike = get_close_matches(wanted, names, n=3, cutoff=_LIKENESS)
    alike += [last[word] for word in get_close_matches(wanted.rpartition(".")[2], last, n=3, cutoff=_LIKENESS)]
    tables = [entry.name for entry in entries if entry.key is None and _is_about(wanted, entry)]
    if likely := list(dict.fromkeys([*alike, *tables]))[:_MOST_MEANT]:
        return f"did you mean {' or '.join(likely)}?"
    return "docs/scenario.md lists all of a scenario"


def _is_about(wanted: str, entry: _Entry) -> bool:
    """Return whether the meaning of a table has a word, in singular or plural."""
    return re.search(rf"\b{re.escape(wanted.lower())}s?\b", meaning(entry.table_class).lower()) is not None


def _wrapped(text: str) -> list[str]:
    return textwrap.wrap(text.replace("`", ""), _WIDTH, initial_indent="  ", subsequent_indent="  ")


_PAGES: dict[str, tuple[type[EnsembleSettings], str, str, str, str]] = {
    "study_file.md": (StudySettings, "Study", "A study", "[studies](studies.md)", "studies/i235_one_span.toml"),
    "search_file.md": (SearchSettings, "Search", "A search", "[searches](search.md)", "searches/lightest_ball.toml"),
    "optimise_file.md": (
        OptimiseSettings,
        "Optimisation",
        "An optimisation",
        "[optimisation](optimise.md)",
        "optimisations/least_charge.toml",
    ),
}
"""Of each page: settings, name of the file and with an article, the page that explains it, an example."""

_INTRODUCTION = """\
# {name} files

<!-- Made by `python -m bridge_demolition_addon.model.ensemble.reference docs`: change the code instead. -->

{named} file is a [TOML](https://toml.io) file, which `bda {command} FILE --output DIR` runs; see {page}. Start from
[{example_name}](../examples/{example}). A key that is not listed is refused, and so is a value outside its limits.
"""

_OF_STUDIES = """\
`[[vary]]` and `[[criteria]]` are those of [study files](study_file.md#vary).
"""
_SHARED = ("vary", "criteria")
"""Tables of all three files, which the page of studies has."""


def reference_pages() -> dict[str, str]:
    """Return every table and key with its default, limits and meaning, in Markdown, by the names of the pages."""
    return {
        page: reference(
            _INTRODUCTION.format(
                name=name,
                named=named,
                command=settings.table,
                page=link,
                example=example,
                example_name=Path(example).name,
            )
            + ("" if settings is StudySettings else _OF_STUDIES),
            settings,
            () if settings is StudySettings else _SHARED,
        )
        for page, (settings, name, named, link, example) in _PAGES.items()
    }


if __name__ == "__main__":
    for name, text in reference_pages().items():
        (Path(sys.argv[1]) / name).write_text(text, encoding="utf-8", newline="\n")
