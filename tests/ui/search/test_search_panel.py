"""The panel Search: a search that runs beside Blender, is stopped and gone on with, and tells what it found."""

import json
import time
from dataclasses import replace
from types import SimpleNamespace

import pytest
from support.panel_layouts import Layout, without_blender
from support.scenarios import SHORT_RUN

from bridge_demolition_addon.model.scenario import BlastSettings, Charge
from bridge_demolition_addon.model.study.runs_table import read_runs
from bridge_demolition_addon.ui.scenario.values import show_scenario
from bridge_demolition_addon.ui.search import session
from bridge_demolition_addon.ui.search.operator import shown_search
from bridge_demolition_addon.ui.search.ui import CLASSES

PATIENCE_S = 300.0
VERY_SHORT = replace(SHORT_RUN, time=replace(SHORT_RUN.time, duration_s=0.1))


@pytest.fixture
def panel(extension, tmp_path):
    """The settings of a scene that shows a search along a drop that never brings the bridge down."""
    settings = extension.context.scene.bda
    show_scenario(settings, VERY_SHORT)
    settings.search_directory, settings.study_jobs = str(tmp_path / "search"), 1
    settings.search_quantity = "DROP_HEIGHT"
    settings.search_lowest, settings.search_highest, settings.search_trials = 0.05, 0.1, 10
    return settings


def look_in_until(is_over):
    """Do what Blender's timer does, as there is none without a window."""
    began = time.monotonic()
    while not is_over():
        assert time.monotonic() - began < PATIENCE_S
        session.look_in()
        assert session.why_ended() == ""
        time.sleep(0.02)


def drawn(blender):
    """What the panel draws: texts of labels, and names of buttons."""
    found = []

    class Told(Layout):
        def label(self, **settings):
            found.append(settings["text"])

        def operator(self, name, **settings):
            found.append(name)
            return super().operator(name, **settings)

    context = SimpleNamespace(
        scene=blender.context.scene,
        region=SimpleNamespace(width=100_000),  # a sentence on a line
        preferences=SimpleNamespace(system=SimpleNamespace(ui_scale=1.0)),
    )
    for panel in CLASSES:
        without_blender(panel)(Told(context)).draw(context)
    return found


def test_a_search_is_stopped_gone_on_with_and_told(blender, panel, tmp_path):
    ops, folder = blender.ops.bda, tmp_path / "search"
    assert "bda.start_search" in drawn(blender) and not ops.stop_search.poll() and not ops.open_search_curve.poll()
    assert ops.start_search() == {"FINISHED"}
    assert not ops.start_search.poll() and "bda.stop_search" in drawn(blender)
    look_in_until(lambda: session.search_at_work().run.done >= 1)
    assert ops.stop_search() == {"FINISHED"}
    kept = read_runs(folder / "trials.csv")
    assert session.search_at_work() is None and len(kept) >= 1

    assert ops.start_search() == {"FINISHED"}
    look_in_until(lambda: session.search_at_work() is None)
    table = read_runs(folder / "trials.csv")
    assert table.rows[: len(kept)] == kept.rows and len(table) == 8
    heights = [row.inputs["ball.drop_height_m"] for row in table.rows]
    assert all(0.05 <= each <= 0.1 for each in heights) and len(set(heights)) > 1
    assert json.loads((folder / "search.json").read_text(encoding="utf-8"))["successes"] == 0
    told = drawn(blender)
    assert "0 of 8 trials met all criteria: the criteria were never met in the range." in told
    assert "bda.open_search_curve" in told and (folder / "curve.png").stat().st_size > 0
    session.unregister()
    assert session.found_by_search() is None


def test_what_the_panel_shows_is_what_is_asked(panel):
    asked = shown_search(panel)
    assert (asked.settings.key, asked.settings.lowest, asked.settings.highest) == ("ball.drop_height_m", 0.05, 0.1)
    assert (asked.settings.factor, asked.settings.trials) == (False, 10)
    assert [each.kind for each in asked.settings.criteria] == ["collapsed"]
    charge = Charge(name="one", place_m=(6.0, 0.0, 1.0), mass_kg=20.0)
    show_scenario(panel, replace(SHORT_RUN, ball=None, charges=(charge,), blast=BlastSettings(start_s=0.1)))
    panel.search_quantity, panel.search_criterion, panel.search_span = "CHARGES", "SPAN_DOWN", 1
    asked = shown_search(panel)
    assert asked.settings.factor and asked.trial(1, 0.1).scenario.charges[0].mass_kg == pytest.approx(2.0)
    assert [(each.kind, each.span) for each in asked.settings.criteria] == [("span down", 1)]


@pytest.mark.parametrize(
    "change, message",
    [
        ({"search_quantity": "CHARGES"}, "the scenario has no charges that go off"),
        ({"search_lowest": 0.2}, "expected more than search.lowest"),
        ({"search_criterion": "SPAN_DOWN", "search_span": 3}, "expected a whole number up to 1"),
        ({"search_criterion": "AS_IN_STUDY"}, r"at least one table \[\[criteria\]\]"),
    ],
)
def test_a_search_that_cannot_run_is_refused_with_a_sentence(blender, panel, tmp_path, change, message):
    for name, value in change.items():
        setattr(panel, name, value)
    with pytest.raises(RuntimeError, match=message):
        blender.ops.bda.start_search()
    assert session.search_at_work() is None and not (tmp_path / "search").exists()


def test_without_a_folder_there_is_no_search(blender, panel):
    panel.search_directory = ""
    assert not blender.ops.bda.start_search.poll()
