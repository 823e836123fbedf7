"""What Blender data keeps of a scenario: tables as JSON, or as one value for each key.

Files saved before have to stay readable: a table in a list has its name under ``table`` among its keys, and a key
without a value is left out where each has a property of its own.
"""

import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict
from typing import Any, TypeVar

from ...errors import ScenarioError
from ..schema import Table, key_fields, shown, value_type

_Table = TypeVar("_Table", bound=Table)


def tables_text(tables: Iterable[Table]) -> str:
    """Return tables as a JSON list."""
    return values_text([{"table": table.table, **asdict(table)} for table in tables])


def tables_from_text(text: str, classes: Iterable[type[_Table]]) -> tuple[_Table, ...]:
    """Return the tables in a JSON list, each of one of some classes; none where the text is empty."""
    named = {cls.table: cls for cls in classes}
    kept = values_from_text(text, [])
    try:
        return tuple(table_from_values(named[values.pop("table")], values) for values in kept)
    except (AttributeError, KeyError, TypeError) as error:
        raise ScenarioError(f"what this file keeps of its scenario was edited: {error}; undo that") from error


def table_values(table: Table) -> dict[str, Any]:
    """Return the value of each key of a table without inner tables; None where a key has no value."""
    return {item.name: getattr(table, item.name) for item in key_fields(type(table))}


def table_from_values(table_class: type[_Table], values: Mapping[str, Any]) -> _Table:
    """Return the table with some values, and the defaults of keys that have none."""
    kinds = {item.name: value_type(item) for item in key_fields(table_class)}
    # Blender gives some truth values back as numbers.
    return table_class(**{name: bool(value) if kinds[name] is bool else value for name, value in values.items()})


def values_text(values: Any) -> str:
    return json.dumps(values)


def values_from_text(text: str, nothing: Any) -> Any:
    """Return the values in JSON; `nothing` where the text is empty."""
    if text == "":
        return nothing
    try:
        values = json.loads(text)
    except (TypeError, ValueError) as error:
        raise ScenarioError(f"what this file keeps of its scenario was edited: {error}; undo that") from error
    if not isinstance(values, type(nothing)):
        raise ScenarioError(f"what this file keeps of its scenario was edited: found {shown(values)}; undo that")
    return values
