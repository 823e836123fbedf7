# SPDX-License-Identifier: GPL-3.0-or-later
"""The functions for Python do what their examples, docs/python.md and docs/results.md say, with one run for it all."""

import doctest
import inspect
import json
import re
import shutil
import subprocess
import sys

import numpy as np
import pytest
from support.checkout import ROOT

import bridge_demolition_addon as interface
from bridge_demolition_addon.engineering.units import name_and_unit
from bridge_demolition_addon.errors import DemolitionError
from bridge_demolition_addon.model.results.checks import check_arrays

PAGE = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")
DOCUMENT = (ROOT / "docs" / "results.md").read_text(encoding="utf-8")
NOTEBOOK = ROOT / "docs" / "results.ipynb"
KINDS = {"text": "U", "whole": "i", "true or false": "b", "single": "f4", "double": "f8"}
ONLY_ON_GROUND = {"triangles", "triangle_counts"}
ONLY_WITH_BARS = {"body_bar_use"}
ONLY_WHERE_ASKED = {
    "contact_frames",
    "contact_bodies",
    "contact_places_m",
    "contact_normals",
    "contact_normal_impulses_ns",
    "contact_friction_impulses_ns",
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Where the examples are tried, as if it were the project's."""
    folder = tmp_path_factory.mktemp("tried")
    (folder / "docs").mkdir()
    for name in ("small_bridge.toml", "small_study.toml"):
        shutil.copy(ROOT / "docs" / name, folder / "docs")
    return folder


@pytest.fixture(scope="module")
def tried(folder):
    """What came of the examples in the docstrings, and the run that they made."""
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        runner = doctest.DocTestRunner()
        # In the order of their lines, as some look at what those before them made.
        for example in sorted(doctest.DocTestFinder().find(interface), key=lambda example: example.lineno or 0):
            runner.run(example)
    return runner.summarize(), interface.load_results(folder / "my_results")


def told_arrays():
    """The rows of the table of arrays: shape, unit and kind by name."""
    rows = re.findall(r"^\| `(\w+)` \|([^|]*)\|([^|]*)\|([^|]*)\|", DOCUMENT.partition("## All arrays")[2], flags=re.M)
    return {name: tuple(cell.strip() for cell in cells) for name, *cells in rows}


@pytest.mark.long
def test_the_examples_in_the_docstrings_come_out_as_they_say(tried):
    outcome, _ = tried
    assert outcome.attempted >= 20
    assert outcome.failed == 0


@pytest.mark.long
def test_the_job_of_the_page_runs(tried, folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)
    (job,) = re.findall(r"^```python\n(.*?)^```", PAGE, flags=re.S | re.M)
    exec(job, found := {})
    said = capsys.readouterr().out
    assert "shards lie elsewhere" in said and "far too few for a plan" in said
    assert found["page"].is_file() and (folder / "heavier_plan.png").stat().st_size > 10_000
    assert found["stated"].reach.runs == 2


def test_the_page_lists_all_functions_with_their_arguments():
    rows = re.findall(r"^\| `(\w+)\((.*?)\)` \|", PAGE, flags=re.M)
    functions = [name for name in interface.__all__ if inspect.isfunction(getattr(interface, name))]
    assert sorted(name for name, _ in rows) == sorted(functions)
    for name, arguments in rows:
        parameters = inspect.signature(getattr(interface, name)).parameters.values()
        told = [f"{one.name}={one.default!r}" if one.default is not one.empty else one.name for one in parameters]
        assert ", ".join(told).replace("'", '"') == arguments


@pytest.mark.long
@pytest.mark.parametrize(
    "wrong", [lambda: interface.export("my_results", "dwg"), lambda: interface.run_study("no", "x")]
)
def test_what_is_wrong_is_a_sentence(wrong, tried, folder, monkeypatch):
    monkeypatch.chdir(folder)
    with pytest.raises(DemolitionError, match=r"to is 'dwg': expected one of|no: no such file: expected a study"):
        wrong()


@pytest.mark.long
def test_every_array_has_the_shape_and_kind_that_the_table_says(tried):
    _, results = tried
    arrays, told, lengths = results.arrays(), told_arrays(), {}
    assert set(told) == set(arrays) | ONLY_ON_GROUND | ONLY_WHERE_ASKED | ONLY_WITH_BARS
    for name, values in arrays.items():
        shape, _, kind = told[name]
        letters, values = shape.split(", ") if shape else [], np.asarray(values)
        assert len(letters) == values.ndim, name
        for letter, length in zip(letters, values.shape, strict=True):
            assert length == (int(letter) if letter.isdigit() else lengths.setdefault(letter, length)), name
        assert values.dtype.str.lstrip("<>|=").startswith(KINDS[kind]), name
    assert len(set(lengths.values())) == len(lengths)  # or one letter could stand for another


def test_arrays_on_the_ground_are_those_that_are_checked(tried):
    arrays = {name: np.asarray(values) for name, values in tried[1].arrays().items()}
    counts = np.zeros(len(arrays["body_names"]), int)
    for shape, wanted in (((0, 3), True), ((0, 2), False)):
        more = {"triangles": np.zeros(shape, int), "triangle_counts": counts}
        if wanted:
            check_arrays(arrays | more)
        else:
            with pytest.raises(DemolitionError, match="triangles"):
                check_arrays(arrays | more)


def test_units_are_those_that_the_names_say():
    for name, (_, unit, _) in told_arrays().items():
        assert name_and_unit(name)[1] == unit.replace("1", "")


@pytest.mark.parametrize("number", [0, 1])
def test_three_lines_read_a_run(tried, folder, monkeypatch, number):
    monkeypatch.chdir(folder)
    lines = re.findall(r"^```python\n(.*?)^```", DOCUMENT, flags=re.S | re.M)[number]
    assert len(lines.split("\n\n")) == 2 and len(lines.replace("\n\n", "\n").splitlines()) == 3
    found = {}
    exec(lines, found)
    assert np.array_equal(found["places_m"], tried[1].frames.positions_m[-1])


def test_nothing_is_loaded_before_it_is_needed_whatever_the_package_is_called(tmp_path):
    (tmp_path / "another_name").symlink_to(ROOT / "bridge_demolition_addon")
    program = (
        "import sys, another_name\n"
        "before = {'bpy', 'numpy', 'bridge_demolition_addon'} & set(sys.modules)\n"
        f"scenario = another_name.read_scenario({str(ROOT / 'docs' / 'small_bridge.toml')!r})\n"
        "print(before, scenario.ball.mass_kg, 'bpy' in sys.modules, 'bridge_demolition_addon' in sys.modules)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True, encoding="utf-8", check=True
    )
    assert done.stdout.split() == ["set()", "5000.0", "False", "False"]


def test_what_is_no_run_is_a_sentence(tmp_path):
    with pytest.raises(DemolitionError, match="expected the results of a run"):
        interface.load_results(tmp_path)


@pytest.mark.long
def test_the_notebook_runs_from_its_first_cell_to_its_last(folder):
    import nbformat
    from nbclient import NotebookClient

    shutil.copy(ROOT / "docs" / "small_bridge.toml", folder)
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    NotebookClient(notebook, timeout=None, resources={"metadata": {"path": str(folder)}}).execute()
    shown = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    assert sum("image/png" in output.get("data", {}) for output in shown) == 2
    assert any("connections broke" in output.get("text", "") for output in shown)


def test_the_notebook_is_kept_without_what_came_out():
    kept = json.loads(NOTEBOOK.read_text(encoding="utf-8"))
    code = [cell for cell in kept["cells"] if cell["cell_type"] == "code"]
    assert all(cell["outputs"] == [] and cell["execution_count"] is None for cell in code)
