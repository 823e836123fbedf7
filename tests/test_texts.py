# SPDX-License-Identifier: GPL-3.0-or-later
"""Texts are English strings that keep what they are made of: in copies, in drawings, and in files."""

import copy
import json
import pickle

import pytest
from matplotlib.figure import Figure

from bridge_demolition_addon.texts import UP, Quantity, Text, Unit, joined, of_stored, read, stored

TEXT = Text("{} flew {}", "Shard 3", Quantity(8.3, "m", ".1f", UP))


def test_a_text_is_an_english_string_in_si_units():
    assert TEXT == "Shard 3 flew 8.3 m" and Text("as it {is}") == "as it {is}"
    assert joined("{}, {}", "abc") == "a, b, c" and joined("{}, {}", []) == ""
    assert Text("no limit").capital == "No limit"


@pytest.mark.parametrize(
    "copied",
    [
        copy.deepcopy,
        lambda text: pickle.loads(pickle.dumps(text)),
        lambda text: of_stored(json.loads(json.dumps(stored(text)))),
        str,
    ],
)
def test_copies_keep_what_it_is_made_of(copied):
    own = copied(TEXT)
    assert own == TEXT and own.pattern == TEXT.pattern
    name, distance = own.values
    assert (name, distance.number, distance.unit, distance.rounding) == ("Shard 3", "8.3", "m", UP)


def test_drawings_keep_it():
    axes = Figure().subplots()
    axes.set_xlabel(Text("throw ({})", Unit("m")))
    assert axes.xaxis.get_label_text().values == ("m",)


def test_a_text_of_a_file_is_read_by_the_patterns_it_was_written_by():
    patterns = ("{} of {} connections", "removal of {}")
    assert read("saw cut of 4 connections", patterns).values == ("saw cut", "4")
    assert read("removal of pier <1>", patterns).values == ("pier <1>",)
    assert read("as it was built", patterns).values == ()
