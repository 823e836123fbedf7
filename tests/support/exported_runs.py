# SPDX-License-Identifier: GPL-3.0-or-later
"""A run of turning bodies, in single precision as runs are recorded, and where its corners are by plain sums."""

from dataclasses import replace

import numpy as np
from support.run_folders import flying_shards, keep_run

from bridge_demolition_addon.model.results.frames import BallHistory

SMALLEST_M = 1e-6
"""What places of a run may differ by in another program."""


def turning_run(count=5, frames=12):
    """Shards that fly, each turning about an axis of its own, a ball, and ground of two triangles that never moves."""
    results = flying_shards(count, frames)
    random = np.random.default_rng(7)
    axes = random.normal(size=(count + 1, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    angles = np.linspace(0.0, 5.0, frames)[:, None] * random.uniform(-1.0, 1.0, count + 1)
    turns = _turned(axes, angles)
    turns[:, -1] = np.eye(3)
    kept = results.frames
    moved = replace(
        kept,
        positions_m=kept.positions_m.astype(np.float32),
        rotations=turns.astype(np.float32),
        velocities_m_s=kept.velocities_m_s.astype(np.float32),
    )
    points = random.uniform(-1.0, 1.0, results.inventory.points_m.shape)
    return replace(results, frames=moved, inventory=replace(results.inventory, points_m=points))


def with_ground(results):
    """The same, with its last body turned into ground: a surface of four corners, of which one stands higher."""
    inventory = results.inventory
    corners = np.array([(-40.0, -30.0, 0.0), (50.0, -30.0, 0.0), (50.0, 35.0, 2.0), (-40.0, 35.0, 0.0)])
    kinds, masses = inventory.body_kinds.astype(object), inventory.masses_kg.copy()
    kinds[-1], masses[-1] = "ground", 0.0
    counts = inventory.vertex_counts.copy()
    vertices = np.vstack([inventory.vertices_m[: -counts[-1]], corners])
    counts[-1] = len(corners)
    triangle_counts = np.zeros_like(counts)
    triangle_counts[-1] = 2
    changed = replace(
        inventory,
        triangles=np.array([(0, 1, 2), (0, 2, 3)]),
        triangle_counts=triangle_counts,
        body_kinds=kinds.astype(str),
        masses_kg=masses,
        vertices_m=vertices,
        vertex_counts=counts,
    )
    return replace(results, inventory=changed, balls=BallHistory.unknown())


def kept_turning_run(folder):
    """The folder of such a run, and what was recorded."""
    results = turning_run()
    return keep_run(folder, results), results


def corners_m(results, row, body):
    """Where the corners of a body are in a recorded frame, (v, 3) m: turned, then moved."""
    frames = results.frames
    own = results.inventory.vertices_by_body()[body]
    return np.array(
        [[sum(frames.rotations[row, body, i, j] * float(v[j]) for j in range(3)) for i in range(3)] for v in own]
    ) + frames.positions_m[row, body].astype(float)


def in_order(points):
    """Points (v, 3) in an order that does not depend on how they came."""
    rounded = np.round(points, 3)
    return points[np.lexsort(rounded.T)]


def _turned(axes, angles):
    """Rotation matrices (k, n, 3, 3) about unit axes (n, 3) by angles (k, n), by Rodrigues' formula."""
    cross = np.zeros((len(axes), 3, 3))
    cross[:, 2, 1], cross[:, 0, 2], cross[:, 1, 0] = axes.T
    cross -= cross.transpose(0, 2, 1)
    sines, cosines = np.sin(angles)[..., None, None], np.cos(angles)[..., None, None]
    return np.eye(3) + sines * cross + (1.0 - cosines) * (cross @ cross)
