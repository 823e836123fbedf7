# SPDX-License-Identifier: GPL-3.0-or-later
"""Tolerances are quoted from one place, and what a report leaves out follows from its scenario."""

from dataclasses import replace

from support.checkout import ROOT
from support.scenarios import I235

from bridge_demolition_addon.model.scenario import Charge, ConnectionSettings
from bridge_demolition_addon.report.sections.cover import limits_of
from bridge_demolition_addon.report.wording.checks import CHECKS


def test_the_page_on_reports_quotes_all_checks():
    page = (ROOT / "docs" / "report.md").read_text(encoding="utf-8")
    table = [line for line in page.partition("agrees within")[2].splitlines() if line.startswith("| ")][1:]
    assert table[: len(CHECKS)] == [f"| {check.what} | {check.against} | {check.within} |" for check in CHECKS]


def test_limits_follow_from_the_scenario():
    rigid = " ".join(limits_of(I235))
    assert "nothing bends" in rigid and "One breaking force" in rigid and "blast" not in rigid
    concrete = ConnectionSettings(type="FIXED", method="face", material="concrete", stiffness="elastic")
    elastic = " ".join(limits_of(replace(I235, connections=concrete)))
    assert "nothing bends" not in elastic and "connections deform" in elastic and "One breaking force" not in elastic
    charged = replace(I235, charges=(Charge(place_m=(6.5, 0.0, 1.0), mass_kg=1.0),))
    assert "Pressures of blast behind" in " ".join(limits_of(charged))
