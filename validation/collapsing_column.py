# SPDX-License-Identifier: GPL-3.0-or-later
"""Columns of loose blocks that collapse: how far they run out and how high they lie, by the laws of experiments."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from case import VALIDATION, Against, Case, Comparison, Found, simulated
from matplotlib.figure import Figure
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import ConvexHull, cKDTree
from solids import block

from bridge_demolition_addon.engineering.geometry.mesh import TriangleMesh
from bridge_demolition_addon.model.results.arrays import Results

COLUMNS = tuple((shape, aspect) for shape in ("cubes", "splinters") for aspect in (0.5, 0.9, 2.0, 4.0))
"""Shape of blocks, and height over radius that a column is meant to have; what it has once it has settled counts."""

COUNT, SIDE_M, PACKED = 320, 0.3, 0.55
"""Blocks of a column, the side of a cube of the same volume, and which part of a column is blocks, about."""

PANELS, GAP_M, PANEL_M = 12, 0.02, 0.3
SETTLING_S, COLLAPSING_S = 1.2, 3.0
"""How long blocks rest behind the panels after the last has fallen, and how long they run out."""

SEED, SECTORS = 1, 12


@dataclass(frozen=True, slots=True)
class Column:
    """A column to collapse.

    Attributes
    ----------
    shape : str
    radius_m : float
        Of a circle inside all panels.
    """

    shape: str
    radius_m: float

    @classmethod
    def of(cls, shape: str, aspect: float) -> Column:
        """Return the column of a shape of blocks with about that height over its radius."""
        return cls(shape, (COUNT * SIDE_M**3 / (PACKED * math.pi * aspect)) ** (1.0 / 3.0))

    @property
    def mean_radius_m(self) -> float:
        """Radius of the circle with the same area as what the panels enclose."""
        return self.radius_m * math.sqrt(PANELS * math.tan(math.pi / PANELS) / math.pi)


@dataclass(frozen=True, slots=True)
class Deposit:
    """A column as it was let go, and how it lay in the end, over its radius.

    Attributes
    ----------
    aspect, runout, height : float
        Height over radius; by how much the radius grew, and how high it lay, over the first radius.
    outline : (b, 2) float
        Distance and height of each block in the end, over the first radius.
    """

    aspect: float
    runout: float
    height: float
    outline: np.ndarray


def law_of_runout(aspect: float) -> float:
    """Return by how much the radius grows, over itself (Lube and others 2004)."""
    return 1.24 * aspect if aspect < 1.7 else 1.6 * math.sqrt(aspect)


def law_of_height(aspect: float) -> float:
    """Return how high it lies in the end, over its first radius (Lube and others 2004)."""
    return min(aspect, 0.88 * aspect ** (1.0 / 6.0))


def block_of(shape: str, random: np.random.Generator) -> TriangleMesh:
    """Return a block about the origin, turned at random: a cube, or a splinter of the same volume."""
    if shape == "cubes":
        half = SIDE_M / 2.0
        solid = block((-half, -half, -half), (half, half, half))
        vertices, triangles = solid.vertices, solid.triangles
    else:
        points = random.normal(size=(14, 3))
        points *= np.array([1.0, 0.8, 0.6]) / np.sqrt(np.sum(points**2, axis=1))[:, None]
        hull = ConvexHull(points)
        vertices, triangles = points[hull.vertices], np.searchsorted(hull.vertices, hull.simplices)
        inwards = np.einsum("ti,ti->t", hull.equations[:, :3], _normals(vertices, triangles)) < 0.0
        triangles[inwards] = triangles[inwards][:, ::-1]
        vertices = vertices * (SIDE_M / hull.volume ** (1.0 / 3.0))
    turned, _ = np.linalg.qr(random.normal(size=(3, 3)))
    return TriangleMesh(vertices @ (turned * np.linalg.det(turned)), triangles)


def _normals(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    first, second, third = (vertices[triangles[:, corner]] for corner in range(3))
    return np.cross(second - first, third - first)


def positions_m(radius_m: float, apart_m: float) -> np.ndarray:
    """Return positions (b, 3) as of spheres packed closely in layers within a circle, from the lowest one up."""
    reach = math.ceil(radius_m / apart_m) + 2
    columns, rows = (grid.ravel() for grid in np.meshgrid(np.arange(-reach, reach + 1), np.arange(-reach, reach + 1)))
    layer = apart_m * np.stack([columns + rows / 2.0, rows * math.sqrt(0.75)], axis=1)
    found: list[np.ndarray] = []
    while sum(map(len, found)) < COUNT:
        shift = np.array([0.0, apart_m / math.sqrt(3.0)]) if len(found) % 2 else np.zeros(2)
        level = layer + shift
        level = level[np.hypot(*level.T) <= radius_m - apart_m / 2.0]
        height = apart_m * (0.75 + math.sqrt(2.0 / 3.0) * len(found))
        found.append(np.column_stack([level, np.full(len(level), height)]))
    return np.concatenate(found)[:COUNT]


def collapsed(folder: Path, name: str, column: Column) -> Deposit:
    """Drop blocks within panels, let them settle, take the panels away, and return how they lay in the end."""
    random = np.random.default_rng(SEED)
    blocks = [block_of(column.shape, random) for _ in range(COUNT)]
    apart = 1.01 * 2.0 * max(float(np.sqrt(np.sum(solid.vertices**2, axis=1)).max()) for solid in blocks)
    positions = positions_m(column.radius_m, apart)
    meshes = {f"block_{row:03d}.obj": solid for row, solid in enumerate(blocks)}
    meshes |= {f"panel_{row:02d}.obj": solid for row, solid in enumerate(_panels(column, positions[-1, 2] + apart))}
    released_s = math.sqrt(2.0 * positions[-1, 2] / 9.81) + SETTLING_S
    tables = [_table(name, positions[row] if row < COUNT else np.zeros(3)) for row, name in enumerate(meshes)]
    scenario = _SCENARIO.format(
        title=name.replace("_", " "),
        duration_s=round(released_s + COLLAPSING_S, 2),
        shards=COUNT + PANELS,
        released_s=round(released_s, 2),
    )
    results = simulated(folder, name, scenario + "".join(tables), meshes)
    return deposit(results, column, released_s)


_SCENARIO = """
[scenario]
title = "{title}"

