# SPDX-License-Identifier: GPL-3.0-or-later
"""Calculate weights that drop on reinforced strips by OpenSees, which the case `drop_on_shards` compares with.

The strip is a beam of 80 elements, whose ends lie on supports that do not pull. Its
sections have the stiffness of whole concrete until they crack, once and for all, and then that of the cracked section
and its plastic moments. The weight is a point mass on a spring that does not pull. It needs openseespy, as
`bridges_by_opensees.py` does.

Usage: drop_by_opensees.py writes docs/data/drop_by_opensees.csv
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
sys.path.insert(1, str(Path(__file__).resolve().parents[2] / "validation"))

import numpy as np
import openseespy.opensees as ops
from drop_on_shards import BY_OPENSEES, DROPS, SUBSTEP_S, Drop, stays_m
from slabs import CONCRETE_PA, DENSITY_KG_M3, WALL_M

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2 as G

STEEL_PA, CRACKS_PA = 200e9, 2.9e6
ELEMENTS, STEP_S, UNTIL_S = 80, 1e-4, 0.6
CONTACT_N_M, SUPPORT_N_M = 5e8, 2e9


def main() -> int:
    """Write the table."""
    version, rows = ops.version(), []
    for name, drop in DROPS.items():
        for damping, damping_s in (("none", 0.0), ("as in the run", SUBSTEP_S)):
            times, sunk = course(drop, damping_s)
            for quantity, value in (("largest", sunk.max()), ("stays", stays_m(times, sunk))):
                rows.append((name, damping, quantity, f"{1e3 * value:.1f}", f"OpenSees {version}"))
                print(*rows[-1], flush=True)
    with BY_OPENSEES.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([("drop", "damping", "deflection", "mm", "by"), *rows])
    return 0


def cracked_i_m4(drop: Drop) -> float:
    """Second moment of the cracked section, in concrete: b x² / 2 = n A (d - x)."""
    strip = drop.strip
    steel = STEEL_PA / CONCRETE_PA * 1e-6 * strip.area_mm2
    depth = (np.sqrt(steel**2 + 2.0 * strip.width_m * steel * strip.depth_m) - steel) / strip.width_m
    return float(strip.width_m * depth**3 / 3.0 + steel * (strip.depth_m - depth) ** 2)


def course(drop: Drop, damping_s: float) -> tuple[np.ndarray, np.ndarray]:
    """Times since the weight hits, and how far the middle has gone down, m.

    `damping_s` is that of Rayleigh, by the stiffness as it is then.
    """
    strip, half = drop.strip, drop.strip.span_m / 2.0
    along = np.array([-half - WALL_M / 2.0, *np.linspace(-half, half, ELEMENTS + 1), half + WALL_M / 2.0])
    count, middle = len(along), len(along) // 2 + 1
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    lengths = np.zeros(count)
    lengths[:-1] += np.diff(along) / 2.0
    lengths[1:] += np.diff(along) / 2.0
    masses = DENSITY_KG_M3 * strip.width_m * strip.height_m * lengths
    for node, (x, mass) in enumerate(zip(along.tolist(), masses.tolist(), strict=True), start=1):
        ops.node(node, x, 0.0)
        ops.mass(node, mass, mass, mass * strip.height_m**2 / 12.0)
    _section(drop)
    ops.geomTransf("Linear", 1)
    ops.beamIntegration("Legendre", 1, 1, 2)
    for element in range(1, count):
        ops.element("dispBeamColumn", element, element, element + 1, 1, 1)
    weight = _supports_and_weight(along, middle, drop.mass_kg)
    ops.timeSeries("Constant", 1)
    ops.pattern("Plain", 1, 1)
    for node, mass in enumerate(masses.tolist(), start=1):
        ops.load(node, 0.0, -mass * G, 0.0)
    _analysis("Static")
    if ops.analyze(1) != 0:
        raise RuntimeError("OpenSees found no equilibrium under the weight of the strip")
    at_rest = ops.nodeDisp(middle, 2)
    ops.setNodeDisp(weight, 2, at_rest, "-commit")
    ops.setNodeVel(weight, 2, -drop.speed_m_s, "-commit")
    ops.loadConst("-time", 0.0)
    ops.wipeAnalysis()
    ops.timeSeries("Constant", 2)
    ops.pattern("Plain", 2, 2)
    ops.load(weight, 0.0, -drop.mass_kg * G, 0.0)
    if damping_s:
        ops.region(1, "-ele", *range(1, count), "-rayleigh", 0.0, 0.0, 0.0, damping_s)
    _analysis("Transient")
    times, sunk = [], []
    while ops.getTime() < UNTIL_S:
        _step()
        times.append(ops.getTime())
        sunk.append(at_rest - ops.nodeDisp(middle, 2))
    return np.array(times), np.array(sunk)


def _step() -> None:
    """Go on by one step, or by ten short ones where sections crack in it."""
    if ops.analyze(1, STEP_S) == 0:
        return
    ops.algorithm("KrylovNewton")
    if ops.analyze(10, STEP_S / 10.0) != 0:
        raise RuntimeError(f"OpenSees found no solution at {ops.getTime():.4f} s")
    ops.algorithm("Newton")


def _section(drop: Drop) -> None:
    """Moment by curvature: cracked and elastic-plastic, with whole concrete beside it up to the curvature of cracks."""
    strip = drop.strip
    whole = CONCRETE_PA * strip.width_m * strip.height_m**3 / 12.0
    cracked = CONCRETE_PA * cracked_i_m4(drop)
    cracks_at = CRACKS_PA * strip.width_m * strip.height_m**2 / 6.0 / whole
    pull = strip.area_mm2 * strip.yield_n_mm2
    block_m = pull / (strip.width_m * strip.compression_n_mm2 * 1e6)
    hogging = pull * (strip.height_m - strip.depth_m - block_m / 2.0)
    ops.uniaxialMaterial("ElasticPP", 11, cracked, strip.moment_nm / cracked, -hogging / cracked)
    ops.uniaxialMaterial("Elastic", 12, whole - cracked)
    ops.uniaxialMaterial("MinMax", 13, 12, "-min", -cracks_at, "-max", cracks_at)
    ops.uniaxialMaterial("Parallel", 1, 11, 13)
    ops.uniaxialMaterial("Elastic", 2, CONCRETE_PA * strip.width_m * strip.height_m)
    ops.section("Aggregator", 1, 2, "P", 1, "Mz")


def _supports_and_weight(along: np.ndarray, middle: int, mass_kg: float) -> int:
    """Put the strip on supports that press alone, of which one moves, and a weight on its middle; return its node."""
    count = len(along)
    ops.uniaxialMaterial("ENT", 3, SUPPORT_N_M)
    ops.uniaxialMaterial("Elastic", 4, SUPPORT_N_M)
    ops.uniaxialMaterial("ENT", 5, CONTACT_N_M)
    ops.uniaxialMaterial("Elastic", 6, 1.0)  # next to nothing: it holds the weight until it is let go
    left, right, weight, held = range(count + 1, count + 5)
    for node, x in ((left, along[1]), (right, along[-2]), (weight, 0.0), (held, 0.0)):
        ops.node(node, float(x), 0.0)
    for node in (left, right, held):
        ops.fix(node, 1, 1, 1)
    ops.fix(weight, 1, 0, 1)
    ops.mass(weight, 0.0, mass_kg, 0.0)
    ops.element("zeroLength", count, left, 2, "-mat", 4, 3, "-dir", 1, 2)
    ops.element("zeroLength", count + 1, right, count - 1, "-mat", 3, "-dir", 2)
    ops.element("zeroLength", count + 2, middle, weight, "-mat", 5, "-dir", 2)
    ops.element("zeroLength", count + 3, held, weight, "-mat", 6, "-dir", 2)
    return weight


def _analysis(kind: str) -> None:
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system("BandGeneral")
    ops.algorithm("Newton")
    if kind == "Static":
        ops.test("NormDispIncr", 1e-9, 100)
        ops.integrator("LoadControl", 1.0)
    else:
        ops.test("NormUnbalance", 1.0, 50)
        ops.integrator("HHT", 0.9)
    ops.analysis(kind)


if __name__ == "__main__":
    sys.exit(main())
