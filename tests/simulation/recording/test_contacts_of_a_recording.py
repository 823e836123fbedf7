# SPDX-License-Identifier: GPL-3.0-or-later
"""Contacts that a run keeps, against statics: what bodies at rest press on the ground with, and where."""

from dataclasses import replace
from math import cos, radians, sin, tan

import numpy as np
import pytest
from support.blocks import Blocks

from bridge_demolition_addon.bullet import layout
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import SimulationError
from bridge_demolition_addon.model.results.arrays import load_results, motion_digest
from bridge_demolition_addon.model.scenario import Removal
from bridge_demolition_addon.scene.custom_properties import keep_tables
from bridge_demolition_addon.simulation.blender_events import start_recording, stop_recording
from bridge_demolition_addon.simulation.recording.recorder import Recording

LOWER_KG, UPPER_KG = 100.0, 50.0
LOWER_M, UPPER_M = np.array((2.0, -1.0, 0.5)), np.array((2.2, -0.9, 1.25))
FRAMES = 24

SHARE = 1e-4
"""Of a weight, and of 1 m: what the solver's iterations leave of an imbalance at rest. Measured: 2e-8."""


def stack(**time):
    """Ground, a block of 1 m × 2 m × 1 m on it, and one of 0.5 m on that, off its centre."""
    blocks = Blocks(**time)
    blocks.block((0, 0, -0.5), size_m=(20, 20, 1))
    blocks.block(tuple(LOWER_M), LOWER_KG, (1, 2, 1))
    blocks.block(tuple(UPPER_M), UPPER_KG, (0.5, 0.5, 0.5))
    return blocks


def between(results, upper, lower):
    """Places of the contacts between two bodies in the last frame, and the impulses on the upper one."""
    last = results.contacts.of_frame(results.frames.number[-1])
    upwards = (last.bodies == (upper, lower)).all(axis=1)
    found = upwards | (last.bodies == (lower, upper)).all(axis=1)
    signs = np.where(upwards, 1.0, -1.0)[:, None]
    assert found.sum() >= 3  # fewer points hold nothing up
    return last.places_m[found], (signs * last.impulses_ns)[found]


def middle(places, impulses):
    """Where the normal impulses act as one."""
    return impulses[:, 2] @ places[:, :2] / impulses[:, 2].sum()


@pytest.mark.parametrize("every_substep", [True, False])
def test_contacts_of_a_stack_bear_its_weight_below_its_centres(blender, tmp_path, every_substep):
    results = stack(solver_iterations=100).play(tmp_path, FRAMES, every_substep=every_substep, contacts=True)
    weight_ns = STANDARD_GRAVITY_M_S2 * results.frames.substep_s[-1]
    both_m = (LOWER_KG * LOWER_M + UPPER_KG * UPPER_M) / (LOWER_KG + UPPER_KG)
    cases = (
        (1, 0, LOWER_KG + UPPER_KG, both_m, LOWER_M, (0.5, 1.0), 0.0),
        (2, 1, UPPER_KG, UPPER_M, UPPER_M, (0.25, 0.25), 1.0),
    )
    for upper, lower, mass_kg, centre_m, face_m, half_m, height_m in cases:
        positions, impulses = between(results, upper, lower)
        assert impulses.sum(axis=0) == pytest.approx((0.0, 0.0, mass_kg * weight_ns), abs=SHARE * mass_kg * weight_ns)
        assert positions[:, 2] == pytest.approx(height_m, abs=SHARE)
        assert (abs(positions[:, :2] - face_m[:2]) <= np.array(half_m) + SHARE).all()
        assert middle(positions, impulses) == pytest.approx(centre_m[:2], abs=SHARE)  # no moment is left


