# SPDX-License-Identifier: GPL-3.0-or-later
"""Sections across a slab in irregular shards that is fixed at one end, held against statics."""

from dataclasses import dataclass

import numpy as np
import pytest
from reference.strength import cut_loads, rectangular_sections, utilisation
from support.long_cases import long_but

from bridge_demolition_addon.engineering.elasticity.section_stiffness import ElasticModuli
from bridge_demolition_addon.engineering.fracture.shards import fracture
from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.engineering.geometry.vectors import rotated
from bridge_demolition_addon.engineering.mechanics.carried_sections import (
    SPREAD,
    CarriedSections,
    MemberSections,
    kinds_of,
)
from bridge_demolition_addon.engineering.mechanics.overloads import Overloads
from bridge_demolition_addon.engineering.mechanics.section_cuts import (
    ConnectedFaces,
    ConnectionLoads,
    SectionForces,
    section_axes,
    worst_around,
)
from bridge_demolition_addon.engineering.mechanics.strength import Joint, Strength
from bridge_demolition_addon.engineering.structure.connections import (
    Connections,
    connect,
    foundations,
    joined,
    neighbours_by_face,
    second_moments,
)
from bridge_demolition_addon.model.bridge.member import Member
from bridge_demolition_addon.model.structure.equilibrium import at_rest, box_inertia
from bridge_demolition_addon.model.structure.stiffness import CutMembers, connection_stiffness

pytestmark = pytest.mark.slow

DENSITY_KG_M3, PULL_M_S2 = 2400.0, 9.80665
DEPTH_M, WIDTH_M, HEIGHT_M = 0.5, 1.0, 6.0
SOLID = box((DEPTH_M, WIDTH_M, HEIGHT_M), (0.0, 0.0, HEIGHT_M / 2.0))
SLAB = Member("slab", "deck", SOLID)
ROOT_MOMENT_NM = DENSITY_KG_M3 * PULL_M_S2 * DEPTH_M * WIDTH_M * HEIGHT_M**2 / 2.0
ROOT_STRESS_PA = ROOT_MOMENT_NM / (WIDTH_M * DEPTH_M**2 / 6.0)


@dataclass(frozen=True, eq=False)
class PulledSlab:
    """A slab in shards on the ground, held by elastic connections and pulled sideways by its weight."""

    connections: Connections
    second_moments_m4: np.ndarray
    centres_m: np.ndarray
    loads: ConnectionLoads

    @classmethod
    def cut(cls, shard_count: int, seed: int):
        """The slab at rest."""
        cut = fracture(SOLID, shard_count, seed)
        between = connect(cut.centres, cut.faces, *neighbours_by_face(cut.faces), limit_per_shard=1000)
        connections = joined([between, foundations(cut.shards)])
        faces = connections.pairs[:, 0], connections.areas, connections.points, connections.normals
        moments = second_moments(cut.shards, *faces)
        joints, rows = [Joint("FIXED", moduli=ElasticModuli(30e9, 0.2))], np.zeros(len(connections), int)
        of_shards = np.zeros(len(cut), int)
        members = CutMembers([SLAB], of_shards, cut.shards, cut.points, of_shards > 0, np.zeros(1, bool))
        stiffness = connection_stiffness(connections, moments, joints, rows, members)
        masses = DENSITY_KG_M3 * cut.volumes
        inertias = masses[:, None] * [box_inertia(np.ptp(shard.vertices, axis=0)) for shard in cut.shards]
        rest = at_rest(connections, stiffness, masses, inertias, cut.centres, gravity_m_s2=(PULL_M_S2, 0.0, 0.0))
        loads = ConnectionLoads(rest.loads[:3].T, rest.loads[3:].T, connections.points)
        return cls(connections, moments, np.vstack((cut.centres, np.zeros(3))), loads)

    @property
    def axes(self) -> np.ndarray:
        """Of the faces of its connections, (m, 3, 3)."""
        return section_axes(self.connections.normals)

    @property
    def pairs(self) -> np.ndarray:
        """Shards of each connection, and the ground behind the last of them."""
        return self.connections.pairs % len(self.centres_m)

    @property
    def faces(self) -> ConnectedFaces:
        """Of its connections."""
        connections = self.connections
        return ConnectedFaces(
            self.pairs, connections.points, connections.normals, connections.areas, self.second_moments_m4
        )

    @property
    def moves(self) -> np.ndarray:
        """Whether each body moves."""
        return np.arange(len(self.centres_m)) < len(self.centres_m) - 1

    def member_sections(self, thickness_m: float = SLAB.thickness_m) -> MemberSections:
        """Its sections."""
        count = len(self.connections)
        return MemberSections(
            self.faces,
            self.centres_m,
            self.moves,
            kinds_of((~self.moves[self.pairs]).astype(int)),
            np.full(count, thickness_m),
        )

    def sections(self, rows: np.ndarray) -> tuple[SectionForces, np.ndarray, np.ndarray]:
        """Loads and sizes of sections through connections."""
        return self.sections_of_parts(rows, np.zeros(len(self.connections), int))

    def sections_of_parts(self, rows: np.ndarray, parts: np.ndarray) -> tuple[SectionForces, np.ndarray, np.ndarray]:
        """The same, by the parts that connections hold together."""
        members = self.member_sections()
        of_rows = [members.through(row) for row in rows.tolist()]
        owners, through = np.repeat(np.arange(len(rows)), [*map(len, of_rows)]), np.concatenate(of_rows)
        holds = parts[through["face"]] == parts[rows][owners]
        owners, through = owners[holds], through[holds]
        faces, signs, cosines = (through[name] for name in ("face", "sign", "cosine"))
        return cut_loads(self.faces, self.loads, owners, faces, signs, cosines, self.axes[rows])

    def overloads(self, tension_pa: float, sections: MemberSections | None) -> Overloads:
        """What judges it by a strength that cracks in tension and bending."""
        strength = Strength(*(1e12 if name == "compression" else tension_pa for name in ("compression", *"1234")))
        return Overloads(self.faces, self.moves, strength, sections)


