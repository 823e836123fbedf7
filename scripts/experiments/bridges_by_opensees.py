# SPDX-License-Identifier: GPL-3.0-or-later
"""Calculate six elastic bridges by OpenSees, which `elastic_bridges.py` compares with, for its README.

Portal, frame of an example, grillage and skewed slab are meshes of eight-node bricks or plane-stress quadrilaterals
with one point of integration and stabilisation (SSPbrick, SSPquad); the deck over two spans is a beam of Timoshenko.
It needs openseespy, which the extra `verify` brings: F. McKenna et al., OpenSees, https://opensees.berkeley.edu, by way
of M. Zhu, F. McKenna, M. H. Scott (2018), OpenSeesPy, SoftwareX 7, 6-11.

Usage: bridges_by_opensees.py writes docs/data/bridges_by_opensees.csv
"""

from __future__ import annotations

import csv
import math
import sys
from collections.abc import Callable, Iterable
from pathlib import Path

import numpy as np
import openseespy.opensees as ops

TABLE = Path(__file__).resolve().parents[2] / "docs" / "data" / "bridges_by_opensees.csv"
GRAVITY_M_S2, POISSON = 9.80665, 0.2


def main() -> int:
    """Write the table."""
    version, rows = ops.version(), []
    for bridge, calculated in BRIDGES.items():
        for quantity, value in calculated().items():
            rows.append((bridge, quantity, f"{value:.4g}", f"OpenSees {version}"))
            print(*rows[-1], flush=True)
    with TABLE.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([("bridge", "quantity", "value", "by"), *rows])
    return 0


def spaced(*stretches: tuple[float, float, int]) -> np.ndarray:
    """Coordinates of a mesh that divides stretches, which follow each other, into so many parts."""
    starts = [np.linspace(low, high, count + 1)[:-1] for low, high, count in stretches]
    return np.round(np.concatenate([*starts, [stretches[-1][1]]]), 6)


