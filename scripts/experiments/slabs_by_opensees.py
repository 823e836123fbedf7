# SPDX-License-Identifier: GPL-3.0-or-later
"""Calculate slabs on several columns under one axis by OpenSees, as plates, for docs/elastic.md and its tests.

Plates of Mindlin and Reissner (ShellMITC4) of 0.25 m lie on springs along lines of their undersides: each metre of a
bearing is as stiff as 30 000 MN/m, all of it 100 000 MN/m at most, with columns that shorten below it.
Bearings hold across the road, the first ones along it as well. It needs openseespy, as `bridges_by_opensees.py` does.

Usage: slabs_by_opensees.py writes docs/data/slabs_by_opensees.csv
"""

from __future__ import annotations

import csv
import math
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
import openseespy.opensees as ops
from bridges_by_opensees import GRAVITY_M_S2, POISSON, solve

TABLE = Path(__file__).resolve().parents[2] / "docs" / "data" / "slabs_by_opensees.csv"
YOUNG_PA, DENSITY_KG_M3, OVERHANG_M, SIZE_M = 34e9, 2500.0, 0.4, 0.25


@dataclass(frozen=True)
class Slab:
    """A slab over abutments, or ends on columns, and piers of square columns, evenly across the road."""

    spans_m: tuple[float, ...]
    width_m: float
    thickness_m: float
    columns: int
    column_m: float
    skew_deg: float = 0.0
    on_abutments: bool = True
    column_height_m: float = 0.0  # of columns that shorten

    def lines(self) -> Iterator[tuple[str, float, float, float, float]]:
        """Yield each bearing: name, where along the road, from where to where across it, stiffness of a metre."""
        axes = np.cumsum([0.0, *self.spans_m]).tolist()
        spacing = self.width_m / self.columns
        for axis, along in enumerate(axes):
            if self.on_abutments and axis in (0, len(axes) - 1):
                half = self.width_m / 2.0
                yield f"abutment {1 + (axis > 0)}", along, -half, half, 1e11 / self.width_m
                continue
            stiff = 3e10 * self.column_m
            if self.column_height_m:
                stiff = 1.0 / (1.0 / stiff + self.column_height_m / (YOUNG_PA * self.column_m**2))
            for column in range(self.columns):
                across, half = spacing * (column - (self.columns - 1) / 2.0), self.column_m / 2.0
                name = f"pier {axis + (not self.on_abutments)} column {column + 1}"
                yield name, along, across - half, across + half, stiff / self.column_m


SLABS = {
    "two spans on four columns": Slab((12.0, 12.0), 10.0, 0.7, 4, 0.8),
    "two spans on three columns": Slab((9.0, 9.0), 12.0, 0.5, 3, 0.6),
    "three spans on two columns": Slab((12.0, 15.0, 12.0), 9.0, 0.8, 2, 1.0),
    "wide on four columns": Slab((8.0, 8.0), 16.0, 0.45, 4, 0.5),
    "deep on five columns": Slab((14.0, 14.0), 12.0, 0.9, 5, 0.8),
    "one span on two rows of four": Slab((10.0,), 10.0, 0.6, 4, 0.8, on_abutments=False),
    "on columns that shorten": Slab((12.0, 12.0), 10.0, 0.7, 4, 0.8, column_height_m=6.0),
    "skew of 15°": Slab((12.0, 12.0), 10.0, 0.7, 4, 0.8, skew_deg=15.0),
    "skew of 25°": Slab((12.0, 12.0), 10.0, 0.7, 4, 0.8, skew_deg=25.0),
}
MACHINE_M = {"over an outer column": (12.0, 3.75), "in a span": (6.0, 3.75)}
"""Where 50 t stand on 1 m × 1 m of the first slab, by the part of it that each bearing has."""


def main() -> int:
    """Write the table."""
    version, rows = ops.version(), []
    for name, slab in SLABS.items():
        rows += [(name, *found) for found in carried(slab).items()]
    for name, place_m in MACHINE_M.items():
        parts = carried(SLABS["two spans on four columns"], place_m)
        rows += [(f"50 t {name}", *found) for found in parts.items()]
    with TABLE.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(("slab", "bearing", "value", "by"))
        table.writerows((name, bearing, f"{value:.4g}", f"OpenSees {version}") for name, bearing, value in rows)
    return 0


