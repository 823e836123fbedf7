# SPDX-License-Identifier: GPL-3.0-or-later
"""``bda export``: where it writes, what it says, and what it leaves where it fails."""

import signal

import pytest
from support.exported_runs import kept_turning_run, turning_run
from support.processes import run_program
from support.run_folders import killed_run, stream_run

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.exports import write
from bridge_demolition_addon.exports.formats import FORMATS
from bridge_demolition_addon.system.signals import Interrupted

WITHOUT_BLENDER = ("paraview", "xlsx", "gltf", "mat")
FILES = {
    "paraview": "series",
    "xlsx": "run.xlsx",
    "gltf": "run.glb",
    "usd": "run.usdc",
    "alembic": "run.abc",
    "mat": "run.mat",
}


@pytest.fixture
def run(tmp_path):
    return kept_turning_run(tmp_path / "run")[0]


def left_in(folder):
    return sorted(path.name for path in folder.iterdir())


def refused(capsys, *arguments):
    """What is said of a command that is wrong input."""
    assert main(["export", *map(str, arguments)]) == 2
    return capsys.readouterr().err


def test_it_needs_no_blender_and_says_how_far_it_is_and_where_it_wrote(run, tmp_path):
    done = run_program("bda_without_blender", "export", run, "--to", "paraview", "--output", tmp_path / "series")
    assert (done.returncode, done.stderr) == (0, "")
    lines = done.stdout.splitlines()
    assert "12 of 12 frames written" in lines
    assert lines[-1] == str(tmp_path / "series")
    assert left_in(tmp_path) == ["run", "series"]


def test_quiet_is_quiet(run, tmp_path, capsys):
    assert main(["export", str(run), "--to", "xlsx", "--output", str(tmp_path / "run.xlsx"), "--quiet"]) == 0
    assert capsys.readouterr() == ("", "")


def test_frames_that_a_killed_run_left_are_exported(tmp_path):
    (tmp_path / "run").mkdir()
    stream_run(tmp_path / "run", turning_run(), frames=3)
    assert main(["export", str(tmp_path / "run"), "--to", "paraview", "--output", str(tmp_path / "series")]) == 0
    assert (tmp_path / "series" / "bodies.pvd").read_text().count("<DataSet") == 3


@pytest.mark.parametrize("name", FORMATS)
def test_nothing_is_written_over(run, tmp_path, capsys, name):
    output = tmp_path / FILES[name]
    output.write_text("mine")
    assert f"{output}: is there already" in refused(capsys, run, "--to", name, "--output", output)
    assert output.read_text() == "mine"


def test_an_unknown_format_is_refused_with_those_there_are(run, tmp_path, capsys):
    said = refused(capsys, run, "--to", "fbx", "--output", tmp_path / "run.fbx")
    assert "'fbx'" in said
    assert all(name in said for name in FORMATS)
    assert left_in(tmp_path) == ["run"]


def test_another_ending_is_refused(run, tmp_path, capsys):
    said = refused(capsys, run, "--to", "gltf", "--output", tmp_path / "run.gltf")
    assert "expected a name that ends in .glb" in said
    assert left_in(tmp_path) == ["run"]


def test_a_folder_that_is_not_there_is_not_made(run, tmp_path, capsys):
    said = refused(capsys, run, "--to", "xlsx", "--output", tmp_path / "no" / "run.xlsx")
    assert f"there is no folder {tmp_path / 'no'}" in said
    assert left_in(tmp_path) == ["run"]


def test_what_is_no_run_is_refused(tmp_path, capsys):
    output = tmp_path / "run.glb"
    assert "found nothing" in refused(capsys, tmp_path / "gone", "--to", "gltf", "--output", output)
    (tmp_path / "empty").mkdir()
    assert "holds no frames of a run" in refused(capsys, tmp_path / "empty", "--to", "gltf", "--output", output)
    logs_only = killed_run(tmp_path / "logs")
    assert "holds no frames of a run" in refused(capsys, logs_only, "--to", "gltf", "--output", output)
    (logs_only / "results.npz").write_bytes(b"PK damaged")
    assert "expected the results of a run" in refused(capsys, logs_only, "--to", "gltf", "--output", output)
    assert left_in(tmp_path) == ["empty", "logs"]


class Stopping(Silence):
    """Ctrl-C as soon as the first part is written."""

    def part(self, done, total, text):
        raise Interrupted(signal.SIGINT)


class Failing(Silence):
    """A disk that is full by then."""

    def part(self, done, total, text):
        raise OSError(28, "No space left on device")


@pytest.mark.parametrize("name", WITHOUT_BLENDER)
def test_ctrl_c_leaves_nothing(run, tmp_path, name):
    with pytest.raises(Interrupted):
        write.export_run(run, FORMATS[name], tmp_path / FILES[name], Stopping())
    assert left_in(tmp_path) == ["run"]


@pytest.mark.parametrize("name", WITHOUT_BLENDER)
def test_a_full_disk_leaves_nothing_and_is_said(run, tmp_path, name):
    with pytest.raises(OutputError, match=r"cannot be written \(.*No space left on device\)"):
        write.export_run(run, FORMATS[name], tmp_path / FILES[name], Failing())
    assert left_in(tmp_path) == ["run"]


def test_a_folder_that_a_killed_export_left_is_named(run, tmp_path, capsys):
    (tmp_path / "series.part").mkdir()
    said = refused(capsys, run, "--to", "paraview", "--output", tmp_path / "series")
    assert f"{tmp_path / 'series.part'}: left by something that was killed" in said
