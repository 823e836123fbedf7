"""Calls of functions of the core that answer whether they could do what they were asked for."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from typing import Any

import numpy as np

from ...errors import NotFiniteError
from .library import function
from .structs import NotFinite, Struct, address_of

DONE, NO_MEMORY, OUT_OF_RANGE, NOT_FINITE = range(4)
"""Answers of functions: those of `core/src/vectors.h`."""

_OF_BODIES = (
    *("position", "rotation", "velocity", "angular velocity", "mass", "moment of inertia", "force"),
    "impulse of a contact",
)
CONTACT_IMPULSE = len(_OF_BODIES) - 1
_OF_CONNECTIONS = ("deformation", "stiffness", "damping", "force")
"""Quantities in the order of `core/src/core.h`."""

_ANSWERS = {
    NO_MEMORY: "there is not enough memory for what the core was asked for",
    OUT_OF_RANGE: "the core was given numbers of bodies, connections or other rows that there are not",
}

_TYPES = frozenset(np.dtype(kind).str for kind in (np.float64, np.int64, np.uint64, np.bool_))


_KNOWN: dict[str, Callable[..., Any]] = {}
"""Functions that were called before, by their names."""


def answer_of(name: str, *arguments: Struct | np.ndarray | float) -> int:
    """Call a function with structs, arrays, counts and numbers, and return its answer."""
    given = [_given(argument) for argument in arguments]
    if name not in _KNOWN:
        _KNOWN[name] = function(name, *map(_kind, arguments))
    answer: int = _KNOWN[name](*given)
    return answer


def call(name: str, *arguments: Struct | np.ndarray | float) -> None:
    """Call a function with structs, arrays, counts and numbers.

    Raises
    ------
    NotFiniteError
        Something is endless or no number, as the first struct says.
    ValueError
        Numbers are out of range.
    MemoryError
        There is no room.
    """
    answer = answer_of(name, *arguments)
    if answer:
        wrong = next((argument.wrong for argument in arguments if hasattr(argument, "wrong")), NotFinite())
        raise fault(answer, wrong)


def fault(answer: int, wrong: NotFinite) -> Exception:
    """Return the error of an answer; `wrong` is what is not finite, where that is it."""
    if answer == NOT_FINITE:
        return not_finite(wrong.quantity, wrong.row)
    return (MemoryError if answer == NO_MEMORY else ValueError)(_ANSWERS[answer])


def not_finite(quantity: int, row: int) -> NotFiniteError:
    """Return the error that a quantity of a body or connection is not finite, by their numbers in the core."""
    if quantity < len(_OF_BODIES):
        return NotFiniteError(_OF_BODIES[quantity], row)
    return NotFiniteError(_OF_CONNECTIONS[quantity - len(_OF_BODIES)], row, of_connection=True)


def _given(argument: Struct | np.ndarray | float) -> int | float:
    """Return what C gets of an argument: the address of what is more than a number."""
    if isinstance(argument, np.ndarray):
        if argument.dtype.str not in _TYPES or not argument.flags.c_contiguous:
            raise ValueError(f"the core gets no numbers of type {argument.dtype}, nor any out of order")
        return address_of(argument)
    return ctypes.addressof(argument) if isinstance(argument, Struct) else argument


def _kind(argument: Struct | np.ndarray | float) -> type[ctypes.c_void_p | ctypes.c_double | ctypes.c_int64]:
    """Return the type of C of an argument."""
    if isinstance(argument, Struct | np.ndarray):
        return ctypes.c_void_p
    return ctypes.c_double if isinstance(argument, float) else ctypes.c_int64
