"""Frames of a run: those that a film shows, in real time or slowed down, and those that a timeline marks."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..errors import OutputError
from ..model.results.arrays import Results
from ..model.results.summary import impact_step

_NOISE_S = 1e-6


def film_rows(times_s: np.ndarray, pictures_per_second: float, slowness: float = 1.0) -> np.ndarray:
    """Return the rows (p,) of recorded frames, one for every picture of a film from the first frame to the last.

    The film shows the frame whose time (k,) is nearest. So it keeps time where frames are of different lengths, as
    around a detonation, and where it is slowed down it repeats frames, as nothing is known between them. With a
    `slowness` of 10 a second of the simulation takes ten seconds of film.
    """
    times_s = np.asarray(times_s, float)
    if not len(times_s):
        raise OutputError("film: there are no recorded frames; play the timeline with the handler registered first")
    if not (pictures_per_second > 0.0 and slowness > 0.0):
        raise OutputError(
            f"film: expected positive numbers, found {pictures_per_second:g} pictures a second and a "
            f"slowness of {slowness:g}"
        )
    duration = times_s[-1] - times_s[0]
    count = int(np.floor(duration * slowness * pictures_per_second + 1e-6)) + 1
    wanted = times_s[0] + np.arange(count) / (pictures_per_second * slowness)
    after = np.clip(np.searchsorted(times_s, wanted), 1, max(len(times_s) - 1, 1))
    if len(times_s) == 1:
        return np.zeros(count, int)
    before = after - 1
    return np.where(wanted - times_s[before] <= times_s[after] - wanted, before, after)


def moments(
    results: Results, gravity_m_s2: np.ndarray, detonations_s: Mapping[str, float], came_to_rest_s: float | None
) -> list[tuple[int, str]]:
    """Return frames of a run and what happens in them: release and hit of a ball, charges, first break, rest.

    Detonations later than the run are left out. `came_to_rest_s` is None where the run does not come to rest, or this
    is not known.
    """
    frames = results.frames
    numbers, times_s = np.asarray(frames.number), np.asarray(frames.time_s)
    marked = []
    for ball in results.inventory.of_kind("ball"):
        moving = np.flatnonzero(np.asarray(frames.velocities_m_s[:, ball]).any(axis=1))
        if len(moving):
            marked.append((int(numbers[max(moving[0] - 1, 0)]), "Release"))
    hit = impact_step(results, gravity_m_s2)
    if hit is not None:
        marked.append((int(numbers[hit]), "Hit"))
    at_rest = {} if came_to_rest_s is None else {"At rest": came_to_rest_s}
    for name, time_s in [*detonations_s.items(), *at_rest.items()]:
        row = int(np.searchsorted(times_s, time_s - _NOISE_S))
        if row < len(numbers):
            marked.append((int(numbers[row]), name))
    broken = np.flatnonzero(~np.asarray(frames.intact).all(axis=1))
    if len(broken):
        marked.append((int(numbers[broken[0]]), "First break"))
    return sorted(marked)
