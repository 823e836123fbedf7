"""Scenario files: TOML read strictly into a `Scenario`, and written back without loss.

A file may be a variant, which only says how it differs from the file that it is based on.
"""

import json
import re
import tomllib
from collections.abc import Iterable, Iterator
from dataclasses import fields
from difflib import get_close_matches
from os import PathLike, fspath
from pathlib import Path
from typing import Any

from ..errors import ScenarioError, UnreadableError
from ..reading import MEGABYTE, file_text
from ..schema import (
    Table,
    expected,
    holds_many,
    is_required,
    key_fields,
    key_name,
    numbered_tables,
    shown,
    subtable_class,
    subtable_fields,
)
from .scenario import Scenario

LIKENESS = 0.68
"""Least likeness of an unknown name and a suggestion: radius_m means search_radius_m, but title does not mean time."""

PATHS = (("geometry", "file"), ("fracture", "points_file"), ("fracture", "painted_file"))
"""Table and key of every path of another file."""

BARE_KEY = re.compile(r"[A-Za-z0-9_-]{1,60}")

BASED_ON = "based_on"
"""Key of the table of a scenario: the file of which this one is a variant."""

MOST_BASES = 20
"""How many files a variant may be based on, one on the other."""

MOST_BYTES = 10 * MEGABYTE
"""Size up to which a scenario is read; those with thousands of places have less than 1 MB."""

WITHOUT = "without"
"""Key of the table of a scenario: tables and keys of that file that this one does without."""


def read_scenario(path: str | PathLike[str]) -> Scenario:
    """Read a scenario file, and the files that it is based on.

    Parameters
    ----------
    path : str or path
        A TOML file; `scenario_text` makes one, and the reference of all keys is ``docs/scenario.md``.

    Raises
    ------
    ScenarioError
        The file cannot be read, is not TOML, or a key is unknown, missing or has a wrong value.
        The text is one line: the path as given, the key and what was expected.
    """
    try:
        return _scenario(_document_of_file(Path(path)))
    except ScenarioError as error:
        raise ScenarioError(f"{fspath(path)}: {error}") from error


def scenario_from_text(text: str) -> Scenario:
    """Read a scenario from TOML. It cannot be based on a file, as it has no place to look for that from.

    Raises
    ------
    ScenarioError
        The text is not TOML, or a key is unknown, missing or has a wrong value.
    """
    return _scenario(_document(text))


def scenario_text(scenario: Scenario) -> str:
    """Write a scenario as TOML; `scenario_from_text` gives an equal scenario back."""
    return "\n".join(_table_lines(scenario))


def toml_value(value: Any) -> str:
    """Write a value of a key as TOML."""
    if isinstance(value, tuple):
        return f"[{', '.join(map(toml_value, value))}]"
    if isinstance(value, bool | str):
        return json.dumps(value, ensure_ascii=False)
    return repr(value)


def _file_text(path: Path) -> str:
    try:
        return file_text(path, MOST_BYTES)
    except UnreadableError as error:
        raise ScenarioError(f"{error}: expected a scenario in TOML") from error


def _document(text: str) -> dict[str, Any]:
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:  # tomllib lets too long numbers and too deep lists through as these
        raise ScenarioError(f"not a TOML file: {error}") from error


def _document_of_file(path: Path, variants: tuple[Path, ...] = ()) -> dict[str, Any]:
    """Return what a file says with all that it is based on; it must not be one of its own variants."""
    document = _document(_file_text(path))
    _make_paths_absolute(path.parent, document)
    name, without = take_based_on(document)
    if name is None:
        return document
    base = Path(_absolute(path.parent, name))
    variants = (*variants, path.resolve())
    if base in variants:
        raise ScenarioError(f"is based on {shown(name)}, which is based on it in turn")
    if len(variants) > MOST_BASES:
        raise ScenarioError(f"expected at most {MOST_BASES} files that are based on each other")
    try:
        inherited = _document_of_file(base, variants)
    except ScenarioError as error:
        raise ScenarioError(f"based on {shown(name)}: {error}") from error
    return varied(inherited, document, without)


def _make_paths_absolute(folder: Path, document: dict[str, Any]) -> None:
    """Make the paths of other files absolute: they are given from the folder of this file."""
    for table, key in PATHS:
        tables = document.get(table)
        for each in tables if isinstance(tables, list) else [tables]:
            if isinstance(each, dict) and isinstance(each.get(key), str) and each[key].strip():
                each[key] = _absolute(folder, each[key])


def _absolute(folder: Path, path: str) -> str:
    try:
        return str((folder / path).resolve())
    except (OSError, ValueError, RuntimeError) as error:  # a NUL in it, for one, or links that lead in a circle
        raise ScenarioError(f"{shown(path)} is no path of a file: {error}") from error


def _scenario(document: dict[str, Any]) -> Scenario:
    """Return the scenario in a document, where the table ``[scenario]`` stands beside the tables it is made of."""
    names = [Scenario.table, *(item.name for item in subtable_fields(Scenario))]
    _refuse_unknown("", document, names)
    heading = document.get(Scenario.table, {})
    if not isinstance(heading, dict):
        raise ScenarioError(f"{Scenario.table} is {shown(heading)}: expected a table")
    _refuse_unknown(Scenario.table, heading, [item.name for item in key_fields(Scenario)])
    return Scenario(**_key_values(Scenario, heading), **_subtables(Scenario, document))


