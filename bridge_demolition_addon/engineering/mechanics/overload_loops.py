"""Overloads of connections as a loop, which Numba compiles: import this only where it is installed.

It gives the same bits as `carried_sections` and `strength`, as the loops of cracks do: see `elasticity.crack_loops`.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..elasticity.crack_loops import compiled, crossed


@compiled
def overload_any(
    rows: Any,
    loads: Any,
    positions: Any,
    rotations: Any,
    bodies: Any,
    signs: Any,
    points: Any,
    axes: Any,
    areas: Any,
    directions: Any,
    bending_moduli: Any,
    torsion_moduli: Any,
    strengths: Any,
    pressed: Any,
    friction: Any,
    left: Any,
) -> bool:
    """`Overloads.overload_any`; strengths (5, m) are in the order of `Strength`, friction (0,) where none counts."""
    for row in rows:
        body, sign = bodies[row], signs[row]
        force = loads[0, row], loads[1, row], loads[2, row]
        x, y, z = _product(rotations, body, points[row])
        arm = (
            (positions[0, body] + x) - positions[0, body],
            (positions[1, body] + y) - positions[1, body],
            (positions[2, body] + z) - positions[2, body],
        )
        by_force = crossed(arm, force)
        moment = (
            sign * (loads[3, row] - by_force[0]),
            sign * (loads[4, row] - by_force[1]),
            sign * (loads[5, row] - by_force[2]),
        )
        force = sign * force[0], sign * force[1], sign * force[2]
        normal = _product(rotations, body, axes[row, :, 0])
        level = _product(rotations, body, axes[row, :, 1])
        steep = _product(rotations, body, axes[row, :, 2])
        axial = _along(normal, force) / areas[row]
        across = _along(level, force), _along(steep, force)
        about = _along(level, moment), _along(steep, moment)
        first = abs(directions[row, 0, 0] * about[0] + directions[row, 1, 0] * about[1])
        second = abs(directions[row, 0, 1] * about[0] + directions[row, 1, 1] * about[1])
        bending = first / bending_moduli[row, 0] + second / bending_moduli[row, 1]
        shear = np.sqrt(across[0] * across[0] + across[1] * across[1]) / areas[row]
        if len(friction):
            shear = max(shear + friction[row] * min(axial, 0.0), 0.0)
        shear = shear / strengths[2, row]
        shear += abs(_along(normal, moment)) / torsion_moduli[row] / strengths[3, row]
        pulled = strengths[1, row] if axial > 0.0 else strengths[4, row]
        stretched = axial / pulled + bending / strengths[4, row]
        edge = max(stretched, (bending - axial) / (pressed[row] * strengths[0, row]))
        if np.sqrt(edge * edge + shear * shear) / left[row] > 1.0:
            return True
    return False


@compiled
def _product(rotations: Any, body: int, vector: Any) -> Any:
    """`vectors.transformed` of one vector with a body."""
    x, y, z = vector[0], vector[1], vector[2]
    return (
        rotations[0, 0, body] * x + rotations[0, 1, body] * y + rotations[0, 2, body] * z,
        rotations[1, 0, body] * x + rotations[1, 1, body] * y + rotations[1, 2, body] * z,
        rotations[2, 0, body] * x + rotations[2, 1, body] * y + rotations[2, 2, body] * z,
    )


@compiled
def _along(axis: Any, vector: Any) -> Any:
    """Component of a vector along an axis."""
    return axis[0] * vector[0] + axis[1] * vector[1] + axis[2] * vector[2]
