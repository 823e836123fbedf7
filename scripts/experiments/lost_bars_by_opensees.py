# SPDX-License-Identifier: GPL-3.0-or-later
"""Calculate a truss by OpenSees without each of its bars, which the test of critical bars compares with.

It is that of examples/steel/truss_severed.toml, with its deck and with a heavier one. Each bar is 8 elastic beams, with
half of their weight at each of their ends; feet are fixed. First order: linear beams of Timoshenko. Second order: beams
of Euler that go with what moves and turns, `Corotational`, in ten steps of the load. A bar is judged by forces where it
begins, where it ends, and at the joints between its pieces: N / N_pl + M_y / M_pl,y + M_z / M_pl,z, the linear rule of
EN 1993-1-1:2005, 6.2.1 (7), and with shear and torsion √(… ² + …²), as docs/steel.md has it. Without a bar, the others
are judged; its plates stay at the nodes. It needs openseespy, as `bridges_by_opensees.py` does.

Usage: lost_bars_by_opensees.py writes docs/data/lost_bars_by_opensees.csv
"""

from __future__ import annotations

import csv
import math
import sys
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import openseespy.opensees as ops
from bridges_by_opensees import GRAVITY_M_S2

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from bridge_demolition_addon.engineering.steelwork.bars import SteelBar
from bridge_demolition_addon.model.scenario import Scenario
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.structure.model import build_model

ROOT = Path(__file__).resolve().parents[2]
TABLE = ROOT / "docs" / "data" / "lost_bars_by_opensees.csv"
EXAMPLE = ROOT / "examples" / "steel" / "truss_severed.toml"
YOUNG_PA, SHEAR_PA, DENSITY_KG_M3, YIELD_PA = 210e9, 210e9 / 2.6, 7850.0, 355e6
BEAMS = 8
HEADINGS = ("deck_kg_m", "lost", "most_used", "utilisation", "most_used_2nd_order", "utilisation_2nd_order", "by")
DECKS_KG_M = (5000.0, 7500.0)


def main() -> int:
    """Write the table."""
    version, rows = ops.version(), []
    for deck_kg_m in DECKS_KG_M:
        frame = Frame(with_deck(read_scenario(EXAMPLE), deck_kg_m))
        for lost in (None, *frame.bars):
            worst = (max(frame.uses(lost, order), key=lambda use: use[1]) for order in (1, 2))
            found = [text for name, used in worst for text in (name, f"{used:.4g}")]
            rows.append((f"{deck_kg_m:g}", lost or "none", *found, f"OpenSees {version}"))
            print(*rows[-1], flush=True)
    with TABLE.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([HEADINGS, *rows])
    return 0


def with_deck(scenario: Scenario, deck_kg_m: float) -> Scenario:
    """Return the scenario of the truss with a deck of another mass."""
    steelwork = scenario.steelwork
    (truss,) = steelwork.trusses
    return replace(scenario, steelwork=replace(steelwork, trusses=(replace(truss, deck_kg_m=deck_kg_m),)))


