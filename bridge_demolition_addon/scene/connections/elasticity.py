"""Stiffness and damping of connections, kept with them and with the scene."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import bpy
import numpy as np

from ...engineering.elasticity.section_stiffness import SectionStiffness
from ...errors import SimulationError
from ..custom_properties import edited, keep, kept_number, kept_series

_STIFFNESS = "bda_stiffness"
_DAMPING_RATIO = "bda_damping_ratio"
_THICKNESS = "bda_thickness"
_UPPER = np.triu_indices(6)
_UNCOUPLED = 7
"""Numbers of files that were saved before: axial, shear along y and z, torsion, and three of bending about y and z."""


@dataclass(frozen=True, slots=True, eq=False)
class ConnectionElasticity:
    """Elasticity of m connections.

    The damping ratio is that of the first frequency, as a share of the critical damping. Thicknesses (m,) are those of
    the members that connections are in; nan where they are not known.
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
    if (np.diagonal(matrix) < 0.0).any():
        raise edited(connection, _STIFFNESS, expected)
    return matrix


def _uncoupled_matrix(numbers: np.ndarray) -> np.ndarray:
    axial, first, second, torsion, *bending = numbers.tolist()
    of_bending = np.array([[bending[:2], bending[1:]]])
    one = SectionStiffness.uncoupled(np.array([axial]), np.array([[first, second]]), np.array([torsion]), of_bending)
    return one.matrices[0]
