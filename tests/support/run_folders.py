# SPDX-License-Identifier: GPL-3.0-or-later
"""Folders of runs as `bda run` leaves them, made from given results in no time."""

import json
from dataclasses import replace

import numpy as np
from support.moving_boxes import moving_boxes
from support.scenarios import I235

from bridge_demolition_addon.model.results.frames import BallHistory
from bridge_demolition_addon.model.results.stream import FrameStream
from bridge_demolition_addon.model.results.summary import summarise
from bridge_demolition_addon.model.scenario import BlastSettings, Charge, Exclusion, Neighbour, Site, Zone
from bridge_demolition_addon.model.scenario.file import scenario_text

G = 9.80665

TOLD = replace(
    I235,
    title='Bridge <b>& $5$ "Co"</b>',
    zones=(
        Zone(name="Road <1> $2$", kind="road", corners_m=((-5, 4.7), (20, 4.7), (20, 9), (-5, 9))),
        Zone(name="Far away", kind="building", corners_m=((90, 0), (95, 0), (95, 5))),
    ),
    exclusion=Exclusion(buffer_m=5, designed_drop_m=1),
    site=Site(latitude_deg=41.6, longitude_deg=-93.6),
    blast=BlastSettings(start_s=0.2),
    charges=(
        Charge(position_m=(0, 0, 1), mass_kg=5, explosive="C-4"),
        Charge(position_m=(13, 0, 1), mass_kg=2, delay_ms=25),
    ),
    neighbours=(
        Neighbour(name="House", position_m=(40, 30, 2)),
        Neighbour(name="School & yard", position_m=(-60, 10, 2)),
    ),
)
"""A scenario with everything that a report tells of, and names that want escaping."""


def flying_shards(count=30, frames=25, frame_s=1 / 24):
    """Shards of a deck that fall and fly to all sides, half of their connections until the tenth frame; and a ball."""
    random = np.random.default_rng(1)
    times = frame_s * np.arange(frames)
    sizes = random.uniform(0.4, 1.2, (count + 1, 3))
    sizes[-1] = 1.3
    first = np.column_stack([random.uniform(0, 13, count), random.uniform(-4, 4, count), np.full(count, 5.4)])
    first = np.vstack([first, [[6.5, 0.0, 8.0]]])
    velocities = np.column_stack([random.normal(0, 2, (count + 1, 2)), np.zeros(count + 1)])
    positions = first + times[:, None, None] * velocities
    positions[:, :, 2] = np.maximum(first[:, 2] - G / 2 * times[:, None] ** 2, sizes[:, 2] / 2)
    speeds = np.broadcast_to(velocities, positions.shape).copy()
    speeds[:, :, 2] = np.where(positions[:, :, 2] > sizes[:, 2] / 2, -G * times[:, None], 0.0)
    speeds[12:, count] = 0.0  # of the ball, once it has hit
    pairs = np.column_stack([np.arange(count - 1), np.arange(1, count)])
    connections = len(pairs)
    intact = np.ones((frames, connections), bool)
    intact[10:, ::2] = False
    loads = random.uniform(1e3, 1e6, (frames, count + 1))
    return moving_boxes(
        times,
        sizes,
        positions,
        kinds=["shard"] * count + ["ball"],
        velocities_m_s=speeds,
        body_names=np.array([f"Shard {row:05d}" for row in range(count)] + ["Wrecking ball"]),
        body_members=np.array(["deck"] * (count - 4) + ["pier 1"] * 4 + [""]),
        body_member_kinds=np.array(["deck"] * (count - 4) + ["pier"] * 4 + [""]),
        body_sums_n=loads,
        body_peaks_n=loads / 3,
        body_peak_sums_n=loads,
        body_contact_impulses_ns=random.normal(0, 1e4, (frames, count + 1, 3)),
        von_mises_pa=loads * 10,
        connection_names=np.array([f"Connection.{row:03d}" for row in range(connections)]),
        pairs=pairs,
        points_m=np.zeros((connections, 3)),
        areas_m2=np.full(connections, 0.2),
        normals=np.tile([1.0, 0.0, 0.0], (connections, 1)),
        second_moments_m4=np.zeros((connections, 2, 2)),
        connection_forces_n=np.zeros((frames, connections, 3)),
        connection_moments_nm=np.zeros((frames, connections, 3)),
        connection_peaks_n=random.uniform(0, 1e5, (frames, connections)),
        connection_peak_forces_n=np.zeros((frames, connections, 3)),
        connection_peak_moments_nm=np.zeros((frames, connections, 3)),
        intact=intact,
        balls=np.array([count]),
        ball_times_s=times[1:],
        ball_impulses_ns=np.where((np.arange(1, frames) == 12)[:, None, None], (0.0, 0.0, 5e4), 0.0),
        ball_velocities_m_s=speeds[1:, [count]],
    )


def keep_run(folder, results, scenario=TOLD, *, completed=True):
    """A run's folder with results, summary and scenario; the scenario may be None."""
    folder.mkdir(parents=True)
    results.save(folder / "results.npz")
    summary = {"title": scenario.title if scenario else "By hand", "completed": completed, "blender": "5.2"}
    summary |= summarise(results, np.array([0.0, 0.0, -G]))
    (folder / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
    if scenario:
        (folder / "scenario_as_run.toml").write_text(scenario_text(scenario), encoding="utf-8")
    return folder


def stream_run(folder, results, frames=None):
    """The stream of a run that goes on or was killed, with as many of the frames of these results."""
    contacts = results.contacts
    stream = FrameStream(folder, results.load_sampling, results.inventory, contacts=contacts is not None)
    times, balls = results.frames.time_s, results.balls
    for row in range(len(times) if frames is None else frames):
        first, last = np.searchsorted(balls.times_s, [times[max(row - 1, 0)], times[row]], side="right")
        substeps = (values[first:last] for values in (balls.times_s, balls.impulses_ns, balls.velocities_m_s))
        frame = results.frames[row]
        touching = contacts.of_frame(frame.number) if contacts else None
        stream.append(frame, BallHistory(balls.bodies, *substeps), touching)
    return stream


def killed_run(folder, last_lines=()):
    """The folder of a run that was killed: its logs, with more lines at the end of the force log."""
    folder.mkdir()
    header = "frame,time_s,body,force_x_N,peak_force_N,peak_force_sum_N"
    lines = [
        f"{2 + k},{0.5 * k},{body},1,{10 * k},{30 * k}" for k in range(3) for body in ("Ground", "Shard 0", "Shard 1")
    ]
    (folder / "force_log.csv").write_text("\n".join([header, *lines, *last_lines]), encoding="utf-8")
    (folder / "breaking_log.csv").write_text("frame,time_s,connection\n3,0.5,A\n3,0.5,B\n", encoding="utf-8")
    return folder
