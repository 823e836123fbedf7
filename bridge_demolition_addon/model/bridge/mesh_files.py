"""Mesh files of the user, placed in the bridge's coordinates."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.repair import Repaired, repaired_solid
from ...engineering.geometry.solids import union
from ...engineering.geometry.vectors import transformed, turn_by_degrees
from ...errors import GeometryError, ScenarioError, UnreadableError
from ..mesh_reading import from_y_up, read_mesh
from ..scenario import Geometry
from ..schema import FARTHEST_M, SHORTEST_LENGTH_M, given
from .member import Member

_BELOW_GROUND_M = 1e-3
"""How far a member may extend below the ground: what is deeper would be thrown out of it at the start."""

_LISTED = 5
_PLANES = ([1, 2], [2, 0], [0, 1])
"""Axes of the planes of rotations about x, y and z, each from the first to the second."""


def geometry_members(tables: Sequence[Geometry], *, is_flat: bool = True) -> tuple[tuple[Member, ...], tuple[str, ...]]:
    """Return members from files, united where they have the same name, and sentences on what was repaired.

    On flat ground nothing may extend below it; elsewhere it is dug away. A `GeometryError` says all that is wrong.
    """
    members, notes, wrong = [], [], []
    ordered = sorted(tables, key=lambda table: [other.name for other in tables].index(table.name))
    for name, group in groupby(ordered, key=lambda table: table.name):
        same_name = list(group)
        try:
            parts = [_part(table, is_flat=is_flat) for table in same_name]
            members.append(_member(same_name, [part.solid for part in parts]))
        except GeometryError as error:
            files = ", ".join(dict.fromkeys(table.file for table in same_name))
            wrong.append(f"{files}: {str(error).removeprefix(f'{files}: ')}")
            continue
        notes += [f"{name}: {repair}" for part in parts for repair in part.repairs]
    if wrong:
        more = f" And so for {len(wrong) - _LISTED} more." if len(wrong) > _LISTED else ""
        raise GeometryError(" ".join(wrong[:_LISTED]) + more)
    return tuple(members), tuple(notes)


def _part(table: Geometry, *, is_flat: bool) -> Repaired:
    mesh = placed_mesh(table)
    _check_extent(mesh, table.name)
    done = repaired_solid(mesh, table.name)
    if is_flat:
        _check_above_ground(done.solid, table.name)
    return done


def placed_mesh(table: Geometry) -> TriangleMesh:
    """Return the mesh in a file, scaled, rotated and moved to its position."""
    path = Path(table.file)
    mesh = _file_mesh(path, table.part)
    vertices = mesh.vertices * table.scale
    up = table.up or ("y" if path.suffix.lower() == ".glb" else "z")
    if up == "y":
        vertices = from_y_up(vertices)
    turns_deg = (*table.tilt_deg, table.rotation_deg)
    for plane, angle_deg in zip(_PLANES, turns_deg, strict=True):
        if angle_deg:
            vertices[:, plane] = transformed(turn_by_degrees(angle_deg), vertices[:, plane])
    return TriangleMesh(vertices + np.array(table.position_m), mesh.triangles)


def exported(mesh: TriangleMesh, suffix: str) -> bytes:
    """Return the mesh as the content of a file whose name ends in that suffix, such as ``.stl``."""
    import trimesh

    content: Any = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False).export(file_type=suffix[1:])
    return content.encode() if isinstance(content, str) else content


def _file_mesh(path: Path, part: str | None) -> TriangleMesh:
    try:
        return read_mesh(path, part)
    except UnreadableError as error:
        raise ScenarioError(f'geometry.file is "{path}": {error}') from error


def _check_extent(mesh: TriangleMesh, name: str) -> None:
    lower, upper = mesh.bounds
    farthest, thinnest = float(np.abs(mesh.bounds).max()), float((upper - lower).min())
    if farthest > FARTHEST_M:
        raise GeometryError(
            f"{name}: reaches {farthest:.4g} m from the origin; bring it within {FARTHEST_M:g} m by "
            "geometry.position_m, or by geometry.scale if the file is not in metres."
        )
    if 0.0 < thinnest < SHORTEST_LENGTH_M:
        raise GeometryError(
            f"{name}: is {thinnest:.4g} m thick; expected at least {SHORTEST_LENGTH_M:g} m, so set geometry.scale if "
            "the file is not in metres, or give it a thickness."
        )


def _check_above_ground(solid: TriangleMesh, name: str) -> None:
    lowest = float(solid.bounds[0, 2])
    if lowest < -_BELOW_GROUND_M:
        raise GeometryError(
            f"{name}: reaches {-lowest:.4g} m below the ground, which is at height 0; raise it by geometry.position_m."
        )


def _member(tables: Sequence[Geometry], solids: Sequence[TriangleMesh]) -> Member:
    first = tables[0]
    if len(tables) == 1:
        density = first.density_kg_m3 or given(first.mass_kg) / solids[0].volume
        return Member(first.name, first.kind, solids[0], density)
    for other in tables[1:]:
        if first.density_kg_m3 is None or (other.kind, other.density_kg_m3) != (first.kind, first.density_kg_m3):
            raise ScenarioError(
                f'geometry.name is "{first.name}" more than once: expected the same kind and density_kg_m3 with each, '
                "as they become one solid"
            )
    return Member(first.name, first.kind, union(solids), first.density_kg_m3)
