# SPDX-License-Identifier: GPL-3.0-or-later
"""Means, peaks and impulses of frames against bodies that hang, are squeezed and are hit, worked out by hand."""

from dataclasses import fields, replace

import numpy as np
import pytest

from bridge_demolition_addon.engineering.mechanics.frame_loads import FrameLoads, LoadAccumulator, SubstepLoads

NO_PAIRS, NO_VECTORS = np.zeros((0, 2), int), np.zeros((0, 3))

# Sub-steps of unequal length, in s; exact in binary so that only the sums round.
UNEQUAL_S = (0.25, 0.5, 0.125)
FRAME_S = 0.875

# Rounding in sums of a few numbers up to 1000.
ROUNDING = 1e-12


def loads_of(
    centres,
    pairs=NO_PAIRS,
    forces=NO_VECTORS,
    moments=None,
    points=None,
    signed=None,
    contact_pairs=NO_PAIRS,
    contact_forces=NO_VECTORS,
    contact_points=None,
    rotations=None,
):
    """Loads of one sub-step of one second; what is not given is zero, and bodies are not turned."""
    count = len(pairs)
    return SubstepLoads(
        substeps_s=np.ones(1),
        connection_forces_n=np.asarray(forces, float).reshape(1, count, 3),
        connection_moments_nm=np.zeros((1, count, 3)) if moments is None else np.asarray(moments, float)[None],
        connection_points_m=np.zeros((1, count, 3)) if points is None else np.asarray(points, float)[None],
        signed_2019_ns=np.zeros((1, count)) if signed is None else np.asarray(signed, float)[None],
        contact_substeps=np.zeros(len(contact_pairs), int),
        contact_pairs=np.asarray(contact_pairs, int),
        contact_impulses_ns=np.asarray(contact_forces, float).reshape(-1, 3),
        contact_points_m=np.zeros((len(contact_pairs), 3)) if contact_points is None else np.asarray(contact_points),
        centres_m=np.asarray(centres, float)[None],
        rotations=(np.tile(np.eye(3), (len(centres), 1, 1)) if rotations is None else rotations)[None],
    )


def frame_loads(pairs, volumes, normals=None):
    """Normals, vertical unless given, turn with the first bodies."""
    pairs = np.asarray(pairs)
    normals = np.tile([0.0, 0.0, 1.0], (len(pairs), 1)) if normals is None else np.asarray(normals, float)
    return LoadAccumulator(
        pairs, np.asarray(volumes, float), lambda turned: np.einsum("mij,mj->mi", turned[pairs[:, 0]], normals)
    )


def during(loads, substep_s):
    """The loads of one second, in a sub-step of another length."""
    impulses = {name: substep_s * getattr(loads, name) for name in ("contact_impulses_ns", "signed_2019_ns")}
    return replace(loads, substeps_s=np.array([substep_s]), **impulses)


def together(history):
    """Loads of several sub-steps as one."""
    arrays = {
        item.name: np.concatenate([getattr(substep, item.name) for substep in history]) for item in fields(SubstepLoads)
    }
    counts = [len(substep.contact_substeps) for substep in history]
    return SubstepLoads(**arrays | {"contact_substeps": np.repeat(np.arange(len(history)), counts)})


def by_name(loads):
    known = {item.name: getattr(loads, item.name) for item in fields(FrameLoads)}
    of_bars = "body_bar_use", "connection_bars"  # which are not of the sub-steps' loads
    return {name: values for name, values in known.items() if name not in of_bars}


def gathered(frame, history, substeps=UNEQUAL_S):
    """Loads of a frame, added one sub-step at a time; added all at once they are the same to the last bit."""
    history = [during(loads, substep_s) for loads, substep_s in zip(history, substeps, strict=True)]
    resultants = frame.add(together(history))
    at_once = frame.finish()
    frame.begin()
    one_by_one = [frame.add(substep)[0] for substep in history]
    loads = frame.finish()
    np.testing.assert_array_equal(resultants, one_by_one)
    for name, values in by_name(loads).items():
        np.testing.assert_array_equal(values, getattr(at_once, name), err_msg=name)
    return loads


