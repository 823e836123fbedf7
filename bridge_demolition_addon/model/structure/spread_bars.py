"""Bars that are spread over a member, such as links, and what of them crosses the faces that shards share.

A crack with the normal n and the area A is crossed by ρ |n · e| A of bars along e, with ρ of steel in each area across
them. So a plane crack at an angle θ in a beam has links for V = A_sw / s · z f_y cot θ: EN 1992-1-1:2004, equation 6.8.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...engineering.elasticity.bar_rupture import mean_strain_at_rupture, spacing_of_ratio_m, tensile_strength_pa
from ...engineering.elasticity.steel_bars import Steel
from ...engineering.geometry.sides import AXES
from ...engineering.structure.connections import Connections
from ..bridge.member import Member
from ..materials.bar_layers import BarLayer


@dataclass(frozen=True, slots=True)
class SpreadBars:
    """Spread bars of a member, which is `length_m` long along them."""

    member: int
    layer: BarLayer
    length_m: float

    @property
    def along(self) -> int:
        """Return the axis that the bars run along."""
        return AXES.index(self.layer.along)

    def pulls_n(self, connections: Connections, factor: float) -> np.ndarray:
        """Return the forces (m,) at which the bars across connections yield, which are so many times as strong."""
        crossed_m2 = abs(connections.normals[:, self.along]) * connections.areas
        return factor * self.layer.ratio * self.layer.yield_pa * crossed_m2

    def opening_m(self, compressive_pa: float, steel: Steel) -> float:
        """Return the opening of one crack at which they rupture: of the length between cracks, or of all of it."""
        layer, tensile_pa = self.layer, tensile_strength_pa(compressive_pa)
        spacing_m = min(spacing_of_ratio_m(layer.diameter_m, layer.ratio), self.length_m)
        own = replace(steel, yield_pa=layer.yield_pa)
        return spacing_m * mean_strain_at_rupture(own, layer.diameter_m, spacing_m, tensile_pa)


def spread_bars(layers: Sequence[BarLayer], members: Sequence[Member]) -> Iterator[SpreadBars]:
    """Yield the spread bars of each member."""
    for layer in layers:
        if not layer.is_spread:
            continue
        for index, member in enumerate(members):
            if layer.is_in(member.name, member.kind):
                lengths = np.ptp(member.solid.vertices, axis=0)
                yield SpreadBars(index, layer, float(lengths[AXES.index(layer.along)]))
