# SPDX-License-Identifier: GPL-3.0-or-later
"""Terrain in the sidebar: its file is chosen as a file, and a place on a map keeps all its digits."""

from support.scenarios import I235

from bridge_demolition_addon.model.scenario import Ground, GroundSurface


def test_terrain_is_shown_and_read_back_without_loss(settings):
    """Eastings and northings have more digits than Blender's single precision, so they are kept as text."""
    from dataclasses import replace

    from bridge_demolition_addon.ui.scenario.values import scenario_of, show_scenario

    corners = ((0.0, 0.0), (8.0, 0.0), (8.0, 4.0))
    ground = Ground(
        file="/site/dtm.tif",
        origin=(448_312.375, 4_607_155.125, 262.5),
        bearing_deg=75.0,
        no_data=-9999.0,
        surfaces=(GroundSurface(name="river", kind="water", height_m=-4.5, corners_m=corners),),
    )
    show_scenario(settings, replace(I235, ground=ground))
    group = settings.scenario.ground
    assert scenario_of(settings).ground == ground
    assert group.bl_rna.properties["file"].subtype == "FILE_PATH"
    assert group.surfaces[0].bl_rna.properties["file"].subtype == "FILE_PATH"
    group.origin = "448312.375, 4607155.625, 262.5"  # as it is typed
    assert scenario_of(settings).ground.origin == (448_312.375, 4_607_155.625, 262.5)
