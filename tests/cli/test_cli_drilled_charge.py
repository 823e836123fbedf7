# SPDX-License-Identifier: GPL-3.0-or-later
"""``bda charge --zone-m``: grams a hole from a specific charge and back, rules, warnings, and wrong input."""

import re

import pytest

from bridge_demolition_addon.cli.main import main

ZONE = ("--zone-m", "0.7", "0.7", "1.5")
HOLES = ("--holes-a-row", "5", "--spacing-m", "0.3", "--depth-m", "0.45", "--stemming-m", "0.25")
EMULSION = ("--explosive", "emulsion")


def printed(capsys, *arguments):
    assert main(["charge", *arguments]) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    return captured.out


def fact(text, name):
    return re.search(rf"^{name} +(.*)", text, re.MULTILINE)[1]


def test_grams_a_hole_from_a_specific_charge_and_back(capsys):
    """The worked example: 0.735 m³ with 1 kg/m³ in 10 holes are 73.5 g in each."""
    forth = printed(capsys, *ZONE, *HOLES, *EMULSION, "--specific-kg-m3", "1")
    assert fact(forth, "charge") == "73.5 g in each hole, 0.735 kg"
    assert fact(forth, "specific charge") == "1.00 kg/m³: thrown out"
    back = printed(capsys, *ZONE, *HOLES, *EMULSION, "--charge-g", "73.5")
    assert back == forth


def test_a_structure_of_six_columns(capsys):
    text = printed(capsys, *ZONE, *HOLES, *EMULSION, "--charge-g", "73.5", "--zones", "6", "--structure-t", "196")
    assert fact(text, "all zones") == "4.41 kg in 60 holes"
    assert fact(text, "by mass") == "22.5 g/t; recorded jobs have 3 to 18"


def test_rules_stand_where_nothing_is_given(capsys):
    text = printed(capsys, "--zone-m", "0.6", "0.6", "1.2", "--charge-g", "60")
    # One row in the middle: burden 0.3 m; 0.3 to 0.54 m apart, the middle of which is 0.42; two of these fit.
    assert fact(text, "by rule") == "a row, 0.3 to 0.54 m apart, 0.4 m deep, 0.3 m of stemming at least"
    assert fact(text, "holes").startswith("2 in a row, 38 mm, 0.42 m apart, 0.4 m deep, 0.3 m of stemming")
    assert fact(text, "explosive") == "gelatine, 1450 kg/m³, strength 120"


def test_bars_that_stay(capsys):
    bars = ("--bars", "8", "--bar-diameter-mm", "25")
    text = printed(capsys, "--zone-m", "0.7", "0.7", "0.9", "--charge-g", "60", *bars)
    assert fact(text, "bars") == (
        "1.96 MN in tension and 0.90 MN in compression by EN 1993-1-1, curve c; 1.50 MN if straight, as in a run"
    )
    assert fact(text, "  height by rule").startswith("2.55 m")
    assert "bars of 25 mm bared" not in text
    short = printed(capsys, "--zone-m", "0.7", "0.7", "0.7", "--charge-g", "60", *bars)
    # 28 diameters: λ 0.891, χ 0.605.
    assert (
        "bared over 0.70 m resist 61% of their yield force, and all of it if they are straight: from 0.79 m on" in short
    )


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (("--stemming-m", "0.1"), "stemming of 0.1 m is less than the burden, 0.175 m"),
        (("--depth-m", "0.6"), "holes are 0.86 of the thickness deep"),
        (("--charge-g", "5"), "0.08 kg/m³ are outside half to twice the table, 0.22 to 2.00"),
        (("--structure-t", "0.5"), "g/t are outside 1 to 90, which all recorded jobs are within"),
    ],
)
def test_warnings(capsys, arguments, text):
    given = dict(zip(arguments[::2], arguments[1::2], strict=True))
    values = {"--charge-g": "73.5"} | given
    flat = [part for pair in values.items() for part in pair]
    out = printed(capsys, *ZONE, *flat)
    assert any(text in line for line in out.splitlines() if line.startswith("look at"))


def test_distances_have_the_values_of_the_formulas(capsys):
    text = printed(capsys, *ZONE, *HOLES, *EMULSION, "--charge-g", "73.5")
    # √0.735 = 0.857; (50 / 0.857)^-1.6 × 1140 = 1.70 mm/s. 0.735^(1/3) = 0.902; 20 kPa × (55.4)^-1.45 = 59 Pa, 129 dB.
    assert re.search(r"^  50 m +1.7 mm/s +129 dB$", text, re.MULTILINE)
    assert "no safety distance" in text and "a licensed blaster" in text


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ((*ZONE,), "--zone-m is given: expected --specific-kg-m3 or --charge-g with it"),
        (("--mass-kg", "3", "--rows", "2"), "--rows is given: expected --zone-m with it"),
        ((*ZONE, "--charge-g", "70", "--explosive", "C-4"), "--explosive is C-4: expected one of gelatine, emulsion"),
        (("--mass-kg", "3", "--explosive", "emulsion"), "--explosive: explosive is 'emulsion': expected one of TNT"),
        ((*ZONE, "--charge-g", "70", "--bars", "8"), "--bars is 8: expected --bar-diameter-mm with it"),
        (
            (*ZONE, *HOLES, *EMULSION, "--charge-g", "300"),
            "each hole would have 300.0 g: expected at most 272.2 g of emulsion, which it holds in 0.2 m",
        ),
        ((*ZONE, "--charge-g", "70", "--stemming-m", "0.5"), "stemming is 0.5 m: expected less than the depth of"),
        ((*ZONE, "--charge-g", "70", "--overpressure-kpa", "3"), "--overpressure-kpa is 3: expected --distance-m"),
    ],
)
def test_wrong_input_is_refused_in_one_sentence(capsys, arguments, text):
    assert main(["charge", *arguments]) != 0
    captured = capsys.readouterr()
    assert text in captured.err and captured.err.count("\n") == 1
    assert captured.out == ""
