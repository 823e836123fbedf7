"""Names of sections by their sizes or their outline, and where a section lies in the plane of a profile.

Profiles of other programs have their origin anywhere, mostly in the middle of the box around them, and may be turned or
mirrored. A `PlacedSection` says where the centre of the section is there, and how its y axis lies.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...errors import ScenarioError
from ..arithmetic import arctangent
from ..arrays import FloatArray
from ..geometry.plan_areas import signed_area
from ..geometry.vectors import length, unit
from .catalogue import rolled_sizes_mm, section_named
from .sections import SteelSection

_ROUNDING_MM = (0.6, 0.6, 0.11, 0.11)
"""How far height, width, web and flange of a rolled section may be from those of the table: files round to mm or, for
thicknesses, to tenths."""

_RADIUS = (0.1, 1.1)
"""The same of its root radius, where one is given: a part of it, and mm."""

_SLOPE = 0.16
"""Sine of the angle up to which a side still counts as along an axis: flanges of older rolled sections lean by 14 %."""

_SHORTEST = 1e-3
"""Part of the size of an outline below which a side says nothing of its direction."""

_SAME = 5e-3
"""Part of the size of an outline by which corners may be off those of a shape, and of its area."""

_LONGEST_CHORD = 0.8
"""Longest side of the outline of a round tube by its radius, as of eight sides: a square tube has corners on a circle,
too."""


@dataclass(frozen=True, slots=True, eq=False)
class PlacedSection:
    """A section in the plane of a profile.

    Attributes
    ----------
    name : str
        As a scenario gives it.
    centre_m : (2,) float
        Its centre.
    y_axis : (2,) float
        Unit vector along its y; its z axis is a quarter turn further, anticlockwise.
    """

    name: str
    centre_m: FloatArray
    y_axis: FloatArray

    @property
    def section(self) -> SteelSection:
        return section_named(self.name)


def sized_name(shape: str, sizes_m: Sequence[float]) -> str:
    """Return the name of a shape of `catalogue.SHAPES` with sizes in m; the rolled section's name where one has these.

    Raises
    ------
    ScenarioError
        There is no such section: a size is not above 0, or plates are thicker than what they are in.
    """
    if shape == "I" and (rolled := rolled_name(sizes_m)):
        return rolled
    if shape == "RHS" and _text(sizes_m[0]) == _text(sizes_m[1]):
        shape, sizes_m = "SHS", sizes_m[1:]
    name = f"{shape} {'x'.join(map(_text, sizes_m))}"
    section_named(name)
    return name


def rolled_name(sizes_m: Sequence[float], radius_m: float | None = None) -> str | None:
    """Return the rolled section with height, width, web and flange (4,) within rounding; None where there is none.

    A root radius above 0 has to be its own, too.
    """
    for name, known in rolled_sizes_mm().items():
        *plates, root = known
        differences = [abs(1e3 * size - own) for size, own in zip(sizes_m, plates, strict=True)]
        if any(off > most for off, most in zip(differences, _ROUNDING_MM, strict=True)):
            continue
        if not radius_m or abs(1e3 * radius_m - root) <= max(_RADIUS[0] * root, _RADIUS[1]):
            return name
    return None


def placed_by_sizes(shape: str, sizes_m: Sequence[float], radius_m: float | None = None) -> PlacedSection:
    """Return a section of sizes in m whose box has its middle at the origin, as profiles of IFC have.

    An I-section with another root radius than the rolled one of its sizes is welded. A `ScenarioError` says why there
    is no such section.
    """
    name = sized_name(shape, sizes_m)
    if shape == "I" and radius_m and rolled_name(sizes_m, radius_m) is None:
        name = f"I {'x'.join(map(_text, sizes_m))}"
    return PlacedSection(name, -_middle(section_named(name).rings), np.array([1.0, 0.0]))


def moved(placed: PlacedSection, x_axis: FloatArray, origin_m: FloatArray, *, mirrored: bool) -> PlacedSection:
    """Return a placed section whose plane lies in another one: turned, moved, and mirrored before at its y axis.

    `x_axis` (2,) is a unit vector. A mirrored section is one that is turned: of an angle with its legs exchanged, of a
    channel by 180°, and all others are alike on both sides.
    """
    name, centre, y_axis = placed.name, placed.centre_m, placed.y_axis
    if mirrored:
        name, y_axis = _mirrored(name, y_axis)
        centre = centre * (-1.0, 1.0)
    return PlacedSection(name, origin_m + _turned(centre, x_axis), _turned(y_axis, x_axis))


def section_of_outline(rings: Sequence[FloatArray]) -> PlacedSection | None:
    """Return the section with an outline of rings (k, 2) in m, holes among them; None where it is of no known shape."""
    largest = max(rings, key=lambda ring: abs(float(signed_area(ring))))
    holes = [ring for ring in rings if ring is not largest]
    if len(holes) > 1:
        return None
    outer = _anticlockwise(largest)
    if holes:
        return _tube(outer, _anticlockwise(holes[0])) or _hollow(outer, _anticlockwise(holes[0]))
    return _open(outer)


def _text(size_m: float) -> str:
    """Size in mm, to a hundredth."""
    return f"{1e3 * size_m:.2f}".rstrip("0").rstrip(".")


def _middle(rings: Sequence[FloatArray]) -> FloatArray:
    points = np.concatenate(rings)
    return np.asarray((points.min(axis=0) + points.max(axis=0)) / 2.0)


def _turned(points: FloatArray, x_axis: FloatArray) -> FloatArray:
    """Points (..., 2) with their x axis along another one (2,)."""
    across = np.array([-x_axis[1], x_axis[0]])
    return np.asarray(points[..., :1] * x_axis + points[..., 1:] * across)


def _mirrored(name: str, y_axis: FloatArray) -> tuple[str, FloatArray]:
    """Name and y axis of a section that is mirrored at the upright axis of its profile."""
    shape, _, sizes = name.partition(" ")
    y_axis = y_axis * (-1.0, 1.0)  # along which the mirrored section's own y axis runs
    if shape == "U":
        return name, y_axis
    if shape == "L":
        height, width, plate = sizes.split("x")
        return f"L {width}x{height}x{plate}", np.array([y_axis[1], -y_axis[0]])
    return name, -y_axis


def _anticlockwise(ring: FloatArray) -> FloatArray:
    return ring if float(signed_area(ring)) > 0.0 else ring[::-1]


def _tube(outer: FloatArray, inner: FloatArray) -> PlacedSection | None:
    """Round tube: all corners of each ring are as far from one centre."""
    centre = _middle([outer])
    radii = []
    for ring in (outer, inner):
        apart = length(ring - centre)
        radius = float(apart.max())
        longest = float(length(np.roll(ring, -1, axis=0) - ring).max())
        if longest > _LONGEST_CHORD * radius or radius - float(apart.min()) > _SAME * radius:
            return None
        radii.append(radius)
    return _known("CHS", [2.0 * radii[0], radii[0] - radii[1]], centre, np.array([1.0, 0.0]))


def _hollow(outer: FloatArray, inner: FloatArray) -> PlacedSection | None:
    """Box or rectangular tube: two rectangles about one middle, with square or rounded corners."""
    turn = _direction(outer)
    boxes, rounded_corners = [], False
    for ring in (outer, inner):
        upright = _turned_back(ring, turn)
        corners = _square_corners(upright)
        if corners is None or len(corners) != 4:
            return None
        low, high = corners.min(axis=0), corners.max(axis=0)
        rounded_corners |= float(signed_area(upright)) < (1.0 - 1e-4) * float(np.prod(high - low))
        boxes.append((low, high))
    (low, high), (inner_low, inner_high) = boxes
    walls = np.concatenate((inner_low - low, high - inner_high))
    size = float((high - low).max())
    if np.abs(walls[:2] - walls[2:]).max() > _SAME * size:
        return None
    web, flange = 0.5 * (walls[:2] + walls[2:])
    width, height = high - low
    centre = _turned((low + high) / 2.0, turn)
    if rounded_corners and abs(web - flange) <= 0.1 * min(web, flange):
        return _known("RHS", [height, width, 0.5 * (web + flange)], centre, turn)
    return _known("BOX", [height, width, web, flange], centre, turn)


def _open(outer: FloatArray) -> PlacedSection | None:
    """Flat, angle, channel, T or I, by the number of its corners; each of its four directions is tried."""
    turn = _direction(outer)
    for _ in range(4):
        corners = _square_corners(_turned_back(outer, turn))
        if corners is None:
            return None
        made = {4: _flat, 6: _angle, 8: _channel_or_tee, 12: _i_section}.get(len(corners), lambda _: None)(corners)
        if made is not None:
            shape, sizes = made
            found = _fitted(shape, sizes, corners, turn)
            if found is not None:
                return found
        turn = np.array([-turn[1], turn[0]])
    return None


def _fitted(shape: str, sizes_m: Sequence[float], corners: FloatArray, turn: FloatArray) -> PlacedSection | None:
    """Section of a shape with sizes, where its sharp outline has these corners (k, 2); None where it has not."""
    try:
        sharp = section_named(f"{shape} {'x'.join(map(_text, sizes_m))}")
    except ScenarioError:
        return None
    (ring,) = sharp.rings
    ring = ring - _middle([ring]) + _middle([corners])
    apart = np.array([float(length(corners - point).min()) for point in ring])
    if float(apart.max()) > _SAME * float(np.ptp(corners, axis=0).max()):
        return None
    return _known(shape, sizes_m, _turned(_middle([corners]) - _middle(sharp.rings), turn), turn)


def _known(shape: str, sizes_m: Sequence[float], centre_m: FloatArray, turn: FloatArray) -> PlacedSection | None:
    try:
        return PlacedSection(sized_name(shape, sizes_m), centre_m, turn)
    except ScenarioError:
        return None


def _direction(ring: FloatArray) -> FloatArray:
    """Unit vector (2,) along the longest side of a ring, from -45° to 45° from the x axis."""
    sides = np.roll(ring, -1, axis=0) - ring
    way = unit(sides[int(length(sides).argmax())])
    quarters = round(float(arctangent(way[1], way[0])) / (math.pi / 2.0))
    for _ in range(quarters % 4):
        way = np.array([way[1], -way[0]])
    return np.asarray(way)


def _turned_back(points: FloatArray, turn: FloatArray) -> FloatArray:
    return _turned(points, np.array([turn[0], -turn[1]]))


def _square_corners(ring: FloatArray) -> FloatArray | None:
    """Corners (k, 2) of the outline with right angles that a ring has without roundings; None where it has none such.

    Sides that run along neither axis are roundings. Of sides in one direction that follow each other, between which
    there is no other than roundings, the longest counts, at its middle.
    """
    sides = np.roll(ring, -1, axis=0) - ring
    lengths = length(sides)
    size = float(np.ptp(ring, axis=0).max())
    kept: list[tuple[int, float, float]] = []
    for side, long, middle in zip(sides, lengths.tolist(), ring + sides / 2.0, strict=True):
        if long <= _SHORTEST * size:
            continue
        lean = np.abs(side) / long
        if float(lean.min()) > _SLOPE:
            continue
        axis = int(lean.argmax())  # that it runs along
        level = float(middle[1 - axis])
        if kept and kept[-1][0] == axis:
            kept[-1] = max(kept[-1], (axis, long, level), key=lambda one: one[1])
        else:
            kept.append((axis, long, level))
    if len(kept) > 1 and kept[0][0] == kept[-1][0]:
        kept[0] = max(kept[0], kept.pop(), key=lambda one: one[1])
    if len(kept) < 4 or len(kept) % 2:
        return None
    corners = []
    for (axis, _, level), (_, _, next_level) in zip(kept, kept[1:] + kept[:1], strict=True):
        corners.append((next_level, level) if axis == 0 else (level, next_level))
    return np.array(corners)


def _levels(values: FloatArray, size: float) -> list[float]:
    """Different values, ascending."""
    levels: list[float] = []
    for value in sorted(values.tolist()):
        if not levels or value - levels[-1] > 0.2 * _SAME * size:
            levels.append(value)
    return levels


_Sized = tuple[str, list[float]]


def _flat(corners: FloatArray) -> _Sized | None:
    width, height = np.ptp(corners, axis=0).tolist()
    return "FLAT", [height, width]


def _angle(corners: FloatArray) -> _Sized | None:
    """Height, width and thickness of an angle with its corner at the lower left."""
    (x, z), size = corners.T, float(np.ptp(corners, axis=0).max())
    across, up = _levels(x, size), _levels(z, size)
    if len(across) != 3 or len(up) != 3:
        return None
    plate = across[1] - across[0]
    return "L", [up[2] - up[0], across[2] - across[0], plate]


def _channel_or_tee(corners: FloatArray) -> _Sized | None:
    """Channel that is open to the right, or a T with its flange at the top."""
    (x, z), size = corners.T, float(np.ptp(corners, axis=0).max())
    across, up = _levels(x, size), _levels(z, size)
    if len(across) == 3 and len(up) == 4:
        web, flange = across[1] - across[0], up[1] - up[0]
        return "U", [up[3] - up[0], across[2] - across[0], web, flange]
    if len(across) == 4 and len(up) == 3:
        return "T", [up[2] - up[0], across[3] - across[0], across[2] - across[1], up[2] - up[1]]
    return None


def _i_section(corners: FloatArray) -> _Sized | None:
    """I-section with an upright web, or a plate girder where its flanges differ."""
    (x, z), size = corners.T, float(np.ptp(corners, axis=0).max())
    up = _levels(z, size)
    if len(up) != 4:
        return None
    height = up[3] - up[0]
    top, bottom = up[3] - up[2], up[1] - up[0]
    at_top, at_bottom = (x[np.abs(z - level) < _SAME * size] for level in (up[3], up[0]))
    top_width, bottom_width = float(np.ptp(at_top)), float(np.ptp(at_bottom))
    inner = x[(np.abs(z - up[1]) < _SAME * size) | (np.abs(z - up[2]) < _SAME * size)]
    web = 2.0 * float(np.abs(inner - _middle([corners])[0]).min())
    if abs(top_width - bottom_width) < 0.2 * _SAME * size and abs(top - bottom) < 0.2 * _SAME * size:
        return "I", [height, 0.5 * (top_width + bottom_width), web, 0.5 * (top + bottom)]
    return "PG", [height, web, top_width, top, bottom_width, bottom]
