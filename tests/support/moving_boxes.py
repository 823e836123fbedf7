# SPDX-License-Identifier: GPL-3.0-or-later
"""Recordings of boxes whose motion is given, for what is worked out from motion alone."""

import numpy as np

from bridge_demolition_addon.model.results.arrays import Results

CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float) / 2.0


def turned_about_z(angles):
    """Rotation matrices (k, 3, 3) about the z axis."""
    matrices = np.zeros((len(angles), 3, 3))
    matrices[:, 0, 0] = matrices[:, 1, 1] = np.cos(angles)
    matrices[:, 1, 0] = np.sin(angles)
    matrices[:, 0, 1] = -matrices[:, 1, 0]
    matrices[:, 2, 2] = 1.0
    return matrices


def moving_boxes(
    times_s, sizes_m, places_m, *, rotations=None, kinds=None, masses_kg=None, velocities_m_s=None, **more
):
    """A recording of n boxes.

    Parameters
    ----------
    times_s
        (k,) times.
    sizes_m
        (n, 3) edges of the boxes.
    places_m
        (k, n, 3) their middles.
    rotations, kinds, masses_kg, velocities_m_s
        (k, n, 3, 3), (n,), (n,) and (k, n, 3); upright shards at rest of 1000 kg/m³ unless given.
    **more
        Other arrays of `Results`, by their names in the file.
    """
    times_s, sizes_m, places_m = np.array(times_s, float), np.array(sizes_m, float), np.array(places_m, float)
    steps, count = len(times_s), len(sizes_m)
    volumes = sizes_m.prod(axis=1)
    bodies, vectors = np.zeros((steps, count)), np.zeros((steps, count, 3))
    fields = {
        "reading": np.array("every sub-step"),
        "frames": np.arange(2, 2 + steps),
        "times_s": times_s,
        "substep_s": np.diff(times_s, prepend=times_s[0]) / 10.0,
        "body_names": np.array([f"Shard {row}" for row in range(count)]),
        "body_kinds": np.array(["shard"] * count if kinds is None else kinds),
        "masses_kg": 1000.0 * volumes if masses_kg is None else np.array(masses_kg, float),
        "volumes_m3": volumes,
        "body_members": np.array([""] * count),
        "body_member_kinds": np.array([""] * count),
        "vertices_m": (sizes_m[:, None] * CORNERS).reshape(-1, 3),
        "vertex_counts": np.full(count, len(CORNERS)),
        "places_m": places_m,
        "rotations": np.broadcast_to(np.eye(3), (steps, count, 3, 3)) if rotations is None else np.array(rotations),
        "velocities_m_s": vectors if velocities_m_s is None else np.array(velocities_m_s, float),
        "spins_rad_s": vectors,
        "asleep": np.zeros((steps, count), bool),
        "body_forces_n": vectors,
        "body_peaks_n": bodies,
        "body_sums_n": bodies,
        "body_peak_sums_n": bodies,
        "body_contact_impulses_ns": vectors,
        "body_signed_2019_n": bodies,
        "blast_impulses_ns": vectors,
        "stresses_pa": np.zeros((steps, count, 3, 3)),
        "von_mises_pa": bodies,
        "connection_names": np.zeros(0, str),
        "pairs": np.zeros((0, 2), int),
        "points_m": np.zeros((0, 3)),
        "areas_m2": np.zeros(0),
        "normals": np.zeros((0, 3)),
        "second_moments_m4": np.zeros((0, 2, 2)),
        "connection_forces_n": np.zeros((steps, 0, 3)),
        "connection_moments_nm": np.zeros((steps, 0, 3)),
        "connection_peaks_n": np.zeros((steps, 0)),
        "connection_peak_forces_n": np.zeros((steps, 0, 3)),
        "connection_peak_moments_nm": np.zeros((steps, 0, 3)),
        "intact": np.zeros((steps, 0), bool),
        "balls": np.zeros(0, int),
        "ball_times_s": np.zeros(0),
        "ball_impulses_ns": np.zeros((0, 0, 3)),
        "ball_velocities_m_s": np.zeros((0, 0, 3)),
    }
    return Results.of_arrays(fields | more)
