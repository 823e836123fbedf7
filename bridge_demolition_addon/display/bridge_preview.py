"""Lines of what is built or about to be: outlines of a bridge and its ball from their sizes, and reinforcing bars."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh, plane_cuts, triangle_areas_and_normals
from ..engineering.geometry.vectors import dot
from ..model.bridge import deck_top_at
from ..model.bridge.member import Member, own_axes
from ..model.bridge.substructure import substructure
from ..model.bridge.superstructure import superstructure
from ..model.materials import BarLayer
from ..model.scenario import Ball, Bridge
from ..model.scenario.ball import BallCable
from ..model.schema import given
from .ground_lines import cross_lines, way_lines

_SHARP_DEG = 1.0
"""Triangles that meet at less than this are parts of one face, and their common side is not drawn."""

_CIRCLE_PARTS = 48
_ARC_PARTS = 24
_CROSS_M = 0.5


def bridge_edges(bridge: Bridge) -> np.ndarray:
    """Return the members' edges as lines (2 k, 3) float, m; neither densities nor merging matter for them."""
    members = (*superstructure(bridge), *substructure(bridge))
    return np.concatenate([sharp_edges(member.solid) for member in members])


def ball_lines(ball: Ball, surface: Callable[[float, float], float] | None) -> np.ndarray:
    """Return a ball before each of its drops, with its way and its target, as lines (2 k, 3) float, m.

    `surface` says how high what it falls on is, m; where that is not known, only a ball on a cable is drawn.
    """
    parts = [np.zeros((0, 3))]
    if ball.cable:
        parts += [*_sphere(ball.cable.start_m, ball.diameter_m), *_swing(ball.cable)]
    elif surface is not None:
        for drop in ball.drops:
            surface_m = surface(*given(drop.target_m))
            target = np.array((*given(drop.target_m), surface_m))
            height = surface_m + given(drop.drop_height_m) + ball.diameter_m / 2.0
            start = (target[0], target[1], height)
            parts += [*_sphere(start, ball.diameter_m), np.stack((start, target)), cross_lines(target, _CROSS_M)]
    return np.concatenate(parts)


def outline(bridge: Bridge | None, ball: Ball | None, *, is_all: bool = True) -> np.ndarray:
    """Return bridge and ball as lines (2 k, 3) float, m.

    Without `is_all` the ball may fall on something else than the bridge, and the height of its drop is not known.
    """
    parts = [np.zeros((0, 3))]
    if bridge:
        parts.append(bridge_edges(bridge))
    if ball:
        parts.append(ball_lines(ball, partial(deck_top_at, bridge) if bridge and is_all else None))
    return np.concatenate(parts)


def sharp_edges(mesh: TriangleMesh) -> np.ndarray:
    """Return the edges of a mesh at which its faces meet at an angle, as lines (2 k, 3) float, m."""
    triangles = mesh.triangles
    edges = np.sort(triangles[:, (0, 1, 1, 2, 2, 0)].reshape(-1, 2), axis=1)
    _, normals = triangle_areas_and_normals(mesh.corners)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    edges, normals = edges[order], np.repeat(normals, 3, axis=0)[order]
    firsts, lasts = edges[::2], edges[1::2]  # a closed surface has every edge twice
    if len(edges) % 2 or (firsts != lasts).any():
        raise ValueError("the surface is not closed")
    is_sharp = dot(normals[::2], normals[1::2]) < math.cos(math.radians(_SHARP_DEG))
    return mesh.vertices[firsts[is_sharp]].reshape(-1, 3)


def _sphere(middle: tuple[float, float, float] | np.ndarray, diameter_m: float) -> Iterator[np.ndarray]:
    """Give three circles about the axes."""
    angles = np.linspace(0.0, 2.0 * math.pi, _CIRCLE_PARTS + 1)
    flat = 0.5 * diameter_m * np.column_stack((np.cos(angles), np.sin(angles), np.zeros_like(angles)))
    for turn in range(3):
        yield way_lines(middle + np.roll(flat, turn, axis=1))


