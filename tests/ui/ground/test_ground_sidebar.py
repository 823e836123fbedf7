# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn on the ground and in the air, zones that are added, a site plan, and dust that renders."""

import json
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.image import imread, imsave
from support.checkout import EXAMPLES, REPORT_2019

from bridge_demolition_addon.engineering.geometry.plan_areas import outlines
from bridge_demolition_addon.model.debris.zones import exclusion_zone
from bridge_demolition_addon.model.scenario import Exclusion, Neighbour, Zone
from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_text

ROAD = Zone(name="Main Street", kind="road", corners_m=((20.0, -5.0), (30.0, -5.0), (30.0, 5.0), (20.0, 5.0)))
SCENARIO = read_scenario(REPORT_2019 / "two_spans_13m_explosives.toml")
SHORT = replace(
    SCENARIO,
    fracture=replace(SCENARIO.fracture, shards=40),
    time=replace(SCENARIO.time, duration_s=1.2),
    blast=replace(SCENARIO.blast, start_s=0.1),
    connections=replace(SCENARIO.connections, strength_factor=0.05),
    zones=(ROAD,),
    neighbours=(Neighbour(name="School", position_m=(60.0, 10.0, 0.0)),),
    exclusion=Exclusion(buffer_m=10.0),
)
ALL = {"EXCLUSION", "ZONES", "DEBRIS", "RINGS", "NEIGHBOURS", "WAY", "FLASHES", "NAMES"}


@pytest.fixture
def built(extension, tmp_path):
    path = tmp_path / "scenario.toml"
    path.write_text(scenario_text(SHORT), encoding="utf-8")
    scene = extension.context.scene
    scene.bda.scenario_path = str(path)
    assert extension.ops.bda.build_scenario() == {"FINISHED"}
    scene.bda.overlays = ALL
    return scene


@pytest.fixture
def ran(built, extension, tmp_path):
    built.bda.output_directory = str(tmp_path / "run")
    assert extension.ops.bda.run() == {"FINISHED"}
    return built


def texts(scene):
    return [item.text for item in everything(scene) if item.text]


def everything(scene):
    from bridge_demolition_addon.ui.ground.decorator import drawn

    return list(drawn(scene, scene.view_layers[0]))


def by_text(scene, beginning):
    (found,) = (item for item in everything(scene) if item.text.startswith(beginning))
    return found


def test_zones_neighbours_and_distances_are_drawn_before_a_run(built):
    assert {"Main Street (road)", "School", "10 m", "50 m"} <= set(texts(built))
    assert not [text for text in texts(built) if text.startswith("Debris")]
    planned = by_text(built, "Exclusion zone")
    assert planned.text == "Exclusion zone as planned, without debris"
    # 10 m to every side of two spans of 13 m with their overhangs, which are no longer than a metre.
    assert np.ptp(planned.lines[:, 0]) == pytest.approx(26.0 + 20.0, abs=2.1)
    built.bda.overlays = set()
    assert everything(built) == []


@pytest.mark.long
def test_after_a_run_zone_and_debris_are_those_of_the_report(ran, tmp_path):
    from bridge_demolition_addon.model.results.arrays import load_results

    zone = exclusion_zone(load_results(tmp_path / "run" / "results.npz"), SHORT.exclusion)
    shown = by_text(ran, "Exclusion zone of the last run")
    corners = np.concatenate(outlines(zone.whole))
    np.testing.assert_allclose(shown.lines[::2, :2], corners, atol=1e-4)  # results are kept in single precision
    assert by_text(ran, "Debris").text.endswith("m²")


@pytest.mark.long
def test_a_flash_is_drawn_while_a_charge_goes_off(ran):
    from bridge_demolition_addon.simulation.blender_events import shown_results

    names, series = {charge.name for charge in SHORT.charges}, shown_results(ran).series
    goes_off = {charge.name: 0.1 + charge.delay_ms / 1e3 for charge in SHORT.charges}
    seen = []
    for frame, now_s in zip(series.frames, series.times_s.tolist(), strict=True):  # frames differ in length
        ran.frame_set(frame)
        flashing = {name for name, time_s in goes_off.items() if -1e-6 <= now_s - time_s <= 0.25}
        assert names & set(texts(ran)) == flashing
        seen.append(len(flashing))
    assert seen[0] == 0 and max(seen) > 0 and seen[-1] == 0


