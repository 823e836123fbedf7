# SPDX-License-Identifier: GPL-3.0-or-later
"""``bda calibrate``: the law of a site as a table that a scenario takes, and refusals in one line."""

import tomllib
from dataclasses import replace

import pytest
from support.run_folders import TOLD, flying_shards, keep_run

from bridge_demolition_addon.cli.main import main
from bridge_demolition_addon.engineering.blast.site_law import station_distances_m
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.debris.touchdown import landings, shaking_at
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


def test_stations_have_the_scaled_distances_of_the_neighbours_between_them():
    """0.5 and 1.732 m/√kJ, and 5 t from 20 m: 980.665 kJ, √ of it 31.32. From 0.5 / 1.25 · 31.32 = 12.5 m to
    1.732 · 1.25 · 31.32 = 67.8 m.
    """
    distances = station_distances_m([1.732, 0.5], 980.665)
    assert (distances[0], distances[-1]) == pytest.approx((12.53, 67.80), abs=0.01) and len(distances) == 8
    assert distances[1:] / distances[:-1] == pytest.approx([(67.80 / 12.53) ** (1.0 / 7.0)] * 7, rel=1e-3)


def test_a_drop_test_is_planned_for_the_neighbours_of_a_run(tmp_path, capsys):
    """With a weight that lands with the energy of the run's landing, a station is as far away as the neighbour."""
    results = flying_shards()
    run = keep_run(tmp_path / "run", results, TOLD)
    shaking = shaking_at(TOLD.neighbours[0].position_m, landings(results))
    mass_t = f"{shaking.energy_j / 1e3 / STANDARD_GRAVITY_M_S2:.9g}"
    assert main(["calibrate", "--plan", str(run), "--mass-t", mass_t, "--height-m", "1"]) == 0
    first, house, school, last = capsys.readouterr().out.splitlines()
    assert f"from 1 m: {shaking.energy_j / 1e3:.4g} kJ" in first
    assert house.startswith("House: ") and school.startswith("School & yard: ")
    assert house.endswith(f"as {shaking.distance_m:.3g} m from the weight")
    assert last.startswith("Measure at ") and last.count(",") == 7


@pytest.mark.parametrize(
    "arguments, complaint",
    [
        ([], "expected either a table of events, EVENTS.csv, or --plan RUN"),
        (["events.csv", "--plan", "run"], "expected either a table of events"),
        (["--plan", "run", "--mass-t", "5"], "--height-m goes with --plan RUN"),
        (["events.csv", "--height-m", "5"], "--height-m goes with --plan RUN"),
    ],
)
def test_what_does_not_go_together_is_told(arguments, complaint, capsys):
    assert main(["calibrate", *arguments]) == 2
    assert complaint in capsys.readouterr().err


def test_a_run_without_neighbours_gives_no_plan(tmp_path, capsys):
    run = keep_run(tmp_path / "run", flying_shards(6), replace(TOLD, neighbours=()))
    assert main(["calibrate", "--plan", str(run), "--mass-t", "5", "--height-m", "20"]) == 2
    assert "nothing fell, or it has no neighbours" in capsys.readouterr().err
    assert main(["calibrate", "--plan", str(tmp_path / "none"), "--mass-t", "5", "--height-m", "20"]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
