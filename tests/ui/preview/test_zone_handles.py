# SPDX-License-Identifier: GPL-3.0-or-later
"""Blast zones that are dragged in the 3D view: along their members, and by their ends."""

from dataclasses import replace

import numpy as np
import pytest
from support.checkout import EXAMPLES

from bridge_demolition_addon.model.scenario.file import read_scenario, scenario_text

DRILLED = read_scenario(EXAMPLES / "drilled" / "two_spans.toml")


@pytest.fixture
def shown(extension, tmp_path):
    """The scene with the drilled bridge in its panels, of which nothing is built."""
    scene, path = extension.context.scene, tmp_path / "scenario.toml"
    path.write_text(scenario_text(DRILLED), encoding="utf-8")
    scene.bda.scenario_path = str(path)
    assert extension.ops.bda.load_scenario() == {"FINISHED"}
    scene.bda.overlays = {"BLAST_ZONES"}
    return scene


def zone_of(scene, index=0):
    from bridge_demolition_addon.ui.scenario.values import scenario_of

    return scenario_of(scene.bda).blast_zones[index]


def drawn(scene):
    from bridge_demolition_addon.ui.ground.decorator import drawn as everything

    return list(everything(scene, scene.view_layers[0]))


def handles_of(scene):
    from bridge_demolition_addon.ui.preview.handles import handles

    return {(handle.kind, handle.index): handle for handle in handles(scene)}


def test_each_zone_has_a_ring_and_an_arrow_at_each_end(shown):
    """A zone of 1.5 m about 1.5 m above the ground: from 0.75 to 2.25 m, whose arrows point away from it."""
    found = handles_of(shown)
    assert len(found) == 3 * 6
    assert [found[kind, 0].position_m[2] for kind in ("ZONE", "ZONE_BEGIN", "ZONE_END")] == [1.5, 0.75, 2.25]
    assert found["ZONE_BEGIN", 0].points_to == (0.0, 0.0, -1.0)
    assert found["ZONE_END", 0].points_to == (0.0, 0.0, 1.0)
    assert found["ZONE", 0].points_to is None
    assert found["ZONE_END", 2].name == "P1.1, end"


def test_boxes_are_drawn_before_anything_is_built_and_follow_what_is_dragged(shown, extension):
    before = drawn(shown)
    assert before[0].text == "P2.1: 0 ms"
    assert [len(part.lines) for part in before[:2]] == [24, 20]
    assert extension.ops.bda.drag_handle(kind="ZONE", index=0, position_m=(0.0, 0.0, 2.0)) == {"FINISHED"}
    after = drawn(shown)
    np.testing.assert_allclose(after[0].lines[:, 2] - before[0].lines[:, 2], 0.5, atol=1e-6)
    np.testing.assert_allclose(after[1].lines[:, 2] - before[1].lines[:, 2], 0.5, atol=1e-6)
    assert (zone_of(shown).middle_m, zone_of(shown).height_m) == (2.0, 1.5)
    assert shown.bda.scenario.blast_zones_index == 0


def test_an_end_is_dragged_by_itself(shown, extension):
    drag = extension.ops.bda.drag_handle
    assert drag(kind="ZONE_END", index=1, position_m=(0.0, 0.0, 2.604)) == {"FINISHED"}
    zone = zone_of(shown, 1)
    assert zone.ends_along_m == pytest.approx((0.75, 2.6))
    assert (zone.middle_m, zone.height_m) == (1.675, 1.85)
    assert drag(kind="ZONE_BEGIN", index=1, position_m=(9.0, 9.0, 0.5)) == {"FINISHED"}
    assert zone_of(shown, 1).ends_along_m == pytest.approx((0.5, 2.6))
    assert zone_of(shown, 0).ends_along_m == (0.75, 2.25)