def _table(table_class: type[Table], values: Any) -> Table:
    if not isinstance(values, dict):
        raise ScenarioError(f"{table_class.table} is {shown(values)}: expected a table")
    _refuse_unknown(table_class.table, values, [item.name for item in fields(table_class)])
    return table_class(**_key_values(table_class, values), **_subtables(table_class, values))


def _key_values(table_class: type[Table], values: dict[str, Any]) -> dict[str, Any]:
    for item in key_fields(table_class):
        if is_required(item) and item.name not in values:
            raise ScenarioError(f"{key_name(table_class, item)} is missing: expected {expected(item)}")
    return {item.name: values[item.name] for item in key_fields(table_class) if item.name in values}


def _subtables(table_class: type[Table], values: dict[str, Any]) -> dict[str, Table]:
    for item in subtable_fields(table_class):
        if is_required(item) and item.name not in values:
            raise ScenarioError(f"{key_name(table_class, item)} is missing: expected a table")
    return {
        item.name: (_tables if holds_many(item) else _table)(subtable_class(item), values[item.name])
        for item in subtable_fields(table_class)
        if item.name in values
    }


def _tables(table_class: type[Table], values: Any) -> tuple[Table, ...]:
    """Return the tables of a list, each written under its own ``[[name]]``."""
    if not isinstance(values, list):
        raise ScenarioError(
            f"{table_class.table} is {shown(values)}: expected tables, each under [[{table_class.table}]]"
        )
    return numbered_tables(table_class, values, lambda each: _table(table_class, each))


def _refuse_unknown(table: str, values: dict[str, Any], known: Iterable[str]) -> None:
    known = list(known)
    for name in values:
        if name not in known:
            raise ScenarioError(f"{_dotted(table, name)} is unknown: {_suggestion(table, name, known)}")


def _suggestion(table: str, name: str, known: list[str]) -> str:
    """Return what an unknown name may mean: one like it in its table, the same elsewhere, or any of its table."""
    alike = [_dotted(table, match) for match in get_close_matches(name, known, n=1, cutoff=LIKENESS)]
    elsewhere = [full for full in _full_names(Scenario) if full.rpartition(".")[2] == name]
    if alike or elsewhere:
        return f"did you mean {(alike + elsewhere)[0]}?"
    return f"expected one of {', '.join(known)}"


def _full_names(table_class: type[Table]) -> Iterator[str]:
    for item in fields(table_class):
        yield key_name(table_class, item)
        if inner := subtable_class(item):
            yield from _full_names(inner)


def _dotted(table: str, name: str) -> str:
    part = name if BARE_KEY.fullmatch(name) else shown(name)
    return f"{table}.{part}" if table else part


def _table_lines(table: Table, heading: str = "[{}]") -> Iterator[str]:
    """Return the lines of a table and of the tables in it; what is not given has no line."""
    yield heading.format(table.table)
    for item in key_fields(type(table)):
        value = getattr(table, item.name)
        if value is not None:
            yield f"{item.name} = {toml_value(value)}"
    yield ""
    for item in subtable_fields(type(table)):
        inner = getattr(table, item.name)
        if holds_many(item):
            for each in inner:
                yield from _table_lines(each, "[[{}]]")
        elif inner:
            yield from _table_lines(inner)


def take_based_on(document: dict[str, Any]) -> tuple[str | None, list[str]]:
    """Remove from a document what it is based on and what it does without, and return both.

    Parameters
    ----------
    document : dict
        As read from TOML. The two keys are removed from it.

    Raises
    ------
    ScenarioError
        One of the two is no text, or something is left out of no file.
    """
    heading = document.get(Scenario.table)
    if not isinstance(heading, dict):
        return None, []
    base, without = heading.pop(BASED_ON, None), heading.pop(WITHOUT, [])
    if base is not None and not (isinstance(base, str) and base.strip()):
        raise ScenarioError(f"{Scenario.table}.{BASED_ON} is {shown(base)}: expected the path of a scenario file")
    if not isinstance(without, list) or not all(isinstance(name, str) for name in without):
        raise ScenarioError(f"{Scenario.table}.{WITHOUT} is {shown(without)}: expected a list of tables and keys")
    if without and base is None:
        raise ScenarioError(f"{Scenario.table}.{WITHOUT} needs {Scenario.table}.{BASED_ON}")
    return base, without


def varied(base: dict[str, Any], changes: dict[str, Any], without: Iterable[str]) -> dict[str, Any]:
    """Return a document with changes: tables are merged key by key, values and lists of tables replaced.

    Parameters
    ----------
    base, changes : dict
        Documents as read from TOML; both stay as they are.
    without : iterable of str
        Names such as ``ball`` or ``bridge.pier_caps`` of what is left out of the base.

    Raises
    ------
    ScenarioError
        The base has nothing of a name.
    """
    result = base
    for name in without:
        result = _left_out(result, name.split("."), name)
    return _merged(result, changes)


def _left_out(table: dict[str, Any], path: list[str], name: str) -> dict[str, Any]:
    first, *rest = path
    if first not in table or (rest and not isinstance(table[first], dict)):
        raise ScenarioError(f"{Scenario.table}.{WITHOUT} names {shown(name)}, which is not in the file it is based on")
    inner = {first: _left_out(table[first], rest, name)} if rest else {}
    return {key: value for key, value in table.items() if key != first} | inner


def _merged(base: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    both = {
        key for key in base.keys() & changes.keys() if isinstance(base[key], dict) and isinstance(changes[key], dict)
    }
    return base | changes | {key: _merged(base[key], changes[key]) for key in both}
