# SPDX-License-Identifier: GPL-3.0-or-later
"""A reinforced beam without links, which fails in shear long before it would bend: when, against EN 1992-1-1, 6.2.2."""

from pathlib import Path

from case import VALIDATION, Against, Case, Comparison, Found
from loaded_beams import LoadedBeam, collapse_loads_n, courses, draw_courses
from matplotlib.figure import Figure

BEAM = LoadedBeam(3.0, 0.2, 0.4, 0.36, 1440.0, 38.0, 4.0, 0.0, 40)
MOST_N = 1.5 * BEAM.shears_at_n


def run(folder: Path) -> Found:
    """Load a beam of each seed."""
    found = courses(folder, BEAM, MOST_N)
    loads = collapse_loads_n(found)
    comparisons = [
        Comparison(f"load as it comes down, {name}", "kN", 1e-3 * BEAM.shears_at_n, 1e-3 * load, 0.3, Against.MEASURED)
        for name, load in loads.items()
    ]
    comparisons.append(
        Comparison("the same over that in bending, median", "", (0.0, 0.9), loads["median"] / BEAM.bends_at_n)
    )

    def draw(figure: Figure) -> None:
        axes = figure.subplots()
        draw_courses(axes, found, 20.0)
        for load, name in ((BEAM.shears_at_n, "shear"), (BEAM.bends_at_n, "bending")):
            axes.axhline(1e-3 * load, color="0.6", linewidth=0.8)
            axes.text(19.8, 1e-3 * load, f"{name} by EN 1992-1-1", ha="right", va="bottom", fontsize=8)
        axes.legend()

    return Found(comparisons, draw)


CASE = Case(
    name="sheared_beam",
    title="Reinforced beam without links",
    group=VALIDATION,
    asked=f"A beam of {BEAM.span_m:g} m ({BEAM.width_m:g} m × {BEAM.height_m:g} m) with {BEAM.area_mm2:g} mm² near "
    f"its bottom and no links lies on two bearings, cut into {BEAM.shards} irregular shards. A load in its "
    "middle grows. It is strong in bending. At which load does it come down?",
    left_out="The size effect, aggregate interlock but by friction, and bond. What resists is the tensile strength of "
    "concrete in inclined faces, as long as they are whole; then dowels, 0.24 of the yield force of bars, and "
    "friction, 0.7 of what presses.",
    source="V_Rd,c = 0.18 k (100 ρ f_c)^⅓ b d at d from a support, EN 1992-1-1:2004, 6.2.2, with the mean strength "
    f"of {BEAM.compression_n_mm2:g} N/mm² and no factors of safety: a formula fitted to tests.",
    reason="30 % is asked of so coarse a model, and one of three seeds misses it. The beam comes down when inclined "
    "faces from load to support have cracked, where shards have them, within the range of the formula, and "
    "far below its load in bending. But nothing in the model is fitted to it: the formula grows with the cube "
    "root of strength and steel and falls with depth, the model goes by tensile strength and where faces lie. "
    "Take it for the kind of failure, not for its load.",
    run=run,
)
