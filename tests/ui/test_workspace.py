# SPDX-License-Identifier: GPL-3.0-or-later
"""The workspace BDA, and the first help."""

import runpy

import pytest
from support.checkout import ROOT, SMALL

from bridge_demolition_addon.ui.chart_pictures import chart_of
from bridge_demolition_addon.ui.scenario.hints import SENTENCES, walkthrough
from bridge_demolition_addon.ui.workspace import arrange


@pytest.fixture
def windowed(extension):
    """Blender as it starts, with its workspaces."""
    extension.ops.wm.read_homefile(use_factory_startup=True)
    return extension


def kinds(screen):
    return {area.ui_type for area in screen.areas}


def test_it_is_made_once_and_leaves_others_as_they_are(windowed):
    """Without a window's events Blender does not go to it: that is seen in a real window."""
    before, layout = {workspace.name for workspace in windowed.data.workspaces}, kinds(windowed.context.window.screen)
    for _ in range(3):
        assert windowed.ops.bda.make_workspace() == {"FINISHED"}
    assert {workspace.name for workspace in windowed.data.workspaces} - before == {"BDA"}
    assert kinds(windowed.data.workspaces["Layout"].screens[0]) == layout


def test_a_shown_screen_gets_bridge_charts_and_timeline(windowed):
    screen = windowed.context.window.screen
    arrange(screen)
    assert {"VIEW_3D", "IMAGE_EDITOR", "TIMELINE"} <= kinds(screen)
    sizes = {area.ui_type: area.width * area.height for area in screen.areas}
    assert max(sizes, key=sizes.get) == "VIEW_3D"


def test_the_view_of_the_bridge_has_its_sidebar_and_no_tools(windowed):
    screen = windowed.context.window.screen
    arrange(screen)
    (view,) = (area.spaces.active for area in screen.areas if area.type == "VIEW_3D")
    assert view.show_region_ui and not view.show_region_toolbar


def test_the_chart_that_a_run_leaves_is_found_and_then_the_one_that_is_drawn(windowed, tmp_path):
    scene = windowed.context.scene
    assert chart_of(scene) is None
    scene.bda.scenario_path = str(SMALL)
    windowed.ops.bda.build_scenario()
    scene.frame_end = 8
    scene.bda.output_directory = str(tmp_path / "run")
    windowed.ops.bda.run()
    assert chart_of(scene) == tmp_path / "run" / "force_over_time.png"
    windowed.ops.bda.draw_charts()
    assert chart_of(scene) == tmp_path / "run" / "charts" / "force_over_time.png"


def test_the_page_of_the_walkthrough_has_all_its_words_and_pictures(tmp_path):
    write_page = runpy.run_path(str(ROOT / "scripts" / "walkthrough_page.py"))["write_page"]
    page = write_page(tmp_path / "walkthrough")
    text = page.read_text(encoding="utf-8")
    source = (ROOT / "docs" / "walkthrough.md").read_text(encoding="utf-8")
    assert text.count("<h2>") == source.count("\n## ")
    assert text.count("<img") == source.count("![")
    for part in text.split('src="')[1:]:
        assert (page.parent / part.partition('"')[0]).is_file()
    assert 'href="' not in text.replace('href="http', "")


def test_there_is_a_walkthrough_to_open(extension):
    assert walkthrough().is_file() and len(SENTENCES) == 3
