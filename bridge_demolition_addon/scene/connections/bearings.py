"""Bearings, kept with the connections at their pads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import bpy
import numpy as np

from ...engineering.elasticity.bearings import PadSprings
from ..custom_properties import edited, kept_series
from .breaking_settings import set_strength

_NAME = "bda_bearing"
_PADS = "bda_pads"
_OF_CONNECTION = 4
_OF_SPRING = 6
"""How many numbers a connection has (friction, whether it pulls, travel, breaking force), and each of its springs."""


@dataclass(frozen=True, slots=True, eq=False)
class BearingsOfScene:
    """Springs of the pads of a scene, and the names (b,) of its bearings."""

    names: tuple[str, ...]
    springs: PadSprings


@dataclass(frozen=True, slots=True, eq=False)
class NamedBearings:
    """Connections (c,) at the pads of bearings, which of b bearings each is part of, and the names (b,) of these."""

    names: tuple[str, ...]
    rows: np.ndarray
    bearings: np.ndarray


def keep_pads(connections: Sequence[bpy.types.Object], springs: PadSprings) -> None:
    """Keep springs of pads with their connections; no stress breaks these."""
    numbers = np.column_stack((springs.friction, springs.pulls, springs.travel_m, springs.breaking_n))
    of_springs = np.column_stack((springs.places_m, springs.vertical_n_m, springs.sideways_n_m))
    for number, (row, values) in enumerate(zip(springs.rows.tolist(), numbers.tolist(), strict=True)):
        connections[row][_PADS] = [*values, *of_springs[springs.parts == number].ravel().tolist()]
        set_strength(connections[row], None)


def name_bearings(connections: Sequence[bpy.types.Object], names: Sequence[str], springs: PadSprings) -> None:
    """Keep with the connections of pads which bearing they are part of."""
    for row, bearing in zip(springs.rows.tolist(), springs.bearings.tolist(), strict=True):
        connections[row][_NAME] = names[bearing]


def named_bearings_of(connections: Sequence[bpy.types.Object]) -> NamedBearings | None:
    """Return the bearings among connections, elastic or rigid; None without any."""
    rows = [row for row, connection in enumerate(connections) if _NAME in connection]
    if not rows:
        return None
    named = [str(connections[row][_NAME]) for row in rows]
    names = tuple(dict.fromkeys(named))
    return NamedBearings(names, np.array(rows), np.array([names.index(name) for name in named]))


def bearings_of(connections: Sequence[bpy.types.Object]) -> BearingsOfScene | None:
    """Return the bearings among connections; None without any whose pads deform."""
    rows = [row for row, connection in enumerate(connections) if _PADS in connection]
    if not rows:
        return None
    of_rows = [_numbers(connections[row]) for row in rows]
    of_connections = np.array([numbers[:_OF_CONNECTION] for numbers in of_rows])
    of_springs = [numbers[_OF_CONNECTION:].reshape(-1, _OF_SPRING) for numbers in of_rows]
    springs = np.concatenate(of_springs)
    named = [str(connections[row].get(_NAME, "")) for row in rows]
    names = tuple(dict.fromkeys(named))
    return BearingsOfScene(
        names,
        PadSprings(
            rows=np.array(rows),
            parts=np.repeat(np.arange(len(rows)), [len(block) for block in of_springs]),
            places_m=springs[:, :3],
            vertical_n_m=springs[:, 3],
            sideways_n_m=springs[:, 4:],
            friction=of_connections[:, 0],
            pulls=of_connections[:, 1] > 0.0,
            travel_m=of_connections[:, 2],
            bearings=np.array([names.index(name) for name in named]),
            breaking_n=of_connections[:, 3],
        ),
    )


def _numbers(connection: bpy.types.Object) -> np.ndarray:
    """Return the numbers of a connection and of its springs."""
    expected = "the numbers of a bearing and of its springs"
    numbers = kept_series(connection, _PADS, expected)
    of_springs = numbers[_OF_CONNECTION:]
    is_whole = len(of_springs) > 0 and len(of_springs) % _OF_SPRING == 0
    if not is_whole or not (of_springs.reshape(-1, _OF_SPRING)[:, 3] > 0.0).all():
        raise edited(connection, _PADS, expected)
    return numbers