# Body 0 is the ceiling at 10 m; 1 weighs 100 N and hangs on it, 2 weighs 40 N and hangs on 1. Both are cubes of 2 m.
CHAIN = np.array([[1, 0], [1, 2]])
CHAIN_CENTRES = np.array([[0.0, 0.0, 11.0], [0.0, 0.0, 9.0], [0.0, 0.0, 7.0]])
CHAIN_POINTS = np.array([[0.0, 0.0, 10.0], [0.0, 0.0, 8.0]])
CHAIN_VOLUMES = np.array([0.0, 8.0, 8.0])
CHAIN_NORMALS = [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]


def chain_loads(share=1.0):
    return loads_of(
        CHAIN_CENTRES,
        CHAIN,
        share * np.array([[0.0, 0.0, 140.0], [0.0, 0.0, -40.0]]),
        points=CHAIN_POINTS,
    )


def test_hanging_chain_at_rest():
    loads = gathered(frame_loads(CHAIN, CHAIN_VOLUMES, CHAIN_NORMALS), [chain_loads()] * 3)
    np.testing.assert_allclose(loads.connection_forces_n, [[0, 0, 140], [0, 0, -40]], atol=ROUNDING)
    np.testing.assert_allclose(loads.body_forces_n, [[0, 0, -140], [0, 0, 100], [0, 0, 40]], atol=ROUNDING)
    np.testing.assert_allclose(loads.body_sums_n, [140, 180, 40], atol=ROUNDING)
    # Where nothing changes, the largest is the mean.
    assert loads.connection_peaks_n.tolist() == [140, 40]
    assert loads.connection_peak_forces_n.tolist() == [[0, 0, 140], [0, 0, -40]]
    assert loads.body_peaks_n.tolist() == [140, 100, 40]
    assert loads.body_peak_sums_n.tolist() == [140, 180, 40]
    assert not loads.body_contact_impulses_ns.any() and not loads.connection_moments_nm.any()


def test_stress_in_a_hanging_chain_is_that_in_the_middle_of_each_body():
    loads = gathered(frame_loads(CHAIN, CHAIN_VOLUMES, CHAIN_NORMALS), [chain_loads()] * 3)
    expected = np.zeros((3, 3, 3))
    # What hangs below, and half of itself, over 4 m²; the ceiling has no volume and so no stress.
    expected[1, 2, 2], expected[2, 2, 2] = (40 + 50) / 4, 20 / 4
    np.testing.assert_allclose(loads.stresses_pa, expected, atol=ROUNDING)
    np.testing.assert_allclose(loads.von_mises_pa, [0, 22.5, 5], atol=ROUNDING)


@pytest.mark.parametrize("edge, force", [(1.0, 6.0), (0.5, 100.0), (4.0, 1.0)])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_block_squeezed_between_two_contacts(edge, force, axis):
    """The middle one of three bodies, pressed from both sides in the centres of its faces."""
    towards = np.eye(3)[axis]
    centres = np.array([7.0, -3.0, 2.0]) + edge * np.array([-towards, 0 * towards, towards])
    squeezed = loads_of(
        centres,
        contact_pairs=[[1, 0], [2, 1]],
        contact_forces=[force * towards, force * towards],  # on the middle one, then on the last
        contact_points=centres[1] + edge / 2 * np.array([-towards, towards]),
    )
    loads = gathered(frame_loads(NO_PAIRS, [0.0, edge**3, 0.0]), [squeezed] * 3)
    stress = -force / edge**2 * np.diag(towards)
    # Rounding of forces up to 100 and stresses up to 400, by coordinates up to 9 whose last place is not exact.
    np.testing.assert_allclose(loads.stresses_pa, [0 * stress, stress, 0 * stress], atol=1e-11)
    np.testing.assert_allclose(loads.von_mises_pa, [0, force / edge**2, 0], atol=1e-11)
    np.testing.assert_allclose(loads.body_forces_n, force * np.array([-towards, 0 * towards, towards]), atol=ROUNDING)
    np.testing.assert_allclose(loads.body_sums_n, [force, 2 * force, force], atol=ROUNDING)
    assert loads.body_peaks_n.tolist() == [force, 0, force]
    assert loads.body_peak_sums_n.tolist() == [force, 2 * force, force]
    np.testing.assert_allclose(
        loads.body_contact_impulses_ns, FRAME_S * force * np.array([-towards, 0 * towards, towards]), atol=ROUNDING
    )
    assert not loads.body_signed_2019_n.any()


