# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of a section: the areas in a drawing by shapely, the parts of a picture, and what is refused."""

import re
import xml.etree.ElementTree as ElementTree

import pytest
from shapely.geometry import Polygon
from support.run_folders import keep_run
from support.sample_results import hanging_chain

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.exports.section_drawings import dxf_text, new_section_file, write_section
from bridge_demolition_addon.model.debris.pile_sections import Direction, pile_section


@pytest.fixture
def section():
    """Through the shard that fell: 0.7071 m wide about y = 4, 4 m high from the ground on."""
    return pile_section(hanging_chain(), Direction.ACROSS, 3.1)


@pytest.fixture
def run(tmp_path):
    return keep_run(tmp_path / "run", hanging_chain())


def polylines(text):
    """Corners of the polylines of a drawing, by layer."""
    lines = text.splitlines()
    pairs = list(zip(map(int, lines[::2]), lines[1::2], strict=True))
    found, corner = [], None
    for code, value in pairs:
        if code == 0:
            corner = value == "VERTEX"
            if value == "POLYLINE":
                found.append([None, []])
        elif code == 8 and found and not found[-1][1]:
            found[-1][0] = value
        elif corner and code == 10:
            found[-1][1].append([float(value)])
        elif corner and code == 20:
            found[-1][1][-1].append(float(value))
    return found


def test_a_drawing_holds_the_outline_in_metres(section):
    text = dxf_text(section)
    (_, debris), (_, ground) = polylines(text)
    assert [layer for layer, _ in polylines(text)] == ["DEBRIS", "GROUND"]
    assert Polygon(debris).area == pytest.approx(4.0 * 0.5**0.5, abs=1e-3)
    assert Polygon(debris).bounds == pytest.approx((4.0 - 0.5**1.5, 0.0, 4.0 + 0.5**1.5, 4.0), abs=1e-4)
    assert {height for _, height in ground} == {0.0}
    assert "AC1009" in text and text.endswith("0\nEOF\n")
    assert text.count("\nSECTION\n") == text.count("\nENDSEC\n")


def test_a_picture_says_the_figures(section, tmp_path):
    write_section(section, tmp_path / "cut.svg")
    root = ElementTree.parse(tmp_path / "cut.svg").getroot()
    assert root.tag.endswith("svg")
    comments = "".join(re.findall(r"<!--(.*?)-->", (tmp_path / "cut.svg").read_text(encoding="utf-8")))
    assert "debris: 2.83 m², 0.71 m wide, 4.00 m above the ground" in comments
    assert "height (m)" in comments and "standing" not in comments
    for ending in (".png", ".pdf"):
        write_section(section, tmp_path / f"cut{ending}")
        assert (tmp_path / f"cut{ending}").stat().st_size > 1000


def test_nothing_is_written_over_and_a_plane_beside_the_bridge_is_refused(section, tmp_path):
    (tmp_path / "cut.dxf").write_text("mine")
    with pytest.raises(OutputError, match="is there already"):
        write_section(section, tmp_path / "cut.dxf")
    assert (tmp_path / "cut.dxf").read_text() == "mine"
    with pytest.raises(OutputError, match=r"ends in \.svg"):
        write_section(section, tmp_path / "cut.txt")
    with pytest.raises(OutputError, match="at 90 m: cuts no shard"):
        write_section(pile_section(hanging_chain(), Direction.ACROSS, 90.0), tmp_path / "far.dxf")
    assert [path.name for path in tmp_path.iterdir()] == ["cut.dxf"]


def test_names_are_counted_up(section, tmp_path):
    assert new_section_file(tmp_path, section, ".svg").name == "section_across_3.1m.svg"
    (tmp_path / "section_across_3.1m.svg").touch()
    assert new_section_file(tmp_path, section, ".svg").name == "section_across_3.1m_2.svg"


def test_the_command_says_figures_and_files(run, capsys):
    assert main(["section", str(run), "--across", "3.1"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split("  ")[-1].strip() for line in lines[:3]] == ["2.83 m²", "0.71 m", "4.00 m"]
    assert lines[4:] == [str(run / "section_across_3.1m.svg"), str(run / "section_across_3.1m.dxf")]
    assert main(["section", str(run), "--along", "4", "--output", str(run / "mine.dxf"), "--quiet"]) == 0
    assert capsys.readouterr().out == "" and (run / "mine.dxf").exists()


def test_the_command_refuses_what_is_wrong(run, tmp_path, capsys):
    for words, fault in (
        ([str(run), "--across", "far"], "'far' is wrong: expected a number of metres"),
        ([str(run)], "one of the arguments --across --along is required"),
        ([str(run), "--across", "99"], "cuts no shard"),
        ([str(tmp_path / "none"), "--across", "1"], "expected the results of a run"),
    ):
        assert main(["section", *words]) == 2
        assert fault in capsys.readouterr().err
