# SPDX-License-Identifier: GPL-3.0-or-later
"""The button that exports the shown run."""

import shutil

import pytest
import trimesh
from support.checkout import SMALL

from bridge_demolition_addon.exports.formats import GLTF, PARAVIEW, new_export
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.ui.recording import session
from bridge_demolition_addon.ui.results.operator import BDA_OT_export_run


@pytest.fixture
def shown(extension, settings, tmp_path):
    """The small bridge, built and run, and the run's folder."""
    settings.scenario_path = str(SMALL)
    extension.ops.bda.build_scenario()
    settings.output_directory = str(tmp_path / "run")
    extension.context.scene.frame_end = 5
    extension.ops.bda.run()
    return extension, tmp_path / "run"


def test_it_writes_the_shown_run_into_its_folder_and_counts_up(shown):
    bpy, folder = shown
    for _ in range(2):
        assert bpy.ops.bda.export_run(form="gltf") == {"FINISHED"}
    assert (folder / "export.glb").read_bytes() == (folder / "export_2.glb").read_bytes()
    names = load_results(folder).inventory.body_names.tolist()
    assert set(trimesh.load_scene(folder / "export.glb").geometry) == set(names)
    assert bpy.ops.bda.export_run(form="paraview") == {"FINISHED"}
    assert (folder / "export" / "bodies.pvd").is_file()


def test_a_run_that_cannot_be_read_is_told_and_nothing_is_written(shown):
    bpy, folder = shown
    (folder / "results.npz").unlink()
    with pytest.raises(RuntimeError, match=r"results\.npz"):
        bpy.ops.bda.export_run(form="gltf")
    assert not list(folder.glob("export*"))


def test_without_a_run_it_is_greyed_with_the_reason(extension):
    assert BDA_OT_export_run.disabled_reason(extension.context) == "Nothing was recorded yet: run the scene first"


def test_a_run_that_is_gone_is_named(shown):
    bpy, folder = shown
    session.unregister()  # as after Blender was closed
    shutil.rmtree(folder)
    assert "holds the results of this scene's run no more" in BDA_OT_export_run.disabled_reason(bpy.context)


def test_names_are_those_of_the_format(tmp_path):
    assert new_export(tmp_path, GLTF).name == "export.glb"
    (tmp_path / "export").mkdir()
    assert new_export(tmp_path, PARAVIEW).name == "export_2"