def test_charges_without_a_world_to_go_off_in_are_no_trouble(extension):
    from bridge_demolition_addon.scene.blast.charges import create_charges, keep_blast

    scene = extension.context.scene
    create_charges(scene, SHORT.charges)
    keep_blast(scene, SHORT.blast)
    scene.bda.overlays = ALL
    assert everything(scene) == []


@pytest.mark.long
def test_the_chosen_shard_is_drawn_with_its_name_where_it_is(ran):
    from bridge_demolition_addon.scene.bodies import Kind, bodies_of, kind_of

    layer = ran.view_layers[0]
    shard = next(body for body in bodies_of(ran) if kind_of(body) == Kind.SHARD)
    assert shard.name not in texts(ran)
    shard.select_set(True, view_layer=layer)
    layer.objects.active = shard
    ran.frame_set(ran.frame_end)
    found = by_text(ran, shard.name)
    position = shard.evaluated_get(layer.depsgraph).matrix_world.translation
    assert found.position_m == pytest.approx(tuple(position)) and len(found.lines) == 2 * len(shard.data.edges)


def test_a_zone_by_its_corners_is_added_to_the_scenario_and_a_wrong_one_is_not(built):
    from bridge_demolition_addon.errors import ScenarioError
    from bridge_demolition_addon.ui.ground.ui import add_zone
    from bridge_demolition_addon.ui.scenario.built import shown_site

    corners = [(0.0, 8.0), (12.5, 8.0), (12.5, 20.25)]
    assert add_zone(built, corners) == "Zone 1"
    added = shown_site(built.bda)["zones"][-1]
    assert (added.name, added.corners_m) == ("Zone 1", tuple(corners))
    for wrong in (corners[:2], [(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)]):
        with pytest.raises(ScenarioError, match="corners_m"):
            add_zone(built, wrong)
    assert len(built.bda.scenario.zones) == 2


def test_a_site_plan_lies_as_wide_and_turned_as_asked(built, extension, tmp_path):
    settings, bpy = built.bda, extension
    imsave(tmp_path / "plan.png", np.full((50, 100, 3), 0.5))
    settings.plan_picture, settings.plan_width_m, settings.plan_bearing_deg = str(tmp_path / "plan.png"), 80.0, 0.0
    settings.plan_origin = (0.25, 0.5)
    assert bpy.ops.bda.lay_site_plan() == {"FINISHED"}
    built.view_layers[0].update()
    plan = built.objects["Site plan"]
    corners = np.array([plan.matrix_world @ vertex.co for vertex in plan.data.vertices])
    # North is up, and x points north: the picture's upward direction, 40 m, lies along x, and its right along -y.
    assert sorted(np.ptp(corners, axis=0).tolist()) == pytest.approx([0.0, 40.0, 80.0], abs=1e-4)
    assert corners[0] == pytest.approx((-20.0, 20.0, 0.01), abs=1e-4)  # lower left: a quarter of 80 m to the left
    assert not plan.rigid_body
    assert bpy.ops.bda.lay_site_plan() == {"FINISHED"}
    assert [obj.name for obj in built.objects if obj.name.startswith("Site plan")] == ["Site plan"]
    (tmp_path / "none.png").write_text("no picture")
    settings.plan_picture = str(tmp_path / "none.png")
    with pytest.raises(RuntimeError, match=r"none\.png"):
        bpy.ops.bda.lay_site_plan()
    assert "Site plan" in built.objects


