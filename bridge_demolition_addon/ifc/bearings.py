"""Bearings of a file: the members below and above each, and the motions that it leaves free."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh, triangle_areas_and_normals
from ..engineering.geometry.solids import from_manifold, to_manifold, union
from ..engineering.geometry.vectors import transformed
from ..model.scenario import ConnectionBetween
from ..model.scenario.bearings import FIXED, PINNED, ROCKER, SLIDING, Bearing
from .contacts import TOUCHING_M, NearbyMembers
from .elements import Element
from .gaps import STEEPEST, cut_by, largest_body, lengthened
from .library import library
from .missing_references import CONTRADICTIONS
from .placement import Placement

SEAT_M = 0.001
"""How far a bearing is let into what it lies on, so that the two become one solid in spite of rounding."""

HIGHEST_PLINTH_M = 0.5
"""Height up to which what a bearing stands on is taken for a plinth that the file lacks."""

HIGHEST_PLATE_M = 0.1
"""Gap up to which what lies on a bearing is taken to have a plate under it that the file lacks, such as a wedge."""

_LOOKS_UP = 0.9
"""Least vertical part of the normal of a face that a plinth stands on."""

_ALL_TURNS = ("turn x", "turn y", "turn z")
_FREE_OF_TYPE = {
    "CYLINDRICAL": ("turn y",),
    "DISK": _ALL_TURNS,
    "ELASTOMERIC": ("turn x", "turn y"),
    "GUIDE": ("move x", *_ALL_TURNS),
    "POT": _ALL_TURNS,
    "ROCKER": ("turn y",),
    "ROLLER": ("move x", "turn y"),
    "SPHERICAL": _ALL_TURNS,
}
"""Motions that types of IfcBearing leave free, x along the road and y across it."""

_FREE_OTHERWISE = ("turn y",)
_UNKNOWN = "the file does not say what it leaves free, taken for turn y"

_KIND_OF_MOVES = {
    frozenset(): PINNED,
    frozenset({"move x"}): ROCKER,
    frozenset({"move x", "move y"}): SLIDING,
}
"""Kinds of bearings that rotate, by the motions that they leave free."""

_PROPERTIES = {"move": "DisplacementAccommodated", "turn": "RotationAccommodated"}
"""Of Pset_BearingCommon: three truths each, along the bearing's own x, y and z."""


@dataclass(frozen=True, slots=True)
class BearingElement:
    """A bearing between members, given by their numbers in the list of members.

    It becomes part of the member below; with nothing below, `below` is None, and a support has to be made for it. The
    solid touches all of them. `source` says where its free motions are from, and `closed` which gaps were closed.
    """

    below: int | None
    above: tuple[int, ...]
    solid: TriangleMesh
    free: tuple[str, ...]
    source: str
    closed: str = ""
    is_assumed: bool = False
    """Whether the file does not say what it leaves free."""


def bearing_of(
    element: Element,
    solid: TriangleMesh,
    contacts: NearbyMembers,
    names: Sequence[str],
    placement: Placement,
    gap_m: float,
) -> BearingElement | str:
    """Return what a bearing with a solid connects of the members with these names, or why it is left out.

    Gaps up to `gap_m` above and below it are closed.
    """
    down, up = contacts.reached(solid, -TOUCHING_M), contacts.reached(solid, TOUCHING_M)
    # One that it is sunk into, or that is sunk into it, lies on the side that it reaches further into.
    below = sorted((index for index in down if down[index] > up.get(index, 0.0)), key=lambda index: -down[index])
    above = sorted(index for index in up if up[index] > down.get(index, 0.0))
    closed, plinth = [], ""
    if not below and gap_m > 0.0:
        under = contacts.reached(lengthened(solid, -gap_m), 0.0)
        below = sorted(under.keys() - set(above), key=lambda index: -under[index])[:1]
        if below:
            solid = lengthened(solid, -gap_m - SEAT_M)
            closed.append(names[below[0]])
        else:
            under = contacts.reached(lengthened(solid, -HIGHEST_PLINTH_M), 0.0)
            below = sorted(under.keys() - set(up), key=lambda index: -under[index])[:1]
            if below:
                solid = on_plinth(solid, contacts.solid(below[0]))
                plinth = f"a plinth down to {names[below[0]]} is added under it"
    if not above and gap_m > 0.0:
        above, over_m = _nearest_above(solid, contacts, set(below), gap_m)
        if above:
            reach_m = over_m + STEEPEST * float(np.ptp(solid.vertices[:, :2], axis=0).max())
            solid = cut_by(lengthened(solid, reach_m), [contacts.solid(index) for index in above])
            if over_m > gap_m:
                plinth = "; ".join(filter(None, (plinth, f"a plate up to {names[above[0]]} is added on it")))
            else:
                closed.append(names[above[0]])
    if not above or (not below and gap_m <= 0.0):
        return f"nothing touches it from {'above' if below else 'below'}{_gaps(solid, contacts, names)}"
    free, source = free_motions(element, placement)
    text = f"made thicker, by up to {1e3 * gap_m:g} mm, to touch {' and '.join(closed)}" if closed else ""
    text = "; ".join(filter(None, (text, plinth)))
    assumed = source.endswith(_UNKNOWN)
    return BearingElement(below[0] if below else None, tuple(above), solid, free, source, text, assumed)


