# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the listing of 2019 departs from its own equations, the code here follows the equations."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.blast.exposure import lines_of_blast, projected_areas
from bridge_demolition_addon.engineering.blast.pulses import (
    REPORT_DECAY,
    blast_pulses,
    blast_wave,
    impulse_between,
    pressure_at,
)
from bridge_demolition_addon.engineering.geometry.hulls import convex_hulls
from bridge_demolition_addon.engineering.timing.timeline import TimeStep

CUBE = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])


def report_pulses(stand_off_m, tnt_kg):
    """Pulses of the report's own equations, with the decay it takes."""
    return blast_pulses([[stand_off_m]], [tnt_kg], [0.0], ["air"], model="kinney-graham", constant_decay=REPORT_DECAY)


def test_1_duration_depends_on_distance_and_is_no_second():
    # A bracket in the wrong place made it 980 ms to 984 ms everywhere.
    durations = blast_wave([1.0, 5.0, 20.0], 1.0, model="kinney-graham").positive_phase_duration_s
    assert 1e3 * durations == pytest.approx([0.5202, 2.472, 3.983], abs=5e-4)
    # And it grows with the cube root of the whole charge.
    assert blast_wave(50.0, 1000.0, model="kinney-graham").positive_phase_duration_s == pytest.approx(10 * durations[1])


def test_2_ambient_pressure_pushes_nothing():
    # 101 kPa were added to the overpressure, for ever.
    pulses = report_pulses(50.0, 1000.0)
    assert pressure_at(pulses, pulses.arrivals_s) == pytest.approx(29.238e3, rel=1e-4)
    assert pressure_at(pulses, 0.0) == pressure_at(pulses, 1e4) == 0.0
    assert impulse_between(pulses, 1.0, 1e4) == 0.0


def test_3_a_pulse_arrives_decays_and_ends():
    # The pressure began everywhere at once, went on below zero after the phase, and always fell with a decay of 1.
    pulses = report_pulses(50.0, 1000.0)
    arrival, end = pulses.arrivals_s.item(), pulses.ends_s.item()
    assert arrival == pytest.approx(0.090, rel=0.02)  # 50 m behind a front of 1.1 to 2 times the speed of sound
    assert pressure_at(pulses, arrival - 1e-6) == pressure_at(pulses, end + 1e-6) == 0.0
    assert (pressure_at(pulses, np.linspace(0.0, 10.0, 10_001)) >= 0.0).all()
    solved = blast_pulses([[10.0, 50.0, 200.0]], [1000.0] * 3, [0.0] * 3, ["air"] * 3)
    assert solved.decays[0] == pytest.approx([8.48, 0.80, 0.19], abs=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("fps, fps_base", [(24, 1.0), (60, 1.0), (240, 1.0), (30, 1.001)])
@pytest.mark.parametrize("substeps, time_scale", [(1, 1.0), (10, 1.0), (10, 0.05)])
def test_4_impulse_does_not_depend_on_frames_and_steps(fps, fps_base, substeps, time_scale):
    # Elapsed time was the frame times the time scale over the steps per second: ten times too slow at ten sub-steps.
    step = TimeStep(fps, fps_base, substeps, time_scale)
    pulses = blast_pulses([[7.0, 19.0]], [50.0, 200.0], [0.0, 0.1], ["air", "surface"])
    total, time = 0.0, 0.0
    while time < 0.25:
        total = total + impulse_between(pulses, time, time + step.substep_s)
        time += step.substep_s
    # Up to 12 000 steps are added up.
    np.testing.assert_allclose(total, pulses.impulses_pa_s, rtol=1e-9)


def test_5_directions_are_unit_vectors_from_each_charge():
    # The area grew with the distance, and was that towards one fixed point whichever charge went off.
    charges, body = np.array([[-100.0, 0.0, 0.0], [0.0, -3.0, -3.0]]), np.zeros((1, 3))
    _, directions = lines_of_blast(charges, body)
    areas = projected_areas(convex_hulls([CUBE]), np.eye(3)[None], directions)
    assert areas[0] == pytest.approx([1.0, np.sqrt(2.0)])
    np.testing.assert_allclose(np.linalg.norm(directions, axis=2), 1.0, rtol=1e-15)


def test_6_time_is_divided_by_the_duration():
    # The MATLAB listing multiplied by it, so that long pulses ended first.
    near, far = report_pulses(20.0, 1000.0), report_pulses(200.0, 1000.0)
    assert near.durations_s < far.durations_s
    for pulses in (near, far):
        half_way = pulses.arrivals_s + pulses.durations_s / 2.0
        assert pressure_at(pulses, half_way) == pytest.approx(pulses.peaks_pa * 0.5 * np.exp(-0.5))