def test_connections_and_contacts_act_together():
    """A block of 100 N that hangs with 70 N and stands on a floor with the remaining 30 N."""
    centres = [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.0, 0.0, 3.0]]  # block, floor, ceiling
    loads = loads_of(
        centres,
        [[0, 2]],
        [[0.0, 0.0, 70.0]],
        points=[[0.0, 0.0, 2.0]],
        contact_pairs=[[1, 0]],
        contact_forces=[[0.0, 0.0, -30.0]],
        contact_points=[[0.0, 0.0, 0.0]],
    )
    frame = frame_loads([[0, 2]], [8.0, 0.0, 0.0])
    found = gathered(frame, [loads] * 3)
    np.testing.assert_allclose(found.body_forces_n, [[0, 0, 100], [0, 0, -30], [0, 0, -70]], atol=ROUNDING)
    np.testing.assert_allclose(found.body_sums_n, [100, 30, 70], atol=ROUNDING)
    # Only the floor's share is an impulse of contacts.
    np.testing.assert_allclose(
        found.body_contact_impulses_ns, FRAME_S * np.array([[0, 0, 30], [0, 0, -30], [0, 0, 0]]), atol=ROUNDING
    )
    # In its middle 70 N pull above and 30 N push below, and its own weight makes up the difference: (70 - 30) / 2 / 4.
    np.testing.assert_allclose(found.stresses_pa[0], np.diag([0.0, 0, 5]), atol=ROUNDING)


def test_mean_is_impulse_over_time_and_peak_the_largest_however_short():
    """A push that changes from sub-step to sub-step, largest in the shortest."""
    pushes = (8.0, 2.0, 40.0)
    history = [loads_of(np.zeros((2, 3)), contact_pairs=[[0, 1]], contact_forces=[[push, 0.0, 0.0]]) for push in pushes]
    loads = gathered(frame_loads(NO_PAIRS, np.zeros(2)), history)
    impulse = 8 * 0.25 + 2 * 0.5 + 40 * 0.125
    assert loads.body_contact_impulses_ns.tolist() == [[impulse, 0, 0], [-impulse, 0, 0]]
    np.testing.assert_allclose(loads.body_forces_n, [[impulse / FRAME_S, 0, 0], [-impulse / FRAME_S, 0, 0]])
    np.testing.assert_allclose(loads.body_sums_n, impulse / FRAME_S)
    assert loads.body_peaks_n.tolist() == loads.body_peak_sums_n.tolist() == [40, 40]


def test_a_constant_force_has_its_own_value_as_mean_whatever_the_sub_steps():
    pull = loads_of(np.zeros((2, 3)), [[0, 1]], [[3.0, 0.0, 4.0]])
    for substeps in (UNEQUAL_S, (1.0,), (1 / 240,) * 10, (1e-6, 1.0)):
        loads = gathered(frame_loads([[0, 1]], np.zeros(2)), [pull] * len(substeps), substeps)
        # Rounding of up to ten sums.
        np.testing.assert_allclose(loads.connection_forces_n, [[3, 0, 4]], rtol=1e-14)
        np.testing.assert_allclose(loads.body_sums_n, [5, 5], rtol=1e-14)
        assert loads.connection_peaks_n.tolist() == [5]


def test_forces_that_turn_about_cancel_in_the_mean_but_not_in_sums_and_peaks():
    pair = np.array([[0, 1]])
    to_and_fro = [loads_of(np.zeros((2, 3)), pair, [[force, 0.0, 0.0]]) for force in (6.0, -6.0)]
    loads = gathered(frame_loads(pair, np.zeros(2)), to_and_fro, (0.5, 0.5))
    assert not loads.connection_forces_n.any() and not loads.body_forces_n.any()
    assert loads.body_sums_n.tolist() == loads.body_peaks_n.tolist() == [6, 6]


