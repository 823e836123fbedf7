"""Keys and tables of a scenario: what they mean, and which values they take.

A table is a dataclass. Its fields are made by `key`, or hold other tables. The check of the values (`Table`), the
messages (`expected`), the reference of keys and the sidebar follow from this one declaration.
"""

import json
import sys
from abc import ABCMeta
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import MISSING, Field, dataclass, field, fields, replace
from functools import cache
from numbers import Integral, Real
from types import NoneType
from typing import Any, ClassVar, TypeVar, get_args, get_origin
from unicodedata import bidirectional, category, normalize

import numpy as np

from ..errors import Faults, ScenarioError

_Value = TypeVar("_Value")
_Table = TypeVar("_Table", bound="Table")

Scalar = bool | int | float | str
"""Type of a value that may be any of these."""

LARGEST_INTEGER = 2**31 - 1
"""Largest whole number that Blender's properties hold."""

SMALLEST_NUMBER = float(np.finfo(np.float32).tiny)
LARGEST_NUMBER = float(np.finfo(np.float32).max)
"""Bounds of the sizes that Blender's single precision holds; what is not 0 has to lie between them."""

SHORTEST_LENGTH_M = 0.001
"""Least size of anything solid: Bullet mixes up the contacts of smaller bodies."""

FARTHEST_M = 10_000.0
"""Largest distance of anything solid from the origin: Blender's single precision keeps it to a millimetre."""

SIZE = {"unit": "m", "at_least": SHORTEST_LENGTH_M, "at_most": FARTHEST_M}
"""Unit and limits of a size of anything solid."""

POSITION = {"unit": "m", "at_least": -FARTHEST_M, "at_most": FARTHEST_M}
"""Unit and limits of a coordinate of anything solid."""

LARGEST_BY_NAME = {"thickness_m": 100.0, "width_m": 1000.0, "diameter_m": 1000.0, "scale": 1e6, "friction": 100.0}
EARLIER_NAMES = {
    "place_m": "position_m",
    "spin_rad_s": "angular_velocity_rad_s",
    "rest_spin_rad_s": "rest_angular_velocity_rad_s",
}
"""Present names of keys, by those that they had before: files with these are still read."""

LARGEST_BY_UNIT = {
    "m": 1e8,
    "m³": 1e9,
    "mm²": 1e8,
    "kg": 1e9,
    "kg/m": 1e6,
    "kg/m³": 1e5,
    "s": 1e6,
    "ms": 1e9,
    "m/s": 1e5,
    "m³/h": 1e5,
    "h": 1e5,
    "mm/s": 1e6,
    "rad/s": 1e5,
    "1/s": 1e4,
    "°": 1e5,
    "N": 1e13,
    "kgf": 1e12,
    "N/s": 1e15,
    "N/m": 1e16,
    "N·s/m": 1e16,
    "N·m/rad": 1e16,
    "N·m·s/rad": 1e16,
    "N/mm²": 1e7,
    "kPa": 1e7,
}
"""Largest sizes of numbers, by the end of their keys' names, or else by their units: no bridge and nothing that is done
to one comes near them. The heaviest bridges have 4e8 kg, and a section of 1000 m² of steel holds 1e12 N."""

OTHER_UNITS = {
    "m": ("millimetres", 1e3),
    "kg": ("grams", 1e3),
    "s": ("milliseconds", 1e3),
    "N/mm²": ("N/m²", 1e6),
    "kg/m³": ("t/m³", 1e-3),
}
"""Units that numbers are given in by mistake, and how many of them are one of the right unit."""

SHARE = {"at_least": 0, "at_most": 1}
"""Limits of a part of something."""

DENSITY = {"default": None, "unit": "kg/m³", "at_least": 10}
"""Unit and limits of a density that may be left out: no solid of a bridge is lighter than foam."""

ROUNDING = 1e-9
"""Relative slack where lengths are compared that a user would add up in decimals."""

LONGEST_SHOWN_TEXT = 60
LONGEST_TEXT = 1000
_TURNING = {"LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI"}
"""Classes of letters by which a text looks like another: Unicode Standard Annex 9, 2.1 to 2.5."""

