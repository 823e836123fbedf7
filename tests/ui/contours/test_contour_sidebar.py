# SPDX-License-Identifier: GPL-3.0-or-later
"""The sidebar's contours: settings, buttons and what is drawn over the view, as far as it needs no window."""

import numpy as np
import pytest
from support.blocks import Blocks

from bridge_demolition_addon.display.contour_quantities import ContourQuantity
from bridge_demolition_addon.display.contours import RangeKind

FRAMES = 4


@pytest.fixture
def recorded(extension, tmp_path):
    """A block of 100 kg that hangs from a ledge, recorded."""
    blocks = Blocks()
    ledge, block = blocks.block((0.0, 0.0, 5.0)), blocks.block((0.0, 0.0, 3.0), 100.0)
    blocks.connect("FIXED", (0.0, 0.0, 4.0), ledge, block)
    (tmp_path / "log").mkdir()
    blocks.play(tmp_path / "log", FRAMES)
    return blocks


def ours_in_handlers():
    import bpy

    lists = (bpy.app.handlers.frame_change_post, bpy.app.handlers.depsgraph_update_post, bpy.app.handlers.load_pre)
    return sum(handler.__module__.startswith("bridge_demolition_addon") for one in lists for handler in one)


def shown(blocks, number=1):
    body = blocks.world.collection.objects[number]
    return tuple(body.evaluated_get(blocks.scene.view_layers[0].depsgraph).color)[:3]


def test_ticking_the_box_colours_and_unticking_puts_back(recorded):
    from bridge_demolition_addon.display.colour_scale import ColourMap, colours, linear

    settings = recorded.scene.bda
    settings.contour_range = "FRAME"
    recorded.scene.frame_set(3)
    before, others = shown(recorded), ours_in_handlers()
    settings.contours = True
    # The only load is the highest: the last colour of the map.
    assert shown(recorded) == pytest.approx(linear(colours(ColourMap.VIRIDIS, [1.0]))[0], abs=1e-6)
    settings.contours = False
    assert shown(recorded) == before
    assert ours_in_handlers() == others


def test_a_changed_setting_is_followed_at_once(recorded):
    from bridge_demolition_addon.display.colour_scale import ColourMap, colours, linear

    recorded.scene.frame_set(3)
    settings = recorded.scene.bda
    settings.contours, settings.contour_map = True, "CIVIDIS"
    assert shown(recorded) == pytest.approx(linear(colours(ColourMap.CIVIDIS, [1.0]))[0], abs=1e-6)


@pytest.mark.parametrize("outdated", [False, True], ids=["played by Blender", "forgotten by Blender"])
def test_a_magnified_shape_is_shown_until_it_is_asked_for_no_more(extension, tmp_path, outdated):
    """A block that falls freely for three frames of a twenty-fourth of a second."""
    blocks = Blocks()
    block = blocks.block((0.0, 0.0, 50.0), 100.0)
    (tmp_path / "log").mkdir()
    results = blocks.play(tmp_path / "log", FRAMES)
    scene, settings = blocks.scene, blocks.scene.bda
    if outdated:
        blocks.world.substeps_per_frame += 1  # Blender forgets what it played

    def height():
        return block.evaluated_get(scene.view_layers[0].depsgraph).matrix_world.translation.z

    frame = int(results.frames.number[3])
    fallen = 50.0 - results.frames.positions_m[3, 0, 2]
    assert fallen > 0.05
    scene.frame_set(frame)
    settings.contours, settings.contour_quantity, settings.contour_magnification = True, "DISPLACEMENT", 7.0
    assert height() == pytest.approx(50.0 - 7.0 * fallen, abs=1e-4)
    scene.frame_set(frame - 1)
    scene.frame_set(frame)
    assert height() == pytest.approx(50.0 - 7.0 * fallen, abs=1e-4)
    settings.contour_magnification = 1.0
    assert height() == pytest.approx(50.0 - fallen, abs=1e-4)
    settings.contour_magnification = 7.0
    settings.contours = False
    assert height() == pytest.approx(50.0 - fallen, abs=1e-4)


def test_settings_have_the_units_that_the_panel_names(recorded):
    from bridge_demolition_addon.ui.contours.view import settings_of

    settings = recorded.scene.bda
    settings.contour_range, settings.contour_low, settings.contour_high = "FIXED", 1.0, 2.0
    assert (settings_of(recorded.scene).low, settings_of(recorded.scene).high) == (1e3, 2e3)
    settings.contour_quantity = "VON_MISES"
    found = settings_of(recorded.scene)
    assert (found.quantity, found.range_kind, found.high) == (ContourQuantity.VON_MISES, RangeKind.FIXED, 2e6)
    settings.contour_quantity, settings.contour_magnification = "DISPLACEMENT", 200.0
    found = settings_of(recorded.scene)
    assert (found.high, found.magnification) == pytest.approx((2e-3, 200.0))


