"""The elastic structure at rest: its deformation under its own weight, and its first frequency about that."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from ..geometry.rotations import rotated
from .equations import RigidBodies, connected_parts, stiffness_blocks, stressed, summed_on_bodies
from .frequencies import SLACK, first_frequency
from .joint_rows import JointFrames, components_first, components_last, joint_positions
from .sparse_system import BlockSystem

_LARGEST_M = 0.5
"""Largest deformation; beyond it there is no equilibrium near the shape in which the part was built."""

_SOLUTIONS = 8
"""Linear solutions, one after another, each of which corrects the turning of the last: two or three are enough."""

_AT_REST = 1e-9
"""Unbalanced load, as a share of the largest weight, at which the structure rests."""


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
) -> Equilibrium:
    """Return where bodies rest that elastic connections hold, which carry no load where they are now.

    `stiffness` (6, 6, m) is as in `ElasticStructure`; `loads` (6, n) are further forces on the bodies, N, and
    moments about their centres, N·m.
    """
    moves = bodies.moves
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
        rest = _part_at_rest(members, frames.only(rows), stiffness[..., rows], started, gravity_m_s2, loads)
        if rest:
            held[members] = True
            positions, turned, frequency = rest
            positions_m[:, members], rotations[..., members] = positions[:, members], turned[..., members]
            frequencies.append(frequency)
    loads = stressed(stiffness, joint_positions(frames, positions_m, rotations).deformations() - unloaded)
    return Equilibrium(positions_m, rotations, held, min(frequencies, default=0.0), loads)


def _part_at_rest(
    members: IntArray,
    frames: JointFrames,
    stiffness: FloatArray,
    bodies: RigidBodies,
    gravity_m_s2: FloatArray,
    loads: FloatArray | None,
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
    for _ in range(_SOLUTIONS):
        positions = joint_positions(frames, positions_m, rotations)
        rows = positions.rows()
        own = bodies.mass_matrices(rotations, members)
        system.factor(SLACK * own, *stiffness_blocks(rows, stiffness))
        holding = rows.loads(stressed(stiffness, positions.deformations() - unloaded))
        left = (weights + summed_on_bodies(frames.first, frames.second, holding, count))[:, members]
        if abs(left[:3]).max() <= _AT_REST * abs(weights).max():
            break
        moved = np.zeros((6, count))
        moved[:, members] = system.solve(left)
        if not abs(moved[:3]).max() <= _LARGEST_M:
            return None
        positions_m = positions_m + moved[:3]
        rotations = components_first(rotated(components_last(rotations), components_last(moved[3:])))
    return positions_m, rotations, first_frequency(system, own)
