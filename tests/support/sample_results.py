# SPDX-License-Identifier: GPL-3.0-or-later
"""A small recording whose every number can be checked by hand."""

from dataclasses import replace

import numpy as np

from bridge_demolition_addon.engineering.mechanics.frame_loads import FrameLoads, LoadAccumulator, SubstepLoads
from bridge_demolition_addon.engineering.mechanics.work import FrameWork
from bridge_demolition_addon.model.results.arrays import Results
from bridge_demolition_addon.model.results.frames import BallHistory, ContactHistory, Frame, FrameSeries, Inventory

G = 9.80665
GRAVITY = np.array([0.0, 0.0, -G])
FRAME_S = 0.04
SUBSTEPS = 10
SUBSTEP_S = FRAME_S / SUBSTEPS

PAIRS = np.array([[1, 0], [1, 2]])
POINTS = np.array([[0.0, 0.0, 20.0], [0.0, 0.0, 16.0]])
NORMALS = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]])
CENTRES = np.array([[0.0, 0.0, 21.0], [0.0, 0.0, 18.0], [0.0, 0.0, 14.0], [5.0, 0.0, 22.5]])
CUBE = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
SIZES_M = np.array([[20.0, 20.0, 2.0], [1.0, 1.0, 4.0], [0.5**0.5, 0.5**0.5, 4.0], [0.5, 0.5, 0.5]])
VOLUMES_M3 = np.array([0.0, 4.0, 2.0, 0.125])
BALL_POINT = np.array([5.0, 0.0, 22.0])


def hanging_chain() -> Results:
    """Shard *upper* (300 kg) hangs from the ground, a ledge; shard *lower* (200 kg) hangs from it; a ball drops above.

    The shards are 4 m high, with square sections of 1 m² and 0.5 m². Five frames, 2 to 6; in frame 2 no time passes.
    The ball is let go in frame 3 and falls freely for 2.5 frames, up to a speed of 2.5 g Δt. In the second half of
    frame 6 the ledge stops it with a steady force: its 1000 kg by 5 g, and by one more g against gravity. In the second
    half of frame 5 a pull of 1 kN along x between the shards is added; then they come apart, and by frame 6 *lower* has
    moved by (3, 4, -12) m.
    """
    times = FRAME_S * np.arange(5)
    intact = np.ones((5, 2), bool)
    intact[4, 1] = False
    positions = np.tile(CENTRES, (5, 1, 1))
    positions[4, 2] += (3.0, 4.0, -12.0)
    velocities = np.zeros((5, 4, 3))
    velocities[2:4, 3] = np.array([[1.0], [2.0]]) * FRAME_S * GRAVITY
    asleep = np.zeros((5, 4), bool)
    asleep[:3, 1:3] = True
    ball_times = SUBSTEP_S * np.arange(1, 4 * SUBSTEPS + 1)
    fall_s = np.interp(ball_times, FRAME_S * np.array([0.0, 1.0, 3.5, 4.0]), FRAME_S * np.array([0.0, 0.0, 2.5, 0.0]))
    inventory = Inventory(
        body_names=np.array(["Ground", "upper", "lower", "Wrecking ball"]),
        body_kinds=np.array(["ground", "shard", "shard", "ball"]),
        masses_kg=np.array([0.0, 300.0, 200.0, 1000.0]),
        volumes_m3=VOLUMES_M3,
        body_members=np.array(["", "upper column", "lower column", ""]),
        body_member_kinds=np.array(["", "pier", "pier", ""]),
        vertices_m=np.concatenate([size / 2.0 * CUBE for size in SIZES_M]),
        vertex_counts=np.full(4, 8),
        connection_names=np.array(["Connection", "Connection.001"]),
        pairs=PAIRS,
        points_m=POINTS,
        areas_m2=np.array([1.0, 0.5]),
        normals=NORMALS,
        second_moments_m4=np.array([1.0, 0.25])[:, None, None] * np.eye(2) / 12.0,
    )
    frames = [
        Frame(
            number=2 + step,
            time_s=times[step],
            substep_s=SUBSTEP_S if step else 0.0,
            positions_m=positions[step],
            rotations=np.tile(np.eye(3), (4, 1, 1)),
            velocities_m_s=velocities[step],
            angular_velocities_rad_s=np.zeros((4, 3)),
            asleep=asleep[step],
            intact=intact[step],
            blast_impulses_ns=np.zeros((4, 3)),
            loads=loads,
            work=_work(step),
        )
        for step, loads in enumerate(_loads(connections=2))
    ]
    balls = BallHistory(
        bodies=np.array([3]),
        times_s=ball_times,
        impulses_ns=SUBSTEP_S * _contact_forces()[1:].reshape(-1, 1, 3),
        velocities_m_s=(fall_s[:, None] * GRAVITY)[:, None],
    )
    return Results("every sub-step", inventory, FrameSeries.of(frames), balls)


