# SPDX-License-Identifier: GPL-3.0-or-later
"""Blast zones in rendered pictures: with their drill holes until they fire, a flash, and nothing afterwards."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.image import imread
from support.drilled_columns import ZONE, column_members

from bridge_demolition_addon.display.zone_boxes import flash_of, rods, zone_rods
from bridge_demolition_addon.model.scenario.recording import PictureSettings
from bridge_demolition_addon.model.structure.blast_zones import placed_zone
from bridge_demolition_addon.scene.rendering.markers import ShownZone, remove_zones, show_zones

PLACED = placed_zone(ZONE, column_members())


def test_rods_have_the_lengths_of_their_lines():
    mesh = rods(np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 2.0)]), 0.1)
    assert (len(mesh.vertices), len(mesh.triangles)) == (16, 24)
    volume = np.einsum("ij,ij->i", mesh.corners[:, 0], np.cross(mesh.corners[:, 1], mesh.corners[:, 2])).sum() / 6.0
    assert volume == pytest.approx(0.1 * 0.1 * (1.1 + 2.1))


def test_holes_stick_out_of_the_side_that_is_drilled():
    """A column of 0.7 m, drilled from its start."""
    mesh = zone_rods(PLACED)
    low, high = mesh.bounds
    assert low[0] == pytest.approx(-0.35 - 0.12 - 0.03) and high[0] == pytest.approx(0.35 + 0.06)
    assert (low[2], high[2]) == pytest.approx((0.75 - 0.06, 2.25 + 0.06))
    assert len(mesh.triangles) == 12 * (12 + 10)
    assert flash_of(PLACED).bounds[1, 2] == pytest.approx(2.25 + 0.12)


def test_pictures_show_a_zone_until_it_fires_and_a_flash_as_it_does(blender, tmp_path):
    from bridge_demolition_addon.scene.rendering.stills import prepare_pictures, render_picture
    from bridge_demolition_addon.scene.rendering.surroundings import aim_camera

    scene = blender.context.scene
    failed = placed_zone(replace(ZONE, name="failed", middle_m=3.2, delay_ms=300.0), column_members())
    show_zones(scene, [ShownZone(PLACED, 5, 8), ShownZone(failed, None)])
    prepare_pictures(scene, PictureSettings(width_px=160, height_px=90))
    aim_camera(scene, np.array([(-2.0, -2.0, 0.0), (2.0, 2.0, 4.0)]), 160 / 90)
    drawn = {}
    for frame in (1, 4, 5, 7, 8, 20):
        render_picture(scene, frame, tmp_path / f"{frame}.png")
        picture = imread(tmp_path / f"{frame}.png")[:, :, :3]
        drawn[frame] = picture
    empty = drawn[8]
    shown = {frame: int((abs(picture - empty).max(axis=2) > 0.05).sum()) for frame, picture in drawn.items()}
    assert shown[1] == shown[4] > 50
    assert shown[5] == shown[7] > 1.2 * shown[1]  # a whole box in place of edges and holes, without outlines
    assert shown[8] == shown[20] == 0
    assert remove_zones(scene) == 3
    assert not blender.data.collections and not blender.data.meshes and not scene.objects.get("failed")


def test_zones_are_in_no_view_but_in_pictures(blender):
    scene = blender.context.scene
    show_zones(scene, [ShownZone(PLACED, 5, 8)])
    show_zones(scene, [ShownZone(PLACED, 9, 12)])
    assert len(scene.objects) == 2
    assert not any(item.visible_get() for item in scene.objects)
