"""Bodies that enter a zone, and when: convex hulls of moving bodies against a prism over a polygon; the exclusion zone.

That is made of plan area, designed drop, predicted debris and a buffer, the four areas of BS 6187:2011, *Code of
practice for full and partial demolition*. How wide the buffer has to be is for the engineer to say: the simulation
knows neither pieces smaller than its shards nor what flies off at an impact.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from manifold3d import CrossSection, JoinType, Manifold

from ...engineering.arithmetic import cosine
from ...engineering.arrays import Rows
from ...engineering.geometry.plan_areas import distances_outside, outlines, signed_area, united
from ...engineering.geometry.solids import hull
from ...engineering.geometry.vectors import length, rotated, rotation_vectors, transformed
from ..results.arrays import Results
from ..results.motion import relative_to_ground
from ..scenario import Exclusion, Zone
from .footprint import corners_at, footprint, swept_footprint

TIME_TOLERANCE_S = 1e-3
"""How well an entry is placed in time between two recorded steps."""

_FAR_M = 1e5
"""Height up to which a zone without a top reaches, and depth of one without a bottom; farther than anything falls."""


@dataclass(frozen=True, slots=True)
class Entry:
    """A body that enters a zone: when its hull first extends into it, and whether it does so at the end as well."""

    body: int
    time_s: float
    stays: bool


@dataclass(frozen=True, slots=True)
class ZoneWatch:
    """Bodies that entered a zone, in order, and those that extended into it from the beginning, such as a pier.

    `mass_within_kg` sums the bodies in it at the end that were not there before, whole bodies counted.
    """

    zone: Zone
    entries: tuple[Entry, ...]
    there_before: tuple[int, ...]
    mass_within_kg: float


def watch_zone(results: Results, zone: Zone, bodies: Rows) -> ZoneWatch:
    """Return the entries of bodies into a zone over a whole run.

    Between two recorded steps a body is taken to move and rotate evenly. Touching is not entering: some volume has to
    be within.
    """
    prism = _Prism.of(zone)
    there_before, entries = [], []
    results = relative_to_ground(results)
    bodies = _coming_near(results, prism, np.asarray(bodies, int))
    before, after = corners_at(results, 0, bodies), corners_at(results, -1, bodies)
    for row, body in enumerate(bodies):
        if prism.meets(before[row]):
            there_before.append(int(body))
        elif (time_s := _first_entry(results, prism, body)) is not None:
            entries.append(Entry(int(body), time_s, prism.meets(after[row])))
    entries.sort(key=lambda entry: entry.time_s)
    mass = math.fsum(float(results.inventory.masses_kg[entry.body]) for entry in entries if entry.stays)
    return ZoneWatch(zone, tuple(entries), tuple(there_before), mass)


@dataclass(frozen=True, eq=False, slots=True)
class _Prism:
    solid: Manifold
    low: np.ndarray
    high: np.ndarray

    @classmethod
    def of(cls, zone: Zone) -> _Prism:
        corners = np.array(zone.corners_m)
        bottom = -_FAR_M if zone.bottom_m is None else zone.bottom_m
        top = _FAR_M if zone.top_m is None else zone.top_m
        if signed_area(corners) < 0.0:
            corners = corners[::-1]
        solid = Manifold.extrude(CrossSection([corners]), top - bottom).translate((0.0, 0.0, bottom))
        return cls(solid, np.append(corners.min(axis=0), bottom), np.append(corners.max(axis=0), top))

    def may_meet(self, low: np.ndarray, high: np.ndarray) -> np.ndarray:
        """Return whether boxes, given by corners (k, 3), overlap the one around the prism."""
        return ((low < self.high) & (high > self.low)).all(axis=-1)

    def meets(self, corners: np.ndarray) -> bool:
        """Return whether the convex hull of corners (v, 3) extends into the prism."""
        if not self.may_meet(corners.min(axis=0), corners.max(axis=0)):
            return False
        return (hull(corners) ^ self.solid).volume() > 0.0


def _coming_near(results: Results, prism: _Prism, bodies: np.ndarray) -> np.ndarray:
    """Return the bodies whose spheres meet the box around a prism on their way from step to step."""
    own = results.inventory.vertices_by_body()
    radii = np.array([float(length(own[body]).max()) for body in bodies])[:, None]
    positions = results.frames.positions_m[:, bodies]
    near = prism.may_meet(positions[0] - radii, positions[0] + radii)
    for before, after in pairwise(positions):
        near |= prism.may_meet(np.minimum(before, after) - radii, np.maximum(before, after) + radii)
    return bodies[near]


def _first_entry(results: Results, prism: _Prism, body: int) -> float | None:
    """Return when a body that is outside at first extends into a zone, s."""
    corners = results.inventory.vertices_of(body)
    radius = float(length(corners).max(initial=0.0))
    positions = results.frames.positions_m[:, body]
    low = np.minimum(positions[:-1], positions[1:]) - radius
    high = np.maximum(positions[:-1], positions[1:]) + radius
    for step in np.flatnonzero(prism.may_meet(low, high)).tolist():
        time_s = _entry_between(_Motion.of(results, step, body, corners), prism, 0.0, 1.0)
        if time_s is not None:
            return time_s
    return None


@dataclass(frozen=True, eq=False, slots=True)
class _Motion:
    """A body between two recorded steps; a share of 0 is the first of them, 1 the second."""

    corners: np.ndarray
    place: np.ndarray
    shift: np.ndarray
    rotation: np.ndarray
    turn: np.ndarray
    start_s: float
    duration_s: float

    @classmethod
    def of(cls, results: Results, step: int, body: int, corners: np.ndarray) -> _Motion:
        steps = slice(step, step + 2)
        positions, rotations = results.frames.positions_m[steps, body], results.frames.rotations[steps, body]
        times = results.frames.time_s[steps]
        turn = rotation_vectors(rotations[0], rotations[1])
        return cls(
            corners, positions[0], positions[1] - positions[0], rotations[0], turn, times[0], times[1] - times[0]
        )

    def at(self, share: float) -> np.ndarray:
        return transformed(rotated(self.rotation, share * self.turn), self.corners) + self.place + share * self.shift

    def bulge_m(self, share: float) -> float:
        """Return the largest distance of a corner's path, between positions a share apart, from a straight line."""
        angle = min(share * float(length(self.turn)), math.pi)
        return float(length(self.corners).max()) * (1.0 - float(cosine(angle / 2.0)))


