"""The elastic structure at rest: its deformation under its own weight, and its first frequency about that."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..geometry.rotations import rotated
from .bearings import Bearings, PadsAtRest
from .equations import RigidBodies, connected_parts, stiffness_blocks, stressed, summed_on_bodies, without
from .joint_rows import JointFrames, components_first, components_last, joint_positions
from .sparse_system import BlockSystem

_SLOWEST_S = 60.0
"""Longest period of a part that is held; slower ones are mechanisms, or have no support."""

_LARGEST_M = 0.5
"""Largest deformation; beyond it there is no equilibrium near the shape in which the part was built."""

_SOLUTIONS = 8
"""Linear solutions, one after another, each of which corrects the turning of the last: two or three are enough."""

_AT_REST = 1e-9
"""Unbalanced load, as a share of the largest weight, at which the structure rests."""

_SOLUTIONS_ON_BEARINGS = 60
_AT_REST_ON_BEARINGS = 1e-7
"""The same with bearings, which lift off and slide: their springs are so stiff that rounding leaves more."""

_ITERATIONS = 60
_SAME_FREQUENCY = 1e-6


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
) -> Equilibrium:
    """Return where bodies rest that elastic connections hold, which carry no load where they are now.

    `stiffness` (2, 3, 3, m) is as in `ElasticStructure`; `loads` (6, n) are further forces on the bodies, N, and
    moments about their centres, N·m. Of connections that are bearings the stiffness does not count, and their loads are
    forces along the axes of the world, and moments about the middles of their springs.
    """
    moves = bodies.moves
    if bearings is not None:
        stiffness = without(stiffness, bearings.rows)
    label = connected_parts(moves, frames.first, frames.second)
    ends = np.stack((frames.first, frames.second))
    supported = np.unique(label[ends][:, ~moves[ends].all(axis=0)])
    unloaded = joint_positions(frames, bodies.positions_m, bodies.rotations).deformations()
    positions_m, rotations = bodies.positions_m.copy(), bodies.rotations.copy()
    held, frequencies = np.zeros(len(bodies), bool), []
    of_connections = label[ends].max(axis=0, initial=-1)
    for part in supported[supported >= 0].tolist():
        members, rows = np.flatnonzero(label == part), np.flatnonzero(of_connections == part)
        started = replace(bodies, positions_m=positions_m, rotations=rotations)
        pads = None if bearings is None else _PartOnBearings(bearings, rows)
        rest = _part_at_rest(members, frames.only(rows), stiffness[..., rows], started, gravity_m_s2, loads, pads)
        if rest:
            held[members] = True
            positions, turned, frequency = rest
            positions_m[:, members], rotations[..., members] = positions[:, members], turned[..., members]
            frequencies.append(frequency)
    loads = stressed(stiffness, joint_positions(frames, positions_m, rotations).deformations() - unloaded)
    if bearings is not None:
        loads[:, bearings.rows] = bearings.loads_at_rest(positions_m, rotations)
    return Equilibrium(positions_m, rotations, held, min(frequencies, default=0.0), loads)


class _PartOnBearings:
    """Bearings among the connections (r,) of a part, in ascending order."""

    def __init__(self, bearings: Bearings, rows: IntArray):
        self._bearings = bearings
        self._mine = np.flatnonzero(np.isin(bearings.rows, rows))
        self._at = np.searchsorted(rows, bearings.rows[self._mine])

    def at_rest(self, positions_m: FloatArray, rotations: FloatArray, *, whole: bool) -> PadsAtRest:
        """Return forces and stiffness of those of the part, which are numbered among its connections."""
        pads, mine = self._bearings.at_rest(positions_m, rotations, whole=whole), self._mine
        first, second, between = (block[..., mine] for block in pads.blocks)
        on_first, on_second = (load[:, mine] for load in pads.loads)
        return PadsAtRest(self._at, (first, second, between), (on_first, on_second))


def _part_at_rest(
    members: IntArray,
    frames: JointFrames,
    stiffness: FloatArray,
    bodies: RigidBodies,
    gravity_m_s2: FloatArray,
    loads: FloatArray | None,
    pads: _PartOnBearings | None,
) -> tuple[FloatArray, FloatArray, float] | None:
    """Positions, rotations and first frequency of connected bodies (b,) at rest; None for a mechanism."""
    count, positions_m, rotations = len(bodies), bodies.positions_m, bodies.rotations
    unknown = np.full(count, -1)
    unknown[members] = np.arange(len(members))
    system = BlockSystem(len(members), unknown[frames.first], unknown[frames.second])
    weights = np.zeros((6, count))
    weights[:3, members] = bodies.masses_kg[members] * gravity_m_s2[:, None]
    if loads is not None:
        weights[:, members] += loads[:, members]
    unloaded = joint_positions(frames, positions_m, rotations).deformations()
    slack = 1.0 / np.square(_SLOWEST_S / (2.0 * np.pi))
    solutions, balanced = (_SOLUTIONS, _AT_REST) if pads is None else (_SOLUTIONS_ON_BEARINGS, _AT_REST_ON_BEARINGS)
    for number in range(solutions):
        positions = joint_positions(frames, positions_m, rotations)
        rows = positions.rows()
        own = bodies.mass_matrices(rotations, members)
        blocks = stiffness_blocks(rows, stiffness)
        holding = rows.loads(stressed(stiffness, positions.deformations() - unloaded))
        if pads is not None:
            on_pads = pads.at_rest(positions_m, rotations, whole=number == 0)
            for block, more in zip(blocks, on_pads.blocks, strict=True):
                block[..., on_pads.rows] += more
            for load, more in zip(holding, on_pads.loads, strict=True):
                load[:, on_pads.rows] += more
        system.factor(slack * own, *blocks)
        left = (weights + summed_on_bodies(frames.first, frames.second, holding, count))[:, members]
        if abs(left[:3]).max() <= balanced * abs(weights).max():
            break
        moved = np.zeros((6, count))
        moved[:, members] = system.solve(left)
        if not abs(moved[:3]).max() <= _LARGEST_M:
            return None
        positions_m = positions_m + moved[:3]
        rotations = components_first(rotated(components_last(rotations), components_last(moved[3:])))
    return positions_m, rotations, _first_frequency(system, own, slack)


def _first_frequency(system: BlockSystem, own: FloatArray, slack: float) -> float:
    """First frequency in Hz; of what is free to slide, that of its swinging up and down."""
    lowest = _lowest_square(system, own) - slack
    if lowest <= slack:  # it slides, or sways like a pendulum
        lowest = _square_by_weight(system, own)
    return float(np.sqrt(max(lowest, 0.0)) / (2.0 * np.pi))


def _square_by_weight(system: BlockSystem, own: FloatArray) -> float:
    """Square of the angular frequency of the shape (z alone) that the weight bends it to: Lord Rayleigh (1877)."""
    masses = own[2, 2]
    weights = np.zeros((6, len(masses)))
    weights[2] = masses
    down = system.solve(weights)[2]
    return float((masses * down).sum() / (masses * down * down).sum())


def _lowest_square(system: BlockSystem, own: FloatArray) -> float:
    """Square of the lowest angular frequency, by inverse iteration from an even motion in all directions."""
    shape = np.zeros((6, own.shape[2]))
    shape[:3] = 1.0
    square = 0.0
    for _ in range(_ITERATIONS):
        inert = own[:, 0] * shape[0]
        for column in range(1, 6):
            inert = inert + own[:, column] * shape[column]
        answer = system.solve(inert)
        before, square = square, float((shape * inert).sum() / (answer * inert).sum())
        shape = answer / abs(answer).max()
        if abs(square - before) <= _SAME_FREQUENCY * abs(square):
            break
    return square
