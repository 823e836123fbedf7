# SPDX-License-Identifier: GPL-3.0-or-later
"""Slips that newcomers make are answered by a sentence that says what to write instead, all of a file at once."""

from pathlib import Path

import pytest
from support.checkout import I235_FILE, ROOT
from support.scenarios import I235

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.model.scenario.file import scenario_text

RIGHT = scenario_text(I235)
STUDY = ROOT / "examples" / "studies" / "i235_one_span.toml"


@pytest.fixture
def complaints(tmp_path, monkeypatch, capsys):
    """Returns what a command says of a file with a content, by default `bda check`."""

    def said(content, *command, file="bridge.toml"):
        monkeypatch.chdir(tmp_path)
        Path(file).write_bytes(content if isinstance(content, bytes) else content.encode())
        assert main([*(command or ("check",)), file]) == 2
        printed = capsys.readouterr()
        assert printed.out == ""
        lines = printed.err.splitlines()
        assert all(line.startswith(f"bda: error: {file}: ") for line in lines)
        return [line.removeprefix(f"bda: error: {file}: ") for line in lines]

    return said


def with_value(old, new):
    assert RIGHT.count(old) == 1, old
    return RIGHT.replace(old, new)


def line_of(text):
    return RIGHT[: RIGHT.index(text)].count("\n") + 1


SLIPS = {
    "decimal comma": (
        "thickness_m = 0.25\n",
        "thickness_m = 0,25\n",
        "thickness_m = 0,25 has a decimal comma: write thickness_m = 0.25",
    ),
    "with a comment": (
        "thickness_m = 0.25\n",
        "thickness_m = 0,25 # m\n",
        "thickness_m = 0,25 has a decimal comma: write thickness_m = 0.25",
    ),
    "no blanks": (
        "thickness_m = 0.25\n",
        "thickness_m=0,25\n",
        "thickness_m=0,25 has a decimal comma: write thickness_m=0.25",
    ),
    "in a list": (
        "target_m = [6.5, 0.0]",
        "target_m = [6,5; 0,0]",
        "target_m = [6,5; 0,0] has semicolons between its numbers: write target_m = [6.5, 0.0]",
    ),
    "quotation marks": (
        'type = "HINGE"',
        "type = \u201cHINGE\u201d",
        'type = \u201cHINGE\u201d has typographic quotation marks: write type = "HINGE"',
    ),
    "German quotation marks": (
        'type = "HINGE"',
        "type = \u201eHINGE\u201c  # a hinge",
        'type = \u201eHINGE\u201c has typographic quotation marks: write type = "HINGE"',
    ),
    "no quotation marks": (
        'type = "HINGE"',
        "type = HINGE",
        'type = HINGE is a text without quotation marks: write type = "HINGE"',
    ),
    "text without an end": (
        'type = "HINGE"',
        'type = "HINGE',
        'type = "HINGE has a text without an end: write type = "HINGE"',
    ),
    "colon": ('type = "HINGE"', 'type: "HINGE"', 'type: "HINGE" has a colon: write type = "HINGE"'),
    "unit": (
        "mass_kg = 10000.0",
        "mass_kg = 10 t",
        "mass_kg = 10 t has a unit: write the number alone, in the unit that the name of the key ends in",
    ),
    "gaps": ("mass_kg = 10000.0", "mass_kg = 10 000", "mass_kg = 10 000 has gaps in its number: write mass_kg = 10000"),
    "no digit before the point": (
        "thickness_m = 0.25",
        "thickness_m = .25",
        "thickness_m = .25 has a number without a digit before its point: write thickness_m = 0.25",
    ),
    "no digit after the point": (
        "mass_kg = 10000.0",
        "mass_kg = 10000.",
        "mass_kg = 10000. has a number without a digit after its point: write mass_kg = 10000.0",
    ),
    "begins with 0": ("seed = 235", "seed = 07", "seed = 07 has a number that begins with 0: write seed = 7"),
    "switch": (
        "foundation = true",
        "foundation = True",
        "foundation = True is no true or false: write foundation = true",
    ),
    "no-break space": (
        "thickness_m = 0.25",
        "thickness_m\u00a0= 0.25",
        "thickness_m = 0.25 has spaces, digits or letters that only look like usual ones: write thickness_m = 0.25",
    ),
    "letter that is not seen": (
        "thickness_m = 0.25",
        "thickness_m\u200b = 0.25",
        "thickness_m\u200b = 0.25 has spaces, digits or letters that only look like usual ones: write "
        "thickness_m = 0.25",
    ),
    "digits of full width": (
        "thickness_m = 0.25",
        "thickness_m = 0.\uff12\uff15",
        "thickness_m = 0.\uff12\uff15 has spaces, digits or letters that only look like usual ones: write "
        "thickness_m = 0.25",
    ),
    "heading": ("[ball]", "[ball", "[ball has a heading without an end: write [ball]"),
    "comment": ("[ball]", "// steel\n[ball]", "// steel is no TOML, where a comment begins with #: write # steel"),
}


