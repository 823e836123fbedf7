# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel Study: a study that runs beside Blender, is paused, stopped and gone on with, and shown."""

import sys
import time

import numpy as np
import pytest
from support.checkout import ROOT
from support.ensemble_panels import PATIENCE_S, drawn, look_in_until
from support.scenarios import SHORT_RUN

import bridge_demolition_addon
from bridge_demolition_addon.model.scenario.file import scenario_text
from bridge_demolition_addon.model.study.file import study_of
from bridge_demolition_addon.model.study.runs_table import read_runs
from bridge_demolition_addon.model.study.sampled_runs import sampled_run
from bridge_demolition_addon.model.study.settings import StudySettings, Vary
from bridge_demolition_addon.studies.run_process import RunLimits, RunProcess
from bridge_demolition_addon.studies.run_program import run_program_command
from bridge_demolition_addon.studies.versions import versions_with
from bridge_demolition_addon.ui.ensemble import session
from bridge_demolition_addon.ui.ensemble import study as sidebar
from bridge_demolition_addon.ui.ensemble.study import WORK, shown_study
from bridge_demolition_addon.ui.scenario.values import show_scenario, show_table

HEIGHT = Vary(key="ball.drop_height_m", distribution="uniform", lowest=0.05, highest=2.0)
FEW = StudySettings(
    scenario="scenario_as_run.toml", runs=3, quantile=0.5, confidence=0.5, rank=1, seed=7, vary=(HEIGHT,)
)


@pytest.fixture
def panel(extension, tmp_path):
    """The settings of a scene that shows a small study, with a folder for it."""
    settings = extension.context.scene.bda
    show_scenario(settings, SHORT_RUN)
    show_table(settings.study, FEW)
    settings.study_directory, settings.study_jobs = str(tmp_path / "study"), 1
    return settings


@pytest.mark.long
def test_a_study_that_runs_beside_blender_is_paused_stopped_gone_on_with_and_shown(blender, panel, tmp_path):
    ops = blender.ops.bda
    assert ops.start_study() == {"FINISHED"}
    assert not ops.start_study.poll()
    look_in_until(WORK, lambda: WORK.session.planner.done >= 1)
    assert ops.pause_study() == {"FINISHED"}
    run = WORK.session
    assert not ops.pause_study.poll() and ops.resume_study.poll()
    # Capacity is one more than the draws at a time: all three may be begun by now, and no more are.
    assert ops.resume_study() == {"FINISHED"}
    assert not run.is_paused
    assert ops.stop_study() == {"FINISHED"}
    assert WORK.session is None
    kept = read_runs(tmp_path / "study" / "runs.csv")
    assert 1 <= len(kept) <= 3

    assert ops.start_study() == {"FINISHED"}
    look_in_until(WORK)
    assert WORK.why_ended == ""
    table = read_runs(tmp_path / "study" / "runs.csv")
    study = study_of(FEW, SHORT_RUN)
    assert table.rows[: len(kept)] == kept.rows
    assert [dict(row.inputs) for row in table.rows] == [sampled_run(study, number).inputs for number in (1, 2, 3)]
    assert {row.status for row in table.rows} == {"done"}
    assert (tmp_path / "study" / "study.json").exists()

    shown = WORK.result
    farthest = max(row.outputs["reach_m"] for row in table.rows)
    assert f"within {np.ceil(farthest * 10.0) / 10.0:.1f} m" in shown.sentences[0]
    # The line goes around the bridge at the distance to keep: that distance by the factor for runout, and the buffer;
    # corners of its arcs lie up to 0.13 % outside of the circle.
    kept = 1.82 * farthest + SHORT_RUN.exclusion.buffer_m
    line = shown.limit_lines[:, 0].max() - shown.runs.bridge.bounds()[2]
    assert kept - 1e-3 <= line <= 1.0013 * kept + 1e-3
    assert len(shown.triangles[0]) == len(shown.triangles[1]) > 0

    worst = max(table.rows, key=lambda row: row.outputs["reach_m"])
    assert ops.open_worst_draw() == {"FINISHED"}
    assert panel.built_scenario == scenario_text(sampled_run(study, worst.number).scenario)
    assert panel.scenario.ball.drop_height_m == pytest.approx(worst.inputs["ball.drop_height_m"])
    assert blender.context.scene.rigidbody_world
    bodies = len(blender.context.scene.rigidbody_world.collection.objects)
    assert ops.open_worst_draw() == {"FINISHED"}  # in place of what was built
    assert len(blender.context.scene.rigidbody_world.collection.objects) == bodies


