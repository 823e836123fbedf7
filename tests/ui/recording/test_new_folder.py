# SPDX-License-Identifier: GPL-3.0-or-later
"""A run needs no folder chosen: it makes one, and the line above the buttons says what comes next."""

import pytest
from support.checkout import SMALL

from bridge_demolition_addon.model.results.arrays import RESULTS_FILE
from bridge_demolition_addon.ui.recording.session import documents_folder, new_folder
from bridge_demolition_addon.ui.scenario.hints import next_step


@pytest.fixture
def home(monkeypatch, tmp_path):
    """A home without anything in it."""
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("USERPROFILE", str(tmp_path))
    monkeypatch.delenv("XDG_CONFIG_HOME", raising=False)
    return tmp_path


@pytest.fixture
def small(extension, settings):
    settings.scenario_path = str(SMALL)
    extension.ops.bda.build_scenario()
    extension.context.scene.frame_end = 5
    return extension


def test_documents_are_where_the_desktop_says(home):
    assert documents_folder() == home
    (home / "Documents").mkdir()
    assert documents_folder() == home / "Documents"
    (home / ".config").mkdir()
    (home / ".config" / "user-dirs.dirs").write_text('# made by xdg\nXDG_DOCUMENTS_DIR="$HOME/Dokumente"\n')
    assert documents_folder() == home, "a folder that is not there"
    (home / "Dokumente").mkdir()
    assert documents_folder() == home / "Dokumente"


def test_folders_are_counted_up_and_never_reused(blender, home):
    parent = home / "Bridge Demolition"
    assert new_folder("I-235: one span") == parent / "I-235_one_span_1"
    for name in ("I-235_one_span_2", "I-235_one_span_9", "I-235_one_span_9b", "Other_70"):
        (parent / name).mkdir(parents=True)
    assert new_folder("I-235: one span") == parent / "I-235_one_span_10"


@pytest.mark.parametrize("title, name", [("...", "demolition_1"), ("../../etc", "etc_1"), ("Brücke 3", "Brücke_3_1")])
def test_a_name_is_one_folder_whatever_the_title_is(blender, home, title, name):
    assert new_folder(title) == home / "Bridge Demolition" / name
    assert len(new_folder("a" * 300).name) < 70


def test_each_run_of_an_unsaved_file_gets_a_folder_in_the_documents(small, home):
    for number in (1, 2):
        assert small.ops.bda.run() == {"FINISHED"}
        assert (home / "Bridge Demolition" / f"Small_bridge_wrecking_ball_{number}" / RESULTS_FILE).is_file()
    assert small.context.scene.bda.output_directory == ""


@pytest.mark.long
def test_a_run_of_a_saved_file_is_beside_it_and_its_report_in_it(small, home, tmp_path):
    (tmp_path / "job").mkdir()
    small.ops.wm.save_as_mainfile(filepath=str(tmp_path / "job" / "scene.blend"))
    small.ops.bda.run()
    folder = tmp_path / "job" / "Small_bridge_wrecking_ball_1"
    assert (folder / RESULTS_FILE).is_file()
    small.ops.bda.make_report()
    assert (folder / "report.html").is_file()


def test_after_a_run_that_was_stopped_the_next_step_is_to_run_again(small, home):
    def delete(scene, _depsgraph):
        if scene.frame_current == 3:
            small.data.objects.remove(scene.rigidbody_world.constraints.objects[0])

    small.app.handlers.frame_change_post.append(delete)
    try:
        small.ops.bda.run()
    finally:
        small.app.handlers.frame_change_post.remove(delete)
    assert next_step(small.context.scene).startswith("Next: Run again to its end")


def test_the_next_step_follows_the_work(extension, settings, home):
    scene = extension.context.scene
    assert "Presets" in next_step(scene) and "Build Scenario" in next_step(scene)
    settings.scenario_path = str(SMALL)
    extension.ops.bda.build_scenario()
    assert next_step(scene).startswith("Next: Run")
    settings.scenario.ball.mass_kg = 4321.0
    assert "Build Again and Run" in next_step(scene)
    extension.ops.bda.show_built()
    scene.frame_end = 5
    extension.ops.bda.register_handler()
    assert "being recorded" in next_step(scene)
    for frame in range(2, 6):
        scene.frame_set(frame)
    extension.ops.bda.unregister_handler()
    assert "Report" in next_step(scene)
    extension.ops.bda.remove_demolition()
    assert "Presets" in next_step(scene)
