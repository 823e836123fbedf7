# SPDX-License-Identifier: GPL-3.0-or-later
"""Plane frames of straight bars by the stiffness method, with shear: a solution that shares no code with the package.

W. McGuire, R. H. Gallagher, R. D. Ziemian (2000), Matrix Structural Analysis, 2nd edition, chapters 4 and 5.
"""

from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

YOUNG_PA, POISSON = 30e9, 0.2
SHEAR_PART = 5.0 / 6.0


@dataclass
class PlaneFrame:
    """Nodes in a plane, bars of rectangular sections between them, weights as point loads, and fixed nodes."""

    nodes: list[tuple[float, float]] = field(default_factory=list)
    bars: list[tuple[int, int, float, float]] = field(default_factory=list)  # nodes, depth, width
    loads_n: dict[int, float] = field(default_factory=dict)
    fixed: set[int] = field(default_factory=set)
    rollers: set[int] = field(default_factory=set)  # held upwards alone

    def node(self, x_m, z_m):
        """The node at a place, a new one where there is none yet."""
        for number, (x, z) in enumerate(self.nodes):
            if abs(x - x_m) + abs(z - z_m) < 1e-9:
                return number
        self.nodes.append((float(x_m), float(z_m)))
        return len(self.nodes) - 1

    def line(self, points_m, depth_m, width_m, weight_n_m=0.0):
        """Bars along points; half of the weight of each hangs at either of its ends."""
        numbers = [self.node(*point) for point in points_m]
        for first, second in pairwise(numbers):
            self.bars.append((first, second, depth_m, width_m))
            length = np.hypot(*np.subtract(self.nodes[second], self.nodes[first]))
            for number in (first, second):
                self.load(number, 0.5 * weight_n_m * length)

    def load(self, number, down_n):
        """Hang a weight on a node."""
        self.loads_n[number] = self.loads_n.get(number, 0.0) + down_n

    def solved(self):
        """Displacements (n, 3): along x and z, and the turn from x to z."""
        count = 3 * len(self.nodes)
        stiffness, loads = np.zeros((count, count)), np.zeros(count)
        for bar in self.bars:
            rows = self._rows(bar)
            turn, local, _ = self._of_bar(bar)
            stiffness[np.ix_(rows, rows)] += turn.T @ local @ turn
        for number, down in self.loads_n.items():
            loads[3 * number + 1] -= down
        held = [3 * number + way for number in self.fixed for way in range(3)]
        held += [3 * number + 1 for number in self.rollers]
        free = np.setdiff1d(np.arange(count), held)
        moved = np.zeros(count)
        moved[free] = np.linalg.solve(stiffness[np.ix_(free, free)], loads[free])
        return moved.reshape(-1, 3)

    def end_forces(self, moved, first, second):
        """Axial force (tension positive) and moments at the first and second end of the bar between two nodes.

        Moments act on the bar, positive from x to z.
        """
        for bar in self.bars:
            if {bar[0], bar[1]} == {first, second}:
                turn, local, _ = self._of_bar(bar)
                ends = local @ turn @ moved[[bar[0], bar[1]]].ravel()
                moments = (ends[2], ends[5]) if bar[0] == first else (ends[5], ends[2])
                return ends[3], *moments
        raise KeyError((first, second))

    def reaction(self, moved, number):
        """Forces along x and z, and the moment from x to z, of the support on a node."""
        total = np.zeros(3)
        for bar in self.bars:
            turn, local, _ = self._of_bar(bar)
            ends = (turn.T @ local @ turn @ moved[[bar[0], bar[1]]].ravel()).reshape(2, 3)
            for row in (0, 1):
                if bar[row] == number:
                    total += ends[row]
        total[1] += self.loads_n.get(number, 0.0)
        return total

    @staticmethod
    def _rows(bar):
        return [3 * number + way for number in bar[:2] for way in range(3)]

    def _of_bar(self, bar):
        """Rotation (6, 6) into the axes of a bar, its stiffness (6, 6) there, and its length."""
        first, second, depth, width = bar
        along = np.subtract(self.nodes[second], self.nodes[first])
        length = float(np.hypot(*along))
        c, s = along / length
        turn = np.kron(np.eye(2), np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]))
        area, inertia = depth * width, width * depth**3 / 12.0
        shear = YOUNG_PA / (2.0 * (1.0 + POISSON)) * SHEAR_PART * area
        soft = 12.0 * YOUNG_PA * inertia / (shear * length**2)
        a = YOUNG_PA * area / length
        b = 12.0 * YOUNG_PA * inertia / (length**3 * (1.0 + soft))
        d = 6.0 * YOUNG_PA * inertia / (length**2 * (1.0 + soft))
        e, f = (part * YOUNG_PA * inertia / (length * (1.0 + soft)) for part in (4.0 + soft, 2.0 - soft))
        local = np.array(
            [
                [a, 0, 0, -a, 0, 0],
                [0, b, d, 0, -b, d],
                [0, d, e, 0, -d, f],
                [-a, 0, 0, a, 0, 0],
                [0, -b, -d, 0, b, -d],
                [0, d, f, 0, -d, e],
            ],
            float,
        )
        return turn, local, length
