"""What elastic connections are made with, kept with them and the scene: stiffness, damping, bearings, soil, tendons."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import bpy
import numpy as np

from ...engineering.elasticity.bearings import PadSprings
from ...engineering.elasticity.section_stiffness import SectionStiffness
from ...engineering.elasticity.tendons import TendonPassages, TendonSteel
from ...engineering.foundations import SoilSprings
from ...errors import SimulationError
from ...model.scenario.kept import values_text
from ...model.structure.tendons import ModelTendons
from ..custom_properties import edited, keep, kept_number, kept_series, kept_values
from .constraints import set_strength

_STIFFNESS = "bda_stiffness"
_DAMPING_RATIO = "bda_damping_ratio"
_THICKNESS = "bda_thickness"
_UPPER = np.triu_indices(6)
_ROUNDING = 1e-12
"""Part of the largest stiffness of a connection: one that is 0 may be so far below it, once it was turned."""

_UNCOUPLED = 7
"""Numbers of files that were saved before: axial, shear along y and z, torsion, and three of bending about y and z."""


@dataclass(frozen=True, slots=True, eq=False)
class ConnectionElasticity:
    """Elasticity of m connections.

    The damping ratio is the first frequency's, as a share of the critical damping. Thicknesses (m,) are of the members
    that connections are in; nan where they are not known.
    """

    damping_ratio: float
    stiffness: SectionStiffness
    thicknesses_m: np.ndarray


def elasticity_of(scene: bpy.types.Scene, connections: Sequence[bpy.types.Object]) -> ConnectionElasticity | None:
    """Return the elasticity of the connections of a scene; None where they are rigid."""
    if not is_elastic(scene):
        return None
    thicknesses_m = np.array([kept_number(connection, _THICKNESS, 0.0) for connection in connections])
    return ConnectionElasticity(
        damping_ratio=kept_number(scene, _DAMPING_RATIO, 0.0),
        stiffness=_stiffness_of(connections),
        thicknesses_m=np.where(thicknesses_m > 0.0, thicknesses_m, np.nan),
    )


def keep_elasticity(
    scene: bpy.types.Scene,
    connections: Sequence[bpy.types.Object],
    stiffness: SectionStiffness,
    damping_ratio: float,
    thicknesses_m: np.ndarray | None = None,
) -> None:
    """Make all connections (m,) of a scene elastic, in members with these thicknesses (m,), where they are known."""
    scene[_DAMPING_RATIO] = damping_ratio
    numbers_of = stiffness.matrices[:, *_UPPER].tolist()
    for connection, numbers in zip(connections, numbers_of, strict=True):
        connection[_STIFFNESS] = numbers
    if thicknesses_m is not None:
        for connection, thickness_m in zip(connections, thicknesses_m.tolist(), strict=True):
            connection[_THICKNESS] = thickness_m


def forget_elasticity(scene: bpy.types.Scene) -> None:
    """Let the connections of a scene be rigid."""
    keep(scene, _DAMPING_RATIO, None)


def is_elastic(scene: bpy.types.Scene) -> bool:
    """Return whether the connections of a scene are elastic."""
    return _DAMPING_RATIO in scene


def _stiffness_of(connections: Sequence[bpy.types.Object]) -> SectionStiffness:
    for connection in connections:
        if _STIFFNESS not in connection:
            raise SimulationError(
                f"connection {connection.name!r} has no stiffness as the others have: delete it, or build again"
            )
    return SectionStiffness(np.array([_kept_matrix(connection) for connection in connections]).reshape(-1, 6, 6))


def _kept_matrix(connection: bpy.types.Object) -> np.ndarray:
    """Stiffness (6, 6) of a connection."""
    expected = f"{len(_UPPER[0])} finite numbers of a stiffness, none negative on its diagonal"
    numbers = kept_series(connection, _STIFFNESS, expected)
    if len(numbers) not in (len(_UPPER[0]), _UNCOUPLED) or not np.isfinite(numbers).all():
        raise edited(connection, _STIFFNESS, expected)
    matrix = _uncoupled_matrix(numbers) if len(numbers) == _UNCOUPLED else np.zeros((6, 6))
    if len(numbers) != _UNCOUPLED:
        matrix[_UPPER] = numbers
        matrix += np.triu(matrix, 1).T
    diagonal = np.diagonal(matrix)
    if (diagonal < -_ROUNDING * diagonal.max()).any():
        raise edited(connection, _STIFFNESS, expected)
    return matrix


def _uncoupled_matrix(numbers: np.ndarray) -> np.ndarray:
    axial, first, second, torsion, *bending = numbers.tolist()
    of_bending = np.array([[bending[:2], bending[1:]]])
    one = SectionStiffness.uncoupled(np.array([axial]), np.array([[first, second]]), np.array([torsion]), of_bending)
    return one.matrices[0]


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
    of_rows = [_pad_numbers(connections[row]) for row in rows]
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


def _pad_numbers(connection: bpy.types.Object) -> np.ndarray:
    """Return the numbers of a connection and of its springs."""
    expected = "the numbers of a bearing and of its springs"
    numbers = kept_series(connection, _PADS, expected)
    of_springs = numbers[_OF_CONNECTION:]
    is_whole = len(of_springs) > 0 and len(of_springs) % _OF_SPRING == 0
    if not is_whole or not (of_springs.reshape(-1, _OF_SPRING)[:, 3] > 0.0).all():
        raise edited(connection, _PADS, expected)
    return numbers


_SOIL = "bda_soil"
_COUNT = 4
"""How many numbers a footing has, and each point under it."""


def keep_soil(connections: Sequence[bpy.types.Object], soil: SoilSprings) -> None:
    """Keep soil with the connections that stand on it; no stress breaks these."""
    of_footings = zip(soil.stiffness_n_m3, soil.horizontal_n_m3, soil.capacity_pa, soil.friction, strict=True)
    positions = np.column_stack((soil.places_m, soil.areas_m2))
    for number, (row, values) in enumerate(zip(soil.rows.tolist(), of_footings, strict=True)):
        connections[row][_SOIL] = [*map(float, values), *positions[soil.footings == number].ravel().tolist()]
        set_strength(connections[row], None)


def soil_of(connections: Sequence[bpy.types.Object]) -> SoilSprings | None:
    """Return the soil under connections; None where the ground is rigid under all of them."""
    rows = [row for row, connection in enumerate(connections) if _SOIL in connection]
    if not rows:
        return None
    blocks = [_soil_numbers(connections[row]) for row in rows]
    footings = np.array([block[0] for block in blocks])
    footing_of_point = np.repeat(np.arange(len(rows)), [len(block) - 1 for block in blocks])
    points = np.concatenate([block[1:] for block in blocks])
    return SoilSprings(np.array(rows), footing_of_point, points[:, :3], points[:, 3], *footings.T)


def _soil_numbers(connection: bpy.types.Object) -> np.ndarray:
    """Return the numbers of a footing and of each point under it (1 + p, 4)."""
    expected = "the numbers of a footing and of the points under it"
    numbers = kept_series(connection, _SOIL, expected)
    if len(numbers) <= _COUNT or len(numbers) % _COUNT or not (numbers[:2] > 0.0).all():
        raise edited(connection, _SOIL, expected)
    return numbers.reshape(-1, _COUNT)


_TENDONS = "bda_tendons"
_WHOLE = ("tendons", "first", "second", "connections")
"""Whole numbers among what is kept of passages."""


def keep_tendons(
    scene: bpy.types.Scene,
    tendons: ModelTendons | None,
    shards: Sequence[bpy.types.Object],
    connections: Sequence[bpy.types.Object],
) -> None:
    """Keep the tendons of a model in the scene, by the names of its shards and connections; none for None."""
    if tendons is None:
        keep(scene, _TENDONS, None)
        return
    passed = {item.name: getattr(tendons.passages, item.name).tolist() for item in fields(TendonPassages)}
    passed["first"], passed["second"] = ([shards[row].name for row in passed[name]] for name in ("first", "second"))
    passed["connections"] = [connections[row].name if row >= 0 else "" for row in passed["connections"]]
    passed["openings_m"] = [opening if np.isfinite(opening) else None for opening in passed["openings_m"]]
    kept = {
        "names": tendons.names,
        "members": tendons.members,
        "steel": {item.name: getattr(tendons.steel, item.name).tolist() for item in fields(TendonSteel)},
        "passages": passed,
        "paths_m": [path.tolist() for path in tendons.paths_m],
    }
    keep(scene, _TENDONS, values_text(kept))


def tendons_of(
    scene: bpy.types.Scene, bodies: Sequence[bpy.types.Object], connections: Sequence[bpy.types.Object]
) -> ModelTendons | None:
    """Return the tendons of a scene with bodies and connections in this order; None without any."""
    kept = kept_values(scene, _TENDONS, {})
    if not kept:
        return None
    rows = {body.name: row for row, body in enumerate(bodies)}
    rows_of_connections = {connection.name: row for row, connection in enumerate(connections)}
    try:
        passed = kept["passages"]
        values: dict[str, Any] = {item.name: passed[item.name] for item in fields(TendonPassages)}
        values["first"], values["second"] = ([rows[name] for name in passed[end]] for end in ("first", "second"))
        values["connections"] = [rows_of_connections.get(name, -1) for name in passed["connections"]]
        values["openings_m"] = [np.inf if opening is None else opening for opening in passed["openings_m"]]
        arrays = {name: np.array(numbers, int if name in _WHOLE else float) for name, numbers in values.items()}
        return ModelTendons(
            tuple(kept["names"]),
            tuple(kept["members"]),
            TendonSteel(**{name: np.array(numbers) for name, numbers in kept["steel"].items()}),
            TendonPassages(**arrays),
            tuple(np.array(path, float) for path in kept["paths_m"]),
        )
    except (KeyError, TypeError, ValueError) as error:
        raise edited(scene, _TENDONS, "the tendons that the add-on wrote, in shards that are all there") from error
