"""How stiff the connections of a model are, by their faces, materials, and how far shards extend behind them."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ...engineering.elasticity.interfaces import shares_of_length, slips_by_stretching
from ...engineering.elasticity.member_shapes import (
    MemberShapes,
    contraction_ratios,
    contraction_shares,
    in_axes,
    member_shapes,
    moderate_second_moments,
    plate_turning,
    principal_moments,
    ratios_in_lattices,
    shifting_moduli,
    turning_inertias,
    turning_levers,
)
from ...engineering.elasticity.section_stiffness import (
    SectionStiffness,
    section_stiffness,
    whole_section_turning,
)
from ...engineering.geometry.vectors import dot, product, transformed
from ...engineering.mechanics.section_cuts import section_axes
from ...engineering.mechanics.strength import Joint
from ...engineering.structure.connections import GROUND, Connections
from ...errors import GeometryError
from .connection_source import CutMembers

_DEEP = 0.75
"""Part of a member's extent from which on a shard counts as being as deep as the member."""

_WIDE = 0.5
"""Width of a face over the thickness of its member from which on it is a section of that, and no sliver."""

_LEVER = 6.0
"""Longest lever of a face that is not a whole section, over its width by the ratio of that to the distance of points.

Faces as wide as shards are far apart have all of theirs; in slivers, which shear would bend, none is longer than wide.
With it no face of a slab in 40 to 1,000 shards is stressed to more than 1.5 times the strength of its section, without
it some are to 45 times; frames are as stiff with both.
"""


def connection_stiffness(
    connections: Connections,
    second_moments_m4: np.ndarray,
    joints: Sequence[Joint],
    joint_of_connection: np.ndarray,
    cut: CutMembers,
) -> SectionStiffness:
    """Return the stiffness of m connections.

    Parameters
    ----------
    connections, second_moments_m4 : Connections, (m, 2, 2) float
        The connections, and second moments of their faces.
    joints, joint_of_connection : sequence of Joint, (m,) int
        What they have in common, with the moduli of their material, and which of these each is.
    cut : CutMembers
    """
    without = np.flatnonzero(connections.areas <= 0.0)
    if len(without):
        first, second = connections.pairs[without[0]].tolist()
        raise GeometryError(
            f"{len(without)} connections have no area, the first between shards {first} and {second}: elastic "
            "connections need shared faces"
        )
    young, shear = (
        np.array([getattr(joint.moduli, name) for joint in joints])[joint_of_connection]
        for name in ("young_pa", "shear_pa")
    )
    sections, areas = section_axes(connections.normals), connections.areas
    deforms = np.append(~cut.fixed, False)[connections.pairs.T]  # the ground, at index -1, does not
    away = cut.points_m[connections.pairs.T] - connections.points
    lengths = np.abs(dot(away, connections.normals)) * deforms
    deep = [
        _is_deep(ends, sections[:, :, 1:], cut) | ~moves[:, None]
        for ends, moves in zip(connections.pairs.T, deforms, strict=True)
    ]
    is_deep = deep[0] & deep[1]
    shares, slips = _interfaces(connections, second_moments_m4, young, lengths.sum(axis=0), deforms, cut)
    moments = second_moments_m4 * shares[:, ::-1, None] * shares[:, None, ::-1]  # about y counts the length along z
    is_whole = is_deep.all(axis=1) & (_widths(areas, second_moments_m4) >= _WIDE * _thicknesses(connections, cut))
    shapes = member_shapes([member.solid for member in cut.members])
    turning, levers = _turning(connections, moments, sections, shear / young, away, lengths, is_whole, cut, shapes)
    moduli, turning = _with_poisson_effect(connections, turning, sections, young, shear, cut, shapes)
    whole_turning = whole_section_turning(areas, second_moments_m4, shear / young)
    turning = np.where(is_whole[:, None, None], whole_turning, turning)
    turns_freely = np.array([bool(joint.free) for joint in joints])[joint_of_connection]
    levers = np.where(turns_freely[:, None, None], 0.0, levers)  # a bearing turns about its own middle
    return section_stiffness(young, shear, areas, lengths.sum(axis=0), is_deep, turning, levers, slips, moduli)


