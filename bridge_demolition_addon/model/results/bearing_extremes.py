"""The largest and the least that bearings carried in a run, for its summary."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ...engineering.mechanics.bearing_loads import BearingLoads

OPEN_SHARE = 0.999
"""From this share of its area on, a bearing that has lifted off there has opened."""

SLIPPED_M = 1e-4
"""Bullet has positions in single precision: within a bridge of 100 m they are within a tenth of this."""


KEYS = (
    "name",
    "at_rest_up_N",
    "largest_up_N",
    "largest_up_s",
    "least_up_N",
    "least_up_s",
    "largest_horizontal_N",
    "largest_horizontal_s",
    "largest_moment_y_Nm",
    "largest_moment_y_s",
    "opened",
    "opened_s",
    "largest_open_share",
    "slid",
    "slip_m",
    "largest_displacement_m",
    "left_share",
    "gone_s",
)
"""What a summary says of a bearing, in this order."""


class BearingExtremes:
    """Notes the extremes of b bearings, frame by frame, as long as each is there and after a warm-up."""

    def __init__(self, names: Sequence[str], warm_up_s: float):
        self._warm_up_s = warm_up_s
        self._bearings: list[dict[str, Any]] = [{"name": name} for name in names]

    def note(self, time_s: float, loads: BearingLoads, left: np.ndarray) -> None:
        """Take over a frame that ends then, with the part (b,) of the connections of each bearing that is left."""
        if time_s <= self._warm_up_s:
            return
        for number, bearing in enumerate(self._bearings):
            if "gone_s" in bearing:
                continue
            if np.isnan(loads.largest_up_n[number]):
                bearing["slept"] = True
                continue
            _note_largest(bearing, time_s, loads, number)
            bearing["left_share"] = float(left[number])
            if left[number] > 0.0:
                _note_others(bearing, time_s, loads, number)
            else:  # the rest of the frame in which it went says nothing of it
                bearing["gone_s"] = time_s

    def summary(self) -> list[dict[str, Any]]:
        """Return the extremes of the bearings that were noted, ready for JSON.

        Times are the ends of frames. Slip is None where connections are rigid: these slide without friction. The force
        at rest is None where the bodies slept at first, and so are not solved until something wakes them.
        """
        return [
            {key: (bearing | _judged(bearing))[key] for key in KEYS}
            for bearing in self._bearings
            if "at_rest_up_N" in bearing
        ]


def _judged(bearing: dict[str, Any]) -> dict[str, Any]:
    return {
        "opened": bearing["opened_s"] is not None,
        "slid": None if bearing["slip_m"] is None else bearing["slip_m"] > SLIPPED_M,
        "gone_s": bearing.get("gone_s"),
    }


def _note_largest(bearing: dict[str, Any], time_s: float, loads: BearingLoads, number: int) -> None:
    _keep_largest(bearing, "largest_up_N", loads.largest_up_n[number], time_s)
    _keep_largest(bearing, "largest_horizontal_N", loads.largest_horizontal_n[number], time_s)
    _keep_largest(bearing, "largest_moment_y_Nm", loads.largest_moment_y_nm[number], time_s)


def _note_others(bearing: dict[str, Any], time_s: float, loads: BearingLoads, number: int) -> None:
    if "at_rest_up_N" not in bearing:
        at_first = {"largest_displacement_m": 0.0, "largest_open_share": 0.0, "opened_s": None, "slip_m": None}
        at_rest_n = None if bearing.get("slept") else float(loads.forces_n[number, 2])
        bearing |= {"at_rest_up_N": at_rest_n, **at_first}
    along, across, _ = loads.displacements_m[number].tolist()
    _keep_largest(bearing, "least_up_N", loads.least_up_n[number], time_s, sign=-1.0)
    displacement_m = float(np.sqrt(along * along + across * across))
    bearing["largest_displacement_m"] = max(displacement_m, bearing["largest_displacement_m"])
    bearing["largest_open_share"] = max(float(loads.open_shares[number]), bearing["largest_open_share"])
    if loads.open_shares[number] >= OPEN_SHARE and bearing["opened_s"] is None:
        bearing["opened_s"] = time_s
    if not np.isnan(slip_m := float(loads.slips_m[number])):
        bearing["slip_m"] = max(slip_m, bearing["slip_m"] or 0.0)


def _keep_largest(bearing: dict[str, Any], key: str, value: float, time_s: float, sign: float = 1.0) -> None:
    """Keep a value with its time under a key, and one that ends in ``_s``, where none before was larger."""
    if key not in bearing or sign * value > sign * bearing[key]:
        bearing[key], bearing[f"{key.rpartition('_')[0]}_s"] = float(value), time_s
