# SPDX-License-Identifier: GPL-3.0-or-later
"""How finely members are cut, and how far bridges that were measured are from the aims."""

import statistics

import pytest
from experiments import elastic_bridges
from support.checkout import ROOT

from bridge_demolition_addon.engineering.elasticity.accuracy import spacing_m

AT_ACUTE_CORNERS = "quarter at an acute corner"


def test_shards_of_bars_and_plates_are_as_far_apart_as_they_fill_them():
    assert spacing_m(8.0, 64, 2.0, 2.0) == pytest.approx(0.5)  # cubes of 0.5 m
    assert spacing_m(0.25 * 4.0 * 16.0, 64, 0.25, 4.0) == pytest.approx(1.0)  # squares of 1 m in one layer
    assert spacing_m(0.5 * 0.5 * 12.0, 4, 0.5, 0.5) == pytest.approx(3.0)  # four in a row


@pytest.mark.parametrize(
    "bridge, missed",
    [
        ("deck on bearings", set()),
        (
            "girders on bearings",
            {(f"{place} girders", shards) for place in ("outer", "inner") for shards in (100, 200, 600)}
            | {("deflection", 600), ("first frequency", 600)},
        ),
        ("skewed on bearings", {(AT_ACUTE_CORNERS, shards) for shards in (100, 200, 600)}),
    ],
)
def test_bridges_on_bearings_meet_the_aims(bridge, missed):
    """Reactions 2 %, moments and deflections 5 %, frequencies 3 %, but for what the README says in bold."""
    found = {
        (quantity, shards)
        for (name, quantity), by_shards in elastic_bridges.deviations().items()
        for shards, deviations in by_shards.items()
        if name == bridge and shards >= 100 and abs(statistics.median(deviations)) > elastic_bridges.aim(quantity)
    }
    assert found == missed


def test_the_page_has_the_table_that_is_measured(capsys):
    elastic_bridges.table()
    page = ROOT / "bridge_demolition_addon" / "engineering" / "elasticity" / "README.md"
    assert capsys.readouterr().out in page.read_text(encoding="utf-8")