@pytest.mark.long
def test_a_study_of_which_no_draw_finishes_says_so_and_frees_its_folder(blender, panel, tmp_path):
    panel.study.use_time_limit_s, panel.study.time_limit_s = True, 1e-3
    blender.ops.bda.start_study()
    look_in_until(WORK)
    assert {row.status for row in read_runs(tmp_path / "study" / "runs.csv").rows} == {"timed_out"}
    shown = WORK.result
    assert shown.sentences[0].startswith("These runs set no limit: 3 of 3 did not finish")
    assert len(shown.triangles[0]) == len(shown.limit_lines) == 0
    with pytest.raises(RuntimeError, match="No run of this study finished"):
        blender.ops.bda.open_worst_draw()
    assert blender.ops.bda.start_study() == {"FINISHED"}  # the folder is free
    look_in_until(WORK)


def test_a_folder_of_another_study_is_refused_and_kept(blender, panel, tmp_path):
    blender.ops.bda.start_study()
    blender.ops.bda.stop_study()
    before = (tmp_path / "study" / "study.toml").read_bytes()
    panel.study.seed = 8
    with pytest.raises(RuntimeError, match="was begun with another study or scenario"):
        blender.ops.bda.start_study()
    assert (tmp_path / "study" / "study.toml").read_bytes() == before
    assert WORK.session is None


@pytest.mark.parametrize(
    "change, message",
    [
        (lambda study: setattr(study.vary[0], "key", "ball.height"), "ball.height is unknown"),
        (lambda study: setattr(study.vary[0], "lowest", -1.0), r"a run may sample ball\.drop_height_m = -1"),
    ],
)
def test_a_study_that_cannot_run_is_refused_with_a_sentence(blender, panel, tmp_path, change, message):
    change(panel.study)
    with pytest.raises(RuntimeError, match=message):
        blender.ops.bda.start_study()
    assert not (tmp_path / "study").exists()
    assert WORK.session is None


def test_a_folder_without_a_study_is_refused(blender, panel, tmp_path):
    with pytest.raises(RuntimeError, match=r"expected the folder of a study, with study\.toml in it"):
        blender.ops.bda.show_study()
    panel.study_directory = ""
    assert not blender.ops.bda.show_study.poll()
    assert not blender.ops.bda.open_worst_draw.poll()
    assert blender.ops.bda.start_study.poll()  # it begins in a new folder


def test_a_study_file_is_shown_with_its_scenario(blender, panel, tmp_path):
    study = study_of(FEW, SHORT_RUN)
    (tmp_path / "study.toml").write_text(study.text, encoding="utf-8")
    (tmp_path / "scenario_as_run.toml").write_text(study.scenario_text, encoding="utf-8")
    show_table(panel.study, StudySettings(scenario="none.toml"))
    panel.study_path = str(tmp_path / "study.toml")
    assert blender.ops.bda.load_study() == {"FINISHED"}
    assert shown_study(panel).text == study.text
    panel.study_path = str(tmp_path / "missing.toml")
    with pytest.raises(RuntimeError, match=r"missing\.toml: no such file"):
        blender.ops.bda.load_study()


@pytest.mark.long
@pytest.mark.skipif(sys.platform == "win32", reason="the launcher is a script of Unix")
def test_draws_run_in_blenders_own_program_where_there_is_one(blender, tmp_path):
    """The launcher takes Blender's arguments as Blender does, and is no Python that knows this package."""
    launcher = tmp_path / "blender"
    script = f"import sys; sys.path.remove({str(ROOT)!r}); exec(sys.argv[sys.argv.index('--python-expr') + 1])"
    launcher.write_text(
        f'#!/bin/sh\n[ "$1 $2" = "--background --factory-startup" ] || exit 3\n'
        f'PYTHONPATH={ROOT} exec "{sys.executable}" -c "{script}" "$@"\n'
    )
    launcher.chmod(0o755)
    versions = versions_with(".".join(map(str, blender.app.version)))
    study = study_of(FEW, SHORT_RUN)
    process = RunProcess(run_program_command(str(launcher)), versions, RunLimits(PATIENCE_S))
    try:
        end = process.play(sampled_run(study, 1).request, tmp_path / "draw")
    finally:
        process.close()
    assert (end.status, end.reason) == ("done", "")
    assert end.outputs["reach_m"] >= 0.0