def _nearest_above(
    solid: TriangleMesh, contacts: NearbyMembers, below: set[int], gap_m: float
) -> tuple[list[int], float]:
    """Return the member that is nearest above a bearing, if any, and the gap up to which it was looked for."""
    for over_m in (gap_m, HIGHEST_PLATE_M):
        over = contacts.reached(lengthened(solid, over_m), 0.0)
        if above := sorted(over.keys() - below, key=lambda index: -over[index])[:1]:
            return above, over_m
    return [], gap_m


def with_one_fixed(
    found: Sequence[tuple[BearingElement, str]], along_m: Mapping[str, float]
) -> list[tuple[BearingElement, str]]:
    """Pin the bearings at one support alone where the file says nothing of any bearing.

    A bridge that is pinned at all its supports would be an arch between them. `along_m` is where the members below them
    are along the road; the first of them keeps its bearings, and all others let the bridge move along the road.
    """
    if not found or not all(bearing.is_assumed for bearing, _ in found):
        return list(found)
    first = min({below for _, below in found}, key=lambda name: along_m[name])
    moving = ("move x", *_FREE_OTHERWISE)
    source = (
        f"the file does not say what it leaves free: pinned on {first}, and free to move along the road on all others"
    )
    return [
        (replace(bearing, free=bearing.free if below == first else moving, source=source), below)
        for bearing, below in found
    ]


def on_plinth(solid: TriangleMesh, below: TriangleMesh) -> TriangleMesh:
    """Return a bearing that goes down to what lies below it, with its whole face where that slopes.

    On a pier cap with a crossfall, a plinth down to its highest part alone would stand on an edge.
    """
    size_m = float(np.ptp(solid.vertices[:, :2], axis=0).max())
    lowest = float(solid.bounds[0, 2])
    highest, falls_m = _top_under(solid, below)
    down_m = min(highest, lowest) - lowest - min(falls_m, STEEPEST * size_m) - SEAT_M
    lowered = TriangleMesh(below.vertices - (0.0, 0.0, SEAT_M), below.triangles)
    return largest_body(cut_by(lengthened(solid, down_m), [lowered]))


def _top_under(solid: TriangleMesh, below: TriangleMesh) -> tuple[float, float]:
    """Return the height of the highest part of what lies below a solid, in its plan, and how far that falls, m."""
    column = lengthened(solid, -HIGHEST_PLINTH_M)
    common = from_manifold(to_manifold(column) ^ to_manifold(below))
    highest = float(common.bounds[1, 2])
    _, normals = triangle_areas_and_normals(common.corners)
    tops = common.corners[normals[:, 2] > _LOOKS_UP]
    return highest, highest - float(tops[..., 2].min(initial=highest))


def seated(solid: TriangleMesh) -> TriangleMesh:
    """Return a bearing that is let into what it lies on."""
    return union([solid, TriangleMesh(solid.vertices - (0.0, 0.0, SEAT_M), solid.triangles)])


def _gaps(solid: TriangleMesh, contacts: NearbyMembers, names: Sequence[str]) -> str:
    apart = [(gap, index) for gap, index in contacts.near_to(solid) if gap > TOUCHING_M]
    if not apart:
        return ""
    gap_m, index = apart[0]
    return f"; {names[index]} is {1e3 * gap_m:.1f} mm off: close that gap in the program that the file was made with"


