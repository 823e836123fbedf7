"""All members of a bridge, with their densities; or all of them as one solid."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.solids import union
from ...errors import ScenarioError
from ..scenario import Bridge
from ..scenario.arch import ARCH_KIND, BLOCK_KIND, Arch, RigidFrame
from ..scenario.bridge_checks import deck_top, deck_underside, slab_underside
from ..scenario.bridge_parts import Abutments, Deck, Girders, PierCaps, Piers
from ..schema import given
from .layout import GroundHeight, level_ground
from .member import Member
from .substructure import LEG, substructure
from .superstructure import superstructure

_SAME_LEVEL_M = 1e-9
"""Heights of two faces that lie on each other differ by rounding, which the boolean engine would take for a gap."""


def bridge_members(bridge: Bridge, ground: GroundHeight = level_ground) -> tuple[Member, ...]:
    """Return all members, touching without overlap: decks and girders, abutments, arch, piers or legs."""
    bridge = bridge.lightened
    members = [*superstructure(bridge), *substructure(bridge, ground)]
    if bridge.merge:
        convex = tuple(part for member in members for part in member.parts or (member.solid,))
        members = [Member("bridge", "bridge", _merged(bridge, [member.solid for member in members]), parts=convex)]
    density = bridge_density(bridge, members)
    return tuple(replace(member, density_kg_m3=_own_density(bridge, member.kind) or density) for member in members)


def bridge_density(bridge: Bridge, members: Sequence[Member]) -> float:
    """Return the density of members without one of their own, kg/m³: as given, or by the rest of the total mass."""
    if bridge.density_kg_m3 is not None:
        return bridge.density_kg_m3
    own = [_own_density(bridge, member.kind) for member in members]
    pairs = list(zip(members, own, strict=True))
    known_kg = math.fsum(member.volume_m3 * density for member, density in pairs if density is not None)
    rest = math.fsum(member.volume_m3 for member, density in pairs if density is None)
    if not rest:
        raise ScenarioError(
            f"bridge.mass_kg is {bridge.mass_kg}: expected bridge.density_kg_m3 instead, as every member has a density "
            f"of its own; together they weigh {known_kg:.6g} kg"
        )
    mass_kg = given(bridge.mass_kg)
    if known_kg >= mass_kg:
        raise ScenarioError(
            f"bridge.mass_kg is {bridge.mass_kg}: expected more than {known_kg:.6g} (kg), which the members with a "
            "density of their own weigh"
        )
    return (mass_kg - known_kg) / rest


def _own_density(bridge: Bridge, kind: str) -> float | None:
    parts: dict[str, Deck | Girders | PierCaps | Piers | Abutments | Arch | RigidFrame | None] = {
        "deck": bridge.deck,
        "girder": bridge.girders,
        "pier cap": bridge.pier_caps,
        "pier": bridge.piers,
        "abutment": bridge.abutments,
        ARCH_KIND: bridge.arch,
        BLOCK_KIND: bridge.arch,
        LEG: bridge.frame,
    }
    part = parts.get(kind)
    return part.density_kg_m3 if part else None


def _merged(bridge: Bridge, solids: Sequence[TriangleMesh]) -> TriangleMesh:
    """Solids that touch, as one; where they lie on each other their heights are made the same to the last bit."""
    base = deck_underside(bridge)
    levels = [0.0, base, slab_underside(bridge), deck_top(bridge)]
    if bridge.piers:
        levels.append(bridge.piers.height_m)
    return union([_on_levels(solid, np.array(levels)) for solid in solids])


def _on_levels(solid: TriangleMesh, levels: np.ndarray) -> TriangleMesh:
    vertices = solid.vertices.copy()
    apart = np.abs(vertices[:, 2:] - levels)
    nearest = levels[apart.argmin(axis=1)]
    vertices[:, 2] = np.where(apart.min(axis=1) <= _SAME_LEVEL_M, nearest, vertices[:, 2])
    return replace(solid, vertices=vertices)
