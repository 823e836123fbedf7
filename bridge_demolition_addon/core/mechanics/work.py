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

    def rests(self) -> bool:
        """Return whether no body has a velocity."""
        return not (self.velocities_m_s.any() or self.angular_velocities_rad_s.any())


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
        self._left_per_second = 1.0 - np.stack((linear_damping, angular_damping))
        self._step_s = 0.0
        self._linear_left = self._angular_left = np.ones((len(masses_kg), 1))
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
        resultants_ns: np.ndarray,
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
        resultants_ns : (n, 3) float
            Their sum on every body.
        substep_s : float
            Its length.
        """
        before, masses = self._before, np.where(free, self._masses, 0.0)
        self._before = after
        if before.rests() and after.rests() and np.array_equal(before.centres_m, after.centres_m):
            return
        self._set_step(substep_s)
        # Bullet damps velocities first, then adds gravity, loads and the solver's impulses.
        damped = self._linear_left * before.velocities_m_s
        turning = self._angular_left * before.angular_velocities_rad_s
        mean = Motion(
            after.centres_m,
            0.5 * (damped + after.velocities_m_s),
            0.5 * (turning + after.angular_velocities_rad_s),
        )
        momenta = masses[:, None] * (after.velocities_m_s - damped - substep_s * self._gravity)
        self._loads_j += float(dot(momenta - resultants_ns, mean.velocities_m_s)[free].sum())
        self._gravity_j += substep_s * float((masses * dot(mean.velocities_m_s, self._gravity)).sum())
        squares = dot(before.velocities_m_s, before.velocities_m_s) - dot(damped, damped)
        self._damping_j += 0.5 * float((masses * squares).sum())
        for cause, each in enumerate((of_connections, of_contacts)):
            self._made_by[cause] += self._add_pairs(each, mean, free)
        self._made_by[2] += self._add_lifting(before, after, masses, substep_s)

    def _set_step(self, substep_s: float) -> None:
        """Have the shares of the velocities that Bullet's damping leaves in a sub-step; most have the same length."""
        if substep_s != self._step_s:
            self._step_s = substep_s
            self._linear_left, self._angular_left = power(self._left_per_second, substep_s)[..., None]

    def _add_pairs(self, between: PairImpulses, mean: Motion, free: np.ndarray) -> float:
        """Add work between bodies: what is taken away, what tools did, what each body got. Return what is made."""
        # The velocity of a point p of a body is v + ω × (p - c): of what it has at the origin and of ω.
        at_origin = mean.velocities_m_s - cross(mean.angular_velocities_rad_s, mean.centres_m)
        motion = np.concatenate((at_origin, mean.angular_velocities_rad_s), axis=1)
        about_origin = cross(between.points_m, between.impulses_ns)
        if between.angular_impulses_nms is not None:
            about_origin = about_origin + between.angular_impulses_nms
        loads = np.concatenate((between.impulses_ns, about_origin), axis=1)
        first, second = between.pairs.T
        total = dot(loads, motion.take(first, axis=0) - motion.take(second, axis=0))
        total[~(free[first] | free[second])] = 0.0
        self._dissipated_j -= float(np.minimum(total, 0.0).sum())
        self._add_tools(between, loads, motion, free)
        rows = np.flatnonzero(total > 0.0)
        gains = [
            np.maximum(sign * dot(loads[rows], motion[bodies[rows]]), 0.0) * free[bodies[rows]]
            for sign, bodies in ((1.0, first), (-1.0, second))
        ]
        both = gains[0] + gains[1]
        share = np.divide(total[rows], both, out=np.zeros_like(both), where=both > 0.0)
        for bodies, gain in zip((first, second), gains, strict=True):
            self._made_j += np.bincount(bodies[rows], share * gain, len(free))
        return float(total[rows].sum())

    def _add_tools(self, between: PairImpulses, loads: np.ndarray, motion: np.ndarray, free: np.ndarray) -> None:
        """Add the work of bodies that move as animation says on those that move freely."""
        led = ~free & motion.any(axis=1)
        if not led.any():
            return
        for sign, bodies, others in ((-1.0, *between.pairs.T), (1.0, *between.pairs.T[::-1])):
            rows = np.flatnonzero(led[bodies] & free[others])
            self._tools_j += sign * float(dot(loads[rows], motion[bodies[rows]]).sum())

    def _add_lifting(self, before: Motion, after: Motion, masses: np.ndarray, substep_s: float) -> float:
        """Return the energy of bodies that Bullet moved up without a velocity: so it parts hulls that overlap."""
        pushed = after.centres_m - before.centres_m - substep_s * after.velocities_m_s
        made = np.maximum(-masses * dot(pushed, self._gravity), 0.0)
        self._made_j += made
        return float(made.sum())
