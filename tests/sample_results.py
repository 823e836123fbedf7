"""A small recording whose every number can be checked by hand."""

from dataclasses import replace

import numpy as np

from bridge_demolition_addon.core.results import Results

GRAVITY = np.array([0.0, 0.0, -9.80665])
FRAME_S = 0.04


def hanging_chain() -> Results:
    """Shard *upper* (300 kg) hangs from the ground's edge, shard *lower* (200 kg) from it; a ball stops in frame 6.

    Five frames, 2 to 6. The ball is let go in frame 3 and falls freely in 4 and 5. In frame 5 a pull of 1 kN along x
    between the shards is added; then they come apart, and by frame 6 *lower* has moved by (3, 4, -12) m.
    """
    frames = np.arange(2, 7)
    forces = np.zeros((5, 2, 3))
    forces[:, 0, 2] = 500 * 9.80665  # on upper, from the ground
    forces[:, 1, 2] = -200 * 9.80665  # on upper, from lower
    forces[3, 1, 0] = 1000.0
    forces[4] = ((0.0, 0.0, 300 * 9.80665), (0.0, 0.0, 0.0))
    intact = np.ones((5, 2), bool)
    intact[4, 1] = False
    places = np.zeros((5, 4, 3))
    places[:, :, 2] = (0.0, 10.0, 14.0, 20.0)
    places[4, 2] += (3.0, 4.0, -12.0)
    velocities = np.zeros((5, 4, 3))
    velocities[2:4, 3] = np.array([[1.0], [2.0]]) * FRAME_S * GRAVITY
    return Results(
        frames=frames,
        times_s=FRAME_S * np.arange(5),
        substep_s=np.array([0.0, *[FRAME_S / 10] * 4]),
        body_names=np.array(["Ground", "upper", "lower", "Wrecking ball"]),
        body_kinds=np.array(["ground", "shard", "shard", "ball"]),
        masses_kg=np.array([0.0, 300.0, 200.0, 1000.0]),
        places_m=places,
        rotations=np.broadcast_to(np.eye(3), (5, 4, 3, 3)).copy(),
        velocities_m_s=velocities,
        connection_names=np.array(["Connection", "Connection.001"]),
        pairs=np.array([[1, 0], [1, 2]]),
        connection_forces_n=forces,
        connection_moments_nm=np.zeros((5, 2, 3)),
        intact=intact,
    )


def without_connections(results: Results) -> Results:
    """The same recording as if there never had been a connection."""
    count = len(results.frames)
    return replace(
        results,
        connection_names=np.array([], str),
        pairs=np.zeros((0, 2), int),
        connection_forces_n=np.zeros((count, 0, 3)),
        connection_moments_nm=np.zeros((count, 0, 3)),
        intact=np.ones((count, 0), bool),
    )
