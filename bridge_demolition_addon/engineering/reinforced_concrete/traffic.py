"""Traffic on road bridges, lane by lane: load model 1 of EN 1991-2, HL-93 of AASHTO, or loads of one's own."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..arrays import FloatArray
from .influence_lines import MovingLoad

_KILO = 1e3
_ACROSS = 24
"""Points across a lane or a strip at which the effect of its uniform load is taken."""


@dataclass(frozen=True, slots=True)
class Traffic:
    """Loads of a carriageway's lanes.

    Each lane has the same moving loads, one at a time, times its factors: for axles and for its uniform load.
    """

    carriageway_m: float
    lane_m: float
    loads: tuple[MovingLoad, ...]  # of a lane with factors of 1
    axle_factors: tuple[float, ...]  # of each lane, heaviest first
    uniform_factors: tuple[float, ...]
    rest_n_m2: float  # on the carriageway outside the lanes
    wheel_distance_m: float  # across a vehicle
    edge_m: float  # least distance of a wheel from the edge of the carriageway
    presence: tuple[float, ...] = ()  # factor on all lanes by the number of loaded ones; empty for 1

    @property
    def lanes(self) -> int:
        return len(self.axle_factors)

    @property
    def rest_m(self) -> float:
        """Width of the carriageway outside the lanes."""
        return max(self.carriageway_m - self.lanes * self.lane_m, 0.0)

    def presence_of(self, lanes: int) -> float:
        return self.presence[min(lanes, len(self.presence)) - 1] if self.presence and lanes else 1.0

    def on_whole_width(self) -> tuple[MovingLoad, ...]:
        """Return the sum of the lanes' loads."""
        return self._of_lanes([1.0] * self.lanes, [1.0] * self.lanes, self.rest_m)

    def on_part(self, line: Callable[[FloatArray], FloatArray]) -> tuple[MovingLoad, ...]:
        """Return the loads on a part of the bridge, such as a girder, by its influence line across the road.

        Lanes lie side by side wherever on the carriageway that is worst, the heaviest where it acts most.
        """
        slack = self.rest_m
        best: tuple[MovingLoad, ...] = ()
        for shift in np.linspace(0.0, slack, 9 if slack else 1):
            left = -0.5 * self.carriageway_m + shift
            middles = left + self.lane_m * (np.arange(self.lanes) + 0.5)
            wheels = 0.5 * self.wheel_distance_m
            axles = np.maximum(0.5 * (line(middles - wheels) + line(middles + wheels)), 0.0)
            order = np.argsort(-axles, kind="stable")
            uniform = np.array([_mean(line, middle - self.lane_m / 2, middle + self.lane_m / 2) for middle in middles])
            right = left + self.lanes * self.lane_m
            rest = shift * _mean(line, left - shift, left) + (slack - shift) * _mean(line, right, right + slack - shift)
            for loaded in range(1, self.lanes + 1):
                chosen = order[:loaded]
                loads = self._of_lanes(axles[chosen].tolist(), uniform[chosen].tolist(), rest)
                if not best or _weight(loads) > _weight(best):
                    best = loads
        return best

    def _of_lanes(self, axles: Sequence[float], uniform: Sequence[float], rest_m: float) -> tuple[MovingLoad, ...]:
        presence = self.presence_of(len(axles))
        axle = presence * math.fsum(share * factor for share, factor in zip(axles, self.axle_factors, strict=False))
        even = presence * math.fsum(
            share * factor for share, factor in zip(uniform, self.uniform_factors, strict=False)
        )
        return tuple(
            replace(
                load,
                axles_n=tuple(axle * force for force in load.axles_n),
                uniform_n_m=float(even * load.uniform_n_m + rest_m * self.rest_n_m2),
            )
            for load in self.loads
        )

    def clear_m(self, deck_m: float) -> float:
        """Return the least distance of a wheel from the edge of a deck with the carriageway in its middle."""
        return 0.5 * (deck_m - self.carriageway_m) + self.edge_m

    def wheels_across(self, strip_m: float, deck_m: float) -> tuple[MovingLoad, ...]:
        """Return the wheels of one lane, of two and so on, side by side, on a strip of slab that spans across the road.

        `strip_m` is the length along the road over which one axle is spread; loads are those by length along the
        road. `deck_m` is the width of the deck.
        """
        intensity = max(_by_length(load, strip_m) for load in self.loads)
        even = max(load.uniform_n_m for load in self.loads) / self.lane_m
        wheels = 0.5 * self.wheel_distance_m
        across = []
        for loaded in range(1, self.lanes + 1):
            forces, offsets = [], []
            for lane in range(loaded):
                force = 0.5 * self.presence_of(loaded) * self.axle_factors[lane] * intensity
                forces += [force, force]
                offsets += [lane * self.lane_m, lane * self.lane_m + 2.0 * wheels]
            across.append(MovingLoad(tuple(forces), tuple(offsets), even, clear_m=self.clear_m(deck_m)))
        return tuple(across)


def _mean(line: Callable[[FloatArray], FloatArray], begin: float, end: float) -> float:
    middles = begin + (end - begin) * (np.arange(_ACROSS) + 0.5) / _ACROSS
    return float(np.maximum(line(middles), 0.0).mean())


def _weight(loads: Sequence[MovingLoad]) -> float:
    """Measure of loads that differ by factors alone: the sum of the axles, or the uniform load where there are none."""
    return max(math.fsum(load.axles_n) + 10.0 * load.uniform_n_m for load in loads)


