# SPDX-License-Identifier: GPL-3.0-or-later
"""A beam of concrete with tendons, on a pinned bearing and a rocker, and what beam theory says of it by hand."""

import numpy as np

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.standing import StandingBridge

WIDTH_M, DEPTH_M, HEIGHT_M, DENSITY_KG_M3 = 0.5, 1.0, 3.0, 2500.0
AREA_M2, MODULUS_M3, INERTIA_M4 = WIDTH_M * DEPTH_M, WIDTH_M * DEPTH_M**2 / 6.0, WIDTH_M * DEPTH_M**3 / 12.0
WEIGHT_N_M = DENSITY_KG_M3 * STANDARD_GRAVITY_M_S2 * AREA_M2
MIDDLE_M = HEIGHT_M + DEPTH_M / 2.0
AREA_MM2, PRESTRESS_N_MM2, STRENGTH_N_MM2 = 1500.0, 1000.0, 1860.0
FORCE_N = AREA_MM2 * PRESTRESS_N_MM2

_SCENARIO = """
[scenario]
title = "Prestressed beam"
[time]
duration_s = {duration_s}
frames_per_second = 100
substeps_per_frame = 10
[bridge]
density_kg_m3 = 2500.0
span_lengths_m = [{span_m}]
[bridge.deck]
width_m = 0.5
thickness_m = 1.0
overhang_m = 0.0
[bridge.piers]
kind = "wall"
column_length_m = 0.4
column_width_m = 0.5
height_m = 3.0
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
damping_ratio = 0.02
[shards]
use_deactivation = false
start_deactivated = false
"""


def beam_text(tendons="", *, blocks=24, span_m=20.0, duration_s=1.0, irregular=False):
    """A beam in blocks, prisms in a row, or in irregular shards, and tables of tendons."""
    middles_m = span_m * (np.arange(blocks) + 0.5) / blocks
    points = [f"[[fracture.points]]\nplace_m = [{x:.6f}, 0.0, {MIDDLE_M}]" for x in middles_m]
    text = _SCENARIO.format(
        duration_s=duration_s,
        span_m=span_m,
        shards=blocks + 2,
        points="" if irregular else "\n".join(points),
    )
    return text + tendons


def tendon(line, *, name="tendon", area_mm2=AREA_MM2, more=""):
    """A table of a tendon."""
    return (
        f'\n[[tendons]]\nname = "{name}"\nmember = "deck"\n{line}\narea_mm2 = {area_mm2}\n'
        f"prestress_n_mm2 = {PRESTRESS_N_MM2}\nstrength_n_mm2 = {STRENGTH_N_MM2}\n{more}\n"
    )


class Beam:
    """The beam, and how it stands."""

    def __init__(self, text):
        self.scenario = scenario_from_text(text)
        self.model = checked_model(self.scenario)
        self.bridge = StandingBridge(self.model, self.scenario.joints)
        self.whole = np.ones(len(self.model.connections))
        self.nothing = np.zeros((6, len(self.model.shards)))
        pads_m = self.model.bearings.springs.middles_m()[:, 0]
        self.span_m, self.first_m = float(np.ptp(pads_m)), float(pads_m.min())

    @property
    def length_m(self):
        return float(np.ptp(self.model.members[0].solid.vertices[:, 0]))

    @property
    def weight_moment_nm(self):
        """Moment of the weight in the middle of the span, by hand."""
        return WEIGHT_N_M * self.length_m / 2.0 * (self.span_m / 2.0 - self.length_m / 4.0)

    @property
    def stiffness_nm2(self):
        return self.scenario.joints[0].moduli.young_pa * INERTIA_M4

    @property
    def middle_face(self):
        """The connection nearest to the middle of the span."""
        away_m = np.abs(self.model.connections.points - (self.first_m + self.span_m / 2.0, 0.0, MIDDLE_M))
        return int(away_m.sum(axis=1).argmin())

    def rest(self, factor=1.0, cuts=()):
        return self.bridge.rest(self.whole > 0.0, self.whole, self.nothing, factor, cuts=cuts)

    def collapse_factor(self, cuts=()):
        return self.bridge.collapse_factor(self.whole > 0.0, self.whole, self.nothing, cuts=cuts)

    def middle_rises_m(self, standing):
        """How far the middle of the span has risen from where it was built."""
        model, moved = self.model, standing.uncracked.positions_m[2, :-1]
        deck = np.flatnonzero(~model.fixed)
        order = deck[np.argsort(model.centres_m[deck, 0])]
        rises = moved[order] - model.centres_m[order, 2]
        return float(np.interp(self.first_m + self.span_m / 2.0, model.centres_m[order, 0], rises))
