# SPDX-License-Identifier: GPL-3.0-or-later
"""Forces of bearings from those of their connections, held against sums done by hand."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.mechanics.bearing_loads import BearingAccumulator, BearingPads
from bridge_demolition_addon.engineering.mechanics.frame_loads import SubstepLoads

POINTS_M = np.array([[0.0, -1.0, 1.0], [0.0, 2.0, 1.0], [5.0, 0.0, 1.0]])
"""Two pads of a bearing, the first with twice the area, so that its middle is above the origin; and one of another."""
AREAS_M2 = np.array([2.0, 1.0, 1.0])
QUARTER_TURN = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])


def pads(**changed):
    """Body 0 lies on body 1 by the first bearing, and on body 2 by the second; stiffness 1 kN/m sideways."""
    given = {
        "rows": np.arange(3),
        "bearings": np.array([0, 0, 1]),
        "pairs": np.array([[0, 1], [0, 1], [0, 2]]),
        "points_m": POINTS_M,
        "areas_m2": AREAS_M2,
        "sideways_n_m": np.full((3, 2), 1e3),
        "lifts_off": np.ones(3, bool),
        "positions_m": np.zeros((3, 3)),
        "rotations": np.tile(np.eye(3), (3, 1, 1)),
    }
    return BearingPads.as_built(**given | changed)


def loads(forces_n, *, moments_nm=None, moved_m=(0.0, 0.0, 0.0), rotation=None, substeps_s=(0.1, 0.3)):
    """Sub-steps with forces (s, 3, 3) of the connections, with body 0 moved and turned."""
    count = len(substeps_s)
    centres_m, rotations = np.zeros((count, 3, 3)), np.tile(np.eye(3), (count, 3, 1, 1))
    centres_m[:, 0] = moved_m
    if rotation is not None:
        rotations[:, 0] = rotation
    forces_n = np.array(forces_n, float)
    nothing = np.zeros((0, 3))
    return SubstepLoads(
        substeps_s=np.array(substeps_s),
        connection_forces_n=forces_n,
        connection_moments_nm=np.zeros_like(forces_n) if moments_nm is None else np.array(moments_nm, float),
        connection_points_m=np.tile(POINTS_M, (count, 1, 1)),
        signed_2019_ns=np.zeros((count, 3)),
        contact_substeps=np.zeros(0, int),
        contact_pairs=np.zeros((0, 2), int),
        contact_impulses_ns=nothing,
        contact_points_m=nothing,
        centres_m=centres_m,
        rotations=rotations,
    )


def of_frame(substeps, given=None):
    accumulator = BearingAccumulator(given or pads())
    accumulator.add(substeps)
    return accumulator.finish()


FORCES_N = [
    [[0.0, 0.0, 10.0], [0.0, 0.0, 20.0], [3.0, 4.0, 1.0]],
    [[0.0, 0.0, 30.0], [0.0, 0.0, 0.0], [0.0, 0.0, -5.0]],
]


def test_forces_are_means_over_time_and_peaks_are_those_of_sub_steps():
    """Sums are 30 and 30, then 1 and -5; the first sub-step is a quarter of the frame."""
    found = of_frame(loads(FORCES_N))
    assert found.forces_n[0] == pytest.approx([0.0, 0.0, 30.0])
    assert found.forces_n[1] == pytest.approx([0.75, 1.0, 0.25 * 1.0 - 0.75 * 5.0])
    assert found.largest_up_n == pytest.approx([30.0, 1.0])
    assert found.least_up_n == pytest.approx([30.0, -5.0])
    assert found.largest_horizontal_n == pytest.approx([0.0, 5.0])


def test_moments_are_about_the_middle_of_the_axis_and_turn_with_what_lies_above():
    """A force F upwards at y has the moment y F about x: -10 + 40 = 30, then -30; turned by 90° it is about y."""
    assert of_frame(loads(FORCES_N)).moments_nm[0] == pytest.approx([0.25 * 30.0 - 0.75 * 30.0, 0.0, 0.0])
    turned = of_frame(loads(FORCES_N, rotation=QUARTER_TURN))
    assert turned.moments_nm[0] == pytest.approx([0.0, 0.25 * 30.0 - 0.75 * 30.0, 0.0])
    assert turned.largest_moment_y_nm == pytest.approx([30.0, 0.0])
    own = np.zeros((2, 3, 3))
    own[:, 2, 1] = 7.0
    assert of_frame(loads(FORCES_N, moments_nm=own)).moments_nm[1] == pytest.approx([0.0, 7.0, 0.0])


def test_what_carries_nothing_is_open_unless_it_holds_against_uplift():
    """In the second sub-step the pad with a third of the area carries nothing, and in none of them all of it."""
    assert of_frame(loads(FORCES_N)).open_shares == pytest.approx([1.0 / 3.0, 0.0])
    holds = pads(lifts_off=np.zeros(3, bool))
    assert of_frame(loads(FORCES_N), holds).open_shares == pytest.approx([0.0, 0.0])
    lifted = np.array(FORCES_N)
    lifted[1, :2] = 0.0
    assert of_frame(loads(lifted)).open_shares == pytest.approx([1.0, 0.0])


def test_slip_is_the_displacement_without_the_deformation():
    """Moved by 10 mm along, each pad resists by 4 N: 4 mm of that is deformation at 1 kN/m."""
    forces = np.zeros((2, 3, 3))
    forces[:, :, 0], forces[:, :, 2] = -4.0, 10.0
    found = of_frame(loads(forces, moved_m=(0.01, 0.0, 0.002)))
    assert found.displacements_m == pytest.approx(np.array([[0.01, 0.0, 0.002]] * 2))
    assert found.slips_m == pytest.approx([0.006] * 2)
    free = pads(sideways_n_m=np.array([[0.0, 1e3]] * 3))
    assert of_frame(loads(forces, moved_m=(0.01, 0.0, 0.0)), free).slips_m == pytest.approx([0.0] * 2)
    rigid = pads(sideways_n_m=np.full((3, 2), np.inf))
    assert np.isnan(of_frame(loads(forces), rigid).slips_m).all()


def test_how_sub_steps_are_put_together_makes_no_difference():
    one, two = BearingAccumulator(pads()), BearingAccumulator(pads())
    one.add(loads(FORCES_N))
    for number, substep_s in enumerate((0.1, 0.3)):
        two.add(loads(FORCES_N[number : number + 1], substeps_s=(substep_s,)))
    of_one, of_two = one.finish(), two.finish()
    for name in of_one.__slots__:
        assert np.array_equal(getattr(of_one, name), getattr(of_two, name)), name
    one.begin()
    assert one.finish() is None


def test_connections_may_come_in_any_order():
    order = np.array([2, 1, 0])
    mixed = pads(
        rows=order,
        bearings=np.array([1, 0, 0]),
        pairs=np.array([[0, 2], [0, 1], [0, 1]]),
        points_m=POINTS_M[order],
        areas_m2=AREAS_M2[order],
    )
    assert of_frame(loads(FORCES_N), mixed).moments_nm == pytest.approx(of_frame(loads(FORCES_N)).moments_nm)
