# SPDX-License-Identifier: GPL-3.0-or-later
"""Removing a demolition leaves nothing of it behind; supports hold."""

from dataclasses import replace

import numpy as np
import pytest
from support.checkout import REPORT_2019
from support.scenarios import I235

from bridge_demolition_addon.model.scenario import FractureSettings, Support
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.scene.blast.charges import charge_objects
from bridge_demolition_addon.scene.blast.force_fields import force_collection
from bridge_demolition_addon.scene.bodies import Kind, bodies_of, kind_of
from bridge_demolition_addon.scene.connections.constraints import connections_of
from bridge_demolition_addon.scene.demolition import build_demolition
from bridge_demolition_addon.scene.removal import remove_demolition, remove_loose_connections
from bridge_demolition_addon.scene.world import time_is_animated
from bridge_demolition_addon.simulation import blender_events
from bridge_demolition_addon.simulation.blender_events import start_recording, stop_recording
from bridge_demolition_addon.simulation.recording.recorder import Recording

SPAN = replace(I235, fracture=FractureSettings(shards=30))


@pytest.fixture
def watched():
    """Deleting a body that was simulated crashes Blender by itself; the add-on watches over it."""
    blender_events.register()
    yield
    blender_events.unregister()


def shards_of(scene):
    return [body for body in bodies_of(scene) if kind_of(body) == Kind.SHARD]


def play(scene, frames):
    for frame in range(1, frames + 1):
        scene.frame_set(frame)


def ends_of(connection):
    return connection.rigid_body_constraint.object1, connection.rigid_body_constraint.object2


def contents(blender):
    kinds = ("objects", "meshes", "collections")
    return {kind: sorted(data.name for data in getattr(blender.data, kind)) for kind in kinds}


@pytest.mark.parametrize("example", ["i235_one_span", "i235_steps", "single_span_explosives"])
@pytest.mark.parametrize("played", [0, 12])
def test_nothing_is_left_but_the_charges(blender, example, played):
    scenario = read_scenario(REPORT_2019 / f"{example}.toml")
    scenario = replace(scenario, fracture=replace(scenario.fracture, shards=30))
    scenario = replace(scenario, blast=replace(scenario.blast, apply="fields"))
    scene = blender.context.scene
    build_demolition(scene, scenario, build_model(scenario))
    bodies = len(bodies_of(scene))
    play(scene, played)
    assert remove_demolition(scene) == bodies
    charges = sorted(charge.name for charge in scenario.charges)
    assert contents(blender) == {"objects": charges, "meshes": [], "collections": ["Charges"] if charges else []}
    assert len(charge_objects(scene)) == len(charges)
    assert scene.frame_current == 1 and scene.rigidbody_world is None
    assert not {"bda_strength_pa", "bda_ductility", "bda_changes"} & set(scene.keys())
    assert remove_demolition(scene) == 0
    play(scene, 3)


def test_slow_motion_ends_with_the_demolition(blender):
    scenario = read_scenario(REPORT_2019 / "single_span_explosives.toml")
    blast = replace(scenario.blast, slow_frame_ms=2.0)
    scenario = replace(scenario, fracture=replace(scenario.fracture, shards=30), blast=blast)
    scene = blender.context.scene
    build_demolition(scene, scenario, build_model(scenario))
    assert time_is_animated(scene)
    remove_demolition(scene)
    assert not time_is_animated(scene)


def test_built_anew_and_played_again(blender):
    scene, model = blender.context.scene, build_model(SPAN)
    for _ in range(3):
        build_demolition(scene, SPAN, model)
        play(scene, 40)
        assert len(shards_of(scene)) == 30 and len(blender.data.meshes) == 32
        remove_demolition(scene)


def test_a_scene_without_bodies_has_nothing_to_remove(blender):
    assert remove_demolition(blender.context.scene) == remove_loose_connections(blender.context.scene) == 0


def test_the_world_goes_with_the_collection_that_it_has_by_then(blender):
    """Any collection can be chosen in Blender's own panel, also that of the force fields, which goes when empty."""
    scene = blender.context.scene
    scenario = replace(read_scenario(REPORT_2019 / "single_span_explosives.toml"), fracture=SPAN.fracture)
    scenario = replace(scenario, blast=replace(scenario.blast, apply="fields"))
    build_demolition(scene, scenario, build_model(scenario))
    blender.data.batch_remove(list(force_collection(scene).all_objects))
    scene.rigidbody_world.collection = force_collection(scene)
    assert remove_demolition(scene) == 0
    assert force_collection(scene) is None and scene.rigidbody_world is None


def test_what_was_not_built_here_stays(blender):
    scene = blender.context.scene
    build_demolition(scene, SPAN, build_model(SPAN))
    shards = shards_of(scene)
    mesh = shards[0].data
    blender.data.objects.new("copy", mesh)
    own = blender.data.objects.new("own", shards[1].data.copy())
    scene.rigidbody_world.collection.objects.link(own)
    scene.view_layers[0].update()
    assert remove_demolition(scene) == 32
    assert mesh.name in blender.data.meshes
    assert bodies_of(scene) == [own]


@pytest.mark.parametrize("played", [0, 12])
def test_loose_connections_are_removed_and_no_other(blender, watched, tmp_path, played):
    scene = blender.context.scene
    build_demolition(scene, SPAN, build_model(SPAN))
    shard = shards_of(scene)[3]
    held = [connection for connection in connections_of(scene) if shard in ends_of(connection)]
    count, loose = len(connections_of(scene)), len(held)
    play(scene, played)
    scene.frame_set(1)
    blender.data.objects.remove(shard)
    scene.rigidbody_world.substeps_per_frame = scene.rigidbody_world.substeps_per_frame
    scene.view_layers[0].update()
    assert remove_loose_connections(scene) == loose > 0
    assert len(connections_of(scene)) == count - loose
    recording = Recording(scene, tmp_path)
    start_recording(recording)
    play(scene, 5)
    stop_recording()
    assert recording.error is None and recording.recorded_frames == 4


def test_supports_hold_their_shards(blender):
    scenario = replace(
        SPAN,
        ball=None,
        supports=[Support(member="pier cap")],
        shards=replace(SPAN.shards, start_deactivated=False, use_deactivation=False),
    )
    scene, model = blender.context.scene, build_model(scenario)
    build_demolition(scene, scenario, model)
    shards = shards_of(scene)
    assert [body.rigid_body.type == "PASSIVE" for body in shards] == model.fixed.tolist()
    assert model.fixed.any() and not model.fixed.all()
    positions = [body.location.copy() for body in shards]
    for connection in connections_of(scene):
        connection.rigid_body_constraint.enabled = False
    for frame in range(1, 20):
        scene.frame_set(frame)
    graph = blender.context.evaluated_depsgraph_get()
    moved = [
        (body.evaluated_get(graph).matrix_world.translation - position).length
        for body, position in zip(shards, positions, strict=True)
    ]
    assert max(np.array(moved)[model.fixed]) == 0.0
    assert max(np.array(moved)[~model.fixed]) > 0.01  # overhanging ends of the deck come down
