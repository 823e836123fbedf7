# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames and a skewed grillage of steel bars, at rest and as a support is lost, against OpenSees."""

import csv
from pathlib import Path

import numpy as np
from bar_frames import FRAMES, GRILLAGE, LOST, PLACES, BarFrame
from case import VERIFICATION, Case, Comparison, Found, simulated
from matplotlib.figure import Figure
from solids import block

from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.structure.equilibrium import model_at_rest
from bridge_demolition_addon.model.structure.model import Model, build_model

TABLE = Path(__file__).resolve().parents[1] / "docs" / "data" / "bars_by_opensees.csv"
LOST_S, DURATION_S, PROP_M, UNDER_M = 0.1, 0.7, 2.0, 0.5
PROP = f"""
[[geometry]]
name = "prop"
file = "prop.stl"
density_kg_m3 = 2400.0

[[removals]]
time_s = {LOST_S}
members = ["prop"]
"""
"""What holds one corner of the grillage until it goes: so stout that it gives way by less than 0.1 mm."""

UNITS = {"displacement": "mm", "moment": "kN·m", "first": "Hz"}


def run(folder: Path) -> Found:
    """Work out each frame at rest, and let the grillage lose a support in a run."""
    expected = {(row["frame"], row["quantity"]): float(row["value"]) for row in _rows()}
    comparisons = [
        Comparison(
            f"{frame.title}: {quantity}", UNITS[quantity.split()[0]], expected[frame.title, quantity], found, 0.01
        )
        for frame in FRAMES
        for quantity, found in quantities(frame).items()
    ]
    times_s, sunk_mm = sinking(folder)
    deepest = f"largest deflection after {LOST} is lost"
    comparisons.append(
        Comparison(f"{GRILLAGE.title}: {deepest}", "mm", expected[GRILLAGE.title, deepest], float(sunk_mm.max()), 0.02)
    )

    def draw(figure: Figure) -> None:
        axes = figure.subplots()
        axes.plot(times_s, sunk_mm, color="black", label="run")
        axes.axhline(expected[GRILLAGE.title, deepest], color="0.6", linewidth=0.8, label="OpenSees, largest")
        axes.set(xlabel="time (s)", ylabel=f"deflection of {GRILLAGE.watched} (mm)")
        axes.legend()

    return Found(comparisons, draw)


def _rows() -> list[dict[str, str]]:
    with TABLE.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def quantities(frame: BarFrame) -> dict[str, float]:
    """Return displacements, mm, moments, kN·m, and the first frequency of a frame at rest under its weight."""
    scenario = scenario_from_text(frame.scenario())
    model = build_model(scenario)
    rest = model_at_rest(model, scenario.joints)
    node = body_of(model, frame.watched)
    found = {
        f"displacement of {frame.watched} {way}": 1e3 * abs(rest.positions_m[axis, node] - model.centres_m[node, axis])
        for way, axis in frame.ways
    }
    for name in frame.bent:
        for place, moment in zip(PLACES, moments_nm(model, rest.loads, name), strict=True):
            found[f"moment of {name} at {place:g} of its length"] = 1e-3 * abs(moment)
    return found | {"first frequency": rest.frequency_hz}


def body_of(model: Model, member: str) -> int:
    """Return the body of a member that has one, as a node does."""
    (body,) = np.flatnonzero(model.member_of_shard == [part.name for part in model.members].index(member))
    return int(body)


def moments_nm(model: Model, loads: np.ndarray, name: str) -> np.ndarray:
    """Return the moment about the strong axis of a bar at places along it, by that of its joints to both sides."""
    steel = model.steel
    index = [part.name for part in model.members].index(name)
    mine = np.flatnonzero(steel.joints.members == index)
    order = np.argsort(steel.joints.numbers[mine])
    rows, bar = steel.rows[mine][order], model.members[index].steel.bar
    signs = np.where(model.connections.pairs[rows, 0] == steel.joints.pairs[mine, 0][order], 1.0, -1.0)
    about = bar.axes[:, 1] @ (signs * loads[3:, rows])
    along = bar.joints_m[steel.joints.numbers[mine]][order] / bar.length_m
    return np.interp(PLACES, along, about)


def sinking(folder: Path) -> tuple[np.ndarray, np.ndarray]:
    """Return times, s, and how far the watched node of the grillage is below its place without loads, mm."""
    x, y, z = GRILLAGE.nodes[LOST].position_m
    half = 0.5 * PROP_M
    prop = block((x - half, y - half, 0.0), (x + half, y + half, z - UNDER_M))
    text = GRILLAGE.on(LOST, "prop").scenario().replace("duration_s = 1.0", f"duration_s = {DURATION_S}") + PROP
    results = simulated(folder, "grillage", text, {"prop": prop})
    (node,) = np.flatnonzero(results.inventory.body_members == GRILLAGE.watched)
    return results.frames.time_s, 1e3 * (
        GRILLAGE.nodes[GRILLAGE.watched].position_m[2] - results.frames.positions_m[:, node, 2]
    )


CASE = Case(
    name="bars_by_program",
    title="Frames and a grillage of steel bars",
    group=VERIFICATION,
    asked="A frame of two bays and two storeys leans by 1 in 8, and a grillage of three girders of 16 m with three "
    "cross beams has a skew of 25° and 4 t on an outer girder. How far do they go, what moments do bars carry, and how "
    "slow is the first vibration? Then one support of the loaded girder goes at once. Each bar is in 16 pieces.",
    left_out="Yield: stresses stay below it. First frequencies are those without loads; columns that carry weight sway "
    "more slowly in a run.",
    source="OpenSees 3.8 with 16 beams of Timoshenko a bar, loads at rest on what has moved, and Newmark's method once "
    "the support has gone: `scripts/experiments/bars_by_opensees.py`, [its results](data/bars_by_opensees.csv).",
    reason="1 % at rest, as asked of frames. 2 % of the largest deflection in motion: sub-steps damp a little.",
    run=run,
)