@pytest.mark.parametrize("old, new, sentence", SLIPS.values(), ids=SLIPS)
def test_a_slip_is_explained_by_what_was_meant(old, new, sentence, complaints):
    assert complaints(with_value(old, new)) == [f"line {line_of(old)}: {sentence}"]


@pytest.mark.parametrize("path", [r"C:\Users\anna\part.stl", r"C:\new\part.stl", r"D:\part.stl"])
def test_a_path_of_windows_is_explained(path, complaints):
    said = complaints(f'{RIGHT}\n[[geometry]]\nname = "part"\ndensity_kg_m3 = 2400\nfile = "{path}"\n')
    number, slashed = RIGHT.count("\n") + 5, path.replace("\\", "/")
    wanted = f'line {number}: file = "{path}" has backslashes within double quotation marks: write file = "{slashed}"'
    assert said == [wanted]


def test_a_table_or_a_key_that_is_there_twice_is_named(complaints):
    number = RIGHT.count("\n") + 2
    assert complaints(f"{RIGHT}\n[ball]\nmass_kg = 1\n") == [
        f"line {number}: [ball] is there a second time: put all of its keys under the first, or write [[ball]] for "
        "each where there may be several"
    ]
    assert complaints(with_value("seed = 235", "seed = 235\nseed = 1")) == [
        f"line {line_of('seed = 235') + 1}: seed = 1 gives a key of its table a second time: leave one of them out"
    ]


FILES = {
    "UTF-16": (
        RIGHT.encode("utf-16"),
        "a text in UTF-16: save it again as UTF-8 (in Notepad, Save As, Encoding): expected a scenario in TOML",
    ),
    "UTF-16 without a mark": (
        RIGHT.encode("utf-16-le"),
        "a text in UTF-16 or UTF-32: save it again as UTF-8 (in Notepad, Save As, Encoding): expected a scenario in "
        "TOML",
    ),
    "UTF-32": (
        RIGHT.encode("utf-32"),
        "a text in UTF-32: save it again as UTF-8 (in Notepad, Save As, Encoding): expected a scenario in TOML",
    ),
    "Latin-1": (
        "title = 'Br\u00fccke'".encode("latin-1"),
        "not a text in UTF-8, at byte 11: save it again as UTF-8: expected a scenario in TOML",
    ),
    "spreadsheet": (
        b"PK\x03\x04\xff",
        "is a spreadsheet, a document or a ZIP file, not a text: expected a scenario in TOML",
    ),
    "PDF": (b"%PDF-1.7\n\xff", "is a PDF, not a text: expected a scenario in TOML"),
    "IFC": (b"ISO-10303-21;\nHEADER;\n", "this is an IFC file: use bda import"),
    "study": (STUDY.read_bytes(), "this is a study: use bda study"),
    "search": (b'[search]\nscenario = "a.toml"\n', "this is a search: use bda search"),
    "optimisation": (b'[optimise]\nscenario = "a.toml"\n', "this is an optimisation: use bda optimise"),
}


