# SPDX-License-Identifier: GPL-3.0-or-later
"""The charge plan as a chapter of the report of a run."""

from dataclasses import replace

from support.checkout import EXAMPLES
from support.run_folders import TOLD

from bridge_demolition_addon.model.results.stability import ZoneLoad
from bridge_demolition_addon.model.scenario import Geometry, MemberCut, Neighbour, VibrationLaw
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.report.document.blocks import DataTable, Paragraph
from bridge_demolition_addon.report.sections.charge_plan import charge_plan_section, known_plan

DRILLED = read_scenario(EXAMPLES / "drilled" / "two_spans.toml")


def section_of(scenario, loads=()):
    return charge_plan_section(scenario, known_plan(scenario), loads)


def notices(section):
    return [block.text for block in section.blocks if isinstance(block, Paragraph) and block.is_notice]


def tables(section):
    return {block.name: block for block in section.blocks if isinstance(block, DataTable)}


def test_a_scenario_without_zones_has_no_such_chapter():
    assert section_of(TOLD) is None


def test_what_a_blaster_would_ask_stands_once_for_all_zones():
    weak = [replace(zone, stemming_m=0.16, cover_factor=1.0) for zone in DRILLED.blast_zones]
    found = notices(section_of(replace(DRILLED, blast_zones=weak)))
    (stemming,) = [text for text in found if "stemming" in text]
    assert (
        stemming == "Look at P2.1, P2.2, P1.1, P1.2, P3.1, P3.2: stemming of 0.16 m is less than the burden, 0.175 m."
    )
    assert any("scaled depth of burial" in text for text in found)


def test_misfires_and_an_odd_amount_are_named():
    first, *others = DRILLED.blast_zones
    zones = [replace(first, fires=False), *(replace(zone, charge_g=0.0) for zone in others)]
    section = section_of(replace(DRILLED, blast_zones=zones))
    assert "Planned not to fire: P2.1." in notices(section)
    assert tables(section)["firing_sequence"].rows == []
    assert tables(section)["charge_table"].shown_rows()[0][8] == "misfires"
    light = section_of(replace(DRILLED, blast_zones=[replace(first, charge_g=10.0)]))
    # 10 holes of 10 g on 196 t: 0.51 g/t
    assert "0.5 g/t are outside 1 to 90 g/t, which recorded jobs are within." in notices(light)


def test_what_is_above_a_zone_falls_and_can_land_on_its_stub():
    """Zones from 0.75 to 2.25 m of columns: 14 bars of 20 mm over 75 diameters may be counted on for 0.316 MN."""
    loads = [ZoneLoad("P2.1", 0.38e6, 0.0, 0.0), ZoneLoad("P1.2", -0.11e6, 0.0, 0.0)]
    table = tables(section_of(DRILLED, loads))["zone_falls"]
    cells = {row[0]: row[1:] for row in table.shown_rows()}
    assert cells["P2.1"] == ["0.38", "1.20", "1.50", "5.4", "2.65", "0.75", "0.07", "1.43", "yes"]
    assert cells["P1.2"][:2] == ["-0.11", "0.05"]  # of 2.20 MN in tension
    assert cells["P3.1"][:2] == ["-", "-"]  # not known
    viaduct = tables(section_of(read_scenario(EXAMPLES / "drilled" / "viaduct_pier.toml")))["zone_falls"]
    assert {row[-1] for row in viaduct.shown_rows()} == {"no"}
    misfires = [replace(zone, fires=False) for zone in DRILLED.blast_zones]
    assert "zone_falls" not in tables(section_of(replace(DRILLED, blast_zones=misfires)))


def test_a_file_that_is_gone_is_named_in_place_of_the_plan(tmp_path):
    gone = Geometry(file=str(tmp_path / "gone.stl"), name="gone", kind="pier", density_kg_m3=2400)
    section = section_of(replace(DRILLED, geometry=(gone,)))
    (notice,) = notices(section)
    assert notice.startswith("The charge plan is not known: ") and "gone.stl" in notice


def test_the_plan_of_a_viaduct_with_504_holes_is_whole():
    """Three walls of 5.0 × 0.8 m with two zones of 2.0 m each: 6 × 12 × 7 holes of 66 g in 6 × 8.0 m³."""
    section = section_of(read_scenario(EXAMPLES / "drilled" / "viaduct_pier.toml"))
    found = tables(section)
    holes, fired = found["drill_holes"].rows, found["firing_sequence"].rows
    assert len(holes) == len(found["charge_table"].rows) == len(found["fragments"].rows) == 6
    assert len(fired) == 72  # rows
    assert fired[0][2] == "P2 foot" and fired[-1][2] == "P3 middle"
    totals = dict(found["charge_totals"].rows)
    assert totals["Holes, each with a detonator"] == "504"
    assert totals["Explosive"] == "33.3 kg" and totals["Specific charge"] == "0.69 kg/m³"
    assert totals["Drilled"] == "267.1 m"


def test_severed_members_have_a_table():
    cut = MemberCut(member="pier 1 cap", along="y", position_m=0.5, mass_kg=3.0, delay_ms=50.0)
    section = section_of(replace(DRILLED, blast_zones=(), cuts=(cut,)))
    found = tables(section)
    assert found["severed_members"].shown_rows()[0][:3] == ["Cut 1", "pier 1 cap", "y"]
    assert [row[2] for row in found["firing_sequence"].rows] == ["Cut 1"]
    assert "drill_holes" not in found
    assert any("licensed blaster to say" in block.text for block in section.blocks if isinstance(block, Paragraph))


def test_a_law_of_the_site_is_named_with_its_band_and_where_it_is_extrapolated():
    law = VibrationLaw(
        of="charges", velocity_mm_s=800.0, exponent=1.5, scatter=0.3, events=8, scaled=(20.0, 30.0, 60.0), spread=0.5
    )
    places = {"near": (13.0, 3.0, 1.0), "house": (13.0, 45.0, 1.0)}
    neighbours = [Neighbour(name=name, position_m=place) for name, place in places.items()]
    section = section_of(replace(DRILLED, neighbours=neighbours, vibration_laws=(law,)))
    (of_law,) = [block.text for block in section.blocks if isinstance(block, Paragraph) and "this site" in block.text]
    assert "800 mm/s (R/√Q)^-1.5" in of_law and "8 events" in of_law and "20 to 60 m/√kg" in of_law
    assert [text for text in notices(section) if "extrapolated" in text] == [
        "near: its scaled distance is outside those that were measured, so that the law of the site is extrapolated."
    ]
    table = tables(section)["charge_neighbours"]
    expected, at_most = (
        next(place for place, column in enumerate(table.columns) if column.key == name)
        for name in ("peak_particle_velocity_mm_s", "at_most_mm_s")
    )
    assert all(row[at_most] > row[expected] > 0.0 for row in table.rows)
