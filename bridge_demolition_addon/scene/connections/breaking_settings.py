"""What breaks connections, kept with them and the scene: strengths, and forces that become Blender's thresholds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import astuple, dataclass, fields

import bpy
import numpy as np

from ...engineering.elasticity.steel_bars import USUAL_STEEL, Steel
from ...engineering.mechanics.reinforcement import FaceBars
from ...engineering.mechanics.strength import Ductility, Strength
from ...engineering.timing.timeline import TimeStep
from ..custom_properties import keep, kept_number, kept_numbers
from ..time_scale import time_step_at
from .constraints import connections_of

_STRENGTH = "bda_strength_pa"
_WARM_UP = "bda_warm_up_s"
_DAMPING = "bda_warm_up_damping"
_DUCTILITY = "bda_ductility"
_STEEL = "bda_steel"
_BARS = "bda_bars"
_HINGE = "bda_hinge"
_YIELD_SHARE = "bda_yield_share"
_FORCE = "bda_breaking_force_n"

_NO_BARS = (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)

_UNBREAKABLE = Strength(*[1e300] * len(fields(Strength)))
"""Strength of a connection that no stress breaks."""


@dataclass(frozen=True, slots=True)
class Breaking:
    """How connections break.

    Attributes
    ----------
    strength
        Strength of all connections with an area, or of each; None where Blender's breaking threshold alone decides.
    warm_up_s
        Simulated time from the start in which nothing breaks, so that the structure can settle under its own weight.
    ductility
        What is left of a broken connection; None for nothing.
    warm_up_damping
        Share of their velocities that shards lose in one second of the warm-up, from 0 to 1.
    steel
        Steel of the reinforcement of elastic connections.
    bars
        Layers of reinforcement across connections, in addition to what `ductility` leaves.
    """

    strength: Strength | None = None
    warm_up_s: float = 0.0
    ductility: Ductility | None = None
    warm_up_damping: float = 0.0
    steel: Steel = USUAL_STEEL
    bars: FaceBars | None = None

    @property
    def is_reinforced(self) -> bool:
        """Return whether anything holds where connections broke."""
        return self.ductility is not None or self.bars is not None


def keep_breaking(scene: bpy.types.Scene, breaking: Breaking) -> None:
    """Keep how connections break in the scene, and so in its file."""
    scene[_WARM_UP], scene[_DAMPING] = breaking.warm_up_s, breaking.warm_up_damping
    steel = breaking.steel if breaking.is_reinforced else None
    for name, values in ((_STRENGTH, breaking.strength), (_DUCTILITY, breaking.ductility), (_STEEL, steel)):
        keep(scene, name, astuple(values) if values else None)


def set_strength(connection: bpy.types.Object, strength: Strength | None) -> None:
    """Give a connection a strength of its own instead of the scene's; with None no stress breaks it."""
    connection[_STRENGTH] = astuple(strength or _UNBREAKABLE)


def keep_bars(connections: Sequence[bpy.types.Object], bars: FaceBars) -> None:
    """Keep bars with the connections (m,) that they cross."""
    columns = np.column_stack((bars.yield_n, bars.offsets_m, bars.directions, bars.openings_m))
    for connection, numbers in zip(connections, columns.tolist(), strict=True):
        connection[_BARS] = numbers
    if bars.hinges is not None:
        for row in np.flatnonzero(bars.have_own_law).tolist():
            connections[row][_HINGE] = bars.hinges[row].tolist()
    if bars.yield_shares is not None:
        for row in np.flatnonzero(~np.isnan(bars.yield_shares)).tolist():
            connections[row][_YIELD_SHARE] = float(bars.yield_shares[row])


def _bars_of(connections: Sequence[bpy.types.Object]) -> FaceBars | None:
    if not any(_BARS in connection for connection in connections):
        return None
    numbers = np.array([kept_numbers(connection, _BARS, _NO_BARS) for connection in connections])
    hinges = None
    if any(_HINGE in connection for connection in connections):
        none = (np.nan,) * 3
        hinges = np.array(
            [kept_numbers(connection, _HINGE, none) if _HINGE in connection else none for connection in connections]
        )
    shares = None
    if any(_YIELD_SHARE in connection for connection in connections):
        shares = np.array(
            [
                kept_number(connection, _YIELD_SHARE, 0.0) if _YIELD_SHARE in connection else np.nan
                for connection in connections
            ]
        )
    return FaceBars(numbers[:, 0], numbers[:, 1:3], numbers[:, 3:6], numbers[:, 6], hinges, shares)


def breaking_of(scene: bpy.types.Scene, connections: Sequence[bpy.types.Object] = ()) -> Breaking:
    """Return what a scene and connections keep; without that, Blender's threshold decides and there is no warm-up.

    Where any of m connections has a strength of its own, the strength has arrays (m,) float.
    """
    strength = Strength(*kept_numbers(scene, _STRENGTH, astuple(_UNBREAKABLE))) if _STRENGTH in scene else None
    if any(_STRENGTH in connection for connection in connections):
        other = astuple(strength or _UNBREAKABLE)
        strength = Strength(*np.array([kept_numbers(connection, _STRENGTH, other) for connection in connections]).T)
    ductility = Ductility(*kept_numbers(scene, _DUCTILITY, (0.0, 0.0))) if _DUCTILITY in scene else None
    return Breaking(
        strength,
        kept_number(scene, _WARM_UP, 0.0),
        ductility,
        kept_number(scene, _DAMPING, 0.0),
        Steel(*kept_numbers(scene, _STEEL, astuple(USUAL_STEEL))),
        _bars_of(connections),
    )


def set_breaking_force(connection: bpy.types.Object, force_n: float, step: TimeStep) -> None:
    """Make a connection break at a force: Blender has the impulse in a sub-step, the connection keeps the force."""
    connection[_FORCE] = force_n
    constraint = connection.rigid_body_constraint
    constraint.use_breaking = True
    constraint.breaking_threshold = step.impulse(force_n)


def kept_breaking_force(connection: bpy.types.Object) -> float | None:
    """Return the force that a connection breaks at, N; None where only Blender's own threshold decides."""
    return kept_number(connection, _FORCE, 0.0) if _FORCE in connection else None


def rewrite_thresholds(scene: bpy.types.Scene) -> bool:
    """Write the thresholds that the kept forces have in the step of the start frame, and return whether any changed.

    With a new threshold Blender simulates from the start again, so call this before a simulation starts. A connection
    without a kept force keeps its threshold.
    """
    step = time_step_at(scene, scene.rigidbody_world.point_cache.frame_start)
    is_changed = False
    for connection in connections_of(scene):
        if (force_n := kept_breaking_force(connection)) is not None:
            constraint, impulse = connection.rigid_body_constraint, float(np.float32(step.impulse(force_n)))
            if constraint.breaking_threshold != impulse:
                constraint.breaking_threshold = impulse
                is_changed = True
    return is_changed
