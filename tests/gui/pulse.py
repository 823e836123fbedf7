# SPDX-License-Identifier: GPL-3.0-or-later
"""How often Blender gets round to events, and to drawing, while it is busy."""

import time

import bpy
import numpy as np
from person import Person

ANSWER_S = 0.5
"""Blender answers and draws at least so often while it runs."""
SHARE = 0.95
"""Of the waits that must be shorter: the world is made in one of the first frames."""
LONGEST_S = 2.0
"""And no wait is ever as long as this."""

_BEAT_S = 0.01


class Pulse:
    """Takes the time whenever Blender looks for events, and whenever it draws a 3D view."""

    def __init__(self) -> None:
        self._beats: list[tuple[float, float]] = []
        self._drawings: list[tuple[float, float]] = []
        self._handle = bpy.types.SpaceView3D.draw_handler_add(self._drawn, (), "WINDOW", "POST_PIXEL")
        self._timer = self._beat  # Blender knows a function again by its identity
        bpy.app.timers.register(self._timer)

    def stop(self) -> None:
        """Take no more times."""
        bpy.app.timers.unregister(self._timer)
        bpy.types.SpaceView3D.draw_handler_remove(self._handle, "WINDOW")

    def waits(self) -> dict[str, np.ndarray]:
        """Times between two looks for events, and between two drawings, s (k, 2).

        In the first column is the time that passes. In the second is what Blender works meanwhile, in all its threads
        together.
        """
        return {
            "events": np.diff(np.array(self._beats), axis=0),
            "drawings": np.diff(np.array(self._drawings), axis=0),
        }

    def _beat(self) -> float:
        self._beats.append(_now())
        return _BEAT_S

    def _drawn(self) -> None:
        self._drawings.append(_now())


def judge(person: Person, what: str, waits: np.ndarray) -> None:
    """Note how long Blender did not look for events, or did not draw, and judge it.

    By the clock a wait is longer where something else runs on the machine, and of work where Blender works in several
    threads at once. So the shorter of the two is still no less than what it would take alone.
    """
    for name, column in zip(("by the clock", "of work", "by the shorter"), (*waits.T, waits.min(axis=1)), strict=True):
        middle, most, longest = np.quantile(column, (0.5, SHARE, 1.0))
        times = f"{middle:.3f} s in the middle, {most:.3f} s for {SHARE:.0%}, {longest:.3f} s at most"
        is_judged = name == "by the shorter"
        trouble = "too long" if is_judged and not (most < ANSWER_S and longest < LONGEST_S) else ""
        person.note(f"{len(column)} waits between {what} while it runs, {name}: {times}", trouble)


def _now() -> tuple[float, float]:
    return time.perf_counter(), time.process_time()
