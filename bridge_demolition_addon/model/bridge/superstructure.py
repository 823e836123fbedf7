"""The deck as solids: slabs, girders under them, and box girders."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.solids import box, difference, union
from ..scenario import Bridge
from ..schema import given
from .layout import deck_ends, deck_top, deck_underside, skewed, slab_underside, without_shear
from .member import Member
from .substructure import deck_profile

_BEYOND_M = 1.0
"""How far what is cut out of a box girder extends beyond its ends: any length does that leaves no skin there."""


def superstructure(bridge: Bridge) -> list[Member]:
    """Every deck, a box girder with its slab, and every girder."""
    ends = deck_ends(bridge)
    parts = []
    for number, (begin, end) in enumerate(ends, start=1):
        prefix = f"span {number} " if len(ends) > 1 else ""
        parts.append(_deck(bridge, f"{prefix}deck", begin, end))
        for girder in range(bridge.girders.number if bridge.girders else 0):
            solid = skewed(bridge, _girder(bridge, begin, end, girder))
            parts.append(Member(f"{prefix}girder {girder + 1}", "girder", solid, unskewed=without_shear(bridge)))
    return parts


def cast_decks(bridge: Bridge) -> Iterator[tuple[str, list[str]]]:
    """Yield the names of decks and of the girders that each is cast with."""
    decks, number = len(deck_ends(bridge)), bridge.girders.number if bridge.girders else 0
    for prefix in [f"span {span} " for span in range(1, decks + 1)] if decks > 1 else [""]:
        yield f"{prefix}deck", [f"{prefix}girder {girder}" for girder in range(1, number + 1)]


def _deck(bridge: Bridge, name: str, begin: float, end: float) -> Member:
    if bridge.frame and bridge.frame.is_haunched:
        profile, width = deck_profile(bridge, begin, end), bridge.deck.width_m
        return Member(name, "deck", profile.solid(width), parts=profile.pieces(width), is_in_pieces=True)
    if not bridge.box_girder:
        slab, strips = skewed(bridge, _slab(bridge, begin, end)), tuple(_strips(bridge, begin, end))
        return Member(name, "deck", slab, parts=strips, unskewed=without_shear(bridge))
    plates = (skewed(bridge, plate) for plate in _plates(bridge, begin, end))
    solid = skewed(bridge, _box_girder(bridge, begin, end))
    return Member(name, "deck", solid, parts=tuple(plates), unskewed=without_shear(bridge))


def _slab(bridge: Bridge, begin: float, end: float) -> TriangleMesh:
    deck = bridge.deck
    middle = ((begin + end) / 2.0, 0.0, slab_underside(bridge) + deck.thickness_m / 2.0)
    return box((end - begin, deck.width_m, deck.thickness_m), middle)


def _strips(bridge: Bridge, begin: float, end: float) -> Iterator[TriangleMesh]:
    """Yield the slab in a strip above each girder: a shard that lay on two would hold both as one body."""
    number = bridge.girders.number if bridge.girders else 1
    if number == 1:
        return
    deck, edge = bridge.deck, 0.5 * bridge.deck.width_m
    inner = [bridge.girder_spacing_m * (girder - 0.5 * number) for girder in range(1, number)]
    height = slab_underside(bridge) + deck.thickness_m / 2.0
    for right, left in pairwise((-edge, *inner, edge)):
        middle = ((begin + end) / 2.0, (right + left) / 2.0, height)
        yield skewed(bridge, box((end - begin, left - right, deck.thickness_m), middle))


def _girder(bridge: Bridge, begin: float, end: float, girder: int) -> TriangleMesh:
    girders = given(bridge.girders)
    across = bridge.girder_spacing_m * (girder - (girders.number - 1) / 2.0)
    middle = ((begin + end) / 2.0, across, deck_underside(bridge) + girders.depth_m / 2.0)
    return box((end - begin, girders.width_m, girders.depth_m), middle)


def _box_girder(bridge: Bridge, begin: float, end: float) -> TriangleMesh:
    """Slab and box in one, with the cells cut out; what is united overlaps, so that no two faces coincide."""
    girder, bottom, top = given(bridge.box_girder), deck_underside(bridge), deck_top(bridge)
    middle, length = (begin + end) / 2.0, end - begin
    into_slab = (slab_underside(bridge) + top) / 2.0
    body = box((length, girder.width_m, into_slab - bottom), (middle, 0.0, (into_slab + bottom) / 2.0))
    floor, ceiling = bottom + girder.bottom_thickness_m, slab_underside(bridge)
    cells = [
        box(
            (length + 2.0 * _BEYOND_M, girder.cell_width_m, ceiling - floor),
            (middle, across, (floor + ceiling) / 2.0),
        )
        for across in _cell_axes(bridge)
    ]
    return difference(union([_slab(bridge, begin, end), body]), cells)


def _plates(bridge: Bridge, begin: float, end: float) -> list[TriangleMesh]:
    """The slab, the webs and the bottom slab, which together are the box girder."""
    girder, bottom, ceiling = given(bridge.box_girder), deck_underside(bridge), slab_underside(bridge)
    middle, length, floor = (begin + end) / 2.0, end - begin, bottom + girder.bottom_thickness_m
    spacing = girder.cell_width_m + girder.web_thickness_m
    webs = [
        box(
            (length, girder.web_thickness_m, ceiling - floor),
            (middle, spacing * (web - girder.cells / 2.0), (floor + ceiling) / 2.0),
        )
        for web in range(girder.cells + 1)
    ]
    bottom_slab = box((length, girder.width_m, girder.bottom_thickness_m), (middle, 0.0, (bottom + floor) / 2.0))
    return [_slab(bridge, begin, end), *webs, bottom_slab]


def _cell_axes(bridge: Bridge) -> list[float]:
    girder = given(bridge.box_girder)
    spacing = girder.cell_width_m + girder.web_thickness_m
    return [spacing * (cell - (girder.cells - 1) / 2.0) for cell in range(girder.cells)]
