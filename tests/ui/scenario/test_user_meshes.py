# SPDX-License-Identifier: GPL-3.0-or-later
"""Selected meshes become members of the scenario, and paint says where they are cut finer."""

from pathlib import Path

import numpy as np
import pytest

from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.model.structure.point_files import paint_from_file
from bridge_demolition_addon.ui.preview.decorator import preview_lines
from bridge_demolition_addon.ui.scenario.preset_menu import name_own_model
from bridge_demolition_addon.ui.scenario.values import scenario_of


@pytest.fixture
def objects(extension, settings):
    """A deck of 10 x 4 x 0.5 m on two walls, modelled by hand, selected, and no other bridge."""
    settings.scenario.use_bridge = settings.scenario.use_ball = False
    settings.scenario.fracture.shards = 60
    made = []
    for name, size, position in (
        ("deck", (10.0, 4.0, 0.5), (5.0, 0.0, 4.25)),
        ("west wall", (0.5, 4.0, 4.0), (0.5, 0.0, 2.0)),
        ("east wall", (0.5, 4.0, 4.0), (9.5, 0.0, 2.0)),
    ):
        mesh, solid = extension.data.meshes.new(name), box(size)
        mesh.from_pydata(solid.vertices, [], solid.triangles.tolist())
        made.append(extension.data.objects.new(name, mesh))
        extension.context.scene.collection.objects.link(made[-1])
        made[-1].location = position
        made[-1].select_set(True)
    extension.context.view_layer.objects.active = made[0]
    extension.context.view_layer.update()
    return made


def test_selected_meshes_are_built_as_members(extension, settings, objects, tmp_path):
    folder = tmp_path / "members"
    assert extension.ops.bda.add_selected_members(directory=str(folder), density_kg_m3=2500.0) == {"FINISHED"}
    assert sorted(path.name for path in folder.iterdir()) == ["deck.ply", "east wall.ply", "west wall.ply"]
    assert all(obj.hide_get() for obj in objects)
    shown = preview_lines(settings)  # in their place: twelve edges of each box
    assert len(shown) == 3 * 12 * 2 and np.ptp(shown, axis=0) == pytest.approx([10.0, 4.0, 4.5])
    model = build_model(scenario_of(settings))
    masses = {member.name: member.mass_kg for member in model.members}
    # Blender keeps single precision of some metres.
    assert masses == pytest.approx({"deck": 50_000, "west wall": 20_000, "east wall": 20_000}, rel=1e-5)
    extension.ops.bda.build_scenario()
    assert len(preview_lines(settings)) == 0
    shards = [body for body in extension.data.objects if body.get("bda_kind") == "shard"]
    assert len(shards) == 60
    assert sum(body.rigid_body.mass for body in shards) == pytest.approx(90_000, rel=1e-5)


@pytest.mark.parametrize("with_bridge", [False, True])
def test_the_default_bridge_is_built_too_only_where_that_was_said(extension, settings, objects, tmp_path, with_bridge):
    settings.scenario.use_bridge = True
    extension.ops.bda.add_selected_members(directory=str(tmp_path / "members"), with_bridge=with_bridge)
    assert settings.scenario.use_bridge == with_bridge
    scenario = scenario_of(settings)
    assert (scenario.bridge is not None) == with_bridge
    assert {mesh.name for mesh in scenario.geometry} == {"deck", "west wall", "east wall"}


@pytest.mark.long
def test_the_saved_scenario_needs_no_objects(extension, settings, objects, tmp_path):
    extension.ops.bda.add_selected_members(directory=str(tmp_path / "members"))
    extension.ops.bda.save_scenario(filepath=str(tmp_path / "saved.toml"))
    for obj in objects:
        extension.data.objects.remove(obj)
    model = build_model(read_scenario(tmp_path / "saved.toml"))
    assert sum(member.mass_kg for member in model.members) == pytest.approx(2400 * 36, rel=1e-5)


@pytest.mark.long
def test_a_changed_mesh_takes_the_place_of_what_was_added_before(extension, settings, objects, tmp_path):
    extension.ops.bda.add_selected_members(directory=str(tmp_path))
    objects[0].hide_set(False)
    objects[0].select_set(True)
    objects[0].scale = (1.0, 1.0, 2.0)
    extension.context.view_layer.update()
    extension.ops.bda.add_selected_members(directory=str(tmp_path))
    scenario = scenario_of(settings)
    assert [mesh.name for mesh in scenario.geometry].count("deck") == 1
    assert {member.name: member.volume_m3 for member in build_model(scenario).members}["deck"] > 19.0


