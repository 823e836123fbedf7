"""Options of cutting a solid, beyond the number of its shards."""

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
    """How a solid is cut."""

    density: PointDensity | None = None  # where points lie closer; evenly by default
    # How far points are moved at random, as a part of a shard's mean size (volume / shards)^(1/3): sampled points stay
    # as random as they are, chosen ones lose their order.
    noise: float = 0.0
    stretch: tuple[float, float, float] = (1.0, 1.0, 1.0)  # relative lengths of shards along x, y and z
    recursion: Recursion | None = None


PLAIN = FractureOptions()
"""Points sampled evenly, and nothing else."""
