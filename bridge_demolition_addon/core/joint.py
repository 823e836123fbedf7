"""What kind of connection holds two bodies together, and what breaks it."""

from __future__ import annotations

from dataclasses import dataclass

from .strength import Strength

TYPES = ("FIXED", "POINT", "HINGE", "GENERIC")
"""Kinds of connections that can be built."""

MOTIONS = ("move x", "move y", "move z", "turn x", "turn y", "turn z")
"""How one body can move against the other: along and about the axes of the world, as they are built."""


@dataclass(frozen=True, eq=False, slots=True)
class Joint:
    """What many connections have in common.

    Attributes
    ----------
    type
        One of `TYPES`: FIXED holds everything, POINT a point, HINGE all but the rotation about the vertical, GENERIC
        all but what is free.
    free
        The `MOTIONS` that a GENERIC connection lets happen.
    breaking_force_n
        Force that breaks the connection; None where no single force does.
    strength
        Stresses that break it; None where no stress does.
    """

    type: str
    free: tuple[str, ...] = ()
    breaking_force_n: float | None = None
    strength: Strength | None = None
