# SPDX-License-Identifier: GPL-3.0-or-later
"""What a run says of bars that held in it, by its summary."""

from bridge_demolition_addon.model.run_folder.summary import RunSummary
from bridge_demolition_addon.model.sequence.ending import bare_bars_text, doubts_of_run


def fired(zone, pressed_n, folded_m=0.0):
    """A zone whose bars may be counted on for 316 kN."""
    bars = {"cage_compression_n": 316e3, "cage_pressed_n": pressed_n, "cage_folded_m": folded_m}
    return {"kind": "blast zone", "zone": zone, **bars}


def events_of(*events):
    """Events as a summary gives them back."""
    return RunSummary.of({"events": list(events)}).events


def test_bars_that_hold_more_than_may_be_counted_on_are_told():
    events = [fired("P1.1", 379.2e3), fired("P1.2", 300e3), fired("P2.1", 386e3, 0.4), fired("P3.1", 347.6e3, 1e-9)]
    told = bare_bars_text(events_of(*events, {"kind": "removal"}))
    assert told.startswith(
        "Bare bars of P1.1, P3.1 held though they were pressed with up to 1.20 times what may be counted"
    )
    assert doubts_of_run(RunSummary.of({"events": events})) == (told,)


def test_nothing_is_told_of_bars_that_fold_or_hold_what_they_may():
    assert bare_bars_text(events_of(fired("P1.2", 300e3), fired("P2.1", 386e3, 0.4), {"kind": "removal"})) == ""
    assert bare_bars_text(()) == ""
