# SPDX-License-Identifier: GPL-3.0-or-later
"""What is done to a bridge with elastic connections: after each step the rest bears what statics says of it.

A beam of 20 t is held by posts of different stiffness, so that it does not bend but sinks and turns on springs: what
each bears follows from two equations, of forces and of moments.
"""

from __future__ import annotations

import numpy as np
import pytest
from support.blast_scenes import charge, set_off
from support.blocks import Blocks
from support.scenarios import I235

from bridge_demolition_addon.engineering.elasticity.section_stiffness import SectionStiffness
from bridge_demolition_addon.engineering.mechanics.strength import Joint, Springs, Strength
from bridge_demolition_addon.engineering.timing.timeline import Timeline
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.scenario import Jackhammer, Load, Removal, SawCut, Weakening
from bridge_demolition_addon.scene.bodies import mark_member
from bridge_demolition_addon.scene.connections.constraints import Breaking, keep_breaking, set_joints, set_strength
from bridge_demolition_addon.scene.connections.elasticity import keep_elasticity
from bridge_demolition_addon.scene.custom_properties import keep_tables
from bridge_demolition_addon.scene.tools.build_site import BuildSite
from bridge_demolition_addon.scene.tools.jackhammer import create_jackhammer

GRAVITY = float(np.float32(STANDARD_GRAVITY_M_S2))
MASS_KG, TOP_M = 20_000.0, 10.5
WEIGHT_N = MASS_KG * GRAVITY
PLACES_M = np.array([-3.5, -1.5, 0.5, 2.0, 3.5])
STIFF_N_M = np.array([4e9, 1e9, 2e9, 3e9, 1e9])
STRONG = Strength(1e12, 1e12, 1e12, 1e12, 1e12)
EXACT = 1e-3
"""Posts sink by some hundredths of a millimetre, and places at 10 m are kept to a thousandth of one; the beam turns."""


POST_KG = 10.0


class BeamOnPosts:
    """The beam, and a post below each place, on a footing; both ends of a post give way alike.

    A centimetre of room at both ends, so that a post that is cut off touches nothing.
    """

    def __init__(self, **time: float):
        self.scene_of_blocks = blocks = Blocks(**time)
        self.scene = blocks.scene
        self.beam = blocks.block((0, 0, 10), MASS_KG, (8, 1, 1))
        self.posts = [blocks.block((x, 0, 9), POST_KG, (0.5, 1, 0.98)) for x in PLACES_M]
        footings = [blocks.block((x, 0, 8), size_m=(0.5, 1, 1)) for x in PLACES_M]
        for number, post in enumerate(self.posts):
            mark_member(post, f"post {number}", "pier")
        self.joints = [
            blocks.connect("FIXED", (x, 0, 9.5), post, self.beam) for x, post in zip(PLACES_M, self.posts, strict=True)
        ]
        self.feet = [
            blocks.connect("FIXED", (x, 0, 8.5), footing, post)
            for x, footing, post in zip(PLACES_M, footings, self.posts, strict=True)
        ]
        for joint in (*self.joints, *self.feet):
            joint["bda_area_m2"], joint["bda_normal"] = 1.0, (0.0, 0.0, 1.0)
        # Tops turn all but freely, so that no moments go through them, but the beam does not roll over.
        axial = np.tile(2.0 * STIFF_N_M, 2)
        turning = np.concatenate((np.full(len(STIFF_N_M), 1e6), STIFF_N_M))
        shear = np.column_stack((axial, axial)) / 3.0
        stiffness = SectionStiffness.uncoupled(axial, shear, turning, turning[:, None, None] * np.eye(2))
        keep_elasticity(self.scene, (*self.joints, *self.feet), stiffness, 0.05)
        keep_breaking(self.scene, Breaking(STRONG))

    def play(self, folder, frames=24):
        """Simulate; return the results, and forces on the beam (k, 5, 3) by the posts."""
        results = self.scene_of_blocks.play(folder, frames)
        rows = [results.inventory.connection_names.tolist().index(joint.name) for joint in self.joints]
        on_first = results.frames.loads.connection_forces_n[:, rows]
        is_beam = results.inventory.body_names[results.inventory.pairs[rows, 0]] == self.beam.name
        return results, np.where(is_beam[:, None], 1.0, -1.0) * on_first


def shares(left, load_n=0.0, load_at_m=0.0):
    """What posts (p,) bear of the weight and a load, by the balance of forces and moments, where some are left.

    By its own weight the foot of a post gives way too, and takes half of that off what its top bears.
    """
    own = np.where(left, 0.5 * POST_KG * GRAVITY, 0.0)
    stiff = np.where(left, STIFF_N_M, 0.0)
    sums = np.array([[stiff.sum(), (stiff * PLACES_M).sum()], [(stiff * PLACES_M).sum(), (stiff * PLACES_M**2).sum()]])
    sink, slope = np.linalg.solve(sums, [WEIGHT_N + load_n + own.sum(), load_n * load_at_m + (own * PLACES_M).sum()])
    return stiff * (sink + slope * PLACES_M) - own


