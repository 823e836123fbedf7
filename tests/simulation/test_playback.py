# SPDX-License-Identifier: GPL-3.0-or-later
"""Sub-steps that are still to come, against those of a stone whose fall has an exact answer."""

from types import SimpleNamespace

import numpy as np
import pytest

from bridge_demolition_addon.model.scenario.time import TimeSettings

FRAME_S, FEWEST, FARTHEST_M, GRAVITY = 1.0 / 25.0, 4, 0.01, 9.81


def to_come(scene, settings, frame):
    from bridge_demolition_addon.scene.world import create_world
    from bridge_demolition_addon.simulation.playback import Workload

    create_world(scene, settings, 21)
    return Workload(scene, 2, 21).to_come(frame)


def falling(number):
    velocities = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
    return SimpleNamespace(number=number, positions_m=np.array([[0, 0, 0], [0, 0, 100.0]]), velocities_m_s=velocities)


def settings(**others):
    return TimeSettings(duration_s=0.8, frames_per_second=25, substeps_per_frame=FEWEST, **others)


def test_frames_have_as_many_substeps_as_a_stone_is_fast_that_falls_through_all_of_them(blender):
    frames = np.arange(15)  # after frame 6
    fastest = 1.0 + GRAVITY * (frames + 1) * FRAME_S  # at the end of each
    expected = np.maximum(FEWEST, np.ceil(fastest * FRAME_S / FARTHEST_M)).sum()
    found = to_come(blender.context.scene, settings(farthest_per_substep_m=FARTHEST_M), falling(6))
    assert found == pytest.approx(expected, abs=1.0)  # Blender's gravity and frame have single precision


def test_frames_are_alike_where_no_way_is_given(blender):
    assert to_come(blender.context.scene, settings(), falling(6)) == 15 * FEWEST


def test_nothing_follows_on_the_last_frame(blender):
    assert to_come(blender.context.scene, settings(farthest_per_substep_m=FARTHEST_M), falling(21)) == 0.0
