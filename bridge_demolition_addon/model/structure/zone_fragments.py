"""Fragments of blast zones that are smaller than shards, how far they fly, and areas for site plans: within a factor of
2, and no safety distance."""

from __future__ import annotations

import zlib
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from manifold3d import CrossSection

from ...engineering.drilled_charges.fragments import (
    Fragments,
    HeightsAt,
    Ranges,
    landings_m,
    lundborg_range_m,
    mckenzie_range_m,
    mean_size_m,
    ranges_m,
    sampled_directions,
    sampled_speeds_m_s,
    size_of_share_m,
    speed_for_range_m_s,
)
from ...engineering.geometry.plan_areas import united
from ...texts import Text
from ..schema import given
from .blast_zones import PlacedZone

FRAGMENTS_A_ZONE = 2000

HAZARD_KG = 0.1
"""Lighter fragments do not count for ranges."""

NO_SAFETY_DISTANCE = Text("within a factor of 2, and no safety distance")

_LEAST_SHARE, _MOST_SHARE = 1e-4, 1.0 - 1e-4
"""Sizes lie between those that so much of the mass is smaller than: the law has no end of its own."""


@dataclass(frozen=True, slots=True)
class FlyrockOfZone:
    """How far fragments of a zone fly, m: sampled ones with their cover, and by two rules without one."""

    sampled: Ranges
    lundborg_m: float
    mckenzie_m: float


def zone_fragments(placed: PlacedZone, seed: int = 0) -> Fragments:
    """Return fragments of a zone as they leave the free faces along its rows, the same for the same seed."""
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
    return flyrock_of_zones([placed], heights_at, seed)[0]


def flyrock_of_zones(
    zones: Sequence[PlacedZone], heights_at: HeightsAt | None = None, seed: int = 0
) -> tuple[FlyrockOfZone, ...]:
    """Return the flyrock of zones with explosive in them; all fragments that count fly at once, which is quicker."""
    if not zones:
        return ()
    thrown = [zone_fragments(placed, seed) for placed in zones]
    counted = [fragments.of(fragments.masses_kg >= HAZARD_KG) for fragments in thrown]
    landings = landings_m(Fragments.joined(counted), heights_at)
    ends = np.cumsum([len(fragments.sizes_m) for fragments in counted])[:-1]
    return tuple(
        FlyrockOfZone(
            ranges_m(placed.box_m.mean(axis=0), landed, fragments.masses_kg, HAZARD_KG),
            float(lundborg_range_m(placed.zone.hole_diameter_m)),
            float(mckenzie_range_m(placed.zone.hole_diameter_m, placed.scaled_burial)),
        )
        for placed, fragments, landed in zip(zones, counted, np.split(landings, ends), strict=True)
    )


DOUBT = Text("factor 2, no safety distance")

_SEGMENTS = 96

_PARTS = (("50 %", "half_m"), ("99 %", "most_m"), ("99.9 %", "nearly_all_m"))


def fragment_areas(zones: Sequence[PlacedZone], flown: Sequence[FlyrockOfZone | None]) -> dict[str, CrossSection]:
    """Return areas with parts of the mass in fragments, the largest first; empty where no zone has explosive.

    Around the middle of each zone they are circles with the distances that its fragments fly.
    """
    pairs = [(placed, of) for placed, of in zip(zones, flown, strict=True) if of is not None]
    if not pairs:
        return {}
    return {
        f"fragments {share}: {DOUBT}": united([_circle(placed, getattr(of.sampled, name)) for placed, of in pairs])
        for share, name in reversed(_PARTS)
    }


def zone_areas(zones: Sequence[PlacedZone]) -> dict[str, CrossSection]:
    """Return where zones are in plan, by their names."""
    return {f"blast zone {placed.zone.name}": _box(placed.box_m) for placed in zones}


def _circle(placed: PlacedZone, radius_m: float) -> CrossSection:
    x, y, _ = placed.box_m.mean(axis=0).tolist()
    return CrossSection.circle(max(radius_m, 1e-3), _SEGMENTS).translate((x, y))


def _box(box_m: np.ndarray) -> CrossSection:
    (low_x, low_y, _), (high_x, high_y, _) = box_m.tolist()
    return CrossSection([[(low_x, low_y), (high_x, low_y), (high_x, high_y), (low_x, high_y)]])