def test_what_is_left_of_a_bridge_shares_its_weight_after_each_step_of_a_sequence(blender, tmp_path):
    """A post is taken away, another is sawn off, and a third is weakened until it breaks by itself."""
    beam = BeamOnPosts()
    all_of_them = np.ones(5, bool)
    first = all_of_them & (np.arange(5) != 1)
    second = first & (np.arange(5) != 3)
    # The middle post breaks at its foot, which also bears its own weight, once it can bear no more than 0.99 of that.
    borne = shares(second)[2] + POST_KG * GRAVITY
    set_strength(beam.feet[2], Strength(2.0 * borne, 1e12, 1e12, 1e12, 1e12))
    keep_tables(
        beam.scene,
        "changes",
        [
            Removal(time_s=0.25, members=("post 1",)),
            SawCut(time_s=0.5, point_m=(0, 0, 9.5), normal=(0, 0, 1), members=("post 3",)),
            Weakening(time_s=0.75, members=("post 2",), factor=0.51),
            Weakening(time_s=1.0, members=("post 2",), factor=0.97),
        ],
    )
    results, forces = beam.play(tmp_path, 30)
    times = results.frames.time_s
    third = second & (np.arange(5) != 2)
    for until, left in ((0.25, all_of_them), (0.5, first), (0.75, second), (1.0, second), (times[-1], third)):
        # Some frames after a step the beam has come to rest: it swings a hundred times a second, and is damped.
        frame = np.flatnonzero(times < until - 1e-6)[-1]
        np.testing.assert_allclose(forces[frame, :, 2], shares(left), rtol=EXACT, atol=EXACT * WEIGHT_N)
        assert forces[frame, :, 2].sum() == pytest.approx(WEIGHT_N, rel=1e-4)
        # What is taken away or sawn off bears nothing; the one whose foot broke hangs from the beam.
        assert (abs(forces[frame, ~left & (np.arange(5) != 2)]) == 0.0).all()
    assert results.frames.intact[-1].sum() == 6


def test_posts_bear_a_load_that_grows_at_a_point_of_the_beam(blender, tmp_path):
    """So slowly, against its 100 swings a second, that it is at rest at any time."""
    beam, most_n, at_m = BeamOnPosts(), 3.0 * WEIGHT_N, 2.5
    keep_tables(beam.scene, "loads", [Load(point_m=(at_m, 0, 10.5), times_s=(0.2, 0.8), forces_n=(0, most_n))])
    results, forces = beam.play(tmp_path)
    times = results.frames.time_s
    middles = times - (times[-1] - times[-2]) / 2.0
    for frame in np.flatnonzero((times > 0.3) & (abs(times - 0.8) > 0.05)):
        load_n = most_n * np.clip((middles[frame] - 0.2) / 0.6, 0.0, 1.0)
        expected = shares(np.ones(5, bool), load_n, at_m)
        np.testing.assert_allclose(forces[frame, :, 2], expected, rtol=EXACT, atol=EXACT * (WEIGHT_N + load_n))


def test_a_post_that_bears_too_little_breaks_at_once_and_the_others_take_its_share(blender, tmp_path):
    beam = BeamOnPosts()
    whole = shares(np.ones(5, bool))
    left = np.arange(5) > 0
    # The next one bears twice as much then, and so that it breaks too; the others do not.
    assert shares(left)[1] > 2.0 * whole[1]
    set_strength(beam.feet[0], Strength(0.99 * whole[0], 1e12, 1e12, 1e12, 1e12))
    set_strength(beam.feet[1], Strength(1.5 * whole[1], 1e12, 1e12, 1e12, 1e12))
    for foot, bears in zip(beam.feet[2:], whole[2:], strict=True):
        set_strength(foot, Strength(20.0 * bears, 1e12, 1e12, 1e12, 1e12))
    results, forces = beam.play(tmp_path)
    left &= np.arange(5) > 1
    assert results.frames.intact[-1].sum() == 8
    np.testing.assert_allclose(forces[-1, :, 2], shares(left), rtol=EXACT, atol=EXACT * WEIGHT_N)


def test_a_blast_pushes_the_beam_by_its_impulse_and_leaves_the_shares_as_they_were(blender, tmp_path):
    """From rest to rest, posts give what weight and blast do, as momentum says."""
    beam = BeamOnPosts()
    set_off(beam.scene_of_blocks, [charge("A", (1.0, 0.0, 14.0), 20.0)], "direct", start_s=0.25)
    results, forces = beam.play(tmp_path, 36)
    frames = results.frames
    row = results.inventory.body_names.tolist().index(beam.beam.name)
    blast_ns = frames.blast_impulses_ns[:, row]
    steps_s = np.diff(frames.time_s, prepend=frames.time_s[0])
    given = (forces.sum(axis=1) * steps_s[:, None]).sum(axis=0)
    weight_ns = np.array([0.0, 0.0, WEIGHT_N * frames.time_s[-1]])
    assert blast_ns[:, 2].sum() < -1000.0
    np.testing.assert_allclose(given, weight_ns - blast_ns.sum(axis=0), atol=2e-3 * abs(blast_ns).sum())
    np.testing.assert_allclose(forces[-1, :, 2], shares(np.ones(5, bool)), rtol=EXACT, atol=EXACT * WEIGHT_N)


