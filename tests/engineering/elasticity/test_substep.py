# SPDX-License-Identifier: GPL-3.0-or-later
"""Sub-steps of the compiled core are those of one dense system by numpy: random structures, all kinds of forces."""

from dataclasses import fields, replace

import numpy as np
import pytest
from reference.crack_law import CrackLaw
from reference.spring_law import ReferenceSprings
from reference.substep import velocities_after
from reference.terms import ReferenceTerm
from support.core_terms import forces_and_tangents, term_in_substep, term_of_law

from bridge_demolition_addon.engineering.drilled_charges.cages import BareBars, Cages
from bridge_demolition_addon.engineering.elasticity.bearings import Bearings, PadSprings
from bridge_demolition_addon.engineering.elasticity.crack_state import DOWEL_SHARE, SHEARED
from bridge_demolition_addon.engineering.elasticity.cracks import Cracks, ExpectedCracks, corner_positions
from bridge_demolition_addon.engineering.elasticity.equations import RigidBodies
from bridge_demolition_addon.engineering.elasticity.joint_rows import (
    JointFrames,
    JointPositions,
    effective_inverse_masses,
    joint_positions,
)
from bridge_demolition_addon.engineering.elasticity.springs import (
    PressedSprings,
    SpringPositions,
    SpringsOfConnections,
)
from bridge_demolition_addon.engineering.elasticity.steel_bars import Bars, Steel
from bridge_demolition_addon.engineering.elasticity.structure import ElasticStructure, StepInput
from bridge_demolition_addon.engineering.elasticity.substep import CRACKS, SPRINGS, Frames, Places
from bridge_demolition_addon.engineering.geometry.vectors import rotated
from bridge_demolition_addon.errors import NotFiniteError

BODIES, GAPS = 9, 2000
SUBSTEP_S, DAMPING_S = 1.0 / 480.0, 2e-4


def turned(rng, count, most):
    angles = rng.normal(size=(count, 3)) * most
    return np.ascontiguousarray(np.moveaxis(rotated(np.tile(np.eye(3), (count, 1, 1)), angles), 0, -1))