LINE_BREAKING_CATEGORIES = {"Cc", "Cs", "Zl", "Zp"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Key:
    """What a key means, as a contractor would say it, and the unit and the limits of its value."""

    description: str
    unit: str = ""  # SI symbol, empty for a plain number
    above: float | None = None
    at_least: float | None = None
    at_most: float | None = None
    choices: tuple[str, ...] = ()  # empty for any text
    or_else: str = ""  # text for other values, which the table around this one checks
    typical: Any = None  # a usual value of what has no default, for its tooltip
    label: str = ""  # what the window calls it where its own name would puzzle, without a unit

    @property
    def limits(self) -> str:
        """Limits as text, such as ``above 0`` or ``from 1 to 1000``; empty if there are none."""
        if self.at_least is not None and self.at_most is not None:
            return f"from {self.at_least} to {self.at_most}"
        words = {"above": self.above, "of at least": self.at_least, "up to": self.at_most}
        return " and ".join(f"{word} {limit}" for word, limit in words.items() if limit is not None)

    def holds(self, value: float) -> bool:
        """Return whether a number is finite and within the limits."""
        return (
            abs(value) <= sys.float_info.max  # a whole number may be larger
            and (self.above is None or value > self.above)
            and (self.at_least is None or value >= self.at_least)
            and (self.at_most is None or value <= self.at_most)
        )


def key(description: str, *, default: Any = MISSING, **limits: Any) -> Any:
    """Return the dataclass field of a key, by the fields of `Key`; without a default the key is required."""
    return field(default=default, metadata={"key": Key(description=description, **limits)})


class _TableType(ABCMeta):
    """Makes a table as it is written, and returns it resolved: with its values as they are kept, and what follows."""

    def __call__(cls, *args: Any, **values: Any) -> Any:
        known = cls.__dataclass_fields__  # type: ignore[attr-defined]
        values = {name if name in known else EARLIER_NAMES.get(name, name): value for name, value in values.items()}
        table = super().__call__(*args, **values)
        for changes_of in (_kept_values, named_tables, cls.resolved):  # type: ignore[attr-defined]
            if changes := changes_of(table):
                written = {item.name: getattr(table, item.name) for item in fields(table)}
                table = super().__call__(**written | changes)
        table._check_together()
        return table


class Table(metaclass=_TableType):
    """Base of the dataclasses of a scenario, one for each table: checks its values when it is made.

    Whole numbers are taken where a number is expected, and lists are kept as tuples.
    """

    __slots__ = ()
    __dataclass_fields__: ClassVar[dict[str, Field[Any]]]
    table: ClassVar[str]
    named_beside: ClassVar[str] = ""
    """Another list of tables that names are shared with: no two of both may have one."""
    may_share_names: ClassVar[bool] = False
    """Whether several tables of a list may have one name, as nothing refers to one of them by it."""
    numbered: ClassVar[str] = ""
    """What a table without a name is called, with its number after it."""
    is_object: ClassVar[bool] = False
    """Whether the window shows each as an object of the scene, and not as a table."""

    def resolved(self) -> dict[str, Any]:
        """Return the values that follow from others, by the names of their fields."""
        return {}

    def _check_together(self) -> None:
        """Check the values against each other."""

    def unexpected(self, name: str, wanted: str) -> ScenarioError:
        """Return the error of a value, with its key and what was expected in its place."""
        return ScenarioError(f"{self.table}.{name} is {shown(getattr(self, name))}: expected {wanted}")


def _kept_values(table: Table) -> dict[str, Any]:
    """Return the values of a table that are kept otherwise than they are given, each checked by itself."""
    kept, faults = {}, Faults()
    for item in fields(table):
        with faults.noted():
            value = getattr(table, item.name)
            if (as_kept := checked(item, key_name(type(table), item), value)) is not value:
                kept[item.name] = as_kept
    faults.check()
    return kept


def named_tables(holder: Table) -> dict[str, Any]:
    """Return tables without a name called after their number; no two may have one that it identifies."""
    places: dict[tuple[str, str], list[str]] = {}
    numbered = {}
    for item in fields(holder):
        inner = subtable_class(item)
        if inner is None or not holds_many(item) or "name" not in inner.__dataclass_fields__:
            continue
        tables = getattr(holder, item.name) or ()
        if inner.numbered and not all(table.name for table in tables):
            tables = numbered[item.name] = named(tables)
        for number, table in enumerate(() if inner.may_share_names else tables, start=1):
            alike = normalize("NFC", " ".join(table.name.split()))
            places.setdefault((inner.named_beside or inner.table, alike), []).append(
                f"[[{inner.table}]] number {number}"
            )
    twice = {name: found for (_, name), found in places.items() if len(found) > 1}
    if twice:
        raise ScenarioError(
            *(
                f"{' and '.join(found)} have one name, {shown(name)}: expected a name of its own for each"
                for name, found in twice.items()
            )
        )
    return numbered


def named(tables: Sequence[_Table]) -> tuple[_Table, ...]:
    """Return the tables of a list, where those without a name are called after their number."""
    return tuple(
        table if table.name else replace(table, name=f"{table.numbered} {number}")  # type: ignore[attr-defined]
        for number, table in enumerate(tables, start=1)
    )


def given(value: _Value | None) -> _Value:
    """Return a value that the check of its table has found to be given."""
    assert value is not None
    return value


def numbered_tables(
    table_class: type[Table], values: Iterable[_Value], make: Callable[[_Value], _Table]
) -> tuple[_Table, ...]:
    """Make the tables of a list; each fault gives the number of the table that it is about."""
    tables, faults = [], Faults()
    for number, value in enumerate(values, start=1):
        try:
            tables.append(make(value))
        except ScenarioError as error:
            faults.found += error.within(f"[[{table_class.table}]] number {number}").faults
    faults.check()
    return tuple(tables)


def key_fields(table_class: type[Table]) -> Iterator[Field[Any]]:
    """Return the fields of a table that hold plain values."""
    return (item for item in fields(table_class) if subtable_class(item) is None)


def subtable_fields(table_class: type[Table]) -> Iterator[Field[Any]]:
    """Return the fields of a table that hold tables."""
    return (item for item in fields(table_class) if subtable_class(item) is not None)


def key_name(table_class: type[Table], item: Field[Any]) -> str:
    """Return the name of a key or table as it stands in a scenario, such as ``bridge.deck.width_m``."""
    inner = subtable_class(item)
    return inner.table if inner else f"{table_class.table}.{item.name}"


def key_of(item: Field[Any]) -> Key:
    """Return what `key` was given for a field that holds a plain value."""
    return item.metadata["key"]


def is_required(item: Field[Any]) -> bool:
    """Return whether a scenario has to name this key or table."""
    return item.default is MISSING and item.default_factory is MISSING


@cache
def is_optional(item: Field[Any]) -> bool:
    """Return whether the value may be None, which leaves a key or table out."""
    return NoneType in get_args(item.type)


@cache
def value_type(item: Field[Any]) -> Any:
    """Return the type of a field's value where it is given: ``float`` for ``float | None``."""
    return next(kind for kind in get_args(item.type) if kind is not NoneType) if is_optional(item) else item.type


@cache
def holds_many(item: Field[Any]) -> bool:
    """Return whether a field holds a list, of tables or of values."""
    return get_origin(value_type(item)) is tuple


@cache
def subtable_class(item: Field[Any]) -> type[Table] | None:
    """Return the dataclass of the table or tables that a field holds, None for a field with a plain value."""
    kind = get_args(value_type(item))[0] if holds_many(item) else value_type(item)
    return kind if isinstance(kind, type) and issubclass(kind, Table) else None


def checked(item: Field[Any], name: str, value: Any) -> Any:
    """Check the value of a key or table and return it as it is kept."""
    if value is None and is_optional(item):
        return None
    table_class = subtable_class(item)
    if table_class and holds_many(item):
        if not isinstance(value, list | tuple) or not all(isinstance(inner, table_class) for inner in value):
            raise _unexpected(item, name, value)
        return tuple(value)
    return _checked(item, name, value_type(item), value)


def _checked(item: Field[Any], name: str, kind: Any, value: Any) -> Any:
    """Check a value that is to be of a kind, or an element of a list, which is named by its number as in a study."""
    if get_origin(kind) is tuple:
        length = _list_length(kind)
        if not isinstance(value, list | tuple) or len(value) != (length or max(len(value), 1)):
            raise _unexpected(item, name, value)
        element = get_args(kind)[0]
        return tuple(_checked(item, f"{name}.{number}", element, inner) for number, inner in enumerate(value, start=1))
    if kind in (int, float):
        return _checked_number(item, name, kind, value)
    if kind is Scalar:
        return _checked(item, name, type(value) if isinstance(value, bool | int | str) else float, value)
    if not isinstance(value, kind) or (kind is str and not _is_text(value, key_of(item))):
        raise _unexpected(item, name, value)
    if kind is str and (fault := _fault_of(value)):
        raise _unexpected(item, name, value, f"; {fault}")
    return value


def _checked_number(item: Field[Any], name: str, kind: type, value: Any) -> int | float:
    if isinstance(value, bool) or not isinstance(value, Integral if kind is int else Real):
        raise _unexpected(item, name, value)
    try:
        number = kind(value)
    except OverflowError as error:
        raise _unexpected(item, name, value) from error
    rule = key_of(item)
    if not rule.holds(number):
        raise _unexpected(item, name, value, _asked_unit(item, number))
    if abs(number) > (largest := _largest(item)):
        unit = f" ({rule.unit})" if rule.unit else ""
        wanted = f"expected at most {largest:.15g}{unit}{_asked_unit(item, number)}"
        raise ScenarioError(f"{name} is {shown(value)}: {wanted}")
    if number and not SMALLEST_NUMBER <= abs(number) <= LARGEST_NUMBER:
        raise ScenarioError(f"{name} is {shown(value)}: expected a number that single precision can hold")
    return number


@cache
def _largest(item: Field[Any]) -> float:
    """Return the largest size that a number has in anything that makes sense."""
    by_name = (limit for ending, limit in LARGEST_BY_NAME.items() if item.name.endswith(ending))
    return next(by_name, LARGEST_BY_UNIT.get(key_of(item).unit, LARGEST_NUMBER))


def _asked_unit(item: Field[Any], number: float) -> str:
    """Return the question whether a number that is refused is in another unit; empty where that fits no better."""
    if key_of(item).unit not in OTHER_UNITS:
        return ""
    word, factor = OTHER_UNITS[key_of(item).unit]
    fits = key_of(item).holds(number / factor) and abs(number / factor) <= _largest(item)
    return f"; is this in {word}?" if fits else ""


def _is_text(text: str, rule: Key) -> bool:
    if rule.choices and not rule.or_else:
        return text in rule.choices
    return bool(text.strip()) and not any(category(letter) in LINE_BREAKING_CATEGORIES for letter in text)


def _fault_of(text: str) -> str:
    """Return what of a text is shown as something else, or as nothing that can be read; empty for none."""
    if len(text) > LONGEST_TEXT:
        return f"this one has {len(text)} letters, more than {LONGEST_TEXT}"
    turned = next((letter for letter in text if bidirectional(letter) in _TURNING), "")
    return f"U+{ord(turned):04X} in it turns the direction of what is written" if turned else ""


def check_exactly_one(table: Table, *names: str) -> None:
    """Check that one of several keys is given."""
    present = [name for name in names if getattr(table, name) is not None]
    if not present:
        *first, last = names
        raise ScenarioError(f"{table.table} has no {', '.join(first)} or {last}: give one of them")
    if len(present) > 1:
        listed = " and ".join(f"{table.table}.{name}" for name in present)
        raise ScenarioError(f"{listed} are given together: give only one of them")


def _unexpected(item: Field[Any], name: str, value: Any, more: str = "") -> ScenarioError:
    return ScenarioError(f"{name} is {shown(value)}: expected {expected(item)}{more}")


def expected(item: Field[Any]) -> str:
    """Return what a key takes, such as ``a number above 0 (m)``."""
    if subtable_class(item):
        return "tables" if holds_many(item) else "a table"
    rule, kind = key_of(item), value_type(item)
    if kind is bool:
        return "true or false"
    if kind is str:
        others = f", or {rule.or_else}" if rule.or_else else ""
        return f"one of {_listed(rule.choices)}{others}" if rule.choices else "a text on one line, not blank"
    noun, _ = _nouns(kind)
    if rule.choices:
        noun = f"{noun}, each one of {_listed(rule.choices)}"
    unit = f"({rule.unit})" if rule.unit else ""
    return " ".join(part for part in (noun, rule.limits, unit) if part)


def _nouns(kind: Any) -> tuple[str, str]:
    """Return the name of a kind of value, in singular and plural."""
    if get_origin(kind) is tuple:
        of = f"of {_list_length(kind) or 'one or more'} {_nouns(get_args(kind)[0])[1]}"
        return f"a list {of}", f"lists {of}"
    names = {
        int: ("a whole number", "whole numbers"),
        str: ("a text", "texts"),
        Scalar: ("a number, a text, true or false", "numbers, texts, true or false"),
    }
    return names.get(kind, ("a number", "numbers"))


def _list_length(kind: Any) -> int | None:
    """Return the length of a list, None where it may have any but 0."""
    return None if Ellipsis in get_args(kind) else len(get_args(kind))


def _listed(choices: Sequence[str]) -> str:
    return ", ".join(map(json.dumps, choices))


def shown(value: Any) -> str:
    """Return a value of a scenario as a short text on one line."""
    if value is None:
        return "missing"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Integral) and abs(int(value)) > 2**63:
        return "a whole number of more than 64 bits"
    if isinstance(value, str):
        letters = value.encode(errors="backslashreplace").decode()  # halves of letters cannot be written
        return json.dumps(shortened(letters), ensure_ascii=False)
    if isinstance(value, list | tuple):
        return f"a list of length {len(value)}"
    if isinstance(value, dict):
        return "a table"
    return shortened(" ".join(str(value).split()))


def shortened(text: str) -> str:
    """Return a text of the user's as a message has it: its beginning where it is long."""
    return text if len(text) <= LONGEST_SHOWN_TEXT else text[:LONGEST_SHOWN_TEXT] + "…"
