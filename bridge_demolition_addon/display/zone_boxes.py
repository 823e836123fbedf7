"""Blast zones in a view: their boxes and drill holes as lines, coloured by when they fire."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..engineering.drilled_charges.drill_holes import hole_positions_m
from ..engineering.geometry.sides import SIDES
from ..model.structure.blast_zones import PlacedZone
from .colour_scale import ColourMap, colours

COLOUR_MAP = ColourMap.VIRIDIS

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


def delay_colours(zones: Sequence[PlacedZone]) -> np.ndarray:
    """Return colours (z, 3) of zones by their delays, from the first to the last."""
    delays = np.array([placed.zone.delay_ms for placed in zones])
    span = float(np.ptp(delays)) if len(delays) else 0.0
    return colours(COLOUR_MAP, (delays - delays.min(initial=0.0)) / span if span else np.zeros(len(delays)))
