"""Areas that fragments of blast zones fall within, for site plans: within a factor of 2, and no safety distance."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from manifold3d import CrossSection

from ...engineering.geometry.plan_areas import united
from .blast_zones import PlacedZone
from .zone_fragments import FlyrockOfZone

DOUBT = "factor 2, no safety distance"

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
