# SPDX-License-Identifier: GPL-3.0-or-later
"""Cables are drawn from their anchors to where they are fixed, go with their shards, and vanish as they let go."""

import numpy as np
import pytest
from support.steelwork import pulled_column

from bridge_demolition_addon.model.sequence.checked_model import checked_model


@pytest.fixture
def drawn(blender):
    import bpy

    from bridge_demolition_addon.scene.demolition import build_demolition

    scenario = pulled_column(pieces=2)
    shards = build_demolition(bpy.context.scene, scenario, checked_model(scenario))
    return bpy.context.scene, shards


def ends(scene):
    """Return where the rod begins and ends now."""
    import bpy

    bpy.context.view_layer.update()
    cable = scene.objects["cable"].evaluated_get(bpy.context.evaluated_depsgraph_get())
    matrix = np.array(cable.matrix_world)
    return matrix[:3, 3], matrix[:3, 3] + matrix[:3, 1]


def test_a_rod_goes_from_the_anchor_to_the_point_and_with_its_shard(drawn):
    scene, shards = drawn
    begin, end = ends(scene)
    np.testing.assert_allclose(begin, (8.0, 0.0, 0.0), atol=1e-5)
    np.testing.assert_allclose(end, (0.0, 0.0, 6.0), atol=1e-5)
    (held,) = {child.parent for child in scene.objects if child.parent}
    assert held in shards
    held.location = np.add(held.location, (1.0, 0.0, -2.0))
    np.testing.assert_allclose(ends(scene)[1], (1.0, 0.0, 4.0), atol=1e-5)


def test_it_is_no_body_and_vanishes_as_it_lets_go(drawn):
    from bridge_demolition_addon.scene.bodies import bodies_of
    from bridge_demolition_addon.scene.tools.cables import hide_cables

    scene, _ = drawn
    assert "cable" not in [body.name for body in bodies_of(scene)]
    cable = scene.objects["cable"]
    scene.frame_set(scene.frame_start + 5)
    hide_cables(scene, ["other"])
    assert not cable.hide_render
    hide_cables(scene, ["cable"])
    assert cable.hide_render and cable.hide_viewport
    scene.frame_set(scene.frame_start + 2)
    assert not cable.hide_render
