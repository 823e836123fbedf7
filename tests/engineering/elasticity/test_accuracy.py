# SPDX-License-Identifier: GPL-3.0-or-later
"""How finely members are cut, and that results are off by no more than is said for that."""

import csv
import statistics

import pytest
from support.checkout import ROOT

from bridge_demolition_addon.engineering.elasticity.accuracy import expected_deviation, spacing_m


def test_shards_of_bars_and_plates_are_as_far_apart_as_they_fill_them():
    assert spacing_m(8.0, 64, 2.0, 2.0) == pytest.approx(0.5)  # cubes of 0.5 m
    assert spacing_m(0.25 * 4.0 * 16.0, 64, 0.25, 4.0) == pytest.approx(1.0)  # squares of 1 m in one layer
    assert spacing_m(0.5 * 0.5 * 12.0, 4, 0.5, 0.5) == pytest.approx(3.0)  # four in a row


ALONG = {
    # Lengths of the members that span over the spacing of their shards, by hand.
    "portal": {40: 9.3, 100: 14.7, 200: 20.8, 600: 36.0},
    "frame of an example": {40: 7.4, 100: 11.7, 200: 16.5, 600: 28.6},
    "deck over two spans": {40: 18.6, 100: 29.4, 200: 41.6, 600: 58.2},
    "four girders": {40: 4.2, 100: 10.4, 200: 20.1, 600: 35.0},
    "skewed slab": {40: 9.5, 100: 14.9, 200: 21.2, 600: 31.4},
}


def rows(name):
    with (ROOT / "docs" / "data" / name).open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_what_was_measured_is_off_by_no_more_than_is_said():
    references = {(row["bridge"], row["quantity"]): float(row["value"]) for row in rows("bridges_by_opensees.csv")}
    found = {}
    for row in rows("elastic_bridges.csv"):
        key = row["bridge"], row["quantity"]
        found.setdefault((*key, int(row["shards"])), []).append(float(row["value"]) / references[key] - 1.0)
    assert {bridge for bridge, _, _ in found} == set(ALONG)
    for (bridge, quantity, shards), deviations in found.items():
        if quantity != "quarter at an acute corner":  # where little arrives, as the docstring says
            assert abs(statistics.median(deviations)) <= expected_deviation(ALONG[bridge][shards])
