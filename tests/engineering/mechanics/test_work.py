# SPDX-License-Identifier: GPL-3.0-or-later
"""Work of gravity, loads, tools and the solver, held against the energies of motions that can be written down."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.mechanics.stress import PairSums
from bridge_demolition_addon.engineering.mechanics.work import FrameWork, Motion, PairImpulses, WorkAccumulator

GRAVITY = np.array([0.0, 0.0, -9.81])
STEP_S = 0.01
NONE = PairImpulses(np.zeros((0, 2), int), np.zeros((0, 3)), np.zeros((0, 3)), substeps=np.zeros(0, int))
PAIR = np.array([[0, 1]])


def motion(velocities, centres=None, spins=None):
    """Motion at the end of one sub-step."""
    velocities = np.array(velocities, float)
    centres, spins = (
        np.zeros_like(velocities) if vectors is None else np.array(vectors, float) for vectors in (centres, spins)
    )
    return Motion(centres[None], velocities[None], spins[None])


def contacts(impulses, pairs=PAIR):
    """Impulses of contacts at the origin, in one sub-step."""
    zeros = np.zeros(len(pairs), int)
    return PairImpulses(pairs, np.array(impulses, float), np.zeros((len(pairs), 3)), substeps=zeros)


def accumulator(masses, start, damping=0.0, gravity=(0.0, 0.0, 0.0)):
    share = np.full(len(masses), damping)
    return WorkAccumulator(np.array(masses, float), share, share, np.array(gravity, float), start)


def add(work, after, free, of_connections, of_contacts):
    """Add a sub-step, with the resultants that these impulses have."""
    shape = (1, len(free))
    both = (
        (PairSums(impulses.pairs, impulses.substeps, shape), impulses) for impulses in (of_connections, of_contacts)
    )
    resultants = sum(sums.resultants(impulses.impulses_ns) for sums, impulses in both)
    work.add(after, free[None], of_connections, of_contacts, resultants, np.array([STEP_S]))


def along_x(values):
    return [[value, 0.0, 0.0] for value in values]


def test_a_falling_body_gets_its_kinetic_energy_from_gravity():
    before, after = motion([[0.0, 0.0, -3.0]]), motion([[0.0, 0.0, -3.0 - 9.81 * STEP_S]], [[0, 0, -(3.0981) * STEP_S]])
    work = accumulator([20.0], before, gravity=GRAVITY)
    add(work, after, np.array([True]), NONE, NONE)
    frame = work.finish()
    assert frame.gravity_j == pytest.approx(0.5 * 20.0 * (3.0981**2 - 3.0**2), rel=1e-12)
    assert frame.made_j[0] == pytest.approx(0.0, abs=1e-9)
    assert frame.loads_j == pytest.approx(0.0, abs=1e-9)


def test_what_pushes_from_outside_is_a_load():
    work = accumulator([2.0], motion([[0.0, 0.0, 0.0]]))
    add(work, motion([[5.0, 0.0, 0.0]], [[5.0 * STEP_S, 0, 0]]), np.array([True]), NONE, NONE)
    assert work.finish().loads_j == pytest.approx(25.0, rel=1e-12)


def test_damping_takes_what_the_speed_loses():
    left = (1.0 - 0.04) ** STEP_S
    work = accumulator([2.0], motion([[10.0, 0.0, 0.0]]), damping=0.04)
    add(work, motion([[10.0 * left, 0.0, 0.0]], [[10.0 * left * STEP_S, 0, 0]]), np.array([True]), NONE, NONE)
    frame = work.finish()
    assert frame.damping_j == pytest.approx(100.0 * (1.0 - left**2), rel=1e-12)
    assert frame.loads_j == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("restitution", [0.0, 0.4, 1.0])
def test_an_impact_dissipates_what_textbooks_say(restitution):
    masses, speed = (3.0, 5.0), 4.0
    reduced = masses[0] * masses[1] / sum(masses)
    impulse = -reduced * speed * (1.0 + restitution)  # on the first body
    after = (speed + impulse / masses[0], -impulse / masses[1])
    work = accumulator(masses, motion(along_x((speed, 0.0))))
    contact = contacts([[impulse, 0.0, 0.0]])
    add(work, motion(along_x(after), STEP_S * np.array(along_x(after))), np.array([True, True]), NONE, contact)
    frame = work.finish()
    # A central impact with restitution e takes ½ μ u² of the reduced mass μ, less e² of it.
    assert frame.dissipated_j == pytest.approx(0.5 * reduced * speed**2 * (1.0 - restitution**2), abs=1e-12)
    assert frame.made_j.sum() == pytest.approx(0.0, abs=1e-12)


def test_bodies_that_are_pushed_apart_from_rest_got_their_energy_from_the_solver():
    masses, impulse = np.array([1.0, 4.0]), 6.0
    after = np.array([-impulse, impulse]) / masses
    work = accumulator(masses, motion(along_x((0.0, 0.0))))
    pushed = contacts([[-impulse, 0.0, 0.0]])
    add(work, motion(along_x(after), STEP_S * np.array(along_x(after))), np.array([True, True]), NONE, pushed)
    frame = work.finish()
    np.testing.assert_allclose(frame.made_j, 0.5 * masses * after**2, rtol=1e-12)
    assert frame.made_by_contacts_j == pytest.approx(frame.made_j.sum())
    assert (frame.made_by_connections_j, frame.made_by_lifting_j) == (0.0, pytest.approx(0.0, abs=1e-12))


@pytest.mark.parametrize(("apart", "made"), [(0, 0.75), (2, 0.75), (3, 3.0)])
def test_bodies_that_touch_give_back_what_they_took_and_all_above_that_is_made(apart, made):
    """2 kg stops on what never moves, which takes 2.25 J of it; later it leaves with 3 J, of which 0.75 J are made."""
    free = np.array([False, True])

    def speeds(velocity):
        return motion(along_x([0.0, velocity]))

    work = accumulator([0.0, 2.0], speeds(-1.5))
    add(work, speeds(0.0), free, NONE, contacts([[-3.0, 0.0, 0.0]]))
    assert work.finish().dissipated_j == pytest.approx(2.25)
    for _ in range(apart):
        add(work, speeds(0.0), free, NONE, NONE)
    leaves = np.sqrt(3.0)
    add(work, speeds(leaves), free, NONE, contacts([[-2.0 * leaves, 0.0, 0.0]]))
    frame = work.finish()
    assert frame.made_by_contacts_j == pytest.approx(made)
    assert frame.made_j[1] == pytest.approx(made)
    assert frame.dissipated_j == pytest.approx(made - 3.0)  # what comes back is not dissipated after all


def test_a_plate_that_rocks_from_one_edge_to_the_other_makes_no_energy():
    """It turns about y by ω: at the edge that comes down it loses J ω b / 2, at the other it gains less."""
    spins = np.array([[0.0, 0.0, 0.0], [0.0, 2.0, 0.0]])
    edges = np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])  # at x > 0 its velocity is -ω b: down
    impulses = np.array([[0.0, 0.0, -3.0], [0.0, 0.0, -1.0]])  # on the ground
    contact = PairImpulses(np.repeat(PAIR, 2, axis=0), impulses, edges, substeps=np.zeros(2, int))
    still = motion(np.zeros((2, 3)), spins=spins)
    work = accumulator([0.0, 1.0], still)
    add(work, still, np.array([False, True]), NONE, contact)
    frame = work.finish()
    assert frame.made_j.sum() == 0.0
    assert frame.dissipated_j == pytest.approx((3.0 - 1.0) * 2.0 * 1.0)


def test_a_moment_that_sets_bodies_turning_against_each_other_made_energy():
    inertia, moment = 2.0, 3.0
    spins = np.array([[0.0, 0.0, moment / inertia], [0.0, 0.0, -moment / inertia]])
    work = accumulator([1.0, 1.0], motion(np.zeros((2, 3))))
    twist = PairImpulses(PAIR, np.zeros((1, 1, 3)), np.zeros((1, 1, 3)), np.array([[[0.0, 0.0, moment]]]))
    add(work, motion(np.zeros((2, 3)), spins=spins), np.array([True, True]), twist, NONE)
    frame = work.finish()
    np.testing.assert_allclose(frame.made_j, 0.5 * inertia * spins[:, 2] ** 2, rtol=1e-12)
    assert frame.made_by_connections_j == pytest.approx(frame.made_j.sum())


def test_a_tool_that_moves_as_animation_says_does_work_and_makes_nothing():
    # A tool at 2 m/s takes a resting body of 3 kg along: half of its work is lost in the impact.
    work = accumulator([0.0, 3.0], motion(along_x((2.0, 0.0))))
    contact = contacts([[-6.0, 0.0, 0.0]])
    after = along_x((2.0, 2.0))
    add(work, motion(after, STEP_S * np.array(after)), np.array([False, True]), NONE, contact)
    frame = work.finish()
    assert frame.tools_j == pytest.approx(12.0)
    assert frame.dissipated_j == pytest.approx(6.0)
    assert frame.made_j.sum() == 0.0


def test_a_body_moved_up_without_a_velocity_was_lifted_by_the_solver():
    support = contacts([[0.0, 0.0, 7.0 * 9.81 * STEP_S]])
    work = accumulator([7.0, 0.0], motion(np.zeros((2, 3))), gravity=GRAVITY)
    lifted = motion(np.zeros((2, 3)), [[0.0, 0.0, 0.002], [0.0, 0.0, 0.0]])
    add(work, lifted, np.array([True, False]), NONE, support)
    frame = work.finish()
    assert frame.made_by_lifting_j == pytest.approx(7.0 * 9.81 * 0.002)
    assert frame.made_j[0] == pytest.approx(frame.made_by_lifting_j)


def test_a_substep_passed_over_counts_for_nothing():
    work = accumulator([1.0], motion([[0.0, 0.0, 0.0]]))
    work.pass_over(motion([[9.0, 0.0, 0.0]]))
    add(work, motion([[9.0, 0.0, 0.0]], [[9.0 * STEP_S, 0, 0]]), np.array([True]), NONE, NONE)
    assert work.finish().loads_j == pytest.approx(0.0, abs=1e-12)


def test_sub_steps_added_at_once_are_those_added_one_by_one_to_the_last_bit():
    """Bodies that fall, touch and are held, one of them led, another one at rest now and then."""
    random = np.random.default_rng(3)
    steps, bodies, connections = 7, 40, 90
    substeps_s = np.where(np.arange(steps) < 4, STEP_S, STEP_S / 3.0)
    pairs = np.array([random.choice(bodies, 2, replace=False) for _ in range(connections)])
    free = random.random((steps, bodies)) > 0.1
    free[:, 0], free[3] = False, True
    vectors = random.normal(size=(3, steps, bodies, 3))
    vectors[:, 2:4] = vectors[:, 1:2] * ([[[[1.0]]], [[[0.0]]], [[[0.0]]]])  # nothing moves in two of them
    loads = random.normal(size=(3, steps, connections, 3))
    counts = np.array([30, 0, 11, 11, 57, 1, 20])
    touching = np.array([random.choice(bodies, 2, replace=False) for _ in range(counts.sum())])
    impulses, points = random.normal(size=(2, counts.sum(), 3))
    of_step = np.repeat(np.arange(steps), counts)
    resultants = random.normal(size=(steps, bodies, 3))
    masses, damping = random.uniform(1.0, 9.0, bodies), random.uniform(0.0, 0.1, (2, bodies))
    in_cracks = random.uniform(size=(2, steps))

    def frame(batches):
        start = Motion(*np.zeros((3, 1, bodies, 3)))
        work = WorkAccumulator(masses, *damping, GRAVITY, start)
        for first, last in batches:
            rows = (of_step >= first) & (of_step < last)
            work.add(
                Motion(*vectors[:, first:last]),
                free[first:last],
                PairImpulses(pairs, *loads[:, first:last]),
                PairImpulses(touching[rows], impulses[rows], points[rows], substeps=of_step[rows] - first),
                resultants[first:last],
                substeps_s[first:last],
            )
            for step in range(first, last):
                work.add_in_cracks(in_cracks[0, step], in_cracks[1, step])
        return work.finish()

    one_by_one = frame([(step, step + 1) for step in range(steps)])
    for batches in ([(0, steps)], [(0, 3), (3, steps)]):
        found = frame(batches)
        for name in FrameWork.__dataclass_fields__:
            assert np.array_equal(getattr(found, name), getattr(one_by_one, name)), name
            assert np.any(getattr(found, name)), name


def test_unknown_work_has_the_shape_of_known_work():
    unknown = FrameWork.unknown(4, 2)
    assert unknown.gravity_j.shape == (4,)
    assert unknown.made_j.shape == (4, 2)
    assert np.isnan(unknown.made_j).all()


def test_a_spring_gives_back_what_it_could_store_and_all_above_that_is_made():
    """Two bodies of 2 kg go towards each other at 1 m/s each, 2 J, and a spring that can store 1.5 J stops them."""
    free, masses = np.array([True, True]), [2.0, 2.0]

    def spring(impulse_ns, stored_j):
        zeros = np.zeros((1, 1, 3))
        pushes = np.array([[[-impulse_ns, 0.0, 0.0]]])
        return PairImpulses(PAIR, pushes, zeros, zeros, stored_j=np.array([[stored_j]]))

    work = accumulator(masses, motion(along_x([1.0, -1.0])))
    back, pushed = np.sqrt(0.75), np.sqrt(2.0)
    amounts = []
    for speed, change, stored in ((1.0, 0.0, 0.0), (0.0, 2.0, 1.5), (-back, 2.0 * back, 0.0)):
        add(work, motion(along_x([speed, -speed])), free, spring(change, stored), NONE)
        frame = work.finish()
        amounts.append((frame.dissipated_j, frame.made_by_connections_j))
    # What it cannot store is dissipated; what it stored makes no energy when it comes back.
    np.testing.assert_allclose(amounts, [(0.0, 0.0), (0.5, 0.0), (0.0, 0.0)], atol=1e-12)
    add(work, motion(along_x([-pushed, pushed])), free, spring(2.0 * (pushed - back), 0.0), NONE)
    assert work.finish().made_by_connections_j == pytest.approx(2.0 * (pushed**2 - back**2), rel=1e-12)