def _turning(
    connections: Connections,
    second_moments_m4: np.ndarray,
    sections: np.ndarray,
    shear_over_young: np.ndarray,
    away_m: np.ndarray,
    lengths_m: np.ndarray,
    is_whole: np.ndarray,
    cut: CutMembers,
    shapes: MemberShapes,
) -> tuple[np.ndarray, np.ndarray]:
    """Second moments that resist turning, and levers of shifts (m, 3, 3) in the axes of sections: means of both sides.

    The points of the two sides are away (2, m, 3) from the faces, and count by how long they are (2, m).
    """
    inertias = _face_inertias(moderate_second_moments(second_moments_m4), sections)
    widths = _widths(connections.areas, second_moments_m4)
    longest = _LEVER * np.square(widths) / np.maximum(lengths_m.sum(axis=0), 1e-12)
    longest = np.where(is_whole, np.inf, longest)
    of_shards = np.append(cut.member_of_shard, 0)  # the ground, at index -1, has no length
    turning, levers = np.zeros((2, len(connections), 3, 3))
    shares = lengths_m / np.maximum(lengths_m.sum(axis=0), 1e-12)
    for ends, away, share in zip(connections.pairs.T, away_m, shares, strict=True):
        of_members: MemberShapes = shapes.only(of_shards[ends])
        normals = connections.normals
        middles = _middles_behind(away, normals, inertias, connections.areas)
        weights = share[:, None, None]
        turning += weights * turning_inertias(of_members, inertias, normals, shear_over_young)
        levers += weights * turning_levers(of_members, middles, normals, longest)
    return in_axes(sections, turning), in_axes(sections, levers)


def _with_poisson_effect(
    connections: Connections,
    turning_m4: np.ndarray,
    sections: np.ndarray,
    young_pa: np.ndarray,
    shear_pa: np.ndarray,
    cut: CutMembers,
    shapes: MemberShapes,
) -> tuple[np.ndarray, np.ndarray]:
    """Moduli that resist shifts, and second moments that resist turning, (m, 3, 3) in the axes of sections.

    Between two members, where neither decides, faces are as stiff along as across.
    """
    moduli, turning = young_pa[:, None, None] * np.eye(3), turning_m4.copy()
    of_members = cut.members_of(connections.pairs)
    rows = np.flatnonzero((of_members[:, 0] == of_members[:, 1]) & (of_members[:, 0] >= 0))
    within = of_members[rows, 0]
    shards = np.bincount(cut.member_of_shard, minlength=len(cut.members))
    # What is cut in planes across its length has too few inclined faces for it.
    contracts = np.array([not member.keeps_parts for member in cut.members])
    chosen, shares = shapes.only(within), (contracts * contraction_shares(shapes, shards))[within]
    normals, young, shear, frames = connections.normals[rows], young_pa[rows], shear_pa[rows], sections[rows]
    ratios = contraction_ratios(shares, shear / young)
    for member in np.flatnonzero(cut.in_lattices).tolist():
        own = np.flatnonzero(within == member)
        of_lattice = ratios_in_lattices(connections.pairs[rows[own]], cut.points_m[:, :2], (shear / young)[own])
        for values, instead in zip(ratios, of_lattice, strict=True):
            values[own] = instead
    moduli[rows] = in_axes(frames, shifting_moduli(chosen, ratios, normals, young, shear))
    in_world = in_axes(np.swapaxes(frames, 1, 2), turning[rows])
    turning[rows] = in_axes(frames, plate_turning(in_world, chosen, ratios, normals))
    return moduli, turning


def _widths(areas_m2: np.ndarray, second_moments_m4: np.ndarray) -> np.ndarray:
    """The shorter sides (m,) of rectangles with the areas and second moments of faces."""
    smaller, _ = principal_moments(second_moments_m4)
    return np.sqrt(12.0 * smaller / areas_m2)


