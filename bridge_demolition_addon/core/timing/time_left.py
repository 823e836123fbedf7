"""The time that work still takes, judged by the steps that are done."""

from __future__ import annotations

from collections.abc import Sequence

_SECONDS_PER_MINUTE = 60


def remaining_s(marks_s: Sequence[float], total: int) -> float | None:
    """Return how long the steps still to come take, if each takes as long as the later half of those done, s.

    Parameters
    ----------
    marks_s : sequence of float
        When the work began, and when each step so far was done, whatever else happened in between included: time on the
        clock, not only that of the steps.
    total : int
        Number of all steps.

    Returns
    -------
    float or None
        None before a step is done.
    """
    done = len(marks_s) - 1
    if done < 1:
        return None
    earlier = done // 2
    return (marks_s[-1] - marks_s[earlier]) / (done - earlier) * max(total - done, 0)


def in_words(seconds: float) -> str:
    """Return a time left in words, such as ``about 1:05 min left``."""
    whole = round(seconds)
    return f"about {whole // _SECONDS_PER_MINUTE}:{whole % _SECONDS_PER_MINUTE:02d} min left"