@pytest.mark.parametrize("content, sentence", FILES.values(), ids=FILES)
@pytest.mark.parametrize("command", ["check", "run", "stages"])
def test_a_file_of_another_kind_is_recognised(content, sentence, command, complaints):
    assert complaints(content, command) == [sentence]


@pytest.mark.parametrize("command", ["study", "search", "optimise"])
def test_a_scenario_is_recognised_where_it_is_to_be_varied(command, complaints):
    assert complaints(RIGHT, command) == ["this is a scenario: use bda check or bda run"]


def test_tables_by_other_words_are_recognised(complaints):
    more = "\n[explosives]\nplace_m = [6.5, 0.0, 4.0]\nmass_kg = 5\n"
    assert complaints(RIGHT + more) == [
        "explosives is unknown: did you mean charges?",
        "charges is a table: expected tables, each under [[charges]]",
    ]


def test_a_material_that_is_unknown_is_said_with_the_method_that_it_needs(complaints):
    (said,) = complaints(with_value("breaking_force_kgf = 10000.0", 'material = "C30/37"'))
    assert said.startswith(
        'connections.material is "C30/37": expected method "face" with it, found "vertex", and one of "concrete", '
    )


def test_a_mesh_of_another_format_and_a_missing_density_are_said_together(tmp_path, complaints):
    path = (tmp_path / "bridge.dwg").resolve()
    assert complaints(f'{RIGHT}\n[[geometry]]\nname = "part"\nfile = "bridge.dwg"\n') == [
        f'[[geometry]] number 1: geometry.file is "{path}": expected a file that ends in .stl, .obj, .ply or .glb; '
        "export it as one of these",
        "[[geometry]] number 1: geometry has no density_kg_m3 or mass_kg: give one of them",
    ]


def test_all_faults_of_a_file_are_said_at_once_in_the_order_of_its_lines_and_of_the_reference(complaints):
    content = with_value("thickness_m = 0.25\n", "thicknes_m = 0,25\n")
    content = content.replace("mass_kg = 10000.0", "mass_kg = -5").replace("height_m = 4.9", 'height_m = "4.9"')
    content = content.replace('type = "HINGE"', "type = HINGE").replace("[fracture]", "[fracture]\nshard = 3")
    assert complaints(content) == [
        f"line {line_of('thickness_m = 0.25')}: thicknes_m = 0,25 has a decimal comma: write thicknes_m = 0.25",
        f'line {line_of("type = ") + 1}: type = HINGE is a text without quotation marks: write type = "HINGE"',
        "bridge.deck.thicknes_m is unknown: did you mean bridge.deck.thickness_m?",
        'bridge.piers.height_m is "4.9": expected a number from 0.001 to 10000.0 (m)',
        "fracture.shard is unknown: did you mean fracture.shards?",
        "ball.mass_kg is -5: expected a number above 0 (kg)",
    ]


def test_a_file_without_tables_lacks_all_that_is_required(complaints):
    assert complaints("# nothing yet") == [
        "scenario.title is missing: expected a text on one line, not blank",
        "time is missing: expected a table",
        "fracture is missing: expected a table",
        "connections is missing: expected a table",
    ]


