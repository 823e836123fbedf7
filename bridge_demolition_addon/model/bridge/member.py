"""A structural member: a closed solid with a name, a kind and a density."""

from collections.abc import Sequence
from dataclasses import dataclass

from ...engineering.geometry.mesh import TriangleMesh, triangle_areas_and_normals
from ..schema import given


@dataclass(frozen=True, slots=True)
class Member:
    """A structural member.

    Attributes
    ----------
    name : str
        What the member is called; no two of a model have the same name.
    kind : str
        What it is: ``deck``, ``girder``, ``pier cap``, ``pier``, ``abutment``, ``bridge`` for all of these in one, or
        whatever a user's own geometry is called.
    solid : TriangleMesh
        Closed, in m.
    density_kg_m3 : float, optional
        Density, kg/m³; None as long as it is not known.
    parts : tuple of TriangleMesh
        Convex solids that the member consists of, touching without overlap, where it is not convex itself and they are
        known. Cut within them its shards are convex. Bullet takes every shard for its convex hull, and a shard that
        is joined from pieces around a hollow reaches into its neighbours with its hull, and is thrown off them as soon
        as their connection breaks.
    """

    name: str
    kind: str
    solid: TriangleMesh
    density_kg_m3: float | None = None
    parts: tuple[TriangleMesh, ...] = ()

    @property
    def volume_m3(self) -> float:
        """Volume of the solid, m³."""
        return self.solid.volume

    @property
    def thickness_m(self) -> float:
        """Twice the volume by the surface, m: the thickness of a plate, the wall of a box, half the side of a bar."""
        areas, _ = triangle_areas_and_normals(self.solid.corners)
        return 2.0 * self.volume_m3 / float(areas.sum())

    @property
    def mass_kg(self) -> float:
        """Mass of the member, kg."""
        return self.volume_m3 * given(self.density_kg_m3)


def mean_density(members: Sequence[Member]) -> float:
    """Mass of all members over their volume, kg/m³; to the last bit the density of all where they have the same."""
    densities = {member.density_kg_m3 for member in members}
    if len(densities) == 1:
        return given(densities.pop())
    return sum(member.mass_kg for member in members) / sum(member.volume_m3 for member in members)
