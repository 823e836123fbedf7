# SPDX-License-Identifier: GPL-3.0-or-later
"""Slab bridges of boxes from mesh files, with bars by a rule."""

from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh
from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.model.bridge.mesh_files import exported
from bridge_demolition_addon.model.scenario import (
    ConnectionSettings,
    FractureSettings,
    Geometry,
    GeometryReinforcement,
    Scenario,
    TimeSettings,
)
from bridge_demolition_addon.model.scenario.bearings import Bearing

WIDTH_M = 4.0
SUPPORT_M = 1.0
HEIGHT_M = 5.0
OWN_WEIGHT = GeometryReinforcement(designed_for="own weight")


def block(size_m, low_m):
    """A box by its sizes and its lowest corner."""
    return box(size_m, [low + 0.5 * size for low, size in zip(low_m, size_m, strict=True)])


def slab(length_m, thickness_m, *, supports_m, kind="abutment"):
    """A deck on supports of 1 m along the road, by their middles."""
    parts = {"deck": ("deck", block((length_m, WIDTH_M, thickness_m), (0.0, -0.5 * WIDTH_M, HEIGHT_M)))}
    for number, at in enumerate(supports_m, start=1):
        low = (at - 0.5 * SUPPORT_M, -0.5 * WIDTH_M, 0.0)
        parts[f"support {number}"] = (kind, block((SUPPORT_M, WIDTH_M, HEIGHT_M), low))
    return parts


def scenario_of(parts, folder, rule=OWN_WEIGHT, **tables):
    """A scenario of members by their names, kinds and solids, whose meshes are written into a folder."""
    geometry = []
    for number, (name, (kind, solid)) in enumerate(parts.items()):
        file = folder / f"{number}.obj"
        file.write_bytes(exported(TriangleMesh(solid.vertices, solid.triangles), ".obj"))
        geometry.append(Geometry(name=name, file=str(file), kind=kind, density_kg_m3=2400.0))
    bearings = [Bearing(members=("deck", name), kind="rocker") for name in parts if name.startswith("support")]
    tables = {
        "connections": ConnectionSettings(method="face", material="reinforced concrete slab", type="FIXED"),
        "fracture": FractureSettings(shards=40),
        "bearings": tuple(bearings),
        "geometry_reinforcement": rule,
    } | tables
    return Scenario(title="Of meshes", time=TimeSettings(duration_s=1.0), geometry=tuple(geometry), **tables)
