# SPDX-License-Identifier: GPL-3.0-or-later
"""A reinforced beam with links under a load that grows: when it comes down, and how far it bends, by EN 1992-1-1."""

from pathlib import Path
from typing import TypeVar

import numpy as np
from case import VERIFICATION, Case, Comparison, Found
from loaded_beams import LoadedBeam, collapse_loads_n, courses, draw_courses
from matplotlib.figure import Figure

BEAM = LoadedBeam(4.0, 0.3, 0.4, 0.35, 900.0, 38.0, 1000.0, 4000.0, 40)
Numbers = TypeVar("Numbers", float, np.ndarray)
MOST_N = 1.3 * BEAM.bends_at_n
BENDS_UNTIL = 0.95
"""Part of the load of plastic theory at which deflections are compared: bars yield at about the same."""


def run(folder: Path) -> Found:
    """Load a beam of each seed."""
    found = courses(folder, BEAM, MOST_N)
    at_n = BENDS_UNTIL * BEAM.bends_at_n
    bends = [float(np.interp(at_n, *of_seed)) for of_seed in found.values()]
    comparisons = [
        Comparison(f"load as it comes down, {name}", "kN", 1e-3 * BEAM.bends_at_n, 1e-3 * load, 0.15)
        for name, load in collapse_loads_n(found).items()
    ]
    comparisons.append(
        Comparison("deflection just before, median", "mm", 1e3 * expected_m(at_n), 1e3 * float(np.median(bends)), 0.3)
    )

    def draw(figure: Figure) -> None:
        axes = figure.subplots()
        draw_courses(axes, found, 40.0)
        along = np.array([0.0, BEAM.bends_at_n])
        axes.plot(1e3 * expected_m(along), 1e-3 * along, color="0.6", label="cracked section")
        axes.axhline(1e-3 * BEAM.bends_at_n, color="0.6", linewidth=0.8)
        axes.legend()

    return Found(comparisons, draw)


def expected_m(load_n: Numbers) -> Numbers:
    """Deflection of a beam that is cracked along all of its length, F L³ / (48 E I)."""
    return load_n * BEAM.span_m**3 / (48.0 * BEAM.cracked_stiffness_nm2)


CASE = Case(
    name="bent_beam",
    title="Reinforced beam in bending",
    group=VERIFICATION,
    asked=f"A beam of {BEAM.span_m:g} m ({BEAM.width_m:g} m × {BEAM.height_m:g} m) with {BEAM.area_mm2:g} mm² near its "
    f"bottom and links of {BEAM.links_mm2_m2:g} mm²/m² lies on two bearings, cut into {BEAM.shards} irregular shards. "
    "A load in its middle grows. At which does it come down, and how far does it bend before?",
    left_out="Hardening of bars, failure in shear and of concrete in compression. Bars rupture as their steel and bond "
    "say, so that one crack stands for all that a hinge of 1.2 h has. Concrete between cracks is whole, without bond "
    "that softens.",
    source="F = 4 M / L by hand, A f_y (d - a / 2), a = A f_y / (b f_c), EN 1992-1-1:2004, 3.1.7 (3), less the moment "
    "of its own weight. Deflection of the cracked section, F L³ / (48 E I), b x² / 2 = n A (d - x).",
    reason="15 % of the load: cracks go along inclined faces, which rub, and 3 % are a frame. 30 % of the deflection, "
    "and that is missed: the beam is 2 to 3 times as stiff as its cracked section before it yields. Few faces crack, "
    "mostly near the middle, where a real beam has cracks along most of its length; each opens by what bars stretch "
    "in a hinge. Collapse does not depend on that; frequencies and deflections of cracked bridges do.",
    run=run,
)
