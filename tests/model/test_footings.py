# SPDX-License-Identifier: GPL-3.0-or-later
"""A block on a bed of springs, stepped in time without Blender: it settles, yields, lifts off and slides as by hand."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity.equations import RigidBodies
from bridge_demolition_addon.engineering.elasticity.joint_rows import JointFrames
from bridge_demolition_addon.engineering.elasticity.structure import ElasticStructure, StepInput
from bridge_demolition_addon.engineering.foundations import SOILS, Footings, SoilSprings
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.foundations import Foundation
from bridge_demolition_addon.model.scenario import Scenario
from bridge_demolition_addon.model.scenario.file import scenario_from_text

pytestmark = pytest.mark.slow

MASS_KG = 20_000.0
SIDE_M = 2.0
STIFFNESS_N_M3 = 2e8
WHOLE_N_M = STIFFNESS_N_M3 * SIDE_M**2
SUBSTEP_S = 1.0 / 60.0
SIDES = 12


class Block:
    """A cube of 20 t on a square footing of 2 m, which forces push at its centre, 1 m above the ground."""

    def __init__(self, capacity_pa=np.inf, friction=10.0):
        middles = SIDE_M * ((np.arange(SIDES) + 0.5) / SIDES - 0.5)
        x, y = (grid.ravel() for grid in np.meshgrid(middles, middles))
        count = len(x)
        one = np.ones(1)
        soil = SoilSprings(
            rows=np.zeros(1, int),
            footings=np.zeros(count, int),
            places_m=np.column_stack((x, y, np.zeros(count))),
            areas_m2=np.full(count, SIDE_M**2 / count),
            stiffness_n_m3=STIFFNESS_N_M3 * one,
            horizontal_n_m3=STIFFNESS_N_M3 * one,
            capacity_pa=capacity_pa * one,
            friction=friction * one,
        )
        ends, axes = (np.zeros(1, int), np.ones(1, int)), np.eye(3)[:, :, None]
        frames = JointFrames(*ends, axes, axes, np.array([[0.0, 0.0, -1.0]]).T, np.zeros((3, 1)))
        self.masses = np.array([MASS_KG, 0.0])
        inertias = np.zeros((3, 3, 2))
        self.inertia = MASS_KG * 2.0 * SIDE_M**2 / 12.0
        inertias[[0, 1, 2], [0, 1, 2], 0] = self.inertia
        self.positions = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, 0.0]]).T
        self.rotations = np.repeat(np.eye(3)[:, :, None], 2, axis=2)
        self.velocities = np.zeros((6, 2))
        footings = Footings(soil, *ends, self.masses > 0.0, self.positions, self.rotations)
        bodies = RigidBodies(self.masses, inertias, self.positions, self.rotations)
        self.structure = ElasticStructure(frames, np.zeros((6, 6, 1)), bodies, 0.0, soil=footings)
        self.turn = 0.0

    def push(self, force_n, seconds):
        """Push with a force (3,) for a time; the block is slowed as by heavy damping, so that it comes to rest."""
        impulse = SUBSTEP_S * np.array(force_n, float)
        for _ in range(round(seconds / SUBSTEP_S)):
            self.velocities *= 0.8
            self.velocities[:3, 0] += impulse / MASS_KG
            self.structure.update_plastic_state(self.positions, self.rotations)
            states = StepInput(self.positions, self.rotations, self.velocities, np.zeros(2, bool))
            step = self.structure.step(states, np.ones(1, bool), SUBSTEP_S)
            self.velocities[:3, 0] += step.of_bodies[:3, 0] / MASS_KG
            self.velocities[3:, 0] += step.of_bodies[3:, 0] / self.inertia
            self.positions = self.positions + SUBSTEP_S * self.velocities[:3]
            self.turn += SUBSTEP_S * self.velocities[4, 0]
            turned = np.array(
                [[np.cos(self.turn), 0, np.sin(self.turn)], [0, 1, 0], [-np.sin(self.turn), 0, np.cos(self.turn)]]
            )
            self.rotations = np.stack((turned, np.eye(3)), axis=2)
        self.force_n = step.of_first[:3, 0] / SUBSTEP_S
        return self

    @property
    def settled_m(self):
        return 1.0 - self.positions[2, 0]


def test_it_settles_by_load_over_stiffness_and_comes_back():
    block = Block().push((0.0, 0.0, -4e5), 1.0)
    assert block.settled_m == pytest.approx(4e5 / WHOLE_N_M, rel=1e-4)
    assert block.force_n == pytest.approx([0.0, 0.0, 4e5], rel=1e-4, abs=1.0)
    assert block.push((0.0, 0.0, -1e5), 1.0).settled_m == pytest.approx(1e5 / WHOLE_N_M, rel=1e-4)


def test_beyond_what_soil_bears_it_sinks_and_what_it_sank_stays():
    """It is pushed with 1.2 times the capacity, then with half and a quarter: it rises by what is elastic alone."""
    capacity_n = 4e5
    block = Block(capacity_pa=capacity_n / SIDE_M**2).push((0.0, 0.0, -1.2 * capacity_n), 0.1)
    assert block.force_n[2] == pytest.approx(capacity_n, rel=1e-4)
    half = block.push((0.0, 0.0, -0.5 * capacity_n), 1.0).settled_m
    quarter = block.push((0.0, 0.0, -0.25 * capacity_n), 1.0).settled_m
    assert half > 3.0 * capacity_n / WHOLE_N_M
    assert half - quarter == pytest.approx(0.25 * capacity_n / WHOLE_N_M, rel=1e-3)


def test_it_does_not_hold_what_is_lifted():
    block = Block().push((0.0, 0.0, -1e5), 0.5).push((0.0, 0.0, 1e4), 0.5)
    assert block.settled_m < -0.005
    assert block.force_n.tolist() == [0.0, 0.0, 0.0]


def test_a_push_at_the_side_lifts_the_heel_as_winkler_has_it():
    """With the load N at e = 0.6 m from the middle, beyond a sixth of B = 2 m, c = 3 (B / 2 - e) of the footing is
    pressed, by up to p = 2 N / (c B): it turns by p / (k c). Twelve strips in place of a continuous bed: 3 %."""
    load_n, off_m = 4e5, 0.6
    block = Block().push((0.0, 0.0, -load_n), 0.5).push((off_m * load_n, 0.0, -load_n), 2.0)
    pressed_m = 3.0 * (SIDE_M / 2.0 - off_m)
    turn = 2.0 * load_n / (pressed_m * SIDE_M) / (STIFFNESS_N_M3 * pressed_m)
    assert block.turn == pytest.approx(turn, rel=0.03)


def test_it_slides_where_friction_ends_and_bears_that_meanwhile():
    block = Block(friction=0.5).push((0.0, 0.0, -4e5), 0.5)
    held = block.push((1e5, 0.0, -4e5), 1.0)
    assert held.force_n[0] == pytest.approx(-1e5, rel=1e-3)
    assert held.positions[0, 0] < 0.005
    slid = block.push((3e5, 0.0, -4e5), 0.5)
    assert slid.force_n[0] == pytest.approx(-2e5, rel=0.01)
    before = slid.positions[0, 0]
    assert slid.push((3e5, 0.0, -4e5), 0.5).positions[0, 0] - before > 0.05


def test_classes_have_the_pressures_of_bowles():
    """k = 40 q: medium dense sand with 44.8 MN/m³ bears 1120 kPa."""
    foundation = Foundation(member="pier", soil="medium dense sand")
    assert foundation.capacity_pa == pytest.approx(1120e3)
    assert Foundation(member="pier", soil="loose sand", capacity_kpa=200.0).capacity_pa == pytest.approx(200e3)
    own = Foundation(member="pier", stiffness_mn_m3=30.0, friction=0.4)
    assert (own.ground.stiffness_n_m3, own.capacity_pa) == (30e6, np.inf)
    assert SOILS["loose sand"].stiffness_n_m3 < SOILS["dense sand"].stiffness_n_m3


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({}, "foundations.stiffness_mn_m3 is missing: expected a number, or a foundations.soil"),
        ({"stiffness_mn_m3": 10.0}, "foundations.friction is missing: expected a number, or a foundations.soil"),
        ({"soil": "mud"}, r'foundations.soil is "mud": expected one of "loose sand"'),
        ({"soil": "dense sand", "footing_m": (0.0, 1.0)}, r"foundations.footing_m.1 is 0.0"),
    ],
)
def test_wrong_keys_are_refused_in_words(given, said):
    with pytest.raises(ScenarioError, match=said):
        Foundation(member="pier", **given)


SHORT = """
[scenario]
title = "short"
[time]
duration_s = 1.0
[bridge]
span_lengths_m = [5.0]
density_kg_m3 = 2400.0
[bridge.deck]
width_m = 4.0
thickness_m = 0.5
[bridge.piers]
columns = 1
column_length_m = 1.0
column_width_m = 1.0
height_m = 3.0
[fracture]
shards = 10
[connections]
type = "FIXED"
method = "face"
material = "concrete"
stiffness = "elastic"
[[foundations]]
member = "pier"
soil = "dense sand"
"""


def model_of(text) -> Scenario:
    from bridge_demolition_addon.model.structure.model import build_model

    return build_model(scenario_from_text(text))


def test_a_model_has_footings_of_the_size_that_is_given():
    text = SHORT.replace('soil = "dense sand"', 'soil = "dense sand"\nfooting_m = [2.0, 3.0]')
    bare, model = model_of(SHORT), model_of(text)
    piers = len({shard for shard in bare.connections.pairs[bare.soil.rows, 0].tolist()})
    assert bare.soil.areas_m2.sum() == pytest.approx(2.0)  # two piers
    assert model.soil.areas_m2.sum() == pytest.approx(12.0)
    assert len(model.soil.rows) == piers
    assert model.connections.areas[model.soil.rows].sum() == pytest.approx(12.0)
    assert model.stiffness.axial_n_m[model.soil.rows].sum() == pytest.approx(96e6 * 12.0)
    assert not model.breakable[model.soil.rows].any() and model.breakable.sum() == len(model.connections) - piers


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (('member = "pier"', 'member = "footing"'), 'foundations.member is "footing": expected the name or kind'),
        (('member = "pier"', 'member = "deck"'), "nothing of deck.* stands on the ground and can move"),
        (('soil = "dense', 'footing_m = [0.5, 3.0]\nsoil = "dense'), "footing_m is 0.5 × 3 m .* at least 1 × 1 m"),
        (
            ('stiffness = "elastic"', 'stiffness = "rigid"'),
            'connections.stiffness is "rigid": expected "elastic" with foundations',
        ),
        (('stiffness = "elastic"', 'stiffness = "elastic"\nfoundation = false'), "connections.foundation is false"),
        (
            ("[[foundations]]", '[[supports]]\nmember = "pier"\nface = "bottom"\n[[foundations]]'),
            "nothing of pier 1 stands on the ground and can move: .* no support under it",
        ),
        (
            ("[[foundations]]", '[[foundations]]\nmember = "pier 1"\nsoil = "stiff clay"\n[[foundations]]'),
            "pier 1 has two foundations",
        ),
    ],
)
def test_footings_that_are_not_there_are_refused_in_words(change, said):
    with pytest.raises(ScenarioError, match=said):
        model_of(SHORT.replace(*change))
