# SPDX-License-Identifier: GPL-3.0-or-later
"""What reports say of piles is what `scripts/validate` found of columns of loose blocks."""

import json

import pytest
from support.checkout import ROOT

from bridge_demolition_addon.model.debris.throws import HEIGHT, RUNOUT

CASE = ROOT / "docs" / "data" / "validation" / "collapsing_column.json"


@pytest.mark.parametrize(("quantity", "limits"), [("runout", RUNOUT), ("height in the end", HEIGHT)])
def test_the_error_of_piles_is_that_of_the_validation(quantity, limits):
    comparisons = json.loads(CASE.read_text(encoding="utf-8"))["comparisons"]
    ratios = [row["found"] / row["expected"] for row in comparisons if row["quantity"].startswith(quantity)]
    assert len(ratios) == 8
    assert limits[0] <= min(ratios) < limits[0] + 0.01 and limits[1] - 0.01 < max(ratios) <= limits[1]