def test_peaks_of_a_body_are_of_one_moment():
    """Two pulls on body 0 at different times: no sub-step has both."""
    pairs = np.array([[0, 1], [0, 2]])
    history = [
        loads_of(np.zeros((3, 3)), pairs, [[10.0, 0, 0], [0.0, 0, 0]]),
        loads_of(np.zeros((3, 3)), pairs, [[0.0, 0, 0], [7.0, 0, 0]]),
    ]
    loads = gathered(frame_loads(pairs, np.zeros(3)), history, (0.5, 0.5))
    assert loads.connection_peaks_n.tolist() == [10, 7]
    assert loads.body_peaks_n.tolist() == loads.body_peak_sums_n.tolist() == [10, 10, 7]
    # Opposite pulls at the same time leave no resultant.
    opposite = [loads_of(np.zeros((3, 3)), pairs, [[10.0, 0, 0], [-10.0, 0, 0]])]
    loads = gathered(frame_loads(pairs, np.zeros(3)), opposite, (0.5,))
    assert loads.body_peaks_n.tolist() == [0, 10, 10]
    assert loads.body_peak_sums_n.tolist() == [20, 10, 10]


def test_force_and_moment_at_the_peak_are_those_of_the_same_sub_step():
    """Each connection has its largest force at another time, and the largest moment at none of them."""
    pairs = np.array([[0, 1], [1, 2]])
    history = [
        loads_of(np.zeros((3, 3)), pairs, [[3.0, 0, 4], [1, 0, 0]], moments=[[1.0, 0, 0], [2, 0, 0]]),
        loads_of(np.zeros((3, 3)), pairs, [[0.0, -1, 0], [0, 2, 0]], moments=[[90.0, 0, 0], [90, 0, 0]]),
        loads_of(np.zeros((3, 3)), pairs, [[0.0, 2, 0], [0, 0, -9]], moments=[[0.0, 5, 0], [0, 0, 6]]),
    ]
    loads = gathered(frame_loads(pairs, np.zeros(3)), history)
    assert loads.connection_peaks_n.tolist() == [5, 9]
    assert loads.connection_peak_forces_n.tolist() == [[3, 0, 4], [0, 0, -9]]
    assert loads.connection_peak_moments_nm.tolist() == [[1, 0, 0], [0, 0, 6]]
    # 90 N·m for 0.5 s, and the others' shares; one moment on the first body of each.
    mean = np.array([[0.25 * 1 + 0.5 * 90, 0.125 * 5, 0], [0.25 * 2 + 0.5 * 90, 0, 0.125 * 6]]) / FRAME_S
    np.testing.assert_allclose(loads.connection_moments_nm, mean, rtol=1e-14)  # rounding of three sums


def test_signed_numbers_are_added_for_first_bodies_and_taken_off_for_second():
    pairs = np.array([[0, 1], [1, 2], [2, 0], [0, 1]])
    history = [loads_of(np.zeros((4, 3)), pairs, np.zeros((4, 3)), signed=(1.0, 10.0, -100.0, 1000.0))]
    history.append(loads_of(np.zeros((4, 3)), pairs, np.zeros((4, 3)), signed=(3.0, 30.0, -300.0, 3000.0)))
    loads = gathered(frame_loads(pairs, np.zeros(4)), history, (0.5, 0.5))
    # Of body 0 in the first sub-step: 1 + 1000 of its first places, less -100 of its second. The mean is twice that.
    assert loads.body_signed_2019_n.tolist() == [2 * 1101, 2 * (10 - 1001), 2 * (-100 - 10), 0]
    # They are for comparison only: forces know nothing of them.
    assert not loads.body_forces_n.any() and not loads.body_peak_sums_n.any()


