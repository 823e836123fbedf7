# SPDX-License-Identifier: GPL-3.0-or-later
"""Free motions of a file's bearings as kinds of bearings."""

import pytest

from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.ifc.bearings import BearingElement, bearing_tables, with_one_fixed

NAMES = ("pier cap", "girder 1", "girder 2")
PAD = box((0.4, 0.4, 0.1))
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
    tables = bearing_tables([(BearingElement(0, (1, 2), PAD, free, ""), "pier cap")], NAMES)
    assert [bearing.members for bearing in tables.bearings] == [("girder 1", "pier cap"), ("girder 2", "pier cap")]
    assert {(bearing.kind, bearing.pads, bearing.friction) for bearing in tables.bearings} == {(kind, pads, friction)}
    assert not tables.connections
    assert tables.members == set(NAMES)


@pytest.mark.parametrize("free", [("move y", "turn y"), ("turn x",), ("move x",)])
def test_what_no_kind_of_bearing_is_stays_a_connection(free):
    tables = bearing_tables([(BearingElement(0, (1,), PAD, free, ""), "pier cap")], NAMES)
    assert not tables.bearings
    assert [(rule.members, rule.free) for rule in tables.connections] == [(("girder 1", "pier cap"), free)]


def test_bearings_between_two_members_that_differ_are_noted():
    two = [(BearingElement(0, (1,), PAD, free, ""), "pier cap") for free in (("turn y",), ROTATES)]
    tables = bearing_tables(two, NAMES)
    assert [bearing.kind for bearing in tables.bearings] == ["pinned"]
    assert tables.notes == ("bearings between girder 1 and pier cap differ: the first counts for all of them",)


@pytest.mark.parametrize("is_assumed", [True, False])
def test_where_the_file_says_nothing_one_support_alone_is_pinned(is_assumed):
    found = [
        (BearingElement(0, (1,), PAD, ("turn y",), "", is_assumed=is_assumed), below) for below in ("west", "east")
    ]
    free = [bearing.free for bearing, _ in with_one_fixed(found, {"west": 0.0, "east": 20.0})]
    assert free == [("turn y",), ("move x", "turn y") if is_assumed else ("turn y",)]
