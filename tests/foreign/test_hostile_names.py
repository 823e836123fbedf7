# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of a run from someone else: no export takes them for paths, formulas, markup, layers or numbers of its own."""

import csv
import json
import zipfile
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
from scipy.io import loadmat
from support.exported_runs import turning_run, with_ground
from support.long_cases import long_but
from support.run_folders import TOLD, keep_run

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.exports.formats import FORMATS
from bridge_demolition_addon.exports.write import export_run
from bridge_demolition_addon.report.write import write_report

HOSTILE = (
    '=HYPERLINK("http://x.example","a")',
    "../../../escaped",
    "</script><script>alert(1)</script>",
    "a\nSECTION\n0\nEOF",
    "$(touch escaped) `touch escaped` %n\\",
    "@SUM(1+1)*cmd|' /C calc'!A0",
    "Träger \u202e\u200b ½ 桥 \U0001f309",
    "x" * 300,
    "CON",
)


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """The folder of a run of which each body has such a name, and their names."""
    results = with_ground(turning_run(len(HOSTILE) - 1))
    names = np.array(HOSTILE)
    hostile = replace(results, inventory=replace(results.inventory, body_names=names))
    folder = tmp_path_factory.mktemp("hostile")
    return keep_run(folder / "run", hostile, replace(TOLD, title=HOSTILE[2]))


def files_beside(folder):
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}


@pytest.mark.slow
@pytest.mark.parametrize("name", long_but(["paraview", "xlsx", "gltf", "mat"], list(FORMATS)))
def test_an_export_stays_where_it_is_and_keeps_the_names(run, name, tmp_path):
    form = FORMATS[name]
    before = files_beside(run.parent)
    target = tmp_path / "inner" / f"out{form.ending}"
    target.parent.mkdir()
    export_run(run, form, target, Silence())
    assert files_beside(run.parent) == before
    assert [path.name for path in tmp_path.iterdir()] == ["inner"]
    assert [path.name for path in target.parent.iterdir()] == [target.name]
    READ[form.name](target)


def read_workbook(path):
    """No cell is a formula: each is a number or a text."""
    with zipfile.ZipFile(path) as book:
        for name in book.namelist():
            if name.endswith(".xml"):
                assert not any(part.tag.endswith("}f") for part in ElementTree.fromstring(book.read(name)).iter()), name


def read_paraview(folder):
    for path in folder.rglob("*.pvd"):
        for data in ElementTree.parse(path).iter("DataSet"):
            assert (path.parent / data.attrib["file"]).resolve().is_relative_to(folder.resolve())


def read_model(path):
    content = path.read_bytes()
    length = int.from_bytes(content[12:16], "little")
    assert set(HOSTILE[:-1]) <= {node.get("name") for node in json.loads(content[20 : 20 + length])["nodes"]}


def read_stage(path):
    from pxr import Usd

    stage = Usd.Stage.Open(str(path))
    assert sum(prim.GetTypeName() == "Mesh" for prim in stage.Traverse()) == len(HOSTILE)


def read_arrays(path):
    assert len(loadmat(path)["body_names"]) == len(HOSTILE)


def read_nothing(path):
    assert path.stat().st_size > 1000


READ = {
    "xlsx": read_workbook,
    "paraview": read_paraview,
    "gltf": read_model,
    "usd": read_stage,
    "mat": read_arrays,
    "alembic": read_nothing,
}


@pytest.mark.long
def test_a_report_with_its_word_file_plans_and_tables_takes_them_as_texts(run, tmp_path):
    write_report([run], tmp_path / "report", word=True, progress=Silence())
    page = (tmp_path / "report" / "report.html").read_text(encoding="utf-8")
    assert "<script>alert" not in page
    with zipfile.ZipFile(tmp_path / "report" / "report.docx") as word:
        assert ElementTree.fromstring(word.read("word/document.xml")) is not None
    for path in (tmp_path / "report").rglob("*.csv"):
        with path.open(encoding="utf-8", newline="") as file:
            assert not [cell for row in csv.reader(file) for cell in row if cell[:1] in ("=", "@")], path
    for path in (tmp_path / "report").glob("*.geojson"):
        json.loads(path.read_text(encoding="utf-8"))
    for path in (tmp_path / "report").glob("*.dxf"):
        assert path.read_text(encoding="utf-8").rstrip().endswith("EOF")
        assert path.read_text(encoding="utf-8").split("\n").count("EOF") == 1
    assert not list(tmp_path.parent.rglob("escaped"))
