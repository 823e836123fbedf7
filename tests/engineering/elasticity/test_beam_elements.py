# SPDX-License-Identifier: GPL-3.0-or-later
"""Joints that make two rigid bodies an element of a beam, against Timoshenko's beam and published torsion constants."""

import numpy as np
import pytest

from bridge_demolition_addon.engineering.elasticity.section_stiffness import (
    BeamSection,
    ElasticModuli,
    measured_at,
    web_torsion_m4,
)

CONCRETE = ElasticModuli(34e9, 0.2)


@pytest.mark.parametrize("length_m", [0.5, 3.0, 12.0])
def test_a_cantilever_of_one_element_bends_as_timoshenko_says(length_m):
    """Held at one node, with a force at the other: F L³ / 3 E I + F L / G A_s, and F L² / 2 E I of turning."""
    section, force = BeamSection.rectangle(0.4, 0.9), 1e5
    # Seen from the node that moves, the joint lies half a length back.
    at_the_end = measured_at(section.joint(CONCRETE, length_m), np.array([-0.5 * length_m, 0.0, 0.0]))
    moved = np.linalg.solve(at_the_end, np.array([0.0, 0.0, force, 0.0, 0.0, 0.0]))
    bending, shear = 34e9 * 0.4 * 0.9**3 / 12.0, 34e9 / 2.4 * 0.3
    assert moved[2] == pytest.approx(force * length_m**3 / 3.0 / bending + force * length_m / shear, rel=1e-9)
    assert moved[4] == pytest.approx(-force * length_m**2 / 2.0 / bending, rel=1e-9)


def test_a_web_twists_as_a_mesh_of_bricks_does():
    """A T of 0.4 m × 0.9 m below 2 m × 0.25 m: OpenSees has G J / G = 0.0296 m⁴ along its middle half, 6 × 10 bricks in
    the web; the flange alone is 0.0096 m⁴ of it (Roark, table 10.1)."""
    flange = BeamSection.rectangle(2.0, 0.25).torsion_m4
    assert web_torsion_m4(0.4, 0.9, 0.25) + flange == pytest.approx(0.0296, rel=0.03)


def test_a_web_without_a_slab_to_speak_of_twists_as_half_of_one_twice_as_deep():
    assert web_torsion_m4(0.4, 0.9, 1e-3) == pytest.approx(0.5 * BeamSection.rectangle(0.4, 1.8).torsion_m4, rel=1e-3)
