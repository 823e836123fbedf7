# SPDX-License-Identifier: GPL-3.0-or-later
"""How often Blender gets round to events, and to drawing, while it is busy."""

import time

import bpy
import numpy as np

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


def _now() -> tuple[float, float]:
    return time.perf_counter(), time.process_time()
