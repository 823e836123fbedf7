# SPDX-License-Identifier: GPL-3.0-or-later
"""Kept studies, searches and optimisations are of the program as it is: a run of each comes out again as it was."""

import ensembles
import pytest

pytestmark = pytest.mark.long

LONG = {"drilled_two_spans", "lillebruen", "overbridge"}
"""Those of which a run takes a minute or more: `scripts/remake --check` makes one again. Tests run the beginning of the
first one's bridge, as of all examples."""


@pytest.mark.parametrize("name", sorted(set(ensembles.ENSEMBLES) - LONG))
def test_a_run_made_again_has_the_outputs_that_are_kept(name):
    assert ensembles.outputs_that_differ(name) == [], f"of an earlier version: scripts/remake {name}"


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