@pytest.mark.slow
@pytest.mark.parametrize("count", long_but([40, 200], [40, 200, 1000]))
def test_the_section_at_the_ground_bears_what_statics_says(count):
    slab = PulledSlab.cut(count, 1)
    rows = np.flatnonzero(~slab.moves[slab.pairs[:, 1]])
    loads, areas, second_moments = slab.sections(rows)
    # The foundation is one plane of 1 m, well within the spread of 2.3 m: a whole section, exact but for the sag.
    assert areas == pytest.approx(np.full(len(rows), DEPTH_M * WIDTH_M), rel=1e-6)
    about_y, about_z = second_moments[:, 0, 0], second_moments[:, 1, 1]
    assert np.maximum(about_y, about_z) == pytest.approx(WIDTH_M**3 * DEPTH_M / 12.0, rel=1e-3)
    assert abs(loads.bending_nm).max(axis=1) == pytest.approx(ROOT_MOMENT_NM, rel=1e-3)
    assert np.linalg.norm(loads.shear_n, axis=1) == pytest.approx(2.0 * ROOT_MOMENT_NM / HEIGHT_M, rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("count", long_but([200], [200, 1000]))
def test_sections_between_shards_bear_what_statics_says(count):
    slab = PulledSlab.cut(count, 2)
    connections = slab.connections
    height = connections.points[:, 2]
    rows = np.flatnonzero((abs(connections.normals[:, 2]) > 0.97) & (height > 1.0) & (height < 4.0))
    loads, areas, _ = slab.sections(rows)
    # Planes up to 14° from level, whose jagged cut goes round shards of 0.15 m to 0.25 m.
    assert len(rows) > 5
    assert areas == pytest.approx(np.full(len(rows), DEPTH_M * WIDTH_M), rel=0.08)
    assert np.median(areas) == pytest.approx(DEPTH_M * WIDTH_M, rel=0.02)
    above = HEIGHT_M - height[rows]
    expected = ROOT_MOMENT_NM * np.square(above / HEIGHT_M)
    assert np.linalg.norm(loads.bending_nm, axis=1) / expected == pytest.approx(np.ones(len(rows)), abs=0.15)
    assert np.median(np.linalg.norm(loads.bending_nm, axis=1) / expected) == pytest.approx(1.0, abs=0.03)


def test_a_section_does_not_reach_from_one_part_to_another():
    slab = PulledSlab.cut(200, 1)
    rows = np.flatnonzero(~slab.moves[slab.pairs[:, 1]])
    parts = (slab.connections.points[:, 1] > 0.0).astype(int)
    _, areas, _ = slab.sections_of_parts(rows, parts)
    ground = slab.connections.areas[rows]
    assert areas == pytest.approx(np.where(parts[rows], ground[parts[rows] == 1].sum(), ground[parts[rows] == 0].sum()))


def test_the_core_judges_whole_sections_as_numpy_does():
    slab = PulledSlab.cut(200, 1)
    members, count = slab.member_sections(), len(slab.connections)
    rows = np.flatnonzero(members.are_whole(np.arange(count)))
    overloads, holds = slab.overloads(2e6, members), np.ones(count, bool)
    alone, parts = np.zeros(len(rows)), (slab.connections.points[:, 1] > 0.0).astype(int)
    used = overloads.together(rows, alone, slab.loads, slab.axes[rows], holds, np.ones(count), parts)
    loads, areas, second_moments = slab.sections_of_parts(rows, parts)
    strength = Strength(1e12, 2e6, 2e6, 2e6, 2e6)
    expected = utilisation(loads, rectangular_sections(areas, second_moments), strength)
    np.testing.assert_allclose(used, expected, rtol=1e-12)


def test_loads_that_bodies_carry_break_what_the_same_loads_break_as_they_are_given():
    slab = PulledSlab.cut(200, 1)
    count, turn = len(slab.connections), rotated(np.eye(3), np.array([0.3, -0.2, 0.5]))
    bodies, places = slab.pairs[:, 0], slab.centres_m
    levers = slab.connections.points - places[bodies]
    sections = CarriedSections(bodies, np.ones(count), levers, slab.axes)
    moments_nm = slab.loads.moments_nm + np.cross(levers, slab.loads.forces_n)
    loads = np.concatenate([vectors @ turn.T for vectors in (slab.loads.forces_n, moments_nm)], axis=1).T.copy()
    placed = (places @ turn.T).T.copy(), np.tile(turn[:, :, None], len(places))
    holds, left = np.arange(count) % 7 > 0, np.linspace(0.8, 1.2, count)
    parts = (slab.connections.points[:, 1] > 0.0).astype(int)
    judging = slab.overloads(0.5 * ROOT_STRESS_PA, slab.member_sections())
    rows, used = judging.overloaded(np.flatnonzero(holds), slab.loads, slab.axes[holds], holds, left, parts)
    worst = rows[worst_around(slab.pairs[rows], used, slab.moves)]
    assert judging.breaking(holds, sections, loads, *placed, left, parts).tolist() == worst.tolist() != []


def test_what_clips_an_edge_is_no_section_of_the_member():
    slab = PulledSlab.cut(200, 1)
    sections = slab.member_sections()
    rows = np.arange(len(slab.connections))
    whole = sections.are_whole(rows)
    assert whole[~slab.moves[slab.pairs[:, 1]]].all()
    assert 0.9 < whole.mean() < 1.0
    corner = np.abs(slab.connections.points[:, :2]) / (DEPTH_M / 2.0, WIDTH_M / 2.0)
    assert np.median(corner[~whole].max(axis=1)) > np.median(corner[whole].max(axis=1))
    assert not slab.member_sections(np.nan).are_whole(rows).any()


@pytest.mark.slow
@pytest.mark.parametrize("count", long_but([40, 200], [40, 200, 1000]))
def test_a_slab_cracks_at_the_load_of_beam_theory_however_it_is_cut(count):
    # Shear adds 0.2 %; the foundation, where it cracks, is one plane.
    slab = PulledSlab.cut(count, 3)
    rows = np.arange(len(slab.connections))
    everything = slab.loads, slab.axes, rows >= 0, np.ones(len(rows)), np.zeros(len(rows), int)
    for share, cracks in ((0.97, True), (1.03, False)):
        judged = slab.overloads(share * ROOT_STRESS_PA, slab.member_sections())
        assert bool(len(judged.overloaded(rows, *everything)[0])) == cracks


def test_the_spread_of_two_sections_is_the_perimeter_of_punching():
    # EN 1992-1-1:2004, 6.4.2: u = 4 c + 4 π d, for a load of c = 1 m on a plate of d = 0.25 m.
    assert pytest.approx(4.0 + 4.0 * np.pi * 0.25, rel=0.02) == 2.0 * 2.0 * SPREAD * 0.25


def test_the_thickness_of_a_member_is_that_of_a_plate_or_half_the_side_of_a_bar():
    assert Member("plate", "deck", box((100.0, 100.0, 0.2))).thickness_m == pytest.approx(0.2, rel=0.01)
    assert Member("bar", "pier", box((0.6, 0.6, 60.0))).thickness_m == pytest.approx(0.3, rel=0.01)
