# SPDX-License-Identifier: GPL-3.0-or-later
"""Free motions of a file's bearings as kinds of bearings."""

import pytest

from bridge_demolition_addon.ifc.bearings import BearingElement, bearing_tables

NAMES = ("pier cap", "girder 1", "girder 2")
ROTATES = ("turn x", "turn y", "turn z")


@pytest.mark.parametrize(
    ("free", "kind", "pads", "friction"),
    [
        ((), "fixed", None, None),
        (("turn y",), "pinned", None, None),
        (("turn x", "turn y"), "pinned", None, None),
        (ROTATES, "pinned", 1, None),
        (("move x", "turn y"), "rocker", None, None),
        (("move x", "move y", *ROTATES), "sliding", 1, 0.0),
    ],
)
def test_what_is_free_says_the_kind(free, kind, pads, friction):
    tables = bearing_tables([BearingElement(0, (1, 2), free, "")], NAMES)
    assert [bearing.members for bearing in tables.bearings] == [("girder 1", "pier cap"), ("girder 2", "pier cap")]
    assert {(bearing.kind, bearing.pads, bearing.friction) for bearing in tables.bearings} == {(kind, pads, friction)}
    assert not tables.connections
    assert tables.members == set(NAMES)


@pytest.mark.parametrize("free", [("move y", "turn y"), ("turn x",), ("move x",)])
def test_what_no_kind_of_bearing_is_stays_a_connection(free):
    tables = bearing_tables([BearingElement(0, (1,), free, "")], NAMES)
    assert not tables.bearings
    assert [(rule.members, rule.free) for rule in tables.connections] == [(("girder 1", "pier cap"), free)]


def test_bearings_between_two_members_that_differ_are_noted():
    two = [BearingElement(0, (1,), ("turn y",), ""), BearingElement(0, (1,), ROTATES, "")]
    tables = bearing_tables(two, NAMES)
    assert [bearing.kind for bearing in tables.bearings] == ["pinned"]
    assert tables.notes == ("bearings between girder 1 and pier cap differ: the first counts for all of them",)
