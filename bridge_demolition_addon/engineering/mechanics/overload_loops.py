"""Overloads of connections as loops, which Numba compiles: import this only where it is installed.

They give the same bits as `carried_sections`, `section_cuts` and `strength`, as the loops of cracks do: see
`elasticity.crack_loops`. Strengths (5, m) are in the order of `Strength`, friction is (0,) where none counts.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..compilation import compiled
from ..geometry.sum_loops import MOST_TERMS, total_of_row
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
def over_alone(places: Any, sections: Any, judged: Any, bounds: Any, of_sections: Any, resisting: Any) -> Any:
    """`Overloads.over_alone`: connections (k,) and their utilisations (k,).

    `places` are loads, positions and rotations, `sections` those of `CarriedSections.arrays`, `judged` what is intact
    and what is left, `bounds` those of `largest_utilisations`, `of_sections` all of `Sections`, `resisting` strengths,
    what more of them is pressed, and friction.
    """
    (loads, positions, rotations), (bodies, signs, points, axes, levers) = places, sections
    (intact, left), (most_by_force, most_by_moment) = judged, bounds
    areas, directions, bending_moduli, torsion_moduli = of_sections
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
        turned = _turned(rotation, axes[row])
        used = _used(
            _in_axes(turned, carried_force),
            _in_axes(turned, moment),
            areas[row],
            ((directions[row, 0, 0], directions[row, 0, 1]), (directions[row, 1, 0], directions[row, 1, 1])),
            (bending_moduli[row, 0], bending_moduli[row, 1]),
            torsion_moduli[row],
            _resistance(resisting, row),
        )
        if used / left[row] > 1.0:
            rows[count], found[count] = row, used / left[row]
            count += 1
    return rows[:count].copy(), found[:count].copy()


@compiled
def over_in_cuts(
    places: Any, sections: Any, judged: Any, bounds: Any, of_sections: Any, resisting: Any, cuts: Any, faces: Any
) -> Any:
    """Connections (k,) that are overloaded alone and in their cuts, and their utilisations (k,) in these.

    Others are as `over_alone` takes them, `cuts` and `faces` as `used_in_cuts` does. What a face carries is worked out
    where it is in such a cut: mostly few are overloaded alone.
    """
    (loads, positions, rotations), (bodies, signs, points, axes, _) = places, sections
    intact, left = judged
    rows, found = over_alone(places, sections, judged, bounds, of_sections, resisting)
    shape, count = (len(bodies), 3), 0
    forces, moments, middles = np.empty(shape), np.empty(shape), np.empty(shape)
    is_known, room = np.zeros(len(bodies), np.bool_), _room()
    for row in rows:
        for cut in (row, row + len(bodies)):
            for entry in range(cuts[0][cut], cuts[0][cut + 1]):
                face = cuts[1][entry]
                if is_known[face] or not intact[face]:
                    continue
                body = bodies[face]
                force, moment, middle = _carried(
                    loads[:, face], positions[:, body], rotations[:, :, body], signs[face], points[face]
                )
                for axis in range(3):
                    forces[face, axis], moments[face, axis] = force[axis], moment[axis]
                    middles[face, axis] = middle[axis]
                is_known[face] = True
        turned = _turned(rotations[:, :, bodies[row]], axes[row])
        used = _used_in_cuts(row, intact, (forces, moments, middles), turned, cuts, faces, resisting, room) / left[row]
        if used > 1.0:
            rows[count], found[count] = row, used
            count += 1
    return rows[:count].copy(), found[:count].copy()


@compiled
def used_in_cuts(rows: Any, intact: Any, loads: Any, axes: Any, cuts: Any, faces: Any, resisting: Any) -> Any:
    """`Overloads.in_cuts` of intact connections (r,), whose sections have axes (r, 3, 3).

    `loads` are forces, moments and points (m, 3) of all, `cuts` their starts, faces, signs and cosines, and `faces`
    areas and second moments.
    """
    used, room = np.empty(len(rows)), _room()
    for number in range(len(rows)):
        own = axes[number]
        columns = (
            (own[0, 0], own[1, 0], own[2, 0]),
            (own[0, 1], own[1, 1], own[2, 1]),
            (own[0, 2], own[1, 2], own[2, 2]),
        )
        used[number] = _used_in_cuts(rows[number], intact, loads, columns, cuts, faces, resisting, room)
    return used


@compiled
def _room() -> Any:
    """Room for the faces of a cut, and for what is added up over them."""
    return np.empty(MOST_TERMS, np.int64), np.empty((9, MOST_TERMS))


@compiled
def _used_in_cuts(
    row: int, intact: Any, loads: Any, axes: Any, cuts: Any, faces: Any, resisting: Any, room: Any
) -> float:
    """Mean utilisation of the two cuts of a connection, whose section has these axes."""
    starts, members, _, _ = cuts
    both = 0.0
    for cut in (row, row + len(intact)):
        count = 0
        for entry in range(starts[cut], starts[cut + 1]):
            if intact[members[entry]]:
                room[0][count] = entry
                count += 1
        force, moment, area, second = _cut(count, room, loads, axes, cuts, faces)
        area, directions, moduli, torsion_modulus = rectangle(area, second)
        both += _used(force, moment, area, directions, moduli, torsion_modulus, _resistance(resisting, row))
    return both / 2.0


@compiled
def _cut(count: int, room: Any, loads: Any, axes: Any, cuts: Any, faces: Any) -> Any:
    """`section_cuts.cut_loads` of one cut, whose faces are the first so many in the room."""
    (entries, lines), (forces, moments, points) = room, loads
    (_, members, signs, cosines), (areas, second_moments) = cuts, faces
    for at in range(count):
        face = members[entries[at]]
        lines[0, at] = areas[face] * cosines[entries[at]]
        for axis in range(3):
            lines[1 + axis, at] = lines[0, at] * points[face, axis]
    area = total_of_row(lines, 0, count)
    x, y, z = total_of_row(lines, 1, count), total_of_row(lines, 2, count), total_of_row(lines, 3, count)
    middle = x / area, y / area, z / area
    for at in range(count):
        face, sign, cosine = members[entries[at]], signs[entries[at]], cosines[entries[at]]
        lever = points[face, 0] - middle[0], points[face, 1] - middle[1], points[face, 2] - middle[2]
        pull = sign * forces[face, 0], sign * forces[face, 1], sign * forces[face, 2]
        turn = crossed(lever, pull)
        for axis in range(3):
            lines[axis, at] = pull[axis]
            lines[3 + axis, at] = sign * moments[face, axis] + turn[axis]
        share = areas[face] * cosine
        y, z = dotted(axes[1], lever), dotted(axes[2], lever)
        lines[6, at] = second_moments[face, 0, 0] * cosine + share * (z * z)
        lines[7, at] = second_moments[face, 0, 1] * cosine + share * (-y * z)
        lines[8, at] = second_moments[face, 1, 1] * cosine + share * (y * y)
    force = total_of_row(lines, 0, count), total_of_row(lines, 1, count), total_of_row(lines, 2, count)
    moment = total_of_row(lines, 3, count), total_of_row(lines, 4, count), total_of_row(lines, 5, count)
    second = total_of_row(lines, 6, count), total_of_row(lines, 7, count), total_of_row(lines, 8, count)
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
    resistance: Any,
) -> Any:
    """`strength.utilisation` of one section, with friction where it is a number."""
    (compression, tension, shear_pa, torsion, bending_pa), pressed, friction = resistance
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
def _resistance(resisting: Any, row: int) -> Any:
    """Strengths of a connection, by how much more it has in compression, and its friction, nan where none counts."""
    strengths, pressed, friction = resisting
    all_five = strengths[0, row], strengths[1, row], strengths[2, row], strengths[3, row], strengths[4, row]
    return all_five, pressed[row], friction[row] if len(friction) else np.nan


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
def _turned(rotation: Any, axes: Any) -> Any:
    """Axes of a section, the columns (3, 3), that turn with a body."""
    return _product(rotation, axes[:, 0]), _product(rotation, axes[:, 1]), _product(rotation, axes[:, 2])


@compiled
def _in_axes(axes: Any, vector: Any) -> Any:
    """Components of a vector along three axes."""
    return dotted(axes[0], vector), dotted(axes[1], vector), dotted(axes[2], vector)
