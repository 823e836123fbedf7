"""Custom properties: Blender data keeps in them what it was made with, and users can edit them in Blender's panel.

A scene keeps in them the tables by which a run does what is planned, until a recording applies them.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import isnan
from typing import Any

import bpy
import numpy as np

from ..errors import ScenarioError, SimulationError
from ..model.actions import PlannedAction
from ..model.scenario.kept import tables_from_text, tables_text, values_from_text
from ..model.scenario.scenario import run_tables
from ..model.schema import LARGEST_NUMBER


def keep(holder: bpy.types.ID, name: str, value: Any) -> None:
    """Keep a value in a property, and so in the file; None removes the property."""
    if value is not None:
        holder[name] = value
    elif name in holder:
        del holder[name]


def kept_numbers(holder: bpy.types.ID, name: str, default: Sequence[float]) -> tuple[float, ...]:
    """Return the numbers of a property, as many as its default, which is returned where there is none."""
    if name not in holder:
        return tuple(map(float, default))
    numbers = kept_series(holder, name, f"{len(default)} numbers")
    if len(numbers) != len(default):
        raise edited(holder, name, f"{len(default)} numbers")
    return tuple(numbers.tolist())


def kept_series(holder: bpy.types.ID, name: str, expected: str) -> np.ndarray:
    """Return the numbers (k,) of a property, none nan; an error says what was expected there."""
    value = holder.get(name)
    try:
        numbers = [] if isinstance(value, str | bytes) else [float(number) for number in value]
    except (TypeError, ValueError) as error:
        raise edited(holder, name, expected) from error
    if isinstance(value, str | bytes) or any(map(isnan, numbers)):
        raise edited(holder, name, expected)
    return np.array(numbers, float)


def kept_values(holder: bpy.types.ID, name: str, nothing: Any) -> Any:
    """Return the values that a property holds as JSON, of the type of `nothing`, which is returned without any."""
    try:
        return values_from_text(holder.get(name, ""), nothing)
    except ScenarioError as error:
        raise edited(holder, name, "the text that the add-on wrote") from error


def kept_number(holder: bpy.types.ID, name: str, default: float) -> float:
    """Return the number of a property, or the default where there is none."""
    value = holder.get(name, default)
    if not isinstance(value, int | float) or not abs(value) <= LARGEST_NUMBER:
        raise edited(holder, name, "a number that something can have")
    return float(value)


def edited(holder: bpy.types.ID, name: str, expected: str) -> SimulationError:
    """Return the error that a property holds something else than expected."""
    return SimulationError(f"{holder.name}: its custom property {name} was edited: expected {expected}; undo that")


def keep_run_tables(scene: bpy.types.Scene, tables: Sequence[PlannedAction]) -> None:
    """Keep tables in the scene, and so in its file, in place of earlier ones; a recording of it applies them."""
    for name in run_tables():
        keep_tables(scene, name, [table for table in tables if table.kept_in == name])


def keep_tables(scene: bpy.types.Scene, name: str, tables: Sequence[PlannedAction]) -> None:
    """Keep the tables of one name in place of earlier ones."""
    keep(scene, _property(name), tables_text(tables) if tables else None)


def run_tables_of(scene: bpy.types.Scene, name: str) -> tuple[Any, ...]:
    """Return the tables that a scene keeps under a name."""
    try:
        return tables_from_text(scene.get(_property(name), ""), run_tables()[name])
    except ScenarioError as error:
        raise edited(scene, _property(name), f"the text that the add-on wrote ({error})") from error


def _property(name: str) -> str:
    return f"bda_{name}"
