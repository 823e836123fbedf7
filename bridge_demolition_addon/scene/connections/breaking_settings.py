"""What breaks connections besides Blender's own threshold, kept with the scene."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import astuple, dataclass, fields

import bpy
import numpy as np

from ...engineering.elasticity.steel_bars import USUAL_STEEL, Steel
from ...engineering.mechanics.reinforcement import FaceBars
from ...engineering.mechanics.strength import Ductility, Strength
from ..custom_properties import kept_number, kept_numbers

_STRENGTH = "bda_strength_pa"
_WARM_UP = "bda_warm_up_s"
_DAMPING = "bda_warm_up_damping"
_DUCTILITY = "bda_ductility"
_STEEL = "bda_steel"
_BARS = "bda_bars"

_UNBREAKABLE = Strength(*[1e300] * len(fields(Strength)))
"""Strength of a connection that no stress breaks."""


@dataclass(frozen=True, slots=True)
class Breaking:
    """How connections break.

    Attributes
    ----------
    strength : Strength or None
        Strength of all connections with an area, or of each; None where Blender's breaking threshold alone decides.
    warm_up_s : float
        Simulated time from the start in which nothing breaks, so that the structure can settle under its own weight.
    ductility : Ductility or None
        What is left of a broken connection; None for nothing.
    warm_up_damping : float
        Share of their velocities that shards lose in one second of the warm-up, from 0 to 1.
    steel : Steel
        What the reinforcement of elastic connections is made of.
    bars : FaceBars or None
        Layers of reinforcement across connections, besides what is left by `ductility`.
    """

    strength: Strength | None = None
    warm_up_s: float = 0.0
    ductility: Ductility | None = None
    warm_up_damping: float = 0.0
    steel: Steel = USUAL_STEEL
    bars: FaceBars | None = None


def keep_breaking(scene: bpy.types.Scene, breaking: Breaking) -> None:
    """Keep it in the scene, and so in its file."""
    scene[_WARM_UP], scene[_DAMPING] = breaking.warm_up_s, breaking.warm_up_damping
    steel = breaking.steel if breaking.ductility else None
    for name, values in ((_STRENGTH, breaking.strength), (_DUCTILITY, breaking.ductility), (_STEEL, steel)):
        if values:
            scene[name] = astuple(values)
        elif name in scene:
            del scene[name]


def set_strength(connection: bpy.types.Object, strength: Strength | None) -> None:
    """Give a connection a strength of its own instead of the scene's; with None no stress breaks it."""
    connection[_STRENGTH] = astuple(strength or _UNBREAKABLE)


def keep_bars(connections: Sequence[bpy.types.Object], bars: FaceBars) -> None:
    """Keep with connections (m,) what bars cross them."""
    columns = zip(connections, bars.yield_n.tolist(), bars.offsets_m.tolist(), strict=True)
    for connection, yield_n, offset_m in columns:
        connection[_BARS] = (yield_n, *offset_m)


def _bars_of(connections: Sequence[bpy.types.Object]) -> FaceBars | None:
    if not any(_BARS in connection for connection in connections):
        return None
    numbers = np.array([kept_numbers(connection, _BARS, (0.0, 0.0, 0.0)) for connection in connections])
    return FaceBars(numbers[:, 0], numbers[:, 1:])


def breaking_of(scene: bpy.types.Scene, connections: Sequence[bpy.types.Object] = ()) -> Breaking:
    """Return what is kept in a scene and with connections; in any other, Blender's threshold and no warm-up.

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
