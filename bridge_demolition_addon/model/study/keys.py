"""Keys of a scenario by their dotted names, also into lists, and scenarios with other values of them."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import Field, dataclass, fields, replace
from difflib import get_close_matches
from functools import cache
from typing import Any, get_args, get_origin

from ...errors import ScenarioError
from ..scenario import Scenario
from ..scenario.contacts import BodyInContact
from ..schema import EARLIER_NAMES, Table, holds_many, key_name, key_of, shown, subtable_class, value_type
from ..toml_tables import dotted, say_renamed

_LEAF = "the key itself"

_NAMES = ("name", "member")
"""Keys by which the tables of a list are named, where they have one of these."""


@dataclass(frozen=True, slots=True)
class ScenarioKey:
    """A key of a scenario that holds one value."""

    name: str  # dotted, such as ``charges."mid pier".mass_kg``
    steps: tuple[str | int, ...]  # the way to it: names of fields, and indices in lists
    item: Field  # its declaration, with its limits
    value: Any  # None where the scenario does not give it

    @property
    def unit(self) -> str:
        """Unit of the value, empty for a plain number."""
        return key_of(self.item).unit

    @property
    def has_number(self) -> bool:
        """Whether the scenario has a number there."""
        return isinstance(self.value, int | float) and not isinstance(self.value, bool)


def keys_named(scenario: Scenario, name: str) -> tuple[ScenarioKey, ...]:
    """Return the key of a dotted name; several where it stands for every table of a list."""
    parts = _parts(name)
    if parts[0] == Scenario.table:
        parts = parts[1:] if len(parts) > 1 else parts
        allowed = [item for item in fields(Scenario) if subtable_class(item) is None]
    else:
        allowed = [item for item in fields(Scenario) if subtable_class(item) is not None]
    if parts[0] not in [item.name for item in allowed]:
        raise ScenarioError(f"{name} is unknown: expected a key with its table, such as ball.drop_height_m")
    root = Scenario.table if subtable_class(_field(Scenario, parts[0])) is None else ""
    return tuple(_keys(scenario, name, parts, root, ()))


def changed(scenario: Scenario, values: Mapping[ScenarioKey, Any]) -> Scenario:
    """Return a scenario with other values of some keys, checked as a whole."""
    return _changed(scenario, {key.steps: value for key, value in values.items()})


@cache
def names_to_propose() -> tuple[str, ...]:
    """Return the names of the keys that a scenario may have and a study may vary: numbers, choices, true or false.

    In lists they stand for every table. Of several numbers it is the first.
    """
    return tuple(_names_to_propose(Scenario))


def _names_to_propose(table_class: type[Table]) -> Iterator[str]:
    for item in fields(table_class):
        if inner := subtable_class(item):
            yield from _names_to_propose(inner)
        elif (table_class, item.name) != (Scenario, "seed") and (ending := _way_to_a_value(item)) is not None:
            yield key_name(table_class, item) + ending


def _way_to_a_value(item: Field) -> str | None:
    """Return what leads from a key to one value to sample: empty for a single one, None where there is none."""
    kind, ending = value_type(item), ""
    while get_origin(kind) is tuple:
        kind, ending = get_args(kind)[0], f"{ending}.1"
    return ending if kind is not str or key_of(item).choices else None


def _parts(name: str) -> list[str]:
    """Return the parts of a dotted name, which is written as TOML has it."""
    try:
        inner: Any = tomllib.loads(f"{name} = {json.dumps(_LEAF)}")
    except (ValueError, RecursionError) as error:
        raise ScenarioError(f"{shown(name)} is no name of a key: expected one such as ball.drop_height_m") from error
    parts = []
    while isinstance(inner, dict) and len(inner) == 1:
        [(part, inner)] = inner.items()
        parts.append(part)
    if inner != _LEAF:
        raise ScenarioError(f"{shown(name)} is no name of a key: expected one such as ball.drop_height_m")
    return parts


def _field(table_class: type[Table], name: str) -> Field:
    return next(item for item in fields(table_class) if item.name == name)


def _keys(table: Table, name: str, parts: list[str], before: str, steps: tuple) -> Iterator[ScenarioKey]:
    """Follow the parts of a name that lead on from a table."""
    first, *rest = parts
    known = [item.name for item in fields(table)]
    if first not in known and EARLIER_NAMES.get(first) in known:
        say_renamed(name, EARLIER_NAMES[first])
        first = EARLIER_NAMES[first]
    if first not in known:
        if alike := get_close_matches(first, known, n=1):
            raise ScenarioError(f"{name} is unknown: did you mean {dotted(table.table, alike[0])}?")
        raise ScenarioError(f"{name} is unknown: expected one of {', '.join(known)} after {table.table}")
    item, value = _field(type(table), first), _value_of(table, first)
    so_far, way = dotted(before, first), (*steps, first)
    if subtable_class(item) is None:
        yield from _values(item, value, name, rest, so_far, way)
    elif holds_many(item):
        yield from _in_list(value, name, rest, so_far, way)
    elif value is None:
        raise ScenarioError(f"{name} is not in the scenario: it has no table [{item.name}]")
    elif not rest:
        raise ScenarioError(f"{name} is a table: expected a key of it, such as {name}.{fields(value)[0].name}")
    else:
        yield from _keys(value, name, rest, so_far, way)


def _value_of(table: Table, name: str) -> Any:
    """Return a value of a table; of a body's own friction or restitution the one that it has in older files."""
    value = getattr(table, name)
    return table.older_values.get(name) if value is None and isinstance(table, BodyInContact) else value


