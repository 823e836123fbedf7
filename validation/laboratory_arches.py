# SPDX-License-Identifier: GPL-3.0-or-later
"""Arches of a laboratory, loaded to collapse: as blocks that only touch, and with brittle mortar."""

from pathlib import Path

import numpy as np
from arches import Arch, G, first_crack_n, limit_load_n, loaded
from case import VALIDATION, Against, Case, Comparison, Found
from matplotlib.figure import Figure

SPAN_M = 3.3
ARC = {"span_m": SPAN_M, "rise_m": 0.83, "density_kg_m3": 18000.0 / G, "voussoirs": 20}
ARCHES = {
    "ring of 120 mm": Arch(**ARC, ring_m=0.12, width_m=0.25),
    "ring of 60 mm": Arch(**ARC, ring_m=0.06, width_m=0.3),
}
MEASURED_N = {"ring of 120 mm": 2080.0, "ring of 60 mm": 390.0}
LOAD_X_M = 0.556 - SPAN_M / 2.0
SETTLING_S, GROWTH_S, MOST, FALLEN_M = 0.3, 1.0, 1.4, 0.02
BOND_PA = 1e5
MORTAR = f"""
[connections]
type = "FIXED"
method = "face"
material = "mortar"
stiffness = "elastic"

[[materials]]
name = "mortar"
compression_n_mm2 = 10.0
tension_n_mm2 = {BOND_PA / 1e6}
shear_n_mm2 = {2.0 * BOND_PA / 1e6}
torsion_n_mm2 = {2.0 * BOND_PA / 1e6}
bending_n_mm2 = {BOND_PA / 1e6}
elastic_modulus_n_mm2 = 1000.0
"""


def run(folder: Path) -> Found:
    """Load both arches without mortar, and the thinner one with it."""
    limits = {name: limit_load_n(arch, LOAD_X_M) for name, arch in ARCHES.items()}
    courses = {name: _course(folder, name, limits[name]) for name in ARCHES}
    comparisons = [
        Comparison(f"{name}, by limit analysis", "N", limits[name], course.borne_n(FALLEN_M), 0.1)
        for name, course in courses.items()
    ]
    comparisons += [
        Comparison(f"{name}, against the test", "N", MEASURED_N[name], course.borne_n(FALLEN_M), 0.2, Against.MEASURED)
        for name, course in courses.items()
    ]
    thin = "ring of 60 mm"
    bonded = _course(folder, thin, limits[thin], MORTAR)
    cracked = first_crack_n(ARCHES[thin], LOAD_X_M, BOND_PA)
    holding = limit_load_n(ARCHES[thin], LOAD_X_M, BOND_PA)
    comparisons += [
        Comparison(f"{thin}, first crack of mortar with 0.1 N/mm²", "N", cracked, bonded.cracked_n, 0.2),
        Comparison(f"{thin} with it, down by 2 mm", "N", (0.9 * limits[thin], holding), bonded.load_at_n(0.002)),
    ]

    def draw(figure: Figure) -> None:
        for axes, name in zip(figure.subplots(1, 2), ARCHES, strict=True):
            course = courses[name]
            axes.plot(1e3 * course.sag_m, course.resistance_n, color="black", label="blocks that touch")
            if name == thin:
                cracks = slice(0, int(np.argmax(np.diff(bonded.sag_m) < 0.0)))  # its parts then jump
                axes.plot(
                    1e3 * bonded.sag_m[cracks], bonded.load_n[cracks], "--", color="black", label="brittle mortar"
                )
            axes.axhline(limits[name], color="0.6", linewidth=1.0, label="limit analysis")
            axes.axhline(MEASURED_N[name], color="black", linewidth=1.0, linestyle=":", label="measured")
            axes.set(title=name, xlabel="loaded voussoir down by (mm)", ylabel="load that it carries (N)")
            axes.set(xlim=(0.0, 10.0), ylim=(0.0, 1.25 * MEASURED_N[name]))
        axes.legend(fontsize=8, loc="lower right")

    return Found(comparisons, draw)


def _course(folder: Path, name: str, limit_n: float, connections: str = ""):
    course = ((SETTLING_S, 0.0), (SETTLING_S + GROWTH_S, MOST * limit_n))
    run_name = name.replace(" ", "_") + ("_with_mortar" if connections else "")
    return loaded(folder, run_name, ARCHES[name], LOAD_X_M, course, connections=connections)


CASE = Case(
    name="laboratory_arches",
    title="Arches of a laboratory, loaded to collapse",
    group=VALIDATION,
    asked="Two brick arches of 3.3 m, built with mortar, came down under a line load at 0.56 m from their springing, "
    "as mechanisms of four hinges. Their rings have 20 voussoirs here: blocks that only touch, and with a mortar of "
    "0.1 N/mm² that breaks as a whole once the edge of a joint reaches that.",
    left_out="Bond that goes on holding beside a crack: a joint is whole or broken here. The walls beside the "
    "thicker arch, with which its authors' own model carries 1725 N without any bond. Bricks within a voussoir. "
    "There is no fill, so that its pressure explains nothing here.",
    source="2080 N and 390 N: F. G. Carozzi, C. Poggi, E. Bertolesi and G. Milani (2018), and the numerical "
    "companion of E. Bertolesi and others (2018), as a public repository quotes them; 18 kN/m³ is its assumption. "
    "Bertolesi's own limit analysis gives 261 N without bond for the thinner one, and 919 N with 0.1 N/mm² that "
    "holds on. Limit loads here: as for Prestwood; mortar that holds on as it opens adds a constant pull.",
    reason="10 % of limit analysis, as contacts sink. 20 % of the first crack, by beam theory of a whole elastic "
    "ring (`first_crack_n` there): its own weight uses half of that bond already, so that 5 % of stress are 11 % of "
    "load; and a frame is 7 N. This case showed that joints of whole members deformed unevenly, which is mended. The "
    "tests are missed by half, 20 % was wished for: they carried 2.4 and 1.7 times what blocks do that only touch, "
    "by mortar and walls. Brittle mortar cracks long before blocks come down, and adds little: between nine tenths "
    "of their limit and that of a mortar that holds on is expected. By beam theory the first crack would be at the "
    "390 N that were measured with 0.27 N/mm².",
    run=run,
)
