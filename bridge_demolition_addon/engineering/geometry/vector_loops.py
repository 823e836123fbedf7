"""Products of vectors as functions of loops, which Numba compiles: import this only where it is installed."""

from __future__ import annotations

from typing import Any

from ..compilation import compiled


@compiled
def dotted(first: Any, second: Any) -> Any:
    """Dot product."""
    return first[0] * second[0] + first[1] * second[1] + first[2] * second[2]


@compiled
def crossed(first: Any, second: Any) -> Any:
    """Cross product."""
    (x, y, z), (a, b, c) = first, second
    return y * c - z * b, z * a - x * c, x * b - y * a
