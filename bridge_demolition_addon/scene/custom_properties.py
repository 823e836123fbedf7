"""Custom properties: Blender data keeps in them what it was made with, and users can edit them in Blender's panel."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import bpy

from ..errors import SimulationError
from ..model.schema import LARGEST_NUMBER


def keep(holder: bpy.types.ID, name: str, value: Any) -> None:
    """Keep a value in a property, and so in the file; None removes the property."""
    if value is not None:
        holder[name] = value
    elif name in holder:
        del holder[name]


def kept_numbers(holder: bpy.types.ID, name: str, default: Sequence[float]) -> tuple[float, ...]:
    """Return the numbers of a property, as many as its default, which is returned where there is none."""
    value = holder.get(name, default)
    try:
        numbers = tuple(map(float, value))
    except (TypeError, ValueError):
        numbers = ()
    if len(numbers) != len(default):
        raise edited(holder, name, f"{len(default)} numbers")
    return numbers


def kept_number(holder: bpy.types.ID, name: str, default: float) -> float:
    """Return the number of a property, or the default where there is none."""
    value = holder.get(name, default)
    if not isinstance(value, int | float) or not abs(value) <= LARGEST_NUMBER:
        raise edited(holder, name, "a number that something can have")
    return float(value)


def edited(holder: bpy.types.ID, name: str, expected: str) -> SimulationError:
    """Return the error that a property holds something else than expected."""
    return SimulationError(f"{holder.name}: its custom property {name} was edited: expected {expected}; undo that")