def _by_length(load: MovingLoad, strip_m: float) -> float:
    """Largest load of axles by length along the road, each spread over a strip: of one axle, of two and so on."""
    forces, offsets = load.axles_n, load.offsets_m
    groups = [
        math.fsum(forces[first : last + 1]) / (strip_m + offsets[last] - offsets[first])
        for first in range(len(forces))
        for last in range(first, len(forces))
    ]
    return max(groups, default=0.0)


def load_model_1(carriageway_m: float) -> Traffic:
    """Return load model 1 with α = 1: EN 1991-2:2003, 4.3.2 and tables 4.1 and 4.2.

    Axles of 300, 200 and 100 kN, two in each of the first three lanes, 1.2 m apart, with 2 m between their wheels; 9
    kN/m² in the first lane, 2.5 in others and outside them. A carriageway that is narrower than a lane is one.
    """
    if carriageway_m < 5.4:
        lanes, lane = 1, min(3.0, carriageway_m)
    elif carriageway_m < 6.0:
        lanes, lane = 2, carriageway_m / 2.0
    else:
        lanes, lane = int(carriageway_m / 3.0 + 1e-9), 3.0
    axles = (300.0, 200.0, 100.0, *[0.0] * lanes)[:lanes]
    tandem = MovingLoad((_KILO,) * 2, (0.0, 1.2), _KILO * lane)
    wheels = min(2.0, 0.8 * lane)
    return Traffic(
        carriageway_m,
        lane,
        (tandem,),
        axles,
        (9.0, *[2.5] * (lanes - 1)),
        2.5 * _KILO,
        wheels,
        0.5 * (lane - wheels),
    )


def hl_93(carriageway_m: float) -> Traffic:
    """Return HL-93: AASHTO LRFD Bridge Design Specifications, 3.6.1.1 to 3.6.1.3 and 3.6.2.

    In each lane of 3.6 m a truck of 35, 145 and 145 kN, 4.3 m and 4.3 to 9 m apart, or a tandem of 110 kN twice, 1.2 m
    apart, 33 % more for impact, with 9.34 kN/m. Over supports 90 % of that with two trucks, 15 m from the last axle of
    one to the first of the other. Factors for one to four loaded lanes are 1.2, 1, 0.85 and 0.65.
    """
    lanes, lane = max(int(carriageway_m / 3.6 + 1e-9), 1), min(3.6, carriageway_m)
    if 6.0 <= carriageway_m < 7.2:
        lanes, lane = 2, carriageway_m / 2.0
    impact, truck = 1.33 * _KILO, (35.0, 145.0, 145.0)
    uniform = 9.34 * _KILO
    shapes = [((110.0, 110.0), (0.0, 1.2)), (truck, (0.0, 4.3, 8.6)), (truck, (0.0, 4.3, 13.3))]
    loads = [MovingLoad(tuple(impact * force for force in forces), at, uniform) for forces, at in shapes]
    two = tuple(0.9 * impact * force for force in truck * 2)
    loads.append(MovingLoad(two, (0.0, 4.3, 8.6, 23.6, 27.9, 32.2), 0.9 * uniform, hogging_only=True))
    ones = (1.0,) * lanes
    wheels = min(1.8, 0.8 * lane)
    return Traffic(
        carriageway_m,
        lane,
        tuple(loads),
        ones,
        ones,
        0.0,
        wheels,
        min(0.3, 0.5 * (lane - wheels)),
        (1.2, 1.0, 0.85, 0.65),
    )


def own_traffic(
    carriageway_m: float, uniform_n_m2: float, axles_n: Sequence[float], distances_m: Sequence[float]
) -> Traffic:
    """Return a uniform load on the whole carriageway, and one vehicle of axles at distances from one to the next."""
    offsets = (0.0, *np.cumsum(np.array(distances_m, float)).tolist())[: len(axles_n)]
    lane = min(3.0, carriageway_m)
    load = MovingLoad(tuple(axles_n), tuple(offsets), uniform_n_m2 * lane)
    wheels = min(2.0, 0.8 * lane)
    return Traffic(carriageway_m, lane, (load,), (1.0,), (1.0,), uniform_n_m2, wheels, 0.5 * (lane - wheels))


def lever_rule(supports_m: FloatArray, number: int) -> Callable[[FloatArray], FloatArray]:
    """Return what one of several beams carries of a unit load by its position across them.

    The slab is taken for hinged over each beam, and for a cantilever beyond the outer ones: AASHTO LRFD, C4.6.2.2.1.
    """
    if len(supports_m) == 1:
        return np.ones_like
    values = np.eye(len(supports_m))[number]

    def share(positions_m: FloatArray) -> FloatArray:
        after = np.clip(np.searchsorted(supports_m, positions_m), 1, len(supports_m) - 1)
        part = (positions_m - supports_m[after - 1]) / (supports_m[after] - supports_m[after - 1])
        shares: FloatArray = values[after - 1] + part * (values[after] - values[after - 1])
        return shares

    return share


def strip_widths_m(span_m: float, beyond_m: float) -> tuple[float, float]:
    """Return the length along the road over which a slab across beams shares an axle: between them and over them.

    AASHTO LRFD, table 4.6.2.1.3-1, cast in place: 0.66 + 0.55 S, 1.22 + 0.25 S, and 1.14 + 0.833 X of an overhang with
    the wheel at X from the outer beam, `beyond_m`; it is below 0 where no wheel gets there.
    """
    hogging = 1.22 + 0.25 * span_m if span_m > 0.0 else math.inf
    if beyond_m > 0.0:
        hogging = min(hogging, 1.14 + 0.833 * beyond_m)
    return 0.66 + 0.55 * span_m, hogging if math.isfinite(hogging) else 1.22
