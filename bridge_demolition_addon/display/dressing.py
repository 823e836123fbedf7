"""Dressing: what is drawn in pictures for looks only, as solids with what they are made of. It changes no body."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh, joined_meshes

LOOKS_ONLY = "For looks only: surroundings, figures, machines, dust, chips, bars, rough faces"
"""What every dressed picture says of itself."""


class Stuff(StrEnum):
    """What a part of the dressing is made of."""

    CONCRETE = "concrete"
    STEEL = "steel"
    ASPHALT = "asphalt"
    SOIL = "soil"
    WHITE = "white"
    YELLOW = "yellow"
    RED = "red"
    BLACK = "black"
    RUST = "rust"
    SKIN = "skin"


@dataclass(frozen=True, slots=True)
class DrawnPart:
    """A solid where it is at first, and the body that carries it; None where it stays."""

    stuff: Stuff
    solid: TriangleMesh
    body: int | None = None


def joined_by_stuff(parts: list[DrawnPart]) -> dict[tuple[int | None, Stuff], TriangleMesh]:
    """Return the parts of each body and stuff as one mesh."""
    groups: dict[tuple[int | None, Stuff], list[TriangleMesh]] = {}
    for part in parts:
        groups.setdefault((part.body, part.stuff), []).append(part.solid)
    return {key: joined_meshes(solids) for key, solids in groups.items()}


def rod(start_m: np.ndarray, end_m: np.ndarray, thickness_m: float) -> TriangleMesh:
    """Return a square rod between two points (3,), m; they have to be apart."""
    axis = np.asarray(end_m, float) - np.asarray(start_m, float)
    axis /= np.linalg.norm(axis)
    other = np.array((0.0, 0.0, 1.0)) if abs(axis[2]) < 0.9 else np.array((1.0, 0.0, 0.0))
    right = np.cross(axis, other)
    right /= np.linalg.norm(right)
    up = np.cross(right, axis)
    half = thickness_m / 2.0
    ring = np.array([x * right + y * up for x, y in ((-half, -half), (half, -half), (half, half), (-half, half))])
    vertices = np.concatenate((ring + start_m, ring + end_m))
    sides = [(a, (a + 1) % 4 + 4, (a + 1) % 4) for a in range(4)] + [(a, a + 4, (a + 1) % 4 + 4) for a in range(4)]
    ends = [(0, 1, 2), (0, 2, 3), (4, 6, 5), (4, 7, 6)]
    return TriangleMesh(vertices, np.array(sides + ends))