def test_one_click_takes_the_meshes_of_all_that_is_selected_and_makes_a_folder(extension, settings, objects, tmp_path):
    lamp = extension.data.objects.new("lamp", extension.data.lights.new("lamp", "POINT"))
    extension.context.scene.collection.objects.link(lamp)
    lamp.select_set(True)
    extension.ops.wm.save_as_mainfile(filepath=str(tmp_path / "bridge.blend"))
    assert extension.ops.bda.add_selected_members("INVOKE_DEFAULT") == {"FINISHED"}
    files = sorted(path.name for path in (tmp_path / "members_1").iterdir())
    assert files == ["deck.ply", "east wall.ply", "west wall.ply"]
    tables = extension.context.scene.bda.scenario.geometry
    assert {table.name for table in tables} == {"deck", "east wall", "west wall"}
    assert not lamp.hide_get()


def test_what_cannot_be_a_member_changes_nothing(extension, settings, objects, tmp_path):
    mesh = extension.data.meshes.new("sail")
    mesh.from_pydata([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)], [], [(0, 1, 2)])
    sail = extension.data.objects.new("sail", mesh)
    extension.context.scene.collection.objects.link(sail)
    sail.select_set(True)
    with pytest.raises(RuntimeError, match="sail"):
        extension.ops.bda.add_selected_members(directory=str(tmp_path / "members"))
    assert not (tmp_path / "members").exists() and not len(settings.scenario.geometry)
    assert not any(obj.hide_get() for obj in objects)


def test_files_of_others_are_not_overwritten(extension, settings, objects, tmp_path):
    (tmp_path / "deck.ply").write_text("mine")
    with pytest.raises(RuntimeError, match=r"deck\.ply: exists already"):
        extension.ops.bda.add_selected_members(directory=str(tmp_path))
    assert (tmp_path / "deck.ply").read_text() == "mine" and [path.name for path in tmp_path.iterdir()] == ["deck.ply"]


def test_a_folder_beside_a_file_without_a_place_is_refused(extension, objects):
    with pytest.raises(RuntimeError, match="is relative to this file, which is not saved yet"):
        extension.ops.bda.add_selected_members(directory="//members")


def test_nothing_selected(extension, objects):
    for obj in objects:
        obj.select_set(False)
    with pytest.raises(RuntimeError, match="Select the meshes"):
        extension.ops.bda.add_selected_members(directory="/tmp")


def painted(objects, weight=1.0):
    deck = objects[0]
    group = deck.vertex_groups.new(name="finer")
    group.add([index for index, vertex in enumerate(deck.data.vertices) if vertex.co.x > 0], weight, "REPLACE")
    return deck


@pytest.mark.long
def test_the_painted_end_is_cut_finer(extension, settings, objects, tmp_path):
    painted(objects)
    extension.ops.bda.add_selected_members(directory=str(tmp_path))
    even = build_model(scenario_of(settings)).centres_m
    assert extension.ops.bda.use_paint(filepath=str(tmp_path / "paint")) == {"FINISHED"}
    points, weights = paint_from_file(tmp_path / "paint.csv")
    assert points[weights == 1.0][:, 0] == pytest.approx(10.0) and points[weights == 0.0][:, 0] == pytest.approx(0.0)
    settings.scenario.fracture.painted_factor = 20.0
    finer = build_model(scenario_of(settings)).centres_m
    assert len(finer) == len(even) == 60

    def share(centres):
        deck = centres[centres[:, 2] > 4.0]
        return np.mean(deck[:, 0] > 5.0)

    assert abs(share(even) - 0.5) < 0.2
    assert share(finer) > 0.7


def test_paint_that_is_not_there_is_refused(extension, settings, objects, tmp_path):
    with pytest.raises(RuntimeError, match="Choose a mesh with a vertex group first"):
        extension.ops.bda.use_paint(filepath=str(tmp_path / "paint.csv"))
    painted(objects, weight=0.0)
    with pytest.raises(RuntimeError, match="nothing is painted in vertex group 'finer'"):
        extension.ops.bda.use_paint(filepath=str(tmp_path / "paint.csv"))
    assert not Path(tmp_path / "paint.csv").exists() and not settings.scenario.fracture.use_painted_file


def test_a_model_of_ones_own_has_no_title_of_a_preset(extension, settings, objects, tmp_path):
    assert settings.scenario.title == "Reinforced span, wrecking ball"
    extension.ops.bda.add_selected_members(directory=str(tmp_path / "members"))
    assert settings.scenario.title == "Own model"
    extension.ops.bda.load_preset(preset="drilled_spans")
    extension.ops.wm.save_as_mainfile(filepath=str(tmp_path / "Mill Lane footbridge.blend"))
    titles = {}
    for use_bridge, title in ((True, ""), (False, ""), (False, "Mill Lane, second attempt")):
        settings = extension.context.scene.bda
        settings.scenario.use_bridge = use_bridge
        settings.scenario.title = title or settings.scenario.title
        name_own_model(settings)
        titles[use_bridge, title] = settings.scenario.title
    assert list(titles.values()) == [
        "Two reinforced spans, drilled charges",  # as it was loaded
        "Mill Lane footbridge",
        "Mill Lane, second attempt",  # the user's own
    ]
