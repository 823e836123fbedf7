"""Bodies and connections of a run, as they stand when its simulation begins."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...engineering.mechanics.section_cuts import ConnectedFaces


@dataclass(frozen=True, slots=True, eq=False)
class Inventory:
    """n bodies and m connections.

    Attributes
    ----------
    body_names, body_kinds : (n,) str
        Names, and kinds: shard, ball, ground, tool, crane.
    masses_kg, volumes_m3 : (n,) float
        Both 0 for a body that never moves.
    body_members, body_member_kinds : (n,) str
        Name and kind of the member that each body was cut from; empty where it was not.
    vertices_m, vertex_counts : (v, 3) float, (n,) int
        Vertices of all bodies, each in its own axes from its origin, and how many each has.
    connection_names, pairs : (m,) str, (m, 2) int
        Names, and indices of the connected bodies.
    points_m, areas_m2, normals : (m, 3), (m,), (m, 3) float
        Middles and areas of the faces, and unit normals from the first body to the second.
    second_moments_m4 : (m, 2, 2) float
        Second moments of these areas about the sections' y and z axes.
    triangles, triangle_counts : (t, 3) int, (n,) int, optional
        Triangles of ground that is not flat and of surfaces on it, one body after the other, each in rows of the body's
        own vertices, and how many each has; all other bodies are convex. None where all are.
    """

    body_names: np.ndarray
    body_kinds: np.ndarray
    masses_kg: np.ndarray
    volumes_m3: np.ndarray
    body_members: np.ndarray
    body_member_kinds: np.ndarray
    vertices_m: np.ndarray
    vertex_counts: np.ndarray
    connection_names: np.ndarray
    pairs: np.ndarray
    points_m: np.ndarray
    areas_m2: np.ndarray
    normals: np.ndarray
    second_moments_m4: np.ndarray
    triangles: np.ndarray | None = None
    triangle_counts: np.ndarray | None = None

    @property
    def moves(self) -> np.ndarray:
        """Return whether each body (n,) can move at all."""
        return self.masses_kg > 0.0

    @property
    def faces(self) -> ConnectedFaces:
        return ConnectedFaces(self.pairs, self.points_m, self.normals, self.areas_m2, self.second_moments_m4)

    def of_kind(self, kind: str) -> np.ndarray:
        """Return the indices of the bodies of a kind."""
        return np.flatnonzero(self.body_kinds == kind)

    def vertices_by_body(self) -> list[np.ndarray]:
        """Return the vertices (v, 3) of every body in its own axes, m; its origin where it has none."""
        parts = np.split(self.vertices_m, np.cumsum(self.vertex_counts)[:-1])
        return [part if len(part) else np.zeros((1, 3)) for part in parts]

    def vertices_of(self, body: int) -> np.ndarray:
        """Return the vertices (v, 3) of a body in its own axes, m; its origin where it has none."""
        if not self.vertex_counts[body]:
            return np.zeros((1, 3))
        first = int(self.vertex_counts[:body].sum())
        return self.vertices_m[first : first + self.vertex_counts[body]]

    def triangles_of(self, body: int) -> np.ndarray:
        """Return the triangles (t, 3) of a body, in rows of its vertices; none of a convex hull."""
        if self.triangle_counts is None or self.triangles is None:
            return np.zeros((0, 3), int)
        first = int(self.triangle_counts[:body].sum())
        return self.triangles[first : first + self.triangle_counts[body]]
