"""Bars between two nodes: where they are cut into pieces, what each joint of these stands for, and how stiff it is.

A bar runs from node to node, and is cut across its axis. Between pieces, and between them and the nodes, are joints: of
a bar in n pieces there are n + 1. Pieces are rigid, and each joint deforms as much as a length of the bar about it
would, so that all together are the whole bar, from node to node. A joint in the middle of its length has the rotation
that a bending moment which changes evenly along it gives, so that errors fall with the square of that length.

A bar begins where the plates of its node end. What is within these goes with the node, as mass. A joint to a node lies
there, and stands for twice that length; where the bar turns freely, it lies at the node itself, as a pin does.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from manifold3d import triangulate

from ..arithmetic import cosine, sine
from ..arrays import BoolArray, FloatArray
from ..elasticity.section_stiffness import ElasticModuli
from ..geometry.mesh import TriangleMesh
from ..geometry.vectors import dot, length, product, transformed, unit
from .sections import SteelSection

_STRAIGHT = 0.9998
"""Cosine of 1°, beyond which one bar goes on where another ends."""


@dataclass(frozen=True, slots=True, eq=False)
class SteelBar:
    """A bar between two nodes.

    Attributes
    ----------
    section : SteelSection
    begin_m, end_m : (3,) float
        Ends of its axis: positions of its nodes, or off them where it is joined eccentrically.
    axes : (3, 3) float
        Along it and along y and z of its section, as columns.
    within_m : (2,) float
        Length of it within the plates of each node.
    turns : (2, 2) bool
        Whether it turns freely at each end about y and z.
    pieces : int
    bow_m : (2,) float
        How far its middle is out of the straight line along y and z of its section: a half wave from node to node.
    """

    section: SteelSection
    begin_m: FloatArray
    end_m: FloatArray
    axes: FloatArray
    within_m: FloatArray
    turns: BoolArray
    pieces: int
    bow_m: FloatArray

    @property
    def length_m(self) -> float:
        """From node to node."""
        return float(length(self.end_m - self.begin_m))

    @property
    def cuts_m(self) -> FloatArray:
        """Where its pieces begin and end (n + 1,), from its first node."""
        return np.concatenate(([self.within_m[0]], self._shared_m[1:-1], [self.length_m - self.within_m[1]]))

    @property
    def joints_m(self) -> FloatArray:
        """Where its joints lie (n + 1,), from its first node."""
        joints = self.cuts_m
        for end, node in ((0, 0.0), (-1, self.length_m)):
            joints[end] = node if self.turns[end].any() else joints[end]
        return joints

    @property
    def lengths_m(self) -> FloatArray:
        """Length of the bar that each joint stands for, (n + 1,)."""
        limits = self._limits_m
        return np.diff(limits)

    @property
    def turns_as_m(self) -> FloatArray:
        """Where pieces turn and stretch as the bar does (n,), from its first node: between what joints stand for."""
        return self._limits_m[1:-1]

    def at(self, along_m: FloatArray) -> FloatArray:
        """Return positions (k, 3) on its axis, by those along it (k,)."""
        wave = sine(math.pi * along_m / self.length_m)
        return np.asarray(
            self.begin_m
            + along_m[:, None] * self.axes[:, 0]
            + wave[:, None] * transformed(self.axes[:, 1:], self.bow_m)
        )

    @property
    def _limits_m(self) -> FloatArray:
        """Ends of the lengths that joints stand for, (n + 2,)."""
        whole = self.length_m
        first, last = 2.0 * self.within_m[0], whole - 2.0 * self.within_m[1]
        if self.pieces == 1:
            return np.array([0.0, 0.5 * whole, whole])
        inner = first + (last - first) * np.arange(self.pieces) / (self.pieces - 1)
        return np.concatenate(([0.0], inner, [whole]))

    @property
    def _shared_m(self) -> FloatArray:
        """Middles of these lengths (n + 1,)."""
        limits = self._limits_m
        return 0.5 * (limits[1:] + limits[:-1])


def bar_axes(begin_m: FloatArray, end_m: FloatArray, roll_rad: float) -> FloatArray:
    """Return the axes (3, 3) of a bar as columns: y level and z as steep as can be, then rolled about x.

    In an upright bar z is along the world's x, which is along the road, as in `mechanics.section_forces`.
    """
    along = unit(end_m - begin_m)
    steepest = np.array((1.0, 0.0, 0.0) if float(length(along[:2])) < 1e-6 else (0.0, 0.0, 1.0))
    y = unit(np.cross(steepest, along))
    z = np.cross(along, y)
    c, s = float(cosine(roll_rad)), float(sine(roll_rad))
    return np.column_stack((along, c * y + s * z, c * z - s * y))


def extruded(section: SteelSection, bar_axes: FloatArray, begin_m: FloatArray, end_m: FloatArray) -> TriangleMesh:
    """Return a section as a solid between two positions (3,) on the axis of a bar."""
    outline = np.concatenate(section.rings)
    across = transformed(bar_axes[:, 1:], outline)
    count = len(outline)
    cap = np.asarray(triangulate(list(section.rings)), np.int64)
    sides, first = [], 0
    for ring in section.rings:
        here = first + np.arange(len(ring))
        following = np.roll(here, -1)
        sides += [
            np.column_stack((here, following, following + count)),
            np.column_stack((here, following + count, here + count)),
        ]
        first += len(ring)
    triangles = np.concatenate([cap[:, ::-1], cap + count, *sides])
    return TriangleMesh(np.concatenate((begin_m + across, end_m + across)), triangles)


def node_radius_m(directions: FloatArray, outlines: list[FloatArray], to_axes_m: FloatArray | None = None) -> float:
    """Return how far from a node its bars begin, so that none lies in another.

    Bars (k,) leave it in directions (k, 3); `outlines` are the points (p, 3) of their sections about their axes, which
    miss the node by `to_axes_m` (k, 3). Two that are as wide, at an angle θ, meet at half of their width by tan(θ / 2).
    A bar that goes on straight, or ends, begins at half of the distance of its farthest edge.
    """
    sizes = [float(np.sqrt(dot(points, points)).max()) for points in outlines]
    radius = 0.5 * max(sizes)
    if to_axes_m is not None:
        outlines = [outline + to_axis for outline, to_axis in zip(outlines, to_axes_m, strict=True)]
    for one in range(len(directions)):
        for other in range(one):
            alike = float(dot(directions[one], directions[other]))
            if alike <= -_STRAIGHT:
                continue
            half = max(
                _half_width(outlines[row], directions[row], directions[one + other - row]) for row in (one, other)
            )
            radius = max(radius, half * math.sqrt((1.0 + alike) / max(1.0 - alike, 1e-12)))
    return radius


def node_points(bars: list[tuple[FloatArray, FloatArray]], radius_m: float) -> FloatArray:
    """Return points (p, 3) about a node whose hull is its plates: the sections of its bars where these begin.

    `bars` are directions (3,) and points (p, 3) of sections about the axes. Where all of them lie in one plane, as of a
    bar that ends, they also count behind the node.
    """
    ends = [radius_m * direction + outline for direction, outline in bars]
    directions = np.array([direction for direction, _ in bars])
    if (np.abs(dot(directions, directions[0])) > _STRAIGHT).all():
        ends += [outline - radius_m * direction for direction, outline in bars]
    return np.concatenate(ends)


def joint_stiffness(bar: SteelBar, moduli: ElasticModuli) -> FloatArray:
    """Return the stiffness (n + 1, 6, 6) of the joints of a bar in its own axes, as `SectionStiffness` has it."""
    section, young, shear = bar.section, moduli.young_pa, moduli.shear_pa
    whole = np.zeros((6, 6))
    whole[[0, 1, 2], [0, 1, 2]] = young * section.area_m2, *(shear * section.shear_areas_m2)
    whole[3, 3] = shear * section.torsion_m4
    whole[4:, 4:] = young * section.shape.second_moments_m4
    stiffness: FloatArray = whole / bar.lengths_m[:, None, None]
    for end in (0, -1):
        for axis in np.flatnonzero(bar.turns[end]).tolist():
            _let_turn(stiffness[end], 4 + axis)
    return stiffness


def in_other_axes(stiffness: FloatArray, rotations: FloatArray) -> FloatArray:
    """Return stiffness (k, 6, 6) in other axes, with columns (k, 3, 3) given in the axes of the stiffness."""
    both = np.zeros_like(stiffness)
    both[:, :3, :3] = both[:, 3:, 3:] = rotations
    return product(np.swapaxes(both, 1, 2), product(stiffness, both))


def _half_width(outline: FloatArray, direction: FloatArray, towards: FloatArray) -> float:
    """Half of the width of a section across its axis, in the plane of this and of another direction."""
    aside = towards - float(dot(towards, direction)) * direction
    size = float(length(aside))
    return float(np.abs(dot(outline, aside / size)).max()) if size > 0.0 else 0.0


def _let_turn(stiffness: FloatArray, row: int) -> None:
    """Take a rotation out of a stiffness (6, 6): a static condensation."""
    column = stiffness[:, row] / stiffness[row, row]
    stiffness -= np.outer(column, stiffness[row])
    stiffness[row], stiffness[:, row] = 0.0, 0.0
