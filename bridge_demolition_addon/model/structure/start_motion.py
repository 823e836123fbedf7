"""Velocities and angular velocities with which shards begin, as parts of a member that moves as one body."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...engineering.geometry.vectors import cross
from ..scenario import Geometry
from .model import Model


def start_motions(tables: Sequence[Geometry], model: Model) -> tuple[np.ndarray, np.ndarray]:
    """Return velocities (n, 3), m/s, and angular velocities (n, 3), rad/s, of the shards of a model as it begins.

    Of members in several files, the first says how they move, as one body. Shards that are held do not.
    """
    velocities, angular_velocities = np.zeros((2, len(model.shards), 3))
    names = np.array([member.name for member in model.members])[model.member_of_shard]
    first_of_each = {table.name: table for table in reversed(tables)}
    for table in (each for each in first_of_each.values() if each.is_moving):
        shards = np.flatnonzero(names == table.name)
        masses, centres = model.masses_kg[shards, None], model.centres_m[shards]
        angular_velocities[shards] = table.spin_rad_s
        arms = centres - (masses * centres).sum(axis=0) / masses.sum()
        velocities[shards] = np.array(table.velocity_m_s) + cross(angular_velocities[shards], arms)
    velocities[model.fixed], angular_velocities[model.fixed] = 0.0, 0.0
    return velocities, angular_velocities
