# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes for tests: from and to trimesh, turned and put together."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import trimesh

from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh, joined_meshes


def mesh(vertices, triangles) -> TriangleMesh:
    return TriangleMesh(np.array(vertices, dtype=float), np.array(triangles, dtype=np.int64).reshape(-1, 3))


def of_trimesh(other: trimesh.Trimesh) -> TriangleMesh:
    return mesh(other.vertices, other.faces)


def as_trimesh(of: TriangleMesh) -> trimesh.Trimesh:
    return trimesh.Trimesh(of.vertices, of.triangles, process=False)


def together(*meshes: TriangleMesh) -> TriangleMesh:
    return joined_meshes(meshes)


def rotation(angle_rad: float, axis) -> np.ndarray:
    return trimesh.transformations.rotation_matrix(angle_rad, axis)[:3, :3]


def turned(of: TriangleMesh, angle_rad: float, axis) -> TriangleMesh:
    return replace(of, vertices=of.vertices @ rotation(angle_rad, axis).T)


def moved(of: TriangleMesh, by) -> TriangleMesh:
    return replace(of, vertices=of.vertices + np.array(by))


def is_closed(of: TriangleMesh) -> bool:
    """Whether every directed edge is walked once, and once the other way."""
    edges = of.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    there = np.unique(edges, axis=0)
    return len(there) == len(edges) and np.array_equal(there, np.unique(edges[:, ::-1], axis=0))
