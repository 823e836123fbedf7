# SPDX-License-Identifier: GPL-3.0-or-later
"""What the documents claim of many seeds is what the measured runs say."""

import csv

import numpy as np
import pytest
from pictures import seeds_chart
from support.checkout import DEMOLITIONS, ROOT, SEEDED, said_of
from support.example_claims import beyond_claims

MEASURED = sorted(seeds_chart.DATA.parent.glob("*.csv"))


@pytest.fixture(scope="module")
def runs():
    return seeds_chart.read_throws(seeds_chart.DATA)


def spread(values):
    """A range as the documents write it."""
    if values.max() < 0.1:
        return f"{100.0 * values.min():.1f} to {100.0 * values.max():.1f} cm"
    return f"{values.min():.1f} to {values.max():.1f} m"


def percent(shares):
    """A range of shares as the documents write it: with a digit after the point where they are small."""
    digits = 1 if shares.max() < 0.02 else 0
    return f"{100.0 * shares.min():.{digits}f} to {100.0 * shares.max():.{digits}f} %"


def words(path):
    """Text of a file with single blanks, without the marks of comments."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return " ".join(" ".join(line.removeprefix("#") for line in lines).split())


def test_every_run_has_a_seed_of_its_own_and_is_in_order_of_its_largest_throw(runs):
    assert len(runs) == len(set(runs["seed"])) >= 20
    assert (np.diff(runs["largest_throw_m"]) >= 0.0).all()
    assert (runs["throw_95_percent_m"] <= runs["largest_throw_m"]).all()


def test_the_page_gives_the_ranges_that_were_measured(runs):
    text = words(ROOT / "docs" / "accuracy.md")
    largest = runs["largest_throw_m"]
    assert f"run {len(runs)} times" in text
    assert f"stay within {spread(runs['throw_95_percent_m'])}" in text
    assert f"goes {largest.min():.1f} m in one run and {largest.max():.1f} m in another" in text
    assert min(runs["span_1_share_fallen_2_m"].min(), runs["span_2_share_fallen_2_m"].min()) > 0.9
    assert "In every run both spans come down." in text
    assert f"farthest of these {len(runs)} with a chance of 1 in {len(runs) + 1}" in text


@pytest.mark.parametrize("path", MEASURED, ids=lambda path: path.stem)
def test_the_gallery_gives_the_ranges_that_were_measured(path):
    runs, file = seeds_chart.read_throws(path), SEEDED[path.stem].relative_to(ROOT).as_posix()
    gallery = (ROOT / "docs" / "gallery.md").read_text(encoding="utf-8").splitlines()
    (text,) = (line for line in gallery if "seeds" in line and f"(../{file})" in line)
    broken = runs["broken_connections"]
    claims = (
        f"*{len(runs)} seeds",
        f"95 % of the shards within {spread(runs['throw_95_percent_m'])}, ",
        f"the farthest {spread(runs['largest_throw_m'])}; ",
        f"{broken.min():.0f} to {broken.max():.0f} connections break; ",
        f"solver {percent(runs['made_share'])}.",
    )
    assert [claim for claim in claims if claim not in text] == []


@pytest.mark.parametrize("name", [path.stem for path in MEASURED])
def test_every_claim_of_a_test_holds_in_at_least_twenty_draws(name):
    with (seeds_chart.DATA.parent / f"{name}.csv").open(encoding="utf-8", newline="") as file:
        rows = [{key: float(value) if value else None for key, value in row.items()} for row in csv.DictReader(file)]
    assert len({row["seed"] for row in rows}) == len(rows) >= 20
    assert {row["seed"]: beyond for row in rows if (beyond := beyond_claims(name, row))} == {}


def test_the_example_says_how_often_the_span_that_starts_awake_falls():
    runs = seeds_chart.read_throws(seeds_chart.DATA.with_stem("single_span_awake"))
    falls = (runs["span_1_median_fall_m"] > 4.0).sum()
    assert falls > 0.5 * len(runs)
    assert f"With {falls} of {len(runs)} seeds the piers fail" in said_of(DEMOLITIONS["single_span_awake"])
    assert f"its own weight in {falls} of {len(runs)} seeds" in words(ROOT / "docs" / "accuracy.md")


def test_the_example_says_how_often_a_span_between_charges_of_a_ton_is_falling():
    runs = seeds_chart.read_throws(seeds_chart.DATA.with_stem("two_spans_20m_delays"))
    falling = (np.maximum(runs["span_1_median_fall_m"], runs["span_2_median_fall_m"]) > 0.1).sum()
    assert f"With {falling} of {len(runs)} seeds a span is falling" in said_of(DEMOLITIONS["two_spans_20m_delays"])


def test_the_chart_shows_both_throws_of_every_run(runs):
    farthest, most = seeds_chart.draw(runs).axes[0].lines
    np.testing.assert_array_equal(farthest.get_ydata(), runs["largest_throw_m"])
    np.testing.assert_array_equal(most.get_ydata(), runs["throw_95_percent_m"])


def test_the_page_on_stages_says_how_often_what_stands_by_statics_comes_down():
    name = "excavator_on_the_deck"
    runs = seeds_chart.read_throws(seeds_chart.DATA.with_stem(name))
    down = (np.minimum(runs["span_1_share_fallen_2_m"], runs["span_2_share_fallen_2_m"]) > 0.5).sum()
    assert f"both spans come down with {down} of {len(runs)} seeds" in words(ROOT / "docs" / "stages.md")
    assert f"over {len(runs)} seeds both spans come down in all" in said_of(SEEDED[name]) and down == len(runs)
    rest_s = runs["came_to_rest_s"][np.isfinite(runs["came_to_rest_s"])]
    said = f"{len(rest_s)} come to rest, {rest_s.min():.0f} to {rest_s.max():.0f} s after the start"
    assert said in said_of(SEEDED[name])
