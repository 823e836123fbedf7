# SPDX-License-Identifier: GPL-3.0-or-later
"""An arch bridge and frames by their sizes, and what their parts press on each other with at rest."""

import numpy as np

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.structure.equilibrium import model_at_rest
from bridge_demolition_addon.model.structure.model import build_model

DENSITY_KG_M3 = 2500.0
WEIGHT_N_M3 = DENSITY_KG_M3 * STANDARD_GRAVITY_M_S2

_HEAD = """
[scenario]
title = "At rest"
seed = {seed}
[time]
duration_s = 10.0
[bridge]
density_kg_m3 = 2500.0
span_lengths_m = {spans}
[fracture]
shards = {shards}
{points}
[connections]
type = "FIXED"
method = "face"
material = "concrete"
stiffness = "elastic"
limit_per_shard = 1000
"""

ARCH = """
[bridge.deck]
width_m = 6.0
thickness_m = 0.4
overhang_m = 0.4
[bridge.piers]
kind = "wall"
column_length_m = 0.4
column_width_m = 5.0
height_m = 9.5
[bridge.arch]
span_m = 35.0
rise_m = 7.0
springing_m = 1.0
thickness_m = 0.7
width_m = 5.0
block_length_m = 3.0
"""
ARCH_SPANS = [6.0, 5.0, 5.0, 5.0, 5.0, 5.0, 6.0]

FRAME = """
[bridge.deck]
width_m = 2.0
thickness_m = 0.7
overhang_m = 0.4
[bridge.frame]
clear_height_m = 5.5
leg_thickness_m = 0.8
leg_width_m = 2.0
"""
FRAME_SPANS = [15.0]


def scenario_of(tables, spans, *, shards=60, seed=1, more="", points=""):
    """A scenario of a bridge with these tables beside others."""
    return scenario_from_text(_HEAD.format(seed=seed, spans=spans, shards=shards, points=points) + tables + more)


class AtRest:
    """A bridge at rest, and the forces between its members."""

    def __init__(self, scenario):
        self.scenario, self.model = scenario, build_model(scenario)
        self.rest = model_at_rest(self.model, scenario.joints)
        names = [*(self.model.members[index].name for index in self.model.member_of_shard), "ground"]
        self.pairs = np.array(names)[self.model.connections.pairs % len(names)]

    def on(self, member, other, about_m):
        """Force and moment about a point on a member by another, in N and N·m: (3,) each."""
        return self._sums(
            np.where((self.pairs == (member, other)).all(axis=1), 1.0, 0.0) - self._turned(member, other), about_m
        )

    def beyond(self, x_m, about_m):
        """Force and moment about a point on all shards before a position along the road, by those behind it."""
        before = np.append(self.model.centres_m[:, 0] < x_m, False)
        on_ground = (self.pairs == "ground").any(axis=1)
        first, second = before[self.model.connections.pairs % len(before)].T
        return self._sums(np.where(on_ground, 0.0, first.astype(float) - second), about_m)

    def _turned(self, member, other):
        return np.where((self.pairs == (other, member)).all(axis=1), 1.0, 0.0)

    def _sums(self, signs, about_m):
        forces, moments = self.rest.loads[:3].T * signs[:, None], self.rest.loads[3:].T * signs[:, None]
        arms = self.model.connections.points - np.asarray(about_m, float)
        return forces.sum(axis=0), (moments + np.cross(arms, forces)).sum(axis=0)
