"""Films: encoded and read back by Blender itself, in the colours of the colour bar."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread, imsave

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.core.film import film_plan
from bridge_demolition_addon.core.results import load_results
from bridge_demolition_addon.core.scenario.file import read_scenario
from bridge_demolition_addon.report.film_pictures import lay_over, stress_colours, stress_scale

EXAMPLE = read_scenario(Path(__file__).parents[2] / "examples" / "i235_one_span.toml")
COLOURS = {"red": (1.0, 0.0, 0.0), "green": (0.0, 1.0, 0.0), "blue": (0.0, 0.0, 1.0)}

# H.264 keeps colour at half the size and in steps.
ENCODING = 0.06


def read_back(bpy, film, frame, folder):
    """Pixels of one picture of a film, and how many it has."""
    scene = bpy.data.scenes.new("Read")
    editor = scene.sequence_editor_create()
    strips = editor.strips if hasattr(editor, "strips") else editor.sequences
    strip = strips.new_movie("film", str(film), channel=1, frame_start=1)
    count = strip.content_duration if hasattr(strip, "content_duration") else strip.frame_duration
    element = strip.elements[0]
    scene.render.resolution_x, scene.render.resolution_y = element.orig_width, element.orig_height
    scene.render.resolution_percentage = 100
    scene.view_settings.view_transform = "Standard"
    scene.frame_start = scene.frame_end = frame
    scene.render.filepath = str(folder / "read-")
    bpy.ops.render.render(animation=True, scene=scene.name)
    bpy.data.scenes.remove(scene)
    return imread(folder / f"read-{frame:04d}.png")[:, :, :3], count


def test_pictures_follow_each_other_as_told(blender, tmp_path):
    from bridge_demolition_addon.scene.film import encode_film

    for name, colour in COLOURS.items():
        imsave(tmp_path / f"{name}.png", np.full((36, 64, 3), colour))
    order = ["red"] * 3 + ["green"] + ["blue"] * 2 + ["red"]
    encode_film([tmp_path / f"{name}.png" for name in order], tmp_path / "film.mp4", 24, (64, 36))
    assert (tmp_path / "film.mp4").read_bytes()[4:8] == b"ftyp"
    assert not blender.data.scenes.get("Film")
    for frame, name in enumerate(order, start=1):
        pixels, count = read_back(blender, tmp_path / "film.mp4", frame, tmp_path)
        assert count == len(order)
        assert pixels.shape == (36, 64, 3)
        np.testing.assert_allclose(pixels[18, 32], COLOURS[name], atol=ENCODING)


def test_contours_have_the_colours_of_the_bar(blender, tmp_path):
    from bridge_demolition_addon.scene.film import contour_shading, render_coloured
    from bridge_demolition_addon.scene.rendering import prepare_pictures

    scene = blender.context.scene
    blender.ops.mesh.primitive_cube_add(size=2.0)
    prepare_pictures(scene, np.array([[-1.0, -1, -1], [1, 1, 1]]), 160, 90)
    colours = stress_colours(np.array([3e6]), stress_scale_of(10e6))
    with contour_shading(scene):
        render_coloured(scene, 1, [blender.context.object], colours, tmp_path / "one.png")
    np.testing.assert_allclose(imread(tmp_path / "one.png")[45, 80, :3], colours[0], atol=0.01)
    assert scene.display.shading.light == "STUDIO"  # as it was


def stress_scale_of(largest_pa):
    from moving_boxes import moving_boxes

    return stress_scale(moving_boxes([0.0], [(1, 1, 1)], np.zeros((1, 1, 3)), von_mises_pa=np.array([[largest_pa]])))


def test_the_scale_spans_two_decades_up_to_the_largest():
    scale = stress_scale_of(10e6)
    assert (scale.vmin, scale.vmax) == pytest.approx((0.1, 10.0))
    lowest, low, high, nan = stress_colours(np.array([0.0, 0.1e6, 10e6, np.nan]), scale)
    assert lowest.tolist() == low.tolist() == nan.tolist() != high.tolist()
    assert low.sum() > high.sum() + 1.0  # light to dark


def test_bar_and_words_are_laid_over_and_not_cut_off(tmp_path):
    imsave(tmp_path / "grey.png", np.full((360, 640, 3), 0.4))
    lay_over(tmp_path / "grey.png", tmp_path / "over.png", stress_scale_of(10e6), "1.50 s, $4$ times slower")
    over = imread(tmp_path / "over.png")[:, :, :3]
    changed = abs(over - 0.4).max(axis=2) > 0.02
    assert over.shape == (360, 640, 3)
    assert changed[:, :320].any() and changed[:, 320:].any()
    assert not changed[:250].any()  # the picture itself is left alone
    assert not (changed[-2:].any() or changed[:, :5].any() or changed[:, -5:].any())


def test_a_run_leaves_a_film_of_all_of_it(blender, tmp_path):
    from bridge_demolition_addon.simulation.run import run_scenario

    small = replace(
        EXAMPLE,
        time=replace(EXAMPLE.time, duration_s=0.25),
        fracture=replace(EXAMPLE.fracture, shards=8),
        connections=replace(EXAMPLE.connections, search_radius_m=3.0),
        ball=replace(EXAMPLE.ball, drop_height_m=0.05, release_time_s=0.0),
        pictures=replace(EXAMPLE.pictures, width_px=161, height_px=91),
    )
    folder = tmp_path / "run"
    run_scenario(small, folder, overwrite=False, pictures=False, progress=Silence(), film=True)
    impact = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["impact"]["time_s"]
    pixels, count = read_back(blender, folder / "film.mp4", 1, tmp_path)
    assert count == len(film_plan(load_results(folder / "results.npz").times_s, impact).steps)
    assert pixels.shape == (90, 160, 3)  # the encoder wants even numbers
    assert pixels.std() > 0.02
