# SPDX-License-Identifier: GPL-3.0-or-later
"""Work that goes on in the window in steps: it is finished, stopped with Esc, refused, or ended with the extension."""

from types import SimpleNamespace

import pytest

from bridge_demolition_addon.errors import SimulationError
from bridge_demolition_addon.ui import task_progress
from bridge_demolition_addon.ui.messages import clear_all, messages_of
from bridge_demolition_addon.ui.modal_task import ModalTask, RenderingTask

TICK, ESC, MOUSE, KEY = (SimpleNamespace(type=name) for name in ("TIMER", "ESC", "MOUSEMOVE", "A"))


class Manager:
    """A window manager that only notes which timers there are."""

    def __init__(self):
        self.timers = []

    def event_timer_add(self, seconds, window):
        self.timers.append(seconds)
        return seconds

    def event_timer_remove(self, timer):
        self.timers.remove(timer)

    def __getattr__(self, _name):
        return lambda *_arguments: None


class Reporting:
    """What Blender gives an operator."""

    bl_label = "Count"
    options = SimpleNamespace(is_invoke=False)

    def __init__(self):
        self.reports = []

    def report(self, level, text):
        self.reports.append((*level, text))


class Counting(Reporting, ModalTask):
    """Counts to three; `error` ends it at two."""

    task, unit = "Counting", "numbers"
    error = None

    def work(self, _context):
        def count(thread):
            thread.stage("up")
            for number in (1, 2, 3):
                thread.part(number, 3)
                if self.error and number == 2:
                    raise self.error
            return "Counted to 3"

        return count


class Painting(Reporting, RenderingTask):
    """Makes two pictures."""

    def begin(self, _context):
        self.closed = False
        self._pictures = self.pictures()
        return 2

    def pictures(self):
        try:
            yield "one.png"
            yield "two.png"
        finally:
            self.closed = True

    def finish(self, _context):
        self.report({"INFO"}, "Painted")
        return {"FINISHED"}


@pytest.fixture
def context(blender):
    """A window without anything in it."""
    workspace = SimpleNamespace(status_text_set=lambda _text: None)
    manager = Manager()
    manager.windows = ()
    yield SimpleNamespace(window_manager=manager, window=None, workspace=workspace, scene=blender.context.scene)
    clear_all()
    task_progress.end(SimpleNamespace(window_manager=manager, workspace=None))


def ticks(task, context):
    """Results of ticks, until the task has ended."""
    while (result := task.modal(context, TICK)) == {"RUNNING_MODAL"}:
        yield task_progress.going_on().lines[0]
    yield result


def test_who_leaves_blender_meanwhile_is_told_what_to_do(context):
    task = Counting()
    task.invoke(context, None)
    for value in ("PRESS", "RELEASE"):
        assert task.modal(context, SimpleNamespace(type="Q", ctrl=True, value=value)) == {"RUNNING_MODAL"}
    assert task.reports == [("WARNING", "Counting goes on: Esc stops it, then Blender can be left")]
    task.cancel(context)


@pytest.mark.parametrize("kind, text", [(Counting, "Counted to 3"), (Painting, "Painted")])
def test_work_is_done_in_steps_and_leaves_no_timer(context, kind, text):
    task = kind()
    assert task.invoke(context, None) == {"RUNNING_MODAL"} and context.window_manager.timers == [0.005]
    *lines, result = ticks(task, context)
    assert result == {"FINISHED"} and task.reports == [("INFO", text)]
    assert len(lines) >= 2 and all(task.task in line for line in lines)
    assert context.window_manager.timers == [] and task_progress.going_on() is None


@pytest.mark.parametrize(
    "kind, text", [(Counting, "files that were written whole"), (Painting, "after 1 of 2 pictures")]
)
def test_esc_stops_it_and_says_so(context, kind, text):
    task = kind()
    task.invoke(context, None)
    task.modal(context, TICK)
    assert task.modal(context, ESC) == {"CANCELLED"}
    assert text in messages_of(context.scene)[-1].text
    assert context.window_manager.timers == [] and task_progress.going_on() is None
    assert getattr(task, "closed", True)


def test_the_view_can_be_turned_while_blender_is_not_needed(context):
    counting, painting = Counting(), Painting()
    counting.invoke(context, None)
    assert [counting.modal(context, event) for event in (MOUSE, KEY)] == [{"PASS_THROUGH"}, {"RUNNING_MODAL"}]
    counting.cancel(context)
    painting.invoke(context, None)
    assert [painting.modal(context, event) for event in (MOUSE, KEY)] == [{"RUNNING_MODAL"}, {"RUNNING_MODAL"}]
    painting.cancel(context)


def test_an_error_is_a_message(context):
    task = Counting()
    task.error = SimulationError("no two")
    task.invoke(context, None)
    *_, result = ticks(task, context)
    assert result == {"CANCELLED"} and messages_of(context.scene)[-1].text == "no two"
    assert context.window_manager.timers == [] and task_progress.going_on() is None


def test_only_one_goes_on_at_a_time(context):
    first, second = Counting(), Painting()
    first.invoke(context, None)
    assert second.invoke(context, None) == {"CANCELLED"}
    assert messages_of(context.scene)[-1].text == "Counting goes on: wait for it, or stop it with Esc"
    *lines, _ = ticks(first, context)
    assert lines[-1] == "Counting: 3 of 3 numbers"


def test_a_script_does_it_in_one_go(context):
    task = Counting()
    assert task.execute(context) == {"FINISHED"} and task.reports == [("INFO", "Counted to 3")]
    assert context.window_manager.timers == []
