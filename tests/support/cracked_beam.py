# SPDX-License-Identifier: GPL-3.0-or-later
"""The beam of `prestressed_beam` with bars in place of tendons, as it cracks, and its cracked section by hand."""

import math

import numpy as np

from bridge_demolition_addon.model.structure.cracking import CrackedBridge
from bridge_demolition_addon.model.structure.equilibrium import model_at_rest
from bridge_demolition_addon.model.structure.utilisation import Utilisations

from .prestressed_beam import DEPTH_M, INERTIA_M4, WIDTH_M

AREA_MM2, BELOW_M = 3500.0, 0.08
BARS = f"""
[[reinforcement]]
members = ["deck"]
side = "bottom"
depth_m = {BELOW_M}
area_mm2 = {AREA_MM2}
diameter_mm = 25.0
"""


def cracked(beam):
    """The beam in statics, which cracks as it carries its weight."""
    model, joints, whole = beam.model, beam.scenario.joints, np.ones(len(beam.model.connections))
    return CrackedBridge(model, joints, Utilisations(model, joints), whole > 0.0, whole, model_at_rest(model, joints))


def cracked_stiffness_nm2(beam, area_mm2=AREA_MM2):
    """E I of the cracked section: b x² / 2 = α A (d - x), I = b x³ / 3 + α A (d - x)²."""
    ratio, depth = 200e9 * INERTIA_M4 / beam.stiffness_nm2, DEPTH_M - BELOW_M
    steel = ratio * area_mm2 * 1e-6
    pressed = (-steel + math.sqrt(steel * steel + 2.0 * WIDTH_M * steel * depth)) / WIDTH_M
    second = WIDTH_M * pressed**3 / 3.0 + steel * (depth - pressed) ** 2
    return beam.stiffness_nm2 * second / INERTIA_M4
