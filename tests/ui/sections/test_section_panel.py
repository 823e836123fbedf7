# SPDX-License-Identifier: GPL-3.0-or-later
"""The section in the window: where its plane is put, what it shows of the frame, and what is written."""

import numpy as np
import pytest
from support.checkout import SMALL
from support.panel_layouts import texts_drawn

from bridge_demolition_addon.model.debris.pile_sections import Direction, pile_section
from bridge_demolition_addon.model.results.arrays import load_results


@pytest.fixture
def built(extension, settings, tmp_path):
    """A bridge that is too weak to stand, built."""
    settings.scenario_path = str(SMALL)
    extension.ops.bda.load_scenario()
    settings.scenario.connections.breaking_force_kgf = 300.0
    extension.ops.bda.build_scenario()
    settings.output_directory = str(tmp_path / "run")
    return extension


@pytest.fixture
def ran(built):
    built.ops.bda.run(pictures=False)
    built.context.scene.frame_set(built.context.scene.frame_end)
    return built


def shown(bpy):
    from bridge_demolition_addon.ui.sections import section_of

    return section_of(bpy.context.scene)


def drawn(bpy):
    from bridge_demolition_addon.ui.sections import BDA_PT_section

    return texts_drawn(BDA_PT_section, bpy)


def test_before_a_run_there_is_nothing_to_cut(built):
    assert shown(built) is None
    assert "Nothing was recorded yet: run the scene first" in " ".join(drawn(built))
    for button in ("section_at_cursor", "section_at_shard", "look_at_section", "write_section"):
        assert not getattr(built.ops.bda, button).poll()


@pytest.mark.long
def test_it_is_that_of_the_results_and_follows_the_timeline(ran, settings, tmp_path):
    results, scene = load_results(tmp_path / "run"), ran.context.scene
    settings.show_section, settings.section_place_m = True, 4.0
    heights = []
    for frame, row in ((scene.frame_end, -1), (int(results.frames.number[0]), 0)):
        scene.frame_set(frame)
        expected = pile_section(results, Direction.ACROSS, 4.0, row)
        assert shown(ran).debris.area() == expected.debris.area()
        assert shown(ran).standing.area() == expected.standing.area()
        assert shown(ran).frame == results.frames.number[row]
        heights.append(shown(ran).debris_height_m)
    assert heights[0] > 0.1 and heights[1] == 0.0
    # Before anything moves it is the deck: 4 m wide and 0.4 m thick.
    assert shown(ran).standing.area() == pytest.approx(4.0 * 0.4, rel=1e-3)
    settings.section_direction = "ALONG"
    settings.section_place_m = 0.0
    assert shown(ran).direction is Direction.ALONG
    # 8 m and half a metre beyond each axis, and the columns, 0.8 m long and 3 m high.
    assert shown(ran).standing.area() == pytest.approx(9.0 * 0.4 + 2 * 0.8 * 3.0, rel=0.05)


def test_figures_stand_in_the_panel(ran, settings):
    settings.show_section, settings.section_place_m = True, 4.0
    section, told = shown(ran), " ".join(drawn(ran))
    assert f"Debris: {section.debris_area_m2:.1f} m²" in told
    assert f"Height above the ground: {section.debris_height_m:.2f} m" in told
    ran.context.scene.unit_settings.system = "IMPERIAL"
    assert f"Width: {section.debris_width_m / 0.3048:.4g} ft" in " ".join(drawn(ran))
    settings.section_place_m = 500.0
    assert "The plane cuts nothing here: move it" in " ".join(drawn(ran))
    assert not ran.ops.bda.write_section.poll()


def test_the_plane_is_put_at_the_cursor_and_at_the_chosen_shard(ran, settings):
    scene, layer = ran.context.scene, ran.context.view_layer
    scene.cursor.location = (3.5, -1.25, 0.0)
    ran.ops.bda.section_at_cursor()
    assert settings.section_place_m == pytest.approx(3.5) and settings.show_section
    settings.section_direction = "ALONG"
    ran.ops.bda.section_at_cursor()
    assert settings.section_place_m == pytest.approx(-1.25)
    for body in layer.objects:
        body.select_set(False)
    assert not ran.ops.bda.section_at_shard.poll()
    shard = next(body for body in scene.rigidbody_world.collection.objects if body.name.startswith("Shard"))
    shard.select_set(True)
    layer.objects.active = shard
    ran.ops.bda.section_at_shard()
    place = shard.evaluated_get(ran.context.evaluated_depsgraph_get()).matrix_world.translation
    assert settings.section_place_m == pytest.approx(place.y, abs=1e-5)
    assert not shown(ran).is_empty


@pytest.mark.long
def test_drawings_go_into_the_folder_of_the_run(ran, settings, tmp_path):
    settings.show_section, settings.section_place_m = True, 4.0
    assert ran.ops.bda.write_section() == {"FINISHED"}
    assert ran.ops.bda.write_section() == {"FINISHED"}
    names = {path.name for path in (tmp_path / "run").glob("section_*")}
    assert names == {f"section_across_4m{number}{ending}" for number in ("", "_2") for ending in (".svg", ".dxf")}


def test_bodies_are_where_they_were(ran, settings):
    """A section is drawn, and changes nothing."""

    def places():
        return np.array([body.matrix_world for body in ran.context.scene.rigidbody_world.collection.objects])

    before, objects = places(), len(ran.data.objects)
    settings.show_section = True
    shown(ran)
    settings.show_section = False
    assert (places() == before).all() and len(ran.data.objects) == objects
