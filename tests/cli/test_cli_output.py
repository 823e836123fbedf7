# SPDX-License-Identifier: GPL-3.0-or-later
"""Where no --output is given, results go to a new folder that is named after the scenario, as in the window."""

from pathlib import Path

import pytest
from support.checkout import ROOT, SMALL

from bridge_demolition_addon.cli.ensemble import folder_beside
from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.exports.formats import GLTF, new_export
from bridge_demolition_addon.ifc.folder import folder_beside as folder_beside_ifc
from bridge_demolition_addon.model.run_folder.folder import numbered_folder


def test_a_run_goes_to_a_folder_that_is_counted_up(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    for number in (1, 2):
        assert main(["run", str(SMALL), "--no-pictures"]) == 0
        folder = f"Small_bridge_wrecking_ball_{number}"
        assert str(Path(folder) / "summary.json") in capsys.readouterr().out.splitlines()
        assert (tmp_path / folder / "results.npz").is_file()


def test_names_have_no_letters_that_a_folder_cannot_have(tmp_path):
    assert numbered_folder(tmp_path, "A/B: ball") == tmp_path / "A_B_ball_1"
    (tmp_path / "a_b_BALL_7").mkdir()
    assert numbered_folder(tmp_path, "A/B: ball") == tmp_path / "A_B_ball_8"


def test_a_study_has_one_folder_so_that_the_same_command_goes_on():
    file = ROOT / "examples" / "studies" / "i235_one_span.toml"
    assert folder_beside(file, "study") == folder_beside(file, "study") == Path("i235_one_span_study")


@pytest.mark.parametrize("number, name", [(0, "export.glb"), (1, "export_2.glb")])
def test_exports_go_beside_the_run(tmp_path, number, name):
    for earlier in ("export.glb", "export_2.glb")[:number]:
        (tmp_path / earlier).touch()
    assert new_export(tmp_path, GLTF) == tmp_path / name


def test_an_imported_bridge_goes_beside_its_file(tmp_path):
    assert folder_beside_ifc(tmp_path / "mill.ifc") == tmp_path / "mill_scenario"
    (tmp_path / "mill_scenario").mkdir()
    assert folder_beside_ifc(tmp_path / "mill.ifc") == tmp_path / "mill_scenario_2"
