"""Kinds of connections between two bodies, and what breaks them."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from ..elasticity.section_stiffness import ElasticModuli
from .strength import Strength

TYPES = ("FIXED", "POINT", "HINGE", "GENERIC", "GENERIC_SPRING")
"""Kinds of connections: FIXED holds everything, POINT a point, HINGE all but the rotation about the vertical, GENERIC
all but what is free, and GENERIC_SPRING has springs in what is free."""


class JointMotion(StrEnum):
    """Motions of one body against the other: along and about the axes of the world, as they are built."""

    MOVE_X = "move x"
    MOVE_Y = "move y"
    MOVE_Z = "move z"
    TURN_X = "turn x"
    TURN_Y = "turn y"
    TURN_Z = "turn z"

    @property
    def turns(self) -> bool:
        """Whether the body turns about an axis, instead of moving along it."""
        return self in (JointMotion.TURN_X, JointMotion.TURN_Y, JointMotion.TURN_Z)


MOTIONS = tuple(motion.value for motion in JointMotion)
"""Names of these motions in a scenario."""


@dataclass(frozen=True, slots=True)
class Springs:
    """Springs in the motions that a GENERIC_SPRING connection lets happen; without load as it was built."""

    stiffness_n_m: float = 0.0  # along each free axis
    damping_ns_m: float = 0.0
    turning_stiffness_nm_rad: float = 0.0  # about each free axis
    turning_damping_nms_rad: float = 0.0

    def of(self, motion: JointMotion) -> tuple[float, float]:
        """Return stiffness and damping of the spring in a motion."""
        if motion.turns:
            return self.turning_stiffness_nm_rad, self.turning_damping_nms_rad
        return self.stiffness_n_m, self.damping_ns_m


@dataclass(frozen=True, eq=False, slots=True)
class Joint:
    """Properties that many connections share; None where a connection has none of that kind."""

    type: str  # one of `TYPES`
    free: tuple[str, ...] = ()  # the `MOTIONS` that a GENERIC or GENERIC_SPRING connection lets happen
    springs: Springs = Springs()
    breaking_force_n: float | None = None
    strength: Strength | None = None  # stresses that break it
    moduli: ElasticModuli | None = None  # None where it is rigid