def _swing(cable: BallCable) -> Iterator[np.ndarray]:
    """Give the cable, and the way of the ball's middle down to its lowest point."""
    crane, start = np.array(cable.crane_point_m), np.array(cable.start_m)
    yield np.stack((crane, start))
    angles = np.linspace(math.radians(cable.angle_degrees), 0.0, _ARC_PARTS + 1)
    azimuth = math.radians(cable.azimuth_degrees)
    aside = cable.length_m * np.sin(angles)
    arc = np.column_stack((aside * math.cos(azimuth), aside * math.sin(azimuth), -cable.length_m * np.cos(angles)))
    yield way_lines(crane + arc)


_BAR_MM2 = 314.0
"""Area of a bar of 20 mm: a layer has as many lines as it would have of these."""

_MOST_LINES = 40
_FEWEST_LINES = 2
_PARTS = 8
"""Straight parts of a bar that follows a curved member."""


def bar_lines(layers: Sequence[BarLayer], members: Sequence[Member]) -> np.ndarray:
    """Return the bars of layers in their members as lines (2 k, 3), m, spread evenly as bars of 20 mm, at most 40."""
    parts = [np.zeros((0, 3))]
    for member in members:
        for layer in layers:
            if not layer.is_spread and layer.is_in(member.name, member.kind):
                parts += _in_own_axes(layer, member) if layer.own_axes else _of_layer(layer, member)
    return np.concatenate(parts)


def _of_layer(layer: BarLayer, member: Member) -> Iterator[np.ndarray]:
    along, across, beside = layer.axes
    corners = member.without_skew(member.solid.corners)
    lowest, highest = float(corners[..., across].min()), float(corners[..., across].max())
    level = layer.level_m(lowest, highest)
    _, cuts = plane_cuts(corners, across, level)
    if not len(cuts):
        return
    low, high = float(cuts[..., beside].min()), float(cuts[..., beside].max())
    number = int(np.clip(round(given(layer.area_mm2) / _BAR_MM2), _FEWEST_LINES, _MOST_LINES))
    for position in low + (high - low) * (np.arange(number) + 0.5) / number:
        ends = _ends_at(cuts, along, beside, float(position))
        begin, end = max(min(ends), layer.ends_m[0]), min(max(ends), layer.ends_m[1])
        if begin < end:
            bends = member.line.stations_m if member.line and along == 0 else np.zeros(0)
            places = np.array([begin, *bends[(bends > begin) & (bends < end)], end])
            line = np.zeros((len(places), 3))
            line[:, along], line[:, across], line[:, beside] = places, level, position
            yield np.repeat(member.with_skew(line), 2, axis=0)[1:-1]


def _in_own_axes(layer: BarLayer, member: Member) -> Iterator[np.ndarray]:
    """Yield the lines of a layer that follows its member, in straight parts."""
    along, across, beside = layer.axes
    axes = own_axes(member)
    level = layer.level_m(*axes.ends_m(across))
    low, high = axes.ends_m(beside)
    if across == 2 and beside == 1:
        inside = 0.5 * ((high - low) - axes.width_at_m(level))
        low, high = low + inside, high - inside
    ends = axes.ends_m(along)
    begin, end = max(ends[0], layer.ends_m[0]), min(ends[1], layer.ends_m[1])
    number = int(np.clip(round(given(layer.area_mm2) / _BAR_MM2), _FEWEST_LINES, _MOST_LINES))
    for position in low + (high - low) * (np.arange(number) + 0.5) / number:
        points = np.zeros((_PARTS + 1, 3))
        points[:, along] = np.linspace(begin, end, _PARTS + 1)
        points[:, across], points[:, beside] = level, position
        line = axes.to_world(points)
        yield np.repeat(line, 2, axis=0)[1:-1]


def _ends_at(cuts: np.ndarray, along: int, beside: int, position: float) -> list[float]:
    """Return where a line along an axis, at a position off it, crosses the sides (c, 2, 3) of a plane section."""
    first, second = cuts[:, 0], cuts[:, 1]
    before, after = first[:, beside] - position, second[:, beside] - position
    crossed = (before > 0.0) != (after > 0.0)
    share = before[crossed] / (before[crossed] - after[crossed])
    ends = first[crossed, along] + share * (second[crossed, along] - first[crossed, along])
    return ends.tolist() or [0.0]
