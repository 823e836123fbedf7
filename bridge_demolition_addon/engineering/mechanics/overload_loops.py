"""Overloads of connections as loops, which Numba compiles: import this only where it is installed.

They give the same bits as `carried_sections`, `section_cuts` and `strength`, as the loops of cracks do: see
`elasticity.crack_loops`. Everywhere `places` are loads, positions and rotations, and what `CarriedSections` packs,
`resisting` is what `Overloads` packs, by how much more of it is pressed, and friction, which is (0,) where none counts,
and `cuts` are starts and packed faces.
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
def over_alone(places: Any, judged: Any, resisting: Any) -> Any:
    """`Overloads.over_alone`: connections (k,) and their utilisations (k,).

    `judged` are what is intact and what is left, the bounds of `largest_utilisations`, and lever arms.
    """
    loads, positions, rotations, carried = places
    intact, left, most_by_force, most_by_moment, levers = judged
    rows, found, count = np.empty(len(carried), np.int64), np.empty(len(carried)), 0
    for row in range(len(carried)):
        load = loads[:, row]
        force, torque = np.sqrt(dotted(load[:3], load[:3])), np.sqrt(dotted(load[3:], load[3:]))
        most = (most_by_force[row] + most_by_moment[row] * levers[row]) * force + most_by_moment[row] * torque
        if not (intact[row] and most * (1.0 + SINGLE_PRECISION) > left[row]):
            continue
        own = carried[row]
        rotation = rotations[:, :, own.body]
        carried_force, moment, _ = _carried(load, positions[:, own.body], rotation, own.sign, own.point)
        turned = _turned(rotation, own.axes)
        section = resisting[0][row]
        directions, moduli = section.directions, section.moduli
        used = _used(
            _in_axes(turned, carried_force),
            _in_axes(turned, moment),
            section.area if section.area > 0.0 else np.nan,
            ((directions[0], directions[1]), (directions[2], directions[3])),
            (moduli[0], moduli[1]),
            section.torsion_modulus,
            _resistance(resisting, row),
        )
        if used / left[row] > 1.0:
            rows[count], found[count] = row, used / left[row]
            count += 1
    return rows[:count].copy(), found[:count].copy()


@compiled
def over_in_cuts(places: Any, judged: Any, resisting: Any, cuts: Any) -> Any:
    """Connections (k,) that are overloaded alone and in their cuts, and their utilisations (k,) in these.

    What a face carries is worked out for each cut: mostly few are overloaded alone, and numbers that are kept take
    longer to find again.
    """
    loads, positions, rotations, carried = places
    intact, left = judged[0], judged[1]
    rows, found = over_alone(places, judged, resisting)
    room, count, sides = _room(), 0, np.empty(2)
    for row in rows:
        turned = _turned(rotations[:, :, carried[row].body], carried[row].axes)
        for side in range(2):
            number = _intact_faces(row + side * len(carried), intact, cuts, room)
            for at in range(number):
                face = cuts[1][room[0][at]].face
                own = carried[face]
                place, rotation = positions[:, own.body], rotations[:, :, own.body]
                _note(room, at, _carried(loads[:, face], place, rotation, own.sign, own.point))
            sides[side] = _used_in_cut(row, number, room, turned, cuts, resisting)
        used = (sides[0] + sides[1]) / 2.0 / left[row]
        if used > 1.0:
            rows[count], found[count] = row, used
            count += 1
    return rows[:count].copy(), found[:count].copy()


@compiled
def used_in_cuts(rows: Any, intact: Any, loads: Any, axes: Any, cuts: Any, resisting: Any) -> Any:
    """`Overloads.in_cuts` of intact connections (r,), whose sections have axes (r, 3, 3).

    `loads` are forces, moments and points (m, 3) of all.
    """
    used, room, sides = np.empty(len(rows)), _room(), np.empty(2)
    forces, moments, points = loads
    for number in range(len(rows)):
        own = axes[number]
        columns = (
            (own[0, 0], own[1, 0], own[2, 0]),
            (own[0, 1], own[1, 1], own[2, 1]),
            (own[0, 2], own[1, 2], own[2, 2]),
        )
        for side in range(2):
            count = _intact_faces(rows[number] + side * len(intact), intact, cuts, room)
            for at in range(count):
                face = cuts[1][room[0][at]].face
                _note(room, at, (forces[face], moments[face], points[face]))
            sides[side] = _used_in_cut(rows[number], count, room, columns, cuts, resisting)
        used[number] = (sides[0] + sides[1]) / 2.0
    return used


@compiled
def _room() -> Any:
    """Room for the faces of a cut, for what each carries, and for what is added up over them."""
    return np.empty(MOST_TERMS, np.int64), np.empty((MOST_TERMS, 9)), np.empty((9, MOST_TERMS))


@compiled
def _intact_faces(cut: int, intact: Any, cuts: Any, room: Any) -> int:
    """Find the intact faces of a cut, and return how many there are."""
    count = 0
    for entry in range(cuts[0][cut], cuts[0][cut + 1]):
        if intact[cuts[1][entry].face]:
            room[0][count] = entry
            count += 1
    return count


@compiled
def _note(room: Any, at: int, load: Any) -> None:
    """Note the force, the moment and the point of a face of a cut."""
    force, moment, point = load
    for axis in range(3):
        room[1][at, axis], room[1][at, 3 + axis], room[1][at, 6 + axis] = force[axis], moment[axis], point[axis]


@compiled
def _used_in_cut(row: int, count: int, room: Any, axes: Any, cuts: Any, resisting: Any) -> Any:
    """Utilisation of a cut through so many faces that are noted, by the strength of a connection."""
    force, moment, area, second = _cut(count, room, axes, cuts[1], resisting[0])
    area, directions, moduli, torsion_modulus = rectangle(area, second)
    return _used(force, moment, area, directions, moduli, torsion_modulus, _resistance(resisting, row))


@compiled
def _cut(count: int, room: Any, axes: Any, members: Any, faces: Any) -> Any:
    """`section_cuts.cut_loads` of one cut through so many faces that are noted."""
    entries, loads, lines = room
    for at in range(count):
        member = members[entries[at]]
        lines[0, at] = faces[member.face].area * member.cosine
        for axis in range(3):
            lines[1 + axis, at] = lines[0, at] * loads[at, 6 + axis]
    area = total_of_row(lines, 0, count)
    x, y, z = total_of_row(lines, 1, count), total_of_row(lines, 2, count), total_of_row(lines, 3, count)
    middle = x / area, y / area, z / area
    for at in range(count):
        member = members[entries[at]]
        face, sign, cosine = faces[member.face], member.sign, member.cosine
        lever = loads[at, 6] - middle[0], loads[at, 7] - middle[1], loads[at, 8] - middle[2]
        pull = sign * loads[at, 0], sign * loads[at, 1], sign * loads[at, 2]
        turn = crossed(lever, pull)
        for axis in range(3):
            lines[axis, at] = pull[axis]
            lines[3 + axis, at] = sign * loads[at, 3 + axis] + turn[axis]
        share, (across, up) = face.area * cosine, (dotted(axes[1], lever), dotted(axes[2], lever))
        lines[6, at] = face.second[0] * cosine + share * (up * up)
        lines[7, at] = face.second[1] * cosine + share * (-across * up)
        lines[8, at] = face.second[2] * cosine + share * (across * across)
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
    of_all, pressed, friction = resisting
    own = of_all[row].strength
    return (own[0], own[1], own[2], own[3], own[4]), pressed[row], friction[row] if len(friction) else np.nan


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
