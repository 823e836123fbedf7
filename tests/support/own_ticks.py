# SPDX-License-Identifier: GPL-3.0-or-later
"""Sub-steps of bodies and springs in memory of our own, as the core takes them, without Blender."""

import numpy as np

from bridge_demolition_addon.bullet.body_motion import BodyMotion, BulletBodies
from bridge_demolition_addon.bullet.constraint_rows import BulletRows, Softness
from bridge_demolition_addon.bullet.constraints import BulletConnections
from bridge_demolition_addon.bullet.layout import AWAKE, SYSTEM_V
from bridge_demolition_addon.bullet.memory import BYTES, DOUBLES, INTEGERS, write_vectors
from bridge_demolition_addon.bullet.tick import Tick
from bridge_demolition_addon.engineering.drilled_charges.cages import Cages
from bridge_demolition_addon.engineering.elasticity.substep import Places

SIZE = 4096
"""Bytes of each body and spring."""


class OwnMemory:
    """Bodies (n,) that are awake, and springs (m,) of which all six rows are held, in memory of our own."""

    def __init__(self, positions_m, inverse_masses, springs):
        body, count = SYSTEM_V.body, len(inverse_masses)
        self.memory = np.zeros((count + springs) * SIZE // 8)
        addresses = self.memory.ctypes.data + SIZE * np.arange(count + springs, dtype=np.uint64)
        self.bodies, self.springs = addresses[:count].copy(), addresses[count:].copy()
        INTEGERS.write(self.bodies + np.uint64(body.activation), AWAKE)
        self.put("inverse_mass", inverse_masses)
        for axis in range(3):
            self.put("transform", 1.0, 40 * axis)
            self.put("inverse_inertia", inverse_masses, 40 * axis)
        self.put_vectors("transform", positions_m.T, 96)
        BYTES.write(self.springs + np.uint64(SYSTEM_V.constraint.enabled), 1)
        self.core_bodies = BulletBodies.of(body, self.bodies)
        self.connections = BulletConnections(
            count=springs,
            enabled=SYSTEM_V.constraint.enabled,
            applied_impulse=SYSTEM_V.constraint.applied_impulse,
        )
        self.connections.take(
            addresses=(self.springs, springs),
            exists=(np.ones(springs, bool), springs),
            cracked=(np.zeros(springs, bool), springs),
            feedback=(np.zeros((springs, 16)), 16 * springs),
        )
        held = np.ones((6, springs), bool)
        self.rows = BulletRows.of(SYSTEM_V.spring, self.springs, held, held.copy())

    def put(self, name, values, offset=0):
        DOUBLES.write(self.bodies + np.uint64(getattr(SYSTEM_V.body, name) + offset), values)

    def put_vectors(self, name, vectors, offset=0):
        write_vectors(self.bodies + np.uint64(getattr(SYSTEM_V.body, name) + offset), vectors)

    def vectors(self, name):
        """Vectors (3, n) of bodies."""
        fields = self.bodies + np.uint64(getattr(SYSTEM_V.body, name))
        return DOUBLES.gather(fields + np.uint64(8) * np.arange(3, dtype=np.uint64)[:, None])

    def limits(self, offsets):
        """Limits (6, m) of springs."""
        return DOUBLES.gather(np.array(offsets, np.uint64)[:, None] + self.springs)


def elastic_tick(own, structure, substep_s, given=lambda array: array):
    """Return a sub-step of an elastic structure, and its arrays; each is `given` as it is, or as something else."""
    bodies, count = own.core_bodies.count, own.connections.count
    motion, alone, cages = BodyMotion.room_for(bodies), np.empty((6, bodies)), Cages(count)
    tick = Tick()
    tick.substep_s, tick.is_current = substep_s, 1
    structure.begin_substep(substep_s)
    structure.choose(np.ones(count, bool), np.zeros(bodies, bool))
    structure.stand(Places.of(motion.position_components_m, motion.rotation_components), alone)
    softness = Softness(softest=0.5, free_from=2.0, flags=1, frame_a=80, frame_b=240)
    tick.refer(bodies=own.core_bodies, connections=own.connections, rows=own.rows, softness=softness)
    tick.refer(solved=structure.solved, bars=cages.core)
    tick.keep("cages", cages)
    arrays = {
        "times": np.full(bodies, substep_s),
        "soft": np.ones((6, count)),
        "motion": motion.components,
        "alone": alone,
        "asleep": motion.asleep,
        "awake": np.empty(structure.awake.size, bool),
        "left": np.ones((6, bodies)),
        "holds": np.empty(0, bool),
        "chosen": np.ones(count, bool),
        "on_first": np.arange(count) % 2 == 0,
        "intact": np.empty(count, bool),
        "loads": np.zeros((6, count)),
        "whole": np.ones(count, bool),
        "strength": np.ones(count),
        "failed": np.empty(0, bool),
        "sides": 2 * np.arange(count),
        "components": np.empty((19, bodies)),
        "taken": np.empty((6, count)),
        "impulses": np.empty(count),
        "left_intact": np.empty(count, bool),
        "numbers": np.arange(count),
        "stored": np.empty(count),
        "states": np.empty((8, 0)),
    }
    sizes = {name: array.size for name, array in arrays.items()}
    arrays = {name: given(array) for name, array in arrays.items()}
    for name, array in arrays.items():
        tick.point(name, array, sizes[name])
    tick.count = count
    return tick, arrays
