# SPDX-License-Identifier: GPL-3.0-or-later
"""Bullet's bodies, connections and contacts, read by numpy field by field: what the compiled core does in one pass."""

from __future__ import annotations

import numpy as np

from bridge_demolition_addon.bullet.layout import SLEEPING, Layout
from bridge_demolition_addon.bullet.memory import BYTES, DOUBLES, INTEGERS, POINTERS, copy_pointers

VECTOR = 8 * np.arange(3)
MATRIX = (32 * np.arange(3)[:, None] + VECTOR).ravel()


def fields(addresses: np.ndarray, *offsets: np.ndarray | int) -> np.ndarray:
    """Doubles (c, n) at offsets (c,) in bytes of structures (n,)."""
    return DOUBLES.gather(np.hstack(offsets).astype(np.uint64)[:, None] + addresses)


def components(layout: Layout, bodies: np.ndarray) -> np.ndarray:
    """Rotations, positions, velocities and angular velocities (18, n)."""
    body = layout.body
    turns = body.transform + MATRIX, body.transform + 96 + VECTOR
    return fields(bodies, *turns, body.linear_velocity + VECTOR, body.angular_velocity + VECTOR)


def motion(layout: Layout, bodies: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Components (34, n) of the motion before a sub-step, and whether each body (n,) is asleep."""
    body = layout.body
    loads = body.total_force + VECTOR, body.total_torque + VECTOR, body.inverse_mass, body.inverse_inertia + MATRIX
    states = INTEGERS.gather(bodies + np.uint64(body.activation))
    return np.vstack((components(layout, bodies), fields(bodies, *loads))), np.isin(states, list(SLEEPING))


def connections(
    layout: Layout, addresses: np.ndarray, cracked: np.ndarray, feedback: np.ndarray, sides: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Loads (6, k) on sides (k,), impulses (m,), and whether each connection (m,), at 0 where there is none, holds."""
    exists, constraint = addresses != 0, layout.constraint
    impulses, enabled = np.zeros(len(addresses)), np.zeros(len(addresses), bool)
    impulses[exists] = fields(addresses[exists], constraint.applied_impulse)[0]
    enabled[exists] = BYTES.gather(addresses[exists] + np.uint64(constraint.enabled)) != 0
    loads = feedback.reshape(-1, 8)[sides][:, [0, 1, 2, 4, 5, 6]].T
    return loads, impulses, enabled & ~cracked


def contact_points(layout: Layout, dispatcher: int) -> tuple[np.ndarray, np.ndarray]:
    """Components (15, k) of contact points that carry a load, and addresses (2, k) of their bodies."""
    listed, manifold, point = layout.dispatcher, layout.manifold, layout.manifold.point
    count = INTEGERS.one(dispatcher + listed.manifold_count)
    manifolds = copy_pointers(POINTERS.one(dispatcher + listed.manifold_data), count)
    counts = INTEGERS.gather(manifolds + np.uint64(manifold.count))
    rows = np.repeat(np.arange(count), counts)
    number = np.arange(len(rows)) - np.repeat(np.cumsum(counts) - counts, counts)
    points = manifolds[rows] + np.uint64(manifold.points) + number.astype(np.uint64) * np.uint64(point.size)
    impulses = point.normal_impulse, point.lateral_impulses + 8 * np.arange(2)
    lateral = point.lateral_directions + VECTOR, point.lateral_directions + 32 + VECTOR
    values = fields(points, point.position_on_b + VECTOR, point.normal + VECTOR, *impulses, *lateral)
    loaded = (values[6:9] != 0.0).any(axis=0)
    bodies = [POINTERS.gather(manifolds + np.uint64(side))[rows] for side in (manifold.body_a, manifold.body_b)]
    return values[:, loaded], np.array(bodies)[:, loaded]


def spins_after(layout: Layout, bodies: np.ndarray, times_s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Angular velocities (3, n) that torques make in times (n,), and which bodies (n,) they turn."""
    values, asleep = motion(layout, bodies)
    torques, inverse = values[21:24], values[25:].reshape(3, 3, -1)
    turns = torques.any(axis=0) & ~asleep & np.isfinite(times_s)
    times_s = np.where(turns, times_s, 0.0)
    changes = inverse[:, 0] * torques[0] + inverse[:, 1] * torques[1] + inverse[:, 2] * torques[2]
    return np.where(turns, values[15:18] + times_s * changes, values[15:18]), turns
