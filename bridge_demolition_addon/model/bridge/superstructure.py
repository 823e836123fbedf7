"""The deck as solids: slabs, girders under them, and box girders."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.road_lines import road_prism
from ...engineering.geometry.solids import box, difference, union
from ..scenario import Bridge
from ..scenario.bridge_checks import deck_top, deck_underside, road_line, slab_underside
from ..scenario.half_joints import DeckPart
from ..schema import SHORTEST_LENGTH_M, given
from .layout import deck_ends, deck_prefixes, parts_of_deck, placed, skewed, without_shear
from .member import Member
from .substructure import deck_profile

_STRAIGHT_M = 0.02
"""How far corners of a deck may be off a straight piece: hulls of its shards overlap by less than that."""

_BEYOND_M = 1.0
"""How far what is cut out of a box girder extends beyond its ends: any length does that leaves no skin there."""


def superstructure(bridge: Bridge) -> list[Member]:
    """Every deck, a box girder with its slab, and every girder."""
    members, line, own = [], road_line(bridge), without_shear(bridge)
    for number, (prefix, (begin, end)) in enumerate(zip(deck_prefixes(bridge), deck_ends(bridge), strict=True)):
        part = parts_of_deck(bridge)[number] if bridge.half_joints else None
        if part and not bridge.girders:
            members.append(_with_nibs(bridge, f"{prefix}deck", "deck", part, 0.0, bridge.deck.width_m))
        else:
            members.append(_deck(bridge, f"{prefix}deck", begin, end))
        for girder in range(bridge.girders.number if bridge.girders else 0):
            name = f"{prefix}girder {girder + 1}"
            if part:
                across = _girder_axes(bridge)[girder]
                members.append(_with_nibs(bridge, name, "girder", part, across, given(bridge.girders).width_m))
                continue
            solid = placed(bridge, _girder(bridge, begin, end, girder))
            members.append(Member(name, "girder", solid, unskewed=own, line=line))
    return members


def _with_nibs(bridge: Bridge, name: str, kind: str, part: DeckPart, across_m: float, width_m: float) -> Member:
    """Return a part of a slab or of a girder with the nibs by which it lies on others, or these on it."""
    low, high = deck_underside(bridge), slab_underside(bridge) if kind == "girder" else deck_top(bridge)
    middle = 0.5 * (low + high)

    def piece(along_m: tuple[float, float], below: float, above: float, beyond_m: float = 0.0) -> TriangleMesh:
        (begin, end), wide = along_m, width_m + 2.0 * beyond_m
        size = (end - begin, wide, above - below)
        sides = [across_m - 0.5 * width_m, across_m + 0.5 * width_m] if beyond_m else []
        return _along_road(bridge, size, ((begin + end) / 2.0, across_m, (below + above) / 2.0), sides)

    begin, end = part.whole_m
    cut = []
    for nibs, below, above in (
        (part.lower_nibs_m, middle, high + _BEYOND_M),
        (part.upper_nibs_m, low - _BEYOND_M, middle),
    ):
        for first, last in nibs:
            at = (first - _BEYOND_M, part.begin_m) if last <= part.begin_m else (part.end_m, last + _BEYOND_M)
            cut.append(placed(bridge, piece(at, below, above, _BEYOND_M)))
    bodies = [(part.begin_m, part.end_m)]
    if kind == "deck":
        bodies = _straight_pieces(bridge, *bodies[0])
    pieces = [
        *(piece(body, low, high) for body in bodies),
        *(piece(nib, low, middle) for nib in part.lower_nibs_m),
        *(piece(nib, middle, high) for nib in part.upper_nibs_m),
    ]
    return Member(
        name,
        kind,
        difference(placed(bridge, piece((begin, end), low, high)), cut),
        parts=tuple(placed(bridge, one) for one in pieces),
        unskewed=without_shear(bridge),
        line=road_line(bridge),
        takes_all_parts=True,
    )


def cast_decks(bridge: Bridge) -> Iterator[tuple[str, list[str]]]:
    """Yield the names of decks and of the girders that each is cast with."""
    number = bridge.girders.number if bridge.girders else 0
    for prefix in deck_prefixes(bridge):
        yield f"{prefix}deck", [f"{prefix}girder {girder}" for girder in range(1, number + 1)]


def _deck(bridge: Bridge, name: str, begin: float, end: float) -> Member:
    if bridge.frame and bridge.frame.is_haunched:
        profile, width = deck_profile(bridge, begin, end), bridge.deck.width_m
        return Member(name, "deck", profile.solid(width), parts=profile.pieces(width), is_in_pieces=True)
    own, line = without_shear(bridge), road_line(bridge)
    if not bridge.box_girder:
        slab = placed(bridge, _slab(bridge, begin, end))
        parts = tuple(placed(bridge, strip) for strip in _strips(bridge, begin, end))
        return Member(name, "deck", slab, parts=parts, unskewed=own, line=line)
    pieces = _straight_pieces(bridge, begin, end)
    plates = tuple(placed(bridge, plate) for piece in pieces for plate in _plates(bridge, *piece))
    solid, is_cut = _box_girder(bridge, begin, end), len(pieces) > 1
    return Member(name, "deck", solid, parts=plates, unskewed=own, line=line, takes_all_parts=is_cut)


def _along_road(
    bridge: Bridge, size_m: Sequence[float], middle_m: Sequence[float], across_m: Sequence[float] = ()
) -> TriangleMesh:
    """Return a box along the road with corners where that bends, and at more positions across it."""
    (begin, right, low), (end, left, high) = (
        [middle + side * size for middle, size in zip(middle_m, size_m, strict=True)] for side in (-0.5, 0.5)
    )
    bends = _bends(bridge, begin, end)
    if len(bends) == 2:
        return box(size_m, middle_m)
    return road_prism(bends, [right, *across_m, left], [low] * len(bends), [high] * len(bends))


def _bends(bridge: Bridge, begin: float, end: float) -> list[float]:
    """Return the positions along the road from a begin to an end at which what lies there has corners."""
    line = road_line(bridge)
    if line is None:
        return [begin, end]
    # Of what is warped, all that touches has corners where a girder ends.
    of_parts = [place for part in parts_of_deck(bridge) for place in (part.begin_m, part.end_m, *part.whole_m)]
    places = sorted({*line.stations_m.tolist(), *(of_parts if bridge.half_joints else ())})
    return [begin, *(place for place in places if begin < place < end), end]


def _straight_pieces(bridge: Bridge, begin: float, end: float) -> list[tuple[float, float]]:
    """Return the longest pieces of a deck along the road whose underside is straight but for what matters to no hull.

    On a curve in plan hulls of shards that lie on each other have nothing in common.
    """
    bends, line = _bends(bridge, begin, end), road_line(bridge)
    if line is None:
        return [(begin, end)]
    below = np.column_stack((bends, np.zeros(len(bends)), np.full(len(bends), deck_underside(bridge))))
    heights, corners = line.to_world(below)[:, 2], [0]
    for last in range(2, len(bends)):
        first = corners[-1]
        on_chord = np.interp(bends[first:last], (bends[first], bends[last]), (heights[first], heights[last]))
        if abs(heights[first:last] - on_chord).max() > _STRAIGHT_M:
            corners.append(last - 1)
    return list(pairwise([*(bends[corner] for corner in corners), end]))


def _slab(bridge: Bridge, begin: float, end: float) -> TriangleMesh:
    deck = bridge.deck
    middle = ((begin + end) / 2.0, 0.0, slab_underside(bridge) + deck.thickness_m / 2.0)
    return _along_road(bridge, (end - begin, deck.width_m, deck.thickness_m), middle, _slab_edges(bridge)[1:-1])


def _slab_edges(bridge: Bridge) -> list[float]:
    """Return the positions across the road of edges of the slab, its strips and the girders below."""
    half, below = 0.5 * bridge.deck.width_m, []
    if bridge.box_girder:
        outer = 0.5 * bridge.box_girder.width_m
        below = [-outer, *_cell_edges(bridge), outer]
    elif bridge.girders:
        sides = (-0.5 * bridge.girders.width_m, 0.5 * bridge.girders.width_m)
        below = [middle + side for middle in _girder_axes(bridge) for side in sides]
    edges = [-half]
    for edge in sorted([*below, *_strip_edges(bridge)]):
        if edges[-1] + SHORTEST_LENGTH_M < edge < half - SHORTEST_LENGTH_M:
            edges.append(edge)
    return [*edges, half]


def _strips(bridge: Bridge, begin: float, end: float) -> Iterator[TriangleMesh]:
    """Yield the slab in a strip above each girder: a shard that lay on two would hold both as one body.

    Without girders it is in pieces that are nearly straight.
    """
    inner, pieces = _strip_edges(bridge), _straight_pieces(bridge, begin, end)
    deck, edge = bridge.deck, 0.5 * bridge.deck.width_m
    height = slab_underside(bridge) + deck.thickness_m / 2.0
    if not inner and len(_bends(bridge, begin, end)) > 2:
        yield from (_slab(bridge, *piece) for piece in pieces)
    for right, left in pairwise((-edge, *inner, edge) if inner else ()):
        middle = ((begin + end) / 2.0, (right + left) / 2.0, height)
        own = [side for side in _slab_edges(bridge) if right < side < left]
        yield _along_road(bridge, (end - begin, left - right, deck.thickness_m), middle, own)


def _strip_edges(bridge: Bridge) -> list[float]:
    """Return the positions across the road between strips, half-way between girders."""
    number = bridge.girders.number if bridge.girders else 1
    return [bridge.girder_spacing_m * (girder - 0.5 * number) for girder in range(1, number)]


def _girder(bridge: Bridge, begin: float, end: float, girder: int) -> TriangleMesh:
    girders = given(bridge.girders)
    middle = ((begin + end) / 2.0, _girder_axes(bridge)[girder], deck_underside(bridge) + girders.depth_m / 2.0)
    return _along_road(bridge, (end - begin, girders.width_m, girders.depth_m), middle)


def _girder_axes(bridge: Bridge) -> list[float]:
    girders = given(bridge.girders)
    return [bridge.girder_spacing_m * (girder - (girders.number - 1) / 2.0) for girder in range(girders.number)]


def _box_girder(bridge: Bridge, begin: float, end: float) -> TriangleMesh:
    """Slab and box in one, in place, with the cells cut out; what is united overlaps, so that no faces coincide."""
    girder, bottom, top = given(bridge.box_girder), deck_underside(bridge), deck_top(bridge)
    middle, length = (begin + end) / 2.0, end - begin
    into_slab = (slab_underside(bridge) + top) / 2.0
    size = (length, girder.width_m, into_slab - bottom)
    body = _along_road(bridge, size, (middle, 0.0, (into_slab + bottom) / 2.0), _cell_edges(bridge))
    floor, ceiling = bottom + girder.bottom_thickness_m, slab_underside(bridge)
    cells = [
        _along_road(
            bridge,
            (length + 2.0 * _BEYOND_M, girder.cell_width_m, ceiling - floor),
            (middle, across, (floor + ceiling) / 2.0),
        )
        for across in _cell_axes(bridge)
    ]
    solids = [_slab(bridge, begin, end), body]
    if (line := road_line(bridge)) is None:
        return skewed(bridge, difference(union(solids), cells))
    return difference(union([line.carried(solid) for solid in solids]), [line.carried(cell) for cell in cells])


def _plates(bridge: Bridge, begin: float, end: float) -> list[TriangleMesh]:
    """The slab, the webs and the bottom slab, which together are the box girder."""
    girder, bottom, ceiling = given(bridge.box_girder), deck_underside(bridge), slab_underside(bridge)
    middle, length, floor = (begin + end) / 2.0, end - begin, bottom + girder.bottom_thickness_m
    spacing = girder.cell_width_m + girder.web_thickness_m
    webs = [
        _along_road(
            bridge,
            (length, girder.web_thickness_m, ceiling - floor),
            (middle, spacing * (web - girder.cells / 2.0), (floor + ceiling) / 2.0),
        )
        for web in range(girder.cells + 1)
    ]
    size = (length, girder.width_m, girder.bottom_thickness_m)
    bottom_slab = _along_road(bridge, size, (middle, 0.0, (bottom + floor) / 2.0), _cell_edges(bridge))
    return [_slab(bridge, begin, end), *webs, bottom_slab]


def _cell_axes(bridge: Bridge) -> list[float]:
    girder = given(bridge.box_girder)
    spacing = girder.cell_width_m + girder.web_thickness_m
    return [spacing * (cell - (girder.cells - 1) / 2.0) for cell in range(girder.cells)]


def _cell_edges(bridge: Bridge) -> list[float]:
    half = 0.5 * given(bridge.box_girder).cell_width_m
    return [axis + side for axis in _cell_axes(bridge) for side in (-half, half)]