class Structure:
    """Bodies in a row, of which the first never moves: the connections of some are whole, those of others cracked.

    Some lie on others by bearings, and bars stand bare between some.
    """

    def __init__(self, seed, *, cracked=True, borne=True, bared=True, pulls_n=None):
        rng = np.random.default_rng(seed)
        pairs = [(number, number + 1) for number in range(BODIES - 1)] + [(0, 3), (2, 5), (4, 1), (8, 6), (5, 3)]
        first, second = np.array(pairs).T.copy()
        count = len(pairs)
        self.positions = np.stack((1.0 * np.arange(BODIES), rng.normal(size=BODIES), rng.normal(size=BODIES)))
        self.rotations = turned(rng, BODIES, 1.0)
        masses = np.where(np.arange(BODIES) > 0, rng.uniform(500.0, 5000.0, BODIES), 0.0)
        inertias = np.zeros((3, 3, BODIES))
        inertias[[0, 1, 2], [0, 1, 2]] = rng.uniform(100.0, 2000.0, (3, BODIES)) * (masses > 0.0)
        self.bodies = RigidBodies(masses, inertias, self.positions, self.rotations)
        middles = 0.5 * (self.positions[:, first] + self.positions[:, second])
        axes = [np.ascontiguousarray(np.swapaxes(self.rotations[..., ends], 0, 1)) for ends in (first, second)]
        points = [
            np.einsum("ijk,ik->jk", self.rotations[..., ends], middles - self.positions[:, ends])
            for ends in (first, second)
        ]
        self.frames = JointFrames(first, second, *axes, *points)
        shapes = rng.normal(size=(count, 6, 6))
        self.stiffness = np.ascontiguousarray(np.moveaxis(1e6 * (shapes @ np.swapaxes(shapes, 1, 2)), 0, -1))
        self.intact = np.ones(count, bool)
        yields = rng.uniform(1e3, 3e4, (4, count))
        self.cracks = Cracks(Steel(), np.full(count, 0.02), yields, np.ones(count), np.full(count, 2e8))
        rows = np.array([1, 4, 6, 9]) if cracked else np.zeros(0, int)
        along = self.positions[:, second[rows]] - self.positions[:, first[rows]]
        normals = along / np.sqrt((along * along).sum(axis=0))
        sides = turned(rng, len(rows), 1.0)[:, :2]
        corners = corner_positions(middles[:, rows], sides, np.full((2, len(rows)), 0.4))
        ends = first[rows], second[rows]
        self.cracks.add(rows, *ends, corners, normals, normals, self.positions, self.rotations, pulls_n)
        self.bearings = self._bearings(rng, first, second, middles) if borne else None
        self.structure = ElasticStructure(
            self.frames, self.stiffness, self.bodies, DAMPING_S, self.cracks, bearings=self.bearings
        )
        self.intact[rows] = False
        self.cages = Cages(count)
        if bared:
            ends = np.array([2, 7]), np.array([6, 3])
            points = [self.positions[:, end] + 0.1 for end in ends]
            bars = BareBars(*ends, *points, np.full(2, 6.0), np.full(2, 0.02), np.full(2, 500e6))
            self.cages.add(bars, self.positions, self.rotations)
            self.structure.stand_bare(self.cages)
        # Deformed a little, so that bars yield, sides part and press, and springs lift off or slide.
        self.positions = self.positions + 2e-3 * rng.normal(size=(3, BODIES)) * self.bodies.moves
        turn = turned(rng, BODIES, 1e-3)
        self.rotations = np.where(self.bodies.moves, np.einsum("ijn,jkn->ikn", turn, self.rotations), self.rotations)
        self.rotations = np.ascontiguousarray(self.rotations)
        self.velocities = rng.normal(size=(6, BODIES)) * self.bodies.moves

    def _bearings(self, rng, first, second, middles):
        rows = np.array([2, 7, 11])
        parts = np.repeat(np.arange(3), 4)
        places = middles[:, rows][:, parts].T + 0.3 * rng.normal(size=(12, 3))
        pads = PadSprings(
            rows=rows,
            parts=parts,
            places_m=places,
            vertical_n_m=rng.uniform(1e6, 1e8, 12),
            sideways_n_m=np.repeat(rng.uniform(1e5, 1e7, (12, 1)), 2, axis=1),
            friction=np.array([np.inf, 0.4, np.inf]),
            pulls=np.array([True, False, False]),
            travel_m=np.full(3, 10.0),
            bearings=np.arange(3),
            breaking_n=np.full(3, np.inf),
        )
        above = np.where(np.arange(3) % 2, first[rows], second[rows])
        return Bearings(pads, first, second, above, self.positions, self.rotations)

    def terms(self):
        """Everything that is not proportional to motion, as it is before the sub-step."""
        places = self.positions, self.rotations
        laws = [law for law in (self.cracks, self.bearings, self.cages) if law is not None and len(law.rows)]
        return [ReferenceTerm(term_in_substep(law, np.arange(len(law.rows)), *places), SUBSTEP_S) for law in laws]

    def step(self):
        self.structure.update_plastic_state(self.positions, self.rotations)
        start = StepInput(self.positions, self.rotations, self.velocities, np.zeros(BODIES, bool))
        return self.structure.step(start, self.intact, SUBSTEP_S)

    def expected(self):
        stiffness = self.stiffness.copy()
        if self.bearings is not None:
            stiffness[..., self.bearings.rows] = 0.0
        built = joint_positions(self.frames, self.bodies.positions_m, self.bodies.rotations).deformations()
        return velocities_after(
            self.frames,
            stiffness,
            DAMPING_S,
            self.bodies,
            built,
            self.positions,
            self.rotations,
            self.velocities,
            np.flatnonzero(self.intact),
            self.terms(),
            SUBSTEP_S,
        )


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("kinds", [{}, {"cracked": False}, {"borne": False, "bared": False}])
def test_velocities_are_those_of_one_dense_system(seed, kinds):
    """Forces agree to 1e-4 of what bars yield at, in the core: that is the error that is left of velocities."""
    structure = Structure(seed, **kinds)
    step = structure.step()
    moving = structure.bodies.moves
    error = abs(step.velocities - structure.expected())[:, moving]
    assert error.max() < 2e-4 * abs(structure.velocities).max()


