"""What a member of a bridge looks like, before it has a density."""

from dataclasses import dataclass

import trimesh


@dataclass(frozen=True, slots=True)
class Shape:
    """Name, kind, solid and convex parts of a member, as in `core.member.Member`."""

    name: str
    kind: str
    solid: trimesh.Trimesh
    parts: tuple[trimesh.Trimesh, ...] = ()
