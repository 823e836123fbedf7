"""Work in shifts: when it begins and ends, in hours from the midnight at which the first day begins."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

DAY_H = 24.0

_DONE_H = 1e-9

Shift = tuple[float, float]
"""From which hour of a day to which."""


def working_hours(after_h: float, shifts: Sequence[Shift]) -> Iterator[Shift]:
    """Yield the times in which work goes on from a time on, day by day without an end."""
    day = int(after_h // DAY_H)
    while True:
        for begins, ends in shifts:
            begin, end = DAY_H * day + begins, DAY_H * day + ends
            if end > after_h:
                yield max(begin, after_h), end
        day += 1


def worked_from(after_h: float, hours: float, shifts: Sequence[Shift]) -> tuple[float, float]:
    """Return when work of some hours begins and ends that can begin after a time, and is interrupted between shifts."""
    first, left = None, hours
    for begin, end in working_hours(after_h, shifts):
        first = begin if first is None else first
        if left <= end - begin + _DONE_H:
            return first, begin + left
        left -= end - begin
    raise AssertionError("shifts have no end")


def clock(hour: float) -> tuple[int, str]:
    """Return the day, from 1 on, and the time of day of an hour, in whole minutes."""
    minutes = round(60.0 * hour)
    day, minute = divmod(minutes, 24 * 60)
    return day + 1, f"{minute // 60:02d}:{minute % 60:02d}"
