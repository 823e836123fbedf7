# SPDX-License-Identifier: GPL-3.0-or-later
"""Contours in a scene: colours in renders and after scrubbing, and everything as it was afterwards."""

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.image import imread
from support.blocks import Blocks
from support.long_cases import long_but

from bridge_demolition_addon.display.colour_scale import ColourMap, colours, linear
from bridge_demolition_addon.display.contour_quantities import ContourQuantity
from bridge_demolition_addon.display.contours import ContourSettings, RangeKind
from bridge_demolition_addon.errors import ContourError, OutputError

FRAMES = 6
ONE_LEVEL = 1.01 / 255.0
"""What eight bits per channel allow, up and down."""
FRAME_BY_FRAME = ContourSettings(
    quantity=ContourQuantity.SUM, range_kind=RangeKind.FRAME, logarithmic=False, shaded=False
)


@pytest.fixture
def hanging(blender, tmp_path):
    """Two blocks of 100 and 50 kg, side by side, each hanging from a ledge of its own; recorded over some frames."""
    from bridge_demolition_addon.simulation import blender_events

    blocks = Blocks()
    for x, mass in ((-2.0, 100.0), (2.0, 50.0)):
        ledge = blocks.block((x, 0.0, 5.0))
        blocks.connect("FIXED", (x, 0.0, 4.0), ledge, blocks.block((x, 0.0, 3.0), mass))
    blocks.play(tmp_path, FRAMES)
    yield blocks
    blender_events.unregister()


def own_colours(blocks):
    return [tuple(body.color) for body in blocks.world.collection.objects]


def shown_colours(blocks):
    graph = blocks.scene.view_layers[0].depsgraph
    return np.array([body.evaluated_get(graph).color[:3] for body in blocks.world.collection.objects])


def look_of(scene):
    shading, view, layer = scene.display.shading, scene.view_settings, scene.view_layers[0]
    return (
        *(shading.light, shading.color_type, shading.show_shadows, shading.show_cavity, shading.show_object_outline),
        *(view.view_transform, view.look, view.exposure, view.gamma, layer.material_override),
        *(sorted(scene.keys()), sorted(layer.keys()), scene.render.engine, scene.render.resolution_x, scene.camera),
    )