def carried(slab: Slab, machine_m: tuple[float, float] | None = None) -> dict[str, float]:
    """Upward forces of bearings, kN, under the slab's weight; under a machine the part of it that each has."""
    lines = list(slab.lines())
    xs = divided((-OVERHANG_M, sum(slab.spans_m) + OVERHANG_M, *(line[1] for line in lines)))
    ys = divided((-slab.width_m / 2.0, slab.width_m / 2.0, *(side for line in lines for side in line[2:4])))
    plate(slab, xs, ys)
    springs = {line[0]: list(springs_below(slab, line, xs, ys)) for line in lines}
    if machine_m is None:
        tributary = np.outer(*map(tributary_m, (xs, ys))).ravel()
        loads = DENSITY_KG_M3 * GRAVITY_M_S2 * slab.thickness_m * tributary
    else:
        over = [parts_m(axis, at - 0.5, at + 0.5) for axis, at in zip((xs, ys), machine_m, strict=True)]
        loads = 1e3 * np.outer(*over).ravel()
    solve([(node, (0.0, 0.0, -float(load), 0.0, 0.0, 0.0)) for node, load in enumerate(loads, 1)])
    return {name: -1e-3 * sum(ops.nodeDisp(node, 3) * stiff for node, stiff in own) for name, own in springs.items()}


def divided(places_m: Sequence[float], size_m: float = SIZE_M) -> np.ndarray:
    """Coordinates of a mesh that has all places."""
    places = sorted({round(place, 6) for place in places_m})
    steps = [np.linspace(low, high, math.ceil((high - low) / size_m) + 1)[1:] for low, high in pairwise(places)]
    return np.concatenate([[places[0]], *steps])


def parts_m(axis_m: np.ndarray, low_m: float, high_m: float) -> np.ndarray:
    """How much of a stretch is nearest to each place of an axis."""
    edges = np.concatenate(([-np.inf], 0.5 * (axis_m[1:] + axis_m[:-1]), [np.inf]))
    return np.diff(np.clip(edges, low_m, high_m))


def tributary_m(axis_m: np.ndarray) -> np.ndarray:
    """How much of an axis is nearest to each of its places."""
    return parts_m(axis_m, float(axis_m[0]), float(axis_m[-1]))


def plate(slab: Slab, xs: np.ndarray, ys: np.ndarray) -> None:
    """Make the mesh: nodes across the road one after the other, from 1."""
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    ops.geomTransf("Linear", 1, 1.0, 0.0, 0.0)
    ops.section("ElasticMembranePlateSection", 1, YOUNG_PA, POISSON, slab.thickness_m, 0.0)
    skew = math.tan(math.radians(slab.skew_deg))
    for node, (x, y) in enumerate(((x, y) for x in xs.tolist() for y in ys.tolist()), 1):
        ops.node(node, x + skew * y, y, 0.0)
    corners = (0, len(ys), len(ys) + 1, 1)
    first = [1 + i * len(ys) + j for i in range(len(xs) - 1) for j in range(len(ys) - 1)]
    for element, node in enumerate(first, 1):
        ops.element("ShellMITC4", element, *(node + step for step in corners), 1)


def springs_below(
    slab: Slab, line: tuple[str, float, float, float, float], xs: np.ndarray, ys: np.ndarray
) -> Iterator[tuple[int, float]]:
    """Put springs below the plate along a bearing; yield the nodes of its underside and their stiffness."""
    _, along, low, high, of_metre = line
    first, count = int(abs(xs - along).argmin()) * len(ys) + 1, len(xs) * len(ys)
    across_n_m = 1e11 / (high - low)
    for across, part in enumerate(parts_m(ys, low, high).tolist()):
        if part > 0.0:
            node = first + across
            below, ground = count + node, 2 * count + node
            x, y, _ = ops.nodeCoord(node)
            for tag in (below, ground):
                ops.node(tag, x, y, -slab.thickness_m / 2.0)
            ops.fix(ground, 1, 1, 1, 1, 1, 1)
            ops.element("elasticBeamColumn", below, node, below, *[1e2, 1e12, 1e12, 1e2, 1e2, 1e2], 1)
            held = [across_n_m * part * (along == 0.0), across_n_m * part, of_metre * part]
            for direction, stiff in enumerate(held, 1):
                ops.uniaxialMaterial("Elastic", 4 * node + direction, max(stiff, 1.0))
            tags = [4 * node + direction for direction in (1, 2, 3)]
            ops.element("zeroLength", ground, ground, below, "-mat", *tags, "-dir", 1, 2, 3)
            yield below, of_metre * part


if __name__ == "__main__":
    sys.exit(main())