@pytest.mark.parametrize("angle", [0.0, 0.7])
def test_stress_in_a_beam_counts_the_moments_of_its_connections(angle):
    """A weightless cube of 2 m in a beam between two others: shear V at both ends needs the end moments' difference."""
    shear, tension, moment, area = 30.0, 50.0, 7.0, 4.0
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    pairs = np.array([[0, 1], [1, 2]])  # the cube is the second body of one connection and the first of the other
    loads = loads_of(
        np.array([[0.0, 0, 0], [2.0, 0, 0], [4.0, 0, 0]]) @ turn.T,
        pairs,
        np.array([[tension, 0, shear], [tension, 0, shear]]) @ turn.T,
        # On the first bodies. About the middle of the cube, shear makes 2 × 30 N × 1 m about -y.
        moments=np.array([[0.0, moment, 0], [0.0, moment + 2 * shear, 0]]) @ turn.T,
        points=np.array([[1.0, 0, 0], [3.0, 0, 0]]) @ turn.T,
        rotations=np.tile(turn, (3, 1, 1)),
    )
    frame = frame_loads(pairs, [0.0, 8.0, 0.0], [[1.0, 0, 0], [1.0, 0, 0]])
    found = gathered(frame, [loads] * 3)
    expected = turn @ np.array([[tension, 0, shear], [0, 0, 0], [shear, 0, 0]]) @ turn.T / area
    np.testing.assert_allclose(found.stresses_pa[1], expected, atol=ROUNDING)
    assert found.von_mises_pa[1] == pytest.approx(np.sqrt(tension**2 + 3 * shear**2) / area)
    # The outer two have no volume.
    assert not found.stresses_pa[[0, 2]].any() and not found.von_mises_pa[[0, 2]].any()


def test_stress_is_that_of_the_mean_loads_but_its_peak_that_of_the_heaviest_sub_step():
    history = [chain_loads(share) for share in (1.0, -0.5, 0.0)]
    loads = gathered(frame_loads(CHAIN, CHAIN_VOLUMES, CHAIN_NORMALS), history)
    mean = (0.25 * 1.0 - 0.5 * 0.5) / FRAME_S
    np.testing.assert_allclose(loads.stresses_pa[:, 2, 2], mean * np.array([0, 22.5, 5]), atol=ROUNDING)
    np.testing.assert_allclose(loads.von_mises_pa, [0, 22.5, 5], atol=ROUNDING)


def test_equivalent_stresses_are_of_one_moment_for_all_bodies():
    """Two blocks on a floor, each hit once: the peak is that of the harder hit, in which the other block rests."""
    centres = np.array([[0.0, 0, -1], [0, 0, 1], [5, 0, 1]])
    points = [[0.0, 0, 0], [5.0, 0, 0]]
    hits = [
        loads_of(centres, contact_pairs=[[1, 0], [2, 0]], contact_forces=forces, contact_points=points)
        for forces in ([[0, 0, 80.0], [0, 0, 8.0]], [[0, 0, 8.0], [0, 0, 40.0]])
    ]
    for history in (hits, hits[::-1]):
        loads = gathered(frame_loads(NO_PAIRS, [0.0, 8.0, 8.0]), history, (0.5, 0.5))
        # At a lever of 1 m, over 8 m³.
        assert loads.von_mises_pa.tolist() == [0, 10, 1]
        assert loads.stresses_pa[:, 2, 2].tolist() == [0, -(80 + 8) / 2 / 8, -(8 + 40) / 2 / 8]


def test_loads_act_where_the_bodies_are_in_each_sub_step():
    """A squeezed block that moves along with its contacts is squeezed all the same."""
    history = []
    for position in ([0.0, 0, 0], [100.0, 5, -3], [7.0, 7, 7]):
        centres = np.array([[0.0, 0, -2], [0, 0, 0], [0, 0, 2]]) + position
        history.append(
            loads_of(
                centres,
                contact_pairs=[[1, 0], [1, 2]],
                contact_forces=[[0, 0, 12.0], [0, 0, -12.0]],
                contact_points=np.array([[0.0, 0, -1], [0, 0, 1]]) + position,
            )
        )
    loads = gathered(frame_loads(NO_PAIRS, [8.0, 8.0, 8.0]), history)
    np.testing.assert_allclose(loads.stresses_pa[1], np.diag([0, 0, -3.0]), atol=ROUNDING)


