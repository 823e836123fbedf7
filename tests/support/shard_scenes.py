# SPDX-License-Identifier: GPL-3.0-or-later
"""Solids in shards that are held together by area, for tests of stress and strength."""

from __future__ import annotations

import bpy
import numpy as np

from bridge_demolition_addon.engineering.fracture.shards import fracture
from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.engineering.mechanics.strength import Joint
from bridge_demolition_addon.engineering.structure.connections import connect, neighbours_by_face, second_moments
from bridge_demolition_addon.model.scenario import ShardSettings, SurfaceValues, TimeSettings
from bridge_demolition_addon.scene.bodies import create_shards
from bridge_demolition_addon.scene.connections.constraints import (
    Breaking,
    create_connections,
    keep_breaking,
    set_joints,
)
from bridge_demolition_addon.scene.world import create_world, off_scene

DENSITY_KG_M3 = 2400.0
LAST_FRAME = 2000


class ShardScene:
    """A block in shards with fixed connections at all shared faces, awake, in an empty scene.

    Parameters
    ----------
    size_m, centre_m
        The block.
    shard_count
        How many shards.
    time
        Sub-steps and iterations.
    breaking
        How the connections break; never, by default.
    breaking_force_newton
        The one force of the way of 2019 instead.
    """

    def __init__(self, size_m, centre_m, shard_count, time: dict, breaking=None, breaking_force_newton=None):
        self.scene = bpy.context.scene
        settings = TimeSettings(duration_s=1.0, **time)
        create_world(self.scene, settings, LAST_FRAME)
        self.fracture = fracture(box(size_m, centre_m), shard_count, seed=1)
        faces = self.fracture.faces
        connections = connect(self.fracture.centres, faces, *neighbours_by_face(faces), limit_per_shard=1000)
        moments = second_moments(
            self.fracture.shards, connections.pairs[:, 0], connections.areas, connections.points, connections.normals
        )
        awake = ShardSettings(use_deactivation=False, start_deactivated=False)
        keep_breaking(self.scene, breaking or Breaking())
        masses = DENSITY_KG_M3 * self.fracture.volumes
        with off_scene(self.scene) as (bodies, constraints):
            parts = (self.fracture.shards, self.fracture.centres, masses)
            self.shards = create_shards(bodies, awake, SurfaceValues(0.6, 0.0), *parts)
            made = create_connections(constraints, connections, self.shards, None, moments)
            joint = Joint("FIXED", breaking_force_n=breaking_force_newton)
            set_joints(made, [joint], np.zeros(len(made), int), settings.step)

    def hold(self, is_held: np.ndarray) -> None:
        """Fix some of the shards (n,) in space."""
        for shard, held in zip(self.shards, is_held, strict=True):
            if held:
                shard.rigid_body.type = "PASSIVE"