def test_a_zone_stays_in_its_member_and_as_long_as_its_rows(shown, extension):
    """Five holes 0.3 m apart, staggered by 0.15 m, take 1.35 m."""
    drag = extension.ops.bda.drag_handle
    drag(kind="ZONE_END", index=0, position_m=(0.0, 0.0, 0.2))
    assert zone_of(shown).ends_along_m == pytest.approx((0.75, 2.1))
    drag(kind="ZONE", index=0, position_m=(0.0, 0.0, -7.0))
    assert zone_of(shown).ends_along_m == pytest.approx((0.0, 1.35))
    drag(kind="ZONE", index=0, position_m=(0.0, 0.0, 99.0))
    from bridge_demolition_addon.model.bridge.preparation import prepared_members

    (column,) = [member for member in prepared_members(DRILLED).members if member.name == "pier 2 column 1"]
    top_m = column.solid.bounds[1, 2]
    assert top_m - 0.01 < zone_of(shown).ends_along_m[1] <= top_m + 1e-6


def test_a_zone_is_not_dragged_into_another(shown, extension, tmp_path):
    first, *others = DRILLED.blast_zones
    above = replace(first, name="above", middle_m=3.2, holes_a_row=2, height_m=0.6, charge_g=30.0)
    path = tmp_path / "two.toml"
    path.write_text(scenario_text(replace(DRILLED, blast_zones=(first, above, *others))), encoding="utf-8")
    shown.bda.scenario_path = str(path)
    assert extension.ops.bda.load_scenario() == {"FINISHED"}
    extension.ops.bda.drag_handle(kind="ZONE_END", index=0, position_m=(0.0, 0.0, 4.0))
    assert zone_of(shown).ends_along_m == pytest.approx((0.75, 2.9))
    extension.ops.bda.drag_handle(kind="ZONE", index=1, position_m=(0.0, 0.0, 0.0))
    assert zone_of(shown, 1).ends_along_m == pytest.approx((2.9, 3.5))


def test_what_was_dragged_is_built(shown, extension):
    shown.bda.scenario.fracture.shards = 30
    extension.ops.bda.drag_handle(kind="ZONE_END", index=0, position_m=(0.0, 0.0, 2.8))
    assert extension.ops.bda.build_scenario() == {"FINISHED"}
    from bridge_demolition_addon.scene.custom_properties import run_tables_of

    (fired,) = [change for change in run_tables_of(shown, "changes") if change.name == DRILLED.blast_zones[0].name]
    assert (fired.lowest_corner_m[2], fired.highest_corner_m[2]) == pytest.approx((0.75, 2.8))


def test_handles_are_gone_once_time_has_begun(shown, extension):
    """What they would be at moves away from there; at the start frame they are back."""
    shown.bda.scenario.fracture.shards = 30
    assert extension.ops.bda.build_scenario() == {"FINISHED"}
    zones = {key for key in handles_of(shown) if key[0].startswith("ZONE")}
    shown.frame_set(5)
    assert not {key for key in handles_of(shown) if key[0].startswith("ZONE")}
    shown.frame_set(shown.frame_start)
    assert {key for key in handles_of(shown) if key[0].startswith("ZONE")} == zones and len(zones) == 18


def test_undo_takes_the_numbers_and_the_box_back(shown, extension):
    ops = extension.ops
    ops.ed.undo_push(message="before")
    assert ops.bda.drag_handle("EXEC_DEFAULT", True, kind="ZONE", index=0, position_m=(0.0, 0.0, 2.0)) == {"FINISHED"}
    assert zone_of(extension.context.scene).middle_m == 2.0
    ops.ed.undo()
    scene = extension.context.scene
    assert zone_of(scene).middle_m == 1.5
    assert drawn(scene)[0].lines[:, 2].min() == pytest.approx(0.75)


def test_zones_that_lie_in_no_member_have_no_handles_and_no_boxes(shown, extension):
    shown.bda.scenario.blast_zones[0].member = "pier 9 column 1"
    shown.bda.scenario.blast_zones[1].middle_m = 77.0
    assert {index for kind, index in handles_of(shown) if kind == "ZONE"} == {2, 3, 4, 5}
    assert len(drawn(shown)) == 2 * 4
    with pytest.raises(RuntimeError, match="no zone end 2 here"):
        extension.ops.bda.drag_handle(kind="ZONE_END", index=1, position_m=(0.0, 0.0, 1.0))
