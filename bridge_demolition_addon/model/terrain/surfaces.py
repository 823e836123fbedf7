"""Surfaces on the ground, such as water, a river bank or the carriageway below."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from manifold3d import CrossSection, JoinType, Manifold

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.plan_areas import signed_area, united
from ...engineering.geometry.solids import from_manifold, to_manifold
from ...engineering.terrain.surface import Surface
from ...errors import GeometryError
from ..scenario import GroundSurface, Scenario
from ..schema import given
from .placed import surface_mesh

THICKNESS_M = 1.0
"""Depth of a level surface: a solid, so that nothing small falls through it in a sub-step."""

_GAP_M = 0.05
"""Gap around members that stand in a level surface: Bullet would press the two apart."""

_WITHIN_M = 1e-3


@dataclass(frozen=True, slots=True)
class BuiltSurface:
    """A surface as it is built, with its triangles in the scenario's coordinates."""

    settings: GroundSurface
    mesh: TriangleMesh


def built_surfaces(
    scenario: Scenario,
    members: Sequence[tuple[str, TriangleMesh]],
    ground_at: Callable[[np.ndarray], np.ndarray],
) -> tuple[BuiltSurface, ...]:
    """Return all surfaces of a scenario, on ground with heights (n,) at positions (n, 2); level ones spare members."""
    surfaces = []
    for settings in scenario.ground.surfaces:
        if settings.file is None:
            mesh = _level(settings, members)
        else:
            mesh = surface_mesh(scenario, settings.file)
            _check_through(settings, mesh, members)
        _check_above(settings, mesh, ground_at)
        surfaces.append(BuiltSurface(settings, mesh))
    return tuple(surfaces)


def _level(settings: GroundSurface, members: Sequence[tuple[str, TriangleMesh]]) -> TriangleMesh:
    corners = np.array(settings.corners_m)
    area = CrossSection([corners if signed_area(corners) > 0.0 else corners[::-1]])
    height = given(settings.height_m)
    bottom = height - THICKNESS_M
    standing = [_plan_between(solid, name, bottom, height) for name, solid in members]
    room = [plan.offset(_GAP_M, JoinType.Miter) for plan in standing if not plan.is_empty()]
    area -= united(room)
    if area.is_empty():
        raise GeometryError(f"Surface {settings.name!r}: members take all of its room; give it a larger outline.")
    return from_manifold(Manifold.extrude(area, THICKNESS_M).translate((0.0, 0.0, bottom)))


def _plan_between(solid: TriangleMesh, name: str, bottom: float, top: float) -> CrossSection:
    """Return the area that a solid covers in plan between two heights."""
    low, high = solid.bounds[:, 2]
    if low >= top or high <= bottom:
        return CrossSection()
    part = to_manifold(solid, name).trim_by_plane((0.0, 0.0, 1.0), bottom).trim_by_plane((0.0, 0.0, -1.0), -top)
    return part.project()


def _check_through(settings: GroundSurface, mesh: TriangleMesh, members: Sequence[tuple[str, TriangleMesh]]) -> None:
    surface = Surface(mesh)
    for name, solid in members:
        heights = surface.heights_at(solid.vertices[:, :2])
        below = solid.vertices[:, 2] < heights - _WITHIN_M
        if below.any():
            x, y, z = solid.vertices[below.argmax()]
            raise GeometryError(
                f"Surface {settings.name!r}: {name} reaches through it, at ({x:.2f}, {y:.2f}, {z:.2f}) m; leave a hole "
                "in the mesh around it."
            )


def _check_above(settings: GroundSurface, mesh: TriangleMesh, ground_at: Callable[[np.ndarray], np.ndarray]) -> None:
    low, high = mesh.bounds[:, :2]
    x, y = (np.linspace(low[axis], high[axis], 65) for axis in (0, 1))
    positions = np.concatenate([mesh.vertices[:, :2], np.stack(np.meshgrid(x, y), -1).reshape(-1, 2)])
    over = Surface(mesh).heights_at(positions) - ground_at(positions)
    if np.isnan(over).all():
        raise GeometryError(
            f"Surface {settings.name!r} lies beside the ground: bring it to the bridge by its corners_m, or by "
            "ground.origin and ground.scale."
        )
    if np.nanmax(over) < 0.0:
        raise GeometryError(
            f"Surface {settings.name!r} lies {-np.nanmax(over):.3g} m or more under the ground: nothing reaches it; "
            "raise it."
        )
