# SPDX-License-Identifier: GPL-3.0-or-later
"""An import in a process of its own: what crashes or takes too long is left out by its name, and the rest is there.

The crash is that of a file of PGSuper, whose railing ends any process that works it out; here a program on the path
stands for the library and does the same.
"""

import json
import os
import subprocess

import pytest
from support.ifc_bridges import CONCRETE_KG_M3, MASS_KG, STEEL_KG_M3, VOLUMES_M3, whole_bridge

from bridge_demolition_addon.errors import IfcError, OutputError
from bridge_demolition_addon.ifc.import_process import MARK, import_bridge
from bridge_demolition_addon.ifc.settings import ImportSettings
from bridge_demolition_addon.system.programs import program_command
from bridge_demolition_addon.system.progress import Progress

CRASHING = """
import os, signal, sys, time
import ifcopenshell.geom as geom

work_out = geom.create_shape

def create_shape(settings, entity, *more):
    print("face loop edge", flush=True)
    if entity.Name == "Girder left":
        {what}
    return work_out(settings, entity, *more)

geom.create_shape = create_shape
"""


@pytest.fixture
def path(tmp_path):
    return whole_bridge().written(tmp_path / "bridge.ifc")


@pytest.fixture
def library_that(tmp_path, monkeypatch):
    """Have programs that are started load IfcOpenShell with a `create_shape` that does something to Girder left."""

    def does(what):
        folder = tmp_path / "path"
        folder.mkdir()
        (folder / "sitecustomize.py").write_text(CRASHING.format(what=what))
        monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(folder), os.environ.get("PYTHONPATH", "")]))

    return does


class Titles(Progress):
    """Keeps what it is told."""

    def __init__(self):
        self.parts = []

    def part(self, done, total, text):
        self.parts.append((done, total, text))


def test_no_element_pays_for_what_is_done_with_all_of_them(path, tmp_path):
    """Each has a time of its own; members are put together after the last, which is left out for nothing of that."""
    settings = ImportSettings(shards=20).as_json()
    request = {"path": str(path), "settings": settings, "is_listing": False, "folder": str(tmp_path / "made")}
    request |= {"kept": str(tmp_path), "failed": {}}
    command = program_command("ifc.import_program", with_libraries=True)
    done = subprocess.run(command, input=json.dumps(request) + "\n", capture_output=True, text=True, check=True)
    said = [json.loads(line.removeprefix(MARK)) for line in done.stdout.splitlines() if line.startswith(MARK)]
    last = max(row for row, message in enumerate(said) if "element" in message)
    assert [set(message) for message in said[last + 1 :]] == [{"stage"}] * 5 + [{"done"}]
    assert [message["stage"] for message in said[last + 1 : -1]] == [
        None,
        "closing gaps between members",
        "looking for what nothing holds",
        "cutting off where members lie in each other",
        "writing the scenario",
    ]


@pytest.mark.long
@pytest.mark.parametrize(
    ("what", "why"),
    [
        ("os.kill(os.getpid(), signal.SIGSEGV)", "its geometry crashed its reader (SIGSEGV)"),
        ("os._exit(7)", "its geometry crashed its reader (status 7)"),
        ("time.sleep(60)", "its geometry took longer than 0.5 s"),
    ],
)
def test_an_element_that_ends_its_reader_is_left_out(what, why, path, library_that, tmp_path, capfd):
    library_that(what)
    imported = import_bridge(path, tmp_path / "made", ImportSettings(time_limit_s=0.5))
    assert f"{why}; its mass is not known, and missing" in "\n".join(imported.lines)
    assert imported.left_out == 9  # that girder, its three bearings, and five that carry nothing
    left_kg = MASS_KG - 0.5 * VOLUMES_M3["girder"] * STEEL_KG_M3 - 3 * 0.4 * 0.4 * 0.1 * CONCRETE_KG_M3
    rows = (tmp_path / "made" / "elements.csv").read_text(encoding="utf-8").splitlines()[1:]
    masses = [float(row.split(",")[9]) for row in rows if ",member," in row or ",connection," in row]
    assert sum(masses) == pytest.approx(left_kg, rel=1e-4)
    assert capfd.readouterr().out == ""


@pytest.mark.long
def test_progress_names_elements_and_a_stop_ends_the_process(path, tmp_path):
    progress = Titles()
    import_bridge(path, tmp_path / "made", ImportSettings(), progress)
    assert {total for _, total, _ in progress.parts} == {16}
    assert any("Crosshead (IfcBeam #" in text for _, _, text in progress.parts)

    class Stopped(BaseException):
        pass

    class Stopping(Progress):
        def part(self, done, total, text):
            raise Stopped

    with pytest.raises(Stopped):
        import_bridge(path, tmp_path / "other", ImportSettings(), Stopping())
    assert not (tmp_path / "other").exists()


def test_an_import_can_be_stopped_while_its_file_is_opened(path, tmp_path):
    """The process says nothing between two stages; without a call in between a window would stand still."""

    class Stopped(BaseException):
        pass

    class Stopping(Progress):
        def wait(self):
            raise Stopped

    with pytest.raises(Stopped):
        import_bridge(path, tmp_path / "made", ImportSettings(), Stopping())
    assert not (tmp_path / "made").exists()


def test_refusals_and_what_is_there_already(path, tmp_path):
    with pytest.raises(IfcError, match="no such file"):
        import_bridge(tmp_path / "none.ifc", tmp_path / "made", ImportSettings())
    (tmp_path / "taken").write_text("")
    with pytest.raises(OutputError, match="exists already"):
        import_bridge(path, tmp_path / "taken", ImportSettings())


def test_settings_go_through_json(tmp_path):
    settings = ImportSettings(
        materials=tmp_path / "m.toml", without=("A",), kinds=(("B", "deck"),), only="C", strict=True
    )
    assert ImportSettings.from_json(settings.as_json()) == settings
