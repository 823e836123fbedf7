"""Members of steelwork: a bar for each table, a node with its plates where bars meet, and decks on girders."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.solids import box, from_manifold, hull
from ...engineering.geometry.vectors import transformed, unit
from ...engineering.steelwork.bars import SteelBar, bar_axes, extruded, node_points, node_radius_m
from ...errors import GeometryError
from ..scenario.bearings import FIXED
from ..scenario.girders import DECK_KIND, GIRDER_KIND, GirderSpan
from ..scenario.steelwork import NODE_KIND, TURNS, SteelMember, SteelNode, Steelwork, axis_m
from ..schema import given
from .member import Member, SteelPart

_MOST_WITHIN = 0.45
"""Part of a bar that may lie within the plates of one node."""


def steelwork_members(steelwork: Steelwork | None) -> tuple[Member, ...]:
    """Return all decks on girders, then all bars, and then all nodes."""
    if steelwork is None:
        return ()
    places = {node.name: np.array(node.position_m) for node in steelwork.all_nodes}
    axes = {table.name: _axes(table, places) for table in steelwork.all_members}
    ends = {node.name: _ends_at(node, steelwork.all_members, axes) for node in steelwork.all_nodes}
    radii = {node.name: _radius_m(node, ends[node.name]) for node in steelwork.all_nodes}
    for span in steelwork.girders:  # pieces of girders side by side end in one plane, and so do shards of the deck
        for names in span.points_of():
            radii |= dict.fromkeys(names, max(radii[name] for name in names))
    fixed = {node.name: _held_end(node, steelwork.all_members) for node in steelwork.all_nodes}
    bars = [_bar(steelwork, table, places, axes[table.name], radii, fixed) for table in steelwork.all_members]
    end_nodes = {name for span in steelwork.girders for name in span.end_nodes}
    nodes = [
        _node(steelwork, node, ends[node.name], radii[node.name], goes_on=node.name in end_nodes)
        for node in steelwork.all_nodes
    ]
    decks = [_deck(span, {bar.name: given(bar.steel) for bar in bars}) for span in steelwork.decks]
    return (*decks, *bars, *nodes)


@dataclass(frozen=True, slots=True, eq=False)
class _End:
    """A bar at a node.

    Attributes
    ----------
    direction : (3,) float
        Unit vector away from the node.
    to_axis_m : (3,) float
        From the node to the end of its axis.
    outline : (p, 3) float
        Corners of its section, about its axis.
    """

    table: SteelMember
    direction: np.ndarray
    to_axis_m: np.ndarray
    outline: np.ndarray

    @property
    def at_node(self) -> np.ndarray:
        """Outline (p, 3) about the node."""
        return self.to_axis_m + self.outline


def _axes(table: SteelMember, places: dict[str, np.ndarray]) -> np.ndarray:
    begin, end = axis_m(table, places)
    return bar_axes(begin, end, math.radians(table.roll_deg))


def _ends_at(node: SteelNode, tables: Sequence[SteelMember], axes: dict[str, np.ndarray]) -> list[_End]:
    ends = []
    for table in tables:
        own = axes[table.name]
        for name, sign, to_axis_m in zip(table.nodes, (1.0, -1.0), table.from_nodes_m, strict=True):
            if name == node.name:
                outline = transformed(own[:, 1:], np.concatenate(table.steel_section.rings))
                ends.append(_End(table, sign * own[:, 0], to_axis_m, outline))
    return ends


def _radius_m(node: SteelNode, ends: Sequence[_End]) -> float:
    if node.radius_m is not None:
        return node.radius_m
    return node_radius_m(
        np.array([end.direction for end in ends]),
        [end.outline for end in ends],
        np.array([end.to_axis_m for end in ends]),
    )


def _held_end(node: SteelNode, tables: Sequence[SteelMember]) -> str | None:
    """Return the bar that the node turns with, where all of them turn freely and no support holds it.

    Else nothing would keep the node from turning. Its bar carries no moment for that, as all others are pinned at the
    node itself.
    """
    at_node = [table for table in tables if node.name in table.nodes]
    is_free = all(table.ends[table.nodes.index(node.name)] != FIXED for table in at_node)
    return at_node[0].name if is_free and node.support != FIXED else None


def _bar(
    steelwork: Steelwork,
    table: SteelMember,
    places: dict[str, np.ndarray],
    axes: np.ndarray,
    radii: dict[str, float],
    fixed: dict[str, str | None],
) -> Member:
    begin, end = axis_m(table, places)
    within = np.array([radii[name] for name in table.nodes])
    turns = np.array(
        [
            TURNS[FIXED if fixed[name] == table.name else joined]
            for name, joined in zip(table.nodes, table.ends, strict=True)
        ]
    )
    bow_m = steelwork.bow_m(table, math.dist(begin, end))
    bar = SteelBar(table.steel_section, begin, end, axes, within, turns, steelwork.pieces_of(table), bow_m)
    for name, inside in zip(table.nodes, within.tolist(), strict=True):
        if inside > _MOST_WITHIN * bar.length_m:
            raise GeometryError(
                f"{table.name} is {bar.length_m:.4g} m long, and would begin {inside:.3g} m from the node {name}, so "
                "that no bar there lies in another: move the nodes, or give steelwork.nodes.radius_m"
            )
    ends = bar.at(bar.cuts_m[[0, -1]])
    solid = extruded(bar.section, axes, ends[0], ends[1])
    part = SteelPart(0.5 * (ends[0] + ends[1]), bar, table.nodes)
    return Member(table.name, table.kind, solid, steelwork.density_kg_m3, steel=part)


def _deck(span: GirderSpan, bars: dict[str, SteelPart]) -> Member:
    """Return the deck on girders, in parts that end where pieces of the girders do."""
    of_girder = [given(bars[keys["name"]].bar) for keys in span.bars_of(span.girder_names[0])]
    cuts = sorted(bar.begin_m[0] + along for bar in of_girder for along in bar.cuts_m.tolist())
    begin = span.position_m[0]
    limits = [begin, *cuts, begin + span.length_m]
    parts = tuple(_deck_part(span, *ends) for ends in pairwise(limits))
    solid = _deck_part(span, limits[0], limits[-1])
    return Member(span.deck_name, DECK_KIND, solid, span.deck_density_kg_m3, parts, keeps_parts=True)


def _deck_part(span: GirderSpan, begin_m: float, end_m: float) -> TriangleMesh:
    _, middle, bottom = span.position_m
    thickness = given(span.deck_thickness_m)
    size = (end_m - begin_m, given(span.deck_width_m), thickness)
    return box(size, (0.5 * (begin_m + end_m), middle, bottom + 0.5 * thickness))


def _node(steelwork: Steelwork, node: SteelNode, ends: Sequence[_End], radius_m: float, *, goes_on: bool) -> Member:
    """Return a node; at the end of girders its plates go on behind it, so that the deck lies on their flanges there."""
    plates = [(unit(end.direction), end.at_node) for end in ends]
    if goes_on:
        plates += [(-unit(end.direction), end.at_node) for end in ends if end.table.kind == GIRDER_KIND]
    points = node_points(plates, radius_m)
    place = np.array(node.position_m)
    solid = from_manifold(hull(place + points))
    steel_m3 = radius_m * math.fsum(end.table.steel_section.area_m2 for end in ends)
    mass_kg = steelwork.density_kg_m3 * steel_m3 + node.mass_kg
    return Member(node.name, NODE_KIND, solid, mass_kg / solid.volume, steel=SteelPart(place))