def _entry_between(motion: _Motion, prism: _Prism, first: float, last: float) -> float | None:
    """Return when a body enters a zone between two shares of its motion, by halving."""
    before, after = motion.at(first), motion.at(last)
    swept = np.concatenate([before, after])
    bulge = motion.bulge_m(last - first)
    if not prism.may_meet(swept.min(axis=0) - bulge, swept.max(axis=0) + bulge):
        return None
    if bulge > 0.0:
        offsets = bulge * np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
        swept = (swept[:, None] + offsets).reshape(-1, 3)
    if not prism.meets(swept):
        return None
    if prism.meets(before):
        return motion.start_s + first * motion.duration_s
    if (last - first) * motion.duration_s <= TIME_TOLERANCE_S:
        # Not there before, and perhaps after: a path that only grazes a corner within this time is no entry.
        return motion.start_s + last * motion.duration_s if prism.meets(after) else None
    middle = (first + last) / 2.0
    earlier = _entry_between(motion, prism, first, middle)
    return _entry_between(motion, prism, middle, last) if earlier is None else earlier


_CIRCLE_SEGMENTS = 64
"""Corners of a full circle around a corner; they lie on the circle, so that its sides cut 0.1 % of the radius."""


@dataclass(frozen=True, eq=False, slots=True)
class ExclusionZone:
    """Areas of an exclusion zone: the bridge's plan, the designed drop area with it, and debris at any time of the run.

    The whole is all of these with the buffer around them.
    """

    plan: CrossSection
    drop: CrossSection
    debris: CrossSection
    whole: CrossSection

    @property
    def largest_distance_m(self) -> float:
        """Return the largest distance of the zone's edge from the bridge's plan."""
        corners = np.concatenate(outlines(self.whole))
        return float(distances_outside(self.plan, corners).max())

    @property
    def bounds_m(self) -> tuple[float, float, float, float]:
        """Return smallest x and y, largest x and y."""
        return tuple(self.whole.bounds())


def exclusion_zone(results: Results, settings: Exclusion) -> ExclusionZone:
    """Return the exclusion zone of a run."""
    results = relative_to_ground(results)
    shards = results.inventory.of_kind("shard")
    plan = footprint(results, shards, 0)
    drop = widened(plan, settings.designed_drop_m)
    debris = swept_footprint(results, np.concatenate([shards, results.inventory.of_kind("ball")]))
    return ExclusionZone(plan, drop, debris, widened(united([plan, drop, debris]), settings.buffer_m))


def widened_around(area: CrossSection, distance_m: float) -> CrossSection:
    """Return an area with everything nearer to it than a distance, and up to 0.13 % of that more: never less."""
    return widened(area, distance_m / float(cosine(math.pi / _CIRCLE_SEGMENTS)))


def widened(area: CrossSection, distance_m: float) -> CrossSection:
    """Return an area with everything nearer to it than a distance."""
    if distance_m <= 0.0:
        return area
    return area.offset(distance_m, JoinType.Round, circular_segments=_CIRCLE_SEGMENTS)
