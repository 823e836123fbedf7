# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of docs/ground_motion.md and docs/foundations.md: a record that is made, and how a footing bears.

Usage: python scripts/pictures/ground_pictures.py
"""

from pathlib import Path

import numpy as np

from bridge_demolition_addon.charts.histories import ground_motion_history, response_spectra
from bridge_demolition_addon.charts.style import blank_figure, line_style
from bridge_demolition_addon.engineering.core.calls import call
from bridge_demolition_addon.engineering.foundations import Footings, SoilSprings
from bridge_demolition_addon.model.ground_motion.settings import DesignSpectrum, GroundMotion
from bridge_demolition_addon.model.ground_motion.sources import ground_record

PICTURES = Path(__file__).resolve().parents[2] / "docs" / "pictures"

WIDTH_M, SIDES = 2.0, 40
STIFFNESS_N_M3, CAPACITY_PA = 44.8e6, 1120e3
LOAD_N = 8e5


def footings(capacity_pa: float) -> Footings:
    """A square footing of 2 m on medium dense sand, under a body at the same place."""
    middles = WIDTH_M * ((np.arange(SIDES) + 0.5) / SIDES - 0.5)
    x, y = (grid.ravel() for grid in np.meshgrid(middles, middles))
    one = np.ones(1)
    soil = SoilSprings(
        np.zeros(1, int),
        np.zeros(len(x), int),
        np.column_stack((x, y, np.zeros(len(x)))),
        np.full(len(x), WIDTH_M**2 / len(x)),
        STIFFNESS_N_M3 * one,
        STIFFNESS_N_M3 * one,
        capacity_pa * one,
        one,
    )
    ends = np.zeros(1, int), np.ones(1, int)
    return Footings(soil, *ends, np.array([True, False]), np.zeros((3, 2)), both(np.eye(3)))


def both(rotation: np.ndarray) -> np.ndarray:
    """Rotations (3, 3, 2) of the body and of the ground."""
    return np.stack((rotation, np.eye(3)), axis=2)


def borne(bed: Footings, settled_m: float, turn_rad: float = 0.0) -> np.ndarray:
    """Force and moment (6,) on the body, settled and turned so far."""
    cosine, sine = np.cos(turn_rad), np.sin(turn_rad)
    rotation = both(np.array([[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]]))
    positions = np.array([[0.0, 0.0, -settled_m], [0.0, 0.0, 0.0]]).T
    bed.update_plastic_state(positions, rotation)
    springs = bed.term(np.zeros(1, int))
    springs.begin(positions, rotation)
    forces = np.zeros((3, SIDES * SIDES))
    call("bda_try_term", springs, np.zeros_like(forces), forces)
    moments = np.cross(springs.arrays["second_arms"], forces, axis=0)
    return -np.concatenate((forces, moments)).sum(axis=1)  # resisted, on the body


def moment(bed: Footings, turn_rad: float) -> float:
    """Moment about y with which a footing under a load answers to a turn."""
    low, high = -0.1, 0.1
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if borne(bed, middle, turn_rad)[2] < LOAD_N else (low, middle)
    return float(-borne(bed, low, turn_rad)[4])


def draw_footing() -> None:
    """Draw load over settlement, and moment over turn."""
    figure = blank_figure(9.0, 3.6, layout="constrained", dpi=130)
    left, right = figure.subplots(1, 2)
    bed = footings(CAPACITY_PA)
    way_mm = np.concatenate([np.linspace(a, b, 60) for a, b in ((0, 40), (40, 8), (8, 50))])
    forces = [borne(bed, one_way_mm / 1e3)[2] / 1e6 for one_way_mm in way_mm.tolist()]
    left.plot(way_mm, forces, **line_style(0))
    left.set_xlabel("settlement (mm)")
    left.set_ylabel("load (MN)")
    bed = footings(np.inf)
    turns = np.linspace(0.0, 0.02, 60)
    right.plot(1e3 * turns, [moment(bed, turn) / 1e3 for turn in turns.tolist()], **line_style(0), label="footing")
    pressed_m = np.sqrt(2.0 * LOAD_N / (STIFFNESS_N_M3 * WIDTH_M * turns[1:]))
    theory = np.where(
        pressed_m < WIDTH_M,
        LOAD_N * (WIDTH_M / 2.0 - pressed_m / 3.0),
        STIFFNESS_N_M3 * WIDTH_M**4 / 12.0 * turns[1:],
    )
    right.plot(1e3 * turns[1:], theory / 1e3, **line_style(1), label="Winkler's bed without tension")
    right.axhline(LOAD_N * WIDTH_M / 2e3, color="0.6", linewidth=0.8)
    right.set_xlabel("turn (mrad)")
    right.set_ylabel(f"moment under {LOAD_N / 1e3:.0f} kN (kN·m)")
    right.legend(frameon=False, loc="lower right")
    for axes in (left, right):
        axes.grid(color="0.9", linewidth=0.5)
        axes.set_axisbelow(True)
    figure.savefig(PICTURES / "foundations.png")


def draw_motion() -> None:
    """Draw a record and its spectrum."""
    spectrum = DesignSpectrum(acceleration_m_s2=2.0, ground_type="C")
    record = ground_record(GroundMotion(directions=("along", "across"), spectrum=spectrum), seed=1)
    figure = blank_figure(9.0, 4.2, layout="constrained", dpi=130)
    left, right = figure.subfigures(1, 2, width_ratios=(3, 2))
    ground_motion_history(left, record, 0.0)
    response_spectra(right, record, spectrum, 1.0)
    figure.savefig(PICTURES / "ground_motion.png")


if __name__ == "__main__":
    draw_motion()
    draw_footing()