@dataclass(frozen=True, slots=True)
class BearingTables:
    """Bearings of a scenario, connections in place of those that no kind of bearing is, and notes."""

    bearings: tuple[Bearing, ...]
    connections: tuple[ConnectionBetween, ...]
    notes: tuple[str, ...]

    @property
    def members(self) -> set[str]:
        """Names of the members that they connect."""
        pairs = [table.members for table in self.bearings] + [table.members for table in self.connections]
        return {name for pair in pairs for name in pair}

    def without(self, above: Collection[str]) -> BearingTables:
        """Return the tables without members that lie on bearings, by their names."""
        bearings = tuple(table for table in self.bearings if table.members[0] not in above)
        connections = tuple(table for table in self.connections if table.members[0] not in above)
        return BearingTables(bearings, connections, self.notes)


def bearing_tables(found: Sequence[tuple[BearingElement, str]], names: Sequence[str]) -> BearingTables:
    """Return the tables of bearings, one for each pair of members, and notes on bearings that differ.

    Each bearing comes with the name of the member below it.
    """
    rules: dict[tuple[str, str], tuple[str, ...]] = {}
    notes = []
    for bearing, below in found:
        for above in bearing.above:
            pair = (names[above], below)
            if rules.setdefault(pair, bearing.free) != bearing.free:
                notes.append(f"bearings between {pair[0]} and {pair[1]} differ: the first counts for all of them")
    tables = [_bearing(pair, free) or _connection(pair, free) for pair, free in rules.items()]
    bearings = tuple(table for table in tables if isinstance(table, Bearing))
    return BearingTables(bearings, tuple(table for table in tables if isinstance(table, ConnectionBetween)), (*notes,))


def _bearing(pair: tuple[str, str], free: tuple[str, ...]) -> Bearing | None:
    """Return the bearing between two members, the upper one first; None where none leaves just this free."""
    moves, turns = ({motion for motion in free if motion.startswith(kind)} for kind in ("move", "turn"))
    if not free:
        return Bearing(members=pair, kind=FIXED)
    kind = _KIND_OF_MOVES.get(frozenset(moves))
    if kind is None or "turn y" not in turns:
        return None
    return Bearing(
        members=pair,
        kind=kind,
        pads=1 if len(turns) == len(_ALL_TURNS) else None,  # at a point, it rotates about all axes
        friction=0.0 if kind == SLIDING else None,
    )


def _connection(pair: tuple[str, str], free: tuple[str, ...]) -> ConnectionBetween:
    return ConnectionBetween(members=pair, type="GENERIC", free=free)


def free_motions(element: Element, placement: Placement) -> tuple[tuple[str, ...], str]:
    """Return the motions that a bearing leaves free, along and about the bridge's axes, and where they are from."""
    pset = library("util.element").get_psets(element.entity).get("Pset_BearingCommon", {})
    stated = {motion: pset[name] for motion, name in _PROPERTIES.items() if _are_truths(pset.get(name))}
    rotation = _rotation_of(element.entity.ObjectPlacement)
    if stated and rotation is not None:
        axes = _axes(rotation, placement)
        free = [f"{motion} {axes[number]}" for motion, truths in stated.items() for number in np.flatnonzero(truths)]
        return tuple(sorted(free)), "its free motions are those of Pset_BearingCommon"
    lost = "its own axes follow an alignment, so that its Pset_BearingCommon does not count; " if stated else ""
    if element.facts.predefined in _FREE_OF_TYPE:
        of_type = _FREE_OF_TYPE[element.facts.predefined]
        return of_type, f"{lost}free as {element.facts.predefined} bearings are: {', '.join(of_type)}"
    return _FREE_OTHERWISE, f"{lost}{_UNKNOWN}"


def _rotation_of(placement: Any) -> np.ndarray | None:
    """Return the axes of a placement as columns (3, 3); None where it follows an alignment, or contradicts itself."""
    above = placement
    while above is not None:
        if not above.is_a("IfcLocalPlacement"):
            return None
        above = above.PlacementRelTo
    try:
        return np.array(library("util.placement").get_local_placement(placement))[:3, :3]
    except CONTRADICTIONS:
        return None


def _are_truths(value: Any) -> bool:
    return isinstance(value, list | tuple) and len(value) == 3 and all(isinstance(truth, bool) for truth in value)


def _axes(rotation: np.ndarray, placement: Placement) -> list[str]:
    """Return which axis of the bridge is nearest to each axis (3, 3) of an element."""
    in_plan = transformed(placement.turn, rotation[:2].T).T
    return ["xyz"[number] for number in np.abs(np.vstack((in_plan, rotation[2:]))).argmax(axis=0)]
