# SPDX-License-Identifier: GPL-3.0-or-later
"""Bars and plates in irregular shards, held at their feet: the work of loads on them, held against beam theory.

Loads are in proportion to the mass. By Clapeyron, the work of a load that grows from 0 is half of force times way, and
is the energy of the beam: ∫ N²/2EA, ∫ M²/2EI + V²/2κGA, ∫ T²/2GJ along it.
"""

from dataclasses import dataclass

import numpy as np
import pytest
from support.long_cases import long_but

from bridge_demolition_addon.engineering.elasticity.section_stiffness import ElasticModuli
from bridge_demolition_addon.engineering.fracture.shards import fracture
from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.engineering.mechanics.strength import Joint
from bridge_demolition_addon.engineering.structure.connections import (
    connect,
    foundations,
    joined,
    neighbours_by_face,
    second_moments,
)
from bridge_demolition_addon.model.bridge.member import Member
from bridge_demolition_addon.model.structure.connection_source import CutMembers
from bridge_demolition_addon.model.structure.equilibrium import at_rest, box_inertia
from bridge_demolition_addon.model.structure.stiffness import connection_stiffness

pytestmark = pytest.mark.slow

MODULI = ElasticModuli(30e9, 0.2)
DENSITY_KG_M3, PULL_M_S2 = 2400.0, 0.1


@dataclass(frozen=True)
class Bar:
    """A bar with its sizes along x, y and up."""

    depth_m: float
    width_m: float
    height_m: float

    def works(self, count: int, seed: int) -> list[float]:
        """Work of loads upwards, along x and along y, and of a torque, over what theory says."""
        solid = box((self.depth_m, self.width_m, self.height_m), (0.0, 0.0, self.height_m / 2.0))
        cut = fracture(solid, count, seed)
        between = connect(cut.centres, cut.faces, *neighbours_by_face(cut.faces), limit_per_shard=1000)
        connections = joined([between, foundations(cut.shards)])
        faces = connections.pairs[:, 0], connections.areas, connections.points, connections.normals
        of_shards = np.zeros(len(cut), int)
        members = CutMembers(
            [Member("bar", "pier", solid)], of_shards, cut.shards, cut.points, of_shards > 0, np.zeros(1, bool)
        )
        joints, rows = [Joint("FIXED", moduli=MODULI)], np.zeros(len(connections), int)
        stiffness = connection_stiffness(connections, second_moments(cut.shards, *faces), joints, rows, members)
        masses = DENSITY_KG_M3 * cut.volumes
        inertias = masses[:, None] * [box_inertia(np.ptp(shard.vertices, axis=0)) for shard in cut.shards]
        found = []
        for row, theory in zip((2, 0, 1, 5), self.theory(), strict=True):
            loads = np.zeros((6, len(cut)))
            loads[row] = PULL_M_S2 * masses
            # A little weight: where no forces act, it would be at rest as it is.
            weight = (0.0, 0.0, -1e-5 * PULL_M_S2)
            rest = at_rest(connections, stiffness, masses, inertias, cut.centres, None, weight, loads)
            moved = rest.positions_m[:, :-1].T - cut.centres
            turned = rest.rotations[1, 0, :-1]  # small
            found.append(float((loads[row] * (turned if row == 5 else moved[:, row])).sum()) / theory)
        return found

    def theory(self) -> tuple[float, ...]:
        """Twice the energies of these loads, J."""
        area, length = self.depth_m * self.width_m, self.height_m
        young, shear, even = MODULI.young_pa, MODULI.shear_pa, DENSITY_KG_M3 * area * PULL_M_S2
        bent = [
            even**2 * length**5 / (20.0 * young * area * side**2 / 12.0)
            + even**2 * length**3 / (3.0 * 5.0 / 6.0 * shear * area)
            for side in (self.depth_m, self.width_m)
        ]
        return even**2 * length**3 / (3.0 * young * area), *bent, even**2 * length**3 / (3.0 * shear * self.torsion_m4)

    @property
    def torsion_m4(self) -> float:
        """Torsion constant by the first terms of Saint-Venant's series (Timoshenko, Goodier 1951, equation 160)."""
        short, long = sorted((self.depth_m, self.width_m))
        terms = sum(np.tanh(n * np.pi * long / (2.0 * short)) / n**5 for n in (1, 3, 5, 7))
        return float(short**3 * long / 3.0 * (1.0 - 192.0 * short / (np.pi**5 * long) * terms))


COLUMN, WALL, GIRDER = Bar(0.7, 0.7, 5.0), Bar(0.6, 3.0, 12.0), Bar(0.4, 0.9, 12.0)


@pytest.mark.parametrize("bar", [COLUMN, WALL, GIRDER], ids=("column", "wall", "girder"))
@pytest.mark.parametrize(("count", "within"), long_but([(25, 0.1)], [(25, 0.1), (100, 0.06)], several=True))
def test_bars_in_irregular_shards_deform_as_beams_do(bar, count, within):
    along, one_way, other_way, twisted = np.median([bar.works(count, seed) for seed in (1, 2, 3)], axis=0)
    assert along == pytest.approx(1.0, abs=within / 2.0)
    assert (one_way, other_way) == pytest.approx((1.0, 1.0), abs=within)
    # Feet hold the warping of sections, and a girder in one row of shards has no shear between rows.
    assert 0.8 < twisted < 1.2


def test_a_plate_one_shard_deep_bends_as_a_plate():
    along, across, in_plane, _ = np.median([Bar(0.25, 3.0, 12.0).works(60, seed) for seed in (1, 2, 3)], axis=0)
    assert along == pytest.approx(1.0, abs=0.03)
    assert across == pytest.approx(1.0, abs=0.12)
    assert in_plane == pytest.approx(1.0, abs=0.12)
