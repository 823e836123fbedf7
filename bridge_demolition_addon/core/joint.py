"""What kind of connection holds two bodies together, and what breaks it."""

from __future__ import annotations

from dataclasses import dataclass

from .strength import Strength


@dataclass(frozen=True, eq=False, slots=True)
class Joint:
    """What many connections have in common.

    Attributes
    ----------
    type
        Blender's type of constraint: FIXED, POINT or HINGE.
    breaking_force_n
        Force that breaks the connection; None where no single force does.
    strength
        Stresses that break it; None where no stress does.
    """

    type: str
    breaking_force_n: float | None = None
    strength: Strength | None = None