@pytest.mark.parametrize("seed", range(8))
def test_a_linear_structure_is_solved_to_rounding(seed):
    structure = Structure(seed, cracked=False, borne=False, bared=False)
    np.testing.assert_allclose(structure.step().velocities[:, 1:], structure.expected()[:, 1:], rtol=1e-9, atol=1e-10)


@pytest.mark.parametrize("seed", range(8))
def test_impulses_change_momentum_as_they_say(seed):
    """A body gains what acts on it; what acts within a pair is equal and opposite."""
    structure = Structure(seed)
    step, bodies = structure.step(), structure.bodies
    own = bodies.mass_matrices(structure.rotations, np.arange(BODIES))
    gained = np.einsum("ijn,jn->in", own, step.velocities - structure.velocities)
    np.testing.assert_allclose(gained[:, 1:], step.of_bodies[:, 1:], rtol=1e-6, atol=1e-5 * abs(gained).max())
    np.testing.assert_allclose(step.of_first[:3], -step.of_second[:3], atol=1e-9 * abs(step.of_first).max())
    np.testing.assert_allclose(step.of_cracks_on_first[:3], -step.of_cracks_on_second[:3], atol=1e-9)


@pytest.mark.parametrize("seed", range(6))
def test_what_the_last_substep_remembers_changes_no_solution(seed):
    """The second one begins its guesses with the motion of the first, which is another one."""
    structure = Structure(seed)
    structure.step()
    structure.velocities = np.random.default_rng(seed).normal(size=(6, BODIES)) * structure.bodies.moves
    found, expected = structure.step().velocities, structure.expected()
    np.testing.assert_allclose(found, expected, rtol=1e-4, atol=1e-4 * abs(structure.velocities).max())


@pytest.mark.parametrize("seed", range(6))
def test_rows_of_bullet_resist_as_cracks_do(seed):
    """Frames in the middle of what resists, and rows as soft as it is, of tangents that numpy sums."""
    structure = Structure(seed, borne=False, bared=False)
    step, rng = structure.step(), np.random.default_rng(seed)
    shapes = rng.normal(size=(3, 3, BODIES))
    masses, inertias = rng.uniform(1e-4, 1e-3, BODIES), 1e-4 * np.einsum("ikn,jkn->ijn", shapes, shapes)
    places = Places.of(structure.positions, structure.rotations)
    found = ExpectedCracks.of(step.crack_term, BODIES).between(masses, inertias, step.velocities)
    found.find(places, SUBSTEP_S)
    arrays, count = step.crack_term.arrays, len(step.cracks)
    by_corner = {
        name: values.reshape(*values.shape[:-1], 4, count)
        for name, values in arrays.items()
        if name in ("normals", "tangents", "first_arms", "second_arms")
    }
    normals, tangents, arms = (by_corner[name] for name in ("normals", "tangents", "first_arms"))
    shares = np.einsum("ack,abck,bck->ck", normals, tangents, normals)
    middles = [(shares * by_corner[name]).sum(axis=1) / shares.sum(axis=0) for name in ("first_arms", "second_arms")]
    edge = arms[:, 2] - arms[:, 0]
    edge = edge - (edge * normals[:, 0]).sum(axis=0) * normals[:, 0]
    edge = edge / np.sqrt((edge * edge).sum(axis=0))
    axes = np.stack((normals[:, 0], edge, np.cross(normals[:, 0], edge, axis=0)), axis=1)
    moved = np.cross(axes[:, :, None], (arms - middles[0][:, None])[:, None], axis=0)
    stiffness = np.concatenate(
        (
            np.einsum("axk,abck,bxk->xk", axes, tangents, axes),
            np.einsum("axck,abck,bxck->xk", moved, tangents, moved),
        )
    )
    ends = arrays["first"][:count], arrays["second"][:count]
    rows = JointPositions(axes, axes, *middles, np.zeros_like(middles[0])).rows()
    mobilities = effective_inverse_masses(rows, ends, masses, inertias)
    rates = rows.rates(*(step.velocities[:, bodies] for bodies in ends))
    with np.errstate(divide="ignore"):
        softness = 1.0 / (SUBSTEP_S * SUBSTEP_S * stiffness * mobilities)
    np.testing.assert_allclose(found.rows[0], softness, rtol=1e-9)
    np.testing.assert_allclose(found.rows[1], -SUBSTEP_S * rates, rtol=1e-9, atol=1e-12)
    for (own_axes, points), bodies, middle in zip((found.first, found.second), ends, middles, strict=True):
        turns = structure.rotations[..., bodies]
        np.testing.assert_allclose(np.einsum("ijk,jxk->ixk", turns, own_axes), axes, atol=1e-12)
        np.testing.assert_allclose(np.einsum("ijk,jk->ik", turns, points), middle, atol=1e-12)


