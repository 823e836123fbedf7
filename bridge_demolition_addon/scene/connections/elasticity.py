"""How stiff connections are, kept with them and with the scene."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import bpy
import numpy as np

from ...engineering.elasticity.section_stiffness import SectionStiffness
from ...errors import SimulationError
from ..custom_properties import kept_number, kept_numbers

_STIFFNESS = "bda_stiffness"
_DAMPING_RATIO = "bda_damping_ratio"
_THICKNESS = "bda_thickness"
_COUNT = 7
"""Axial, shear along y and z, torsion, and the three numbers of bending about y and z."""


@dataclass(frozen=True, slots=True, eq=False)
class ConnectionElasticity:
    """How m connections are elastic.

    Attributes
    ----------
    damping_ratio : float
        Damping of the first frequency, as a share of the critical one.
    stiffness : SectionStiffness
    thicknesses_m : (m,) float
        Of the members that connections are in; nan where it is not known.
    """

    damping_ratio: float
    stiffness: SectionStiffness
    thicknesses_m: np.ndarray


def elasticity_of(scene: bpy.types.Scene, connections: Sequence[bpy.types.Object]) -> ConnectionElasticity | None:
    """Return how the connections of a scene are elastic; None where they are rigid."""
    if not is_elastic(scene):
        return None
    return ConnectionElasticity(damping_ratio_of(scene), stiffness_of(connections), thicknesses_of(connections))


def keep_elasticity(
    scene: bpy.types.Scene,
    connections: Sequence[bpy.types.Object],
    stiffness: SectionStiffness,
    damping_ratio: float,
    thicknesses_m: np.ndarray | None = None,
) -> None:
    """Make all connections (m,) of a scene elastic, in members with these thicknesses (m,), where they are known."""
    scene[_DAMPING_RATIO] = damping_ratio
    bending = stiffness.bending_nm
    columns = np.column_stack(
        (
            stiffness.axial_n_m,
            stiffness.shear_n_m,
            stiffness.torsion_nm,
            bending[:, 0, 0],
            bending[:, 0, 1],
            bending[:, 1, 1],
        )
    )
    for connection, numbers in zip(connections, columns.tolist(), strict=True):
        connection[_STIFFNESS] = numbers
    if thicknesses_m is not None:
        for connection, thickness_m in zip(connections, thicknesses_m.tolist(), strict=True):
            connection[_THICKNESS] = thickness_m


def forget_elasticity(scene: bpy.types.Scene) -> None:
    """Let the connections of a scene be rigid."""
    if _DAMPING_RATIO in scene:
        del scene[_DAMPING_RATIO]


def is_elastic(scene: bpy.types.Scene) -> bool:
    """Whether the connections of a scene are elastic."""
    return _DAMPING_RATIO in scene


def damping_ratio_of(scene: bpy.types.Scene) -> float:
    """Return the damping of the first frequency, as a share of the critical one."""
    return kept_number(scene, _DAMPING_RATIO, 0.0)


def stiffness_of(connections: Sequence[bpy.types.Object]) -> SectionStiffness:
    """Return the stiffness of connections."""
    for connection in connections:
        if _STIFFNESS not in connection:
            raise SimulationError(
                f"connection {connection.name!r} has no stiffness as the others have: delete it, or build again"
            )
    numbers = np.array([kept_numbers(connection, _STIFFNESS, (0.0,) * _COUNT) for connection in connections]).reshape(
        -1, _COUNT
    )
    if not ((numbers[:, [0, 1, 2, 3, 4, 6]] >= 0.0).all() and np.isfinite(numbers).all()):
        raise SimulationError("the stiffness of a connection was edited to a negative number: undo that")
    axial, first, second, torsion, *bending = numbers.T
    matrices = np.stack((bending[0], bending[1], bending[1], bending[2]), axis=1).reshape(-1, 2, 2)
    return SectionStiffness(axial, np.column_stack((first, second)), torsion, matrices)


def thicknesses_of(connections: Sequence[bpy.types.Object]) -> np.ndarray:
    """Return the thickness (m,) of the members that connections are in, m; nan where none was kept."""
    kept = np.array([kept_number(connection, _THICKNESS, 0.0) for connection in connections])
    return np.where(kept > 0.0, kept, np.nan)