def test_faults_of_several_files_are_said_at_once(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("a.toml").write_text(with_value("seed = 235", "seed = -1"), encoding="utf-8")
    Path("b.toml").write_text(with_value("mass_kg = 10000.0", "mass_kg = -1"), encoding="utf-8")
    assert main(["run", "a.toml", "b.toml"]) == 2
    assert capsys.readouterr().err.splitlines() == [
        "bda: error: a.toml: scenario.seed is -1: expected a whole number from 0 to 2147483647",
        "bda: error: b.toml: ball.mass_kg is -1: expected a number above 0 (kg)",
    ]


def test_a_base_with_a_slip_is_named(tmp_path, complaints):
    (tmp_path / "base.toml").write_text(with_value("thickness_m = 0.25\n", "thickness_m = 0,25\n"), encoding="utf-8")
    assert complaints('[scenario]\nbased_on = "base.toml"\n') == [
        f'based on "base.toml": line {line_of("thickness_m = 0.25")}: thickness_m = 0,25 has a decimal comma: '
        "write thickness_m = 0.25"
    ]


@pytest.mark.parametrize("command", [["check", "--stand"], ["stages"]], ids=["check", "stages"])
def test_why_it_is_not_known_how_such_a_bridge_stands_is_said(command, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main([*command, str(I235_FILE)]) == 2
    assert capsys.readouterr().err == (
        f'bda: error: {I235_FILE}: connections.method is "vertex": how the bridge stands can only be worked out with '
        'method = "face", without search_radius_m, and material = "reinforced concrete slab" or another\n'
    )


def test_a_folder_that_is_not_empty_names_the_option(tmp_path, capsys):
    (tmp_path / "mine").touch()
    assert main(["run", str(I235_FILE), "--output", str(tmp_path), "--quiet"]) == 2
    assert capsys.readouterr().err.endswith(
        f"{tmp_path}: exists already, and is not empty: choose another folder, or allow overwriting (--overwrite)\n"
    )


@pytest.mark.parametrize(
    "words, sentence",
    [
        (["chek"], "'chek' is no command: did you mean check?; see bda --help"),
        (
            ["x.toml"],
            "x.toml stands where a command is expected: write bda run x.toml or bda check x.toml; see bda --help",
        ),
        (["run", "x.toml", "--quite"], "unrecognized arguments: --quite: did you mean --quiet?; see bda run --help"),
    ],
)
def test_commands_and_options_that_are_nearest_are_named(words, sentence, capsys):
    assert main(words) == 2
    assert capsys.readouterr().err == f"bda: error: {sentence}\n"


def refused(capsys, *words):
    assert main(list(map(str, words))) == 2
    (line,) = capsys.readouterr().err.splitlines()
    return line.removeprefix("bda: error: ")


@pytest.mark.parametrize(
    ("file", "content", "advice"),
    [
        ("a.ifc", "no IFC", "this is an IFC file: use bda import"),
        ("a.OBJ", "v 0 0 0", "this is a mesh: name it in a scenario, [[geometry]]"),
        ("a.laz", "LASF", "this is ground: name it in a scenario, [ground]"),
        ("a.dwg", "AC1027", "this is not read: export an IFC file, or meshes as OBJ"),
        ("a.toml", " \n", "is empty: expected a scenario in TOML, see examples"),
    ],
)
@pytest.mark.parametrize("command", ["check", "run"])
def test_files_of_other_kinds_are_told_what_to_do(complaints, command, file, content, advice):
    assert complaints(content, command, file=file) == [advice]


def test_a_key_of_another_table_is_answered_by_those_of_its_own(complaints):
    (line,) = complaints(RIGHT.replace("[ground]\n", '[ground]\ngeometry = "a.obj"\n', 1))
    assert line.startswith("ground.geometry is unknown: expected one of file, ")
    assert line.endswith("; [geometry] is a table by itself")


def test_commands_say_what_is_near(tmp_path, capsys):
    study = tmp_path / "study.toml"
    vary = 'key = "bridge.deck.widht_m"\ndistribution = "uniform"\nlowest = 1\nhighest = 2\n'
    study.write_text(f'[study]\nscenario = "{I235_FILE}"\n[[vary]]\n{vary}', encoding="utf-8")
    assert refused(capsys, "study", study, "--check").endswith("is unknown: did you mean bridge.deck.width_m?")
    assert refused(capsys, "charge", "--load", "abc").startswith("unrecognized arguments: --load")
    meant = refused(capsys, "explain", "charge")
    assert "did you mean charges or " in meant and " or blast_zones" in meant


def test_a_new_file_has_the_ending_of_scenarios_and_its_folder_is_named(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert refused(capsys, "new", "no/dir/n.toml") == "no/dir/n.toml: folder no/dir is not there; make it first"
    assert main(["new", "n5", "--spans", "13"]) == 0
    assert capsys.readouterr().out.startswith("n5.toml\n") and [path.name for path in tmp_path.iterdir()] == ["n5.toml"]
