# SPDX-License-Identifier: GPL-3.0-or-later
"""Another run beside this one: where its bodies are drawn, its figures, and that it is only drawn."""

from dataclasses import replace

import numpy as np
import pytest
from support.checkout import SMALL
from support.exported_runs import corners_m
from support.panel_layouts import texts_drawn
from support.run_folders import flying_shards, keep_run

from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.model.debris.throws import debris_of
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.report.findings import findings
from bridge_demolition_addon.report.run_folder import read_run


@pytest.fixture
def other(tmp_path):
    """A run of thirty shards and a ball, of another scenario, with frames of another length."""
    return keep_run(tmp_path / "other", flying_shards(frames=40, frame_s=1 / 30))


@pytest.fixture
def ran(extension, settings, tmp_path):
    settings.scenario_path = str(SMALL)
    extension.ops.bda.load_scenario()
    settings.scenario.connections.breaking_force_kgf = 300.0  # too weak to stand
    extension.ops.bda.build_scenario()
    settings.output_directory = str(tmp_path / "run")
    extension.ops.bda.run(pictures=False)
    return extension


@pytest.fixture
def beside(ran, settings, other):
    settings.compared_directory = str(other)
    assert ran.ops.bda.compare_run() == {"FINISHED"}
    return ran


def drawn(bpy):
    from bridge_demolition_addon.ui.comparison.shown import drawn_run

    return drawn_run(bpy.context.scene)


def panel(bpy):
    from bridge_demolition_addon.ui.comparison.ui import BDA_PT_compare

    return texts_drawn(BDA_PT_compare, bpy)


def test_bodies_are_drawn_where_they_were_at_the_same_time(beside, settings, other, tmp_path):
    """At two frames: corners by plain sums, in the last recorded frame of the other run up to this one's time."""
    mine, theirs, scene = load_results(tmp_path / "run"), load_results(other), beside.context.scene
    for number in (mine.frames.number[0], mine.frames.number[20]):
        scene.frame_set(int(number))
        time_s = mine.frames.time_s[list(mine.frames.number).index(number)]
        row = max(step for step, t in enumerate(theirs.frames.time_s) if t <= time_s + 1e-6)
        bodies = range(len(theirs.inventory.body_names))
        corners = np.concatenate([corners_m(theirs, row, body) for body in bodies])
        corners = corners + np.array((0.0, settings.compared_shift_m, 0.0))
        triangles = drawn(beside).triangles
        for ends in (np.min, np.max):
            np.testing.assert_allclose(ends(triangles, axis=0), ends(corners, axis=0), atol=1e-4)
        assert f"{theirs.frames.time_s[row]:.2f} s" in drawn(beside).text


def test_it_stands_beside_the_bridge_or_over_it(beside, settings, tmp_path):
    mine = load_results(tmp_path / "run")
    beside.context.scene.frame_set(int(mine.frames.number[0]))
    widest = max(corners_m(mine, 0, body)[:, 1].max() for body in mine.inventory.of_kind("shard"))
    assert drawn(beside).triangles[:, 1].min() > widest + 3.0
    assert not drawn(beside).is_over and set(drawn(beside).colours[:, 3]) == {1.0}
    beside.ops.bda.lay_over()
    assert settings.compared_shift_m == 0.0 and drawn(beside).is_over
    assert drawn(beside).colours[:, 3].max() < 1.0
    beside.ops.bda.lay_over()
    assert drawn(beside).triangles[:, 1].min() > widest + 3.0
    settings.show_compared = False
    assert drawn(beside) is None


@pytest.mark.long
def test_figures_of_both_are_those_of_their_reports(beside, other, tmp_path):
    told = panel(beside)
    for folder in (tmp_path / "run", other):
        run = read_run(folder)
        reach = "Debris beyond the bridge's outline, at most"
        by_label = {finding.label: finding for finding in findings(run, debris_of(run.recorded))}
        assert f"{by_label['Debris'].value:.1f} t" in told
        assert f"{by_label[reach].value:.2f} m" in told
        assert f"{by_label['Largest load on a shard'].value:.0f} kN" in told
    begin = told.index("Debris distance")
    assert told[begin + 1].endswith(" m") and told[begin + 2].endswith(" m")


def test_every_finding_has_a_name_in_the_panel(other):
    from bridge_demolition_addon.ui.comparison.shown import figure_rows

    run = read_run(other)
    known = [finding for finding in findings(run, debris_of(run.recorded)) if finding.value is not None]
    rows = figure_rows(None, other)
    assert len(rows) == len(known) and len({row.name for row in rows}) == len(rows)
    assert {row.this for row in rows} == {"-"} and "-" not in {row.other for row in rows}


