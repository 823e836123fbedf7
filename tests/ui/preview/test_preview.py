# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panels would build, as it is drawn, and the values that dragging sets."""

import pytest

from bridge_demolition_addon.model.blast.charges import Charge
from bridge_demolition_addon.model.scenario.ball import BallHit

CHARGE = Charge(name="Charge 1", position_m=(1.0, 2.0, 3.0), mass_kg=10.0)


@pytest.fixture
def lines(settings):
    from bridge_demolition_addon.ui.preview.decorator import preview_lines

    return lambda: preview_lines(settings)


def handle_texts(scene):
    from bridge_demolition_addon.ui.preview.handles import handles

    return [handle.name for handle in handles(scene)]


def test_the_preview_follows_the_sizes_and_makes_no_data(settings, lines, extension):
    before = lines()
    settings.scenario.bridge.deck.width_m *= 2.0
    assert lines()[:, 1].max() == pytest.approx(settings.scenario.bridge.deck.width_m / 2.0)
    assert before[:, 1].max() < lines()[:, 1].max()
    assert not extension.data.objects and not extension.data.meshes


def test_it_goes_when_built_and_comes_back_where_sizes_change(settings, lines, extension):
    settings.scenario.fracture.shards = 20
    assert len(lines())
    assert extension.ops.bda.build_scenario() == {"FINISHED"}
    assert not len(lines())
    settings.scenario.fracture.shards = 30
    assert not len(lines())  # it looks the same
    settings.scenario.ball.diameter_m += 0.5
    assert len(lines())
    assert extension.ops.bda.show_built() == {"FINISHED"}
    assert not len(lines())


def test_dragging_sets_target_and_drop_height_and_the_panels_say_what_was_built(settings, extension):
    from bridge_demolition_addon.ui.scenario.built import changes

    settings.scenario.fracture.shards = 20
    assert extension.ops.bda.build_scenario() == {"FINISHED"}
    ball, drag = settings.scenario.ball, extension.ops.bda.drag_handle
    assert handle_texts(settings.id_data) == ["Target", "Drop height"]
    assert drag(kind="TARGET", position_m=(3.123456, -0.5, 77.0)) == {"FINISHED"}
    assert tuple(ball.target_m) == pytest.approx((3.12, -0.5))
    top = settings.id_data.objects["Wrecking ball"].location.z - ball.diameter_m / 2.0 - ball.drop_height_m
    assert drag(kind="DROP", is_upright=True, position_m=(9.0, 9.0, top + 2.5)) == {"FINISHED"}
    assert ball.drop_height_m == pytest.approx(2.5)
    assert tuple(ball.target_m) == pytest.approx((3.12, -0.5))
    assert [change.key for change in changes(settings)] == ["ball.target_m", "ball.drop_height_m"]
    assert drag(kind="DROP", is_upright=True, position_m=(0.0, 0.0, 0.0)) == {"FINISHED"}
    assert ball.drop_height_m == pytest.approx(0.01)  # within the limits of a scenario


def test_dragging_moves_charges_and_those_that_hang_on_something_have_no_handle(settings, extension):
    from bridge_demolition_addon.scene.blast.charges import charges_of, create_charges

    scene = settings.id_data
    settings.scenario.use_ball = False
    first, second = create_charges(scene, [CHARGE, CHARGE])
    second.parent = first
    assert handle_texts(scene) == ["Charge 1", "Charge 1"]  # level, and up and down
    assert extension.ops.bda.drag_handle(kind="CHARGE", position_m=(4.0, 5.0, 6.0)) == {"FINISHED"}
    assert charges_of(scene)[0].position_m == (4.0, 5.0, 6.0)
    with pytest.raises(RuntimeError, match="no charge 2"):
        extension.ops.bda.drag_handle(kind="CHARGE", index=1, position_m=(4.0, 5.0, 6.0))


def test_further_hits_have_targets_of_their_own_and_a_ball_on_a_cable_has_none(settings, extension):
    from bridge_demolition_addon.ui.scenario.values import show_table

    ball = settings.scenario.ball
    show_table(ball.hits.add(), BallHit(lift_time_s=3.0, release_time_s=7.0, target_m=(1.0, 0.0), drop_height_m=2.0))
    assert handle_texts(settings.id_data)[2:] == ["Target of hit 2", "Drop height of hit 2"]
    assert extension.ops.bda.drag_handle(kind="TARGET", index=1, position_m=(2.0, 0.25, 0.0)) == {"FINISHED"}
    assert tuple(ball.hits[0].target_m) == pytest.approx((2.0, 0.25))
    ball.hits.clear()
    ball.use_target_m = ball.use_drop_height_m = False
    ball.use_cable = True
    ball.cable.crane_point_m, ball.cable.length_m, ball.cable.angle_degrees = (0.0, 0.0, 30.0), 10.0, 45.0
    assert handle_texts(settings.id_data) == []