@pytest.mark.long
def test_dust_is_off_and_renders_where_it_is_raised(ran, extension, tmp_path):
    bpy = extension
    assert not [obj for obj in ran.objects if obj.name.startswith("Dust")]
    before = json.loads((tmp_path / "run" / "summary.json").read_text())["fingerprint"]
    assert bpy.ops.bda.raise_dust() == {"FINISHED"}
    clouds = [obj for obj in ran.objects if obj.name.startswith("Dust")]
    assert clouds and not any(puff.rigid_body or puff.particle_systems for puff in clouds)
    ran.render.engine, ran.cycles.samples, ran.cycles.use_denoising = "CYCLES", 4, False
    ran.render.resolution_x, ran.render.resolution_y = 96, 54
    cloud = max(clouds, key=lambda puff: max(puff.scale))
    appears = int(min(point.co.x for curve in curves_of(cloud) for point in curve.keyframe_points if point.co.x > 0))
    pictures = []
    for hidden in (False, True):
        for puff in clouds:
            puff.animation_data.action = None if hidden else puff.animation_data.action
            puff.hide_render = hidden
        ran.frame_set(min(appears + 4, ran.frame_end))
        ran.render.filepath = str(tmp_path / "dust.png")
        bpy.ops.render.render(write_still=True)
        pictures.append(imread(tmp_path / "dust.png")[..., :3])
    # The noise of both is the same: without clouds, no pixel differs. With them 20 and more do, by version of Blender.
    assert (abs(pictures[0] - pictures[1]).max(axis=2) > 0.05).sum() > 10
    assert bpy.ops.bda.settle_dust() == {"FINISHED"}
    assert not [obj for obj in ran.objects if obj.name.startswith("Dust")]
    ran.bda.overwrite = True
    assert bpy.ops.bda.run() == {"FINISHED"}
    assert json.loads((tmp_path / "run" / "summary.json").read_text())["fingerprint"] == before


def curves_of(body):
    from bridge_demolition_addon.scene.tools.keyframes import curves_of as found

    return found(body.animation_data)


@pytest.mark.long
def test_the_timeline_marks_what_happened_and_leaves_other_markers_alone(ran, extension, tmp_path):
    from bridge_demolition_addon.model.results.arrays import load_results

    assert ran.tool_settings.lock_markers  # nobody who drags along a ruler that they cover moves one
    ran.timeline_markers.new("mine", frame=7)
    frames = load_results(tmp_path / "run" / "results.npz").frames
    marked = {marker.name: marker.frame for marker in ran.timeline_markers}
    first = int(frames.number[(~frames.intact).any(axis=1).argmax()])
    assert marked["First break"] == first
    assert {charge.name for charge in SHORT.charges} <= set(marked)
    assert "Release" not in marked  # there is no ball
    ran.bda.overwrite = True
    assert extension.ops.bda.run() == {"FINISHED"}
    assert {marker.name: marker.frame for marker in ran.timeline_markers} == marked
    assert not ran.tool_settings.lock_markers  # the user has one to move
    assert extension.ops.bda.remove_demolition() == {"FINISHED"}
    assert [marker.name for marker in ran.timeline_markers] == ["mine"]


def test_blast_zones_are_drawn_with_their_holes_until_they_fire(extension, tmp_path):
    scenario = read_scenario(EXAMPLES / "drilled" / "two_spans.toml")
    first, *others = scenario.blast_zones
    scenario = replace(
        scenario,
        fracture=replace(scenario.fracture, shards=30),
        blast_zones=[replace(first, fires=False), *others],
        time=replace(scenario.time, stop_at_rest=False),
    )
    path, scene = tmp_path / "scenario.toml", extension.context.scene
    path.write_text(scenario_text(scenario), encoding="utf-8")
    scene.bda.scenario_path = str(path)
    assert extension.ops.bda.build_scenario() == {"FINISHED"}
    scene.bda.overlays = {"BLAST_ZONES"}
    assert texts(scene) == [
        "P2.1: misfires", "P2.2: 0 ms", "P1.1: 300 ms", "P1.2: 300 ms", "P3.1: 600 ms", "P3.2: 600 ms",
    ]  # fmt: skip
    parts = everything(scene)
    assert [len(part.lines) for part in parts[:2]] == [24, 20]  # 12 edges, and 10 holes
    np.testing.assert_allclose(np.ptp(parts[0].lines, axis=0), (0.7, 0.7, 1.5), atol=1e-6)
    scene.bda.overlays = set()
    assert everything(scene) == []
