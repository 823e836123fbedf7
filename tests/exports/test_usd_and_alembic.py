# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender writes: USD, read by the library of its makers, and Alembic, read by Blender."""

import signal
from dataclasses import replace

import numpy as np
import pytest
from pxr import Usd, UsdGeom
from support.exported_runs import SMALLEST_M, corners_m, in_order, turning_run, with_ground
from support.run_folders import keep_run

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.errors import MissingLibraryError, SimulationError
from bridge_demolition_addon.exports.formats import ALEMBIC, USD
from bridge_demolition_addon.exports.write import export_run
from bridge_demolition_addon.system.signals import Interrupted

FIRST = 2
"""Blender's frame of the first that is recorded."""


class Counted(Silence):
    """Keeps what was told."""

    def __init__(self):
        self.parts = []

    def part(self, done, total, text):
        self.parts.append((done, total))


def unevenly_timed():
    """The run, with frames that last longer from the eighth on, and names that USD does not allow."""
    results = with_ground(turning_run())
    frames, inventory = results.frames, results.inventory
    times = frames.time_s.copy()
    times[7:] += np.arange(1, len(times) - 6) * 0.1
    names = inventory.body_names.astype(object)
    names[:3] = "Pfeiler 1 (ä)", "Pfeiler 1 (ö)", "7 up"
    return replace(
        results, frames=replace(frames, time_s=times), inventory=replace(inventory, body_names=names.astype(str))
    )


@pytest.fixture(scope="module")
def exported(tmp_path_factory):
    """Folder with both files, the run, and what was told on the way."""
    folder, results = tmp_path_factory.mktemp("exported"), unevenly_timed()
    run, told = keep_run(folder / "run", results), {}
    for form in (USD, ALEMBIC):
        told[form] = Counted()
        export_run(run, form, folder / f"run{form.ending}", told[form])
    return folder, results, told


@pytest.fixture(scope="module")
def stage(exported):
    return Usd.Stage.Open(str(exported[0] / "run.usdc"))


def prims_by_name(stage):
    """The transforms of bodies, by their names in the run."""
    prims = stage.GetDefaultPrim().GetChildren()
    return {prim.GetAttribute("bda:name").Get(): prim for prim in prims}


def test_usd_has_every_body_at_its_place_in_every_frame(exported, stage):
    _, results, _ = exported
    frames, per_second = results.frames, stage.GetTimeCodesPerSecond()
    prims = prims_by_name(stage)
    assert list(prims) == results.inventory.body_names.tolist()
    for row, time_s in enumerate(frames.time_s):
        cache = UsdGeom.XformCache(FIRST + (time_s - frames.time_s[0]) * per_second)
        for body, prim in enumerate(prims.values()):
            matrix = np.array(cache.GetLocalToWorldTransform(prim))  # of rows: points stand before it
            position, turn = matrix[3, :3], matrix[:3, :3].T
            assert position == pytest.approx(frames.positions_m[row, body], abs=SMALLEST_M)
            assert turn == pytest.approx(frames.rotations[row, body], abs=SMALLEST_M)


def test_usd_has_the_shapes_of_bodies(exported, stage):
    _, results, _ = exported
    cache = UsdGeom.XformCache(FIRST)
    for body, prim in enumerate(prims_by_name(stage).values()):
        shape = UsdGeom.Mesh(prim.GetChild("Shape"))
        matrix = np.array(cache.GetLocalToWorldTransform(shape.GetPrim()))
        points = np.array(shape.GetPointsAttr().Get(), float) @ matrix[:3, :3] + matrix[3, :3]
        # A point of a mesh is in single precision, which USD prescribes: 2e-6 m, 50 m from the body's centre.
        assert in_order(points) == pytest.approx(in_order(corners_m(results, 0, body)), abs=4e-6)
        assert set(shape.GetFaceVertexCountsAttr().Get()) == {3}


def test_usd_says_units_axes_times_and_members(exported, stage):
    _, results, _ = exported
    assert UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z
    assert UsdGeom.GetStageMetersPerUnit(stage) == 1.0
    assert stage.GetTimeCodesPerSecond() == pytest.approx(24.0)
    assert stage.GetStartTimeCode() == FIRST
    lasts_s = (stage.GetEndTimeCode() - stage.GetStartTimeCode()) / stage.GetTimeCodesPerSecond()
    assert lasts_s == pytest.approx(results.frames.time_s[-1] - results.frames.time_s[0], abs=1e-6)
    prims = prims_by_name(stage)
    assert [prim.GetAttribute("bda:member").Get() for prim in prims.values()] == results.inventory.body_members.tolist()
    assert [prim.GetAttribute("bda:massKg").Get() for prim in prims.values()] == results.inventory.masses_kg.tolist()


def test_alembic_has_every_body_at_its_place_in_every_frame(exported, blender):
    folder, results, _ = exported
    blender.ops.wm.alembic_import(filepath=str(folder / "run.abc"), as_background_job=False)
    scene, frames = blender.context.scene, results.frames
    # Alembic names bodies as Blender's exporter does, which keeps letters and digits.
    bodies = sorted(blender.data.objects, key=lambda body: body.name)
    assert len(bodies) == len(results.inventory.body_names)
    for row, number in enumerate(frames.number):
        scene.frame_set(int(number))
        found = np.array([np.array(body.matrix_world.translation) for body in bodies])
        assert in_order(found) == pytest.approx(in_order(frames.positions_m[row].astype(float)), abs=SMALLEST_M)
        for body in bodies:
            row_of_body = int(np.linalg.norm(frames.positions_m[row] - body.matrix_world.translation, axis=1).argmin())
            turn = np.array(body.matrix_world.to_3x3())
            # Blender turns the axes twice, in single precision.
            assert turn == pytest.approx(frames.rotations[row, row_of_body], abs=2e-6)


def test_both_say_how_far_they_are(exported):
    _, results, told = exported
    count, frames = len(results.inventory.body_names), len(results.frames)
    assert told[USD].parts == [(done, count) for done in range(1, count + 1)]
    assert told[ALEMBIC].parts[-1] == (frames, frames)
    assert {done for done, _ in told[ALEMBIC].parts} == set(range(1, frames + 1))


class Stopping(Silence):
    """Ctrl-C as soon as the first part is written."""

    def part(self, done, total, text):
        raise Interrupted(signal.SIGINT)


def test_ctrl_c_ends_blender_and_leaves_nothing(exported, tmp_path):
    with pytest.raises(Interrupted):
        export_run(exported[0] / "run", ALEMBIC, tmp_path / "run.abc", Stopping())
    assert list(tmp_path.iterdir()) == []


def test_a_blender_that_ends_is_told_with_its_last_words(exported, tmp_path):
    program = tmp_path / "blender"
    program.write_text("#!/bin/sh\necho out of luck >&2\nexit 3\n")
    program.chmod(0o755)
    with pytest.raises(SimulationError, match=r"Blender ended .* before usd was written: out of luck"):
        export_run(exported[0] / "run", USD, tmp_path / "run.usdc", Silence(), str(program))
    assert [path.name for path in tmp_path.iterdir()] == ["blender"]


def test_where_there_is_no_blender_it_is_named(exported, tmp_path, monkeypatch):
    (tmp_path / "bpy.py").write_text("raise ModuleNotFoundError(\"No module named 'bpy'\", name='bpy')\n")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    with pytest.raises(
        MissingLibraryError, match="Blender, which writes alembic, is not there: install the bpy package"
    ):
        export_run(exported[0] / "run", ALEMBIC, tmp_path / "run.abc", Silence())
    assert not list(tmp_path.glob("run*"))
