"""Work done on bodies, sub-step by sub-step: by gravity, loads, tools and damping, and by Bullet's solver.

Bullet finds impulses step by step and stops before they are exact. Where it pulls together connections that have
stretched, or pushes apart hulls that overlap, it does work that no real connection or contact does: it makes energy.

A constant force changes the kinetic energy of a body by the force times the mean of its velocities before and after,
times the step. So the work of an impulse is the impulse times that mean velocity where it acts, and all works together
are the change of kinetic energy. Between two bodies only their relative velocity counts: an impulse that slows it takes
energy away, as impacts, friction and breaking do. One that speeds it up gives back what was taken before, by elastic
connections and by bodies since they touch (`touches`), and makes energy beyond that. All points where two bodies touch
count together.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any, Generic, TypeVar

import numpy as np

from ..arithmetic import power
from ..arrays import BoolArray, FloatArray, IntArray
from ..core.calls import call
from ..core.structs import Count, Doubles, Flags, Indices, Struct, WrittenDoubles, WrittenIndices
from ..geometry.vectors import as_components, as_vectors, cross_by_component, dot
from .stress import PairSums
from .touches import Touches


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """Motion of n bodies at the ends of s sub-steps, arrays (s, n, 3)."""

    centres_m: FloatArray  # centres of mass
    velocities_m_s: FloatArray
    angular_velocities_rad_s: FloatArray

    def rests(self) -> bool:
        """Return whether no body has a velocity at any of these times, and none is moved from one to the next."""
        if self.velocities_m_s.any() or self.angular_velocities_rad_s.any():
            return False
        return bool((self.centres_m == self.centres_m[:1]).all())

    def from_(self, before: Motion) -> Motion:
        """Return the motion (s + 1, n, 3) that begins where another ends."""
        names = (item.name for item in fields(Motion))
        return Motion(*(_joined(getattr(before, name)[-1:], getattr(self, name)) for name in names))


@dataclass(frozen=True, slots=True, eq=False)
class PairImpulses:
    """Impulses between k pairs of bodies: of connections, in each of s sub-steps, or of contacts, each in one."""

    pairs: IntArray  # (k, 2), bodies
    impulses_ns: FloatArray  # (s, k, 3) or (k, 3), on the first body of a pair; the second gets the opposite
    points_m: FloatArray  # where they act
    angular_impulses_nms: FloatArray | None = None  # (s, k, 3), of the moment about that point; contacts have none
    substeps: IntArray | None = None  # (k,), of each contact, in ascending order; None for connections
    stored_j: FloatArray | None = None  # (s, k), energy that elastic connections can have stored at each end

    def of_substeps(self, count: int) -> list[slice]:
        """Return which impulses are in each of `count` sub-steps, all of them in a row."""
        steps = np.arange(count + 1)
        ends = steps * len(self.pairs) if self.substeps is None else np.searchsorted(self.substeps, steps)
        return [slice(start, end) for start, end in itertools.pairwise(ends.tolist())]

    def components(self) -> list[FloatArray]:
        """Return the components (6,) of impulses and of their moments about the origin, (k,) or (s k,) each."""
        about_origin = cross_by_component(self.points_m, self.impulses_ns)
        if self.angular_impulses_nms is not None:
            about_origin += self.angular_impulses_nms
        return [*_rows(self.impulses_ns), *_rows(about_origin)]


_Energy = TypeVar("_Energy", float, FloatArray)


@dataclass(frozen=True, slots=True, eq=False)
class FrameWork(Generic[_Energy]):
    """Work in one frame, J. The solver's energy is given by cause, and in `made_j` by the body that got it."""

    gravity_j: _Energy
    loads_j: _Energy  # of blast and whatever else pushes bodies from outside
    tools_j: _Energy  # of bodies that move as animation says, such as a ball that is lifted
    damping_j: _Energy  # energy of translation taken away by Blender's damping
    dissipated_j: _Energy  # taken away between bodies: by impacts, friction, and connections that yield
    yielding_j: _Energy  # part of it by bars that yield across cracks; nan where it is not known
    crack_friction_j: _Energy  # part of it by sides of these cracks that slide on each other; nan as above
    made_by_connections_j: _Energy  # where stretched connections are pulled together
    made_by_contacts_j: _Energy  # where contacts are pushed apart
    made_by_lifting_j: _Energy  # where bodies move up without a velocity, as Bullet parts hulls that overlap
    made_j: FloatArray  # (n,)

    @classmethod
    def unknown(cls, *shape: int) -> FrameWork[Any]:
        """Return unknown work, nan throughout, on n bodies in one frame, or in frames (k, n)."""
        shapes = {item.name: shape[:-1] for item in fields(cls)} | {"made_j": shape}
        values: dict[str, Any] = {name: np.full(of_values, np.nan) for name, of_values in shapes.items()}
        return cls(**values)


