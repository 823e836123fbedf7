"""How a solid is cut, beyond the number of its shards."""

from __future__ import annotations

from dataclasses import dataclass

from .density import PointDensity


@dataclass(frozen=True, slots=True)
class Recursion:
    """Shards that are cut again: a random `share` of those that hold at least `smallest_m3`, each into `shards`."""

    share: float
    shards: int
    smallest_m3: float = 0.0


@dataclass(frozen=True, slots=True)
class FractureOptions:
    """How a solid is cut.

    Attributes
    ----------
    density : PointDensity, optional
        Where the points lie closer; evenly by default.
    noise : float
        How far points are moved at random, in any direction, as a part of a shard's mean size (volume / shards)^(1/3):
        points drawn at random stay as random as they are, given ones lose their order.
    stretch : (3,) float
        How long shards are along x, y and z, relative to each other.
    recursion : Recursion, optional
        Which shards are cut again.
    """

    density: PointDensity | None = None
    noise: float = 0.0
    stretch: tuple[float, float, float] = (1.0, 1.0, 1.0)
    recursion: Recursion | None = None


PLAIN = FractureOptions()
"""Points drawn evenly, and nothing else."""
