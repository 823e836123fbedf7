# SPDX-License-Identifier: GPL-3.0-or-later
"""Tolerances are quoted from one place, and what a report leaves out follows from its scenario."""

from dataclasses import replace

from support.checkout import ROOT
from support.reports_of_many_kinds import DRILLED
from support.scenarios import I235

from bridge_demolition_addon.model.scenario import Charge, ConnectionSettings
from bridge_demolition_addon.report.sections.cover import limits_of, modelled, sources, trust_section
from bridge_demolition_addon.report.wording.checks import CHECKS


def test_the_page_on_reports_quotes_all_checks():
    page = (ROOT / "docs" / "report.md").read_text(encoding="utf-8")
    table = [line for line in page.partition("agrees within")[2].splitlines() if line.startswith("| ")][1:]
    assert table[: len(CHECKS)] == [f"| {check.what} | {check.against} | {check.within} |" for check in CHECKS]


def test_what_is_modelled_and_where_it_comes_from_follow_from_the_scenario():
    of_ball, of_zones = " ".join(modelled(I235)), " ".join(modelled(DRILLED))
    assert "wrecking ball" in of_ball and "drill holes" not in of_ball and "bars" not in of_ball
    for words in ("elastic connections", "reinforcing bars", "drill holes", "fragments of blast zones"):
        assert words in of_zones
    named = dict(sources(DRILLED))
    assert "Lundborg" in named["Fragments (flyrock)"] and "EN 1993-1-1" in named["Bars bared by a charge"]
    assert named.keys() >= {"Cracks and bars", "Drilled charges"} and "Estimated forces of the ball's hits" not in named
    assert not {"Cracks and bars", "Drilled charges", "Blast waves"} & dict(sources(I235)).keys()
    splinters = " ".join(limits_of(DRILLED))
    assert "sampled beside the run" in splinters and "fly farther than any throw" not in splinters


def test_misses_against_measurements_stand_first_and_are_counted():
    (table,) = (block for block in trust_section(I235).blocks if getattr(block, "title", "").startswith("Held against"))
    shares = [within / of for _, within, of, _ in table.rows]
    assert shares == sorted(shares) and shares[0] < 0.5
    assert f": {sum(row[1] for row in table.rows)} of {sum(row[2] for row in table.rows)} numbers" in table.title


def test_limits_follow_from_the_scenario():
    rigid = " ".join(limits_of(I235))
    assert "nothing bends" in rigid and "One breaking force" in rigid and "blast" not in rigid
    concrete = ConnectionSettings(type="FIXED", method="face", material="concrete", stiffness="elastic")
    elastic = " ".join(limits_of(replace(I235, connections=concrete)))
    assert "nothing bends" not in elastic and "connections deform" in elastic and "One breaking force" not in elastic
    charged = replace(I235, charges=(Charge(position_m=(6.5, 0.0, 1.0), mass_kg=1.0),))
    assert "Pressures of blast behind" in " ".join(limits_of(charged))
