"""Blast zones in views and pictures: their boxes and drill holes as lines or rods, coloured by when they fire."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..engineering.drilled_charges.drill_holes import hole_positions_m
from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import box
from ..engineering.geometry.vectors import SIDES
from ..model.structure.blast_zones import PlacedZone
from .colour_scale import ColourMap, colours

COLOUR_MAP = ColourMap.VIRIDIS

_EDGE_M = 0.06
"""Width of edges in pictures of a whole bridge, which have some cm a pixel."""

_STICK_OUT_M = 0.12

_EDGES = np.array([(0, 1), (0, 2), (0, 4), (1, 3), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 6), (5, 7), (6, 7)])
"""Edges between the corners of a box, which are counted in binary along z, y and x."""


def box_lines(box_m: np.ndarray) -> np.ndarray:
    """Return the edges of a box (2, 3) as lines (24, 3) float, m."""
    numbers = np.arange(8)
    corners = np.stack([box_m[numbers >> (2 - axis) & 1, axis] for axis in range(3)], axis=1)
    return corners[_EDGES.ravel()]


def hole_lines(placed: PlacedZone) -> np.ndarray:
    """Return the drill holes of a zone as lines (2 h, 3) float, m, from the drilled side inwards."""
    zone = placed.zone
    along, drilled, across = zone.axes
    middle = placed.box_m.mean(axis=0)
    of_holes = hole_positions_m(zone.rows, zone.holes_a_row, zone.spacing_m, placed.row_spacing_m).reshape(-1, 2)
    sign = SIDES[zone.side][1]
    mouths = np.tile(middle, (len(of_holes), 1))
    mouths[:, along] += of_holes[:, 0]
    mouths[:, across] += of_holes[:, 1]
    mouths[:, drilled] = placed.box_m[1 if sign > 0 else 0, drilled]
    ends = mouths.copy()
    ends[:, drilled] -= np.sign(sign) * zone.depth_m
    return np.stack((mouths, ends), axis=1).reshape(-1, 3)


def rods(lines: np.ndarray, width_m: float) -> TriangleMesh:
    """Return lines (2 k, 3) along the axes as square rods of a width, which stick out by half of it at their ends."""
    ends = lines.reshape(-1, 2, 3)
    lowest, highest = ends.min(axis=1) - width_m / 2.0, ends.max(axis=1) + width_m / 2.0
    solids = [
        box((high - low).tolist(), ((low + high) / 2.0).tolist()) for low, high in zip(lowest, highest, strict=True)
    ]
    begins = np.cumsum([0, *(len(solid.vertices) for solid in solids)])
    return TriangleMesh(
        np.concatenate([np.zeros((0, 3)), *(solid.vertices for solid in solids)]),
        np.concatenate(
            [np.zeros((0, 3), int), *(solid.triangles + begin for solid, begin in zip(solids, begins, strict=False))]
        ),
    )


def zone_rods(placed: PlacedZone) -> TriangleMesh:
    """Return the edges of a zone, outside its member, and its drill holes, which stick out of their mouths."""
    edges = box_lines(placed.box_m + np.array([[-1.0], [1.0]]) * _EDGE_M / 2.0)
    holes = hole_lines(placed)
    drilled, sign = placed.zone.axes[1], SIDES[placed.zone.side][1]
    holes[::2, drilled] += np.sign(sign) * _STICK_OUT_M
    parts = rods(edges, _EDGE_M), rods(holes, max(placed.zone.hole_diameter_m, _EDGE_M))
    return TriangleMesh(
        np.concatenate([part.vertices for part in parts]),
        np.concatenate((parts[0].triangles, parts[1].triangles + len(parts[0].vertices))),
    )


def flash_of(placed: PlacedZone) -> TriangleMesh:
    """Return what flashes as a zone fires: a box around it."""
    size_m = np.diff(placed.box_m, axis=0)[0] + 2.0 * _STICK_OUT_M
    return box(size_m.tolist(), placed.box_m.mean(axis=0).tolist())


def delay_colours(zones: Sequence[PlacedZone]) -> np.ndarray:
    """Return colours (z, 3) of zones by their delays, from the first to the last."""
    delays = np.array([placed.zone.delay_ms for placed in zones])
    span = float(np.ptp(delays)) if len(delays) else 0.0
    return colours(COLOUR_MAP, (delays - delays.min(initial=0.0)) / span if span else np.zeros(len(delays)))
