"""Scenario files: TOML read strictly into a `Scenario`, and written back without loss.

A file may be a variant, which only says how it differs from the file that it is based on.
"""

import hashlib
import logging
from collections.abc import Iterable, Iterator
from os import PathLike, fspath
from os.path import isfile, lexists
from pathlib import Path
from typing import Any

from ...errors import Faults, ScenarioError
from ...system.reading import MEGABYTE
from ..schema import shown
from ..toml_tables import document_of_file, table_of_document, tables_text, toml_document
from .contacts import BALL, GROUND, QUANTITIES, SHARDS, SURFACES, TOOLS, ContactSettings, check_not_both
from .scenario import Scenario

PATHS = (
    ("geometry", "file"),
    ("fracture", "points_file"),
    ("fracture", "painted_file"),
    ("ground", "file"),
    ("ground.surfaces", "file"),
    ("ground_motion", "file"),
)
"""Table and key of every path of another file."""

_CONSOLE = logging.getLogger(__name__)

PAIR_TABLES = tuple(f"{ContactSettings.table}.{name}" for name in (SHARDS, GROUND, BALL, TOOLS, SURFACES))
BODY_TABLES = ("shards", "ground", "ground.surfaces", "ball", "jackhammers")
"""Tables that give friction and restitution: of pairs of surfaces, and of single bodies."""

BASED_ON = "based_on"
"""Key of the table of a scenario: the file of which this one is a variant."""

MOST_BASES = 20
"""How many files a variant may be based on, one on the other."""

MOST_BYTES = 10 * MEGABYTE
"""Size up to which a scenario is read; those with thousands of positions have less than 1 MB."""

MOVED_TO = "report_2019"
"""Folder into which the examples of the 2019 report moved: their old paths lead there."""

WITHOUT = "without"
"""Key of the table of a scenario: tables and keys of that file that this one does without."""


def read_scenario(path: str | PathLike[str]) -> Scenario:
    """Read a scenario file, and the files that it is based on; all keys are in ``docs/scenario.md``.

    Raises
    ------
    ScenarioError
        The file cannot be read, is not TOML, or keys are unknown, missing or have wrong values.
        Each fault is one line: the path as given, the key and what was expected.
    """
    try:
        faults = Faults()
        document = _document_of_file(_where_it_is(Path(path)), faults=faults)
        with faults.noted():
            scenario = _scenario_of_document(document)
        faults.check()
    except ScenarioError as error:
        raise error.within(fspath(path)) from error
    return scenario


def scenario_from_text(text: str) -> Scenario:
    """Read a scenario from TOML. It cannot be based on a file, as it has no folder to look in."""
    return _scenario_of_document(toml_document(text))


def scenario_text(scenario: Scenario) -> str:
    """Write a scenario as TOML; `scenario_from_text` gives an equal scenario back."""
    return tables_text(scenario)


def files_of(scenario: Scenario) -> Iterator[Path]:
    """Yield the paths of the other files that a scenario names, in the order of `PATHS`."""
    for name, key in PATHS:
        tables: list[Any] = [scenario]
        for step in name.split("."):
            values = [getattr(table, step) for table in tables]
            tables = [inner for value in values for inner in (value if isinstance(value, tuple) else [value]) if inner]
        yield from (Path(path) for table in tables if (path := getattr(table, key)))


def file_digests(scenario: Scenario) -> list[str]:
    """Return the SHA-256, in hexadecimal digits, of each file that a scenario names, in the order of `files_of`."""
    digests = []
    for path in files_of(scenario):
        try:
            digests.append(hashlib.sha256(path.read_bytes()).hexdigest())
        except OSError as error:
            raise ScenarioError(f"{path}: cannot be read: {error.strerror}") from error
    return digests


def _scenario_of_document(document: dict[str, Any]) -> Scenario:
    check_not_both(_keys_in(document, PAIR_TABLES), _keys_in(document, BODY_TABLES))
    return table_of_document(Scenario, document)


def _keys_in(document: dict[str, Any], tables: Iterable[str]) -> Iterator[str]:
    """Yield the names of the keys of friction and restitution that a document gives in some tables."""
    for name in tables:
        for table in _tables_in(document, name.split(".")):
            yield from (f"{name}.{quantity}" for quantity in QUANTITIES if quantity in table)


def _where_it_is(path: Path) -> Path:
    """Return a path, or where there is nothing the file of that name in `MOVED_TO` next to it, and say so."""
    moved = path.parent / MOVED_TO / path.name
    if lexists(path) or not isfile(moved):
        return path
    _CONSOLE.warning("%s is now %s", path, moved)
    return moved


def _document_of_file(path: Path, variants: tuple[Path, ...] = (), faults: Faults | None = None) -> dict[str, Any]:
    """Return the document of a file with all that it is based on, which must not be its own variant.

    Where `faults` are given, slips in the file are noted in them.
    """
    document = document_of_file(path, "a scenario", MOST_BYTES, faults)
    _make_paths_absolute(path.parent, document)
    name, without = take_based_on(document)
    if name is None:
        return document
    base = _where_it_is(Path(_absolute(path.parent, name)))
    variants = (*variants, path.resolve())
    if base in variants:
        raise ScenarioError(f"is based on {shown(name)}, which is based on it in turn")
    if len(variants) > MOST_BASES:
        raise ScenarioError(f"expected at most {MOST_BASES} files that are based on each other")
    try:
        inherited = _document_of_file(base, variants)
    except ScenarioError as error:
        raise error.within(f"based on {shown(name)}") from error
    return varied(inherited, document, without)


def _make_paths_absolute(folder: Path, document: dict[str, Any]) -> None:
    """Make the paths of other files absolute, which count from the folder of this file."""
    for name, key in PATHS:
        for table in _tables_in(document, name.split(".")):
            if isinstance(table.get(key), str) and table[key].strip():
                table[key] = _absolute(folder, table[key])


def _tables_in(table: Any, path: list[str]) -> Iterator[dict[str, Any]]:
    """Yield all tables of a document under a path of names, through lists of tables as well."""
    if isinstance(table, list):
        for item in table:
            yield from _tables_in(item, path)
    elif isinstance(table, dict):
        if path:
            yield from _tables_in(table.get(path[0]), path[1:])
        else:
            yield table


def _absolute(folder: Path, path: str) -> str:
    try:
        return str((folder / path).resolve())
    except (OSError, ValueError, RuntimeError) as error:  # a NUL in it, for one, or links that lead in a circle
        raise ScenarioError(f"{shown(path)} is no path of a file: {error}") from error


def take_based_on(document: dict[str, Any]) -> tuple[str | None, list[str]]:
    """Remove the name of the base and the names that are left out from a document, and return both."""
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

    `without` has names such as ``ball`` or ``bridge.pier_caps``, which are left out of the base. Both documents stay.
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