def test_colours_of_contours_are_by_the_scale_of_this_run(beside, settings):
    from bridge_demolition_addon.simulation.blender_events import contours_of
    from bridge_demolition_addon.ui.comparison.shown import other_run

    scene = beside.context.scene
    settings.contours, settings.contour_shaded = True, False
    scene.frame_set(12)
    scale = contours_of(scene).shown_frame()[0].scale
    run = other_run(scene)
    row = run.surfaces.row_at(11 / 24)
    values = run.series.values(row, contours_of(scene).settings.quantity)
    from bridge_demolition_addon.ui.comparison.shown import colours_of

    painted = colours_of(scene, run, row)
    known = np.isfinite(values)
    order = np.argsort(scale.shares(values[known]))
    assert known.sum() > 20
    from bridge_demolition_addon.display.colour_scale import colours

    expected = colours(contours_of(scene).settings.colour_map, scale.shares(values))
    assert (painted[known][order] == expected[known][order]).all()
    settings.contours = False
    assert len(np.unique(colours_of(scene, run, row), axis=0)) == 1


def test_it_is_only_drawn_and_gone_by_its_button_and_with_the_add_on(beside, settings):
    import bridge_demolition_addon

    scene = beside.context.scene
    objects, bodies = len(beside.data.objects), len(scene.rigidbody_world.collection.all_objects)
    assert drawn(beside) is not None
    assert (len(beside.data.objects), len(scene.rigidbody_world.collection.all_objects)) == (objects, bodies)
    assert beside.ops.bda.forget_compared() == {"FINISHED"}
    assert drawn(beside) is None and settings.compared_folder == ""
    assert not beside.ops.bda.forget_compared.poll() and not beside.ops.bda.lay_over.poll()
    beside.ops.bda.compare_run()
    assert drawn(beside) is not None
    bridge_demolition_addon.unregister()
    assert not hasattr(beside.types.Scene, "bda")
    bridge_demolition_addon.register()
    assert drawn(beside) is not None  # the file still names the run


@pytest.mark.long
def test_a_folder_that_has_gone_is_said_and_draws_nothing(beside, other):
    from bridge_demolition_addon.ui.comparison import shown

    for path in other.iterdir():
        path.unlink()
    with pytest.raises(OutputError, match="expected the results of a run"):
        drawn(beside)
    assert "expected the results of a run" in " ".join(panel(beside)) or "holds no run" in " ".join(panel(beside))
    shown.forget()


@pytest.mark.long
def test_what_is_no_run_is_refused(ran, settings, tmp_path):
    assert not ran.ops.bda.compare_run.poll()
    settings.compared_directory = str(tmp_path / "none")
    with pytest.raises(RuntimeError, match="expected the folder of another run"):
        ran.ops.bda.compare_run()
    assert settings.compared_folder == ""
    (tmp_path / "none").mkdir()
    with pytest.raises(RuntimeError, match="expected the results of a run"):
        ran.ops.bda.compare_run()


def test_removed_bodies_are_drawn_until_they_go(other):
    from bridge_demolition_addon.display.moved_surfaces import MovedSurfaces
    from bridge_demolition_addon.exports.shapes import body_meshes

    results = load_results(other)
    positions = np.array(results.frames.positions_m)
    positions[30:, 4, 2] -= 1000.0
    results = replace(results, frames=replace(results.frames, positions_m=positions))
    surfaces = MovedSurfaces(results, body_meshes(results.inventory))
    assert 4 in surfaces.at(29)[2] and 4 not in surfaces.at(30)[2]
    triangles, brightness, _ = surfaces.at(30)
    assert len(triangles) == 12 * 30 and brightness.min() >= 0.45 and brightness.max() <= 1.0


def test_bodies_stay_where_they_were_recorded_while_another_run_is_beside_them(beside, settings, tmp_path):
    """Also after a change by which Blender forgets what it played, and would show the bridge as it was built."""
    from bridge_demolition_addon.ui.results import shown_run

    scene, results = beside.context.scene, load_results(tmp_path / "run")
    bodies = {body.name: body for body in scene.rigidbody_world.collection.objects if body.name.startswith("Shard")}
    rows = [list(results.inventory.body_names).index(name) for name in bodies]

    def farthest_m():
        scene.frame_set(int(results.frames.number[-1]))
        graph = beside.context.evaluated_depsgraph_get()
        shown = np.array([body.evaluated_get(graph).matrix_world.translation for body in bodies.values()])
        return float(np.abs(shown - results.frames.positions_m[-1, rows]).max())

    next(iter(bodies.values())).rigid_body.friction += 0.01
    scene.frame_set(int(results.frames.number[0]))
    scene.rigidbody_world.enabled = False
    assert farthest_m() > 1.0
    shown_run.follow()
    assert farthest_m() < 1e-3
    beside.ops.bda.forget_compared()
    shown_run.follow()
    assert farthest_m() > 1.0
