# SPDX-License-Identifier: GPL-3.0-or-later
"""First frequencies of what is left of an elastic structure, against Timoshenko's beam."""

import numpy as np
import pytest
from support.elastic_beams import CONCRETE, DENSITY_KG_M3, beam

from bridge_demolition_addon.engineering.elasticity.equations import RigidBodies
from bridge_demolition_addon.engineering.elasticity.structure import ElasticStructure, StepInput

SUBSTEP_S, LENGTH_M = 1e-3, 24.0


def frequency_hz(span_m):
    """S. Timoshenko (1921), Philosophical Magazine 41, 744, of a beam of 1 m × 1 m on two supports."""
    wave, density = np.pi / span_m, DENSITY_KG_M3
    bending, shear, turning = CONCRETE.young_pa / 12.0, 5.0 / 6.0 * CONCRETE.shear_pa, density / 12.0
    terms = (turning * density / shear, density + wave**2 * (turning + bending * density / shear), bending * wave**4)
    square = (terms[1] - np.sqrt(terms[1] ** 2 - 4.0 * terms[0] * terms[2])) / (2.0 * terms[0])
    return np.sqrt(square) / (2.0 * np.pi)


class Deck:
    """A deck on three supports, in 48 blocks, of which connections break."""

    def __init__(self):
        self.beam = beam(48, LENGTH_M, held=(), rollers=(0.0, 0.5, 1.0))
        supports = slice(-3, None)
        self.beam.stiffness[[1, 2], [1, 2], supports] = 1e13
        self.beam.stiffness[3, 3, supports] = 1e13
        self.beam.stiffness[0, 0, -3] = 1e13
        still = RigidBodies(self.beam.masses_kg, self.beam.inertias_kg_m2, self.beam.positions_m, self.beam.rotations)
        self.structure = ElasticStructure(self.beam.frames, self.beam.stiffness, still, 0.01)
        self.intact = np.ones(len(self.beam.frames), bool)
        count = len(self.beam.masses_kg)
        self.start = StepInput(self.beam.positions_m, self.beam.rotations, np.zeros((6, count)), np.zeros(count, bool))

    def after(self, broken):
        """What has lost connections once some are broken."""
        self.intact[broken] = False
        self.structure.step(self.start, self.intact, SUBSTEP_S)
        self.structure.end_substep()
        return self.structure.frequencies_after_breaks(self.start.positions_m, self.start.rotations)


def test_a_deck_that_loses_its_middle_support_swings_over_both_spans():
    deck = Deck()
    assert deck.after([]) == []
    ((connections, found),) = deck.after([-2])
    assert connections.tolist() == np.flatnonzero(deck.intact).tolist()
    assert found == pytest.approx(frequency_hz(LENGTH_M), rel=0.005)
    assert deck.after([]) == []  # nothing was lost since


def test_only_what_has_lost_a_connection_and_stands_has_another_frequency():
    deck = Deck()
    assert deck.after([-1, -2, -3]) == []  # it falls
    deck = Deck()
    middle = 23  # between blocks 23 and 24
    assert {len(connections) for connections, _ in deck.after([middle])} == {25, 24}


def test_damping_slows_what_it_is_given_for():
    """With β much longer than a sub-step, relative motion hardly goes on: here of two blocks that part."""
    rates = {}
    for damping_s in (0.0, 10.0):
        deck = Deck()
        deck.structure.damp(np.full(len(deck.intact), damping_s))
        deck.start.velocities[0, 10] = 1.0
        acting = deck.structure.step(deck.start, deck.intact, 1e-6)
        rates[damping_s] = abs(acting.rates[0, 9])
    assert rates[0.0] > 0.5 and rates[10.0] < 0.01
