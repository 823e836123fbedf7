# SPDX-License-Identifier: GPL-3.0-or-later
"""Key figures over the 3D view: they follow timeline, selection and units, and are there only when asked for."""

import numpy as np
import pytest
from support.sample_results import hanging_chain

from bridge_demolition_addon.model.scenario import TimeSettings

LAST, PULLED = 6, 5
"""Frames: *lower* has come down, and a pull of 1 kN across is on both shards."""


@pytest.fixture
def chain(extension):
    """A scene with the bodies of the hanging chain, and its results."""
    from bridge_demolition_addon.scene.world import create_world
    from bridge_demolition_addon.simulation.blender_events import shown_results

    scene = extension.context.scene
    create_world(scene, TimeSettings(duration_s=1.0), LAST)
    for name in ("upper", "lower", "Connection.001"):
        mesh = extension.data.meshes.new(name) if name != "Connection.001" else None
        body = extension.data.objects.new(name, mesh)
        (scene.rigidbody_world.collection.objects if mesh else scene.collection.objects).link(body)
        if mesh:
            scene.collection.objects.link(body)
    shown_results(scene).load(hanging_chain())
    scene.bda.figures_in_view = True
    scene.frame_set(LAST)
    return extension


def seen(bpy):
    from bridge_demolition_addon.ui.key_figures import in_view

    return in_view(bpy.context)


def select(bpy, name):
    body = bpy.context.scene.objects[name]
    bpy.context.view_layer.objects.active = body
    body.select_set(True)


def test_figures_are_those_of_the_shown_frame(chain):
    assert seen(chain).lines == (
        "Frame 6, 0.16 s",
        "Cracked or torn: 1 of 2 connections",
        "Debris: 200 kg of 500 kg",
        "Debris up to 4.80 m from the bridge",  # from (0.5, 0.5) to (3.35, 4.35)
        "Nothing moves in the whole run",  # the chain has no speeds
    )
    chain.context.scene.frame_set(PULLED)
    assert seen(chain).lines[:3] == ("Frame 5, 0.12 s", "Cracked or torn: 0 of 2 connections", "Debris: 0 kg of 500 kg")
    assert not len(seen(chain).debris_lines) and seen(chain).farthest_m is None


def test_force_is_that_of_what_is_selected(chain):
    """By hand: 300 kg and 200 kg hang, and the pull makes 3.107 kN and 2.202 kN of them (square roots)."""
    assert seen(chain).force_text == "Largest on a shard: 2.942 kN, peak 3.107 kN at 0.12 s (upper)"
    select(chain, "lower")
    assert seen(chain).force_text == "lower: 0 N, peak 2.202 kN at 0.12 s"
    chain.context.scene.frame_set(PULLED)
    assert seen(chain).force_text == "lower: 2.202 kN, peak 2.202 kN at 0.12 s"
    np.testing.assert_allclose(seen(chain).curve.now, seen(chain).curve.peak)
    select(chain, "Connection.001")
    assert seen(chain).force_text == "Connection.001: 2.202 kN, peak 2.202 kN at 0.12 s"


def test_limit_is_the_zone_as_planned(chain):
    scenario = chain.context.scene.bda.scenario
    assert not len(seen(chain).limit_lines)
    scenario.use_exclusion = True
    scenario.exclusion.buffer_m, scenario.exclusion.designed_drop_m = 4.0, 1.5
    assert "Debris up to 4.80 m from the bridge, zone planned to 5.50 m" in seen(chain).lines
    # The bridge covers 1 m by 1 m.
    np.testing.assert_allclose(np.abs(seen(chain).limit_lines[:, :2]).max(axis=0), 6.0, rtol=1e-6)
    np.testing.assert_allclose(seen(chain).debris_lines[:, :2].mean(axis=0), (3.0, 4.0), rtol=1e-6)
    scenario.exclusion.designed_drop_m = 0.0
    assert "Debris up to 4.80 m from the bridge: beyond the zone, planned to 4.00 m" in seen(chain).lines


def test_units_are_those_of_the_scene(chain):
    """A pound is 0.45359237 kg and a kip 4448.22 N, a foot 0.3048 m."""
    chain.context.scene.unit_settings.system = "IMPERIAL"
    lines = seen(chain).lines
    assert lines[2:4] == ("Debris: 441 lb of 1 102 lb", "Debris up to 15.73 ft from the bridge")
    assert seen(chain).force_text == "Largest on a shard: 0.6614 kip, peak 0.6985 kip at 0.12 s (upper)"


def test_nothing_is_drawn_where_it_is_not_asked_for_or_there_is_no_run(chain):
    from bridge_demolition_addon.simulation.blender_events import shown_results

    scene = chain.context.scene
    scene.bda.figures_in_view = False
    assert seen(chain) is None
    scene.bda.figures_in_view = True
    shown = shown_results(scene)
    shown.is_live = True  # as while a run records
    assert seen(chain) is None
    shown.is_live = False
    assert seen(chain) is not None
    shown.forget()
    assert seen(chain) is None


def test_it_is_off_at_first_and_other_scenes_show_nothing(chain):
    from bridge_demolition_addon.ui.key_figures import in_view

    other = chain.data.scenes.new("other")
    assert not other.bda.figures_in_view
    other.bda.figures_in_view = True
    with chain.context.temp_override(scene=other, view_layer=other.view_layers[0]):
        assert in_view(chain.context) is None


def test_it_is_kept_until_frame_selection_or_run_are_others(chain):
    from bridge_demolition_addon.simulation.blender_events import shown_results

    first = seen(chain)
    assert seen(chain) is first
    select(chain, "upper")
    assert (second := seen(chain)) is not first
    shown_results(chain.context.scene).load(hanging_chain())
    assert seen(chain) is not second


def test_the_panel_leads_to_the_peak_of_what_is_selected(chain):
    from bridge_demolition_addon.ui.key_figures import peak_of_selected

    assert peak_of_selected(chain.context) is None
    select(chain, "lower")
    name, peak = peak_of_selected(chain.context)
    assert (name, peak.body, peak.frame, peak.text) == ("lower", "lower", PULLED, "2.202 kN")
    assert chain.ops.bda.go_to_body(body=peak.body, frame=peak.frame) == {"FINISHED"}
    assert chain.context.scene.frame_current == PULLED