def test_friction_and_pressure_on_a_slope_are_those_of_statics(blender, tmp_path):
    """Gravity leans by 20° instead of the ground: the resultant of the contacts goes through the centre of mass."""
    slope, mass_kg = radians(20.0), 100.0
    blocks = Blocks(solver_iterations=100)
    blocks.scene.gravity = STANDARD_GRAVITY_M_S2 * np.array((sin(slope), 0.0, -cos(slope)))
    for body in (blocks.block((0, 0, -0.5), size_m=(20, 20, 1)), blocks.block((1, 2, 0.5), mass_kg)):
        body.rigid_body.friction = 1.0
    results = blocks.play(tmp_path, FRAMES, contacts=True)
    weight_ns = mass_kg * STANDARD_GRAVITY_M_S2 * results.frames.substep_s[-1]
    positions, impulses = between(results, 1, 0)
    wanted = weight_ns * np.array((-sin(slope), 0.0, cos(slope)))
    assert impulses.sum(axis=0) == pytest.approx(wanted, abs=SHARE * weight_ns)
    last = results.contacts.of_frame(results.frames.number[-1])
    assert last.normal_impulses_ns.sum() == pytest.approx(weight_ns * cos(slope), rel=SHARE)
    assert abs(last.normals[:, 2]) == pytest.approx(1.0)
    assert abs(last.friction_impulses_ns[:, 2]).max() < 1e-6 * weight_ns
    centre = results.frames.positions_m[-1, 1]
    assert middle(positions, impulses) == pytest.approx((centre[0] + centre[2] * tan(slope), centre[1]), abs=SHARE)


def test_contacts_change_nothing_else_and_are_read_back(blender, tmp_path):
    found = []
    for contacts in (False, True):
        blender.ops.wm.read_factory_settings(use_empty=True)
        (folder := tmp_path / str(contacts)).mkdir()
        results = stack().play(folder, 6, contacts=contacts)
        results.save(folder / "results.npz")
        found.append((load_results(folder), load_results(folder / "results_frames.npy")))
    (without, _), (kept, left) = found
    assert without.contacts is None and motion_digest(without) == motion_digest(kept)
    assert kept.arrays().keys() - without.arrays().keys() == {
        f"contact_{name}"
        for name in ("frames", "bodies", "places_m", "normals", "normal_impulses_ns", "friction_impulses_ns")
    }
    for name, values in without.arrays().items():
        np.testing.assert_array_equal(kept.arrays()[name], values, err_msg=name)
    assert len(kept.contacts)
    for name, values in kept.arrays().items():
        np.testing.assert_array_equal(left.arrays()[name], values, err_msg=name)
    # None in the first frame, in which no time passes.
    assert set(kept.contacts.frames) == set(kept.frames.number[1:])


def test_bodies_that_were_removed_touch_nothing(blender, tmp_path):
    blocks = stack()
    corners = {"lowest_corner_m": (0, -3, 0), "highest_corner_m": (4, 2, 2)}
    keep_tables(blocks.scene, "changes", [Removal(time_s=0.2, **corners)])
    results = blocks.play(tmp_path, 12, contacts=True)
    times = results.frames.time_s[np.searchsorted(results.frames.number, results.contacts.frames)]
    frame_s = blocks.time.step.frame_s
    assert times.max() == pytest.approx(0.2, abs=frame_s) and results.frames.time_s[-1] > 0.2 + 2 * frame_s


def test_they_are_no_part_of_a_recording_without_loads(blender, tmp_path):
    blocks = stack()
    start_recording(recording := Recording(blocks.scene, tmp_path, loads=False, contacts=True))
    for frame in range(1, 5):
        blocks.scene.frame_set(frame)
    stop_recording()
    assert recording.recorded_frames == 3 and recording.results().contacts is None


def test_they_are_not_left_out_in_silence_where_memory_is_not_trusted(blender, tmp_path, monkeypatch):
    right = layout.platform_layout()
    monkeypatch.setattr(layout, "SYSTEM_V", replace(right, body=replace(right.body, friction=right.body.friction + 8)))
    monkeypatch.setattr(layout, "MICROSOFT", layout.SYSTEM_V)
    with pytest.raises(SimulationError, match=r"contacts need Blender's memory.*recording\.contacts off"):
        stack().play(tmp_path, 4, contacts=True)
