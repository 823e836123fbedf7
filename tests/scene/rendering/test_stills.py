# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures by each renderer: no cut is seen before it opens, and the scene keeps its own settings."""

from itertools import product

import numpy as np
import pytest
from matplotlib.image import imread
from support.long_cases import long_but

from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.model.scenario.recording import PictureSettings, Renderer

SIZE_PX = 160, 90
EVEN = 0.02
"""By how much the brightness of a face that is lit evenly may differ, by rounding and by noise that is left."""


def settings_of(scene):
    cycles = scene.cycles
    return (
        *(scene.render.engine, scene.render.resolution_x, scene.view_settings.exposure),
        *(cycles.device, cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising, cycles.max_bounces),
        scene.display.shading.show_object_outline,
    )


def place_blocks(blender, gap_m):
    """Two blocks beside each other, which a camera looks at from the front, under a sun from there."""
    from bridge_demolition_addon.scene.bodies import mesh_of
    from bridge_demolition_addon.scene.rendering.materials import SurfaceMaterial, material_of

    scene = blender.context.scene
    for side in (-1.0, 1.0):
        mesh = mesh_of("Block", box((2.0, 1.0, 2.0)))
        mesh.materials.append(material_of(SurfaceMaterial.STEEL))
        block = blender.data.objects.new("Block", mesh)
        block.location = (side * (1.0 + gap_m / 2.0), 0.0, 0.0)
        scene.collection.objects.link(block)
    sun = blender.data.objects.new("Sun", blender.data.lights.new("Sun", "SUN"))
    sun.rotation_euler = (np.pi / 2.0, 0.0, 0.0)
    scene.collection.objects.link(sun)
    camera = blender.data.objects.new("Eye", blender.data.cameras.new("Eye"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", 3.0
    camera.location, camera.rotation_euler = (0.0, -10.0, 0.0), (np.pi / 2.0, 0.0, 0.0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.view_layers[0].update()
    return scene


QUICK = ((0.0, Renderer.WORKBENCH), (0.3, Renderer.WORKBENCH))
"""Where light is followed, a picture takes seconds."""


@pytest.mark.parametrize(("gap_m", "renderer"), long_but(QUICK, product((0.0, 0.3), Renderer), several=True))
def test_a_cut_is_seen_when_it_opens_and_not_before(blender, tmp_path, renderer, gap_m):
    from bridge_demolition_addon.scene.rendering.stills import prepared_for_pictures, render_picture

    scene = place_blocks(blender, gap_m)
    before = settings_of(scene)
    view = PictureSettings(width_px=SIZE_PX[0], height_px=SIZE_PX[1], renderer=renderer.value, camera="own")
    with prepared_for_pictures(scene, view):
        render_picture(scene, 1, tmp_path / "blocks.png")
    row = imread(tmp_path / "blocks.png")[SIZE_PX[1] // 2, 20:-20, :3].mean(axis=1)
    assert (np.ptp(row) > EVEN) == (gap_m > 0.0)
    assert settings_of(scene) == before


def test_a_blender_without_cycles_says_so(blender):
    from bridge_demolition_addon.errors import OutputError
    from bridge_demolition_addon.scene.rendering.stills import prepare_pictures

    blender.ops.preferences.addon_disable(module="cycles")
    try:
        with pytest.raises(OutputError, match="which this Blender lacks: switch on Cycles Render Engine"):
            prepare_pictures(blender.context.scene, PictureSettings(renderer="cycles"))
    finally:
        blender.ops.preferences.addon_enable(module="cycles")
