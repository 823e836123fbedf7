# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure and draw what iterations make of a fixed beam, with rigid and with elastic connections, next to theory.

Usage: elastic_beam.py measure | draw. The beam is 12 m of concrete, 1 m wide and deep, in 20 blocks, fixed at both
ends; measured after 3 s, with 10 sub-steps in each of 24 frames a second.
"""

import csv
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))

DATA = ROOT / "docs" / "data" / "elastic_beam.csv"
PICTURE = ROOT / "docs" / "pictures" / "elastic_beam.png"
ITERATIONS = (1, 2, 5, 10, 20, 50, 100, 200)
COLUMNS = ("stiffness", "iterations", "sag_over_theory", "end_moment_over_theory")
LENGTH_M, COUNT, DENSITY_KG_M3, FRAMES = 12.0, 20, 2400.0, 72


def main(arguments: list[str]) -> int:
    """Measure or draw."""
    if arguments == ["measure"]:
        rows = [
            (name, iteration, *measured(iteration, name)) for name in ("rigid", "elastic") for iteration in ITERATIONS
        ]
        with DATA.open("w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows([COLUMNS, *rows])
    elif arguments == ["draw"]:
        draw()
    else:
        print(__doc__, file=sys.stderr)
        return 2
    return 0


def measured(iterations: int, stiffness: str) -> tuple[float, float]:
    """Return sag and moment at the end of the beam, over those of theory."""
    import bpy
    from support.blocks import Blocks

    from bridge_demolition_addon.engineering.elasticity.section_stiffness import ElasticModuli, whole_section_stiffness
    from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
    from bridge_demolition_addon.scene.connections.elasticity import keep_elasticity

    bpy.ops.wm.read_factory_settings(use_empty=True)
    blocks, size, moduli = Blocks(solver_iterations=iterations), LENGTH_M / COUNT, ElasticModuli(30e9, 0.2)
    bodies = [
        blocks.block(((number + 0.5) * size, 0, 10), DENSITY_KG_M3 * size if 0 <= number < COUNT else 0.0, (size, 1, 1))
        for number in range(-1, COUNT + 1)
    ]
    made = [
        blocks.connect("FIXED", (number * size, 0, 10), *bodies[number : number + 2]) for number in range(COUNT + 1)
    ]
    for connection in made:
        connection["bda_area_m2"], connection["bda_normal"] = 1.0, (1.0, 0.0, 0.0)
    if stiffness == "elastic":
        ones = np.ones(COUNT + 1)
        lengths = size * np.where(np.arange(COUNT + 1) % COUNT == 0, 0.5, 1.0)
        sections = np.tile(np.eye(2) / 12.0, (COUNT + 1, 1, 1)), lengths
        kept = whole_section_stiffness(moduli.young_pa * ones, moduli.shear_pa * ones, ones, *sections)
        keep_elasticity(blocks.scene, made, kept, 0.05)
    with tempfile.TemporaryDirectory() as folder:
        results = blocks.play(Path(folder), FRAMES)
        sag = 10.0 - results.frames.positions_m[-1, :, 2].min()
        first = results.inventory.connection_names.tolist().index(made[0].name)
        moment = abs(results.frames.loads.connection_moments_nm[-1][first, 1])
    weight, bending = DENSITY_KG_M3 * STANDARD_GRAVITY_M_S2, moduli.young_pa / 12.0
    in_theory = weight * (LENGTH_M**4 / (384.0 * bending) + LENGTH_M**2 / (8.0 * 5.0 / 6.0 * moduli.shear_pa))
    return float(sag / in_theory), float(moment / (weight * LENGTH_M**2 / 12.0))


def draw() -> None:
    """Draw what was measured."""
    from matplotlib.figure import Figure

    with DATA.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    figure = Figure(figsize=(8.0, 3.4), dpi=150, layout="constrained")
    for axes, column, label in zip(
        figure.subplots(1, 2), COLUMNS[2:], ("sag / theory", "moment at the ends / theory"), strict=True
    ):
        for name, style in (("rigid", "o-"), ("elastic", "s--")):
            own = [row for row in rows if row["stiffness"] == name]
            axes.semilogx(
                [int(row["iterations"]) for row in own], [float(row[column]) for row in own], style, label=name
            )
        axes.set_yscale("log" if column == COLUMNS[2] else "linear")
        axes.axhline(1.0, color="0.6", linewidth=0.8, zorder=0)
        axes.set_xlabel("iterations of Bullet's solver")
        axes.set_ylabel(label)
        axes.set_xticks(ITERATIONS, map(str, ITERATIONS))
        axes.minorticks_off()
        axes.grid(color="0.9")
        axes.spines[["top", "right"]].set_visible(False)
        axes.legend(frameon=False)
    figure.savefig(PICTURE)


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
