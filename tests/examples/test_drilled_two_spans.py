# SPDX-License-Identifier: GPL-3.0-or-later
"""What the demonstration shows is within the ranges that its own text tells of."""

from support.example_claims import assert_claims
from support.example_runs import example, run_example

NAME = "drilled_two_spans"


def test_a_fresh_demonstration_is_within_its_ranges(tmp_path):
    assert_claims(NAME, run_example(example(NAME), tmp_path))
