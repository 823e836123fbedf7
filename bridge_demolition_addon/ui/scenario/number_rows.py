"""Lists of lengths as rows: each row shows and sets one number, or one point, of the text that a scenario keeps."""

import math
import tomllib
from dataclasses import Field
from functools import cache, lru_cache
from typing import Any, get_args

import bpy
from bpy.props import FloatProperty, FloatVectorProperty, IntProperty, StringProperty

from ...engineering.single_precision import shortest
from ...errors import ScenarioError
from ...model.schema import holds_many, key_of, value_type
from ...model.toml_tables import toml_value
from ..operators import UndoableAction

MOST_ROWS = 24
"""Longer lists are shown as a text."""

_FIRST = 10.0
"""First number of a list that was empty, m."""

_DECIMALS = 3


@cache
def numbers_in_row(item: Field) -> int:
    """Return how many numbers a row of a key's list has; 0 for a key without rows.

    Numbers without a unit have none: a position on a map has more digits than Blender's single precision.
    """
    if not holds_many(item) or get_args(value_type(item))[-1] is not Ellipsis:
        return 0
    kind = get_args(value_type(item))[0]
    if kind is float:
        return 1 if key_of(item).unit else 0
    kinds = get_args(kind)
    return len(kinds) if kinds and set(kinds) == {float} else 0


def row_unit(item: Field) -> str:
    """Return Blender's name for the unit that it shows in each row, NONE where it shows none."""
    return "LENGTH" if key_of(item).unit == "m" else "NONE"


def row_name(name: str, number: int) -> str:
    """Return the name of the property of a row, counted from 0."""
    return f"{name}_row_{number}"


def rows_in(text: str, length: int) -> list[list[float]] | None:
    """Return the rows of a list in the syntax of TOML; None for a text that holds none of that length."""
    rows = _parsed(text, length)
    return None if rows is None else [list(row) for row in rows]


def list_in(text: str) -> list | None:
    """Return a list from TOML, whose outer brackets may be left out; None for a text that is no list."""
    for written in (text, f"[{text}]"):
        try:
            document = tomllib.loads(f"list = {written}")
        except (ValueError, RecursionError):
            continue
        if list(document) == ["list"] and isinstance(document["list"], list):
            return document["list"]
    return None


def row_properties(item: Field, words: dict[str, str]) -> dict[str, Any]:
    """Return a property for each row that a key's list may have."""
    length = numbers_in_row(item)
    return {
        row_name(item.name, number): _row_property(item, number, words) for number in range(MOST_ROWS * bool(length))
    }


def draw_rows(layout: bpy.types.UILayout, group: bpy.types.PropertyGroup, item: Field) -> bool:
    """Draw the rows of a list with buttons to add and remove some; False where only a text can show what is there."""
    rows = rows_in(getattr(group, item.name), numbers_in_row(item))
    if rows is None or len(rows) > MOST_ROWS:
        return False
    path = group.path_from_id(item.name)
    for number in range(len(rows)):
        line = layout.row(align=True)
        line.prop(
            group, row_name(item.name, number), text=f"{number + 1}" if len(rows[number]) == 1 else "", translate=False
        )
        remove = line.operator("bda.remove_row", text="", icon="REMOVE")
        remove.path, remove.length, remove.number = path, len(rows[number]), number
    add = layout.operator("bda.add_row", text="Add", icon="ADD")
    add.path, add.length = path, numbers_in_row(item)
    return True


class _RowOperator(UndoableAction):
    """Base of the operators on the rows of one list."""

    path: StringProperty(name="List", description="Where it is, from the scene: bda.scenario.bridge.span_lengths_m")
    length: IntProperty(name="Length", description="How many numbers a row has: 1 for lengths, 2 for points", default=1)

    def act(self, context: bpy.types.Context) -> None:
        owner, _, name = self.path.rpartition(".")
        try:
            group = context.scene.path_resolve(owner)
            rows = rows_in(getattr(group, name), self.length)
        except (ValueError, AttributeError) as error:
            raise ScenarioError(f"{self.path}: there is no such list") from error
        if rows is None:
            raise ScenarioError(f"{name} is no list of numbers: mend its text first")
        setattr(group, name, _text(self.change(rows)))

    def change(self, rows: list[list[float]]) -> list[list[float]]:
        """Return the rows as they are to be."""
        return rows


class BDA_OT_add_row(_RowOperator, bpy.types.Operator):
    """Add one more to the list, with the value of the last"""

    bl_label = "Add"

    def change(self, rows: list[list[float]]) -> list[list[float]]:
        if len(rows) >= MOST_ROWS:
            raise ScenarioError(f"the sidebar shows up to {MOST_ROWS} of a list: write more into a scenario file")
        return [*rows, rows[-1] if rows else [_FIRST] * self.length]


class BDA_OT_remove_row(_RowOperator, bpy.types.Operator):
    """Remove this one from the list"""

    bl_label = "Remove"

    number: IntProperty(name="Number", description="Which one, from 0", min=0)

    def change(self, rows: list[list[float]]) -> list[list[float]]:
        if self.number >= len(rows):
            raise ScenarioError(f"the list has {len(rows)}: there is no number {self.number + 1} to remove")
        if len(rows) == 1:
            raise ScenarioError("the last one cannot be removed: the list has to have one or more")
        return rows[: self.number] + rows[self.number + 1 :]


def _row_property(item: Field, number: int, words: dict[str, str]) -> Any:
    length, rule = numbers_in_row(item), key_of(item)

    def shown(group: bpy.types.PropertyGroup) -> float | list[float]:
        rows = rows_in(getattr(group, item.name), length) or []
        row = rows[number] if number < len(rows) else [0.0] * length
        return row if length > 1 else row[0]

    def choose(group: bpy.types.PropertyGroup, value: Any) -> None:
        rows = rows_in(getattr(group, item.name), length) or []
        if number < len(rows):
            rows[number] = [shortest(part) for part in (value if length > 1 else [value])]
            setattr(group, item.name, _text(rows))

    limits = {name: limit for name, limit in (("min", rule.at_least), ("max", rule.at_most)) if limit is not None}
    settings = words | limits | {"unit": row_unit(item), "precision": _DECIMALS, "get": shown, "set": choose}
    return FloatVectorProperty(size=length, **settings) if length > 1 else FloatProperty(**settings)


def _text(rows: list[list[float]]) -> str:
    return toml_value([row if len(row) > 1 else row[0] for row in rows])


@lru_cache(maxsize=64)
def _parsed(text: str, length: int) -> tuple[tuple[float, ...], ...] | None:
    parsed = list_in(text) if text.strip() else []
    if parsed is None:
        return None
    rows = tuple(tuple(part) if isinstance(part, list) else (part,) for part in parsed)
    return rows if all(len(row) == length and all(map(_is_number, row)) for row in rows) else None


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
