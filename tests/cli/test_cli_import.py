# SPDX-License-Identifier: GPL-3.0-or-later
"""``bda import``: a folder with a scenario that can be checked, or a sentence and nothing."""

import csv

import pytest
from support.ifc_bridges import MASS_KG, SCHEMAS, whole_bridge

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.scenario.file import read_scenario


@pytest.fixture
def path(tmp_path):
    return whole_bridge().written(tmp_path / "bridge.ifc")


@pytest.mark.long
@pytest.mark.parametrize("schema", SCHEMAS)
def test_what_is_imported_can_be_checked(schema, tmp_path, capsys):
    path, folder = whole_bridge(schema=schema).written(tmp_path / "bridge.ifc"), tmp_path / "new" / "bridge"
    assert main(["import", str(path), "--output", str(folder), "--shards", "30"]) == 0
    told = capsys.readouterr().out
    assert told.startswith("Two spans\n")
    _, verdict = told.split(f"\n{folder / 'scenario.toml'}\n")
    assert verdict.startswith("\nThe bridge stands under its own weight, by statics: largest utilisation ")
    assert (folder / "import.txt").read_text() in told
    assert main(["check", str(folder / "scenario.toml")]) == 0
    assert f"{MASS_KG / 1000.0:.3f} t" in capsys.readouterr().out


def test_the_files_hold_what_was_told(path, tmp_path, capsys):
    folder = tmp_path / "bridge"
    assert main(["import", str(path), "--output", str(folder)]) == 0
    said = capsys.readouterr()
    assert said.out.splitlines()[-1].startswith("The bridge stands under its own weight")
    assert said.err.splitlines()[0] == "reading bridge.ifc" and "whether it stands" in said.err.splitlines()[-1]
    scenario = read_scenario(folder / "scenario.toml")
    members = prepared_members(scenario).members
    assert sum(member.mass_kg for member in members) == pytest.approx(MASS_KG, rel=1e-6)
    with (folder / "elements.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert sum(float(row["mass_kg"]) for row in rows if row["mass_kg"]) == pytest.approx(MASS_KG, rel=1e-5)
    assert {row["element"]: row["became"] for row in rows if row["became"] != "member"} == {
        **{f"Bearing {number} {side}": "connection" for number in (1, 2, 3) for side in ("right", "left")},
        **dict.fromkeys(("Railing", "Tendon", "Bar", "Pile 1", "Pile 2"), "left out"),
    }
    assert len(list((folder / "members").iterdir())) == len(scenario.geometry) == 16


@pytest.mark.long
def test_bearings_are_listed_and_long_names_keep_off_what_follows(path, tmp_path, capsys):
    folder = tmp_path / "bridge"
    assert main(["import", str(path), "--output", str(folder)]) == 0
    listed = [line.split(maxsplit=1) for line in (folder / "import.txt").read_text().splitlines() if line.strip()]
    bearings = {words[1] for words in listed if words[0] == "bearing"}
    scenario = read_scenario(folder / "scenario.toml")
    assert len(bearings) == 6
    assert bearings == {f"{' on '.join(table.members)}: {table.described}" for table in scenario.bearings}

    text = (folder / "scenario.toml").read_text(encoding="utf-8")
    longer = text.replace('"Carriageway"', '"Carriageway between both abutments"')
    assert longer != text
    (folder / "scenario.toml").write_text(longer, encoding="utf-8")
    capsys.readouterr()
    assert main(["check", str(folder / "scenario.toml")]) == 0
    assert "  Carriageway between both abutments  " in capsys.readouterr().out


@pytest.mark.long
def test_the_same_file_gives_the_same_folder(path, tmp_path):
    folders = [tmp_path / "one", tmp_path / "other"]
    for folder in folders:
        assert main(["import", str(path), "--output", str(folder)]) == 0
    one, other = ({path.name: path.read_bytes() for path in folder.rglob("*.*")} for folder in folders)
    assert one == other


def test_all_that_can_be_told(path, tmp_path, capsys):
    table, folder = tmp_path / "materials.toml", tmp_path / "bridge"
    assert main(["import", "--write-materials", str(table)]) == 0
    assert capsys.readouterr().out == f"{table}\n"
    table.write_text(table.read_text().replace("2550.0", "2500.0"))
    told = [
        "--materials",
        str(table),
        "--unit",
        "m",
        "--ground",
        "0.5",
        "--without",
        "Footing*",
        "--kind",
        "IfcPile=pier",
        "--material-of",
        "Carriageway=steel",
    ]
    assert main(["import", str(path), "--output", str(folder), "--material", "concrete", *told]) == 0
    kinds = {mesh.name: (mesh.kind, mesh.density_kg_m3) for mesh in read_scenario(folder / "scenario.toml").geometry}
    assert kinds["Column"] == ("pier", 2500.0)
    assert kinds["Carriageway"] == ("deck", 7850.0)
    assert not any(name.startswith("Footing") for name in kinds)
    assert "ground                  at 0.500 m in the file: as given by --ground" in capsys.readouterr().out


@pytest.mark.parametrize(
    "arguments, message",
    [
        ([], "bda import needs an IFC file, or --write-materials FILE; see bda import --help"),
        (["{path}", "--output", "{folder}", "--unit", "miles"], "invalid choice: 'miles'"),
        (["{path}", "--output", "{folder}", "--kind", "Pier=dock"], "expected NAME=KIND, with one of deck, girder"),
        (["{path}", "--output", "{folder}", "--shards", "0"], "expected a whole number from 1"),
        (["{path}", "--output", "{folder}", "--shards", "many"], "'many'"),
        (["{path}", "--output", "{folder}", "--ground", "nan"], "expected a height in m"),
        (["{path}", "--output", "{folder}", "--without", "Arch"], 'has no element "Arch"'),
        (["{path}", "--output", "{folder}", "--materials", "none.toml"], "none.toml: no such file"),
        (["{path}", "--output", "{here}"], "exists already; give another folder"),
        (["{path}", "--output", "{path}"], "exists already; give another folder"),
    ],
)
def test_what_is_wrong_is_said_and_nothing_is_written(arguments, message, path, tmp_path, capsys):
    names = {"path": path, "folder": tmp_path / "bridge", "here": tmp_path}
    assert main(["import", *(argument.format(**names) for argument in arguments)]) == 2
    assert message in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.long
def test_a_member_that_cannot_be_used_is_refused_and_nothing_is_written(tmp_path, capsys):
    """The same girder twice: what the second has in common with the first is all of it."""
    made = whole_bridge()
    made.box("IfcBeam", "Double", (21.0, 0.4, 0.8), (10.0, 1.0, 3.6), "DECK", material=made.material("Steel"))
    path = made.written(tmp_path / "bridge.ifc")
    assert main(["import", str(path), "--output", str(tmp_path / "bridge"), "--strict"]) == 2
    said = capsys.readouterr().err
    assert "Double" in said
    assert "--without" in said
    assert list(tmp_path.iterdir()) == [path]
    assert main(["import", str(path), "--output", str(tmp_path / "bridge")]) == 0
    assert "Girder left takes all of its room; 52.752 t are missing" in capsys.readouterr().out  # 21 × 0.4 × 0.8 × 7.85