class Frame:
    """The truss: places and masses of its nodes, and its bars."""

    def __init__(self, scenario: Scenario):
        self.nodes = {node.name: node for node in scenario.steelwork.all_nodes}
        # Of the model, only where bars begin and end at the plates of nodes, and where they are cut, is used.
        self.bars: dict[str, SteelBar] = {
            member.name: member.steel.bar for member in build_model(scenario).members if member.steel.bar
        }
        self.ends = {member.name: member.nodes for member in scenario.steelwork.all_members}

    def uses(self, lost: str | None, order: int) -> Iterator[tuple[str, float]]:
        """Yield how much of its section each bar uses at most, without one of them."""
        ops.wipe()
        ops.model("basic", "-ndm", 3, "-ndf", 6)
        tags = {name: number for number, name in enumerate(self.nodes, 1)}
        masses = {tags[name]: node.mass_kg for name, node in self.nodes.items()}
        for name, node in self.nodes.items():
            ops.node(tags[name], *node.position_m)
            if node.support == "fixed":
                ops.fix(tags[name], *[1] * 6)
        beams = {}
        for number, (name, bar) in enumerate(self.bars.items(), 1):
            begin, end = (tags[node] for node in self.ends[name])
            if name == lost:
                for tag, within_m in zip((begin, end), bar.within_m, strict=True):
                    masses[tag] += DENSITY_KG_M3 * bar.section.area_m2 * float(within_m)
            else:
                beams[name] = add_bar(number, bar, begin, end, masses, order)
        ops.timeSeries("Linear", 1)
        ops.pattern("Plain", 1, 1)
        for tag, mass_kg in masses.items():
            ops.load(tag, 0.0, 0.0, -GRAVITY_M_S2 * mass_kg, 0.0, 0.0, 0.0)
        ops.system("UmfPack")
        ops.numberer("RCM")
        ops.constraints("Plain")
        ops.test("NormDispIncr", 1e-8, 50)
        ops.integrator("LoadControl", 1.0 if order == 1 else 0.1)
        ops.algorithm("Linear" if order == 1 else "Newton")
        ops.analysis("Static")
        if ops.analyze(1 if order == 1 else 10) != 0:
            raise RuntimeError(f"OpenSees found no solution without {lost}")
        for name, elements in beams.items():
            yield name, section_used(self.bars[name], elements)


def add_bar(number: int, bar: SteelBar, begin: int, end: int, masses: dict[int, float], order: int) -> list[int]:
    """Add the beams of a bar between two nodes, with their masses, and return their tags."""
    inner = [1000 * number + row for row in range(1, BEAMS)]
    for row, tag in enumerate(inner, 1):
        ops.node(tag, *(bar.begin_m + (bar.end_m - bar.begin_m) * row / BEAMS).tolist())
        masses[tag] = 0.0
    ops.geomTransf("Linear" if order == 1 else "Corotational", number, *bar.axes[:, 2].tolist())
    section, (about_y, about_z) = bar.section, np.diag(bar.section.shape.second_moments_m4).tolist()
    twist = float(section.torsion_m4)
    elements = []
    for row, (one, other) in enumerate(pairwise([begin, *inner, end])):
        if order == 1:
            of_beam = (YOUNG_PA, SHEAR_PA, section.area_m2, twist, about_y, about_z, *section.shear_areas_m2.tolist())
            ops.element("ElasticTimoshenkoBeam", 1000 * number + row, one, other, *of_beam, number)
        else:
            of_beam = (section.area_m2, YOUNG_PA, SHEAR_PA, twist, about_y, about_z)
            ops.element("elasticBeamColumn", 1000 * number + row, one, other, *of_beam, number)
        elements.append(1000 * number + row)
        for tag in (one, other):
            masses[tag] += 0.5 * DENSITY_KG_M3 * bar.section.area_m2 * bar.length_m / BEAMS
    return elements


def section_used(bar: SteelBar, elements: list[int]) -> float:
    """Return how much of its section a bar uses at most, at its joints."""
    size_m, section = bar.length_m / BEAMS, bar.section
    plastic_n, shear_pa = YIELD_PA * section.area_m2, YIELD_PA / math.sqrt(3.0)
    plastic_y, plastic_z = YIELD_PA * section.shape.plastic_moduli_m3
    used = 0.0
    for along_m in bar.joints_m.tolist():
        row = min(int(along_m / size_m), BEAMS - 1)
        at = np.array(ops.eleResponse(elements[row], "localForce"))
        share = along_m / size_m - row
        axial, shear_y, shear_z, torsion = at[6:10]
        moments = (1.0 - share) * -at[[4, 5]] + share * at[[10, 11]]
        edge = abs(axial) / plastic_n + abs(moments[0]) / plastic_y + abs(moments[1]) / plastic_z
        across = math.hypot(shear_y, shear_z) / (shear_pa * float(section.plastic_shear_areas_m2.min()))
        across += abs(torsion) / (shear_pa * section.torsion_modulus_m3)
        used = max(used, math.hypot(edge, across))
    return used


if __name__ == "__main__":
    sys.exit(main())