def _in_list(tables: tuple[Table, ...], name: str, parts: list[str], before: str, steps: tuple) -> Iterator:
    """Follow the parts of a name that lead into a list of tables: to one of them by name or number, or to all."""
    if not tables:
        raise ScenarioError(f"{name} is not in the scenario: it has no [[{before}]]")
    if not parts:
        raise ScenarioError(f"{name} is a list: expected a key after it, such as {name}.1.{_first_key(tables)}")
    names = [_name_of(table) or str(number) for number, table in enumerate(tables, start=1)]
    first, *rest = parts
    chosen = [index for index, own_name in enumerate(names) if own_name == first]
    if not chosen and first.isascii() and first.isdigit() and 1 <= int(first[:9]) <= len(tables):
        chosen = [int(first) - 1]
    if not chosen and EARLIER_NAMES.get(first, first) in [item.name for item in fields(tables[0])]:
        chosen, rest = list(range(len(tables))), parts
    if not chosen:
        raise ScenarioError(f"{name} is not in the scenario: [[{before}]] has {', '.join(map(shown, names))}")
    if not rest:
        raise ScenarioError(f"{name} is a table: expected a key of it, such as {name}.{_first_key(tables)}")
    for index in chosen:
        label = names[index] if names.count(names[index]) == 1 else str(index + 1)
        yield from _keys(tables[index], name, rest, dotted(before, label), (*steps, index))


def _values(item: Field, value: Any, name: str, parts: list[str], before: str, steps: tuple) -> Iterator[ScenarioKey]:
    """Follow the parts of a name that lead to a value, or into a list of values by their numbers."""
    if parts and value is None and holds_many(item):
        raise ScenarioError(f"{name} is not in the scenario: it has no {before}")
    for part in parts:
        if not isinstance(value, tuple):
            raise ScenarioError(f"{name} is unknown: {before} has one value")
        if not (part.isascii() and part.isdigit() and 1 <= int(part[:9]) <= len(value)):
            raise ScenarioError(f"{name} is unknown: expected a number from 1 to {len(value)} after {before}")
        value, before, steps = value[int(part) - 1], f"{before}.{int(part)}", (*steps, int(part) - 1)
    if isinstance(value, tuple) or (value is None and holds_many(item)):
        raise ScenarioError(f"{name} is a list: expected the number of a value after it, such as {name}.1")
    yield ScenarioKey(before, steps, item, value)


def _name_of(table: Table) -> str | None:
    return next((getattr(table, name) for name in _NAMES if getattr(table, name, None)), None)


def _first_key(tables: tuple[Table, ...]) -> str:
    return fields(tables[0])[0].name


def _changed(value: Any, changes: Mapping[tuple, Any]) -> Any:
    """Return a table, a list or a value with changes, each by the way to it."""
    if () in changes:
        return changes[()]
    inner: dict[Any, dict[tuple[Any, ...], Any]] = {}
    for (first, *rest), changed_value in changes.items():
        inner.setdefault(first, {})[tuple(rest)] = changed_value
    if isinstance(value, tuple):
        return tuple(_changed(item, inner[index]) if index in inner else item for index, item in enumerate(value))
    return replace(value, **{name: _changed(getattr(value, name), rest) for name, rest in inner.items()})
