# SPDX-License-Identifier: GPL-3.0-or-later
"""Bridges of every kind, awake in Blender: they stand as they were built, and nothing is thrown apart."""

from dataclasses import replace

import numpy as np
import pytest
from support.long_cases import long_but

from bridge_demolition_addon.engineering.structure.connections import GROUND
from bridge_demolition_addon.model.scenario import (
    Abutments,
    BoxGirder,
    Bridge,
    ConnectionSettings,
    Deck,
    FractureSettings,
    Girders,
    Piers,
    Scenario,
    ShardSettings,
    Support,
    TimeSettings,
)
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.scene.demolition import build_demolition
from bridge_demolition_addon.simulation.blender_events import start_recording, stop_recording
from bridge_demolition_addon.simulation.recording.recorder import Recording

GRAVITY = 9.80665
WALLS = Piers(kind="wall", column_length_m=0.9, column_width_m=6, height_m=5)
SLAB = Bridge(
    density_kg_m3=2400, span_lengths_m=[10, 12], deck=Deck(width_m=8, thickness_m=0.5, overhang_m=0.5), piers=WALLS
)
BOX = BoxGirder(width_m=5, depth_m=1.2, web_thickness_m=0.4, bottom_thickness_m=0.25)
BRIDGES = {
    "girders": replace(SLAB, girders=Girders(number=3, width_m=0.5, depth_m=0.8)),
    "decks apart": replace(SLAB, deck=replace(SLAB.deck, per_span=True, joint_gap_m=0.04)),
    "skewed box between abutments": replace(
        SLAB, box_girder=BOX, skew_deg=25, abutments=Abutments(length_m=1.5, width_m=6)
    ),
    "one solid": replace(SLAB, box_girder=BOX, merge=True),
}
# The solver's rest and the sag of rigid shards after a second; what is thrown apart moves by decimetres.
MOVED_M = 2e-3


def scenario_of(bridge, **values):
    return Scenario(
        title="standing",
        time=TimeSettings(duration_s=1.0, substeps_per_frame=20, solver_iterations=100),
        bridge=bridge,
        fracture=FractureSettings(shards=80),
        connections=ConnectionSettings(type="FIXED", method="face", limit_per_shard=1000, breaking_force_n=1e12),
        shards=ShardSettings(use_deactivation=False, start_deactivated=False),
        **values,
    )


def played(scene, scenario, folder):
    model = build_model(scenario)
    build_demolition(scene, scenario, model)
    recording = Recording(scene, folder)
    start_recording(recording)
    for frame in range(scene.frame_start, scene.frame_end + 1):
        scene.frame_set(frame)
    stop_recording()
    if recording.error:
        raise recording.error
    return model, recording.results()


QUICK = ("skewed box between abutments",)
"""That which has most that could lie loose."""


@pytest.mark.parametrize("name", long_but(QUICK, BRIDGES))
def test_it_stands_and_its_foundations_carry_its_weight(blender, tmp_path, name):
    model, results = played(blender.context.scene, scenario_of(BRIDGES[name]), tmp_path)
    shards = results.inventory.of_kind("shard")
    moved = np.linalg.norm(results.frames.positions_m[-1, shards] - results.frames.positions_m[0, shards], axis=1)
    assert moved.max() < MOVED_M
    assert results.frames.intact.all()
    on_ground = model.connections.pairs[:, 1] == GROUND
    carried = abs(results.frames.loads.connection_forces_n[-1, on_ground, 2].sum())
    # Shards on the ground rest on it with contacts as well only where a foundation gives way, which none does.
    assert carried == pytest.approx(model.masses_kg.sum() * GRAVITY, rel=0.01)


def test_held_abutments_do_not_move_and_carry_the_deck(blender, tmp_path):
    bridge = BRIDGES["skewed box between abutments"]
    scenario = scenario_of(bridge, supports=[Support(member="abutment")])
    model, results = played(blender.context.scene, scenario, tmp_path)
    shards = results.inventory.of_kind("shard")
    held = shards[model.fixed]
    assert len(held) and (results.frames.positions_m[-1, held] == results.frames.positions_m[0, held]).all()
    assert (results.inventory.masses_kg[held] == 0.0).all()
    moved = np.linalg.norm(results.frames.positions_m[-1, shards] - results.frames.positions_m[0, shards], axis=1)
    assert moved.max() < MOVED_M