def test_a_jackhammer_presses_on_the_beam_and_the_posts_bear_what_it_does(blender, tmp_path):
    beam = BeamOnPosts(substeps_per_frame=20, solver_iterations=50)
    hammer = Jackhammer(
        start_time_s=0.2,
        end_time_s=1.0,
        path_m=((1.0, 0.0),),
        stroke_m=0.2,
        depth_m=2e-3,
        blows_per_second=2.0,
    )
    world = beam.scene.rigidbody_world
    create_jackhammer(BuildSite(world, Timeline.of(1.0 / 24.0, 2.0), lambda _: TOP_M, I235.surface_of), hammer)
    results, forces = beam.play(tmp_path, 40)
    frames = results.frames
    row = results.inventory.body_names.tolist().index(beam.beam.name)
    pressed_ns = frames.loads.body_contact_impulses_ns[:, row, 2]
    assert pressed_ns.min() < -0.05 * WEIGHT_N / 24.0
    steps_s = np.diff(frames.time_s, prepend=frames.time_s[0])
    given = (forces[:, :, 2].sum(axis=1) * steps_s).sum()
    # From rest to rest: weight and blows together.
    expected = WEIGHT_N * frames.time_s[-1] - pressed_ns.sum()
    assert given == pytest.approx(expected, rel=2e-3)
    np.testing.assert_allclose(forces[-1, :, 2], shares(np.ones(5, bool)), rtol=EXACT, atol=EXACT * WEIGHT_N)


def test_a_bearing_that_slides_leaves_what_is_pushed_along_to_the_others(blender, tmp_path):
    """The beam is pulled along by a tenth of its weight: posts share that by their shear stiffness, but one slides."""
    beam = BeamOnPosts()
    time = beam.scene_of_blocks.time
    fixed, bearing = Joint("FIXED"), Joint("GENERIC", ("move x",))
    set_joints(beam.joints, [fixed, bearing], np.array([1, 0, 0, 0, 0]), time.step)
    beam.scene.gravity[0] = 0.1 * GRAVITY
    _, forces = beam.play(tmp_path)
    left = np.arange(5) > 0
    expected = -0.1 * WEIGHT_N * np.where(left, STIFF_N_M, 0.0) / STIFF_N_M[left].sum()
    np.testing.assert_allclose(forces[-1, :, 0], expected, rtol=EXACT, atol=EXACT * WEIGHT_N)
    # The pull is half a metre above the posts, in the middle of the beam, and turns it.
    moment = (PLACES_M * forces[-1, :, 2]).sum()
    assert moment == pytest.approx(0.1 * WEIGHT_N * 0.5, rel=0.01)
    assert forces[-1, :, 2].sum() == pytest.approx(WEIGHT_N, rel=1e-4)


def test_a_support_with_a_spring_bears_by_what_it_gives_way(blender, tmp_path):
    """A block on a spring upwards, elastic in all else: it sinks by its weight over the spring's stiffness."""
    blocks = Blocks(substeps_per_frame=20)
    support, block = blocks.block((0, 0, 8)), blocks.block((0, 0, 10), 1000.0)
    connection = blocks.connect("FIXED", (0, 0, 9), support, block)
    connection["bda_area_m2"], connection["bda_normal"] = 1.0, (0.0, 0.0, 1.0)
    spring = Joint("GENERIC_SPRING", ("move z",), Springs(stiffness_n_m=1e6, damping_ns_m=1e4))
    set_joints([connection], [spring], np.zeros(1, int), blocks.time.step)
    one = np.full(1, 1e9)
    stiffness = SectionStiffness.uncoupled(one, np.full((1, 2), 1e9), one, 1e9 * np.eye(2)[None])
    keep_elasticity(blocks.scene, [connection], stiffness, 0.05)
    blocks.scene.gravity[0] = 0.1 * GRAVITY
    results = blocks.play(tmp_path, 60)
    forces = results.frames.loads.connection_forces_n[-1, 0] * (1 if results.inventory.pairs[0, 0] == 1 else -1)
    np.testing.assert_allclose(forces, [-100.0 * GRAVITY, 0.0, 1000.0 * GRAVITY], rtol=EXACT, atol=1.0)
    # Of 10 mm, places in single precision are 1e-6 m.
    assert 10.0 - results.frames.positions_m[-1, 1, 2] == pytest.approx(1000.0 * GRAVITY / 1e6, rel=EXACT)