def _work(step: int) -> FrameWork:
    """The solver makes 200 J in the last frame, three quarters of it for *lower*."""
    made = np.array([0.0, 50.0, 150.0, 0.0]) * (step == 4)
    return FrameWork(1000.0, 0.0, 0.0, 1.0, 500.0, 40.0, 10.0, made.sum(), 0.0, 0.0, made)


def with_contacts(results: Results) -> Results:
    """The same recording with contacts of its first two bodies: one in its second frame, three in its last."""
    numbers = results.frames.number[[1, -1, -1, -1]]
    contacts = ContactHistory(
        frames=numbers,
        bodies=np.array([[0, 1], [1, 0], [0, 1], [0, 1]]),
        places_m=np.arange(12.0).reshape(4, 3),
        normals=np.array([[0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]]),
        normal_impulses_ns=np.array([2.0, 3.0, 4.0, 0.5]),
        friction_impulses_ns=np.array([[1.5, 0.0, 0.0], [0.0, 4.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, 0.0]]),
    )
    return replace(results, contacts=contacts)


def changed(results: Results, **arrays: np.ndarray) -> Results:
    """The same recording with some arrays replaced, by their names in the file."""
    assert not set(arrays) - set(results.arrays())
    return Results.of_arrays(results.arrays() | arrays)


def without_connections(results: Results) -> Results:
    """The same recording as if there never had been a connection."""
    names = ("connection_names", "pairs", "points_m", "areas_m2", "normals", "second_moments_m4")
    arrays = results.arrays()
    loads = FrameSeries.of([replace(results.frames[step], loads=loads) for step, loads in enumerate(_loads(0))]).loads
    results = replace(results, frames=replace(results.frames, loads=loads))
    return changed(results, intact=arrays["intact"][:, :0], **{name: arrays[name][:0] for name in names})


def _connection_forces() -> np.ndarray:
    """Force on *upper* from ground and from *lower* in each frame and sub-step, (5, 10, 2, 3)."""
    forces = np.zeros((5, SUBSTEPS, 2, 3))
    forces[:4, :, 0, 2] = 500 * G
    forces[:4, :, 1, 2] = -200 * G
    forces[3, SUBSTEPS // 2 :, 1, 0] = 1000.0
    forces[4, :, 0, 2] = 300 * G
    return forces


def _contact_forces() -> np.ndarray:
    """Force on the ball from the ground in each frame and sub-step, (5, 10, 3)."""
    forces = np.zeros((5, SUBSTEPS, 3))
    forces[4, SUBSTEPS // 2 :, 2] = 6000 * G
    return forces


def _loads(connections: int) -> list[FrameLoads]:
    """Loads of all frames by the first so many connections and by the contact of the ball."""
    gathered, frames = LoadAccumulator(PAIRS[:connections], VOLUMES_M3, lambda _: NORMALS[:connections]), []
    for step, (of_connections, of_contact) in enumerate(zip(_connection_forces(), _contact_forces(), strict=True)):
        gathered.begin()
        for substep in range(SUBSTEPS if step else 0):
            forces = of_connections[substep, :connections]
            loads = SubstepLoads(
                substeps_s=np.array([SUBSTEP_S]),
                connection_forces_n=forces[None],
                connection_moments_nm=np.zeros((1, connections, 3)),
                connection_points_m=POINTS[None, :connections],
                signed_2019_ns=SUBSTEP_S * np.linalg.norm(forces[None], axis=-1),
                contact_substeps=np.zeros(1, int),
                contact_pairs=np.array([[3, 0]]),
                contact_impulses_ns=SUBSTEP_S * of_contact[substep, None],
                contact_points_m=BALL_POINT[None],
                centres_m=CENTRES[None],
                rotations=np.tile(np.eye(3), (1, 4, 1, 1)),
            )
            gathered.add(loads)
        frames.append(gathered.finish())
    return frames