def test_any_loads_against_sums_body_by_body():
    """Everything at once, of 12 bodies, 30 connections and up to 20 contacts, added up in plain loops."""
    random = np.random.default_rng(8)
    count = 12
    pairs = np.array([random.choice(count, 2, replace=False) for _ in range(30)])
    volumes = random.uniform(0.5, 2.0, count)
    normals = random.normal(size=(30, 3))
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    centres, points = random.normal(size=(count, 3)), random.normal(size=(30, 3))
    history = [
        loads_of(
            centres,
            pairs,
            random.normal(size=(30, 3)),
            random.normal(size=(30, 3)),
            points,
            random.normal(size=30),
            np.array([random.choice(count, 2, replace=False) for _ in range(contacts)], int).reshape(-1, 2),
            random.normal(size=(contacts, 3)),
            random.normal(size=(contacts, 3)),
        )
        for contacts in (7, 20, 0)
    ]
    loads = gathered(frame_loads(pairs, volumes, normals), history)
    # Rounding in sums of some ten numbers around 1.
    rounding = {"atol": 1e-13}
    # Third law.
    np.testing.assert_allclose(loads.body_forces_n.sum(axis=0), 0.0, **rounding)
    np.testing.assert_allclose(loads.body_contact_impulses_ns.sum(axis=0), 0.0, **rounding)
    everything = []
    for body in range(count):
        resultants, sums, stresses = [], [], []
        for in_substep in history:
            acting = [
                (sign * force, point)
                for two, forces, positions in (
                    (pairs, in_substep.connection_forces_n[0], points),
                    (in_substep.contact_pairs, in_substep.contact_impulses_ns, in_substep.contact_points_m),
                )
                for pair, force, point in zip(two, forces, positions, strict=True)
                for side, sign in ((0, 1.0), (1, -1.0))
                if pair[side] == body
            ]
            stress = sum((np.outer(force, point - centres[body]) for force, point in acting), np.zeros((3, 3)))
            # The same moment turns the other way on the second body; which way the normal points does not matter.
            stress += sum(
                (1.0 if body == pair[0] else -1.0) * np.outer(normal, np.cross(normal, moment))
                for pair, normal, moment in zip(pairs, normals, in_substep.connection_moments_nm[0], strict=True)
                if body in pair
            )
            resultants.append(sum((force for force, _ in acting), np.zeros(3)))
            sums.append(sum(np.linalg.norm(force) for force, _ in acting))
            stresses.append((stress + stress.T) / 2 / volumes[body])
        for name, values in (("body_forces_n", resultants), ("body_sums_n", sums), ("stresses_pa", stresses)):
            mean = sum(substep * value for substep, value in zip(UNEQUAL_S, values, strict=True)) / FRAME_S
            np.testing.assert_allclose(getattr(loads, name)[body], mean, **rounding)
        np.testing.assert_allclose(loads.body_peaks_n[body], max(map(np.linalg.norm, resultants)), **rounding)
        np.testing.assert_allclose(loads.body_peak_sums_n[body], max(sums), **rounding)
        everything.append((sums, stresses))
    heaviest = np.sum([sums for sums, _ in everything], axis=0).argmax()
    assert heaviest == 1  # the sub-step with 20 contacts, neither first nor last
    deviators = [stresses[heaviest] - np.trace(stresses[heaviest]) / 3 * np.eye(3) for _, stresses in everything]
    equivalent = [np.sqrt(1.5 * (deviator**2).sum()) for deviator in deviators]
    np.testing.assert_allclose(loads.von_mises_pa, equivalent, **rounding)


def test_a_second_frame_begins_from_nothing():
    frame = frame_loads(CHAIN, CHAIN_VOLUMES, CHAIN_NORMALS)
    push = {"contact_pairs": [[1, 2]], "contact_forces": [[9.0, 0, 0]], "signed": (4.0, 5.0)}
    loud = loads_of(CHAIN_CENTRES, CHAIN, [[0, 0, 1000.0], [500.0, 0, 0]], moments=np.ones((2, 3)), **push)
    first = gathered(frame, [loud] * 3)
    kept = {name: values.copy() for name, values in by_name(first).items()}
    frame.begin()
    second = gathered(frame, [chain_loads()] * 3)
    alone = gathered(frame_loads(CHAIN, CHAIN_VOLUMES, CHAIN_NORMALS), [chain_loads()] * 3)
    for name, values in by_name(alone).items():
        assert np.array_equal(getattr(second, name), values), name
        # What was handed out for the first frame is not touched by the second.
        assert np.array_equal(getattr(first, name), kept[name]), name
        # The first frame had something in every array, so that something could have been left over.
        assert getattr(first, name).any(), name


