# SPDX-License-Identifier: GPL-3.0-or-later
"""A grillage of beams: T-beams along the road, and the slab in beams across it, by the direct stiffness method.

Nodes move down and turn about both level axes. Beams bend by Euler and Bernoulli and twist by Saint-Venant.
E. C. Hambly (1991), Bridge Deck Behaviour, chapter 3.
"""

from dataclasses import dataclass, field

import numpy as np


@dataclass
class Grillage:
    """Girders under a slab, which is `stations_m` (s,) long in all and has its girders at `girders_m` (g,)."""

    girders_m: np.ndarray
    stations_m: np.ndarray
    slab_m: float
    web_m: tuple[float, float]  # width and depth
    widths_m: np.ndarray  # (g,), of the slab of each
    young_pa: float
    shear_pa: float
    loads: np.ndarray = field(init=False)

    def __post_init__(self):
        count = len(self.girders_m) * len(self.stations_m)
        self._stiffness = np.zeros((3 * count, 3 * count))
        self.loads = np.zeros(3 * count)
        for girder in range(len(self.girders_m)):
            bending, torsion = self.girder(girder)
            for station in range(len(self.stations_m) - 1):
                ends = self.node(girder, station), self.node(girder, station + 1)
                length = self.stations_m[station + 1] - self.stations_m[station]
                self._beam(ends, length, self.young_pa * bending, self.shear_pa * torsion, 0)
        for station in range(len(self.stations_m)):
            wide = self._tributary_m(station)
            bending, torsion = wide * self.slab_m**3 / 12.0, wide * self.slab_m**3 / 6.0
            for girder in range(len(self.girders_m) - 1):
                ends = self.node(girder, station), self.node(girder + 1, station)
                length = self.girders_m[girder + 1] - self.girders_m[girder]
                stiff = self.young_pa * bending, self.shear_pa * torsion
                self._beam(ends, length, *stiff, 1)

    def node(self, girder, station):
        return girder * len(self.stations_m) + station

    def put(self, x_m, y_m, force_n):
        """Put a force on the deck, by the lever rule between nodes."""
        for station, along in self._beside(self.stations_m, x_m):
            for girder, across in self._beside(self.girders_m, y_m):
                self.loads[3 * self.node(girder, station)] += along * across * force_n

    def put_weight(self, density_n_m3):
        web = self.web_m[0] * self.web_m[1]
        for girder, wide in enumerate(self.widths_m):
            for station in range(len(self.stations_m)):
                section = web + wide * self.slab_m
                self.loads[3 * self.node(girder, station)] += density_n_m3 * section * self._tributary_m(station)

    def reactions_n(self, supports_m):
        """Return the upward forces (supports, girders) of rigid bearings, on which girders turn along the road."""
        held = [
            (row, girder, self.node(girder, int(np.argmin(abs(self.stations_m - at_m)))))
            for row, at_m in enumerate(supports_m)
            for girder in range(len(self.girders_m))
        ]
        # Bearings lie along a line across the girder, which does not twist there.
        fixed = [3 * node for _, _, node in held] + [3 * node + 1 for _, _, node in held]
        free = np.setdiff1d(np.arange(len(self.loads)), fixed)
        moved = np.zeros(len(self.loads))
        moved[free] = np.linalg.solve(self._stiffness[np.ix_(free, free)], self.loads[free])
        forces = self.loads - self._stiffness @ moved
        found = np.zeros((len(supports_m), len(self.girders_m)))
        for row, girder, node in held:
            found[row, girder] = forces[3 * node]
        return found

    def girder(self, girder):
        """Second moment of area and torsion constant of a T-beam; its slab twists half as much as a bar."""
        (wide, deep), slab = self.web_m, (self.widths_m[girder], self.slab_m)
        areas, apart = (wide * deep, slab[0] * slab[1]), 0.5 * (deep + slab[1])
        bending = wide * deep**3 / 12.0 + slab[0] * slab[1] ** 3 / 12.0 + areas[0] * areas[1] / sum(areas) * apart**2
        short, long = sorted((wide, deep + slab[1]))
        torsion = long * short**3 * (1.0 / 3.0 - 0.21 * short / long * (1.0 - short**4 / 12.0 / long**4))
        return bending, torsion + (slab[0] - wide) * slab[1] ** 3 / 6.0

    def _tributary_m(self, station):
        ends = self.stations_m[max(station - 1, 0)], self.stations_m[min(station + 1, len(self.stations_m) - 1)]
        return 0.5 * (ends[1] - ends[0])

    @staticmethod
    def _beside(places_m, at_m):
        upper = int(np.clip(np.searchsorted(places_m, at_m), 1, len(places_m) - 1))
        share = (at_m - places_m[upper - 1]) / (places_m[upper] - places_m[upper - 1])
        return (upper - 1, 1.0 - share), (upper, share)

    def _beam(self, ends, length_m, bending_nm2, twisting_nm2, axis):
        """Add a beam along x (0) or y (1): downwards w and slope w' at each end, and its twist."""
        one, two, four = 12.0 / length_m**3, 6.0 / length_m**2, 4.0 / length_m
        own = bending_nm2 * np.array(
            [
                [one, two, -one, two],
                [two, four, -two, 2.0 / length_m],
                [-one, -two, one, -two],
                [two, 2.0 / length_m, -two, four],
            ]
        )
        slope, twist = (2, 1) if axis == 0 else (1, 2)
        rows = [3 * ends[0], 3 * ends[0] + slope, 3 * ends[1], 3 * ends[1] + slope]
        self._stiffness[np.ix_(rows, rows)] += own
        rows = [3 * ends[0] + twist, 3 * ends[1] + twist]
        self._stiffness[np.ix_(rows, rows)] += twisting_nm2 / length_m * np.array([[1.0, -1.0], [-1.0, 1.0]])
