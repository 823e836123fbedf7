# SPDX-License-Identifier: GPL-3.0-or-later
"""The process of previews runs what it was asked last, as that scenario runs anywhere, and ends when it is to."""

import os
import sys
import time
from dataclasses import replace

import numpy as np
import pytest
from support.checkout import EXAMPLES
from support.processes import is_alive, run_program
from support.scenarios import I235, SHORT_RUN

from bridge_demolition_addon.display.bridge_preview import sharp_edges
from bridge_demolition_addon.display.preview_outcome import GAP_M, PreviewOutcome
from bridge_demolition_addon.engineering.geometry.plan_areas import without_gaps
from bridge_demolition_addon.errors import SimulationError
from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.debris.footprint import landed
from bridge_demolition_addon.model.debris.throws import debris_of
from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_from_text, scenario_text
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.study.preview_scenario import SHARDS, preview_scenario
from bridge_demolition_addon.studies.preview_process import PreviewProcess
from bridge_demolition_addon.studies.preview_program import preview_program_command

pytestmark = pytest.mark.slow

PATIENCE_S = 300.0

DRILLED = read_scenario(EXAMPLES / "drilled" / "two_spans.toml")

FALLING = replace(I235, time=replace(I235.time, duration_s=2.0), fracture=replace(I235.fracture, shards=200))
"""In more shards than a preview has."""

LONG = replace(I235, time=replace(I235.time, duration_s=500.0, stop_at_rest=False))
"""Takes minutes: nobody waits for it."""


@pytest.fixture(scope="module")
def kept():
    """One process for all tests that leave it as it is."""
    process = PreviewProcess(preview_program_command())
    yield process
    process.end()


@pytest.fixture
def process():
    process = PreviewProcess(preview_program_command())
    yield process
    process.end()


def wait_for(process, happens=lambda preview: preview.is_over):
    """All previews until one is as wanted."""
    seen, until = [], time.monotonic() + PATIENCE_S
    while time.monotonic() < until:
        if preview := process.look():
            seen.append(preview)
            if happens(preview):
                return seen
        time.sleep(0.02)
    raise TimeoutError


def durations_s(previews):
    """Simulated times of the scenarios that previews are of; one of so far may come before the last."""
    return {preview.outcome.duration_s for preview in previews}


def test_its_outcome_is_that_of_the_run_of_the_same_shards_and_seed(kept, blender, tmp_path):
    from bridge_demolition_addon.simulation.motion_run import motion_run

    kept.ask(scenario_text(FALLING))
    shown = wait_for(kept)[-1].outcome
    coarse = preview_scenario(FALLING, prepared_members(FALLING).members)
    model = checked_model(coarse)
    with motion_run(coarse, model, tmp_path) as (results, _):
        debris = debris_of(landed(results)[0])
        expected = PreviewOutcome.of(results, [sharp_edges(shard) for shard in model.shards], 2.0)
    assert shown.shards == SHARDS
    assert shown.fallen == len(debris.bodies) > 0
    assert shown.area_m2 == debris.area.area() > 0.0
    assert shown.to_json() == expected.to_json()
    corners = np.concatenate([np.asarray(ring) for ring in without_gaps(debris.area, GAP_M).to_polygons()])
    np.testing.assert_allclose(np.sort(shown.debris_lines_m[::2, 0]), np.sort(corners[:, 0]), atol=5.1e-4)


def test_a_newer_request_ends_the_older_run_and_the_same_process_answers(kept):
    kept.ask(scenario_text(SHORT_RUN))
    wait_for(kept)
    before = kept.process_id
    kept.ask(scenario_text(LONG))
    assert not wait_for(kept, lambda preview: preview.outcome is not None)[-1].is_over  # what is known so far
    began = time.monotonic()
    kept.ask(scenario_text(SHORT_RUN))
    assert durations_s(wait_for(kept)) == {SHORT_RUN.time.duration_s}
    assert time.monotonic() - began < 60.0
    assert kept.process_id == before and not kept.is_running


def test_of_several_requests_the_last_is_run(kept):
    for drop_m in (0.2, 0.3, 0.4):
        kept.ask(scenario_text(replace(SHORT_RUN, ball=replace(SHORT_RUN.ball, drop_height_m=drop_m))))
    kept.ask(scenario_text(replace(SHORT_RUN, time=replace(SHORT_RUN.time, duration_s=0.25))))
    assert durations_s(wait_for(kept)) == {0.25}


def test_what_elastic_connections_need_is_loaded_while_nothing_is_asked(blender, tmp_path):
    """By a run with bars, bearings and something that falls, which gives way at once."""
    from bridge_demolition_addon.studies.preview_program import FIRST_ELASTIC, warm_up

    scenario = scenario_from_text(FIRST_ELASTIC)
    model = checked_model(scenario)
    assert scenario.connections.is_elastic and model.bars is not None and model.bearings is not None
    assert warm_up(lambda: False, tmp_path)
    assert not warm_up(lambda: True, tmp_path)


def test_a_run_is_stopped_and_the_process_stays(kept):
    kept.ask(scenario_text(LONG))
    wait_for(kept, lambda preview: preview.outcome is not None)
    kept.stop()
    assert not kept.is_running and is_alive(kept.process_id)
    kept.ask(scenario_text(SHORT_RUN))
    assert durations_s(wait_for(kept)) == {SHORT_RUN.time.duration_s}


def test_a_scenario_that_cannot_be_run_gives_a_sentence(kept):
    no_such_member = replace(DRILLED, blast_zones=(replace(DRILLED.blast_zones[0], member="pier 9"),))
    kept.ask(scenario_text(no_such_member))
    (preview,) = wait_for(kept)
    assert preview.outcome is None and preview.is_over and "pier 9" in preview.reason
    assert "\n" not in preview.reason
    kept.ask(scenario_text(SHORT_RUN))  # it goes on
    assert wait_for(kept)[-1].outcome


def test_it_ends_at_once_and_leaves_nothing(process, tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    process.ask(scenario_text(LONG))
    wait_for(process, lambda preview: preview.outcome is not None)
    before = process.process_id
    assert list(tmp_path.iterdir())
    process.end()
    assert process.process_id is None and not is_alive(before)
    assert not list(tmp_path.iterdir())
    process.end()  # again


@pytest.mark.long
@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no signals")
def test_a_process_that_crashes_is_said_and_replaced(process):
    process.ask(scenario_text(LONG))
    wait_for(process, lambda preview: preview.outcome is not None)
    os.kill(process.process_id, 9)
    with pytest.raises(SimulationError, match="the process of the preview ended with status -9"):
        wait_for(process)
    process.ask(scenario_text(SHORT_RUN))
    assert wait_for(process)[-1].outcome


def test_a_program_that_is_not_there_is_said(tmp_path):
    with pytest.raises(SimulationError, match="no_blender"):
        PreviewProcess([str(tmp_path / "no_blender")]).ask(scenario_text(SHORT_RUN))


@pytest.mark.long
@pytest.mark.skipif(sys.platform != "linux", reason="looks at the processes of Linux")
def test_it_ends_with_the_process_that_asked(tmp_path):
    path = tmp_path / "long.toml"
    path.write_text(scenario_text(LONG), encoding="utf-8")
    folder = tmp_path / "temporary"
    folder.mkdir()
    asked = run_program("preview_and_die", path, TMPDIR=str(folder))
    number = int(asked.stdout)
    until = time.monotonic() + 60.0
    while is_alive(number) and time.monotonic() < until:
        time.sleep(0.1)
    assert not is_alive(number)
    assert [path.name for path in folder.iterdir() if path.name.startswith("bda-preview-")] == []
