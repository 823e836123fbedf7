# SPDX-License-Identifier: GPL-3.0-or-later
"""A slab of 8 m with one layer of bars, on a pinned bearing and a rocker, and the load factor of plastic theory."""

import numpy as np

from bridge_demolition_addon.engineering.mechanics.strength import MATERIALS
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.standing import StandingBridge

LENGTH_M, WIDTH_M, DEPTH_M, HEIGHT_M, DENSITY_KG_M3 = 8.2, 1.5, 0.3, 1.0, 2400.0
BARS_M2, YIELD_PA, BARS_DEPTH_M = 1500e-6, 500e6, 0.04
WEIGHT_N_M = DENSITY_KG_M3 * STANDARD_GRAVITY_M_S2 * WIDTH_M * DEPTH_M

_SCENARIO = """
[scenario]
title = "Slab with bars"
seed = {seed}
[time]
duration_s = {duration_s}
frames_per_second = 24
substeps_per_frame = 20
[bridge]
density_kg_m3 = 2400.0
span_lengths_m = [8.0]
[bridge.deck]
width_m = 1.5
thickness_m = 0.3
overhang_m = 0.1
[bridge.piers]
kind = "wall"
column_length_m = 0.4
column_width_m = 1.5
height_m = 1.0
[[supports]]
member = "pier"
[[bearings]]
members = ["deck", "pier 1"]
kind = "pinned"
[[bearings]]
members = ["deck", "pier 2"]
kind = "rocker"
[fracture]
shards = {shards}
[[fracture.members]]
member = "pier"
shards = 1
{points}
[connections]
type = "FIXED"
method = "face"
material = "concrete"
stiffness = "elastic"
limit_per_shard = 1000
warm_up_s = 0.05
ductile_hardening = {hardening}
[[reinforcement]]
members = ["deck"]
depth_m = 0.04
area_mm2 = 1500.0
[shards]
use_deactivation = false
start_deactivated = false
"""


def slab_text(shards, *, seed=1, blocks=False, hardening=1.0, duration_s=1.0):
    """A slab in irregular shards, or in blocks: prisms in a row."""
    lengths_m = LENGTH_M * (np.arange(shards) + 0.5) / shards - (LENGTH_M - 8.0) / 2.0
    places = [f"[[fracture.points]]\nplace_m = [{x:.4f}, 0.0, {HEIGHT_M + DEPTH_M / 2.0}]" for x in lengths_m]
    points = "\n".join(places) if blocks else ""
    return _SCENARIO.format(seed=seed, shards=shards + 2, points=points, hardening=hardening, duration_s=duration_s)


class Slab:
    """The slab, and how it stands."""

    def __init__(self, text):
        self.scenario = scenario_from_text(text)
        self.model = checked_model(self.scenario)
        self.bridge = StandingBridge(self.model, self.scenario.joints)
        self.whole = np.ones(len(self.model.connections))
        self.nothing = np.zeros((6, len(self.model.shards)))

    @property
    def theory(self):
        """M = A f_y (d - a / 2) over the moment in the middle, by hand, of a beam between the axes of its bearings."""
        pull_n = BARS_M2 * YIELD_PA
        depth_m = DEPTH_M - BARS_DEPTH_M - 0.5 * pull_n / (WIDTH_M * MATERIALS["concrete"].compression_pa)
        return pull_n * depth_m / self.moment_nm

    @property
    def moment_nm(self):
        """Moment of the weight in the middle."""
        span_m = float(np.ptp(self.model.bearings.springs.middles_m()[:, 0]))
        return WEIGHT_N_M * LENGTH_M / 2.0 * (span_m / 2.0 - LENGTH_M / 4.0)

    def rest(self, factor=1.0):
        return self.bridge.rest(self.whole > 0.0, self.whole, self.nothing, factor)

    def collapse_factor(self, left=1.0):
        return self.bridge.collapse_factor(self.whole > 0.0, left * self.whole, self.nothing)
