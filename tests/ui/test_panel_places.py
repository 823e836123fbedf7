# SPDX-License-Identifier: GPL-3.0-or-later
"""Where panels stand in the tab: four groups below the head, simple ones in them and all others in Advanced."""

import pytest
from support.checkout import SMALL

from bridge_demolition_addon.model.scenario import Scenario
from bridge_demolition_addon.ui import sidebar
from bridge_demolition_addon.ui.scenario.prop import shown_tables
from bridge_demolition_addon.ui.sidebar import TREE, parent_of, tables_below


@pytest.fixture
def panels(extension):
    from bridge_demolition_addon.ui.registration import classes

    return {cls.__name__: cls for cls in classes() if issubclass(cls, extension.types.Panel)}


@pytest.fixture
def built(extension, settings, tmp_path):
    settings.scenario_path = str(SMALL)
    extension.ops.bda.build_scenario()
    settings.output_directory = str(tmp_path / "run")
    return extension


def labels_in(panels, outer):
    return [panel.bl_label for panel in panels.values() if getattr(panel, "bl_parent_id", "") == outer]


def test_the_tab_has_a_head_and_four_groups(panels):
    assert labels_in(panels, "") == ["Scenario", "Bridge", "Demolition", "Run and Results", "Planning"]


def test_what_most_people_need_is_in_a_group_and_the_rest_in_its_advanced(panels):
    assert labels_in(panels, sidebar.BRIDGE) == [
        *("Sizes", "Own Model", "Steelwork", "Site", "Zones", "Neighbours", "Exclusion Zone", "Advanced")
    ]
    assert labels_in(panels, sidebar.RUN)[:3] == ["Run", "Results", "Report"]
    assert labels_in(panels, sidebar.PLANNING) == ["Stages", "Study", "Search", "Optimise"]
    assert "Fracture" in labels_in(panels, sidebar.BRIDGE_ADVANCED)
    assert "Record by Hand" in labels_in(panels, sidebar.RUN_ADVANCED)


def test_every_place_has_a_panel_and_every_panel_a_place(panels):
    assert {panel for inside in TREE.values() for panel in inside} <= set(panels)
    for name, panel in panels.items():
        assert parent_of(name) is not None or panel.bl_parent_id in panels


def test_every_table_of_a_scenario_has_a_place_of_its_own(panels):
    tables = {item.name for item in shown_tables(Scenario)}
    groups = (sidebar.BRIDGE, sidebar.DEMOLITION, sidebar.RUN)
    assert tables <= {name for group in groups for name in tables_below(group)}


def test_panels_come_after_what_they_stand_in(panels):
    names = list(panels)
    for name, panel in panels.items():
        if parent := getattr(panel, "bl_parent_id", ""):
            assert names.index(parent) < names.index(name)


def test_advanced_is_last_and_closed_from_the_start(panels):
    for name, panel in panels.items():
        if panel.bl_label == "Advanced":
            assert TREE[panel.bl_parent_id][-1] == name
            assert "DEFAULT_CLOSED" in panel.bl_options


def test_open_from_the_start_is_the_way_to_a_run(panels):
    opened = [panel.bl_label for panel in panels.values() if "DEFAULT_CLOSED" not in panel.bl_options]
    assert opened == [*("Scenario", "Run and Results", "IFC Elements", "Sizes", "Run", "Results", "Report", "Findings")]


def test_results_and_report_come_into_view_open_when_a_run_has_ended(built, panels):
    built.context.scene.bda.output_directory = ""
    results, report = panels["BDA_PT_results"], panels["BDA_PT_report"]
    assert not results.poll(built.context) and not report.poll(built.context)
    built.context.scene.frame_end = 5
    built.ops.bda.run(pictures=False)
    assert results.poll(built.context) and report.poll(built.context)


def test_a_folder_with_results_can_be_reported_without_a_run(built, panels):
    assert panels["BDA_PT_report"].poll(built.context)
    assert not panels["BDA_PT_results"].poll(built.context)


def test_no_report_can_be_opened_before_one_was_made(built, tmp_path):
    assert not built.ops.bda.open_report.poll()
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "report.html").touch()
    assert built.ops.bda.open_report.poll()


def test_findings_come_into_view_once_a_study_has_a_folder(extension, settings, panels, tmp_path):
    findings = panels["BDA_PT_study_findings"]
    assert not findings.poll(extension.context)
    settings.study_directory = str(tmp_path / "study")
    assert findings.poll(extension.context)


def test_a_group_says_that_a_value_in_it_has_changed(built, settings):
    from bridge_demolition_addon.ui.scenario.built import has_changed

    assert not has_changed(settings, tables_below(sidebar.BRIDGE))
    settings.scenario.fracture.shards += 1
    assert has_changed(settings, tables_below(sidebar.BRIDGE))
    assert has_changed(settings, tables_below(sidebar.BRIDGE_ADVANCED))
    assert not has_changed(settings, tables_below(sidebar.DEMOLITION))


def test_what_was_deleted_can_be_built_again_at_once(built, settings):
    from bridge_demolition_addon.ui.scenario.hints import next_step

    scene = built.context.scene
    assert not built.ops.bda.build_scenario.poll()
    for body in list(scene.rigidbody_world.collection.all_objects):
        built.data.objects.remove(body)
    assert "nothing is left" in next_step(scene)
    built.ops.bda.build_scenario()
    assert len(scene.rigidbody_world.collection.all_objects) > 30
    assert not built.ops.bda.build_scenario.poll()
