"""What kind of connection holds two bodies together, and what breaks it."""

from __future__ import annotations

from dataclasses import dataclass

from .strength import Strength

TYPES = ("FIXED", "POINT", "HINGE", "GENERIC", "GENERIC_SPRING")
"""Kinds of connections that can be built."""

MOTIONS = ("move x", "move y", "move z", "turn x", "turn y", "turn z")
"""How one body can move against the other: along and about the axes of the world, as they are built."""


@dataclass(frozen=True, slots=True)
class Springs:
    """Springs in the motions that a GENERIC_SPRING connection lets happen; without load as it was built.

    Attributes
    ----------
    stiffness_n_m, damping_ns_m
        Along each free axis.
    turning_stiffness_nm_rad, turning_damping_nms_rad
        About each free axis.
    """

    stiffness_n_m: float = 0.0
    damping_ns_m: float = 0.0
    turning_stiffness_nm_rad: float = 0.0
    turning_damping_nms_rad: float = 0.0


@dataclass(frozen=True, eq=False, slots=True)
class Joint:
    """What many connections have in common.

    Attributes
    ----------
    type
        One of `TYPES`: FIXED holds everything, POINT a point, HINGE all but the rotation about the vertical, GENERIC
        all but what is free, and GENERIC_SPRING has springs in what is free.
    free
        The `MOTIONS` that a GENERIC or GENERIC_SPRING connection lets happen.
    springs
        Of a GENERIC_SPRING connection.
    breaking_force_n
        Force that breaks the connection; None where no single force does.
    strength
        Stresses that break it; None where no stress does.
    """

    type: str
    free: tuple[str, ...] = ()
    springs: Springs = Springs()
    breaking_force_n: float | None = None
    strength: Strength | None = None
