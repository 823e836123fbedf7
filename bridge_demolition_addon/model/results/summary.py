"""The main numbers of a run for a planner, and the moment that shows most in one picture."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict
from typing import Any, overload

import numpy as np

from ...engineering.arithmetic import cube_root
from ...engineering.geometry.vectors import dot, length
from ...engineering.mechanics.impact import CONCRETE, STEEL, Contact, Hit, estimate, hits
from ...texts import Text
from .arrays import Results
from .collapse import ConnectionCounts
from .energy import energy_summary
from .motion import first_hit, relative_to_ground, throw, without_removed
from .moving import creep_summary, moving_summary
from .records import Creeping, HitOfRun, LargestThrow, MomentOfRun, StillMoving

_FLYING_S = 0.5
"""How long after the last load of a blast: what falls has come down by 1.2 m, what flies is not yet out of sight."""

RESTING_WEIGHTS = 3.0
"""A ball that rests or rolls is pressed with about its weight; a hit presses with more than this many times as much."""


def key_step(results: Results, gravity_m_s2: np.ndarray) -> tuple[int, str]:
    """Return the recorded step that shows most, and which moment it is, with the acceleration of gravity (3,).

    It is the impact of the ball; without one, shortly after the blast; without that, when half of the connections that
    broke in the run had broken; where none did, the step of the largest force on a shard.
    """
    frames = results.frames
    impact = impact_step(results, gravity_m_s2)
    if impact is not None:
        return impact, Text("At the impact of the ball")
    loaded = np.flatnonzero(frames.blast_impulses_ns.any(axis=(1, 2)))
    if len(loaded):
        after = np.searchsorted(frames.time_s, frames.time_s[loaded[-1]] + _FLYING_S)
        return min(int(after), len(frames.time_s) - 1), Text("Shortly after the blast")
    broken = (~frames.intact).sum(axis=1)
    if len(broken) and broken[-1]:
        half = int(np.argmax(broken >= broken[-1] / 2.0))
        return half, Text("When half of the connections that broke had broken")
    forces = frames.loads.body_peak_sums_n[:, results.inventory.of_kind("shard")]
    largest = np.where(np.isfinite(forces), forces, 0.0).max(axis=1, initial=0.0)
    return int(largest.argmax()), Text("At the largest force")


def impact_step(results: Results, gravity_m_s2: np.ndarray) -> int | None:
    """Return the recorded step in which the ball, once it falls, is first stopped; None where it never is."""
    for ball in results.inventory.of_kind("ball"):
        moving = np.flatnonzero(results.frames.velocities_m_s[:, ball].any(axis=1))
        if len(moving):
            if len(results.inventory.of_kind("crane")):
                return _first_push(results, ball, gravity_m_s2)
            released = max(0, moving[0] - 1)  # a ball that falls a few centimetres is hit in its very first step
            hit = first_hit(
                results.frames.velocities_m_s[released:, ball], results.frames.time_s[released:], gravity_m_s2
            )
            return None if hit is None else int(released) + hit
    return None


def _first_push(results: Results, ball: int, gravity_m_s2: np.ndarray) -> int | None:
    """Return the first recorded step in which contacts push a ball on a cable more than its rest would."""
    resting_force = RESTING_WEIGHTS * results.inventory.masses_kg[ball] * length(gravity_m_s2)
    pushes = length(results.frames.loads.body_contact_impulses_ns[:, ball])
    steps = np.flatnonzero(pushes > resting_force * np.diff(results.frames.time_s, prepend=results.frames.time_s[0]))
    return int(steps[0]) if len(steps) else None


def summarise(results: Results, gravity_m_s2: np.ndarray, contact_time_s: float | None = None) -> dict[str, Any]:
    """Return masses, counts, breaking over time, largest force and largest throw of a run, ready for JSON.

    Gravity is a vector (3,), m/s². Hits of the ball last `contact_time_s`; by default as long as elastic ones.
    """
    left, _ = without_removed(results)
    key, reason = key_step(results, gravity_m_s2)
    return {
        "frames": len(results.frames),
        "simulated_s": float(results.frames.time_s[-1]),
        "mass_kg": {
            kind: float(results.inventory.masses_kg[results.inventory.of_kind(kind)].sum())
            for kind in ("shard", "ball")
        },
        "bodies": {kind: len(results.inventory.of_kind(kind)) for kind in ("shard", "ball", "ground")},
        "connections": _connections(results),
        "impact": impact_of(results, gravity_m_s2),
        "key_frame": {**_moment(results, key), "reason": reason},
        "reading": results.load_sampling,
        "hits_of_the_ball": hits_of_balls(results, gravity_m_s2, contact_time_s),
        "largest_resultant": _largest_force(left, left.frames.loads.body_peaks_n),
        "largest_force_sum": _largest_force(left, left.frames.loads.body_peak_sums_n),
        "largest_throw": _json(largest_throw(left)),
        "energy": energy_summary(left),
        "creeping": _json(creep_summary(left)),
        "moving_at_end": _json(moving_summary(left)),
        "blast": _blast(results),
    }


def _json(record: LargestThrow | Creeping | StillMoving | None) -> dict[str, Any] | None:
    return asdict(record, dict_factory=_as_read) if record else None


def _as_read(pairs: Iterable[tuple[str, Any]]) -> dict[str, Any]:
    """Return a table as it is read from JSON, which knows lists alone."""
    return {name: list(value) if isinstance(value, tuple) else value for name, value in pairs}


def first_hit_s(impact: MomentOfRun | None, hits: Iterable[HitOfRun]) -> float | None:
    """Return when the falling ball first hit, by its impact: by its hits if recorded, or else to a frame.

    Contacts of the ball while it is still held are no hits.
    """
    if not impact:
        return None
    return float(max((hit.time_s for hit in hits if hit.time_s < impact.time_s), default=impact.time_s))


def settling(results: Results, warm_up_s: float) -> dict[str, float] | None:
    """Return when the warm-up ended, and the largest speed of a shard then; None without one, or before its end."""
    after = np.flatnonzero(results.frames.time_s >= warm_up_s - 1e-6 * max(warm_up_s, 1.0))
    if not warm_up_s or not len(after):
        return None
    speeds = length(relative_to_ground(results).frames.velocities_m_s[after[0], results.inventory.of_kind("shard")])
    return {"time_s": float(results.frames.time_s[after[0]]), "largest_speed_m_s": float(speeds.max(initial=0.0))}


def impact_of(results: Results, gravity_m_s2: np.ndarray) -> dict[str, Any] | None:
    """Return frame and time in which the ball first hit, ready for JSON; None where it did not."""
    return _moment(results, impact_step(results, gravity_m_s2))


def hits_of_balls(
    results: Results, gravity_m_s2: np.ndarray, contact_time_s: float | None = None
) -> list[dict[str, Any]]:
    """Return all hits of balls: impulse, the raw force with the step that it depends on, and estimates that do not.

    Parameters as in `summarise`.
    """
    steps = np.diff(results.balls.times_s, prepend=results.frames.time_s[0])
    all_hits = []
    for column, ball in enumerate(results.balls.bodies):
        mass = results.inventory.masses_kg[ball]
        radius = float(cube_root(0.75 / np.pi * results.inventory.volumes_m3[ball]))
        contact = Contact.between(STEEL, CONCRETE, mass, radius)
        resting_force = RESTING_WEIGHTS * mass * length(gravity_m_s2)
        velocities = results.balls.velocities_m_s[:, column]
        for hit in hits(results.balls.impulses_ns[:, column], steps, results.frames.time_s[0], resting_force):
            before = velocities[hit.first_step - 1] if hit.first_step else np.zeros(3)
            speed = -float(dot(before, hit.impulse_ns)) / hit.impulse_magnitude_ns
            all_hits.append(
                {
                    "ball": str(results.inventory.body_names[ball]),
                    "time_s": hit.start_s,
                    "lasted_s": hit.end_s - hit.start_s,
                    "impulse_Ns": hit.impulse_magnitude_ns,
                    "approach_m_s": speed,
                    "raw_peak_force_N": hit.raw_peak_force_n,
                    "raw_step_s": hit.raw_step_s,
                    **_estimated_forces(hit, speed, contact, contact_time_s),
                }
            )
    return all_hits


def _estimated_forces(hit: Hit, speed: float, contact: Contact, contact_time_s: float | None) -> dict[str, float]:
    """Return forces that do not depend on the step; none for a ball that was hit from behind."""
    if speed <= 0.0:
        return {}
    estimated = estimate(hit.impulse_magnitude_ns, speed, contact, contact_time_s)
    return {
        "contact_time_s": estimated.contact_time_s,
        "half_sine_peak_force_N": estimated.half_sine_peak_force_n,
        "hertz_peak_force_N": estimated.hertz_peak_force_n,
    }


def _connections(results: Results) -> dict[str, Any]:
    """Return how many connections hold in the first frame, in each in which that changes, and in the last."""
    count, intact = len(results.inventory.connection_names), results.frames.intact.sum(axis=1)
    changed = np.flatnonzero(np.diff(intact, prepend=-1))
    shown = np.union1d(changed, len(intact) - 1)
    return {
        "count": count,
        "intact": int(intact[-1]),
        "broken": int(count - intact[-1]),
        **ConnectionCounts.of_results(results).to_json(),
        "over_time": {
            "time_s": results.frames.time_s[shown].tolist(),
            "intact": intact[shown].tolist(),
            "broken": (count - intact[shown]).tolist(),
        },
    }


def _blast(results: Results) -> dict[str, Any] | None:
    """Return the impulse of the blast on all bodies, and the largest on one; None without a blast."""
    impulses = results.frames.blast_impulses_ns.sum(axis=0, dtype=float)
    sizes = length(impulses)
    if not sizes.any():
        return None
    loaded = np.flatnonzero(results.frames.blast_impulses_ns.any(axis=(1, 2)))
    return {
        "first_load": _moment(results, int(loaded[0])),
        "last_load": _moment(results, int(loaded[-1])),
        "bodies": int((sizes > 0.0).sum()),
        "impulse_Ns": impulses.sum(axis=0).tolist(),
        "largest": {"impulse_Ns": float(sizes.max()), "body": str(results.inventory.body_names[sizes.argmax()])},
    }


@overload
def _moment(results: Results, step: int) -> dict[str, Any]: ...
@overload
def _moment(results: Results, step: int | None) -> dict[str, Any] | None: ...
def _moment(results: Results, step: int | None) -> dict[str, Any] | None:
    if step is None:
        return None
    return {"frame": int(results.frames.number[step]), "time_s": float(results.frames.time_s[step])}


def _largest_force(results: Results, magnitudes: np.ndarray) -> dict[str, Any] | None:
    """Return the largest of the magnitudes (k, n) on any shard, in any frame whose forces are known."""
    known = np.flatnonzero(np.isfinite(magnitudes).all(axis=1))
    shards = results.inventory.of_kind("shard")
    candidates = magnitudes[np.ix_(known, shards)]
    if not candidates.size:
        return None
    step, body = np.unravel_index(candidates.argmax(), candidates.shape)
    return {
        "force_N": float(candidates[step, body]),
        "body": str(results.inventory.body_names[shards[body]]),
        **_moment(results, int(known[step])),
    }


def largest_throw(results: Results) -> LargestThrow | None:
    """Return the largest throw of a shard of those that were not removed, on ground that may move; None without any."""
    results = relative_to_ground(results)
    shards = results.inventory.of_kind("shard")
    if not len(shards):
        return None
    throws = throw(results.frames.positions_m[0, shards], results.frames.positions_m[-1, shards])
    return LargestThrow(float(throws.max()), str(results.inventory.body_names[shards[throws.argmax()]]))
