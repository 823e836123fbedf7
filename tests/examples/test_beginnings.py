# SPDX-License-Identifier: GPL-3.0-or-later
"""Examples begin as the runs did whose ranges they tell of; those that have tests of their own begin there."""

import json

import pytest
from support.checkout import TESTS
from support.example_claims import assert_begins
from support.example_runs import BEGINNINGS, VERSIONS, begun
from support.long_cases import long_but

NAMES = (
    "arch_severed",
    "composite_span_dropped",
    "drilled_misfire",
    "drilled_two_spans_in_100_shards",
    "drilled_viaduct_pier",
    "excavator_on_the_deck",
    "frame_leg_blasted",
    "two_spans_20m_at_once",
)
QUICK = ("two_spans_20m_at_once",)
"""That which takes least."""


def test_none_is_left_out():
    kept = json.loads(VERSIONS.read_text(encoding="utf-8"))
    elsewhere = "".join(
        path.read_text(encoding="utf-8")
        for path in (TESTS / "examples").glob("test_*.py")
        if path.name != "test_beginnings.py" and "assert_begins(" in path.read_text(encoding="utf-8")
    )
    assert {name for name in kept if f'"{name}"' in elsewhere} | set(NAMES) == set(kept) == set(BEGINNINGS)


@pytest.mark.parametrize("name", long_but(QUICK, NAMES))
def test_it_begins_as_it_did(name, session_folder):
    run = begun(name, session_folder)
    # Something has come of what is done to it.
    assert not run.results.frames.intact[-1].all()
    assert_begins(name, run)
