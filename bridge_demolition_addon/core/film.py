"""What a film of a run shows, picture by picture: the whole run in real time, then its decisive moment slowed down."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

PICTURES_PER_SECOND = 24
SLOWNESS = 4.0
HOLD_S = 1.0
BEFORE_S, AFTER_S = 0.25, 1.5
"""How much before and after the decisive moment is shown in slow motion."""


@dataclass(frozen=True, eq=False, slots=True)
class FilmPlan:
    """Pictures of a film in order.

    Attributes
    ----------
    steps
        (p,) recorded step that each picture shows.
    speeds
        (p,) simulated seconds in one second of film: 1, less in slow motion, 0 while the picture stands still.
    """

    steps: np.ndarray
    speeds: np.ndarray


def film_plan(times_s: np.ndarray, moment_s: float | None) -> FilmPlan:
    """The film of a run.

    A picture shows the last recorded step before its time: nothing is drawn that was not simulated, and in slow motion
    pictures stand for as long as their step lasts.

    Parameters
    ----------
    times_s
        (k,) times of the recorded steps.
    moment_s
        The decisive moment, such as an impact; None for a film without slow motion.
    """
    interval_s = 1.0 / PICTURES_PER_SECOND
    hold = round(HOLD_S * PICTURES_PER_SECOND)
    parts = [(np.full(hold, times_s[0]), 0.0), (np.arange(times_s[0], times_s[-1] + interval_s / 2, interval_s), 1.0)]
    parts.append((np.full(hold, times_s[-1]), 0.0))
    if moment_s is not None:
        first, last = max(times_s[0], moment_s - BEFORE_S), min(times_s[-1], moment_s + AFTER_S)
        parts.append((np.arange(first, last + interval_s / SLOWNESS / 2, interval_s / SLOWNESS), 1.0 / SLOWNESS))
        parts.append((np.full(hold, times_s[-1]), 0.0))
    shown_s = np.concatenate([times for times, _ in parts])
    rounding_s = 1e-6  # times add up in single precision
    steps = np.searchsorted(times_s, shown_s + rounding_s, side="right") - 1
    return FilmPlan(steps, np.concatenate([np.full(len(times), speed) for times, speed in parts]))
