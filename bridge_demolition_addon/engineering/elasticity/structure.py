"""The elastic structure: bodies of known mass, held together by elastic connections, and how they share loads.

A sub-step is solved implicitly (backward Euler): the forces of connections are those at its end, so that no stiffness
is too large for it. With the velocities v that bodies would have without connections, stiffness K, damping C, rows J
and deformations e at its beginning, the velocities v' at its end follow from

    (M + Jᵀ dt (dt K + C) J) (v' - v) = Jᵀ g,    g = dt K e - dt (dt K + C) J v,

and the impulses of the connections are g - dt (dt K + C) J (v' - v). D. Baraff and A. Witkin (1998), Large steps in
cloth simulation, SIGGRAPH 98, equation 6, for springs in general; here C = β K.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray, same
from .bearings import Bearings
from .crack_state import CrackState
from .cracks import Cracks
from .equations import SLACK, BlockSystem, RigidBodies, connected_parts, first_frequency, stiffness_blocks, without
from .joint_rows import JointFrames, joint_positions
from .kept_joints import KeptJoints
from .substep import CRACKS, Places, Substep, Term


@dataclass(frozen=True, slots=True, eq=False)
class StepInput:
    """Positions of n bodies before a sub-step, and their motion in it without connections."""

    positions_m: FloatArray  # (3, n), centres of mass
    rotations: FloatArray  # (3, 3, n)
    velocities: FloatArray  # (6, n), m/s and rad/s, at its end without connections
    asleep: BoolArray  # (n,)


@dataclass(frozen=True, slots=True, eq=False)
class ElasticStep:
    """Effects of k elastic connections in a sub-step; the others are broken, or asleep.

    Impulses are on the first and on the second bodies, and about their centres.
    """

    acting: IntArray  # (k,), which connections
    rates: FloatArray  # (6, k), how fast they shrink in it, m/s and rad/s
    of_first: FloatArray  # (6, k), impulses
    of_second: FloatArray
    cracks: IntArray  # (c,), broken connections in whose place reinforcement acts
    of_cracks_on_first: FloatArray  # (6, c), its impulses
    of_cracks_on_second: FloatArray
    of_bodies: FloatArray  # (6, n), the sum on every body
    velocities: FloatArray  # (6, n), at its end
    crack_term: Term | None  # the cracks as they were solved; None where there is none


class SpringLaw(Protocol):
    """Springs of footings or bearings in place of some connections, whose own stiffness does not count."""

    @property
    def rows(self) -> IntArray:
        """Their numbers (c,) among connections."""

    def update_plastic_state(self, positions_m: FloatArray, rotations: FloatArray) -> None:
        """Update before a sub-step what has yielded for good, at positions (3, n) and rotations (3, 3, n)."""

    @property
    def remembered(self) -> FloatArray:
        """What the core knows of the last sub-step (12, p); another array where there are others."""

    def term(self, chosen: IntArray) -> Term:
        """Return what some of them (c,) do, as long as there are the same."""


class StoringLaw(SpringLaw, Protocol):
    """Springs whose energy is counted."""

    def stored_j(self, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
        """Return the energy (c,) that they would give back."""


class BareBarLaw(SpringLaw, Protocol):
    """Bars that stand bare between bodies, beside all connections: their rows are numbered from these on."""

    @property
    def ends(self) -> tuple[IntArray, IntArray]:
        """First and second bodies (g,)."""

    @property
    def holds(self) -> BoolArray:
        """Which of them (g,) hold."""

    def let_go(self, bodies: IntArray) -> None:
        """Let go of all bars that end in some bodies (b,)."""

    def forces_n(self, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
        """Return the forces (g,) along them, above 0 in tension, with bodies at positions and in rotations."""


class _ConnectedComponent:
    """Bodies that connections hold together, and their equations."""

    def __init__(self, bodies: IntArray, connections: IntArray, first: IntArray, second: IntArray):
        self.bodies, self.connections = bodies, connections
        self.first, self.second = first, second
        self.has_lost = False  # a connection, and its first frequency was not asked for since
        self._system: BlockSystem | None = None

    def is_of(self, bodies: IntArray, connections: IntArray) -> bool:
        """Whether these are its bodies and connections."""
        return np.array_equal(bodies, self.bodies) and np.array_equal(connections, self.connections)

    @property
    def system(self) -> BlockSystem:
        """The equations, laid out when they are first needed."""
        if self._system is None:
            self._system = BlockSystem(len(self.bodies), self.first, self.second)
        return self._system


class ElasticStructure:
    """Bodies with elastic connections between them.

    `stiffness` (6, 6, m) is against shifts, N/m, and then turns, N·m/rad, in the axes of the first frames;
    `damping_s` (m,) is damping over stiffness, β, or one for all. What rounding leaves of deformations where the
    `bodies` are counts as none. `from_rest`: steps do not follow one another in time, and none begins with the
    motion of the last.
    """

    def __init__(
        self,
        frames: JointFrames,
        stiffness: FloatArray,
        bodies: RigidBodies,
        damping_s: FloatArray | float,
        cracks: Cracks | None = None,
        soil: StoringLaw | None = None,
        bearings: Bearings | None = None,
        *,
        from_rest: bool = False,
    ):
        self._bare_bars: BareBarLaw | None = None
        self._frames, self._bodies = frames, bodies
        self._damping_s = np.broadcast_to(np.asarray(damping_s, float), len(frames)).copy()
        self._springs = [springs for springs in (soil, bearings) if springs is not None]
        self._bearings = bearings
        self._with_soil = stiffness if bearings is None else without(stiffness, bearings.rows)
        for springs in self._springs:
            stiffness = without(stiffness, springs.rows)
        self._count, self._moves = len(bodies), bodies.moves
        positions = joint_positions(frames, bodies.positions_m, bodies.rotations)
        self._joints = KeptJoints(frames, self._count, stiffness, positions.deformations())
        self.solved = Substep()
        self.solved.from_rest = int(from_rest)
        self.deformations = np.zeros((6, len(frames)))
        for name, array, size in (
            ("masses", np.ascontiguousarray(bodies.masses_kg, float), self._count),
            ("inertias", np.ascontiguousarray(bodies.inertias_kg_m2), 9 * self._count),
            ("stiffness", self._joints.stiffness, 36 * len(frames)),
            ("offsets", self._joints.offsets, 6 * len(frames)),
            ("rows", np.zeros((len(frames), 36)), 36 * len(frames)),
            ("deformations", self.deformations, 6 * len(frames)),
        ):
            self.solved.point(name, array, size)
        self._intact = np.ones(len(frames), bool)
        self._substep_s = 0.0
        self._cracks, self._has_broken = cracks, False
        self._terms: dict[int, Term] = {}  # of laws, as they were last
        self._acting_terms: list[Term] = []
        self._remembered: list[tuple[Cracks | SpringLaw, FloatArray]] = []
        self._awake: BoolArray = np.zeros(0, bool)
        self._step: ElasticStep | None = None  # what acts, as long as it is the same
        self._parts: list[_ConnectedComponent] = []
        self._part_of_body = np.full(self._count, -1)
        self._partition()
        for part in self._parts:
            part.has_lost = False

    def damp(self, damping_s: FloatArray) -> None:
        """Take over damping over stiffness, β (m,), from the next sub-step on."""
        changed = np.flatnonzero(damping_s != self._damping_s)
        self._damping_s = damping_s
        self._stale[self.part_of_connection[changed]] = True
        self._stale[-1] = False

    def frequencies_after_breaks(self, positions_m: FloatArray, rotations: FloatArray) -> list[tuple[IntArray, float]]:
        """Return connections and first frequency in Hz of each part that has lost connections since this was asked.

        Bodies are at positions (3, n) in rotations (3, 3, n). Parts without a support are left out, and those with
        cracks that reinforcement holds: it yields, and has no frequency.
        """
        found = []
        for number, part in enumerate(self._parts):
            if not part.has_lost:
                continue
            part.has_lost = False
            if (part.connections >= len(self._frames)).any():
                continue  # bars that stand bare yield or fold, and have no frequency
            ends = self._frames.first[part.connections], self._frames.second[part.connections]
            is_cracked = not self._intact[part.connections].all()
            if is_cracked or self._moves[np.concatenate(ends)].all():
                continue
            rows = joint_positions(self._frames.only(part.connections), positions_m, rotations).rows()
            own = self._bodies.mass_matrices(rotations, part.bodies)
            blocks = stiffness_blocks(rows, self._with_soil[..., part.connections])
            if self._bearings is not None:  # neither lifted off nor sliding, as at first
                self._bearings.add_stiffness(blocks, part.connections, positions_m, rotations, None)
            part.system.assemble(SLACK * own, np.arange(len(part.connections)), *blocks)
            part.system.factor()
            self._stale[number] = True
            found.append((part.connections, first_frequency(part.system, own)))
        return found

    def step(self, start: StepInput, intact: BoolArray, substep_s: float) -> ElasticStep:
        """Return what connections do in a sub-step of a length in s, of those (m,) that are intact."""
        if start.positions_m.shape[1] != self._count:
            raise ValueError(f"there are positions of {start.positions_m.shape[1]} bodies: expected {self._count}")
        self._follow_breaks(intact)
        self.begin_substep(substep_s)
        step = self.acting_with(start.asleep)
        self.stand(Places.of(start.positions_m, start.rotations), np.ascontiguousarray(start.velocities))
        self.solved.solve()
        return step

    def stand(self, places: Places, velocities: FloatArray) -> None:
        """Take over where bodies are, and their velocities (6, n) at the end of a sub-step without connections."""
        self.solved.stand(self._joints.core_frames, places)
        self.solved.point("velocities", velocities, 6 * self._count)

    def choose(self, intact: BoolArray, asleep: BoolArray) -> ElasticStep:
        """Return the effects of what acts where some connections (m,) are intact, and some bodies (n,) asleep."""
        self._follow_breaks(intact)
        return self.acting_with(asleep)

    @property
    def is_current(self) -> bool:
        """Whether all acts that was chosen, as far as it does not change by itself in a sub-step."""
        return self._step is not None and all(law.remembered is known for law, known in self._remembered)

    @property
    def intact(self) -> BoolArray:
        """Connections (m,) that were intact when this was chosen."""
        return self._intact

    @property
    def awake(self) -> BoolArray:
        """Which parts (p + 1,) were awake when this was chosen."""
        return self._awake

    @property
    def has_lost(self) -> bool:
        """Whether a part has lost a connection since its frequency was asked for."""
        return any(part.has_lost for part in self._parts)

    def begin_substep(self, substep_s: float) -> None:
        """Take over the length of a sub-step."""
        if substep_s != self._substep_s:
            self._substep_s = self.solved.substep_s = substep_s
            self._stale[:-1] = True
        self.solved.point("damping_s", self._damping_s, len(self._frames))

    def acting_with(self, asleep: BoolArray) -> ElasticStep:
        """Return the effects of what acts while some bodies (n,) are asleep, which each sub-step writes again.

        They are the same as long as nothing else acts.
        """
        awake = self._awake_parts(asleep)
        if self._step is None or not self.is_current or not same(awake, self._awake):
            self._awake = awake
            self._step = self._chosen(awake)
        return self._step

    def _chosen(self, awake: BoolArray) -> ElasticStep:
        """Choose what acts while some parts (p + 1,) are awake."""
        are_awake = awake[self.part_of_connection]
        acts = self._intact & are_awake[: len(self._frames)]
        numbers = np.flatnonzero(acts)
        laws = (self._cracks, are_awake), *((law, acts) for law in self._springs), (self._bare_bars, are_awake)
        terms = [self._acting_term(law, of_law) for law, of_law in laws if law is not None]
        self._remembered = [(law, law.remembered) for law, _ in laws if law is not None]
        self._acting_terms = [term for term in terms if term is not None]
        cracks = next((term for term in self._acting_terms if term.kind == CRACKS), None)
        acting, bodies = len(numbers), self._count
        of_cracks = cracks.impulses if cracks is not None else (np.zeros((6, 0)), np.zeros((6, 0)))
        step = ElasticStep(
            acting=numbers,
            rates=np.empty((6, acting)),
            of_first=np.empty((6, acting)),
            of_second=np.empty((6, acting)),
            cracks=np.zeros(0, int) if cracks is None else cracks.rows,
            of_cracks_on_first=of_cracks[0],
            of_cracks_on_second=of_cracks[1],
            of_bodies=np.empty((6, bodies)),
            velocities=np.empty((6, bodies)),
            crack_term=cracks,
        )
        solved = self.solved
        solved.acting_count = acting
        solved.point("equations", self._equations_of(awake), len(self._parts))
        solved.point("awake", awake, len(awake))
        solved.point("acting", numbers, acting)
        for name in ("rates", "of_first", "of_second", "of_bodies"):
            solved.point(name, getattr(step, name), getattr(step, name).size)
        solved.point("ends", step.velocities, 6 * bodies)
        solved.act(self._acting_terms)
        return step

    def _equations_of(self, awake: BoolArray) -> IntArray:
        """Return where the core has the equations of each part (p,) that is awake, and 0 for the others."""
        for number in np.flatnonzero(awake[:-1] & (self._addresses == 0)).tolist():
            self._addresses[number] = self._parts[number].system.address
        return self._addresses

    def crack_state(self, positions_m: FloatArray, rotations: FloatArray) -> CrackState | None:
        """Return the state of cracks that reinforcement holds, after a sub-step; None without any."""
        return self._cracks.state(positions_m, rotations) if self._cracks is not None and len(self._cracks) else None

    def stored_j(self, positions_m: FloatArray, rotations: FloatArray, cracks: CrackState | None = None) -> FloatArray:
        """Return the energy (m,) in connections, and in cracks in this state.

        Bodies are at positions (3, n) in rotations (3, 3, n).
        """
        stored_j = self._joints.stored_j(np.flatnonzero(self._intact), positions_m, rotations)
        if cracks is not None:
            stored_j[cracks.rows] = cracks.stored_j
        for law in self._springs:
            stored_j[law.rows] = law.stored_j(positions_m, rotations) * self._intact[law.rows]
        return stored_j

    def update_plastic_state(self, positions_m: FloatArray, rotations: FloatArray) -> IntArray:
        """Take over, before a sub-step, how far springs and bars have yielded; return what ruptured (d,), let go."""
        for law in self._springs:
            law.update_plastic_state(positions_m, rotations)
        if self._bare_bars is not None:
            self._bare_bars.update_plastic_state(positions_m, rotations)
        if self._cracks is None or not len(self._cracks):
            return np.zeros(0, int)
        return self._forget(self._cracks.update_plastic_state(positions_m, rotations))

    def forget(self, holds: BoolArray) -> IntArray:
        """Let go of the cracks that no bar holds, of all (t,); return which connections these were in place of (d,)."""
        assert self._cracks is not None
        return self._forget(self._cracks.keep(holds))

    def _forget(self, gone: IntArray) -> IntArray:
        if len(gone):
            self._stale[self.part_of_connection[gone]] = True
            self._stale[-1] = False
            self._has_broken = True
        return gone

    def stand_bare(self, bars: BareBarLaw) -> None:
        """Take over bars that stand bare, before a sub-step; again where there are more."""
        self._bare_bars = bars
        self._partition()

    def end_substep(self) -> None:
        """Find the parts again, if a connection broke since this was done last."""
        if self._has_broken:
            self._partition()

    def _partition(self) -> None:
        """Find the parts, and leave out bodies that never move."""
        holds = self._intact.copy()
        if self._cracks is not None:
            holds[self._cracks.rows] = True
        kept = np.flatnonzero(holds)
        first, second = self._frames.first[kept], self._frames.second[kept]
        count = len(self._frames)
        if self._bare_bars is not None:
            count += len(self._bare_bars.rows)
            kept = np.concatenate((kept, self._bare_bars.rows))
            first, second = (np.concatenate(pair) for pair in zip((first, second), self._bare_bars.ends, strict=True))
        label = connected_parts(self._moves, first, second)
        part_of_connection = np.where(self._moves[first], label[first], label[second])
        numbers = np.unique(part_of_connection)
        parts, numbers_before = self._parts, self._part_of_body
        self._part_of_body = np.full(self._count, -1)
        self.part_of_connection = np.full(count, -1)  # (m + g,); -1 stays for connections that had broken
        self._parts = []
        within = np.full(self._count, -1)
        of_bodies, of_connections = _grouped(label, numbers), _grouped(part_of_connection, numbers)
        for number, (bodies, rows) in enumerate(zip(of_bodies, of_connections, strict=True)):
            connections = kept[rows]
            within[bodies] = np.arange(len(bodies))
            self._part_of_body[bodies] = number
            self.part_of_connection[connections] = number
            before = numbers_before[bodies[0]]
            if before >= 0 and parts[before].is_of(bodies, connections):
                self._parts.append(parts[before])  # with its equations laid out
            else:
                ends = within[first[rows]], within[second[rows]]
                self._parts.append(_ConnectedComponent(bodies, connections, *ends))
                self._parts[-1].has_lost = True
            within[bodies] = -1
        # One more, the last, for what belongs to no part: -1.
        self._stale = np.append(np.ones(len(self._parts), bool), False)
        self._step, self.parts = None, self.part_of_connection[: len(self._frames)]
        self._addresses = np.zeros(len(self._parts), int)
        self._has_broken = False
        within_part = np.full(count, -1)
        for part in self._parts:
            within_part[part.connections] = np.arange(len(part.connections))
        solved = self.solved
        solved.parts, solved.bars = len(self._parts), count - len(self._frames)
        starts = np.cumsum([0, *(len(part.bodies) for part in self._parts)])
        bodies = np.concatenate([np.zeros(0, int), *(part.bodies for part in self._parts)])
        solved.point("part_starts", starts, len(self._parts) + 1)
        solved.point("part_bodies", bodies, len(bodies))
        solved.point("part_of_body", self._part_of_body, self._count)
        solved.point("part_of_connection", self.part_of_connection, count)
        solved.point("within_part", within_part, count)
        solved.point("stale", self._stale, len(self._stale))
        solved.point("assembled_rotations", np.full((3, 3, self._count), np.inf), 9 * self._count)

    def _follow_breaks(self, intact: BoolArray) -> None:
        broken = self._intact & ~intact
        if broken.any():
            self._intact, self._step = intact.copy(), None
            self._stale[self.part_of_connection[np.flatnonzero(broken)]] = True
            self._stale[-1] = False
            self._has_broken = True

    def _awake_parts(self, asleep: BoolArray) -> BoolArray:
        """Whether a body of each part (p + 1,) is awake."""
        mine = self._part_of_body >= 0
        awake = np.zeros(len(self._stale), bool)
        awake[self._part_of_body[mine & ~asleep]] = True
        return awake

    def _acting_term(self, law: Cracks | SpringLaw, acts: BoolArray) -> Term | None:
        """Cracks that reinforcement holds, or springs, of connections that act (m,); None where there is none."""
        chosen = np.flatnonzero(acts[law.rows])
        if not len(chosen):
            return None
        term = self._terms.get(id(law))
        if term is None or not term.is_of(chosen, law.remembered):
            self._terms[id(law)] = term = law.term(chosen)
        return term


def _grouped(labels: IntArray, numbers: IntArray) -> list[IntArray]:
    """Rows of labels (n,) that are equal to each of some ascending numbers."""
    order = np.argsort(labels, kind="stable")
    starts, ends = (np.searchsorted(labels[order], numbers, side) for side in ("left", "right"))
    return [order[start:end] for start, end in zip(starts.tolist(), ends.tolist(), strict=True)]
