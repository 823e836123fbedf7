"""Connections of a model that are footings on soil, and the springs under them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...engineering.elasticity.section_stiffness import SectionStiffness
from ...engineering.foundations import SoilSprings
from ...engineering.geometry.mesh import TriangleMesh, triangle_areas_and_normals
from ...engineering.structure.connections import GROUND, Connections
from ...errors import ScenarioError
from ..bridge.member import Member, members_named
from ..foundations import Foundation
from .connection_source import ConnectionRows, ConnectionSource

_PLACES = 128
"""Fewest positions under a footing: with them a rectangular one resists rotation within 2 %."""

_LEVEL_M = 1e-6
"""How far a face may lie off the ground and still stand on it."""


class FootingsOnSoil(ConnectionSource):
    """Connections of what stands on the ground, where this yields."""

    def added(self, rows: ConnectionRows) -> ConnectionRows:
        """Return the same connections, those on soil with the middles, areas and moments of their footings."""
        soil = self._springs(rows.connections)
        if soil is None:
            return rows
        points, areas = rows.connections.points.copy(), rows.connections.areas.copy()
        areas[soil.rows], points[soil.rows] = _summed(soil, soil.areas_m2), _middles(soil)
        on_soil = rows.claimed(soil.rows, "soil", moments_m4=_second_moments(soil)).with_part(soil)
        return replace(on_soil, connections=replace(rows.connections, points=points, areas=areas))

    def stiffen(self, rows: ConnectionRows, matrices: np.ndarray) -> None:
        """Set the stiffness of pressed footings."""
        if not (soil := rows.part(SoilSprings)):
            return
        moments, areas = _second_moments(soil), _summed(soil, soil.areas_m2)
        horizontal = soil.horizontal_n_m3 * areas
        matrices[soil.rows] = SectionStiffness.uncoupled(
            soil.stiffness_n_m3 * areas,
            np.column_stack((horizontal, horizontal)),
            soil.horizontal_n_m3 * (moments[:, 0, 0] + moments[:, 1, 1]),
            soil.stiffness_n_m3[:, None, None] * moments,
        ).matrices

    def _springs(self, connections: Connections) -> SoilSprings | None:
        """Return the springs under footings; None where all stands on unyielding ground."""
        footings: dict[int, tuple[Foundation, np.ndarray, np.ndarray]] = {}
        cut = self.cut
        for foundation in cut.scenario.foundations:
            for index in members_named(foundation.member, cut.members, "foundations.member"):
                rows = np.flatnonzero((cut.members_of(connections.pairs) == (index, GROUND)).all(axis=1))
                if not len(rows):
                    raise ScenarioError(
                        f'foundations.member is "{foundation.member}", and nothing of {cut.members[index].name} stands '
                        "on the ground and can move: expected a member that does, and no support under it"
                    )
                for row, positions, areas in _places(foundation, cut.members[index], rows, cut.shards, connections):
                    if row in footings:
                        raise ScenarioError(f"{cut.members[index].name} has two foundations: expected one")
                    footings[row] = foundation, positions, areas
        if not footings:
            return None
        order = sorted(footings)
        of_rows = [footings[row] for row in order]
        stiffness = np.array([foundation.ground.stiffness_n_m3 for foundation, _, _ in of_rows])
        return SoilSprings(
            rows=np.array(order),
            footings=np.repeat(np.arange(len(order)), [len(areas) for _, _, areas in of_rows]),
            places_m=np.concatenate([positions for _, positions, _ in of_rows]),
            areas_m2=np.concatenate([areas for _, _, areas in of_rows]),
            stiffness_n_m3=stiffness,
            horizontal_n_m3=stiffness * np.array([foundation.horizontal_share for foundation, _, _ in of_rows]),
            capacity_pa=np.array([foundation.capacity_pa for foundation, _, _ in of_rows]),
            friction=np.array([foundation.ground.friction for foundation, _, _ in of_rows]),
        )


def _second_moments(soil: SoilSprings) -> np.ndarray:
    """Return the second moments (f, 2, 2) of footings, as `second_moments` has them; their z is along the road."""
    x, y = (soil.places_m - _middles(soil)[soil.footings])[:, :2].T
    area = soil.areas_m2
    xx, yy, xy = (_summed(soil, area * product) for product in (x * x, y * y, x * y))
    return np.stack((np.stack((xx, -xy), axis=-1), np.stack((-xy, yy), axis=-1)), axis=-2)


def _places(
    foundation: Foundation,
    member: Member,
    rows: np.ndarray,
    shards: Sequence[TriangleMesh],
    connections: Connections,
) -> list[tuple[int, np.ndarray, np.ndarray]]:
    """Return connection, positions (p, 3) and their areas (p,) of a member's footings."""
    faces = [_standing_triangles(shards[connections.pairs[row, 0]], connections.points[row, 2]) for row in rows]
    if not all(map(len, faces)):
        raise ScenarioError(f"{member.name} stands on a slope: expected level ground under members with foundations")
    corners = np.concatenate(faces).reshape(-1, 3)
    low, high = corners.min(axis=0), corners.max(axis=0)
    scale = np.ones(3)
    if foundation.footing_m is not None:
        scale[:2] = np.array(foundation.footing_m) / (high - low)[:2]
        if (scale < 1.0 - 1e-6).any():
            raise ScenarioError(
                f"foundations.footing_m is {foundation.footing_m[0]:g} × {foundation.footing_m[1]:g} m under "
                f"{member.name}: expected at least {high[0] - low[0]:.4g} × {high[1] - low[1]:.4g} m, which stand on it"
            )
    middle = 0.5 * (low + high)
    parts_of_rows = []
    for row, triangles in zip(rows.tolist(), faces, strict=True):
        parts = _divided(triangles, int(np.ceil(np.sqrt(_PLACES / len(triangles)))))
        areas, _ = triangle_areas_and_normals(parts)
        parts_of_rows.append((row, middle + scale * (parts.mean(axis=1) - middle), scale[0] * scale[1] * areas))
    return parts_of_rows


def _standing_triangles(shard: TriangleMesh, height_m: float) -> np.ndarray:
    corners = shard.corners
    return corners[(abs(corners[:, :, 2] - height_m) <= _LEVEL_M).all(axis=1)]


def _divided(triangles: np.ndarray, count: int) -> np.ndarray:
    """Divide each of t triangles (t, 3, 3) into count² smaller ones, alike: (t count², 3, 3)."""
    steps = [(i, j) for i in range(count) for j in range(count - i)]
    upright = [((i, j), (i + 1, j), (i, j + 1)) for i, j in steps]
    turned = [((i + 1, j + 1), (i, j + 1), (i + 1, j)) for i, j in steps if i + j + 2 <= count]
    shares = np.array(upright + turned, float) / count
    first, along = triangles[:, :1], triangles[:, 1:] - triangles[:, :1]
    moved = shares[None, :, :, :1] * along[:, None, None, 0] + shares[None, :, :, 1:] * along[:, None, None, 1]
    return (first[:, None] + moved).reshape(-1, 3, 3)


def _middles(soil: SoilSprings) -> np.ndarray:
    whole = _summed(soil, soil.areas_m2)
    return np.stack([_summed(soil, soil.areas_m2 * values) / whole for values in soil.places_m.T], axis=1)


def _summed(soil: SoilSprings, values: np.ndarray) -> np.ndarray:
    return np.bincount(soil.footings, values, len(soil.rows))
