# SPDX-License-Identifier: GPL-3.0-or-later
"""``bda charge``: what it prints is what the wave gives, and wrong input is refused in one line."""

import re

import pytest

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.engineering.blast.pulses import blast_wave
from bridge_demolition_addon.model.blast.receptors import THRESHOLDS


def printed(capsys, *arguments):
    assert main(["charge", *arguments]) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    return captured.out


def fact(text, name):
    return re.search(rf"^{name} +(\S+)", text, re.MULTILINE)[1]


def test_smallest_charge_for_an_overpressure(capsys):
    text = printed(capsys, "--distance-m", "10", "--overpressure-kpa", "100")
    charge = float(fact(text, "smallest charge"))
    # Four digits are printed.
    assert blast_wave(10.0, charge).peak_overpressure_pa == pytest.approx(100e3, rel=1e-3)
    assert fact(text, "peak overpressure") == "100"
    assert "kg of TNT" in text
    assert "kingery-bulmash, air burst" in text
    assert "in TNT" not in text


def test_smallest_charge_for_an_impulse(capsys):
    text = printed(capsys, "--distance-m", "10", "--impulse-kpa-ms", "500", "--burst", "surface")
    charge = float(fact(text, "smallest charge"))
    assert blast_wave(10.0, charge, "surface").incident_impulse_pa_s == pytest.approx(500.0, rel=1e-3)
    assert fact(text, "impulse") == "500"


@pytest.mark.parametrize("load, worth", [("--overpressure-kpa", 1.37), ("--impulse-kpa-ms", 1.19)])
def test_other_explosives_by_pressure_or_by_impulse(capsys, load, worth):
    tnt = float(fact(printed(capsys, "--distance-m", "10", load, "200"), "smallest charge"))
    text = printed(capsys, "--distance-m", "10", load, "200", "--explosive", "c-4")
    assert float(fact(text, "smallest charge")) == pytest.approx(tnt / worth, rel=1e-3)
    assert float(fact(text, "in TNT")) == tnt
    assert "kg of C-4" in text


def test_effects_of_a_charge(capsys):
    text = printed(capsys, "--mass-kg", "1000", "--model", "kinney-graham")
    assert "kinney-graham, air burst" in text
    rows = re.findall(r"^  (\S.*?) {2,}([\d.]+) +([\d.]+) m$", text, re.MULTILINE)
    assert [row[0] for row in rows] == [threshold.damage for threshold in THRESHOLDS]
    stand_offs = {float(kpa): float(metres) for _, kpa, metres in rows}
    # Ten times the scaled distances, in four digits.
    assert stand_offs[2.07] == 409.7
    assert stand_offs[34.5] == 45.75
    assert stand_offs[68.9] == 32.55


def test_ground_vibration_of_a_charge(capsys):
    text = printed(capsys, "--mass-kg", "25")
    assert re.search(r"^  100 m +9.446 mm/s +204.7 kg$", text, re.MULTILINE)
    assert "50.8 mm/s is kept from 34.94 m on" in text
    assert "average rock, v = 1140 mm/s" in text
    confined = printed(capsys, "--mass-kg", "25", "--ground", "confined")
    assert re.search(r"^  100 m +41.43 mm/s", confined, re.MULTILINE)


def test_more_explosive_than_tnt_reaches_farther(capsys):
    tnt, petn = (printed(capsys, "--mass-kg", "10", "--explosive", name) for name in ("TNT", "PETN"))
    assert fact(petn, "in TNT") == "12.7"
    reach = re.compile(r"typical glass breakage +1.03 +([\d.]+) m")
    assert float(reach.search(petn)[1]) == pytest.approx(1.27 ** (1 / 3) * float(reach.search(tnt)[1]), rel=1e-3)


@pytest.mark.parametrize(
    "arguments, words",
    [
        ("", "one of the arguments --distance-m --mass-kg --zone-m is required"),
        ("--distance-m 10", "--distance-m is 10: expected one of --overpressure-kpa, --impulse-kpa-ms with it"),
        ("--mass-kg 10 --distance-m 10", "--distance-m: not allowed with argument --mass-kg"),
        ("--mass-kg 10 --overpressure-kpa 5", "--overpressure-kpa is 5: expected --distance-m with it, not --mass-kg"),
        ("--mass-kg 10 --impulse-kpa-ms 5", "--impulse-kpa-ms is 5: expected --distance-m with it, not --mass-kg"),
        ("--distance-m 10 --overpressure-kpa 5 --impulse-kpa-ms 5", "not allowed with argument --overpressure-kpa"),
        ("--mass-kg -1", "--mass-kg: '-1' is wrong: expected a number from 1e-06 to 1e+09"),
        ("--mass-kg 0", "--mass-kg: '0' is wrong: expected a number from"),
        ("--mass-kg nan", "--mass-kg: 'nan' is wrong: expected a number from"),
        ("--mass-kg 1e300", "--mass-kg: '1e300' is wrong: expected a number from"),
        ("--mass-kg much", "--mass-kg: 'much' is wrong: expected a number from"),
        ("--distance-m 0 --overpressure-kpa 5", "--distance-m: '0' is wrong: expected a number from"),
        ("--distance-m 1 --overpressure-kpa inf", "--overpressure-kpa: 'inf' is wrong: expected a number from"),
        (
            "--distance-m 1 --overpressure-kpa 1e8",
            "overpressure is 1e+08 kPa: expected up to 4.895e+04",
        ),
        ("--distance-m 1 --overpressure-kpa 1e-6", "--overpressure-kpa is 1e-06: load is 0.001: expected more than"),
        ("--distance-m 1 --impulse-kpa-ms 1e8", "--impulse-kpa-ms is 1e+08: impulse is 1e+08: expected up to"),
        ("--mass-kg 1 --explosive jelly", "--explosive: explosive is 'jelly': expected one of TNT, ANFO"),
        ("--mass-kg 1 --burst water", "--burst: invalid choice: 'water'"),
        ("--mass-kg 1 --model conwep", "--model: invalid choice: 'conwep'"),
        ("--mass-kg 1 --ground sea", "--ground: invalid choice: 'sea'"),
    ],
)
def test_wrong_input_is_refused(arguments, words, capsys):
    assert main(["charge", *arguments.split()]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("bda: error: ")
    assert len(captured.err.splitlines()) == 1
    assert words in captured.err


def test_help_names_the_explosives(capsys):
    assert main(["charge", "--help"]) == 0
    assert "Dynamite 60 %" in " ".join(capsys.readouterr().out.split())