class Bricks:
    """A solid in bricks: the cells of a grid, sheared along x by y, whose middles are in it."""

    def __init__(
        self,
        grid: tuple[np.ndarray, np.ndarray, np.ndarray],
        is_solid: Callable[[float, float, float], bool],
        young_pa: float,
        density_kg_m3: float,
        shear: float = 0.0,
    ):
        ops.wipe()
        ops.model("basic", "-ndm", 3, "-ndf", 3)
        ops.nDMaterial("ElasticIsotropic", 1, young_pa, POISSON)
        self.places: dict[tuple[int, int, int], int] = {}
        self.positions: dict[int, np.ndarray] = {}
        self._grid, self._shear, self._weights = grid, shear, {}
        cells = [np.column_stack((axis[:-1], axis[1:])) for axis in grid]
        element = 0
        for i, x in enumerate(cells[0]):
            for j, y in enumerate(cells[1]):
                for k, z in enumerate(cells[2]):
                    if not is_solid(x.mean(), y.mean(), z.mean()):
                        continue
                    floor = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                    nodes = [self._node(*corner, level) for level in (k, k + 1) for corner in floor]
                    element += 1
                    ops.element("SSPbrick", element, *nodes, 1)
                    weight = density_kg_m3 * GRAVITY_M_S2 * float(np.ptp(x) * np.ptp(y) * np.ptp(z))
                    for node in nodes:
                        self._weights[node] = self._weights.get(node, 0.0) + weight / 8.0

    def _node(self, i: int, j: int, k: int) -> int:
        if (i, j, k) not in self.places:
            node = self.places[i, j, k] = len(self.places) + 1
            x, y, z = (axis[index] for axis, index in zip(self._grid, (i, j, k), strict=True))
            self.positions[node] = np.array([x + self._shear * y, y, z])
            ops.node(node, *self.positions[node].tolist())
        return self.places[i, j, k]

    def on_top(self, place_m: tuple[float, float], size_m: tuple[float, float], parts: int = 8) -> dict[int, float]:
        """Parts of a load, spread evenly about a place without skew, on nodes of the top."""
        found: dict[int, float] = {}
        spread = (np.arange(parts) + 0.5) / parts - 0.5
        for at in spread * size_m[0]:
            for aside in spread * size_m[1]:
                # What lies aside in a skewed grid lies further along the road.
                columns = zip(self._grid, (place_m[0] + at - self._shear * aside, place_m[1] + aside), strict=False)
                (i, u), (j, v) = (self._beside(axis, value) for axis, value in columns)
                for m, along in ((i, 1.0 - u), (i + 1, u)):
                    for n, across in ((j, 1.0 - v), (j + 1, v)):
                        node = self.places[m, n, len(self._grid[2]) - 1]
                        found[node] = found.get(node, 0.0) + along * across / parts**2
        return found

    @staticmethod
    def _beside(axis: np.ndarray, value: float) -> tuple[int, float]:
        cell = int(np.searchsorted(axis, value)) - 1
        return cell, float((value - axis[cell]) / (axis[cell + 1] - axis[cell]))

    def solve(self) -> tuple[float, float]:
        """Put it under its weight; return the largest deflection, mm, and the first frequency, Hz."""
        solve([(node, (0.0, 0.0, -weight)) for node, weight in self._weights.items()])
        deflection = -min(ops.nodeDisp(node, 3) for node in self._weights)
        for node, weight in self._weights.items():
            ops.mass(node, *([weight / GRAVITY_M_S2] * 3))
        return 1e3 * deflection, first_frequency()

    def reaction(self, nodes: Iterable[int], about_m: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> np.ndarray:
        """Force, kN, and moment, kN·m, of supports at nodes on it, in one array (6,)."""
        total = np.zeros(6)
        for node in nodes:
            force = np.array(ops.nodeReaction(node))
            total += np.concatenate((force, np.cross(self.positions[node] - about_m, force)))
        return total / 1e3


def solve(loads: Iterable[tuple[int, tuple[float, ...]]]) -> None:
    """Solve a linear model with loads on nodes."""
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    for node, load in loads:
        ops.load(node, *load)
    ops.system("UmfPack")
    ops.numberer("RCM")
    ops.constraints("Plain")
    ops.integrator("LoadControl", 1.0)
    ops.algorithm("Linear")
    ops.analysis("Static")
    if ops.analyze(1) != 0:
        raise RuntimeError("OpenSees found no solution")
    ops.reactions()


def first_frequency() -> float:
    """Frequency, Hz, of the lowest of two modes."""
    return math.sqrt(min(ops.eigen(2))) / (2.0 * math.pi)


def portal() -> dict[str, float]:
    """Axes of 12 m × 8 m, 0.6 m deep, 2 m wide, feet held: plane stress, 12 quadrilaterals along each depth."""
    span, height, depth, width, young, density, parts = 12.0, 8.0, 0.6, 2.0, 30e9, 2500.0, 12
    size = depth / parts
    along, up, beam = (
        round((span + depth) / size),
        round((height + depth / 2) / size),
        round(height / size) - parts // 2,
    )
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 2)
    ops.nDMaterial("ElasticIsotropic", 1, young, POISSON, density)
    places: dict[tuple[int, int], int] = {}
    weights: dict[int, float] = {}

    def node(i: int, j: int) -> int:
        if (i, j) not in places:
            places[i, j] = len(places) + 1
            ops.node(places[i, j], -depth / 2 + i * size, j * size)
        return places[i, j]

    element = 0
    for i in range(along):
        for j in range(up):
            if j >= beam or i < parts or i >= along - parts:
                corners = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]
                element += 1
                ops.element("SSPquad", element, *corners, 1, "PlaneStress", width, 0.0, 0.0)
                for corner in corners:
                    weight = density * GRAVITY_M_S2 * width * size**2 / 4.0
                    weights[corner] = weights.get(corner, 0.0) + weight
    for (_, j), foot in places.items():
        if j == 0:
            ops.fix(foot, 1, 1)
    solve([(corner, (0.0, -weight)) for corner, weight in weights.items()])
    left = [(place, foot) for (place, j), foot in places.items() if j == 0 and place <= parts]
    thrust = sum(ops.nodeReaction(foot)[0] for _, foot in left)
    moment = sum(ops.nodeReaction(foot)[1] * (place * size - depth / 2) for place, foot in left)
    deflection = -ops.nodeDisp(places[along // 2, round(height / size)], 2)
    return {
        "thrust": abs(thrust) / 1e3,
        "moment at a foot": abs(moment) / 1e3,
        "deflection": 1e3 * deflection,
        "first frequency": first_frequency(),
    }


def two_spans() -> dict[str, float]:
    """A deck of 3 m × 0.7 m over 10 m and 15 m, 0.5 m longer at either end."""
    density, width, depth, young, over, size = 2500.0, 3.0, 0.7, 30e9, 0.5, 0.05
    area, count = width * depth, round((25.0 + 2.0 * 0.5) / size)
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("Linear", 1)
    masses = density * area * size * np.where(np.arange(count + 1) % count == 0, 0.5, 1.0)
    for node, mass in enumerate(masses.tolist(), 1):
        ops.node(node, (node - 1) * size - over, 0.0)
        ops.mass(node, mass, mass, 0.0)
    bending, shear = area * depth**2 / 12.0, young / (2.0 * (1.0 + POISSON))
    for node in range(1, count + 1):
        ops.element("ElasticTimoshenkoBeam", node, node, node + 1, young, shear, area, bending, area * 5 / 6, 1)
    supports = [round((place + over) / size) + 1 for place in (0.0, 10.0, 25.0)]
    for row, node in enumerate(supports):
        ops.fix(node, int(row == 0), 1, 0)
    solve([(node, (0.0, -mass * GRAVITY_M_S2, 0.0)) for node, mass in enumerate(masses.tolist(), 1)])
    reactions = [ops.nodeReaction(node)[1] / 1e3 for node in supports]
    return {
        "reaction 1": reactions[0],
        "reaction 2": reactions[1],
        "reaction 3": reactions[2],
        "hogging moment": abs(ops.eleForce(supports[1])[2]) / 1e3,
        "deflection": -1e3 * min(ops.nodeDisp(node, 2) for node in range(1, count + 2)),
        "first frequency": first_frequency(),
    }


def grillage() -> dict[str, float]:
    """Four girders of 0.4 m × 0.9 m under a slab of 8 m × 0.25 m, 16 m long, on lines below the girders' ends."""
    girders = np.array([-3.0, -1.0, 1.0, 3.0])
    grid = spaced((0.0, 16.0, 40)), spaced((-4.0, 4.0, 40)), spaced((2.0, 2.9, 6), (2.9, 3.15, 2))
    bricks = Bricks(grid, lambda x, y, z: z > 2.9 or abs(girders - y).min() < 0.2, 30e9, 2500.0)
    bearings: list[list[int]] = [[] for _ in girders]
    for (i, j, k), node in bricks.places.items():
        if k == 0 and i in (0, len(grid[0]) - 1):
            ops.fix(node, int(i == 0), 1, 1)
            bearings[int(abs(girders - grid[1][j]).argmin())].append(node)
    deflection, frequency = bricks.solve()
    reactions = [float(bricks.reaction(nodes)[2]) for nodes in bearings]
    return {
        "outer girders": (reactions[0] + reactions[3]) / 2.0,
        "inner girders": (reactions[1] + reactions[2]) / 2.0,
        "deflection": deflection,
        "first frequency": frequency,
    }


def girders_under_a_machine() -> dict[str, float]:
    """The part of 50 t on 1 m × 0.4 m that each girder carries, over an outer and an inner one, and square and skewed.

    The girders are 0.4 m longer than their span at either end, and none slides along the road at its first bearing.
    """
    shares = {}
    for name, place_m, skew_deg in (
        ("outer", (8.0, 3.0), 0.0),
        ("inner", (8.0, 1.0), 0.0),
        ("outer, at a quarter of the span", (4.0, 3.0), 0.0),
        ("outer, skew of 25°", (8.0, 3.0), 25.0),
    ):
        bricks, bearings = girders_with_ends(skew_deg)
        solve([(node, (0.0, 0.0, -part)) for node, part in bricks.on_top(place_m, (1.0, 0.4)).items()])
        for girder, nodes in enumerate(bearings, 1):
            shares[f"{name}: girder {girder}"] = 1e3 * float(bricks.reaction(nodes)[2])
    return shares


def girders_with_ends(skew_deg: float) -> tuple[Bricks, list[list[int]]]:
    """Four girders that are longer than their span, and the nodes of the bearings of each."""
    girders = np.array([-3.0, -1.0, 1.0, 3.0])
    webs = [(-4.0, -3.2, 3), *((y - 0.2, y + 0.2, 4) for y in girders), *((y + 0.2, y + 1.8, 5) for y in girders[:-1])]
    grid = (
        spaced((-0.4, 0.0, 1), (0.0, 16.0, 40), (16.0, 16.4, 1)),
        spaced(*sorted([*webs, (3.2, 4.0, 3)])),
        spaced((2.0, 2.9, 8), (2.9, 3.15, 3)),
    )
    skew = math.tan(math.radians(skew_deg))
    bricks = Bricks(grid, lambda x, y, z: z > 2.9 or abs(girders - y).min() < 0.2, 34e9, 2500.0, skew)
    bearings: list[list[int]] = [[] for _ in girders]
    for (i, j, k), node in bricks.places.items():
        if k == 0 and grid[0][i] in (0.0, 16.0):
            away = abs(girders - grid[1][j])
            ops.fix(node, int(grid[0][i] == 0.0), int(away.min() < 1e-6), 1)
            bearings[int(away.argmin())].append(node)
    return bricks, bearings


def skewed_slab() -> dict[str, float]:
    """A slab of 12 m × 8 m × 0.6 m, ends turned by 40°, on lines below its ends, one of them free to slide."""
    grid = spaced((0.0, 12.0, 36)), spaced((-4.0, 4.0, 24)), spaced((0.0, 0.6, 4))
    bricks = Bricks(grid, lambda x, y, z: True, 30e9, 2500.0, shear=math.tan(math.radians(40.0)))
    # Above 0 the left end, towards positive y, lies further along the road: obtuse corners are there at the start.
    obtuse, acute = [], []
    for (i, j, k), node in bricks.places.items():
        if k == 0 and i in (0, len(grid[0]) - 1):
            ops.fix(node, int(i == 0), int(i == 0), 1)
            y = grid[1][j] * (1.0 if i == 0 else -1.0)
            if abs(y) > 2.0 - 1e-9:
                (acute if y < 0.0 else obtuse).append((node, 0.5 if abs(y) < 2.0 + 1e-9 else 1.0))
    _, frequency = bricks.solve()
    quarter = [
        sum(share * float(bricks.reaction([node])[2]) for node, share in nodes) / 2.0 for nodes in (obtuse, acute)
    ]
    return {
        "quarter at an obtuse corner": quarter[0],
        "quarter at an acute corner": quarter[1],
        "first frequency": frequency,
    }


def example_frame() -> dict[str, float]:
    """The bridge of examples/report_2019/single_span_explosives.toml: deck, caps and columns in one, feet held."""
    grid = (
        spaced(
            (-0.5, -0.35, 1),
            (-0.35, 0.35, 3),
            (0.35, 0.5, 1),
            (0.5, 12.5, 24),
            (12.5, 12.65, 1),
            (12.65, 13.35, 3),
            (13.35, 13.5, 1),
        ),
        spaced((-4.25, -2.475, 4), (-2.475, -1.775, 3), (-1.775, 1.775, 7), (1.775, 2.475, 3), (2.475, 4.25, 4)),
        spaced((0.0, 4.9, 14), (4.9, 5.5, 3), (5.5, 6.1, 4)),
    )

    def is_solid(x: float, y: float, z: float) -> bool:
        from_axis = min(abs(x), abs(x - 13.0))
        column = from_axis < 0.35 and 1.775 < abs(y) < 2.475
        return z > 5.5 or (z > 4.9 and from_axis < 0.5) or (z < 4.9 and column)

    bricks = Bricks(grid, is_solid, 34e9, 2400.0)
    feet = [node for (_, _, k), node in bricks.places.items() if k == 0]
    for node in feet:
        ops.fix(node, 1, 1, 1)
    deflection, frequency = bricks.solve()
    one = [node for node in feet if bricks.positions[node][0] < 1.0 and bricks.positions[node][1] < 0.0]
    loads = bricks.reaction(one, (0.0, -2.125, 0.0))
    return {
        "reaction": float(loads[2]),
        "thrust": abs(float(loads[0])),
        "moment at a foot": abs(float(loads[4])),
        "deflection": deflection,
        "first frequency": frequency,
    }


BRIDGES = {
    "portal": portal,
    "frame of an example": example_frame,
    "deck over two spans": two_spans,
    "four girders": grillage,
    "girders under a machine": girders_under_a_machine,
    "skewed slab": skewed_slab,
}

if __name__ == "__main__":
    sys.exit(main())
