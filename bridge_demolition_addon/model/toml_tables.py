"""Tables in TOML: read strictly into their classes, and written back without loss.

The file of a class holds its own keys under its heading, and the tables in it next to that.
"""

import json
import logging
import re
from collections.abc import Iterator, Sequence
from dataclasses import MISSING, Field, fields
from difflib import get_close_matches
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

from ..errors import Faults, ScenarioError, UnreadableError
from ..system.reading import MEGABYTE, file_text
from .schema import (
    EARLIER_NAMES,
    Table,
    checked,
    expected,
    holds_many,
    is_required,
    key_fields,
    key_name,
    numbered_tables,
    shortened,
    shown,
    subtable_class,
    subtable_fields,
)
from .toml_slips import parsed

LIKENESS = 0.68
"""Least likeness of an unknown name and a suggestion: radius_m means search_radius_m, but title does not mean time."""

_KINDS = {
    "study": "this is a study: use bda study",
    "search": "this is a search: use bda search",
    "optimise": "this is an optimisation: use bda optimise",
    "scenario": "this is a scenario: use bda check or bda run",
}
"""What to do with each kind of file, by its heading. In a study, `scenario` is a key and no heading."""

_OTHER_WORDS = {
    "bearing": "bearings",
    "blasting": "blast",
    "cap": "pier_caps",
    "charge": "charges",
    "columns": "piers",
    "crack_width": "gap_m",
    "cuts": "saw_cuts",
    "density": "density_kg_m3",
    "earthquake": "ground_motion",
    "excavators": "equipment",
    "explosive": "charges",
    "explosives": "charges",
    "footings": "foundations",
    "fragments": "fracture",
    "hammer": "jackhammers",
    "joints": "connections",
    "location_m": "position_m",
    "machines": "equipment",
    "members": "geometry",
    "mesh": "geometry",
    "meshes": "geometry",
    "pillars": "piers",
    "rebar": "reinforcement",
    "receptors": "neighbours",
    "slab": "deck",
    "soil": "foundations",
    "springs": "foundations",
    "terrain": "ground",
    "wrecking_ball": "ball",
}
"""Names of tables and keys by other words for the same."""

_IFC = "ISO-10303-21;"

_OF_ENDING = {
    **dict.fromkeys((".ifc", ".ifcxml", ".ifczip"), "this is an IFC file: use bda import"),
    **dict.fromkeys((".obj", ".stl", ".ply", ".glb", ".gltf"), "this is a mesh: name it in a scenario, [[geometry]]"),
    **dict.fromkeys(
        (".las", ".laz", ".xyz", ".asc", ".tif", ".tiff"), "this is ground: name it in a scenario, [ground]"
    ),
    **dict.fromkeys(
        (".dwg", ".dxf", ".rvt", ".skp", ".blend"), "this is not read: export an IFC file, or meshes as OBJ"
    ),
}
"""What to do with files of other kinds, by their ending."""

_CONSOLE = logging.getLogger(__name__)

BARE_KEY = re.compile(r"[A-Za-z0-9_-]{1,60}")

_Root = TypeVar("_Root", bound=Table)


def document_of_file(
    path: Path, description: str, most_bytes: int = MEGABYTE, faults: Faults | None = None
) -> dict[str, Any]:
    """Return the content of a TOML file; errors do not name it. Where `faults` are given, slips are noted in them."""
    try:
        if path.suffix.lower() in _OF_ENDING and path.is_file():
            raise ScenarioError(_OF_ENDING[path.suffix.lower()])
        text = file_text(path, most_bytes)
    except UnreadableError as error:
        raise ScenarioError(f"{error}: expected {description} in TOML") from error
    if text.startswith(_IFC):
        raise ScenarioError(_OF_ENDING[".ifc"])
    if not text.strip():
        raise ScenarioError(f"is empty: expected {description} in TOML, see examples")
    return toml_document(text, faults)


def toml_document(text: str, faults: Faults | None = None) -> dict[str, Any]:
    """Return the content of a text in TOML. Where `faults` are given, slips are noted in them, and otherwise raised."""
    noted = Faults() if faults is None else faults
    document = parsed(text, noted)
    if faults is None:
        noted.check()
    return document


def table_of_document(root: type[_Root], document: dict[str, Any]) -> _Root:
    """Return the table in a document, where its own keys stand under its heading, next to the tables in it."""
    _check_kind(root, document)
    heading = document.get(root.table, {})
    if not isinstance(heading, dict):
        raise ScenarioError(f"{root.table} is {shown(heading)}: expected a table")
    faults = Faults()
    tables = _meant(root, "", document, [root.table, *(item.name for item in subtable_fields(root))], faults)
    keys = _meant(root, root.table, heading, [item.name for item in key_fields(root)], faults)
    return _made(root, root, {name: tables[name] for name in tables if name != root.table} | keys, faults)