[time]
duration_s = {duration_s}

[recording]
every_substep = false

[fracture]
shards = {shards}

[connections]
type = "FIXED"
method = "face"
breaking_force_n = 1e12

[[connections.between]]
members = ["block", "ground"]
none = true

[shards]
start_deactivated = false

[[removals]]
members = ["panel"]
time_s = {released_s}
"""


def _table(mesh: str, position: np.ndarray) -> str:
    kind = mesh.split("_")[0]
    return f"""
[[geometry]]
name = "{mesh.removesuffix(".obj").replace("_", " ")}"
kind = "{kind}"
file = "{mesh}"
position_m = {[float(f"{value:.6f}") for value in position]}
density_kg_m3 = 2400.0
"""


def _panels(column: Column, height_m: float) -> list[TriangleMesh]:
    """Panels around a column."""
    half = column.radius_m * math.tan(math.pi / PANELS) - GAP_M
    panel = block((column.radius_m, -half, 0.0), (column.radius_m + PANEL_M, half, height_m))
    solids = []
    for angle in 2.0 * math.pi / PANELS * np.arange(PANELS):
        cosine, sine = math.cos(angle), math.sin(angle)
        turn = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
        solids.append(TriangleMesh(panel.vertices @ turn.T, panel.triangles))
    return solids


def deposit(results: Results, column: Column, released_s: float) -> Deposit:
    """Return how a column lay in the end.

    Its height at first is twice that of its centre of mass; its front is the mean over sectors of the farthest block
    that is connected with the middle by blocks no more than about the side of one apart.
    """
    frames, radius = results.frames, column.mean_radius_m
    rows = np.flatnonzero(np.asarray(results.inventory.body_member_kinds) == "block")
    before = int(np.searchsorted(np.asarray(frames.time_s), released_s)) - 1
    first, last = (np.asarray(frames.positions_m[frame])[rows].astype(float) for frame in (before, -1))
    distances = np.hypot(*last[:, :2].T)
    front = front_m(last) + SIDE_M / 2.0
    top = last[:, 2].max() + SIDE_M / 2.0
    outline = np.column_stack([distances, last[:, 2]]) / radius
    return Deposit(2.0 * first[:, 2].mean() / radius, front / radius - 1.0, top / radius, outline)


def front_m(positions_m: np.ndarray) -> float:
    """Return the mean over sectors of the distance of the farthest block (b, 3) that is connected with the middle."""
    near = cKDTree(positions_m).query_pairs(2.0 * SIDE_M, output_type="ndarray")
    graph = coo_array((np.ones(len(near)), (near[:, 0], near[:, 1])), shape=(len(positions_m),) * 2)
    _, parts = connected_components(graph, directed=False)
    pile = positions_m[parts == np.bincount(parts).argmax()]
    sectors = ((np.arctan2(pile[:, 1], pile[:, 0]) / (2.0 * math.pi) + 0.5) * SECTORS).astype(int) % SECTORS
    distances = np.hypot(*pile[:, :2].T)
    return float(np.mean([distances[sectors == sector].max(initial=0.0) for sector in range(SECTORS)]))


def run(folder: Path) -> Found:
    """Let all columns collapse."""
    deposits = {
        (shape, aspect): collapsed(folder, f"{shape}_{aspect:g}".replace(".", "_"), Column.of(shape, aspect))
        for shape, aspect in COLUMNS
    }
    comparisons = []
    for quantity, law, found_of in (
        ("runout", law_of_runout, lambda deposit: deposit.runout),
        ("height in the end", law_of_height, lambda deposit: deposit.height),
    ):
        comparisons += [
            Comparison(
                f"{quantity} over radius, {shape}, {deposit.aspect:.2f} as high",
                "",
                law(deposit.aspect),
                found_of(deposit),
                0.2,
                Against.MEASURED,
            )
            for (shape, _), deposit in deposits.items()
        ]

    def draw(figure: Figure) -> None:
        curve = np.linspace(0.0, 5.0, 101)
        for axes, quantity, law, found_of in zip(
            figure.subplots(1, 2),
            ("runout", "height in the end"),
            (law_of_runout, law_of_height),
            (lambda deposit: deposit.runout, lambda deposit: deposit.height),
            strict=True,
        ):
            axes.plot(curve, [law(aspect) for aspect in curve], color="0.6", label="law of experiments")
            for shape, marker in (("cubes", "s"), ("splinters", "^")):
                of_shape = [deposit for (name, _), deposit in deposits.items() if name == shape]
                axes.plot(
                    [deposit.aspect for deposit in of_shape],
                    [found_of(deposit) for deposit in of_shape],
                    marker,
                    color="black",
                    label=shape,
                )
            axes.set(xlabel="height over radius at first", ylabel=f"{quantity} over radius")
        axes.legend(fontsize=8)

    return Found(comparisons, draw)


CASE = Case(
    name="collapsing_column",
    title="Columns of loose blocks that collapse",
    group=VALIDATION,
    asked="320 loose blocks of concrete are dropped within twelve panels and settle; then the panels are gone. How "
    "far do they run out, and how high do they lie? The blocks are cubes of 0.3 m, or irregular splinters of the "
    "same volume, and columns have four heights. Contacts, damping and steps are the program's own, as in a "
    "scenario that gives none.",
    left_out="The number of grains: experiments had thousands, or hundreds of thousands. These columns have 4 to 7 "
    "blocks from the middle to the edge, and the front lies uncertain by half a block. By the law a tall one would "
    "lie thinner than one block. Dust, and blocks that break.",
    source="(r - r₀) / r₀ = 1.24 a below a height over radius a of 1.7, and 1.6 √a above; h / r₀ = a below 1, and "
    "0.88 a^(1/6) above 1.7, whatever the grains: G. Lube, H. E. Huppert, R. S. J. Sparks and M. A. Hallworth, *J. "
    "Fluid Mech.* 508 (2004) 175, as it is quoted; in between the smaller of both is taken. E. Lajeunesse and others "
    "(2005) have the same form. J. M. Warnett and others, *Granular Matter* 16 (2014) 115: the runout also depends "
    "on radius over grain size.",
    reason="20 % was wished for. Heights are met, and every runout is missed: 0.55 to 0.73 of the law. Few and "
    "coarse blocks interlock, and a front of single blocks is cut off where they lie further apart than their side; "
    "more friction and contacts that do not bounce may add to it. How much each does is not known. The farthest "
    "single blocks lie at 0.9 to 1.2 of the radius that the law has. So a pile of debris covers less ground here "
    "than loose grains would, while single pieces go as far.",
    run=run,
)
