"""What a key of a scenario means and which values it takes: checks, messages and the reference come from here."""

import json
import math
from collections.abc import Iterator, Sequence
from dataclasses import MISSING, Field, dataclass, field, fields
from numbers import Integral, Real
from types import NoneType
from typing import Any, ClassVar, get_args, get_origin
from unicodedata import category

import numpy as np

from ..errors import ScenarioError

LARGEST_INTEGER = 2**31 - 1
"""Largest whole number that Blender's properties hold."""

SMALLEST_NUMBER = float(np.finfo(np.float32).tiny)
LARGEST_NUMBER = float(np.finfo(np.float32).max)
"""Bounds of the sizes that Blender's single precision holds; what is not 0 has to lie between them."""

SHORTEST_LENGTH_M = 0.001
"""Least size of anything solid: Bullet cannot tell contacts apart on bodies that are smaller still."""

FARTHEST_M = 10_000.0
"""How far from the origin anything solid may reach: Blender's single precision keeps places there to a millimetre."""

ROUNDING = 1e-9
"""Relative slack where lengths are compared that a user would add up in decimals."""

LONGEST_SHOWN_TEXT = 60
LINE_BREAKING_CATEGORIES = {"Cc", "Cs", "Zl", "Zp"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Key:
    """Meaning of a key: a description, the unit and the limits of its value.

    Parameters
    ----------
    description
        What the value says, as a contractor would.
    unit
        SI symbol, empty for a plain number.
    above
        The value has to be larger than this.
    at_least, at_most
        Smallest and largest value.
    choices
        The only texts that are taken; empty for any text.
    """

    description: str
    unit: str = ""
    above: float | None = None
    at_least: float | None = None
    at_most: float | None = None
    choices: tuple[str, ...] = ()

    @property
    def limits(self) -> str:
        """The limits in words, such as ``above 0`` or ``from 1 to 1000``; empty if there are none."""
        if self.at_least is not None and self.at_most is not None:
            return f"from {self.at_least} to {self.at_most}"
        words = {"above": self.above, "of at least": self.at_least, "up to": self.at_most}
        return " and ".join(f"{word} {limit}" for word, limit in words.items() if limit is not None)

    def holds(self, value: float) -> bool:
        """Whether a number is finite and within the limits."""
        return (
            math.isfinite(value)
            and (self.above is None or value > self.above)
            and (self.at_least is None or value >= self.at_least)
            and (self.at_most is None or value <= self.at_most)
        )


def key(description: str, *, default: Any = MISSING, **limits: Any) -> Any:
    """Dataclass field of a key in a scenario; without a default the key is required.

    Parameters
    ----------
    description
        What the value says.
    default
        Value of a key that is left out.
    **limits
        The other parameters of `Key`.
    """
    return field(default=default, metadata={"key": Key(description=description, **limits)})


class Table:
    """Base of the dataclasses of a scenario, one for each table: checks its values when it is made.

    Whole numbers are taken where a number is expected, and lists are kept as tuples.

    Raises
    ------
    ScenarioError
        A value has the wrong type or is outside its limits, or values contradict each other.
    """

    __slots__ = ()
    table: ClassVar[str]

    def __post_init__(self) -> None:
        for item in fields(self):
            object.__setattr__(self, item.name, checked(item, key_name(type(self), item), getattr(self, item.name)))
        self._check_together()

    def _check_together(self) -> None:
        """Check what a single value cannot tell."""


def subtable_class(item: Field) -> type[Table] | None:
    """Dataclass of the table or tables that a field holds, none for a field that holds a plain value."""
    held = value_type(item)
    if get_origin(held) is tuple:
        held = get_args(held)[0]
    return held if isinstance(held, type) and issubclass(held, Table) else None


def holds_many(item: Field) -> bool:
    """Whether a field holds a list, of tables or of values."""
    return get_origin(value_type(item)) is tuple


def value_type(item: Field) -> Any:
    """Type of a field's value where it is given: ``float`` for ``float | None``."""
    kinds = [kind for kind in get_args(item.type) if kind is not NoneType]
    return kinds[0] if NoneType in get_args(item.type) else item.type


def key_fields(table_class: type[Table]) -> Iterator[Field]:
    """Fields of a table that hold plain values."""
    return (item for item in fields(table_class) if subtable_class(item) is None)


def subtable_fields(table_class: type[Table]) -> Iterator[Field]:
    """Fields of a table that hold tables."""
    return (item for item in fields(table_class) if subtable_class(item) is not None)


def is_required(item: Field) -> bool:
    """Whether a scenario has to name this key or table."""
    return item.default is MISSING and item.default_factory is MISSING


def key_name(table_class: type[Table], item: Field) -> str:
    """Name of a key or table as it stands in a scenario, such as ``bridge.deck.width_m``."""
    inner = subtable_class(item)
    return inner.table if inner else f"{table_class.table}.{item.name}"


def expected(item: Field) -> str:
    """What a key takes, in words, such as ``a number above 0 (m)``."""
    if subtable_class(item):
        return "tables" if holds_many(item) else "a table"
    rule: Key = item.metadata["key"]
    held = value_type(item)
    if held is bool:
        return "true or false"
    if held is str:
        return f"one of {_listed(rule.choices)}" if rule.choices else "a text on one line, not blank"
    noun, _ = _nouns(held)
    if rule.choices:
        noun = f"{noun}, each one of {_listed(rule.choices)}"
    unit = f"({rule.unit})" if rule.unit else ""
    return " ".join(part for part in (noun, rule.limits, unit) if part)


def checked(item: Field, name: str, value: Any) -> Any:
    """The value of a key as it is kept, after checking it.

    Raises
    ------
    ScenarioError
        The value is not what `expected` says; the text gives the key's name and the value found.
    """
    if value is None and NoneType in get_args(item.type):
        return None
    held = value_type(item)
    if table_class := subtable_class(item):
        return _checked_tables(item, name, value, table_class)
    if get_origin(held) is tuple:
        return _checked_list(item, name, held, value)
    if held in (int, float):
        return _checked_number(item, name, value)
    if not isinstance(value, held) or (held is str and not _is_text(value, item.metadata["key"].choices)):
        raise _unexpected(item, name, value)
    return value


def check_exactly_one(table: Table, *names: str) -> None:
    """See that one of several keys is given.

    Raises
    ------
    ScenarioError
        None is, or more than one.
    """
    given = [name for name in names if getattr(table, name) is not None]
    if len(given) != 1:
        state = "given together" if given else "all missing"
        listed = " and ".join(f"{table.table}.{name}" for name in given or names)
        raise ScenarioError(f"{listed} are {state}: expected exactly one of {', '.join(names)}")


def shown(value: Any) -> str:
    """A value found in a scenario as a short text on one line."""
    if value is None:
        return "missing"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Integral) and abs(value) > 2**63:
        return "a whole number of more than 64 bits"
    if isinstance(value, str):
        return json.dumps(_shortened(value), ensure_ascii=False)
    if isinstance(value, list | tuple):
        return f"a list of length {len(value)}"
    if isinstance(value, dict):
        return "a table"
    return _shortened(" ".join(str(value).split()))