def crack_law(rng):
    has_bars = np.arange(GAPS) % 4 > 0
    directions, normals = rng.normal(size=(2, 3, GAPS))
    bars = Bars(*(rng.uniform(0.0, most, GAPS) * has_bars for most in (1e6, 1e9, 1e7)))
    return CrackLaw(
        bars,
        1e-3 * rng.normal(size=(3, GAPS)),
        rng.uniform(0.0, 1e-3, GAPS),
        normals / np.sqrt((normals * normals).sum(axis=0)),
        directions / np.sqrt((directions * directions).sum(axis=0)),
        rng.uniform(0.0, 1e9, GAPS),
        np.where(np.arange(GAPS) % 3 > 0, 1e-3 * rng.normal(size=(3, GAPS)), 0.0),
        rng.uniform(0.0, 1e5, GAPS),
    )


@pytest.mark.parametrize("seed", range(5))
def test_cracks_resist_as_by_numpy(seed):
    """Gaps from a micrometre to 10 cm, one of them closed, a quarter of them without bars: to the bit."""
    rng = np.random.default_rng(seed)
    law, gaps = crack_law(rng), rng.normal(size=(3, GAPS)) * 10.0 ** rng.uniform(-6.0, -1.0, GAPS)
    gaps[:, 5] = 0.0
    arrays = {
        "yields": law.bars.yield_n,
        "stiffness": law.bars.stiffness_n_m,
        "modulus": law.bars.modulus_n_m,
        "slips": law.slips_m,
        "flows": law.flows_m,
        "normals": law.normals,
        "directions": law.directions,
        "pressed": law.pressed_n_m,
        "rests": law.rests_m,
        "grips": law.grips_n,
        "dowel": DOWEL_SHARE,
        "sheared": SHEARED,
    }
    term = term_of_law(CRACKS, arrays, gaps, np.arange(GAPS) % (GAPS // 4))
    for found, expected in zip(forces_and_tangents(term, np.zeros((3, GAPS))), law.linear(gaps), strict=True):
        np.testing.assert_array_equal(found, expected)


@pytest.mark.parametrize("seed", range(5))
def test_springs_resist_as_by_numpy(seed):
    rng, number = np.random.default_rng(seed), np.arange(GAPS)
    law = ReferenceSprings(
        rng.uniform(1e6, 1e9, GAPS),
        rng.uniform(0.0, 1e8, (2, GAPS)) * (number % 7 > 0),
        np.where(number % 3 > 0, np.inf, rng.uniform(1e3, 1e5, GAPS)),
        np.where(number % 4 > 0, rng.uniform(0.0, 0.8, GAPS), np.inf),
        number % 5 == 0,
        rng.uniform(0.0, 1e5, GAPS) * (number % 6 > 0),
    )
    gaps = rng.normal(size=(3, GAPS)) * 10.0 ** rng.uniform(-8.0, -1.0, GAPS)
    gaps[:, 7] = 0.0
    names = ("vertical", "sideways", "capacity", "friction", "pulls", "pressed_by")
    arrays = (law.vertical_n_m, law.sideways_n_m, law.capacity_n, law.friction, law.pulls, law.pressed_n)
    term = term_of_law(SPRINGS, dict(zip(names, arrays, strict=True)), gaps)
    upwards, tangents = law.resisted(gaps)
    found = forces_and_tangents(term, np.zeros((3, GAPS)))
    np.testing.assert_array_equal(found[0], -upwards)
    np.testing.assert_array_equal(found[1], tangents)
    alone = PressedSprings(*(getattr(law, item.name) for item in fields(law)))
    # On bodies that have moved by the gaps alone.
    ends, none = (np.arange(GAPS), np.full(GAPS, GAPS)), np.zeros((3, GAPS))
    of = np.arange(GAPS) // 3
    springs = SpringsOfConnections(np.unique(of), SpringPositions(of, *ends, none, none, np.ones(20, bool)), alone)
    places = np.append(gaps, np.zeros((3, 1)), axis=1), np.repeat(np.eye(3)[:, :, None], GAPS + 1, axis=2)
    np.testing.assert_array_equal(springs.stored_j(*places), np.bincount(of, law.stored_j(gaps)))


def test_gaps_of_springs_are_between_points_of_both_bodies():
    rng = np.random.default_rng(4)
    above, below = rng.integers(0, BODIES, (2, 50))
    anchors = rng.normal(size=(2, 3, 50))
    whole = np.ones(50), np.ones((2, 50)), np.ones(50), np.ones(50), np.ones(50, bool), np.ones(50)
    places = SpringPositions(np.arange(50), above, below, *anchors, np.ones(50, bool))
    springs = SpringsOfConnections(np.arange(50), places, PressedSprings(*whole))
    positions, rotations = rng.normal(size=(3, BODIES)), turned(rng, BODIES, 2.0)
    term = springs.standing(positions, rotations)
    gaps, arms, arms_below = (term.arrays[name] for name in ("widths", "second_arms", "first_arms"))
    ends = [
        np.einsum("ijk,jk->ik", rotations[..., body], own) for body, own in zip((above, below), anchors, strict=True)
    ]
    np.testing.assert_allclose(gaps, positions[:, above] + ends[0] - positions[:, below] - ends[1], atol=1e-14)
    np.testing.assert_allclose(arms, ends[0], atol=1e-14)
    np.testing.assert_array_equal(-term.resisted()[2], np.minimum(-gaps[2], 1.0))  # they pull, up to their capacity
    # The force acts where the body above is met, on both.
    np.testing.assert_allclose(positions[:, below] + arms_below, positions[:, above] + arms, atol=1e-14)


def test_numbers_out_of_range_are_refused():
    """A body that there is not would be read past the end of arrays."""
    structure = Structure(1, bared=False)
    start = StepInput(structure.positions, structure.rotations, structure.velocities, np.zeros(BODIES, bool))
    structure.structure.step(start, structure.intact, SUBSTEP_S)
    structure.cracks.rows[0] = 10**6  # where the core reads it
    with pytest.raises(ValueError, match="that there are not"):
        structure.structure.step(start, structure.intact, SUBSTEP_S)
    frames = replace(structure.frames, first=structure.frames.first + BODIES)
    with pytest.raises(ValueError, match="connections end in bodies 9 to 17 of 9"):
        Frames.of(frames, BODIES)


def put(name, *place):
    """What puts a number into an array of a structure."""
    return lambda structure, wrong: getattr(structure, name).__setitem__(place, wrong)


@pytest.mark.parametrize("wrong", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize(
    ("damage", "named"),
    [
        (put("velocities", 4, 3), "velocity of body 3"),
        (put("positions", 2, BODIES - 1), "position of body 8"),
        (put("rotations", 0, 1, 0), "rotation of body 0"),
        (put("stiffness", 5, 5, 12), "stiffness of connection 12"),
    ],
)
def test_what_is_no_number_is_named_and_nothing_else_happens(damage, named, wrong):
    structure = Structure(2, borne=False, bared=False)
    damage(structure, wrong)
    with pytest.raises(NotFiniteError, match=f"^the {named} is no finite number$"):
        structure.step()


def test_a_force_of_bars_that_is_no_number_is_named():
    """That with which they begin, across the third of the cracks."""
    pulls_n = np.zeros((3, 4, 4))
    pulls_n[1, 3, 2] = np.nan
    with pytest.raises(NotFiniteError, match=r"^the (force|deformation) of connection 6 is no finite number$"):
        Structure(2, pulls_n=pulls_n).step()


def test_numbers_that_grow_beyond_all_are_named():
    """All are finite as a sub-step begins."""
    structure = Structure(2, cracked=False, borne=False, bared=False)
    structure.velocities[0, 5] = 1e308
    with pytest.raises(NotFiniteError, match=r"^the (force of connection|velocity of body) \d+ is no finite number$"):
        structure.step()
