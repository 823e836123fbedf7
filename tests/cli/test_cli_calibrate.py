# SPDX-License-Identifier: GPL-3.0-or-later
"""``bda calibrate``: the law of a site as a table that a scenario takes, and refusals in one line."""

import tomllib

import pytest

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.model.scenario import VibrationLaw

ROWS = [f"{distance},4,{800.0 * (distance / 2.0) ** -1.5}" for distance in (10, 20, 40, 80, 160)]


@pytest.fixture
def events(tmp_path):
    path = tmp_path / "events.csv"
    path.write_text("\n".join(["distance_m,charge_kg,ppv_mm_s", *ROWS]) + "\n", encoding="utf-8")
    return path


def test_what_is_printed_is_a_table_of_a_scenario(events, capsys):
    """800 mm/s and 1.5 are what the events were made of."""
    assert main(["calibrate", str(events)]) == 0
    text = capsys.readouterr().out
    assert "v = 800 mm/s (R/√Q)^-1.5" in text and "5 events" in text
    (table,) = tomllib.loads(text[text.index("[[vibration_laws]]") :])["vibration_laws"]
    law = VibrationLaw(**table)
    assert (law.of, law.events, law.velocity_mm_s, law.exponent) == ("charges", 5, 800.0, 1.5)
    assert law.scaled == pytest.approx((5.0, 20.0, 80.0))


def test_a_file_is_written_once(events, capsys):
    output = events.with_name("law.toml")
    assert main(["calibrate", str(events), "--output", str(output), "--quiet"]) == 0
    assert capsys.readouterr().out == ""
    kept = output.read_text(encoding="utf-8")
    assert VibrationLaw(**tomllib.loads(kept)["vibration_laws"][0]).events == 5
    assert main(["calibrate", str(events), "--output", str(output)]) == 2
    captured = capsys.readouterr()
    assert "is there already: expected a new file" in captured.err and captured.out == ""
    assert output.read_text(encoding="utf-8") == kept


def test_a_refusal_is_one_line_and_writes_nothing(events, capsys):
    events.write_text("\n".join(["distance_m,charge_kg,ppv_mm_s", *ROWS[:4]]), encoding="utf-8")
    output = events.with_name("law.toml")
    assert main(["calibrate", str(events), "--output", str(output)]) == 2
    captured = capsys.readouterr()
    assert captured.err == f"bda: error: {events}: too few events, 4: expected at least 5; no law is given\n"
    assert captured.out == "" and not output.exists()
