# SPDX-License-Identifier: GPL-3.0-or-later
"""Work that takes turns with Blender's window."""

import threading
import time

import pytest

from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.ui.modal_task import SteppedThread

PARTS = 4


def counted(turns):
    turns.stage("counting")
    for number in range(1, PARTS + 1):
        turns.part(number, PARTS)
    return "counted"


def test_it_goes_on_from_part_to_part_and_gives_what_comes_of_it():
    turns, seen = SteppedThread(counted), []
    while not turns.is_finished:
        turns.step()
        seen.append((turns.stage_text, turns.done))
    assert seen == [("counting", 0), *[("counting", number) for number in range(1, PARTS + 1)], ("counting", PARTS)]
    assert turns.outcome() == "counted"
    turns.step()
    assert turns.outcome() == "counted"


def test_short_parts_are_one_step_and_long_ones_are_not():
    lasts_s = [0.0, 0.0, 0.06, 0.0, 0.06]

    def work(turns):
        for number, part_s in enumerate(lasts_s, start=1):
            time.sleep(part_s)
            turns.part(number, len(lasts_s))

    turns, seen = SteppedThread(work, shortest_s=0.05), []
    while not turns.is_finished:
        turns.step()
        seen.append(turns.done)
    assert seen == [3, 5, 5]


def test_it_never_works_while_it_is_not_its_turn():
    at_work = []

    def work(turns):
        for number in range(1000):
            at_work.append(True)
            at_work.pop()
            turns.part(number, 1000)

    turns = SteppedThread(work)
    for _ in range(500):
        turns.step()
        assert at_work == []
    turns.stop()


def test_stopping_ends_it_where_it_is_and_its_files_are_closed(tmp_path):
    ended = []

    def work(turns):
        try:
            turns.part(1, 2)
            ended.append("not stopped")
        except Exception:
            ended.append("swallowed")
        finally:
            ended.append("cleaned up")

    before = threading.active_count()
    turns = SteppedThread(work)
    turns.step()
    turns.stop()
    deadline = time.monotonic() + 10.0
    while threading.active_count() > before and time.monotonic() < deadline:
        time.sleep(0.01)
    assert ended == ["cleaned up"] and turns.is_finished and threading.active_count() == before


def test_stopping_before_it_began_starts_nothing():
    turns = SteppedThread(lambda _turns: pytest.fail("it ran"))
    turns.stop()
    assert turns.is_finished and turns.outcome() is None


def test_an_error_is_raised_where_the_outcome_is_asked_for():
    def work(turns):
        turns.stage("writing")
        raise OutputError("the disk is full")

    turns = SteppedThread(work)
    while not turns.is_finished:
        turns.step()
    with pytest.raises(OutputError, match="the disk is full"):
        turns.outcome()
