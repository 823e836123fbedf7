# SPDX-License-Identifier: GPL-3.0-or-later
"""Kept studies, searches and optimisations are of the program as it is: a run of each comes out again as it was."""

import ensembles
import pytest
from support.checkout import ROOT

pytestmark = pytest.mark.long

LONG = {"drilled_two_spans", "drilled_two_spans_longer_zones", "lillebruen", "overbridge"}
"""Those of which a run takes a minute or more: `scripts/remake --check` makes one again. Tests run the beginning of the
first one's bridge, as of all examples."""

EARLIER = {"least_charge", "lightest_ball"}
"""Those of an earlier version, as their pages say: kept ranges are made again all at once."""


@pytest.mark.parametrize("name", sorted(set(ensembles.ENSEMBLES) - LONG - EARLIER))
def test_a_run_made_again_has_the_outputs_that_are_kept(name):
    assert ensembles.outputs_that_differ(name) == [], f"of an earlier version: scripts/remake {name}"


@pytest.mark.parametrize("name", sorted(EARLIER))
def test_what_is_of_an_earlier_version_is_said_to_be_where_it_is_shown(name):
    pages = [path.read_text(encoding="utf-8") for path in (ROOT / "docs").glob("*.md")]
    shown = [text for page in pages for text in page.split("\n\n") if f"{name}.toml)" in text and "They are" in text]
    assert shown and all("of an earlier version of the program" in " ".join(text.split()) for text in shown)


@pytest.mark.parametrize(
    ("kept", "again", "differ"),
    [
        (1.0, 1.0 + 1e-7, False),
        (4.2, 4.2 + 1e-4, True),
        (None, None, False),
        (None, 4.2, True),
        (True, False, True),
        ("done", "done", False),
    ],
)
def test_only_rounding_makes_no_other_run(kept, again, differ):
    assert ensembles.is_another(kept, again) is differ
