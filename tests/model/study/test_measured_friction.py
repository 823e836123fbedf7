# SPDX-License-Identifier: GPL-3.0-or-later
"""Studies of examples draw friction of debris within what was measured."""

import pytest
from support.checkout import EXAMPLES

from bridge_demolition_addon.model.study.file import read_study

PUBLISHED = {"contacts.ground.friction": (0.30, 0.70), "contacts.shards.friction": (0.5, 0.7)}
"""Mass concrete on clay to sound rock, NAVFAC DM-7.02 (1986), chapter 3, table 1; very smooth to rough faces,
EN 1992-1-1:2004, 6.2.5 (2)."""


@pytest.mark.parametrize("name", ["drilled_two_spans", "lillebruen"])
def test_friction_of_debris_is_drawn_within_what_was_published(name):
    study = read_study(EXAMPLES / "studies" / f"{name}.toml")
    drawn = {varied.key.name: varied.distribution for varied in study.variations if varied.key.name in PUBLISHED}
    assert set(drawn) == set(PUBLISHED)
    for key, (lowest, highest) in PUBLISHED.items():
        assert lowest <= drawn[key].lowest < drawn[key].highest <= highest
