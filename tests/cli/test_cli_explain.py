# SPDX-License-Identifier: GPL-3.0-or-later
"""``bda explain`` says of a key what the references in the documents say."""

import re

import pytest
from support.checkout import ROOT

from bridge_demolition_addon.cli.main import main

PAGES = ("scenario.md", "study_file.md", "search_file.md", "optimise_file.md")


def explained(capsys, name):
    assert main(["explain", name]) == 0
    return capsys.readouterr().out


def test_a_key_is_explained_in_three_lines(capsys):
    assert explained(capsys, "charges.delay_ms") == (
        "charges.delay_ms: 0 to 1000000 (ms); by default 0.0\n  Time from blast.start_s to its detonation.\n"
    )


@pytest.mark.parametrize("name", ["ball.target_m.1", "[ball].target_m", "ball.target_m"])
def test_numbers_of_elements_and_brackets_are_left_out(capsys, name):
    assert explained(capsys, name.replace("]", "")).startswith("ball.target_m: 2 numbers (m)")


def test_a_table_is_explained_with_its_keys(capsys):
    said = explained(capsys, "[[charges]]")
    assert said.startswith("[[charges]], as often as needed\n  A bare charge.")
    assert "\n  position_m: 3 numbers, -10000 to 10000 (m); required\n" in said


def test_a_name_of_several_keys_explains_all_of_them(capsys):
    said = explained(capsys, "mass_kg")
    for name in ("ball.mass_kg", "bridge.mass_kg", "charges.mass_kg", "equipment.mass_kg"):
        assert f"{name}: " in said


@pytest.mark.parametrize("page", PAGES)
def test_every_key_of_the_references_is_explained_by_the_same_words(page, capsys):
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    sections = re.split(r"^## \[+([\w.]+)\]+$", text, flags=re.M)[1:]
    rows = [
        (f"{table}.{key}", value, meaning)
        for table, section in zip(sections[::2], sections[1::2], strict=True)
        for key, value, _, meaning in re.findall(r"^\| `(\w+)` \| (.*?) \| (.*?) \| (.*) \|$", section, flags=re.M)
    ]
    assert len(rows) > 10
    for name, value, meaning in rows[:: max(1, len(rows) // 25)]:
        said = " ".join(explained(capsys, name).split())
        assert f"{name}: {value};" in said
        assert " ".join(meaning.replace("`", "").split()) in said


@pytest.mark.parametrize(
    "name, sentence",
    [
        ("ball.masskg", "ball.masskg is no key or table of a file: did you mean ball.mass_kg or "),
        ("charge", "charge is no key or table of a file: did you mean charges"),
        ("zzz", "zzz is no key or table of a file: docs/scenario.md lists all of a scenario"),
    ],
)
def test_an_unknown_key_is_answered_with_the_nearest(capsys, name, sentence):
    assert main(["explain", name]) == 2
    assert capsys.readouterr().err.startswith(f"bda: error: {sentence}")