def test_a_frame_without_time_has_no_loads():
    frame = frame_loads(CHAIN, CHAIN_VOLUMES, CHAIN_NORMALS)
    gathered(frame, [chain_loads()] * 3)
    frame.begin()
    shapes = {name: values.shape for name, values in by_name(frame.finish()).items()}
    assert not any(values.any() for values in by_name(frame.finish()).values())
    assert shapes == {
        "connection_forces_n": (2, 3),
        "connection_moments_nm": (2, 3),
        "connection_peaks_n": (2,),
        "connection_peak_forces_n": (2, 3),
        "connection_peak_moments_nm": (2, 3),
        "body_forces_n": (3, 3),
        "body_peaks_n": (3,),
        "body_sums_n": (3,),
        "body_peak_sums_n": (3,),
        "body_contact_impulses_ns": (3, 3),
        "body_signed_2019_n": (3,),
        "stresses_pa": (3, 3, 3),
        "von_mises_pa": (3,),
    }


@pytest.mark.parametrize("bodies", [0, 1, 3])
def test_without_connections_and_contacts_there_are_no_loads(bodies):
    loads = gathered(frame_loads(NO_PAIRS, np.ones(bodies)), [loads_of(np.zeros((bodies, 3)))] * 3)
    assert loads.connection_forces_n.shape == (0, 3)
    assert loads.body_forces_n.shape == (bodies, 3)
    assert loads.stresses_pa.shape == (bodies, 3, 3)
    for name, values in by_name(loads).items():
        assert values.dtype == np.float64, name
        assert not values.any(), name


def test_contacts_come_and_go_within_a_frame():
    centres = np.array([[0.0, 0, 0], [0, 0, 2]])
    touching = loads_of(
        centres, contact_pairs=[[0, 1]], contact_forces=[[0, 0, -16.0]], contact_points=[[0.0, 0.0, 1.0]]
    )
    loads = gathered(frame_loads(NO_PAIRS, [8.0, 8.0]), [loads_of(centres), touching, loads_of(centres)])
    assert loads.body_contact_impulses_ns.tolist() == [[0, 0, -8], [0, 0, 8]]
    # -16 N at a lever of 1 m, over 8 m³, during 0.5 s of 0.875 s.
    np.testing.assert_allclose(loads.stresses_pa[:, 2, 2], -2 * 0.5 / FRAME_S, rtol=1e-14)
    assert loads.von_mises_pa.tolist() == [2, 2]


@pytest.mark.parametrize("moment", [0, 1, 2])
def test_loads_that_are_not_known_do_not_pass_for_none(moment):
    """Bullet's numbers may overflow, at any time; a body without a volume has no stress all the same."""
    pushes = {"contact_pairs": [[0, 1], [3, 2]], "contact_points": np.zeros((2, 3))}
    history = [loads_of(np.ones((4, 3)), contact_forces=[[7.0, 0, 0], [5.0, 0, 0]], **pushes)] * 3
    history[moment] = loads_of(np.ones((4, 3)), contact_forces=[[np.nan, 0, 0], [5.0, 0, 0]], **pushes)
    loads = gathered(frame_loads(NO_PAIRS, [1.0, 0.0, 0.0, 1.0]), history)
    assert np.isnan(loads.body_peaks_n).tolist() == [True, True, False, False]
    assert np.isnan(loads.stresses_pa).any(axis=(1, 2)).tolist() == [True, False, False, False]
    assert np.isnan(loads.von_mises_pa).tolist() == [True, False, False, False]
    # The other two are known: 5 N at a lever of -1 m, over 1 m³; 5 N.
    assert loads.stresses_pa[3, 0, 0] == pytest.approx(-5.0)
    assert loads.body_peaks_n[2:].tolist() == [5, 5]


def test_connections_whose_loads_are_not_known():
    unknown = loads_of(np.ones((3, 3)), [[0, 1], [1, 2]], [[1.0, 0, 0]] * 2, moments=[[0.0, 0, 0], [0, np.nan, 0]])
    loads = gathered(frame_loads([[0, 1], [1, 2]], [1.0, 1.0, 0.0]), [unknown] * 3)
    assert np.isnan(loads.stresses_pa).any(axis=(1, 2)).tolist() == [False, True, False]
    assert np.isnan(loads.von_mises_pa).tolist() == [False, True, False]
    assert not np.isnan(loads.body_peaks_n).any()
