# SPDX-License-Identifier: GPL-3.0-or-later
"""Slabs in irregular shards that stand on the ground and are pulled sideways, held against beam theory."""

from dataclasses import replace

import numpy as np
import pytest
from support.long_cases import long_but

from bridge_demolition_addon.engineering.elasticity.section_stiffness import ElasticModuli
from bridge_demolition_addon.engineering.fracture.shards import fracture
from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh
from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.engineering.mechanics.strength import Joint
from bridge_demolition_addon.engineering.structure.connections import (
    GROUND,
    connect,
    foundations,
    joined,
    neighbours_by_face,
    second_moments,
)
from bridge_demolition_addon.errors import GeometryError
from bridge_demolition_addon.model.bridge.member import Member
from bridge_demolition_addon.model.bridge.mesh_files import exported
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.structure.connection_source import CutMembers
from bridge_demolition_addon.model.structure.equilibrium import at_rest, box_inertia
from bridge_demolition_addon.model.structure.model import build_model
from bridge_demolition_addon.model.structure.stiffness import connection_stiffness

pytestmark = pytest.mark.slow

MODULI = ElasticModuli(30e9, 0.2)
DENSITY_KG_M3, GRAVITY_M_S2 = 2400.0, 9.80665
DEPTH_M, WIDTH_M, HEIGHT_M = 1.0, 4.0, 20.0


def upside_down(shards):
    """Shards of the slab, turned so that its top is its foot."""
    mirror = np.array((1.0, -1.0, -1.0))
    return [TriangleMesh(shard.vertices * mirror + (0.0, 0.0, HEIGHT_M), shard.triangles) for shard in shards]


def held_at_the_top(shards):
    """Foundations of its top, in the axes of the slab."""
    found, mirror = foundations(upside_down(shards)), np.array((1.0, -1.0, -1.0))
    return replace(found, points=found.points * mirror + (0.0, 0.0, HEIGHT_M), normals=found.normals * mirror)


def standing_slab(shard_count, seed, *, held=False):
    """Shards and connections of a slab on the ground, and held at its top too if wanted, with their stiffness."""
    solid = box((DEPTH_M, WIDTH_M, HEIGHT_M), (0.0, 0.0, HEIGHT_M / 2))
    cut = fracture(solid, shard_count, seed)
    between = connect(cut.centres, cut.faces, *neighbours_by_face(cut.faces), limit_per_shard=1000)
    connections = joined([between, foundations(cut.shards), *([held_at_the_top(cut.shards)] if held else [])])
    moments = second_moments(
        cut.shards, connections.pairs[:, 0], connections.areas, connections.points, connections.normals
    )
    of_shards = np.zeros(len(cut), int)
    stiffness = connection_stiffness(
        connections,
        moments,
        [Joint("FIXED", moduli=MODULI)],
        np.zeros(len(connections), int),
        CutMembers(
            [Member("slab", "deck", solid)], of_shards, cut.shards, cut.points, of_shards > 0, np.zeros(1, bool)
        ),
    )
    return cut, connections, stiffness


