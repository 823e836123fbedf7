# SPDX-License-Identifier: GPL-3.0-or-later
"""Preview While Dragging: a coarse run beside Blender of what the panels show, of which nothing gets into the scene."""

import os
import time
from dataclasses import replace

import numpy as np
import pytest
from support.processes import is_alive
from support.sample_results import hanging_chain
from support.scenarios import SHORT_RUN

import bridge_demolition_addon
from bridge_demolition_addon.display.preview_outcome import PreviewOutcome
from bridge_demolition_addon.model.scenario.file import scenario_text
from bridge_demolition_addon.model.study.preview_scenario import ALIKE_PERCENT
from bridge_demolition_addon.studies.preview_process import Preview

pytestmark = pytest.mark.slow

PATIENCE_S = 300.0


@pytest.fixture
def beside(extension):
    from bridge_demolition_addon.ui.preview.run_beside import beside

    return beside


@pytest.fixture
def shown(extension, beside):
    """Settings that show a short run, of which previews are made."""
    from bridge_demolition_addon.ui.scenario.values import show_scenario

    settings = extension.context.scene.bda
    show_scenario(settings, SHORT_RUN)
    settings.preview_run = True
    return settings


def said():
    from bridge_demolition_addon.ui.preview.run_beside import sentences

    return sentences()


def follow_to_end(beside, settings):
    """Look as often as Blender does, until the preview is over."""
    until = time.monotonic() + PATIENCE_S
    while time.monotonic() < until:
        beside.look()
        beside.follow(settings)
        if beside.shown and beside.shown.is_over and not beside.is_of_before:
            return beside.shown
        time.sleep(0.02)
    raise TimeoutError


def everything(blender):
    kinds = ("scenes", "objects", "meshes", "materials", "collections", "actions", "worlds")
    return {kind: [data.name for data in getattr(blender.data, kind)] for kind in kinds}


def test_it_is_off_at_first_and_no_process_runs(extension, beside, settings):
    assert settings.preview_run is False and not beside.is_on
    assert beside.process is None and said() == []


@pytest.mark.long
def test_what_is_dragged_is_run_and_nothing_of_it_gets_into_the_scene(shown, beside, extension):
    before, text = everything(extension), scenario_text(SHORT_RUN)
    first = follow_to_end(beside, shown)
    assert first.outcome.shards == 10
    assert said()[0] == "Preview in 10 shards: one coarse run, no forecast"
    assert said()[-1].startswith("The run ended after 0.5 s")
    process_id = beside.process.process_id
    assert extension.ops.bda.drag_handle(kind="TARGET", position_m=(4.0, 1.0, 0.0)) == {"FINISHED"}
    assert beside.follow(shown) and beside.is_of_before
    assert said()[-1] == "These are the values before; a new run goes on"
    assert not beside.follow(shown)  # nothing has changed since
    second = follow_to_end(beside, shown)
    assert second is not first and beside.process.process_id == process_id
    assert everything(extension) == before
    assert scenario_text(SHORT_RUN) == text and not shown.built_scenario
    assert "preview_run" not in shown.keys()  # noqa: SIM118, Blender's own


def test_it_says_what_elastic_previews_are_worth_and_what_still_falls(shown, beside):
    chain = hanging_chain()
    velocities = chain.frames.velocities_m_s.copy()
    positions_m = chain.frames.positions_m.copy()
    positions_m[-1, 2], velocities[-1, 2] = (0.0, 0.0, 12.0), (0.0, 0.0, -5.0)
    flying = replace(chain, frames=replace(chain.frames, positions_m=positions_m, velocities_m_s=velocities))
    edges_m = [np.zeros((2, 3))] * 2
    rigid, elastic = (PreviewOutcome.of(flying, edges_m, 2.0, is_elastic=is_elastic) for is_elastic in (False, True))
    beside.shown = Preview(elastic, False)
    trust, fall = f"{ALIKE_PERCENT} % of spans fell or stood alike", "1 still fall: shown where they would land"
    assert trust in said()[1] and said()[3].startswith(fall)
    beside.shown = Preview(rigid, False)
    assert trust not in "".join(said()) and said()[2].startswith(fall)
    stands = replace(elastic, fallen=0, falling=0)
    for is_over, is_said in ((False, False), (True, True)):  # so far is no outcome yet
        beside.shown = Preview(stands, is_over)
        assert (trust in said()[1]) == is_said


@pytest.mark.long
def test_what_was_shown_before_needs_no_run(shown, beside, extension):
    first = follow_to_end(beside, shown)
    extension.ops.bda.drag_handle(kind="TARGET", position_m=(4.0, 1.0, 0.0))
    follow_to_end(beside, shown)
    beside.end()
    shown.scenario.ball.target_m = SHORT_RUN.ball.target_m
    assert beside.follow(shown)
    assert beside.shown is first and beside.process is None


def test_faults_are_said_in_a_sentence(shown, beside):
    shown.scenario.ball.target_m = (900.0, 0.0)
    assert follow_to_end(beside, shown).outcome is None
    (sentence,) = said()
    assert sentence.startswith("No preview: ball.target_m")
    shown.scenario.ball.use_target_m = False  # not even a scenario
    assert beside.follow(shown)
    (sentence,) = said()
    assert sentence.startswith("No preview: ") and "ball" in sentence
    assert not beside.is_running and not beside.follow(shown)


@pytest.mark.long
def test_the_process_ends_with_the_switch_with_undo_and_with_another_file(shown, beside, extension):
    def running():
        follow_to_end(beside, shown)
        return beside.process.process_id

    first = running()
    shown.preview_run = False
    assert not is_alive(first) and beside.shown is None and said() == []
    shown.preview_run = True
    second = running()
    extension.ops.ed.undo_push(message="before")
    extension.ops.ed.undo_push(message="after")
    extension.ops.ed.undo()
    assert not is_alive(second) and beside.is_on
    beside.forget()
    third = running_again(beside, extension.context.scene.bda)
    extension.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    assert not is_alive(third) and not beside.is_on and not extension.context.scene.bda.preview_run


def running_again(beside, settings):
    """Number of the process that runs what the settings show, which undo may have changed."""
    follow_to_end(beside, settings)
    return beside.process.process_id


@pytest.mark.long
def test_switching_the_extension_off_leaves_nothing(shown, beside, extension):
    from bridge_demolition_addon.ui.preview import run_beside

    follow_to_end(beside, shown)
    process_id = beside.process.process_id
    assert extension.app.timers.is_registered(run_beside.look_in)
    bridge_demolition_addon.unregister()
    try:
        assert not is_alive(process_id) and beside.process is None and not beside.is_on
        assert not extension.app.timers.is_registered(run_beside.look_in)
        ours = [
            handler
            for name in ("undo_pre", "redo_pre", "load_pre")
            for handler in getattr(extension.app.handlers, name)
            if handler.__module__ == run_beside.__name__
        ]
        assert ours == []
    finally:
        bridge_demolition_addon.register()


@pytest.mark.long
def test_the_timer_never_raises_and_ends_with_the_switch(shown, beside):
    from bridge_demolition_addon.ui.preview.run_beside import LOOK_EVERY_S, look_in

    assert look_in() == LOOK_EVERY_S
    follow_to_end(beside, shown)
    os.kill(beside.process.process_id, 9)
    until = time.monotonic() + PATIENCE_S
    while beside.process.process_id is not None and time.monotonic() < until:
        assert look_in() == LOOK_EVERY_S
        time.sleep(0.02)
    assert said()[0].startswith("No preview: the process of the preview ended with status")
    shown.preview_run = False
    assert look_in() is None
