# SPDX-License-Identifier: GPL-3.0-or-later
"""A demolition of a member from a file, without a bridge."""

from dataclasses import replace

import numpy as np
import pytest
from support.scenarios import I235

from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.errors import GeometryError
from bridge_demolition_addon.model.bridge.mesh_files import exported
from bridge_demolition_addon.model.scenario import Ball, FractureSettings, Geometry
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.scene.bodies import bodies_of, kind_of
from bridge_demolition_addon.scene.demolition import build_demolition


@pytest.fixture
def scenario(tmp_path):
    (tmp_path / "pier.obj").write_bytes(exported(box([1, 1, 4], [0, 0, 2]), ".obj"))
    pier = Geometry(name="pier", file=str(tmp_path / "pier.obj"), density_kg_m3=2400, position_m=[20, 0, 0])
    ball = Ball(mass_kg=1000, diameter_m=1, target_m=[20.2, 0.3], drop_height_m=3)
    return replace(I235, bridge=None, geometry=[pier], ball=ball, fracture=FractureSettings(shards=12))


def test_shards_ball_and_ground_of_a_member_from_a_file(blender, scenario):
    scene = blender.context.scene
    build_demolition(scene, scenario, build_model(scenario))
    blender.context.view_layer.update()
    bodies = {
        kind: [body for body in bodies_of(scene) if kind_of(body) == kind] for kind in ("shard", "ball", "ground")
    }
    assert sum(body.rigid_body.mass for body in bodies["shard"]) == pytest.approx(4 * 2400, rel=1e-6)
    # On the pier's head at 4 m, 3 m clear below a ball of 0.5 m radius.
    np.testing.assert_allclose(bodies["ball"][0].location, [20.2, 0.3, 7.5], atol=1e-6)
    assert bodies["ground"][0].dimensions[0] / 2 > 20.5 + 10 * 4
    on_ground = [
        obj
        for obj in scene.rigidbody_world.constraints.objects
        if obj.rigid_body_constraint.object2 == bodies["ground"][0]
    ]
    assert on_ground


def test_a_ball_beside_everything_is_refused_before_anything_is_made(blender, scenario):
    model = build_model(scenario)
    with pytest.raises(GeometryError, match="No member lies under"):
        build_demolition(blender.context.scene, replace(scenario, ball=replace(scenario.ball, target_m=[0, 0])), model)
    assert blender.context.scene.rigidbody_world is None and not len(blender.data.objects)