def sag_by_theory(shard_count, seed):
    """How far the top of the slab goes sideways under its own weight, over what beam theory says."""
    cut, connections, stiffness = standing_slab(shard_count, seed)
    masses = DENSITY_KG_M3 * cut.volumes
    inertias = masses[:, None] * [box_inertia(np.ptp(shard.vertices, axis=0)) for shard in cut.shards]
    rest = at_rest(connections, stiffness, masses, inertias, cut.centres, gravity_m_s2=(GRAVITY_M_S2, 0.0, 0.0))
    centres = cut.centres
    top = np.argsort(-centres[:, 2])[: max(1, shard_count // 40)]
    arms = np.array((0.0, 0.0, HEIGHT_M)) - centres[top]
    moved = rest.positions_m[:, top].T - centres[top]
    moved += np.einsum("ijk,kj->ki", rest.rotations[..., top], arms) - arms
    weight, inertia = DENSITY_KG_M3 * GRAVITY_M_S2 * DEPTH_M * WIDTH_M, WIDTH_M * DEPTH_M**3 / 12
    bent = weight * HEIGHT_M**4 / (8 * MODULI.young_pa * inertia)
    sheared = weight * HEIGHT_M**2 / (2 * 5 / 6 * MODULI.shear_pa * DEPTH_M * WIDTH_M)
    return moved[:, 0].mean() / (bent + sheared)


# Where a shard is about as deep as the slab, its sag is a matter of how the cuts happen to lie: over 4 seeds each it
# was 1.03 ± 0.08 of theory in 40 shards, 1.01 ± 0.02 in 200, and 0.99 in 1000. The means of four are as far off at most
# as two of their own standard errors.
@pytest.mark.parametrize(
    ("count", "seeds", "within"),
    long_but([(40, 4, 0.12), (200, 4, 0.04)], [(40, 4, 0.12), (200, 4, 0.04), (1000, 1, 0.03)], several=True),
)
def test_a_slab_in_shards_is_as_stiff_as_the_slab(count, seeds, within):
    assert np.mean([sag_by_theory(count, seed) for seed in range(seeds)]) == pytest.approx(1.0, abs=within)


def test_a_connection_without_an_area_is_refused():
    cut = fracture(box((1.0, 1.0, 4.0)), 8, 0)
    connections = connect(cut.centres, cut.faces, *neighbours_by_face(cut.faces), limit_per_shard=1000)
    connections.areas[0] = 0.0
    member, of_shards = Member("slab", "deck", box((1.0, 1.0, 4.0))), np.zeros(len(cut), int)
    with pytest.raises(GeometryError, match="1 connections have no area"):
        connection_stiffness(
            connections,
            np.zeros((len(connections), 2, 2)),
            [Joint("FIXED", moduli=MODULI)],
            np.zeros(len(connections), int),
            CutMembers([member], of_shards, cut.shards, cut.points, of_shards > 0, np.zeros(1, bool)),
        )


def test_connections_to_the_ground_bear_the_whole_weight():
    cut, connections, stiffness = standing_slab(30, 1)
    masses = DENSITY_KG_M3 * cut.volumes
    inertias = masses[:, None] * [box_inertia(np.ptp(shard.vertices, axis=0)) for shard in cut.shards]
    rest = at_rest(connections, stiffness, masses, inertias, cut.centres)
    borne = rest.loads[:3, connections.pairs[:, 1] == GROUND].sum(axis=1)
    weight = DENSITY_KG_M3 * GRAVITY_M_S2 * DEPTH_M * WIDTH_M * HEIGHT_M
    # They push the shards up: pulled towards the ground is negative. It is at rest within 1e-4 of the weight.
    assert abs(borne[2]) == pytest.approx(weight, rel=1e-3)
    assert borne[:2] == pytest.approx([0.0, 0.0], abs=1e-3 * weight)


# Means of seeds that test_a_slab_in_shards_is_as_stiff_as_the_slab has: what is redundant goes by the same stiffness.
@pytest.mark.parametrize(
    ("count", "seeds", "within"),
    long_but([(40, 4, 0.05), (200, 4, 0.02)], [(40, 4, 0.05), (200, 4, 0.02), (1000, 1, 0.02)], several=True),
)
def test_a_slab_held_at_both_ends_has_the_moments_of_a_fixed_beam(count, seeds, within):
    """Pulled sideways: w L² / 12 at both ends, and half of the load."""
    load = DENSITY_KG_M3 * GRAVITY_M_S2 * DEPTH_M * WIDTH_M
    found = []
    for seed in range(seeds):
        cut, connections, stiffness = standing_slab(count, seed, held=True)
        masses = DENSITY_KG_M3 * cut.volumes
        inertias = masses[:, None] * [box_inertia(np.ptp(shard.vertices, axis=0)) for shard in cut.shards]
        rest = at_rest(connections, stiffness, masses, inertias, cut.centres, gravity_m_s2=(GRAVITY_M_S2, 0.0, 0.0))
        for height in (0.0, HEIGHT_M):
            rows = (connections.pairs[:, 1] == GROUND) & (abs(connections.points[:, 2] - height) < 1e-6)
            forces, moments = rest.loads[:3, rows], rest.loads[3:, rows]
            levers = (connections.points[rows] - (0.0, 0.0, height)).T
            turning = moments[1] + levers[2] * forces[0] - levers[0] * forces[2]
            found.append((abs(forces[0].sum()) / (load * HEIGHT_M / 2), abs(turning.sum()) / (load * HEIGHT_M**2 / 12)))
    assert np.mean(found, axis=0) == pytest.approx([1.0, 1.0], abs=within)


def test_members_that_are_not_cut_give_way_evenly_to_both_sides(tmp_path):
    """Three blocks of 2 m in a row, the first of them held: E A / L over 1 m to the second, and 2 m to the third."""
    tables = ""
    for number in range(3):
        (tmp_path / f"{number}.obj").write_bytes(exported(box((2.0, 1.0, 1.0), (2.0 * number, 0.0, 5.0)), ".obj"))
        tables += f'[[geometry]]\nname = "block {number}"\nfile = "{number}.obj"\ndensity_kg_m3 = 2400.0\n'
    path = tmp_path / "scenario.toml"
    path.write_text(
        f"""
[scenario]
title = "three blocks"
[time]
duration_s = 1.0
{tables}
[[materials]]
name = "own"
compression_n_mm2 = 30.0
tension_n_mm2 = 3.0
shear_n_mm2 = 3.0
torsion_n_mm2 = 3.0
bending_n_mm2 = 3.0
elastic_modulus_n_mm2 = 30000.0
[[supports]]
member = "block 0"
[fracture]
shards = 3
[connections]
type = "FIXED"
method = "face"
material = "own"
stiffness = "elastic"
""",
        encoding="utf-8",
    )
    model = build_model(read_scenario(path))
    lengths = {
        tuple(sorted(pair)): 30e9 / axial
        for pair, axial in zip(model.connections.pairs.tolist(), model.stiffness.axial_n_m, strict=True)
    }
    assert lengths == {(0, 1): pytest.approx(1.0, rel=1e-4), (1, 2): pytest.approx(2.0, rel=1e-4)}
