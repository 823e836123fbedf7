# SPDX-License-Identifier: GPL-3.0-or-later
"""What the window and docs/sidebar.md say of previews with elastic connections is what previews and whole runs gave."""

import sys

import pytest
from support.checkout import ROOT

sys.path.insert(0, str(ROOT / "scripts" / "experiments"))

import previews

from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.study import preview_scenario

PAGE = ROOT / "docs" / "sidebar.md"
TABLE = ROOT / "bridge_demolition_addon" / "studies" / "README.md"
COMPARED = previews.compared()


def shares_alike(column):
    counts = [previews.pairs_alike(column, *runs) for runs in COMPARED.values()]
    return [previews.percent(count) for count in counts]


def test_the_page_has_the_table_of_all_runs():
    text = TABLE.read_text(encoding="utf-8")
    assert [line for line in previews.table(previews.KEPT).splitlines() if line not in text] == []


def test_the_window_says_how_many_spans_fell_or_stood_alike():
    """In the mean of all scenarios, at the end and when the first picture is shown."""
    for column in ("soon_spans", "spans"):
        shares = shares_alike(column)
        assert int(sum(shares) / len(shares)) >= preview_scenario.ALIKE_PERCENT
    assert int(sum(shares) / len(shares)) - 3 <= preview_scenario.ALIKE_PERCENT


def test_the_window_says_how_far_debris_got():
    ratios = [ratio for runs in COMPARED.values() if (ratio := previews.throw_ratio(*runs)) is not None]
    assert round(min(ratios), 1) == preview_scenario.LEAST_THROW
    assert round(max(ratios), 1) == preview_scenario.MOST_THROW


def test_the_page_says_how_far_most_shards_have_got_in_the_first_picture():
    columns = "soon_throw_95_percent_m", "throw_95_percent_m"
    ways = [tuple(float(row[column]) for column in columns) for runs in COMPARED.values() for row in runs[0]]
    shares = [soon_m / way_m for soon_m, way_m in ways if way_m > previews.MOVED_M]
    sentence = f"got {min(shares):.1f} to {max(shares):.1f} times as far as at the end"
    assert sentence in " ".join(PAGE.read_text(encoding="utf-8").split())


def test_the_page_says_how_long_previews_take():
    longest = {name: max(float(row["time_in_rigid"]) for row in rows) for name, (rows, _) in COMPARED.items()}
    assert [round(longest.pop(name)) for name in ("deck_truss_severed", "truss_severed")] == [7, 8]
    shortest = min(float(row["time_in_rigid"]) for rows, _ in COMPARED.values() for row in rows)
    assert (round(shortest, 1), round(max(longest.values()))) == (0.8, 5)


def test_each_preset_with_elastic_connections_was_compared():
    elastic = {
        name
        for name, path in previews.SCENARIOS.items()
        if path.is_relative_to(previews.PRESETS) and read_scenario(path).connections.is_elastic
    }
    assert elastic and elastic <= set(COMPARED)
    assert all(runs[1] for runs in COMPARED.values())


@pytest.mark.parametrize(
    "one, other, alike", [("1.00 0.00", "0.80 0.10", (2, 2)), ("0.40 0.00", "0.60 0.00", (1, 2)), ("nan", "1", (0, 0))]
)
def test_a_span_falls_where_half_of_its_deck_does(one, other, alike):
    assert previews.pairs_alike("spans", [{"spans": one}], [{"spans": other}]) == alike


def test_throws_are_compared_by_medians_where_something_falls():
    rows = [[{"throw_95_percent_m": value} for value in values] for values in (("1", "2", "9"), ("4", "4"), ("0.01",))]
    assert previews.throw_ratio(rows[0], rows[1]) == 0.5
    assert previews.throw_ratio(rows[0], rows[2]) is None
