"""Links in the webs of box girders whose plates are cut across together.

A beam with links resists shear as a truss, whose cracks are inclined and cross the links: V = A_sw / s · z f_y cot θ
(EN 1992-1-1:2004, equation 6.8). A cut square to the beam crosses none, and no bars lie in these webs; one along a web
crosses them, but not by as much as struts do that go through it. So bars that are spread evenly over both stand for the
truss: pressed by these, faces rub with its shear.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.geometry.vectors import dot, unit
from ...engineering.reinforced_concrete.resistance import FRICTION_ALONG_CRACK
from ..materials import BarLayer
from ..scenario.bridge_checks import deck_underside, slab_underside
from ..schema import SHORTEST_LENGTH_M
from .connection_source import ConnectionRows, CutBridge
from .member_layers import spread_bars

_COT_STRUT = 2.5
"""Of the flattest struts, which links by rule are designed with: EN 1992-1-1:2004, 6.2.3 (2)."""

_SQUARE = 1e-6
"""Sine up to which a cut is square to a box girder: those of chance are not."""


@dataclass(frozen=True, slots=True, eq=False)
class WebLinks:
    """Forces (m,) at which bars across m connections yield, 0 without any, and openings (m,) of rupture."""

    yield_n: np.ndarray
    openings_m: np.ndarray


def web_links(cut: CutBridge, layers: Sequence[BarLayer], rows: ConnectionRows) -> WebLinks | None:
    """Return the bars that stand for the trusses of webs; None where no box girder is cut square."""
    bridge, settings, strength = cut.scenario.bridge, cut.scenario.connections, cut.scenario.joints[0].strength
    if bridge is None or bridge.box_girder is None or strength is None:
        return None
    yield_n, openings = np.zeros((2, len(rows)))
    floor_m, ceiling_m = deck_underside(bridge) + bridge.box_girder.bottom_thickness_m, slab_underside(bridge)
    normals, of_pair = rows.connections.normals, cut.members_of(rows.connections.pairs)
    for spread in spread_bars(layers, cut.members):
        member = cut.members[spread.member]
        if member.kind != "deck" or spread.layer.along != "z" or spread.layer.ratio <= 0.0:
            continue
        level_m = member.without_skew(rows.connections.points)[:, 2]
        of_webs = (of_pair == spread.member).all(axis=1)
        of_webs &= (level_m > floor_m - SHORTEST_LENGTH_M) & (level_m < ceiling_m + SHORTEST_LENGTH_M)
        across, up = unit(member.with_skew(np.eye(3)[1])), abs(normals[:, 2])
        is_square = of_webs & (abs(dot(normals, across)) < _SQUARE) & (up < _SQUARE)
        is_level = of_webs & (up > 1.0 - _SQUARE)
        if not is_square.any():
            continue
        of_truss = _COT_STRUT / FRICTION_ALONG_CRACK
        parts = np.where(is_square, of_truss, np.where(is_level, of_truss - 1.0, 0.0))
        links_pa = settings.strength_factor * spread.layer.ratio * spread.layer.yield_pa
        yield_n += parts * links_pa * rows.connections.areas
        opening_m = settings.ductile_elongation_m
        if opening_m is None:
            opening_m = spread.opening_m(float(strength.compression_pa), cut.scenario.steel)
        openings[is_square | is_level] = opening_m
    return WebLinks(yield_n, openings) if yield_n.any() else None