def tables_text(root: Table, *, defaults: bool = True) -> str:
    """Write a table, and the tables in it, as TOML, with or without what is as by default.

    `table_of_document` gives an equal one back.
    """
    return "\n".join(_table_lines(root, defaults=defaults))


def dotted(table: str, name: str) -> str:
    """Return the name of a key in a table as TOML has it, in quotation marks where it needs them."""
    part = name if BARE_KEY.fullmatch(name) else toml_value(name)
    return f"{table}.{part}" if table else part


def toml_value(value: Any) -> str:
    """Write a value of a key as TOML."""
    if isinstance(value, tuple):
        return f"[{', '.join(map(toml_value, value))}]"
    if isinstance(value, bool | str):
        return json.dumps(value, ensure_ascii=False)
    return repr(value)


def _check_kind(root: type[Table], document: dict[str, Any]) -> None:
    """Refuse a file of another kind."""
    if root.table in _KINDS and not isinstance(document.get(root.table), dict):
        for name, sentence in _KINDS.items():
            if isinstance(document.get(name), dict):
                raise ScenarioError(sentence)


def _table(root: type[Table], table_class: type[Table], values: Any) -> Table:
    if not isinstance(values, dict):
        raise ScenarioError(f"{table_class.table} is {shown(values)}: expected a table")
    faults = Faults()
    known = [item.name for item in fields(table_class)]
    return _made(root, table_class, _meant(root, table_class.table, values, known, faults), faults)


def _made(root: type[Table], table_class: type[_Root], values: dict[str, Any], faults: Faults) -> _Root:
    """Make a table, or raise the faults that were found before and all of its own."""
    made = {}
    for item in fields(table_class):
        name = key_name(table_class, item)
        if item.name in values:
            with faults.noted():
                made[item.name] = _value(root, item, name, values[item.name])
        elif is_required(item):
            faults.found.append(f"{name} is missing: expected {expected(item)}")
    faults.check()
    return table_class(**made)


def _value(root: type[Table], item: Field[Any], name: str, value: Any) -> Any:
    table_class = subtable_class(item)
    if table_class is None:
        return checked(item, name, value)
    return (_tables if holds_many(item) else _table)(root, table_class, value)


def _tables(root: type[Table], table_class: type[Table], values: Any) -> tuple[Table, ...]:
    """Return the tables of a list, each written under its own ``[[name]]``."""
    if not isinstance(values, list):
        raise ScenarioError(
            f"{table_class.table} is {shown(values)}: expected tables, each under [[{table_class.table}]]"
        )
    return numbered_tables(table_class, values, lambda value: _table(root, table_class, value))


def _meant(
    root: type[Table], table: str, values: dict[str, Any], known: Sequence[str], faults: Faults
) -> dict[str, Any]:
    """Return the values of known names, and of unknown ones under the names that are meant; note the unknown."""
    values = _renamed(table, values, known, faults)
    meant = {name: value for name, value in values.items() if name in known}
    for name in values:
        if name not in known:
            alike = _alike(name, known)
            faults.found.append(
                f"{dotted(table, shortened(name))} is unknown: {_suggestion(root, table, name, known, alike)}"
            )
            if alike:
                meant.setdefault(alike[0], values[name])
    return meant


def _renamed(table: str, values: dict[str, Any], known: Sequence[str], faults: Faults) -> dict[str, Any]:
    """Return values under the present names of keys that had another one before, and say so; refuse both at once."""
    renamed = {}
    for name, value in values.items():
        present = name if name in known else EARLIER_NAMES.get(name, name)
        if present == name or present not in known:
            renamed[name] = value
        elif present in values:
            faults.found.append(
                f"{dotted(table, name)} is given with its present name, {present}: expected one of both"
            )
        else:
            renamed[present] = value
            say_renamed(dotted(table, name), dotted(table, present))
    return renamed


@cache
def say_renamed(before: str, now: str) -> None:
    """Say once that a key has another name now."""
    _CONSOLE.warning("%s is %s now: its earlier name will be refused some day", before, now)


def _alike(name: str, known: Sequence[str]) -> list[str]:
    """Return the known name that an unknown one stands for, by its meaning or its letters; an empty list if none."""
    same = _OTHER_WORDS.get(name.lower())
    return [same] if same is not None and same in known else get_close_matches(name, known, n=1, cutoff=LIKENESS)


def _suggestion(root: type[Table], table: str, name: str, known: Sequence[str], alike: Sequence[str]) -> str:
    """Return what is meant by an unknown name: a name of its table, one elsewhere, or any of its table."""
    if alike:
        return f"did you mean {dotted(table, alike[0])}?"
    wanted = f"expected one of {', '.join(known)}"
    elsewhere = next((full for full in _full_names(root) if full.rpartition(".")[2] == name), "")
    if not elsewhere:
        return wanted
    # A table beside this one, such as [geometry] for what is a key of [ground], is rarely meant.
    return (
        f"{wanted}; [{elsewhere}] is a table by itself"
        if table and "." not in elsewhere
        else f"did you mean {elsewhere}?"
    )


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
