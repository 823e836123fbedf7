# SPDX-License-Identifier: GPL-3.0-or-later
"""Decks on bearings, as scenarios: slabs of 3 × 0.7 m on walls that never move, and strong enough for anything."""

import numpy as np

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.scenario.file import scenario_from_text
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.standing import StandingBridge

WIDTH_M, DEPTH_M, OVERHANG_M = 3.0, 0.7, 0.5
WEIGHT_N_M = 2500.0 * STANDARD_GRAVITY_M_S2 * WIDTH_M * DEPTH_M
TOP_M = 1.7
PINNED_AND_ROCKERS = (("pier 1", 'kind = "pinned"'), ("pier", 'kind = "rocker"'))

_SCENARIO = """
[scenario]
title = "deck on bearings"
seed = {seed}
[time]
duration_s = {duration_s}
frames_per_second = 50
substeps_per_frame = 10
[bridge]
density_kg_m3 = 2500
span_lengths_m = {spans}
[bridge.deck]
width_m = 3.0
thickness_m = 0.7
overhang_m = 0.5
[bridge.piers]
kind = "wall"
column_length_m = {support_m}
column_width_m = 3.0
height_m = 1.0
{supports}
[fracture]
shards = {shards}
[[fracture.members]]
member = "pier"
shards = 1
[[materials]]
name = "strong"
compression_n_mm2 = 1e4
tension_n_mm2 = 1e4
shear_n_mm2 = 1e4
torsion_n_mm2 = 1e4
bending_n_mm2 = 1e4
elastic_modulus_n_mm2 = 30000
poisson_ratio = 0.2
[connections]
type = "FIXED"
method = "face"
material = "strong"
stiffness = "{stiffness}"
{damping}
limit_per_shard = 1000
[shards]
use_deactivation = false
start_deactivated = false
linear_damping = 0.0
angular_damping = 0.0
"""


def deck_text(
    bearings=PINNED_AND_ROCKERS,
    *,
    spans=(10.0, 15.0),
    shards=40,
    seed=1,
    support_m=0.6,
    stiffness="elastic",
    damping_ratio=None,
    duration_s=0.2,
    are_held=True,
    more="",
):
    """A deck in so many shards, and a wall under each end of a span; bearings are walls and the other keys of each.

    Walls are held, or stand on the ground by a connection and can be taken away.
    """
    tables = [f'[[bearings]]\nmembers = ["deck", "{wall}"]\n{keys}\n' for wall, keys in bearings]
    text = _SCENARIO.format(
        seed=seed,
        duration_s=duration_s,
        spans=list(spans),
        support_m=support_m,
        shards=shards + len(spans) + 1,
        stiffness=stiffness,
        damping="" if damping_ratio is None else f"damping_ratio = {damping_ratio}",
        supports='[[supports]]\nmember = "pier"' if are_held else "",
    )
    return "".join((text, *tables, more))


def standing_deck(text, force_n=(0.0, 0.0, 0.0), at_m=None):
    """The model of a scenario at rest, maybe under a force on its deck: how it stands, and the forces of its bearings.

    Forces are by the name of what is below.
    """
    scenario = scenario_from_text(text)
    model = checked_model(scenario)
    loads = np.zeros((6, len(model.shards)))
    if at_m is not None:
        deck = np.flatnonzero(model.member_of_shard == [member.name for member in model.members].index("deck"))
        shard = deck[np.abs(model.centres_m[deck] - at_m).sum(axis=1).argmin()]
        loads[:3, shard], loads[3:, shard] = force_n, np.cross(at_m - model.centres_m[shard], force_n)
    count = len(model.connections)
    standing = StandingBridge(model, scenario.joints).rest(np.ones(count, bool), np.ones(count), loads)
    forces = {bearing.name.removeprefix("deck on "): bearing for bearing in model.bearings.forces(standing.loads)}
    return model, standing, forces
