"""What elastic connections do in a sub-step, before and after the equations of the bodies are solved.

By loops that are compiled, where Numba is installed; with the same bits without it, in more time. All arrays have their
components first.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..arrays import BoolArray, FloatArray, IntArray
from .compiled_joints import equation_loops, joint_loops, joint_position_loops
from .equations import stiffness_blocks, stressed, summed_on_bodies
from .joint_rows import JointFrames, JointRows, joint_positions


@dataclass(frozen=True, eq=False)
class ActingJoints:
    """k connections that act, with how strongly impulses follow rates: dt (dt + β), s²."""

    frames: JointFrames
    rows: JointRows
    stiffness: FloatArray  # (6, 6, k)
    implicit_s2: FloatArray  # (k,)

    @cached_property
    def grouped(self) -> FloatArray:
        """Rows and stiffness (g, 72, 64) as compiled loops take them."""
        rows = self.rows
        of_rows = rows.along, rows.first_turning, rows.second_turning, rows.turning
        grouped: FloatArray = _loops().grouped(*of_rows, self.stiffness)
        return grouped


def deformations(frames: JointFrames, positions_m: FloatArray, rotations: FloatArray) -> FloatArray:
    """Return deformations (6, m) with bodies at positions (3, n) in rotations (3, 3, n)."""
    loops = joint_position_loops()
    if loops is None:
        return joint_positions(frames, positions_m, rotations).deformations()
    found: FloatArray = loops.deformations(
        frames.first,
        frames.second,
        frames.first_axes,
        frames.second_axes,
        frames.first_points_m,
        frames.second_points_m,
        positions_m,
        rotations,
    )
    return found


def begun(
    joints: ActingJoints, strains: FloatArray, substep_s: float, velocities: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return rates (6, k), amounts of impulses (6, k) and their sums on bodies (6, n), as if no body slowed down.

    Strains (6, k) are deformations from the unloaded shape, velocities (6, n) those that bodies would have.
    """
    loops, frames, rows = joint_loops(), joints.frames, joints.rows
    if loops is not None:
        found: tuple[FloatArray, FloatArray, FloatArray] = loops.begun(
            frames.first, frames.second, joints.grouped, joints.implicit_s2, strains, substep_s, velocities
        )
        return found
    rates = rows.rates(*(velocities.take(ends, axis=1) for ends in (frames.first, frames.second)))
    amounts = stressed(joints.stiffness, substep_s * strains - joints.implicit_s2 * rates)
    loads = summed_on_bodies(frames.first, frames.second, rows.loads(amounts), velocities.shape[1])
    return rates, amounts, loads


def slowed(
    joints: ActingJoints, rates: FloatArray, amounts: FloatArray, changes: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Return rates (6, k), impulses (6, k) on first and on second bodies, and their sums (6, n), of what has begun.

    Changes (6, n) are those of the velocities that went into it.
    """
    loops, frames, rows = joint_loops(), joints.frames, joints.rows
    if loops is not None:
        found: tuple[FloatArray, FloatArray, FloatArray, FloatArray] = loops.slowed(
            frames.first, frames.second, joints.grouped, joints.implicit_s2, rates, amounts, changes
        )
        return found
    slowing = rows.rates(*(changes.take(ends, axis=1) for ends in (frames.first, frames.second)))
    loads = rows.loads(amounts - stressed(joints.stiffness, joints.implicit_s2 * slowing))
    return rates + slowing, *loads, summed_on_bodies(frames.first, frames.second, loads, changes.shape[1])


def velocities_alone(
    velocities: FloatArray,
    left: FloatArray,
    inverse_masses: FloatArray,
    inverse_inertias: FloatArray,
    loads: FloatArray,
    substep_s: float,
) -> FloatArray:
    """Return velocities (6, n) at the end of a sub-step without connections, from those at its beginning.

    Bullet leaves a share (6, n) of those of bodies that move freely; loads (6, n) act on bodies with inverse masses
    (n,) and inverse inertias (3, 3, n).
    """
    loops = joint_loops()
    if loops is not None:
        found: FloatArray = loops.velocities_alone(velocities, left, inverse_masses, inverse_inertias, loads, substep_s)
        return found
    turning = inverse_inertias[:, 0] * loads[3] + inverse_inertias[:, 1] * loads[4] + inverse_inertias[:, 2] * loads[5]
    gained = np.concatenate((inverse_masses * loads[:3], turning * (inverse_masses > 0.0)))
    alone: FloatArray = np.where(inverse_masses > 0.0, left, 1.0) * velocities + substep_s * gained
    return alone


def put_loads(
    loads: FloatArray,
    on_first: BoolArray,
    holding: BoolArray,
    parts: Sequence[tuple[IntArray, FloatArray, FloatArray]],
    substep_s: float,
) -> None:
    """Write the loads (6, m) of connections that hold (m,) in a sub-step, and 0 for the others.

    They are those on first bodies, or on second ones (m,). `parts` are numbers (k,) of some connections with their
    impulses (6, k) on both.
    """
    loops = joint_loops()
    if loops is not None:
        loops.clear_loads(loads, holding)
        for numbers, of_first, of_second in parts:
            loops.put_loads(loads, on_first, numbers, of_first, of_second, substep_s)
        return
    loads[:, ~holding] = 0.0
    for numbers, of_first, of_second in parts:
        loads[:, numbers] = np.where(on_first[numbers], of_first, of_second) / substep_s


def stored(stiffness: FloatArray, strains: FloatArray) -> FloatArray:
    """Return the energy (k,) in connections of stiffness (6, 6, k) with strains (6, k)."""
    loops = joint_loops()
    if loops is not None:
        found: FloatArray = loops.stored(stiffness, strains)
        return found
    energies = np.zeros(strains.shape[1])
    for amount, strain in zip(stressed(stiffness, strains), strains, strict=True):
        energies += 0.5 * amount * strain
    return energies


def rows_at(frames: JointFrames, positions_m: FloatArray, rotations: FloatArray) -> JointRows:
    """Return the rows of connections with bodies at positions (3, n) in rotations (3, 3, n)."""
    loops = joint_position_loops()
    if loops is None:
        return joint_positions(frames, positions_m, rotations).rows()
    axes, points = (frames.first_axes, frames.second_axes), (frames.first_points_m, frames.second_points_m)
    return JointRows(*loops.rows(frames.first, frames.second, *axes, *points, rotations))


def added_blocks(
    rows: JointRows, stiffness: FloatArray, implicit_s2: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return what connections (r,) add to the equations of their bodies, and between; zeros have any sign.

    Of the first two only numbers on and above the diagonal count: they are symmetric.
    """
    loops = equation_loops()
    if loops is None:
        return stiffness_blocks(rows, implicit_s2 * stiffness)
    found: tuple[FloatArray, FloatArray, FloatArray] = loops.blocks(
        rows.along, rows.first_turning, rows.second_turning, rows.turning, stiffness, implicit_s2
    )
    return found


def _loops() -> Any:
    loops = joint_loops()
    assert loops is not None, "only compiled loops take connections one after another"
    return loops
