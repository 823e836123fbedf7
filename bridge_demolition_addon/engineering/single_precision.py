"""Numbers that Blender holds in single precision, and the decimals that the user gave."""

from __future__ import annotations

from typing import Any

import numpy as np


def shortest(number: float) -> float:
    """Return the shortest decimal that single precision takes for this number."""
    return float(str(np.float32(number)))


def as_given(value: Any, given: Any) -> Any:
    """Return the number that was given, where Blender holds just that, else the shortest decimal of what it holds.

    A value that is no float is returned as it is.
    """
    if not isinstance(value, float):
        return value
    return given if given is not None and np.float32(given) == np.float32(value) else shortest(value)
