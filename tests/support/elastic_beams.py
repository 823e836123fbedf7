# SPDX-License-Identifier: GPL-3.0-or-later
"""Beams of blocks with elastic connections, as arrays, whose loads and deflections beam theory gives by hand."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bridge_demolition_addon.engineering.elasticity.equations import RigidBodies, spring_forces
from bridge_demolition_addon.engineering.elasticity.equilibrium import Equilibrium, equilibrium
from bridge_demolition_addon.engineering.elasticity.joint_rows import JointFrames, joint_positions
from bridge_demolition_addon.engineering.elasticity.section_stiffness import ElasticModuli, whole_section_stiffness

CONCRETE = ElasticModuli(30e9, 0.2)
DENSITY_KG_M3 = 2400.0
GRAVITY_M_S2 = 9.80665


@dataclass(frozen=True, eq=False)
class ElasticBodies:
    """n bodies and m connections at rest: positions (3, n), rotations (3, 3, n), and what `equilibrium` asks for."""

    frames: JointFrames
    stiffness: np.ndarray
    masses_kg: np.ndarray
    inertias_kg_m2: np.ndarray
    positions_m: np.ndarray
    rotations: np.ndarray

    def at_rest(self) -> Equilibrium:
        """Where they rest under their weight."""
        still = RigidBodies(self.masses_kg, self.inertias_kg_m2, self.positions_m, self.rotations)
        return equilibrium(self.frames, self.stiffness, still, np.array([0.0, 0.0, -GRAVITY_M_S2]))

    def amounts(self, rest: Equilibrium) -> np.ndarray:
        """Forces and moments (6, m) in the rows of the connections there, pulling the first body to the second."""
        before = joint_positions(self.frames, self.positions_m, self.rotations).deformations()
        after = joint_positions(self.frames, rest.positions_m, rest.rotations).deformations()
        return spring_forces(self.stiffness, after - before)


def bodies(
    positions_m: np.ndarray,
    masses_kg: np.ndarray,
    sizes_m: np.ndarray,
    joints: list[tuple[int, int, np.ndarray]],
    stiffness,
) -> ElasticBodies:
    """Boxes at positions (n, 3), connected in pairs at points in the axes of the world."""
    first, second = (np.array([joint[side] for joint in joints]) for side in (0, 1))
    points = np.array([joint[2] for joint in joints], float)
    axes = np.repeat(np.eye(3)[:, :, None], len(joints), axis=2)
    frames = JointFrames(first, second, axes, axes, (points - positions_m[first]).T, (points - positions_m[second]).T)
    squares = np.square(sizes_m)
    inertias = np.zeros((3, 3, len(masses_kg)))
    for axis in range(3):
        inertias[axis, axis] = masses_kg * (squares.sum(axis=1) - squares[:, axis]) / 12.0
    rotations = np.repeat(np.eye(3)[:, :, None], len(masses_kg), axis=2)
    return ElasticBodies(frames, stiffness, masses_kg, inertias, positions_m.T.copy(), rotations)


def beam(blocks: int, length_m: float = 12.0, *, held: tuple[str, ...] = ("start",), rollers: tuple[float, ...] = ()):
    """A beam of 1 m × 1 m along x: fixed at its `start`, its `end` or both, and on rollers at shares of its length."""
    size = length_m / blocks
    places = [((index + 0.5) * size, 0.0, 0.0) for index in range(blocks)]
    joints = [(index - 1, index, (index * size, 0.0, 0.0)) for index in range(1, blocks)]
    lengths = [size] * len(joints)
    for side, x, block in (("start", 0.0, 0), ("end", length_m, blocks - 1)):
        if side in held:
            places.append((x, 0.0, 0.0))
            pair = (len(places) - 1, block) if side == "start" else (block, len(places) - 1)
            joints.append((*pair, (x, 0.0, 0.0)))
            lengths.append(size / 2.0)
    sections = len(joints)
    ones = np.ones(sections)
    of_faces = whole_section_stiffness(
        CONCRETE.young_pa * ones,
        CONCRETE.shear_pa * ones,
        ones,
        np.tile(np.eye(2) / 12.0, (sections, 1, 1)),
        np.array(lengths),
    )
    stiffness = np.moveaxis(of_faces.matrices, 0, -1)
    upright = np.zeros((6, 6, len(rollers)))
    upright[2, 2] = 1e13
    for share in rollers:
        places.append((share * length_m, 0.0, 0.0))
        block = min(int(share * blocks - 1e-9), blocks - 1)
        joints.append((len(places) - 1, max(block, 0), (share * length_m, 0.0, 0.0)))
    positions = np.array(places)
    masses = np.where(np.arange(len(places)) < blocks, DENSITY_KG_M3 * size, 0.0)
    sizes = np.tile((size, 1.0, 1.0), (len(places), 1))
    return bodies(positions, masses, sizes, joints, np.concatenate((stiffness, upright), axis=2))
