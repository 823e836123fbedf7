# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel Stages: checked without a simulation, told in a table, and shown as contours before anything is run."""

import csv
from dataclasses import replace

import numpy as np
import pytest
from support.panel_layouts import texts_drawn
from support.scenarios import I235

from bridge_demolition_addon.display.colour_scale import ColourMap, colours, linear
from bridge_demolition_addon.display.contour_quantities import ContourQuantity
from bridge_demolition_addon.model.scenario import Equipment
from bridge_demolition_addon.simulation.blender_events import contours_of
from bridge_demolition_addon.ui.contours import view as contour_view
from bridge_demolition_addon.ui.scenario.values import show_scenario
from bridge_demolition_addon.ui.stages import BDA_PT_stages, checked_in

EXCAVATOR = Equipment(name="excavator", mass_kg=10_000.0, position_m=(6.0, 0.0), footprint_m=(2.0, 2.0), from_s=0.5)
STANDS = replace(
    I235,
    ball=None,
    fracture=replace(I235.fracture, shards=12),
    connections=replace(I235.connections, type="FIXED", method="face", search_radius_m=None),
    equipment=(EXCAVATOR,),
)


@pytest.fixture
def panel(extension):
    """The settings of a scene that shows a bridge with an excavator on it from half a second on."""
    settings = extension.context.scene.bda
    show_scenario(settings, STANDS)
    return settings


def drawn(blender):
    """What the panel draws: texts of labels, and names of buttons."""
    return texts_drawn(BDA_PT_stages, blender)


def shown_colours(scene, count):
    """Colours that the views show, of the shards in their order."""
    graph = scene.view_layers[0].depsgraph
    shards = [body for body in scene.rigidbody_world.collection.all_objects if body.name.startswith("Shard")]
    assert len(shards) == count
    return np.array([tuple(body.evaluated_get(graph).color)[:3] for body in shards])


def test_stages_are_checked_told_and_shown_before_anything_is_run(blender, panel, tmp_path):
    ops, scene = blender.ops.bda, blender.context.scene
    assert drawn(blender) == ["bda.check_stages"] and not ops.show_utilisation.poll()
    panel.stages_directory = str(tmp_path / "tables")
    assert ops.check_stages() == {"FINISHED"}
    rows = list(csv.DictReader((tmp_path / "tables" / "stages.csv").open(encoding="utf-8")))
    assert [row["equipment"] for row in rows] == ["", "excavator"]
    told = drawn(blender)
    used = [f"{float(row['largest_utilisation']):.0%}" for row in rows]
    falls = [f"{float(row['collapse_factor']):.2f}" for row in rows]
    assert told[1:13] == [
        *("Stage", "From", "Used", "Carries, × weight"),
        *("1", "0 s", used[0], falls[0]),
        *("2", "0.5 s", used[1], falls[1]),
    ]
    assert float(rows[1]["collapse_factor"]) < float(rows[0]["collapse_factor"])
    assert f"Carries {falls[0]} times its weight" in " ".join(told)
    panel.stage_shown = 2
    told = drawn(blender)
    assert f"Carries {falls[1]} times its weight" in " ".join(told)
    assert "with excavator" in told
    carried = list(csv.DictReader((tmp_path / "tables" / "reactions.csv").open(encoding="utf-8")))
    carried = [row for row in carried if row["stage"] == "2"]
    assert len(carried) == 4
    begin = told.index("Reactions, kN") + 4
    for number, row in enumerate(carried):
        cells = [row["support"], *(f"{float(row[f'force_{axis}_kN']):.1f}" for axis in "xyz")]
        assert told[begin + 4 * number : begin + 4 * number + 4] == cells
    assert told[begin + 16 : begin + 20] == ["Moments, kN·m", "x", "y", "z"] and len(told) == begin + 20 + 16

    assert ops.build_scenario() == {"FINISHED"}
    panel.contour_range, panel.contour_low, panel.contour_high, panel.contour_logarithmic = "FIXED", 0.0, 100.0, False
    assert ops.show_utilisation() == {"FINISHED"}
    contours = checked_in(scene).contours
    count = contours.used.shape[1]
    for stage in (2, 1):
        panel.stage_shown = stage
        expected = linear(colours(ColourMap.VIRIDIS, np.clip(contours.used[stage - 1], 0.0, 1.0)))
        known = np.isfinite(expected).all(axis=1)
        assert known.any()
        assert shown_colours(scene, count)[known] == pytest.approx(expected[known], abs=1e-6)
    # Every shard has the utilisation of the connection of its own that is used most: the largest is that of the table.
    assert np.nanmax(contours.used[1]) == pytest.approx(float(rows[1]["largest_utilisation"]), rel=1e-4)
    frame, _ = contours_of(scene).shown_frame()
    assert frame.frame == 1 and contour_view.refusal(scene) == ""
    panel.contours = False


@pytest.mark.long
def test_stages_of_another_bridge_are_not_shown(blender, panel):
    ops, scene = blender.ops.bda, blender.context.scene
    ops.check_stages()
    panel.scenario.seed += 1
    of_other = "The stages that were checked are of other values than the panels show: check them again"
    assert drawn(blender)[1:] == [of_other]
    ops.build_scenario()
    with pytest.raises(RuntimeError, match=of_other):
        ops.show_utilisation()
    panel.contour_quantity, panel.contours = ContourQuantity.UTILISATION.name, True
    assert contour_view.refusal(scene).startswith("Utilisation at rest is that of stages: check them")
    panel.scenario.seed -= 1
    ops.build_anew()
    assert ops.show_utilisation() == {"FINISHED"} and contour_view.refusal(scene) == ""
    next(body for body in scene.objects if body.name.startswith("Shard")).location.x += 1.0
    contour_view.follow(scene)
    assert contour_view.refusal(scene).startswith("stages: they are of another bridge than the scene has")
    panel.contours = False


def test_utilisation_without_stages_says_what_to_do(blender, panel):
    blender.ops.bda.build_scenario()
    panel.contour_quantity, panel.contours = ContourQuantity.UTILISATION.name, True
    assert contour_view.refusal(blender.context.scene).startswith("Utilisation at rest is that of stages: check them")
    assert contours_of(blender.context.scene).shown_frame() is None


def test_equipment_beside_the_bridge_is_refused_with_a_sentence(blender, panel):
    show_scenario(panel, replace(STANDS, equipment=(replace(EXCAVATOR, position_m=(100.0, 0.0)),)))
    with pytest.raises(RuntimeError, match="nothing of the bridge is under"):
        blender.ops.bda.check_stages()
    assert checked_in(blender.context.scene) is None