def _listed(choices: Sequence[str]) -> str:
    return ", ".join(map(json.dumps, choices))


def _list_length(held: Any) -> int | None:
    kinds = get_args(held)
    return None if Ellipsis in kinds else len(kinds)


def _checked_tables(item: Field, name: str, value: Any, table_class: type[Table]) -> Table | tuple[Table, ...]:
    if not holds_many(item):
        if not isinstance(value, table_class):
            raise _unexpected(item, name, value)
        return value
    if not isinstance(value, list | tuple) or not all(isinstance(each, table_class) for each in value):
        raise _unexpected(item, name, value)
    return tuple(value)


def _nouns(held: Any) -> tuple[str, str]:
    """What a type of values is called, one and several of them."""
    if get_origin(held) is tuple:
        of = f"of {_list_length(held) or 'one or more'} {_nouns(get_args(held)[0])[1]}"
        return f"a list {of}", f"lists {of}"
    return {int: ("a whole number", "whole numbers"), str: ("a text", "texts")}.get(held, ("a number", "numbers"))


def _checked_list(item: Field, name: str, held: Any, values: Any) -> tuple[Any, ...]:
    length = _list_length(held)
    if not isinstance(values, list | tuple) or len(values) != (length or max(len(values), 1)):
        raise _unexpected(item, name, values)
    kind = get_args(held)[0]
    return tuple(_checked_element(item, f"{name}[{place}]", kind, value) for place, value in enumerate(values))


def _checked_element(item: Field, name: str, kind: Any, value: Any) -> Any:
    if get_origin(kind) is tuple:
        return _checked_list(item, name, kind, value)
    if kind is str:
        if not isinstance(value, str) or not _is_text(value, item.metadata["key"].choices):
            raise _unexpected(item, name, value)
        return value
    return _checked_number(item, name, value)


def _checked_number(item: Field, name: str, value: Any) -> int | float:
    whole = value_type(item) is int
    if isinstance(value, bool) or not isinstance(value, Integral if whole else Real):
        raise _unexpected(item, name, value)
    try:
        number = int(value) if whole else float(value)
    except OverflowError as error:
        raise _unexpected(item, name, value) from error
    if not item.metadata["key"].holds(number):
        raise _unexpected(item, name, value)
    if number and not SMALLEST_NUMBER <= abs(number) <= LARGEST_NUMBER:
        raise ScenarioError(f"{name} is {shown(value)}: expected a number that single precision can hold")
    return number


def _is_text(text: str, choices: tuple[str, ...]) -> bool:
    if choices:
        return text in choices
    return bool(text.strip()) and not any(category(letter) in LINE_BREAKING_CATEGORIES for letter in text)


def _unexpected(item: Field, name: str, value: Any) -> ScenarioError:
    return ScenarioError(f"{name} is {shown(value)}: expected {expected(item)}")


def _shortened(text: str) -> str:
    return text if len(text) <= LONGEST_SHOWN_TEXT else text[:LONGEST_SHOWN_TEXT] + "…"
