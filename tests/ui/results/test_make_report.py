"""The button that makes a report."""

import pytest
from run_folders import flying_shards, keep_run
from scenarios import I235


def test_the_button_makes_a_report_of_the_folder(extension, tmp_path):
    folder = keep_run(tmp_path / "run", flying_shards(6, 13), I235)
    assert not extension.ops.bda.make_report.poll()  # no folder yet
    extension.context.scene.bda.output_directory = str(folder)
    assert extension.ops.bda.make_report() == {"FINISHED"}
    assert (folder / "report.html").stat().st_size > 0
    assert (folder / "report.pdf").stat().st_size > 0


def test_a_folder_without_results_is_refused_with_a_sentence(extension, tmp_path):
    extension.context.scene.bda.output_directory = str(tmp_path)
    with pytest.raises(RuntimeError, match="holds no run: expected results"):
        extension.ops.bda.make_report()
    assert not list(tmp_path.iterdir())
