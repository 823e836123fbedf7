"""The law of cracks as loops over gaps, which Numba compiles: import this only where it is installed.

For some hundred gaps numpy takes longer to call its functions than these to calculate. The loops give the same bits as
`crack_law` and `gaps`, which are read, changed and tested first: every operation here stands there, in the same order.

All arrays have their components first.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..compilation import compiled
from ..geometry.vector_loops import crossed


@compiled
def _stretched(gap: Any, direction: Any, dowel: Any) -> Any:
    """Stretch of a bar by a gap, as `crack_law.stretches_of_bars`."""
    along = gap[0] * direction[0] + gap[1] * direction[1] + gap[2] * direction[2]
    return (
        dowel * gap[0] + (1.0 - dowel) * along * direction[0],
        dowel * gap[1] + (1.0 - dowel) * along * direction[1],
        dowel * gap[2] + (1.0 - dowel) * along * direction[2],
    )


@compiled
def _tried(stiffness: Any, stretch: Any, slip: Any) -> Any:
    """Force of a bar that has not yielded, and its size."""
    trial = (
        stiffness * (stretch[0] - slip[0]),
        stiffness * (stretch[1] - slip[1]),
        stiffness * (stretch[2] - slip[2]),
    )
    return trial, np.sqrt(trial[0] * trial[0] + trial[1] * trial[1] + trial[2] * trial[2])


@compiled
def _vector(values: Any, row: Any) -> Any:
    """Components of one of vectors (3, b)."""
    return values[0, row], values[1, row], values[2, row]


@compiled
def _across(normal: Any, gap: Any) -> Any:
    """How far a gap is open."""
    return normal[0] * gap[0] + normal[1] * gap[1] + normal[2] * gap[2]


@compiled
def _share_left(less: Any, size: Any) -> Any:
    """Part of a force that is left where a bar yields."""
    return 1.0 - (less / size if size > 0.0 else 0.0)


@compiled
def _tried_and_left(stiffness: Any, stretch: Any, slip: Any, limit: Any, resists: Any) -> Any:
    """Force of a bar as if it had not yielded, its size, how far it flows, and the part of the force that is left."""
    trial, size = _tried(stiffness, stretch, slip)
    flow = max(size - limit[0] - limit[1], 0.0) / resists
    return trial, size, flow, _share_left(stiffness * flow, size)


@compiled
def _scaled(factor: Any, of: Any) -> Any:
    """Multiple of a vector."""
    return factor * of[0], factor * of[1], factor * of[2]


@compiled
def _unit(of: Any, size: Any) -> Any:
    """Direction of a vector of this size; none where it is 0."""
    return (of[0] / size, of[1] / size, of[2] / size) if size > 0.0 else (0.0, 0.0, 0.0)


@compiled
def _answers(
    row: int,
    bars: Any,
    slips: Any,
    flows: Any,
    normals: Any,
    directions: Any,
    pressed: Any,
    rubbing: Any,
    rests: Any,
    gaps: Any,
    dowel: float,
) -> Any:
    """What a bar does across a gap, what its sides do that rub, and how far these are open."""
    yields, stiffness, modulus, resists = bars
    grips, sliding, sliding_resists = rubbing
    gap, normal = _vector(gaps, row), _vector(normals, row)
    opened = _across(normal, gap)
    stretch, limit = _stretched(gap, _vector(directions, row), dowel), (yields[row], modulus[row] * flows[row])
    bar = _tried_and_left(stiffness[row], stretch, _vector(slips, row), limit, resists[row])
    slid = gap[0] - opened * normal[0], gap[1] - opened * normal[1], gap[2] - opened * normal[2]
    rub = _tried_and_left(sliding[row], slid, _vector(rests, row), (grips[row], 0.0), sliding_resists[row])
    return bar, rub, opened


@compiled
def _write_force(
    result: Any, row: int, bar: Any, rub: Any, opened: Any, normal: Any, direction: Any, pressed: Any, dowel: float
) -> None:
    """Force across a gap, of bar, rubbing and pressing together."""
    pull = _stretched(_scaled(bar[3], bar[0]), direction, dowel)
    pressing = pressed * min(opened, 0.0)
    for axis in range(3):
        result[axis, row] = pull[axis] + rub[3] * rub[0][axis] + pressing * normal[axis]


@compiled
def forces(
    bars: Any,
    slips: Any,
    flows: Any,
    normals: Any,
    directions: Any,
    pressed: Any,
    rubbing: Any,
    rests: Any,
    gaps: Any,
    dowel: float,
) -> Any:
    """`CrackLaw.forces`."""
    result = np.empty_like(gaps)
    for row in range(gaps.shape[1]):
        bar, rub, opened = _answers(row, bars, slips, flows, normals, directions, pressed, rubbing, rests, gaps, dowel)
        normal, direction = _vector(normals, row), _vector(directions, row)
        _write_force(result, row, bar, rub, opened, normal, direction, pressed[row], dowel)
    return result


@compiled
def linear(
    bars: Any,
    slips: Any,
    flows: Any,
    normals: Any,
    directions: Any,
    pressed: Any,
    rubbing: Any,
    rests: Any,
    gaps: Any,
    dowel: float,
) -> Any:
    """`CrackLaw.linear`."""
    _, stiffness, modulus, resists = bars
    _, sliding, sliding_resists = rubbing
    count = gaps.shape[1]
    result, tangents = np.empty_like(gaps), np.empty((3, 3, count))
    even = dowel * dowel
    for row in range(count):
        bar, rub, opened = _answers(row, bars, slips, flows, normals, directions, pressed, rubbing, rests, gaps, dowel)
        normal, direction = _vector(normals, row), _vector(directions, row)
        _write_force(result, row, bar, rub, opened, normal, direction, pressed[row], dowel)
        bars_across, rubs_across = stiffness[row] * bar[3], sliding[row] * rub[3]
        bars_along = stiffness[row] * (modulus[row] / resists[row] if bar[2] > 0.0 else 1.0)
        rubs_along = sliding[row] * (0.0 / sliding_resists[row] if rub[2] > 0.0 else 1.0)
        along, turn = _stretched(_unit(bar[0], bar[1]), direction, dowel), _unit(rub[0], rub[1])
        presses = pressed[row] if opened < 0.0 else 0.0
        for axis in range(3):
            for other in range(3):
                total = (presses - rubs_across) * (normal[axis] * normal[other])
                total += (1.0 - even) * bars_across * (direction[axis] * direction[other])
                total += (bars_along - bars_across) * (along[axis] * along[other])
                total += (rubs_along - rubs_across) * (turn[axis] * turn[other])
                if axis == other:
                    total += even * bars_across + rubs_across
                tangents[axis, other, row] = total
    return result, tangents


@compiled
def _column(matrix: Any, other: Any) -> Any:
    """Column of a matrix."""
    return matrix[0, other], matrix[1, other], matrix[2, other]


@compiled
def corner_stiffness(tangents: Any, first_arms: Any, second_arms: Any, corners: Any) -> Any:
    """`gaps.stiffness_of_points`, summed over the corners of each crack."""
    count = tangents.shape[2] // corners
    of_first, of_second, between = np.empty((6, 6, count)), np.empty((6, 6, count)), np.empty((6, 6, count))
    tangent, turning_first, turning_second = np.empty((3, 3)), np.empty((3, 3)), np.empty((3, 3))
    sums = np.empty((8, 3, 3))
    for row in range(count):
        for corner in range(corners):
            gap = corner * count + row
            first_arm, second_arm = _vector(first_arms, gap), _vector(second_arms, gap)
            for axis in range(3):
                line = tangents[axis, 0, gap], tangents[axis, 1, gap], tangents[axis, 2, gap]
                by_first, by_second = crossed(first_arm, line), crossed(second_arm, line)
                for other in range(3):
                    tangent[axis, other] = line[other]
                    turning_first[axis, other] = by_first[other]
                    turning_second[axis, other] = by_second[other]
            for other in range(3):
                to_first = crossed(first_arm, _column(tangent, other))
                to_second = crossed(second_arm, _column(tangent, other))
                about_first = crossed(first_arm, _column(turning_first, other))
                about_second = crossed(second_arm, _column(turning_second, other))
                about_both = crossed(first_arm, _column(turning_second, other))
                for axis in range(3):
                    added = (
                        tangent[axis, other],
                        turning_first[axis, other],
                        turning_second[axis, other],
                        to_first[axis],
                        to_second[axis],
                        about_first[axis],
                        about_second[axis],
                        about_both[axis],
                    )
                    for kind in range(8):
                        if corner == 0:
                            sums[kind, axis, other] = added[kind]
                        else:
                            sums[kind, axis, other] += added[kind]
        for axis in range(3):
            for other in range(3):
                pushed = sums[0, axis, other]
                of_first[axis, other, row], of_second[axis, other, row] = pushed, pushed
                between[axis, other, row] = -pushed
                of_first[axis, 3 + other, row] = sums[1, axis, other]
                of_second[axis, 3 + other, row] = sums[2, axis, other]
                between[axis, 3 + other, row] = -sums[2, axis, other]
                of_first[3 + axis, other, row] = sums[3, axis, other]
                of_second[3 + axis, other, row] = sums[4, axis, other]
                between[3 + axis, other, row] = -sums[3, axis, other]
                of_first[3 + axis, 3 + other, row] = sums[5, axis, other]
                of_second[3 + axis, 3 + other, row] = sums[6, axis, other]
                between[3 + axis, 3 + other, row] = -sums[7, axis, other]
    return of_first, of_second, between
