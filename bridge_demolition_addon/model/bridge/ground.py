"""What a bridge stands on: how high the ground is under a member."""

from __future__ import annotations

from collections.abc import Callable

from ...errors import GeometryError

GroundHeight = Callable[[str, float, float], float]
"""How high the ground is, m, under a member of a name with its middle at x and y."""

_SHORTEST_M = 0.1
"""Least height of what stands on the ground."""


def level_ground(_name: str, _x_m: float, _y_m: float) -> float:
    """Height of ground that is flat, m."""
    return 0.0


def foot_m(name: str, x_m: float, y_m: float, top_m: float, ground: GroundHeight) -> float:
    """Return the height of the ground under a member, m.

    Raises
    ------
    GeometryError
        The ground is above its top, or nearly so.
    """
    foot = ground(name, x_m, y_m)
    if foot > max(top_m - _SHORTEST_M, 0.0):  # on level ground the keys say how high a pier has to be
        raise GeometryError(
            f"The ground is at {foot:.2f} m under {name}, whose top is at {top_m:.2f} m; make the bridge "
            "higher, or the ground lower there: ground.profile_m, or ground.origin of a file."
        )
    return foot
