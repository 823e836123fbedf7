# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender passes over force fields only in scenes and frames in which it is told to."""

from itertools import pairwise

import bpy
import pytest
from support.blast_scenes import weightless

from bridge_demolition_addon.bullet import field_filter
from bridge_demolition_addon.bullet.field_filter import ignore_fields, let_fields_act
from bridge_demolition_addon.errors import LayoutError

MASS_KG = 10.0


@pytest.fixture
def pushed(blender):
    """A block that a field of the user's own pushes upwards, and its scene."""
    blocks = weightless(frames_per_second=24, substeps_per_frame=10)
    block = blocks.block((0, 0, 0), MASS_KG)
    bpy.ops.object.effector_add(type="FORCE", location=(0, 0, -2))
    field = bpy.context.object.field
    field.shape, field.strength, field.falloff_power = "PLANE", 24.0 * 100.0, 0.0
    return blocks.scene, block


def rise(scene, block, frames):
    """By how much the block rises in frames, one after the other."""
    heights = []
    for frame in frames:
        scene.frame_set(frame)
        heights.append(block.evaluated_get(scene.view_layers[0].depsgraph).matrix_world.translation.z)
    return [after - before for before, after in pairwise(heights)]


def test_nothing_is_pushed_while_fields_are_ignored(pushed):
    scene, block = pushed
    accelerated = rise(scene, block, range(1, 6))
    # 100 N on 10 kg in frames of a 24th of a second: each is longer than the last by a t² = 10 / 576 m.
    assert accelerated[3] - accelerated[2] == pytest.approx(10.0 / 576.0, rel=1e-3)
    ignore_fields(scene)
    coasting = rise(scene, block, range(5, 10))
    assert coasting == pytest.approx([coasting[0]] * 4, rel=1e-5)
    let_fields_act(scene)
    again = rise(scene, block, range(9, 13))
    assert again[2] - again[1] == pytest.approx(10.0 / 576.0, rel=1e-3)


def test_the_scene_itself_stays_as_it_is(pushed):
    scene, block = pushed
    rise(scene, block, range(1, 4))
    ignore_fields(scene)
    assert scene.rigidbody_world.effector_weights.collection is None
    assert not scene.rigidbody_world.point_cache.is_outdated
    scene.rigidbody_world.effector_weights.all = 1.0  # has Blender make a new copy, which fields act on
    scene.view_layers[0].update()
    assert scene.view_layers[0].depsgraph.scene_eval.rigidbody_world.effector_weights.collection is None


def test_a_world_that_is_limited_by_its_user_is_left_alone(pushed):
    scene, _ = pushed
    own = bpy.data.collections.new("own fields")
    scene.rigidbody_world.effector_weights.collection = own
    scene.view_layers[0].update()
    limits = scene.view_layers[0].depsgraph.scene_eval.rigidbody_world.effector_weights
    ignore_fields(scene)
    assert limits.collection.name == own.name
    let_fields_act(scene)
    assert limits.collection.name == own.name


@pytest.mark.parametrize("act", [ignore_fields, let_fields_act])
def test_memory_that_is_not_as_expected_is_not_written(pushed, monkeypatch, act):
    scene, block = pushed
    rise(scene, block, range(1, 4))
    if act is let_fields_act:
        ignore_fields(scene)
    weights = scene.view_layers[0].depsgraph.scene_eval.rigidbody_world.effector_weights
    before = weights.collection
    scene.view_layers[0].depsgraph.scene_eval.rigidbody_world.effector_weights.wind = 0.5
    monkeypatch.setattr(field_filter, "INFLUENCES", field_filter.INFLUENCES[::-1])
    with pytest.raises(LayoutError, match="not where it is expected"):
        act(scene)
    assert weights.collection == before
