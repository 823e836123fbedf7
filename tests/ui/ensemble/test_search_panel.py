# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel Search: a search that runs beside Blender, is stopped and gone on with, and tells what it found."""

import json
from dataclasses import replace
from pathlib import Path

import pytest
from support.ensemble_panels import drawn, look_in_until
from support.scenarios import SHORT_RUN

from bridge_demolition_addon.model.scenario import BlastSettings, Charge
from bridge_demolition_addon.model.study.runs_table import read_runs
from bridge_demolition_addon.ui.ensemble import search as sidebar
from bridge_demolition_addon.ui.ensemble import session
from bridge_demolition_addon.ui.ensemble.search import WORK, shown_search
from bridge_demolition_addon.ui.scenario.values import show_scenario

VERY_SHORT = replace(SHORT_RUN, time=replace(SHORT_RUN.time, duration_s=0.1))


@pytest.fixture
def panel(extension, tmp_path):
    """The settings of a scene that shows a search along a drop that never brings the bridge down."""
    settings = extension.context.scene.bda
    show_scenario(settings, VERY_SHORT)
    settings.search_directory, settings.study_jobs = str(tmp_path / "search"), 1
    settings.search_quantity = "DROP_HEIGHT"
    search = settings.search
    search.lowest, search.highest, search.trials = 0.05, 0.1, 10
    return settings


@pytest.mark.long
def test_a_search_is_stopped_gone_on_with_and_told(blender, panel, tmp_path):
    ops, folder = blender.ops.bda, tmp_path / "search"
    assert "bda.start_search" in drawn(blender, sidebar)
    assert not ops.stop_search.poll() and not ops.open_search_curve.poll()
    assert ops.start_search() == {"FINISHED"}
    assert not ops.start_search.poll() and "bda.stop_search" in drawn(blender, sidebar)
    look_in_until(WORK, lambda: WORK.session.planner.done >= 1)
    assert ops.stop_search() == {"FINISHED"}
    kept = read_runs(folder / "trials.csv")
    assert WORK.session is None and len(kept) >= 1

    assert ops.start_search() == {"FINISHED"}
    look_in_until(WORK)
    table = read_runs(folder / "trials.csv")
    assert table.rows[: len(kept)] == kept.rows and len(table) == 8
    heights = [row.inputs["ball.drop_height_m"] for row in table.rows]
    assert all(0.05 <= height <= 0.1 for height in heights) and len(set(heights)) > 1
    assert json.loads((folder / "search.json").read_text(encoding="utf-8"))["successes"] == 0
    told = drawn(blender, sidebar)
    assert "0 of 8 runs met all criteria: the criteria were never met in the range." in told
    assert "bda.open_search_curve" in told and (folder / "curve.png").stat().st_size > 0
    session.unregister()
    assert WORK.result is None


def test_what_the_panel_shows_is_what_is_asked(panel):
    asked = shown_search(panel)
    assert (asked.settings.key, asked.settings.lowest, asked.settings.highest) == ("ball.drop_height_m", 0.05, 0.1)
    assert (asked.settings.factor, asked.settings.trials) == (False, 10)
    assert [criterion.kind for criterion in asked.settings.criteria] == ["collapsed"]
    charge = Charge(name="one", position_m=(6.0, 0.0, 1.0), mass_kg=20.0)
    show_scenario(panel, replace(SHORT_RUN, ball=None, charges=(charge,), blast=BlastSettings(start_s=0.1)))
    panel.search_quantity, panel.search_criterion, panel.search_span = "CHARGES", "SPAN_DOWN", 1
    asked = shown_search(panel)
    assert asked.settings.factor and asked.run_at(1, 0.1).scenario.charges[0].mass_kg == pytest.approx(2.0)
    assert [(criterion.kind, criterion.span) for criterion in asked.settings.criteria] == [("span down", 1)]


@pytest.mark.parametrize(
    "change, message",
    [
        ({"search_quantity": "CHARGES"}, "the scenario has no charges that go off"),
        ({"lowest": 0.2}, "expected more than search.lowest"),
        ({"search_criterion": "SPAN_DOWN", "search_span": 3}, "expected a whole number up to 1"),
        ({"search_criterion": "AS_IN_STUDY"}, r"at least one table \[\[criteria\]\]"),
    ],
)
def test_a_search_that_cannot_run_is_refused_with_a_sentence(blender, panel, tmp_path, change, message):
    for name, value in change.items():
        setattr(panel if name.startswith("search_") else panel.search, name, value)
    with pytest.raises(RuntimeError, match=message):
        blender.ops.bda.start_search()
    assert WORK.session is None and not (tmp_path / "search").exists()


def test_without_a_folder_it_begins_in_a_new_one(blender, panel, tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.delenv("XDG_CONFIG_HOME", raising=False)
    panel.search_directory = ""
    assert blender.ops.bda.start_search() == {"FINISHED"}
    assert Path(panel.search_directory) == WORK.session.folder.path
    assert WORK.session.folder.path.parent == tmp_path / "Bridge Demolition"
    assert WORK.session.folder.path.name.startswith("search_")
    blender.ops.bda.stop_search()


def test_values_under_earlier_names_are_read(extension, panel, caplog):
    """Files that were saved before have them; scripts may set them still."""
    panel.search_lowest = 0.07
    assert panel.search.lowest == pytest.approx(0.07) and not panel.is_property_set("search_lowest")
    assert "scene.bda.search_lowest is scene.bda.search.lowest now" in caplog.text
    assert [handler.__name__ for handler in extension.app.handlers.load_post].count("read_earlier_files") == 1


def test_any_key_of_the_scenario_is_searched_along(blender, panel):
    assert "key" not in drawn(blender, sidebar) and "lowest" in drawn(blender, sidebar)
    panel.search_quantity, panel.search.key, panel.search.factor = "ANOTHER_KEY", "time.gravity_m_s2", False
    assert "key" in drawn(blender, sidebar)


def test_a_search_file_is_shown_with_its_scenario(blender, panel, tmp_path):
    asked = shown_search(panel)
    (tmp_path / "search.toml").write_text(asked.text, encoding="utf-8")
    (tmp_path / "scenario_as_run.toml").write_text(asked.scenario_text, encoding="utf-8")
    panel.search_path, panel.search.highest, panel.study.seed = str(tmp_path / "search.toml"), 0.3, 12
    assert blender.ops.bda.load_search() == {"FINISHED"}
    assert shown_search(panel).text == asked.text
