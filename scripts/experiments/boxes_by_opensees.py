# SPDX-License-Identifier: GPL-3.0-or-later
"""Calculate box girders on two bearings under each axis by OpenSees, as plates, for docs/elastic.md and its tests.

Plates of Mindlin and Reissner (ShellMITC4) of 0.5 m, which give what those of 0.25 m do, lie in the middles of slab,
webs and bottom slab, without diaphragms. Each web lies on a spring below its middle over each axis; the first axis
holds along the road as well.
It needs openseespy, as `bridges_by_opensees.py` does.

Usage: boxes_by_opensees.py writes docs/data/boxes_by_opensees.csv
"""

from __future__ import annotations

import csv
import itertools
import sys
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import openseespy.opensees as ops
from bridges_by_opensees import GRAVITY_M_S2, POISSON, solve
from slabs_by_opensees import DENSITY_KG_M3, YOUNG_PA, divided

TABLE = Path(__file__).resolve().parents[2] / "docs" / "data" / "boxes_by_opensees.csv"
OVERHANG_M, SIZE_M, SPRING_N_M, STIFF_N_M, MACHINE_KG = 0.5, 0.5, 12e9, 1e11, 50e3


@dataclass(frozen=True)
class Box:
    """A box girder of one cell."""

    spans_m: tuple[float, ...]
    width_m: float
    slab_m: float
    box_m: float
    depth_m: float  # below the slab
    web_m: float
    bottom_m: float


BOXES = {
    "25 + 30 + 25 m": Box((25.0, 30.0, 25.0), 10.0, 0.25, 5.0, 1.5, 0.4, 0.25),
    "12 + 16 + 12 m": Box((12.0, 16.0, 12.0), 9.0, 0.25, 5.0, 1.3, 0.4, 0.25),
}


def main() -> int:
    """Write the table: kN of the weight, and parts of 50 t at mid-length, 0.7 m from the edge of the cantilever."""
    rows = []
    for (name, box), machine in itertools.product(BOXES.items(), (False, True)):
        load = f"50 t on a cantilever of {name}" if machine else f"weight of {name}"
        unit_kn = MACHINE_KG * GRAVITY_M_S2 / 1e3 if machine else 1.0
        carried = carried_kn(box, machine=machine)
        rows += [(load, bearing, f"{force / unit_kn:.4g}") for bearing, force in carried.items()]
    with TABLE.open("w", newline="", encoding="utf-8") as file:
        table = csv.writer(file)
        table.writerow(("load", "bearing", "value", "by"))
        table.writerows((*row, f"OpenSees {ops.version()}") for row in rows)
    return 0


def carried_kn(box: Box, *, machine: bool) -> dict[str, float]:
    """Upward forces of bearings, kN, under the weight of the box or a machine alone."""
    axes, length = np.cumsum([0.0, *box.spans_m]).tolist(), sum(box.spans_m)
    place = length / 2.0, box.width_m / 2.0 - 0.7
    web = (box.box_m - box.web_m) / 2.0
    xs = divided((-OVERHANG_M, *axes, length + OVERHANG_M, place[0]), SIZE_M)
    slab = divided((-box.width_m / 2.0, -web, web, box.width_m / 2.0, place[1]), SIZE_M)
    bottom = divided((-box.box_m / 2.0, -web, web, box.box_m / 2.0), SIZE_M)
    low, high = box.bottom_m / 2.0, box.depth_m + box.slab_m / 2.0
    upright = divided((low, high), SIZE_M)
    clear = (box.depth_m - box.bottom_m) / (high - low)
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    nodes: dict[tuple[float, ...], int] = {}
    weights: dict[int, float] = defaultdict(float)
    plates = [
        (1, box.slab_m, 1.0, slab, lambda y: (y, high)),
        (2, box.bottom_m, 1.0, bottom, lambda y: (y, low)),
        (3, box.web_m, clear, upright, lambda z: (-web, z)),
        (3, box.web_m, clear, upright, lambda z: (web, z)),
    ]
    for tag, thick, _, _, _ in plates[:3]:
        ops.section("ElasticMembranePlateSection", tag, YOUNG_PA, POISSON, thick, 0.0)

    def node(x: float, y: float, z: float) -> int:
        key = round(x, 6), round(y, 6), round(z, 6)
        if key not in nodes:
            nodes[key] = len(nodes) + 1
            ops.node(nodes[key], x, y, z)
        return nodes[key]

    element = itertools.count(1)
    for tag, thick, part, places, at in plates:
        for (begin, end), (one, other) in itertools.product(itertools.pairwise(xs), itertools.pairwise(places)):
            corners = [node(begin, *at(one)), node(end, *at(one)), node(end, *at(other)), node(begin, *at(other))]
            ops.element("ShellMITC4", next(element), *corners, tag)
            for corner in corners:
                area = (end - begin) * (other - one)
                weights[corner] += 0.25 * part * thick * area * DENSITY_KG_M3 * GRAVITY_M_S2
    ops.uniaxialMaterial("Elastic", 1, SPRING_N_M)
    ops.uniaxialMaterial("Elastic", 2, STIFF_N_M)
    bearings = {}
    for (axis, along), (side, across) in itertools.product(enumerate(axes, 1), enumerate((-web, web), 1)):
        above, ground = node(along, across, low), 10**6 + len(bearings)
        ops.node(ground, along, across, low)
        ops.fix(ground, 1, 1, 1, 1, 1, 1)
        held = {1: 2, 2: 2, 3: 1} if axis == 1 else {2: 2, 3: 1}
        ops.element("zeroLength", next(element), ground, above, "-mat", *held.values(), "-dir", *held)
        bearings[f"axis {axis}, web {side}"] = above
    loads = {node(*place, high): MACHINE_KG * GRAVITY_M_S2} if machine else weights
    solve([(at, (0.0, 0.0, -float(load), 0.0, 0.0, 0.0)) for at, load in loads.items()])
    return {name: -SPRING_N_M * ops.nodeDisp(at, 3) / 1e3 for name, at in bearings.items()}


if __name__ == "__main__":
    sys.exit(main())
