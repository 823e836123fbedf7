# SPDX-License-Identifier: GPL-3.0-or-later
"""What the demonstration shows begins as the runs did whose ranges its own text tells of.

One of its study is run to its end by `test_ensemble_versions.py`.
"""

import pytest
from support.example_claims import assert_begins
from support.example_runs import begun

NAME = "drilled_two_spans"


@pytest.mark.long
def test_it_stands_until_its_first_zone_fires(session_folder):
    run = begun(NAME, session_folder)
    assert run.summary["events"][0]["zone"] == "P2.1"  # of the middle pier
    assert_begins(NAME, run)
