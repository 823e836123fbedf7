"""Overloads of connections as loops, which Numba compiles: import this only where it is installed.

They give the same bits as `carried_sections`, `section_cuts` and `strength`, as the loops of cracks do: see
`elasticity.crack_loops`. Strengths (5, m) are in the order of `Strength`, friction is (0,) where none counts.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..compilation import compiled
from ..geometry.sum_loops import MOST_TERMS, total
from ..geometry.vector_loops import crossed, dotted
from .strength import ROUNDING, SINGLE_PRECISION


@compiled
def carried_loads(
    loads: Any, positions: Any, rotations: Any, bodies: Any, signs: Any, points: Any
) -> tuple[Any, Any, Any]:
    """`CarriedSections.loads` of all connections, after each of some sub-steps: (3, s, m) each."""
    substeps, count = loads.shape[1], len(bodies)
    forces, moments, places = (
        np.empty((3, substeps, count)),
        np.empty((3, substeps, count)),
        np.empty((3, substeps, count)),
    )
    for step in range(substeps):
        for row in range(count):
            load, place = loads[:, step, row], positions[:, step, bodies[row]]
            force, moment, point = _carried(load, place, rotations[:, :, step, bodies[row]], signs[row], points[row])
            for axis in range(3):
                forces[axis, step, row], moments[axis, step, row] = force[axis], moment[axis]
                places[axis, step, row] = point[axis]
    return forces, moments, places


@compiled
def over_alone(
    loads: Any,
    positions: Any,
    rotations: Any,
    bodies: Any,
    signs: Any,
    points: Any,
    axes: Any,
    levers: Any,
    intact: Any,
    left: Any,
    most_by_force: Any,
    most_by_moment: Any,
    areas: Any,
    directions: Any,
    bending_moduli: Any,
    torsion_moduli: Any,
    strengths: Any,
    pressed: Any,
    friction: Any,
) -> tuple[Any, Any]:
    """`Overloads.over_alone`."""
    rows, found, count = np.empty(len(bodies), np.int64), np.empty(len(bodies)), 0
    for row in range(len(bodies)):
        load = loads[:, row]
        force, torque = np.sqrt(dotted(load[:3], load[:3])), np.sqrt(dotted(load[3:], load[3:]))
        most = (most_by_force[row] + most_by_moment[row] * levers[row]) * force + most_by_moment[row] * torque
        if not (intact[row] and most * (1.0 + SINGLE_PRECISION) > left[row]):
            continue
        body = bodies[row]
        rotation = rotations[:, :, body]
        carried_force, moment, _ = _carried(load, positions[:, body], rotation, signs[row], points[row])
        normal = _product(rotation, axes[row, :, 0])
        level = _product(rotation, axes[row, :, 1])
        steep = _product(rotation, axes[row, :, 2])
        used = _used(
            (dotted(normal, carried_force), dotted(level, carried_force), dotted(steep, carried_force)),
            (dotted(normal, moment), dotted(level, moment), dotted(steep, moment)),
            areas[row],
            ((directions[row, 0, 0], directions[row, 0, 1]), (directions[row, 1, 0], directions[row, 1, 1])),
            (bending_moduli[row, 0], bending_moduli[row, 1]),
            torsion_moduli[row],
            _all_five(strengths, row),
            pressed[row],
            friction[row] if len(friction) else np.nan,
        )
        if used / left[row] > 1.0:
            rows[count], found[count] = row, used / left[row]
            count += 1
    return rows[:count].copy(), found[:count].copy()


@compiled
def used_in_cuts(
    rows: Any,
    intact: Any,
    forces: Any,
    moments: Any,
    points: Any,
    axes: Any,
    starts: Any,
    faces: Any,
    signs: Any,
    cosines: Any,
    areas: Any,
    second_moments: Any,
    strengths: Any,
    pressed: Any,
    friction: Any,
) -> Any:
    """`Overloads.in_cuts` of intact connections (r,), whose sections have axes (r, 3, 3), with loads (m, 3) of all."""
    used = np.empty(len(rows))
    entries, lines, sides = np.empty(MOST_TERMS, np.int64), np.empty((9, MOST_TERMS)), np.empty(2)
    for number in range(len(rows)):
        row = rows[number]
        for side in range(2):
            cut, count = row + side * len(intact), 0
            for entry in range(starts[cut], starts[cut + 1]):
                if intact[faces[entry]]:
                    entries[count] = entry
                    count += 1
            force, moment, area, second = _cut(
                entries[:count],
                lines,
                forces,
                moments,
                points,
                axes[number],
                faces,
                signs,
                cosines,
                areas,
                second_moments,
            )
            area, directions, moduli, torsion_modulus = rectangle(area, second)
            slides = friction[row] if len(friction) else np.nan
            sides[side] = _used(
                force,
                moment,
                area,
                directions,
                moduli,
                torsion_modulus,
                _all_five(strengths, row),
                pressed[row],
                slides,
            )
        used[number] = (sides[0] + sides[1]) / 2.0
    return used


@compiled
def _cut(
    entries: Any,
    lines: Any,
    forces: Any,
    moments: Any,
    points: Any,
    axes: Any,
    faces: Any,
    signs: Any,
    cosines: Any,
    areas: Any,
    second_moments: Any,
) -> Any:
    """`section_cuts.cut_loads` of one cut; `lines` are room to work in."""
    count = len(entries)
    for at in range(count):
        face = faces[entries[at]]
        lines[0, at] = areas[face] * cosines[entries[at]]
        for axis in range(3):
            lines[1 + axis, at] = lines[0, at] * points[face, axis]
    area = total(lines[0, :count])
    middle = total(lines[1, :count]) / area, total(lines[2, :count]) / area, total(lines[3, :count]) / area
    for at in range(count):
        face, sign, cosine = faces[entries[at]], signs[entries[at]], cosines[entries[at]]
        lever = points[face, 0] - middle[0], points[face, 1] - middle[1], points[face, 2] - middle[2]
        pull = sign * forces[face, 0], sign * forces[face, 1], sign * forces[face, 2]
        turn = crossed(lever, pull)
        for axis in range(3):
            lines[axis, at] = pull[axis]
            lines[3 + axis, at] = sign * moments[face, axis] + turn[axis]
        share, own = areas[face] * cosine, second_moments[face]
        y, z = dotted(axes[:, 1], lever), dotted(axes[:, 2], lever)
        lines[6, at] = own[0, 0] * cosine + share * (z * z)
        lines[7, at] = own[0, 1] * cosine + share * (-y * z)
        lines[8, at] = own[1, 1] * cosine + share * (y * y)
    force = total(lines[0, :count]), total(lines[1, :count]), total(lines[2, :count])
    moment = total(lines[3, :count]), total(lines[4, :count]), total(lines[5, :count])
    second = total(lines[6, :count]), total(lines[7, :count]), total(lines[8, :count])
    return _in_axes(axes, force), _in_axes(axes, moment), area, second


@compiled
def rectangle(area: float, second: Any) -> Any:
    """`strength.rectangular_sections` of one section: area, directions of bending, its moduli, and that of torsion."""
    first, beside, other = second
    tangent = 0.0
    if beside != 0.0:
        ratio = (other - first) / (2.0 * beside)
        tangent = (1.0 if ratio >= 0.0 else -1.0) / (abs(ratio) + np.sqrt(ratio * ratio + 1.0))
    cosine = 1.0 / np.sqrt(tangent * tangent + 1.0)
    sine = tangent * cosine
    slope = sine / cosine
    small, large = first - slope * beside, other + slope * beside
    directions = (cosine, sine), (-sine, cosine)
    if small > large:
        small, large = large, small
        directions = (sine, cosine), (cosine, -sine)
    if large - small <= ROUNDING * large:
        directions = (1.0, 0.0), (0.0, 1.0)
    area = area if area > 0.0 else np.nan
    short, long = np.sqrt(12.0 * small / area), np.sqrt(12.0 * large / area)
    torsion_modulus = area * short / (3.0 + 1.8 * short / long)
    return area, directions, (2.0 * small / short, 2.0 * large / long), torsion_modulus


@compiled
def _used(
    force: Any,
    moment: Any,
    area: float,
    directions: Any,
    bending_moduli: Any,
    torsion_modulus: float,
    strengths: Any,
    pressed: float,
    friction: float,
) -> Any:
    """`strength.utilisation` of one section, with friction where it is a number."""
    compression, tension, shear_pa, torsion, bending_pa = strengths
    axial = force[0] / area
    first = abs(directions[0][0] * moment[1] + directions[1][0] * moment[2])
    second = abs(directions[0][1] * moment[1] + directions[1][1] * moment[2])
    bending = first / bending_moduli[0] + second / bending_moduli[1]
    shear = np.sqrt(force[1] * force[1] + force[2] * force[2]) / area
    if not np.isnan(friction):
        shear = max(shear + friction * min(axial, 0.0), 0.0)
    shear = shear / shear_pa
    shear += abs(moment[0]) / torsion_modulus / torsion
    stretched = axial / (tension if axial > 0.0 else bending_pa) + bending / bending_pa
    edge = max(stretched, (bending - axial) / (pressed * compression))
    return np.sqrt(edge * edge + shear * shear)


@compiled
def _carried(load: Any, centre: Any, rotation: Any, sign: float, point: Any) -> Any:
    """Force and moment of a connection on its first body, and where it is."""
    force = load[0], load[1], load[2]
    x, y, z = _product(rotation, point)
    place = centre[0] + x, centre[1] + y, centre[2] + z
    by_force = crossed((place[0] - centre[0], place[1] - centre[1], place[2] - centre[2]), force)
    moment = (
        sign * (load[3] - by_force[0]),
        sign * (load[4] - by_force[1]),
        sign * (load[5] - by_force[2]),
    )
    return (sign * force[0], sign * force[1], sign * force[2]), moment, place


@compiled
def _all_five(strengths: Any, row: int) -> Any:
    """Strengths of a connection."""
    return strengths[0, row], strengths[1, row], strengths[2, row], strengths[3, row], strengths[4, row]


@compiled
def _product(rotation: Any, vector: Any) -> Any:
    """`vectors.transformed` of one vector with a rotation (3, 3)."""
    x, y, z = vector[0], vector[1], vector[2]
    return (
        rotation[0, 0] * x + rotation[0, 1] * y + rotation[0, 2] * z,
        rotation[1, 0] * x + rotation[1, 1] * y + rotation[1, 2] * z,
        rotation[2, 0] * x + rotation[2, 1] * y + rotation[2, 2] * z,
    )


@compiled
def _in_axes(axes: Any, vector: Any) -> Any:
    """Components of a vector along axes, which are columns (3, 3)."""
    return dotted(axes[:, 0], vector), dotted(axes[:, 1], vector), dotted(axes[:, 2], vector)