def _thicknesses(connections: Connections, cut: CutMembers) -> np.ndarray:
    """Thickness (m,) of the thinner of the members that each connection is between."""
    of_members = np.array([member.thickness_m for member in cut.members])
    return np.append(of_members[cut.member_of_shard], np.inf)[connections.pairs].min(axis=1)


def _middles_behind(
    away_m: np.ndarray, normals: np.ndarray, inertias_m4: np.ndarray, areas_m2: np.ndarray
) -> np.ndarray:
    """From the middles of faces to those (m, 3) of what lies between them and points that are away (m, 3).

    Points are not further aside than the face is long: a sliver has no lever that is longer than itself.
    """
    along = dot(away_m, normals)[:, None] * normals
    aside = away_m - along
    squares = dot(aside, aside)
    # A rectangle that is a long has ∫ x² dA = A a² / 12.
    longest = 12.0 * dot(aside, transformed(inertias_m4, aside)) / areas_m2
    shares = np.sqrt(np.minimum(1.0, longest / np.maximum(squares * squares, 1e-24)))
    return np.asarray(0.5 * along + shares[:, None] * aside)


def _face_inertias(second_moments_m4: np.ndarray, sections: np.ndarray) -> np.ndarray:
    """∫ r rᵀ dA (m, 3, 3) of faces in the axes of the world, of second moments (m, 2, 2) about y and z of sections."""
    own = np.zeros((len(sections), 3, 3))
    own[:, 1, 1], own[:, 2, 2] = second_moments_m4[:, 1, 1], second_moments_m4[:, 0, 0]
    own[:, 1, 2] = own[:, 2, 1] = -second_moments_m4[:, 0, 1]
    return product(product(sections, own), np.swapaxes(sections, 1, 2))


def _interfaces(
    connections: Connections,
    second_moments_m4: np.ndarray,
    young_pa: np.ndarray,
    lengths_m: np.ndarray,
    deforms: np.ndarray,
    cut: CutMembers,
) -> tuple[np.ndarray, np.ndarray]:
    """Share of the interface of two members that each face has (m, 2), and how far its shards stretch (m, 2), m/N."""
    shares, slips = np.ones((len(connections), 2)), np.zeros((len(connections), 2))
    in_plane = section_axes(connections.normals)[:, :, 1:]
    sides = np.sqrt(12.0 * second_moments_m4[:, [1, 0], [1, 0]] / connections.areas[:, None])  # along y, along z
    of_members = np.sort(cut.members_of(connections.pairs), axis=1)
    between = deforms.all(axis=0) & (of_members[:, 0] != of_members[:, 1])
    for pair in np.unique(of_members[between], axis=0):
        rows = np.flatnonzero(between & (of_members == pair).all(axis=1))
        thickness = math.fsum(cut.members[index].thickness_m for index in pair.tolist())
        shares[rows] = shares_of_length(connections.points[rows], in_plane[rows], sides[rows], thickness)
        lengths = np.array([_common_sides(cut, connections.pairs[row], in_plane[row]) for row in rows])
        slips[rows] = slips_by_stretching(
            shares[rows], lengths, young_pa[rows], connections.areas[rows], lengths_m[rows]
        )
    return shares, slips


def _common_sides(cut: CutMembers, pair: np.ndarray, in_plane: np.ndarray) -> np.ndarray:
    """How long the shorter of two shards is along each of two axes, the columns (3, 2)."""
    vertices = (cut.shards[shard].vertices for shard in pair.tolist())
    return np.minimum(*(np.ptp(transformed(in_plane.T, corners), axis=0) for corners in vertices))


def _is_deep(chosen: np.ndarray, axes: np.ndarray, cut: CutMembers) -> np.ndarray:
    """Whether shards (m,) are as deep as their members along axes (m, 3, 2); the ground is."""
    deep = np.ones((len(chosen), 2), bool)
    for row, shard in enumerate(chosen.tolist()):
        if shard == GROUND:
            continue
        member = cut.members[cut.member_of_shard[shard]].solid.vertices
        for side in range(2):
            axis = axes[row, :, side]
            deep[row, side] = np.ptp(dot(cut.shards[shard].vertices, axis)) >= _DEEP * np.ptp(dot(member, axis))
    return deep