def test_the_panels_show_what_varies_the_course_and_the_findings_and_those_of_a_folder(blender, panel):
    assert {"bda.start_study", "1  ball.drop_height_m"} <= set(drawn(blender, sidebar))
    blender.ops.bda.start_study()
    running = drawn(blender, sidebar)
    assert {"0 of 3 runs", "bda.pause_study", "bda.stop_study"} <= set(running)
    assert "bda.start_study" not in running
    assert running.index("bda.stop_study") < running.index("0 of 3 runs")  # lines that come move no button
    blender.ops.bda.pause_study()
    assert {"0 of 3 runs, paused", "bda.resume_study"} <= set(drawn(blender, sidebar))
    blender.ops.bda.resume_study()
    look_in_until(WORK)
    found = drawn(blender, sidebar)
    assert found[-len(WORK.result.sentences) - 2 : -2] == list(WORK.result.sentences)
    assert found[-2:] == ["show_study", "bda.open_worst_draw"]
    whose = "This result is of other values than the panels show"
    assert not any(text.startswith(whose) for text in found)
    panel.scenario.ball.mass_kg += 1000.0
    assert any(text.startswith(whose) for text in drawn(blender, sidebar))
    panel.scenario.ball.mass_kg -= 1000.0

    session.unregister()
    assert WORK.result is None
    assert blender.ops.bda.show_study() == {"FINISHED"}
    assert len(WORK.result.runs.table) == 3


@pytest.mark.long
def test_the_panels_say_why_a_study_ended_before_its_end(blender, panel, tmp_path):
    blender.ops.bda.start_study()
    draws = tmp_path / "study" / "draws"
    draws.rename(tmp_path / "elsewhere")
    draws.write_text("a file where draws are to be kept")
    began = time.monotonic()
    while WORK.session:
        assert time.monotonic() - began < PATIENCE_S
        session.look_in()
        time.sleep(0.05)
    assert str(draws) in WORK.why_ended
    assert WORK.why_ended in drawn(blender, sidebar)


def test_switching_the_extension_off_ends_a_study(blender, tmp_path):
    bridge_demolition_addon.register()
    settings = blender.context.scene.bda
    show_scenario(settings, SHORT_RUN)
    show_table(settings.study, FEW)
    settings.study_directory = str(tmp_path / "study")
    blender.ops.bda.start_study()
    session.look_in()
    bridge_demolition_addon.unregister()
    assert WORK.session is None
    # Nobody holds the folder any more.
    assert read_runs(tmp_path / "study" / "runs.csv") is not None


@pytest.mark.long
def test_a_study_of_two_runs_states_no_limit_yet_and_is_raised_to_four(blender, panel, tmp_path):
    panel.study.runs, panel.study.confidence = 2, 0.9
    assert blender.ops.bda.start_study() == {"FINISHED"}
    look_in_until(WORK)
    assert WORK.result.sentences[0].startswith("Too few runs for a limit yet: it needs 4 runs, has 2.")
    assert len(WORK.result.limit_lines) == 0 and len(WORK.result.triangles[0]) > 0
    kept = read_runs(tmp_path / "study" / "runs.csv")
    panel.study.runs = 4
    assert blender.ops.bda.start_study() == {"FINISHED"}
    look_in_until(WORK)
    table = read_runs(tmp_path / "study" / "runs.csv")
    assert len(kept) == 2 and len(table) == 4 and table.rows[:2] == kept.rows
    assert WORK.result.sentences[0].startswith("In 4 independent runs") and len(WORK.result.limit_lines) > 0