class WorkAccumulator:
    """Adds up the work in a frame, some sub-steps at a time; how many makes no difference, to the last bit.

    Bodies that never move have mass 0. `linear_damping` and `angular_damping` (n,) are the shares of the velocities
    that Bullet takes away in a second; `start` is the motion (1, n, 3) at the beginning.
    """

    def __init__(
        self,
        masses_kg: FloatArray,
        linear_damping: FloatArray,
        angular_damping: FloatArray,
        gravity_m_s2: FloatArray,
        start: Motion,
    ):
        self._masses, self._gravity = masses_kg, gravity_m_s2
        self._left_per_second = 1.0 - np.stack((linear_damping, angular_damping))
        self._left: dict[float, FloatArray] = {}
        self._before = start
        self._stored_j: FloatArray | None = None
        self._touches = Touches()
        self._begin()

    def _begin(self) -> None:
        self._gravity_j = self._loads_j = self._tools_j = self._damping_j = self._dissipated_j = 0.0
        self._yielding_j = self._crack_friction_j = 0.0
        self._made_by = np.zeros(3)
        self._made_j = np.zeros(len(self._masses))

    def finish(self) -> FrameWork[float]:
        """Return the work of the frame; the next one begins."""
        by_connections_j, by_contacts_j, by_lifting_j = self._made_by.tolist()
        work = FrameWork(
            self._gravity_j,
            self._loads_j,
            self._tools_j,
            self._damping_j,
            self._dissipated_j,
            self._yielding_j,
            self._crack_friction_j,
            by_connections_j,
            by_contacts_j,
            by_lifting_j,
            self._made_j,
        )
        self._begin()
        return work

    def add_in_cracks(self, yielding_j: float, rubbing_j: float) -> None:
        """Add the work in a sub-step of bars across cracks that yielded, and of their sides that slid on each other.

        What connections take from their bodies has it already.
        """
        self._yielding_j += yielding_j
        self._crack_friction_j += rubbing_j

    def pass_over(self, after: Motion) -> None:
        """Leave out sub-steps at whose ends there is a motion."""
        self._touches.pass_over(len(after.centres_m))
        self._before = after

    def add(
        self,
        after: Motion,
        free: BoolArray,
        of_connections: PairImpulses,
        of_contacts: PairImpulses,
        resultants_ns: FloatArray,
        substeps_s: FloatArray,
    ) -> None:
        """Add some sub-steps, at whose ends bodies move as `after`.

        `free` (s, n): bodies that move freely in them. The others rest, or move as animation says. `resultants_ns` (s,
        n, 3) are the sums of the impulses between bodies.
        """
        whole, masses = after.from_(self._before), np.where(free, self._masses, 0.0)
        self._before = after
        if whole.rests():
            self._touches.pass_over(len(free))
            return
        before = whole.velocities_m_s[:-1]
        # Bullet damps velocities first, then adds gravity, loads and the solver's impulses.
        linear_left, angular_left = self._damping_leaves(substeps_s)
        damped = linear_left * before
        turning = angular_left * whole.angular_velocities_rad_s[:-1]
        mean = Motion(
            after.centres_m,
            0.5 * (damped + after.velocities_m_s),
            0.5 * (turning + after.angular_velocities_rad_s),
        )
        steps = substeps_s[:, None, None]
        momenta = masses[..., None] * (after.velocities_m_s - damped - steps * self._gravity)
        by_loads = dot(momenta - resultants_ns, mean.velocities_m_s)
        by_gravity = masses * dot(mean.velocities_m_s, self._gravity)
        by_damping = masses * (dot(before, before) - dot(damped, damped))
        works = [self._of_pairs(impulses, mean, free) for impulses in (of_connections, of_contacts)]
        if not len(of_contacts.pairs):
            self._touches.pass_over(len(free))
        lifting = self._of_lifting(whole, masses, steps)
        for substep, substep_s in enumerate(substeps_s.tolist()):
            self._loads_j += float(by_loads[substep][free[substep]].sum())
            self._gravity_j += substep_s * float(by_gravity[substep].sum())
            self._damping_j += 0.5 * float(by_damping[substep].sum())
            for cause, work in enumerate(works):
                self._dissipated_j -= work.taken_j[substep]
                self._tools_j = self._tools_j + work.tools_j[0][substep] + work.tools_j[1][substep]
                self._made_by[cause] += work.made_j[substep]
                for made_j in work.made_by_body_j:
                    self._made_j += made_j[substep]
            self._made_by[2] += float(lifting[substep].sum())
            self._made_j += lifting[substep]

    def _damping_leaves(self, substeps_s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the shares (s, n, 1) of velocities and of angular velocities that Bullet's damping leaves."""
        for substep_s in set(substeps_s.tolist()) - self._left.keys():
            self._left[substep_s] = power(self._left_per_second, substep_s)
        linear, angular = np.stack([self._left[substep_s] for substep_s in substeps_s.tolist()], axis=1)
        return linear[..., None], angular[..., None]

    def _of_pairs(self, between: PairImpulses, mean: Motion, free: BoolArray) -> PairWork:
        """Return the work between bodies, by their mean motion in each sub-step."""
        substeps = between.of_substeps(len(free))
        if not len(between.pairs):
            return PairWork.none(len(free))
        sums = PairSums(between.pairs, between.substeps, free.shape)
        first, second = sums.first, sums.second
        # The velocity of a point p of a body is v + ω × (p - c): of what it has at the origin and of ω.
        at_origin = mean.velocities_m_s - cross_by_component(mean.angular_velocities_rad_s, mean.centres_m)
        motion = _components(at_origin, mean.angular_velocities_rad_s)
        on_first, on_second = works_on_bodies(between, motion, first, second)
        if between.substeps is not None:
            first, second, on_first, on_second = _of_both_bodies(first, second, on_first, on_second)
        total = on_first - on_second
        if between.stored_j is not None:
            total = self._after_storing(total, between.stored_j)
        is_free, bodies, returned_j = free.ravel(), free.shape[1], np.zeros(0)
        ends = np.array([0, *(substep.stop for substep in substeps)])
        if between.substeps is not None:
            ends = np.searchsorted(first // bodies, np.arange(len(free) + 1))
            total[~(is_free[first] | is_free[second])] = 0.0
            lower, upper = np.minimum(first, second) % bodies, np.maximum(first, second) % bodies
            returned_j = self._touches.returned_energies(bodies * lower + upper, total, ends)
        shared = shared_work(total, returned_j, on_first, on_second, first, second, is_free)
        starts = np.searchsorted(shared.rows, ends)
        return PairWork(
            taken_j=[float(shared.taken_j[start:end].sum()) for start, end in itertools.pairwise(ends.tolist())],
            made_j=[float(shared.made_j[start:end].sum()) for start, end in itertools.pairwise(starts.tolist())],
            made_by_body_j=[made_j.reshape(free.shape) for made_j in (shared.by_first_j, shared.by_second_j)],
            tools_j=_of_tools(sums, between, motion, is_free, substeps),
        )

    def _after_storing(self, work_j: FloatArray, stored_j: FloatArray) -> FloatArray:
        """Return the rest of the work (s k,) of elastic connections after they have stored and given back theirs.

        Each has an account: of what it takes from its bodies it keeps as much as it can have stored (s, k), and what it
        gives back comes from there. More than that is made; what it cannot keep is dissipated.
        """
        if self._stored_j is None:
            self._stored_j = stored_j[0]
        left_over = np.empty_like(stored_j)
        for substep, work in enumerate(work_j.reshape(stored_j.shape)):
            offered = self._stored_j - work
            self._stored_j = np.clip(offered, 0.0, stored_j[substep])
            left_over[substep] = self._stored_j - offered
        return left_over.ravel()

    def _of_lifting(self, whole: Motion, masses: FloatArray, steps: FloatArray) -> FloatArray:
        """Return the energy (s, n) of bodies that Bullet moved up without a velocity: so it parts overlapping hulls."""
        pushed = whole.centres_m[1:] - whole.centres_m[:-1] - steps * whole.velocities_m_s[1:]
        return np.maximum(-masses * dot(pushed, self._gravity), 0.0)


@dataclass(frozen=True, slots=True, eq=False)
class PairWork:
    """Work between bodies in each of s sub-steps, J. First and second bodies of the pairs are apart."""

    taken_j: list[float]  # energy that is taken away, less what comes back of it, as a negative number
    made_j: list[float]
    made_by_body_j: list[FloatArray]  # (s, n) each
    tools_j: list[list[float]]  # work of bodies that are led

    @classmethod
    def none(cls, substeps: int) -> PairWork:
        """Return the work where there is nothing between bodies."""
        nothing = [0.0] * substeps
        return cls(nothing, nothing, [], [nothing] * 2)


def _of_tools(
    sums: PairSums, between: PairImpulses, motion: FloatArray, free: BoolArray, substeps: list[slice]
) -> list[list[float]]:
    """Return the work of bodies that move as animation says on those that move freely, from both sides."""
    led = ~free & motion.any(axis=0)
    if not led.any():
        return [[0.0] * len(substeps)] * 2
    loads, works = between.components(), []
    for sign, bodies, others in ((-1.0, sums.first, sums.second), (1.0, sums.second, sums.first)):
        acts = led[bodies] & free[others]
        works_j = []
        for substep in substeps:
            rows = substep.start + np.flatnonzero(acts[substep])
            work = _dot([load.take(rows) for load in loads], motion.take(bodies[rows], axis=1))
            works_j.append(sign * float(work.sum()))
        works.append(works_j)
    return works


class CoreWorks(Struct):
    """Impulses of pairs, and the motion of their bodies: `bda_works`."""

    _fields_ = (
        ("count", Count),
        ("bodies", Count),
        ("first", Indices),
        ("second", Indices),
        *((name, Doubles) for name in ("impulses", "points", "angular", "motion")),
        *((name, WrittenDoubles) for name in ("on_first", "on_second")),
    )


def works_on_bodies(
    between: PairImpulses, motion: FloatArray, first: IntArray, second: IntArray
) -> tuple[FloatArray, FloatArray]:
    """Return the work of impulses on first and on second bodies, rows (k,) of their motion (6, s n)."""
    count, bodies = len(first), motion.shape[1]
    on_first, on_second = np.empty((2, count))
    works = CoreWorks(count=count, bodies=bodies).take(
        first=(first, count),
        second=(second, count),
        impulses=(_rows(between.impulses_ns), 3 * count),
        points=(_rows(between.points_m), 3 * count),
        motion=(motion, 6 * bodies),
        on_first=(on_first, count),
        on_second=(on_second, count),
    )
    if between.angular_impulses_nms is not None:
        works.take(angular=(_rows(between.angular_impulses_nms), 3 * count))
    call("bda_find_works", works)
    return on_first, on_second


class CoreSharedWork(Struct):
    """Work between pairs by what it does: `bda_shared_work`."""

    _fields_ = (
        ("count", Count),
        ("bodies", Count),
        ("first", Indices),
        ("second", Indices),
        *((name, Doubles) for name in ("total", "on_first", "on_second", "returned")),
        ("is_free", Flags),
        ("taken", WrittenDoubles),
        ("rows", WrittenIndices),
        *((name, WrittenDoubles) for name in ("made", "by_first", "by_second")),
        ("makers", Count),
    )


@dataclass(frozen=True, slots=True, eq=False)
class SharedWork:
    """Work of k pairs in all of s sub-steps, J: what is taken, and what is made, by the bodies that get it."""

    taken_j: FloatArray  # (k,), less what comes back of it, as negative numbers
    rows: IntArray  # (r,), pairs that make energy
    made_j: FloatArray  # (r,)
    by_first_j: FloatArray  # (s n,), of it, by first bodies
    by_second_j: FloatArray


def shared_work(
    total: FloatArray,
    returned_j: FloatArray,
    on_first: FloatArray,
    on_second: FloatArray,
    first: IntArray,
    second: IntArray,
    is_free: BoolArray,
) -> SharedWork:
    """Return the works (k,) of pairs of bodies, rows of `is_free` (s n,), by what they do; (0,) where none is returned.

    Pairs of bodies that are both led do no work that counts.
    """
    count, bodies = len(total), len(is_free)
    taken, made, rows = np.empty(count), np.empty(count), np.empty(count, int)
    by_first, by_second = np.zeros((2, bodies))
    work = CoreSharedWork(count=count, bodies=bodies).take(
        first=(first, count),
        second=(second, count),
        total=(total, count),
        on_first=(on_first, count),
        on_second=(on_second, count),
        is_free=(is_free, bodies),
        taken=(taken, count),
        rows=(rows, count),
        made=(made, count),
        by_first=(by_first, bodies),
        by_second=(by_second, bodies),
    )
    if len(returned_j):
        work.take(returned=(returned_j, count))
    call("bda_share_work", work)
    return SharedWork(taken, rows[: work.makers], made[: work.makers], by_first, by_second)


def _of_both_bodies(
    first: IntArray, second: IntArray, on_first: FloatArray, on_second: FloatArray
) -> tuple[IntArray, IntArray, FloatArray, FloatArray]:
    """Return the work on two bodies (p,) that touch, of that at all points (k,) where they do.

    How the solver shares an impulse out to points says nothing: what rocks gains at one of them and loses at others.
    """
    is_other = (first[1:] != first[:-1]) | (second[1:] != second[:-1])
    starts = np.concatenate(([0], 1 + np.flatnonzero(is_other)))
    return first[starts], second[starts], np.add.reduceat(on_first, starts), np.add.reduceat(on_second, starts)


def _components(*vectors: FloatArray) -> FloatArray:
    """Components (c, k) of vectors (..., 3), one after the other."""
    return np.concatenate([_rows(vector) for vector in vectors])


def _rows(vectors: FloatArray) -> FloatArray:
    """Components (3, k) of vectors (..., 3)."""
    return as_components(vectors).reshape(3, -1)


def _dot(first: Sequence[FloatArray], second: Sequence[FloatArray]) -> FloatArray:
    """Products (k,) of vectors given by components (c, k)."""
    total = first[0] * second[0]
    added = np.empty_like(total)
    for one, other in zip(first[1:], second[1:], strict=True):
        np.multiply(one, other, out=added)
        total += added
    return total


def _joined(first: FloatArray, second: FloatArray) -> FloatArray:
    """Vectors (s, n, 3) of earlier and later sub-steps, whose components each lie together in memory."""
    return as_vectors(np.concatenate([as_components(vectors) for vectors in (first, second)], axis=1))
