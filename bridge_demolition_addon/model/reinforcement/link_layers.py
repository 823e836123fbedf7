"""Links of a schedule as bars that are spread over their members, as a run has them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from ...engineering.geometry.sides import AXES
from ..bridge.member import Member
from ..materials.bar_layers import BarLayer
from .schedule import Schedule

_MM = 1e3
_PER_SQUARE_METRE = 1e6

_USUAL_MM = 10.0
"""Diameter of links of which only a ratio is given."""


def link_layers(schedule: Schedule, members: Sequence[Member]) -> Iterator[BarLayer]:
    """Yield the links of a schedule: upright legs of what lies, and legs both ways of columns."""
    extents = {member.name: np.ptp(member.without_skew(member.solid.vertices), axis=0) for member in members}
    yields = [row.layer.yield_n_mm2 for row in schedule.bars]
    for row in schedule.links:
        along = AXES[int(np.argmax(extents[row.members[0]]))]
        for axis in ("x", "y") if along == "z" else ("z",):
            layer = BarLayer(
                members=row.members,
                along=axis,
                spread_mm2_m2=_PER_SQUARE_METRE * row.ratio,
                diameter_mm=_MM * row.diameter_m or _USUAL_MM,
            )
            yield layer if not yields else replace(layer, yield_n_mm2=yields[0])
