"""Work done on bodies, sub-step by sub-step: by gravity, loads, tools and damping, and by Bullet's solver.

Bullet finds impulses step by step and stops before they are exact. Where it pulls together connections that have
sagged, or pushes apart hulls that overlap, it does work that no real connection or contact does: it makes energy.

A constant force changes the kinetic energy of a body by the force times the mean of its velocities before and after,
times the step. So the work of an impulse is the impulse times that mean velocity where it acts, and all works together
are the change of kinetic energy. Between two bodies only their relative velocity counts: an impulse that slows it takes
energy away, as impacts, friction and breaking do. One that speeds it up makes energy.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from ..arithmetic import power
from ..geometry.vectors import cross, dot
from .forces import resultants


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """Motion of n bodies at one moment.

    Attributes
    ----------
    centres_m : (n, 3) float
        Centres of mass.
    velocities_m_s, angular_velocities_rad_s : (n, 3) float
    """

    centres_m: np.ndarray
    velocities_m_s: np.ndarray
    angular_velocities_rad_s: np.ndarray


@dataclass(frozen=True, slots=True, eq=False)
class PairImpulses:
    """Impulses between k pairs of bodies in one sub-step: of connections, or of contacts.

    Attributes
    ----------
    pairs : (k, 2) int
        Bodies.
    impulses_ns : (k, 3) float
        Impulse on the first body of each pair; the second gets the opposite.
    points_m : (k, 3) float
        Where they act.
    angular_impulses_nms : (k, 3) float or None
        Impulse of the moment about that point on the first body; None for contacts, which have none.
    """

    pairs: np.ndarray
    impulses_ns: np.ndarray
    points_m: np.ndarray
    angular_impulses_nms: np.ndarray | None = None


@dataclass(frozen=True, slots=True, eq=False)
class FrameWork:
    """Work in one frame, J.

    Attributes
    ----------
    gravity_j : float
        Work of gravity.
    loads_j : float
        Work of blast and of all else that pushes bodies from outside.
    tools_j : float
        Work of bodies that move as animation says, such as a ball that is lifted.
    damping_j : float
        Energy of translation taken away by Blender's damping.
    dissipated_j : float
        Energy taken away between bodies: by impacts, friction, and connections that give.
    made_by_connections_j, made_by_contacts_j, made_by_lifting_j : float
        Energy that the solver has made, by how: connections pulled together, contacts pushed apart, and bodies moved up
        without a velocity, as Bullet parts hulls that overlap.
    made_j : (n,) float
        The same energy by the body that got it.
    """

    gravity_j: float | np.ndarray
    loads_j: float | np.ndarray
    tools_j: float | np.ndarray
    damping_j: float | np.ndarray
    dissipated_j: float | np.ndarray
    made_by_connections_j: float | np.ndarray
    made_by_contacts_j: float | np.ndarray
    made_by_lifting_j: float | np.ndarray
    made_j: np.ndarray

    @classmethod
    def unknown(cls, *shape: int) -> FrameWork:
        """Return work of which nothing is known, nan throughout, on n bodies in one frame, or in frames (k, n)."""
        return cls(*(np.full(shape[:-1], np.nan) for _ in fields(cls)[:-1]), np.full(shape, np.nan))


class WorkAccumulator:
    """Adds up the work in a frame.

    Parameters
    ----------
    masses_kg : (n,) float
        Masses; 0 for bodies that never move.
    linear_damping, angular_damping : (n,) float
        Shares of the velocities that Bullet takes away in a second.
    gravity_m_s2 : (3,) float
        Acceleration of gravity.
    start : Motion
        Motion at the beginning.
    """

    def __init__(
        self,
        masses_kg: np.ndarray,
        linear_damping: np.ndarray,
        angular_damping: np.ndarray,
        gravity_m_s2: np.ndarray,
        start: Motion,
    ):
        self._masses, self._gravity = masses_kg, gravity_m_s2
        self._linear_left, self._angular_left = 1.0 - linear_damping, 1.0 - angular_damping
        self._before = start
        self._begin()

    def _begin(self) -> None:
        self._gravity_j = self._loads_j = self._tools_j = self._damping_j = self._dissipated_j = 0.0
        self._made_by = np.zeros(3)
        self._made_j = np.zeros(len(self._masses))

    def finish(self) -> FrameWork:
        """Return the work of the frame; the next one begins."""
        work = FrameWork(
            self._gravity_j,
            self._loads_j,
            self._tools_j,
            self._damping_j,
            self._dissipated_j,
            *self._made_by.tolist(),
            self._made_j,
        )
        self._begin()
        return work

    def pass_over(self, after: Motion) -> None:
        """Leave out a sub-step that ends with a motion."""
        self._before = after

    def add(
        self,
        after: Motion,
        free: np.ndarray,
        of_connections: PairImpulses,
        of_contacts: PairImpulses,
        substep_s: float,
    ) -> None:
        """Add a sub-step.

        Parameters
        ----------
        after : Motion
            Motion at its end.
        free : (n,) bool
            Bodies that move freely in it. The others rest, or move as animation says.
        of_connections, of_contacts : PairImpulses
            All impulses between bodies.
        substep_s : float
            Its length.
        """
        before, masses = self._before, np.where(free, self._masses, 0.0)
        # Bullet damps velocities first, then adds gravity, loads and the solver's impulses.
        damped = power(self._linear_left, substep_s)[:, None] * before.velocities_m_s
        turning = power(self._angular_left, substep_s)[:, None] * before.angular_velocities_rad_s
        mean = Motion(
            after.centres_m,
            0.5 * (damped + after.velocities_m_s),
            0.5 * (turning + after.angular_velocities_rad_s),
        )
        rest = masses[:, None] * (after.velocities_m_s - damped - substep_s * self._gravity)
        for cause, each in enumerate((of_connections, of_contacts)):
            self._made_by[cause] += self._add_pairs(each, mean, free)
            rest -= resultants(each.pairs, each.impulses_ns, len(masses))
        self._gravity_j += substep_s * float((masses * dot(mean.velocities_m_s, self._gravity)).sum())
        self._loads_j += float(dot(rest, mean.velocities_m_s)[free].sum())
        squares = dot(before.velocities_m_s, before.velocities_m_s) - dot(damped, damped)
        self._damping_j += 0.5 * float((masses * squares).sum())
        self._made_by[2] += self._add_lifting(after, masses, substep_s)
        self._before = after

    def _add_pairs(self, between: PairImpulses, mean: Motion, free: np.ndarray) -> float:
        """Add work between bodies: what is taken away, what tools did, what each body got. Return what is made."""
        first, second = between.pairs.T
        moves = free[first], free[second]
        works = _work_on(first, between, mean), -_work_on(second, between, mean)
        total = np.where(moves[0] | moves[1], works[0] + works[1], 0.0)
        gains = [np.where(mover, work, 0.0) for mover, work in zip(moves, works, strict=True)]
        self._tools_j += float((gains[0] + gains[1] - total).sum())
        self._dissipated_j -= float(np.minimum(total, 0.0).sum())
        gains = [np.maximum(gain, 0.0) for gain in gains]
        both = gains[0] + gains[1]
        made = np.maximum(total, 0.0)
        share = np.divide(made, both, out=np.zeros_like(both), where=both > 0.0)
        for bodies, gain in zip((first, second), gains, strict=True):
            self._made_j += np.bincount(bodies, share * gain, len(free))
        return float(made.sum())

    def _add_lifting(self, after: Motion, masses: np.ndarray, substep_s: float) -> float:
        """Return the energy of bodies that Bullet moved up without a velocity: so it parts hulls that overlap."""
        pushed = after.centres_m - self._before.centres_m - substep_s * after.velocities_m_s
        made = np.maximum(-masses * dot(pushed, self._gravity), 0.0)
        self._made_j += made
        return float(made.sum())


def _work_on(bodies: np.ndarray, between: PairImpulses, mean: Motion) -> np.ndarray:
    """Work (k,) of impulses on bodies (k,), J."""
    arms, turning = between.points_m - mean.centres_m[bodies], mean.angular_velocities_rad_s[bodies]
    work = dot(between.impulses_ns, mean.velocities_m_s[bodies] + cross(turning, arms))
    if between.angular_impulses_nms is not None:
        work += dot(between.angular_impulses_nms, turning)
    return work