def render(scene, engine, path):
    import bpy
    from mathutils import Euler

    camera = bpy.data.objects.new("Eye", bpy.data.cameras.new("Eye"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", 8.0
    camera.location, camera.rotation_euler = (0.0, -10.0, 3.0), Euler((np.pi / 2.0, 0.0, 0.0))
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine = engine
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 160, 80, 100
    if engine == "CYCLES":
        scene.cycles.samples = 4
    scene.render.dither_intensity = 0.0
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    pixels = imread(path)[:, :, :3]
    return pixels[40, [40, 120]]  # the blocks' middles: 2 m from the picture's, of 8 m


@pytest.mark.parametrize("engine", long_but(["BLENDER_WORKBENCH"], ["BLENDER_WORKBENCH", "CYCLES"]))
def test_rendered_colours_are_those_of_the_map(hanging, tmp_path, engine):
    from bridge_demolition_addon.simulation.blender_events import contours_of

    scene = hanging.scene
    contours_of(scene).show(FRAME_BY_FRAME)
    scene.frame_set(FRAMES)
    # 100 kg is the largest, 50 kg half of it, both up from 0: statics, within what the solver leaves.
    expected = colours(ColourMap.VIRIDIS, [1.0, 0.5])
    # Around one half the table goes on by up to 0.006 a step, and the solver may be a step or two off.
    tolerance = np.array([[ONE_LEVEL], [0.012 + ONE_LEVEL]])
    assert (abs(render(scene, engine, tmp_path / "render.png") - expected) <= tolerance).all()


@pytest.mark.parametrize("engine", long_but(["BLENDER_WORKBENCH"], ["BLENDER_WORKBENCH", "CYCLES"]))
def test_a_shaded_picture_keeps_hues_and_darkens_what_looks_away(hanging, tmp_path, engine):
    from bridge_demolition_addon.simulation.blender_events import contours_of

    scene = hanging.scene
    scene.frame_set(FRAMES)
    pictures = []
    for shaded in (False, True, False):
        contours_of(scene).show(replace(FRAME_BY_FRAME, shaded=shaded))
        pictures.append(render(scene, engine, tmp_path / "render.png"))
    flat, shaded, again = (linear(picture) for picture in pictures)
    assert np.array_equal(flat, again)
    dimmed = shaded / flat
    assert (dimmed < 0.97).all() and (dimmed > 0.2).all()
    # One factor for red, green and blue, but for the 255 levels of a picture and a highlight.
    assert (np.ptp(dimmed, axis=1) < 0.25 * dimmed.max(axis=1)).all()


def test_scrubbing_shows_each_frame_as_it_was_recorded(hanging):
    from bridge_demolition_addon.simulation.blender_events import contours_of, shown_results

    scene, recording = hanging.scene, shown_results(hanging.scene).recording
    contours_of(scene).show(
        ContourSettings(quantity=ContourQuantity.SUM, logarithmic=False, colour_map=ColourMap.BLUE_TO_RED)
    )
    sums = np.array([frame.loads.body_sums_n for frame in recording.frames])
    names, moving = recording.inventory.body_names.tolist(), [1, 3]
    for frame in (2, 5, 3, 5):
        scene.frame_set(frame)
        rows = [names.index(hanging.world.collection.objects[index].name) for index in moving]
        row = [recorded.number for recorded in recording.frames].index(frame)
        shares = sums[row, rows] / sums[:, rows].max()
        assert np.allclose(shown_colours(hanging)[moving], linear(colours(ColourMap.BLUE_TO_RED, shares)), atol=1e-6)


def test_an_edited_body_is_coloured_again(hanging):
    from bridge_demolition_addon.simulation.blender_events import contours_of

    contours_of(hanging.scene).show(FRAME_BY_FRAME)
    hanging.scene.frame_set(5)
    before = shown_colours(hanging)
    hanging.world.collection.objects[1].data.update_tag()
    hanging.world.collection.objects[1].update_tag()
    hanging.scene.view_layers[0].update()
    assert np.array_equal(shown_colours(hanging), before)


def test_everything_is_as_before_when_contours_end(hanging):
    import bpy

    from bridge_demolition_addon.simulation.blender_events import contours_of

    scene = hanging.scene
    red = bpy.data.materials.new("Red")
    scene.view_layers[0].material_override = red
    scene.view_settings.view_transform, scene.view_settings.exposure = "AgX", 0.7
    own, look, materials = own_colours(hanging), look_of(scene), list(bpy.data.materials)
    contours_of(scene).show(FRAME_BY_FRAME)
    scene.frame_set(5)
    assert own_colours(hanging) == own
    assert look_of(scene) != look and scene.view_layers[0].material_override != red
    contours_of(scene).hide()
    assert (own_colours(hanging), look_of(scene), list(bpy.data.materials)) == (own, look, materials)
    assert np.array_equal(shown_colours(hanging), np.array(own)[:, :3])
    assert not contours_of(scene).is_shown


def test_a_file_saved_with_contours_can_be_put_back(hanging, tmp_path):
    import bpy

    from bridge_demolition_addon.scene.rendering.body_colours import show_materials
    from bridge_demolition_addon.simulation.blender_events import contours_of

    scene = hanging.scene
    red = bpy.data.materials.new("Red")
    scene.view_layers[0].material_override = red
    own, transform = own_colours(hanging), scene.view_settings.view_transform
    contours_of(scene).show(FRAME_BY_FRAME)
    scene.frame_set(5)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "with.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "with.blend"))
    scene = bpy.context.scene
    assert not contours_of(scene).is_shown
    assert [tuple(obj.color) for obj in scene.rigidbody_world.collection.objects] == own
    show_materials(scene)
    assert scene.view_layers[0].material_override.name == "Red"
    assert scene.view_settings.view_transform == transform


def test_handlers_are_there_once(hanging):
    import bpy

    from bridge_demolition_addon.simulation.blender_events import contours_of

    for _ in range(3):
        contours_of(hanging.scene).show(FRAME_BY_FRAME)
    lists = (bpy.app.handlers.frame_change_post, bpy.app.handlers.depsgraph_update_post, bpy.app.handlers.load_pre)
    assert [sum(handler.__module__.startswith("bridge_demolition_addon") for handler in one) for one in lists] == [
        1,
        1,
        1,
    ]


def test_kept_results_are_shown_and_those_of_another_scene_refused(hanging, tmp_path):
    from support.sample_results import changed

    from bridge_demolition_addon.model.results.arrays import load_results
    from bridge_demolition_addon.simulation.blender_events import contours_of, recorded_scene, shown_results

    shown_results(hanging.scene).recording.results().save(tmp_path / "results.npz")
    scene, results = hanging.scene, load_results(tmp_path / "results.npz")
    contours_of(scene).show(FRAME_BY_FRAME)
    scene.frame_set(5)
    live = shown_colours(hanging)
    recorded_scene(scene).show_results(changed(results, body_sums_n=2.0 * results.frames.loads.body_sums_n))
    row = shown_results(scene).series.row_at(5)
    recorded = [frame.loads.body_sums_n for frame in shown_results(hanging.scene).recording.frames][row]
    assert np.array_equal(shown_results(scene).series.frame(row).loads.body_sums_n, 2.0 * recorded)
    contours_of(scene).refresh()
    assert np.allclose(shown_colours(hanging), live)  # a frame's own range takes the factor out again
    with pytest.raises(ContourError, match="none of their"):
        recorded_scene(scene).show_results(changed(results, body_names=np.array(["a", "b", "c", "d"])))


def test_hidden_connections_work_all_the_same(blender, tmp_path):
    from bridge_demolition_addon.scene.visibility import hide_symbols, symbols_are_hidden

    blocks = Blocks()
    ledge, block = blocks.block((0.0, 0.0, 5.0)), blocks.block((0.0, 0.0, 3.0), 100.0)
    connection = blocks.connect("FIXED", (0.0, 0.0, 4.0), ledge, block)
    layer = blocks.scene.view_layers[0]
    hide_symbols(layer, blocks.scene, hidden=True)
    assert symbols_are_hidden(layer, blocks.scene) and not connection.visible_get() and block.visible_get()
    results = blocks.play(tmp_path, FRAMES)
    # It hangs: the connection carries 100 kg, within a thousandth that the solver leaves.
    assert abs(results.frames.loads.connection_forces_n[-1, 0, 2]) == pytest.approx(100.0 * 9.80665, rel=1e-3)
    hide_symbols(layer, blocks.scene, hidden=False)
    assert not symbols_are_hidden(layer, blocks.scene) and connection.visible_get()


def test_bodies_are_where_they_were_recorded_when_blender_has_forgotten_its_frames(blender, tmp_path):
    from bridge_demolition_addon.simulation.blender_events import contours_of
    from bridge_demolition_addon.simulation.display.film import FilmKind

    blocks = Blocks()
    block = blocks.block((0.0, 0.0, 3.0), 100.0)  # falls freely
    results = blocks.play(tmp_path, FRAMES)
    scene, graph = blocks.scene, blocks.scene.view_layers[0].depsgraph
    contours_of(scene).show(FRAME_BY_FRAME)
    scene.rigidbody_world.time_scale = scene.rigidbody_world.time_scale  # Blender takes any setting for a change
    scene.view_layers[0].update()
    assert scene.rigidbody_world.point_cache.is_outdated
    for row in (5, 2, 4):
        scene.frame_set(int(results.frames.number[row]))
        assert tuple(block.evaluated_get(graph).matrix_world.translation) == pytest.approx(
            results.frames.positions_m[row, 0]
        )
    # As the simulation would begin again in a render, it has to rest there: Blender crashes otherwise.
    assert len(render_film(scene, tmp_path / "film", FRAME_BY_FRAME, small_film(kind=FilmKind.PICTURES))) == FRAMES + 1
    assert scene.rigidbody_world.enabled
    contours_of(scene).hide()


def render_film(*settings):
    """Render a film, all of it at once: the files written."""
    from bridge_demolition_addon.simulation.display.film import FilmRendering

    rendering = FilmRendering(*settings)
    for _ in rendering.pictures():
        pass
    return rendering.finish()


def small_film(**more):
    from bridge_demolition_addon.scene.rendering.film import RenderSettings
    from bridge_demolition_addon.simulation.display.film import FilmSettings

    return FilmSettings(picture=RenderSettings(320, 180), **more)


def test_pictures_of_contours(hanging, tmp_path):
    from bridge_demolition_addon.charts.contour_legend import legend_width
    from bridge_demolition_addon.simulation.display.film import FilmKind

    scene, folder = hanging.scene, tmp_path / "pictures"
    scene.frame_set(3)
    look = look_of(scene)
    paths = render_film(scene, folder, FRAME_BY_FRAME, small_film(kind=FilmKind.PICTURES))
    assert [path.name for path in paths] == [f"contours_{frame:06d}.png" for frame in range(2, 9)]
    assert look_of(scene) == look and scene.frame_current == 3
    pixels = imread(folder / "contours_000004.png")[:, :, :3]
    assert pixels.shape == (180, 320, 3)
    rendered = pixels[:, legend_width(180) :].reshape(-1, 3)
    highest = colours(ColourMap.VIRIDIS, [1.0])[0]
    assert (abs(rendered - highest).max(axis=1) <= ONE_LEVEL).sum() > 100  # the heavier block
    # The bar: a low and a high colour stand in the legend, the high one above the low.
    legend = pixels[:, : legend_width(180)]
    ends = [np.argwhere(abs(legend - colour).max(axis=2) < 0.02) for colour in colours(ColourMap.VIRIDIS, [0.1, 0.9])]
    assert len(ends[0]) and len(ends[1]) and ends[1][:, 0].max() < ends[0][:, 0].min()


def test_a_film_has_its_frames_and_colours(hanging, tmp_path):
    import bpy

    scenes, images = len(bpy.data.scenes), len(bpy.data.images)
    settings = small_film(pictures_per_second=24.0, slowness=2.0)
    (film,) = render_film(hanging.scene, tmp_path / "film", FRAME_BY_FRAME, settings)
    assert [path.name for path in film.parent.iterdir()] == ["contours.mp4"]
    assert len(bpy.data.scenes) == scenes
    clip = bpy.data.movieclips.load(str(film))
    # From frame 2, at time 0, to frame 8 are six frames of 1/24 s: shown twice as long, with the first.
    assert (tuple(clip.size), clip.frame_duration, round(clip.fps)) == ((320, 180), 13, 24)
    assert len(bpy.data.images) <= images + 1  # Blender's own Render Result


def test_slow_motion_is_a_film_of_the_same_pictures(hanging, tmp_path):
    import bpy

    from bridge_demolition_addon.simulation.display.film import FilmRendering

    settings = small_film(pictures_per_second=24.0, slow_motion=5.0)
    rendering = FilmRendering(hanging.scene, tmp_path / "film", FRAME_BY_FRAME, settings)
    assert rendering.picture_count == len(list(rendering.pictures())) == 7
    films = rendering.finish()
    assert [film.name for film in films] == ["contours.mp4", "contours_slow_motion.mp4"]
    lengths = [bpy.data.movieclips.load(str(film)).frame_duration for film in films]
    assert lengths == [7, 31]  # the first picture, and once or five times for each of six frames


def test_a_film_that_cannot_be_made_is_refused(hanging, tmp_path, blender):
    from bridge_demolition_addon.scene.rendering.film import RenderSettings
    from bridge_demolition_addon.simulation.blender_events import contours_of

    look = look_of(hanging.scene)
    with pytest.raises(OutputError, match="even"):
        RenderSettings(321, 180)
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match="cannot be written"):
        render_film(hanging.scene, tmp_path / "file", FRAME_BY_FRAME, small_film())
    other = blender.data.scenes.new("Other")
    with pytest.raises(ContourError, match="no recording"):
        render_film(other, tmp_path / "no", FRAME_BY_FRAME, small_film())
    assert look_of(hanging.scene) == look and not contours_of(hanging.scene).is_shown
    assert not (tmp_path / "no").exists()
