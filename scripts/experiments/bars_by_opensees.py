# SPDX-License-Identifier: GPL-3.0-or-later
"""Calculate frames of steel bars by OpenSees, which the case `bars_by_program` of the validation compares with.

Each bar is 16 beams of Timoshenko, with half of their mass at each of their ends. Supports are fixed. At rest, loads
act on what has moved; frequencies are those without a load. A support that is lost goes at once; Newmark's method with
steps of 0.2 ms and no damping follows what remains. It needs openseespy, as `bridges_by_opensees.py` does.

Usage: bars_by_opensees.py writes docs/data/bars_by_opensees.csv
"""

from __future__ import annotations

import csv
import sys
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import numpy as np
import openseespy.opensees as ops
from bridges_by_opensees import GRAVITY_M_S2, first_frequency

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
sys.path.insert(1, str(Path(__file__).resolve().parents[2] / "validation"))

from bar_frames import FRAMES, GRILLAGE, LOST, PIECES, PLACES, BarFrame

from bridge_demolition_addon.engineering.steelwork.catalogue import section_named

TABLE = Path(__file__).resolve().parents[2] / "docs" / "data" / "bars_by_opensees.csv"
YOUNG_PA, SHEAR_PA, DENSITY_KG_M3 = 210e9, 210e9 / 2.6, 7850.0
STEP_S, STEPS = 2e-4, 5000


def main() -> int:
    """Write the table."""
    version = ops.version()
    rows = [
        (frame.title, quantity, f"{value:.5g}", f"OpenSees {version}")
        for frame in FRAMES
        for quantity, value in quantities(frame)
    ]
    rows.append((GRILLAGE.title, f"largest deflection after {LOST} is lost", f"{sunk_at_most_mm():.5g}", rows[0][3]))
    with TABLE.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([("frame", "quantity", "value", "by"), *rows])
    for row in rows:
        print(*row)
    return 0


class Beams:
    """The beams of a frame in OpenSees."""

    def __init__(self, frame: BarFrame):
        ops.wipe()
        ops.model("basic", "-ndm", 3, "-ndf", 6)
        self.tags = {name: number for number, name in enumerate(frame.nodes, 1)}
        self.masses = dict.fromkeys(self.tags.values(), 0.0)
        self.elements: dict[str, list[int]] = {}
        for name, node in frame.nodes.items():
            ops.node(self.tags[name], *node.position_m)
            self.masses[self.tags[name]] += node.mass_kg
            if node.is_fixed:
                ops.fix(self.tags[name], *[1] * 6)
        for name, (begin, end, section) in frame.bars.items():
            places = np.array(frame.nodes[begin].position_m), np.array(frame.nodes[end].position_m)
            self._add_bar(name, self.tags[begin], self.tags[end], places, section)

    def _add_bar(self, name: str, begin: int, end: int, places: tuple[np.ndarray, np.ndarray], section: str) -> None:
        of, along = section_named(section), places[1] - places[0]
        inner = [len(self.masses) + number for number in range(1, PIECES)]
        for number, tag in enumerate(inner, 1):
            ops.node(tag, *(places[0] + along * number / PIECES).tolist())
            self.masses[tag] = 0.0
        chain, length = [begin, *inner, end], float(np.linalg.norm(along)) / PIECES
        # The web of a lying bar stands upright, and of an upright bar it lies along x.
        transform = len(self.elements) + 1
        ops.geomTransf("PDelta", transform, *((1.0, 0.0, 0.0) if along[2] else (0.0, 0.0, 1.0)))
        (about_y, about_z), (shear_y, shear_z) = np.diag(of.shape.second_moments_m4), of.shear_areas_m2
        self.elements[name] = []
        for one, other in pairwise(chain):
            tag = 1000 * transform + len(self.elements[name])
            stiffness = (YOUNG_PA, SHEAR_PA, of.area_m2, of.torsion_m4, about_y, about_z, shear_y, shear_z)
            ops.element("ElasticTimoshenkoBeam", tag, one, other, *map(float, stiffness), transform, "-geomNonlinear")
            self.elements[name].append(tag)
            for node in (one, other):
                self.masses[node] += 0.5 * DENSITY_KG_M3 * of.area_m2 * length

    def put_masses(self) -> None:
        """Give nodes their masses."""
        for tag, mass in self.masses.items():
            ops.mass(tag, mass, mass, mass, 0.0, 0.0, 0.0)

    def weights(self) -> list[tuple[int, tuple[float, ...]]]:
        """Loads on nodes."""
        return [(tag, (0.0, 0.0, -GRAVITY_M_S2 * mass, 0.0, 0.0, 0.0)) for tag, mass in self.masses.items()]

    def moments_nm(self, name: str) -> np.ndarray:
        """Bending about the strong axis (pieces + 1,), at the ends of the beams of a bar."""
        of_elements = [ops.eleResponse(tag, "localForce") for tag in self.elements[name]]
        return np.array([force[4] for force in of_elements] + [-of_elements[-1][10]])


def rest(beams: Beams) -> None:
    """Put beams under their weight, of which loads on what has moved are a part, in ten steps."""
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    for node, load in beams.weights():
        ops.load(node, *load)
    ops.system("UmfPack")
    ops.numberer("RCM")
    ops.constraints("Plain")
    ops.test("NormDispIncr", 1e-10, 50)
    ops.integrator("LoadControl", 0.1)
    ops.algorithm("Newton")
    ops.analysis("Static")
    if ops.analyze(10) != 0:
        raise RuntimeError("OpenSees found no solution")
    ops.reactions()


def quantities(frame: BarFrame) -> Iterator[tuple[str, float]]:
    """Yield displacements, mm, moments, kN·m, and the first frequency of a frame at rest under its weight."""
    beams = Beams(frame)
    rest(beams)
    for way, axis in frame.ways:
        yield f"displacement of {frame.watched} {way}", 1e3 * abs(ops.nodeDisp(beams.tags[frame.watched], axis + 1))
    for name in frame.bent:
        moments = np.interp(PLACES, np.linspace(0.0, 1.0, PIECES + 1), beams.moments_nm(name))
        for place, moment in zip(PLACES, moments, strict=True):
            yield f"moment of {name} at {place:g} of its length", 1e-3 * abs(moment)
    Beams(frame).put_masses()
    yield "first frequency", first_frequency()


def sunk_at_most_mm() -> float:
    """Largest deflection of the watched node of the grillage once a support has gone at once, from where it was."""
    held, lost = GRILLAGE, GRILLAGE.without_support(LOST)
    beams = Beams(held)
    rest(beams)
    reaction = ops.nodeReaction(beams.tags[LOST])
    before_mm = 1e3 * ops.nodeDisp(beams.tags[held.watched], 3)
    # What follows is linear: what the support gave is taken away from the frame without it, which is at rest with it.
    beams = Beams(lost)
    beams.put_masses()
    ops.timeSeries("Constant", 2)
    ops.pattern("Plain", 2, 2)
    ops.load(beams.tags[LOST], *(-force for force in reaction))
    ops.system("UmfPack")
    ops.numberer("RCM")
    ops.constraints("Plain")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.algorithm("Linear")
    ops.analysis("Transient")
    deepest = 0.0
    for _ in range(STEPS):
        if ops.analyze(1, STEP_S) != 0:
            raise RuntimeError("OpenSees found no solution")
        deepest = min(deepest, ops.nodeDisp(beams.tags[held.watched], 3))
    return -(before_mm + 1e3 * deepest)


if __name__ == "__main__":
    sys.exit(main())
