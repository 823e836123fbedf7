"""Verify a zone: which runs left it, of those that came after it was fixed.

A zone that is drawn around runs holds these runs, and says little of others. One that stands in the scenario was fixed
before any run of that scenario; so how many of these leave it says how likely the next one does.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from manifold3d import CrossSection

from ...engineering.geometry.plan_areas import signed_area
from ...texts import Text
from ..scenario import Zone
from .conclusions import Proportion, proportion

_BEYOND_M2 = 1e-4
"""Area beyond a zone that counts; outlines are kept to a millimetre."""


def zone_area(zone: Zone) -> CrossSection:
    """Return what a zone covers in plan."""
    corners = np.array(zone.corners_m, float)
    return CrossSection([corners if signed_area(corners) > 0.0 else corners[::-1]])


def holds(zone: Zone, area: CrossSection) -> bool:
    """Return whether an area lies within a zone."""
    return (area - zone_area(zone)).area() <= _BEYOND_M2


def proportion_leaving(zone: Zone, swept: Iterable[Sequence[np.ndarray] | None], confidence: float) -> Proportion:
    """Return how often debris leaves a zone in plan that was fixed before the runs.

    Each run has outlines (k, 2) of all that its debris covered at any time, or None where it did not finish, which
    counts as one that left the zone.
    """
    left = [rings is None or (bool(len(rings)) and not holds(zone, CrossSection(list(rings)))) for rings in swept]
    return proportion(Text("left the zone {}", zone.name), np.array(left, bool), confidence)
