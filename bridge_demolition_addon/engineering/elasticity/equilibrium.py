"""The elastic structure at rest: its deformation under its own weight, and its first frequency about that."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..geometry.vectors import rotated
from .bearings import Bearings
from .equations import (
    SLACK,
    BlockSystem,
    RigidBodies,
    connected_parts,
    first_frequency,
    spring_forces,
    stiffness_blocks,
    summed_on_bodies,
    without,
)
from .joint_rows import JointFrames, JointRows, components_first, components_last, joint_positions
from .tendons import TendonForces

_LARGEST_M = 0.5
"""Largest deformation; beyond it there is no equilibrium near the shape in which the part was built."""

_LARGEST_TURN = 0.2
"""The same for rotations on bearings, rad: what topples may stand again on another side."""

_SOLUTIONS = 8
"""Linear solutions, one after another, each of which corrects the turning of the last: two or three are enough."""

_AT_REST = 1e-9
"""Unbalanced load, as a share of the largest weight, at which the structure rests."""

_TAKEN_FOR_REST = 1e-3
"""Unbalanced load, as that share, up to which they are taken for enough."""

_SETTLES = 0.5
"""Part of the unbalanced load that a solution leaves as long as they settle. Where bars are about to buckle or twist,
later ones leave ever more: forces then change the stiffness by as much as there is, which the equations do not know."""

_SOLUTIONS_ON_BEARINGS = 60
_AT_REST_ON_BEARINGS = 1e-7
"""The same with bearings, which lift off and slide: their springs are so stiff that rounding leaves more."""

_ROUNDINGS = 4.0
"""Steps between numbers as large as the positions, below which a correction on bearings is rounding: where connections
are stiffer still than bearings, as between thin shards, it leaves more load than the share above."""

_HALVINGS = 40
"""How often the share of a step is halved at most: what slides may move by metres in one that is 0.1 µm too long."""

_WHOLE_CHANGES = 20
"""How often friction takes over all of the pressing force."""

_WORK_LEFT = 0.1
"""Part of the work at the beginning of a step that may be left where it ends."""


@dataclass(frozen=True, slots=True, eq=False)
class Equilibrium:
    """n bodies at rest."""

    positions_m: FloatArray  # (3, n), as before for bodies that nothing holds
    rotations: FloatArray  # (3, 3, n)
    held: BoolArray  # (n,), whether connections to a support hold a body
    frequency_hz: float  # lowest first frequency of the held parts; 0 where nothing is held
    loads: FloatArray  # (6, m), forces and moments in the connections' rows, pulling the first body to the second


def equilibrium(
    frames: JointFrames,
    stiffness: FloatArray,
    bodies: RigidBodies,
    gravity_m_s2: FloatArray,
    loads: FloatArray | None = None,
    bearings: Bearings | None = None,
    tendons: TendonForces | None = None,
) -> Equilibrium:
    """Return where bodies rest that elastic connections hold, which carry no load where they are now.

    `stiffness` (6, 6, m) is as in `ElasticStructure`; `loads` (6, n) are further forces on the bodies, N, and
    moments about their centres, N·m. Of connections that are bearings the stiffness does not count, and their loads are
    forces along the axes of the world, and moments about the middles of their springs. Tendons go with the bodies.
    """
    if bearings is not None:
        stiffness = without(stiffness, bearings.rows)
    unloaded = joint_positions(frames, bodies.positions_m, bodies.rotations).deformations()
    positions_m, rotations = bodies.positions_m.copy(), bodies.rotations.copy()
    held, frequencies = np.zeros(len(bodies), bool), []
    parts = _supported_parts(bodies.moves, frames, np.arange(len(frames)))
    while parts:
        members, rows = parts.pop(0)
        started = replace(bodies, positions_m=positions_m, rotations=rotations)
        pads = None if bearings is None else _PartOnBearings(bearings, rows)
        rest = _part_at_rest(
            members, frames.only(rows), stiffness[..., rows], started, gravity_m_s2, loads, pads, tendons
        )
        if rest:
            held[members] = True
            positions, turned, frequency = rest
            positions_m[:, members], rotations[..., members] = positions[:, members], turned[..., members]
            frequencies.append(frequency)
        elif bearings is not None and (is_bearing := np.isin(rows, bearings.rows)).any():
            # What topples off its bearings leaves standing what they stood on.
            parts += _supported_parts(bodies.moves, frames, rows[~is_bearing])
    loads = spring_forces(stiffness, joint_positions(frames, positions_m, rotations).deformations() - unloaded)
    if bearings is not None:
        loads[:, bearings.rows] = bearings.loads_at_rest(positions_m, rotations)
    return Equilibrium(positions_m, rotations, held, min(frequencies, default=0.0), loads)


def _supported_parts(moves: BoolArray, frames: JointFrames, rows: IntArray) -> list[tuple[IntArray, IntArray]]:
    """Return bodies and connections of each part that connections (r,) hold to a body that does not move."""
    ends = np.stack((frames.first[rows], frames.second[rows]))
    label = connected_parts(moves, *ends)
    supported = np.unique(label[ends][:, ~moves[ends].all(axis=0)])
    of_connections = label[ends].max(axis=0, initial=-1)
    parts = supported[supported >= 0].tolist()
    return [(np.flatnonzero(label == part), rows[of_connections == part]) for part in parts]


class _ConnectedComponent:
    """Connected bodies `members` (b,), held by connections `rows` of all, on which weight and loads (6, n) act."""

    def __init__(
        self,
        members: IntArray,
        frames: JointFrames,
        stiffness: FloatArray,
        bodies: RigidBodies,
        weights: FloatArray,
        pads: _PartOnBearings | None,
        tendons: TendonForces | None,
    ):
        self._members, self._frames, self._stiffness = members, frames, stiffness
        self._bodies, self._weights, self._pads, self._tendons = bodies, weights, pads, tendons
        self._unloaded = joint_positions(frames, bodies.positions_m, bodies.rotations).deformations()
        unknown = np.full(len(bodies), -1)
        unknown[members] = np.arange(len(members))
        self._rows = JointRows.empty(0)
        self.system = BlockSystem(len(members), unknown[frames.first], unknown[frames.second])

    def unbalanced(self, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
        """Return the forces and moments (6, b) that are left on the bodies at these positions."""
        positions = joint_positions(self._frames, positions_m, rotations)
        self._rows = positions.rows()
        holding = self._rows.loads(spring_forces(self._stiffness, positions.deformations() - self._unloaded))
        if self._pads is not None:
            self._pads.add_loads(holding, positions_m, rotations)
        on_bodies = summed_on_bodies(self._frames.first, self._frames.second, holding, len(self._bodies))
        if self._tendons is not None:
            on_bodies = on_bodies + self._tendons.loads(positions_m, rotations)
        left: FloatArray = (self._weights + on_bodies)[:, self._members]
        return left

    def factor(self, own: FloatArray, positions_m: FloatArray, rotations: FloatArray) -> None:
        """Make the equations where forces were balanced last, with an addition (6, 6, b) for each body."""
        blocks = stiffness_blocks(self._rows, self._stiffness)
        if self._pads is not None:
            self._pads.add_blocks(blocks, positions_m, rotations)
        self.system.assemble(own, np.arange(len(self._frames)), *blocks)
        self.system.factor()


class _PartOnBearings:
    """Bearings among the connections (r,) of a part, in ascending order.

    At first none of them has lifted off or slides. Friction counts by the pressing force of `follow`, which does not
    change while forces are balanced with it. After some changes it goes half of the way only, so that it settles.
    """

    def __init__(self, bearings: Bearings, rows: IntArray):
        self._bearings, self._rows = bearings, rows
        self._pressed_n: FloatArray | None = None
        self._changes = 0

    def follow(self, positions_m: FloatArray, rotations: FloatArray) -> None:
        """Let pads lift off and slide, by the pressing forces at these positions."""
        pressed_n = self._bearings.pressed_at(positions_m, rotations)
        if self._pressed_n is not None and self._changes > _WHOLE_CHANGES:
            pressed_n = 0.5 * (self._pressed_n + pressed_n)
        self._pressed_n = pressed_n
        self._changes += 1

    def add_loads(self, loads: tuple[FloatArray, FloatArray], positions_m: FloatArray, rotations: FloatArray) -> None:
        """Add the forces of pads to those (6, r) on first and second bodies."""
        self._bearings.add_loads(loads, self._rows, positions_m, rotations, self._pressed_n)

    def add_blocks(self, blocks: Sequence[FloatArray], positions_m: FloatArray, rotations: FloatArray) -> None:
        """Add the stiffness of pads to the blocks (6, 6, r) of connections."""
        self._bearings.add_stiffness(blocks, self._rows, positions_m, rotations, self._pressed_n)


def _part_at_rest(
    members: IntArray,
    frames: JointFrames,
    stiffness: FloatArray,
    bodies: RigidBodies,
    gravity_m_s2: FloatArray,
    loads: FloatArray | None,
    pads: _PartOnBearings | None,
    tendons: TendonForces | None,
) -> tuple[FloatArray, FloatArray, float] | None:
    """Positions, rotations and first frequency of connected bodies (b,) at rest; None for a mechanism."""
    count, positions_m, rotations = len(bodies), bodies.positions_m, bodies.rotations
    weights = np.zeros((6, count))
    weights[:3, members] = bodies.masses_kg[members] * gravity_m_s2[:, None]
    if loads is not None:
        weights[:, members] += loads[:, members]
    part = _ConnectedComponent(members, frames, stiffness, bodies, weights, pads, tendons)
    solutions, balanced = (_SOLUTIONS, _AT_REST) if pads is None else (_SOLUTIONS_ON_BEARINGS, _AT_REST_ON_BEARINGS)
    settled = _Settled()
    for _ in range(solutions):
        own = bodies.mass_matrices(rotations, members)
        left = part.unbalanced(positions_m, rotations)
        part.factor(SLACK * own, positions_m, rotations)
        if abs(left[:3]).max() <= balanced * abs(weights).max():
            break
        settled.follow(float(abs(left[:3]).max()), positions_m, rotations)
        moved = np.zeros((6, count))
        moved[:, members] = part.system.solve(left)
        if pads is not None and abs(moved[:3]).max() <= _ROUNDINGS * np.spacing(abs(positions_m).max()):
            break
        if pads is not None:
            moved *= _share_of_step(part, positions_m, rotations, moved, members)
        if not abs(moved[:3]).max() <= _LARGEST_M:
            return None
        positions_m, rotations = _moved(positions_m, rotations, moved)
        if pads is not None:
            moved_m, turned = positions_m - bodies.positions_m, rotations - bodies.rotations
            if not (abs(moved_m).max() <= _LARGEST_M and abs(turned).max() <= _LARGEST_TURN):
                return None
            pads.follow(positions_m, rotations)
    else:
        if pads is not None:  # it rocks or slides, and comes to no rest
            return None
        left_n = float(abs(part.unbalanced(positions_m, rotations)[:3]).max())
        if left_n > max(_TAKEN_FOR_REST * abs(weights).max(), settled.least_n):
            positions_m, rotations = settled.positions_m, settled.rotations
            own = bodies.mass_matrices(rotations, members)
            part.unbalanced(positions_m, rotations)
            part.factor(SLACK * own, positions_m, rotations)
    return positions_m, rotations, first_frequency(part.system, own)


class _Settled:
    """The last of solutions, one after another, up to which they settled."""

    def __init__(self) -> None:
        self.positions_m, self.rotations = np.zeros((3, 0)), np.zeros((3, 3, 0))
        self.least_n, self._solutions, self._settle = math.inf, 0, True

    def follow(self, left_n: float, positions_m: FloatArray, rotations: FloatArray) -> None:
        """Take over a solution that leaves so much unbalanced.

        The first of all, from the unloaded shape, may leave any: what turns stretches then.
        """
        self._settle = self._settle and (self._solutions <= 1 or left_n <= _SETTLES * self.least_n)
        if self._settle:
            self.positions_m, self.rotations, self.least_n = positions_m, rotations, left_n
        self._solutions += 1


def _moved(positions_m: FloatArray, rotations: FloatArray, step: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Positions and rotations after a step (6, n)."""
    return positions_m + step[:3], components_first(rotated(components_last(rotations), components_last(step[3:])))


def _share_of_step(
    part: _ConnectedComponent, positions_m: FloatArray, rotations: FloatArray, step: FloatArray, members: IntArray
) -> float:
    """Return the share of a step (6, n) up to which the forces that are left do work: beyond it energy grows again.

    Of what falls it is so much that this is seen.
    """

    def work(share: float) -> float:
        left = part.unbalanced(*_moved(positions_m, rotations, share * step))
        return float((left * step[:, members]).sum())

    slack = _WORK_LEFT * work(0.0)
    whole = 1.0 / max(1.0, float(abs(step[:3]).max()) / (2.0 * _LARGEST_M), float(abs(step[3:]).max()))
    low, high, share = 0.0, whole, whole
    for _ in range(_HALVINGS):
        done = work(share)
        if abs(done) <= slack or (share == whole and done > 0.0):
            break
        low, high = (share, high) if done > 0.0 else (low, share)
        share = 0.5 * (low + high)
    return share
