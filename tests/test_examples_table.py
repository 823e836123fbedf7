# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of all examples says what was worked out and measured, and bridges as they are stand and carry traffic."""

import sys

import pytest
from support.checkout import REPORT_2019, ROOT

sys.path.insert(0, str(ROOT / "scripts"))

import examples_table

STATICS = {row["example"]: row for row in examples_table.rows(examples_table.STATICS)}
WITHOUT_LANES = (
    "lillebruen",
    "composite_span_dropped",
    "span_lifted_out",
    "frame_leg_blasted",
    *examples_table.UNDRAWN,
)
NOW = [name for name, path in examples_table.SEEDED.items() if path.parent != REPORT_2019]


def test_the_page_is_what_its_script_makes():
    assert examples_table.PAGE.read_text(encoding="utf-8") == examples_table.page()
    assert examples_table.PAGE_OF_2019.read_text(encoding="utf-8") == examples_table.page_of_2019()


def test_all_examples_are_in_it():
    assert list(STATICS) == list(examples_table.SEEDED)
    text = examples_table.page() + examples_table.page_of_2019()
    assert [name for name in examples_table.SEEDED if f"| [{name}](" not in text] == []


@pytest.mark.parametrize("name", NOW)
def test_bridges_as_they_are_stand_and_carry_what_they_are_designed_for(name):
    row = STATICS[name]
    assert row["verdict"] == "stands"
    assert float(row["load_factor"]) > 1.0
    assert int(row["carried"]) == int(row["positions"])
    assert int(row["positions"]) > 0 or name in WITHOUT_LANES


def test_a_row_counts_runs_that_rest_and_spans_that_are_down(monkeypatch, tmp_path):
    monkeypatch.setattr(examples_table, "RANGES", tmp_path)
    (tmp_path / "two_spans_13m_ball.csv").write_text(
        "seed,largest_throw_m,throw_95_percent_m,span_1_share_fallen_2_m,span_2_share_fallen_2_m,came_to_rest_s,made_share\n"
        "1,3.0,1.0,1.0,0.0,4.2,0.01\n"
        "2,5.0,2.0,0.6,0.1,,0.03\n"
    )
    of_runs = examples_table.of_runs("two_spans_13m_ball").split(" | ")
    assert of_runs == ["2", "1 of 2", "span 1: 2; span 2: 0", "1.00 to 2.00 m", "3.00 to 5.00 m", "2.0 % (1.0 to 3.0)"]
