"""Fragments of blast zones that are smaller than shards, and how far they fly: within a factor of 2, and no safety
distance."""

from __future__ import annotations

import zlib
from dataclasses import dataclass

import numpy as np

from ...engineering.drilled_charges.flyrock import lundborg_range_m, mckenzie_range_m, speed_for_range_m_s
from ...engineering.drilled_charges.fragments import (
    Fragments,
    HeightsAt,
    Ranges,
    landings_m,
    mean_size_m,
    ranges_m,
    sampled_directions,
    sampled_speeds_m_s,
    size_of_share_m,
)
from ..schema import given
from .blast_zones import PlacedZone

FRAGMENTS_A_ZONE = 2000

HAZARD_KG = 0.1
"""Lighter fragments do not count for ranges."""

NO_SAFETY_DISTANCE = "within a factor of 2, and no safety distance"

_LEAST_SHARE, _MOST_SHARE = 1e-4, 1.0 - 1e-4
"""Sizes lie between those that so much of the mass is smaller than: the law has no end of its own."""


@dataclass(frozen=True, slots=True)
class FlyrockOfZone:
    """How far fragments of a zone fly, m: sampled ones with their cover, and by two rules without one."""

    sampled: Ranges
    lundborg_m: float
    mckenzie_m: float


def zone_fragments(placed: PlacedZone, seed: int = 0) -> Fragments:
    """Return fragments of a zone as they leave the free faces beside its rows, the same for the same seed."""
    zone, generator = placed.zone, np.random.default_rng([seed, zlib.crc32(given(placed.zone.name).encode())])
    count = FRAGMENTS_A_ZONE
    mean_m = mean_size_m(placed.specific_kg_m3, zone.charge_kg, zone.made_of.relative_strength)
    shares = _LEAST_SHARE + (_MOST_SHARE - _LEAST_SHARE) * generator.random(count)
    largest_m_s = float(speed_for_range_m_s(lundborg_range_m(zone.hole_diameter_m)))
    speeds = sampled_speeds_m_s(count, placed.fragment_speed_m_s, largest_m_s, generator)
    positions = placed.box_m[0] + generator.random((count, 3)) * (placed.box_m[1] - placed.box_m[0])
    across, velocities = zone.axes[2], np.zeros((count, 3))
    leaves_high = generator.random(count) < 0.5
    for is_high, sign in ((True, 1.0), (False, -1.0)):
        rows = np.flatnonzero(leaves_high == is_high)
        normal = sign * np.eye(3)[across]
        velocities[rows] = speeds[rows, None] * sampled_directions(len(rows), normal, generator)
        positions[rows, across] = placed.box_m[int(is_high), across]
    return Fragments(size_of_share_m(shares, mean_m), positions, velocities, placed.density_kg_m3)


def flyrock_of(placed: PlacedZone, heights_at: HeightsAt | None = None, seed: int = 0) -> FlyrockOfZone:
    """Return how far fragments of a zone with explosive in it fly, over level ground or ground with such heights."""
    fragments = zone_fragments(placed, seed)
    landings = landings_m(fragments, heights_at)
    diameter_m = placed.zone.hole_diameter_m
    return FlyrockOfZone(
        ranges_m(placed.box_m.mean(axis=0), landings, fragments.masses_kg, HAZARD_KG),
        float(lundborg_range_m(diameter_m)),
        float(mckenzie_range_m(diameter_m, placed.scaled_burial)),
    )
