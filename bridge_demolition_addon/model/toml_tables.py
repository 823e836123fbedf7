"""Tables in TOML: read strictly into their classes, and written back without loss.

The file of a class holds its own keys under its heading, and the tables in it beside that.
"""

import json
import re
import tomllib
from collections.abc import Iterable, Iterator
from dataclasses import MISSING, fields
from difflib import get_close_matches
from pathlib import Path
from typing import Any, TypeVar

from ..errors import ScenarioError, UnreadableError
from ..system.reading import MEGABYTE, file_text
from .schema import (
    Table,
    expected,
    given,
    holds_many,
    is_required,
    key_fields,
    key_name,
    numbered_tables,
    shown,
    subtable_class,
    subtable_fields,
)

LIKENESS = 0.68
"""Least likeness of an unknown name and a suggestion: radius_m means search_radius_m, but title does not mean time."""

BARE_KEY = re.compile(r"[A-Za-z0-9_-]{1,60}")

_Root = TypeVar("_Root", bound=Table)


def document_of_file(path: Path, description: str, most_bytes: int = MEGABYTE) -> dict[str, Any]:
    """Return the content of a TOML file; errors do not name it."""
    try:
        text = file_text(path, most_bytes)
    except UnreadableError as error:
        raise ScenarioError(f"{error}: expected {description} in TOML") from error
    return toml_document(text)


def toml_document(text: str) -> dict[str, Any]:
    """Return the content of a text in TOML."""
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:  # tomllib lets too long numbers and too deep lists through as these
        raise ScenarioError(f"not a TOML file: {error}") from error


def table_of_document(root: type[_Root], document: dict[str, Any]) -> _Root:
    """Return the table in a document, where its own keys stand under its heading beside the tables in it."""
    _refuse_unknown(root, "", document, [root.table, *(item.name for item in subtable_fields(root))])
    heading = document.get(root.table, {})
    if not isinstance(heading, dict):
        raise ScenarioError(f"{root.table} is {shown(heading)}: expected a table")
    _refuse_unknown(root, root.table, heading, [item.name for item in key_fields(root)])
    return root(**_key_values(root, heading), **_subtables(root, root, document))


def tables_text(root: Table, *, defaults: bool = True) -> str:
    """Write a table, and the tables in it, as TOML, with or without what is as by default.

    `table_of_document` gives an equal one back.
    """
    return "\n".join(_table_lines(root, defaults=defaults))


def dotted(table: str, name: str) -> str:
    """Return the name of a key in a table as TOML has it, in quotation marks where it needs them."""
    part = name if BARE_KEY.fullmatch(name) else shown(name)
    return f"{table}.{part}" if table else part


def toml_value(value: Any) -> str:
    """Write a value of a key as TOML."""
    if isinstance(value, tuple):
        return f"[{', '.join(map(toml_value, value))}]"
    if isinstance(value, bool | str):
        return json.dumps(value, ensure_ascii=False)
    return repr(value)


def _table(root: type[Table], table_class: type[Table], values: Any) -> Table:
    if not isinstance(values, dict):
        raise ScenarioError(f"{table_class.table} is {shown(values)}: expected a table")
    _refuse_unknown(root, table_class.table, values, [item.name for item in fields(table_class)])
    return table_class(**_key_values(table_class, values), **_subtables(root, table_class, values))


def _key_values(table_class: type[Table], values: dict[str, Any]) -> dict[str, Any]:
    for item in key_fields(table_class):
        if is_required(item) and item.name not in values:
            raise ScenarioError(f"{key_name(table_class, item)} is missing: expected {expected(item)}")
    return {item.name: values[item.name] for item in key_fields(table_class) if item.name in values}


def _subtables(root: type[Table], table_class: type[Table], values: dict[str, Any]) -> dict[str, Any]:
    for item in subtable_fields(table_class):
        if is_required(item) and item.name not in values:
            raise ScenarioError(f"{key_name(table_class, item)} is missing: expected a table")
    return {
        item.name: (_tables if holds_many(item) else _table)(root, given(subtable_class(item)), values[item.name])
        for item in subtable_fields(table_class)
        if item.name in values
    }


def _tables(root: type[Table], table_class: type[Table], values: Any) -> tuple[Table, ...]:
    """Return the tables of a list, each written under its own ``[[name]]``."""
    if not isinstance(values, list):
        raise ScenarioError(
            f"{table_class.table} is {shown(values)}: expected tables, each under [[{table_class.table}]]"
        )
    return numbered_tables(table_class, values, lambda value: _table(root, table_class, value))


def _refuse_unknown(root: type[Table], table: str, values: dict[str, Any], known: Iterable[str]) -> None:
    known = list(known)
    for name in values:
        if name not in known:
            raise ScenarioError(f"{dotted(table, name)} is unknown: {_suggestion(root, table, name, known)}")


def _suggestion(root: type[Table], table: str, name: str, known: list[str]) -> str:
    """Return the meaning of an unknown name: one like it in its table, the same elsewhere, or any of its table."""
    alike = [dotted(table, match) for match in get_close_matches(name, known, n=1, cutoff=LIKENESS)]
    elsewhere = [full for full in _full_names(root) if full.rpartition(".")[2] == name]
    if alike or elsewhere:
        return f"did you mean {(alike + elsewhere)[0]}?"
    return f"expected one of {', '.join(known)}"


def _full_names(table_class: type[Table]) -> Iterator[str]:
    for item in fields(table_class):
        yield key_name(table_class, item)
        if inner := subtable_class(item):
            yield from _full_names(inner)


def _table_lines(table: Table, heading: str = "[{}]", *, defaults: bool) -> Iterator[str]:
    """Yield the lines of a table and of the tables in it; a key without a value has no line."""
    yield heading.format(table.table)
    for item in key_fields(type(table)):
        value = getattr(table, item.name)
        if value is not None and (defaults or value != item.default):
            yield f"{item.name} = {toml_value(value)}"
    yield ""
    for item in subtable_fields(type(table)):
        inner = getattr(table, item.name)
        if holds_many(item):
            for one in inner:
                yield from _table_lines(one, "[[{}]]", defaults=defaults)
        elif inner and (defaults or item.default_factory is MISSING or inner != item.default_factory()):
            yield from _table_lines(inner, defaults=defaults)
