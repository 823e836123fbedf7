# SPDX-License-Identifier: GPL-3.0-or-later
"""``bda plan``: the charge plan of a scenario as page, PDF, tables and workbook."""

import csv
import json

import numpy as np
import openpyxl
import pytest
from support.checkout import EXAMPLES, I235_FILE

from bridge_demolition_addon.cli.main import main

DRILLED = EXAMPLES / "drilled" / "two_spans.toml"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    target = tmp_path_factory.mktemp("plan")
    scenario = target / "drilled.toml"
    scenario.write_text(
        f'[scenario]\nbased_on = "{DRILLED}"\n\n[[neighbours]]\nname = "House"\nplace_m = [13.0, 40.0, 1.5]\n'
        "limit_mm_s = 0.5\nlimit_db = 140.0\n\n[site]\nlatitude_deg = 51.0\nlongitude_deg = 7.0\n",
        encoding="utf-8",
    )
    assert main(["plan", str(scenario), "--output", str(target / "plan"), "--quiet"]) == 0
    return target / "plan"


def table(folder, name):
    with (folder / "tables" / f"{name}.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_tables_have_the_worked_example(folder):
    """Six columns with 10 holes of 73.5 g each: 4.41 kg in 60 holes, 1 kg/m³, 22.5 g/t."""
    holes, charges = table(folder, "drill_holes"), table(folder, "charge_table")
    assert len(holes) == len(charges) == 6
    assert sum(int(row["holes"]) for row in holes) == 60
    assert sum(float(row["mass_kg"]) for row in charges) == pytest.approx(4.41)
    assert {round(float(row["specific_charge_kg_m3"]), 6) for row in charges} == {1.0}
    assert {row["effect"] for row in charges} == {"thrown out"}
    totals = {row["fact"]: row["value"] for row in table(folder, "charge_totals")}
    assert totals["By mass of the bridge"] == "22.5 g/t; recorded jobs have 3 to 18 g/t"
    assert totals["Largest mass within 8 ms"] == "1.47 kg"  # both columns of a pier
    assert totals["From the first row to the last"] == "600 ms"


def test_the_sequence_goes_from_pier_to_pier(folder):
    times = [float(row["time_ms"]) for row in table(folder, "firing_sequence")]
    assert times == [0.0] * 4 + [300.0] * 4 + [600.0] * 4


def test_the_page_warns_of_a_limit_and_names_who_decides(folder):
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert "House: a limit is not kept." in page
    assert "a licensed blaster" in page and "no safety distance" in page
    assert "outside" not in page.split("Totals")[0]
    assert (folder / "report.pdf").stat().st_size > 10_000


def test_the_workbook_has_the_same_tables(folder):
    book = openpyxl.load_workbook(folder / "charge_plan.xlsx", read_only=True)
    assert {"units", "drill_holes", "charge_table", "firing_sequence", "charge_totals"} <= set(book.sheetnames)
    rows = list(book["charge_table"].iter_rows(values_only=True))
    assert rows[0][:3] == ("zone", "explosive", "charge_g")
    assert [row[3] for row in rows[1:]] == pytest.approx([0.735] * 6)


def test_a_scenario_without_zones_is_refused(tmp_path, capsys):
    assert main(["plan", str(I235_FILE), "--output", str(tmp_path / "plan")]) == 2
    assert "has no [[blast_zones]] and no [[cuts]], which a charge plan is made from" in capsys.readouterr().err
    assert not (tmp_path / "plan").exists()


@pytest.mark.long
def test_a_check_says_what_zones_do(capsys):
    assert main(["check", str(DRILLED)]) == 0
    text = capsys.readouterr().out
    section = text.split("\nBlast zones\n")[1]
    assert "pier 2 column 1, z 0.75 to 2.25 m, 10 holes of 73.5 g = 0.735 kg of emulsion, 0.500 s" in section
    assert "1.00 kg/m³ in 0.735 m³ (breaks from 0.47, is thrown out from 1.00): thrown out" in section
    # 14 bars of 20 mm by the rule: 14 × 157.1 kN; straight 14 × 27.6 kN, π² E I / 0.75², and λ = 2.387, χ = 0.144
    resist = "14 bars of 20 mm, as the member has, resist 2.20 MN in tension and 0.32 MN in compression by EN 1993-1-1"
    assert f"{resist}, curve c; 0.39 MN if straight, as in a run" in section
    assert "22.5 g a tonne of the bridge; recorded jobs have 3 to 18" in section


def test_the_site_plan_has_the_areas_of_fragments_as_no_safety_distance(folder):
    """Circles around six zones with the largest distance of each part of the mass, and the plan of the bridge."""
    features = json.loads((folder / "charge_plan.geojson").read_text(encoding="utf-8"))["features"]
    areas = {feature["properties"]["name"]: feature["properties"]["area_m2"] for feature in features}
    fragments = [name for name in areas if name.startswith("fragments")]
    assert fragments == [f"fragments {part}: factor 2, no safety distance" for part in ("99.9 %", "99 %", "50 %")]
    assert areas[fragments[0]] > areas[fragments[1]] > areas[fragments[2]] > areas["bridge"]
    rows = table(folder, "fragments")
    farthest = max(float(row["most_within_m"]) for row in rows)
    assert areas[fragments[1]] > 0.99 * np.pi * farthest**2
    # Decks of 27 m × 3.7 m but for the joint of 0.04 m, which the cap below covers.
    assert areas["bridge"] == pytest.approx(27.0 * 3.7, rel=0.01)
    assert areas["blast zone P2.1"] == pytest.approx(0.49)
    layers = (folder / "charge_plan.dxf").read_text(encoding="ascii")
    assert "FRAGMENTS_50_FACTOR_2_NO_SAFETY" in layers and "BLAST_ZONE_P2_1" in layers