def test_a_range_that_is_none_is_told_and_changes_nothing(recorded):
    from bridge_demolition_addon.ui.contours import view as contour_view

    recorded.scene.frame_set(3)
    settings = recorded.scene.bda
    settings.contours = True
    before = shown(recorded)
    settings.contour_high = -1.0
    settings.contour_range = "FIXED"
    assert "has to be below" in contour_view.refusal(recorded.scene)
    assert shown(recorded) == before
    settings.contour_high = 2.0
    assert contour_view.refusal(recorded.scene) == ""
    settings.contour_low = 0.0
    assert "has to begin above 0" in contour_view.refusal(recorded.scene)
    settings.contour_logarithmic = False
    assert contour_view.refusal(recorded.scene) == ""


def test_switching_the_add_on_off_puts_everything_back(blender, tmp_path):
    import bridge_demolition_addon

    bridge_demolition_addon.register()
    blocks = Blocks()
    blocks.block((0.0, 0.0, 3.0), 100.0)
    blocks.play(tmp_path, FRAMES)
    transform = blocks.scene.view_settings.view_transform
    blocks.scene.bda.contours = True
    bridge_demolition_addon.unregister()
    assert ours_in_handlers() == 0
    assert blocks.scene.view_layers[0].material_override is None
    assert blocks.scene.view_settings.view_transform == transform
    assert not [material for material in blender.data.materials if material.name.startswith("Contours")]


@pytest.mark.parametrize(
    ("operator", "reason"),
    [
        ("load_results", "Choose a file results.npz first"),
        ("render_contours", "Choose a folder for the film first"),
        ("toggle_symbols", "neither connections nor force fields"),
    ],
)
def test_buttons_say_why_they_cannot_be_pressed(extension, operator, reason):
    with pytest.raises(RuntimeError, match=reason):
        getattr(extension.ops.bda, operator)()


def test_results_that_are_none_are_refused(recorded, tmp_path):
    import bpy

    recorded.scene.bda.results_path = str(tmp_path / "none.npz")
    with pytest.raises(RuntimeError, match="expected the results of a run"):
        bpy.ops.bda.load_results()


def test_results_of_a_run_that_ended_before_its_end_are_shown(recorded):
    import bpy

    from bridge_demolition_addon.simulation.blender_events import shown_results

    recording = shown_results(recorded.scene).recording
    recorded.scene.bda.results_path = str(recording.folder)  # its results were not written yet
    assert bpy.ops.bda.load_results() == {"FINISHED"}
    series = shown_results(recorded.scene).series
    assert len(series) == recording.recorded_frames and series.recorded is not recording.frames


def test_pictures_by_the_button(recorded, tmp_path):
    import bpy

    settings = recorded.scene.bda
    settings.film_directory, settings.film_kind = str(tmp_path / "film"), "PICTURES"
    settings.film_width, settings.film_height = 320, 180
    assert bpy.ops.bda.render_contours() == {"FINISHED"}
    assert len(list((tmp_path / "film").glob("contours_*.png"))) == FRAMES + 1
    settings.film_width = 321
    with pytest.raises(RuntimeError, match="even"):
        bpy.ops.bda.render_contours()


def test_the_arrow_of_the_largest_force_is_as_long_as_asked_for(recorded):
    from bridge_demolition_addon.ui.contours.decorator import vector_lines

    recorded.scene.frame_set(4)
    settings = recorded.scene.bda
    assert vector_lines(recorded.scene) == {}
    settings.show_vectors, settings.vector_length_m = True, 1.5
    lines = vector_lines(recorded.scene)["BODIES"]
    # The connection pulls the block up, at its centre 3 m high.
    assert np.allclose(lines[:2], [[0.0, 0.0, 3.0], [0.0, 0.0, 4.5]], atol=1e-3)


def test_rings_are_as_wide_as_the_stand_off(recorded):
    from bridge_demolition_addon.model.blast.charges import Charge
    from bridge_demolition_addon.model.blast.receptors import THRESHOLDS, ring_radii
    from bridge_demolition_addon.scene.blast.charges import create_charges
    from bridge_demolition_addon.ui.contours.decorator import ring_lines

    charge = Charge(name="A", position_m=(1.0, 2.0, 0.5), mass_kg=5.0)
    create_charges(recorded.scene, [charge])
    recorded.scene.view_layers[0].update()
    recorded.scene.bda.ring_damage = "4"
    ((lines, radius),) = ring_lines(recorded.scene)
    assert radius == pytest.approx(ring_radii([charge], 0.0, [THRESHOLDS[4]])[0, 0])
    assert np.allclose(np.linalg.norm(lines[:, :2] - (1.0, 2.0), axis=1), radius, rtol=1e-5)
    assert (lines[:, 2] == 0.0).all()
