"""Bearings as connections: what each lies on, what lies on it, and which motions it leaves free."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import union
from ..engineering.geometry.vectors import transformed
from ..model.scenario import ConnectionBetween
from .contacts import TOUCHING_M, NearbyMembers
from .elements import Element
from .library import library
from .placement import Placement

SEAT_M = 0.001
"""How far a bearing is let into what it lies on, so that the two become one solid whatever the rounding of places."""

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
"""What types of IfcBearing leave free, x along the road and y across it."""

_FREE_OTHERWISE = ("turn y",)

_PROPERTIES = {"move": "DisplacementAccommodated", "turn": "RotationAccommodated"}
"""Of Pset_BearingCommon: three truths each, along the bearing's own x, y and z."""


@dataclass(frozen=True, slots=True)
class Bearing:
    """A bearing between members, given by their places in the list of members.

    Attributes
    ----------
    below : int
        What it lies on, and becomes part of.
    above : tuple of int
        What lies on it.
    free : tuple of str
        Motions that it leaves free.
    source : str
        Where these are from.
    """

    below: int
    above: tuple[int, ...]
    free: tuple[str, ...]
    source: str


def bearing_of(
    element: Element, solid: TriangleMesh, contacts: NearbyMembers, names: Sequence[str], placement: Placement
) -> Bearing | str:
    """Return what a bearing connects, or why it is left out.

    Parameters
    ----------
    element : Element
        The bearing.
    solid : TriangleMesh
        Its body, in its place.
    contacts : NearbyMembers
        Of the members.
    names : sequence of str
        Of the members.
    placement : Placement
        Where the bridge stands.
    """
    down, up = contacts.reached(solid, -TOUCHING_M), contacts.reached(solid, TOUCHING_M)
    # One that it is sunk into, or that is sunk into it, lies on the side that it reaches further into.
    below = sorted((each for each in down if down[each] > up.get(each, 0.0)), key=lambda each: -down[each])
    above = sorted(each for each in up if up[each] > down.get(each, 0.0))
    if not below or not above:
        return f"nothing touches it from {'below' if not below else 'above'}{_gaps(solid, contacts, names)}"
    free, source = free_motions(element, placement)
    return Bearing(below[0], tuple(above), free, source)


def seated(solid: TriangleMesh) -> TriangleMesh:
    """Return a bearing that is let into what it lies on."""
    return union([solid, TriangleMesh(solid.vertices - (0.0, 0.0, SEAT_M), solid.triangles)])


def _gaps(solid: TriangleMesh, contacts: NearbyMembers, names: Sequence[str]) -> str:
    apart = [(gap, index) for gap, index in contacts.near_to(solid) if gap > TOUCHING_M]
    if not apart:
        return ""
    gap_m, index = apart[0]
    return f"; {names[index]} is {1e3 * gap_m:.1f} mm off: close that gap in the program that the file was made with"


def bearing_rules(bearings: Sequence[Bearing], names: Sequence[str]) -> tuple[list[ConnectionBetween], list[str]]:
    """Return the connections that bearings are, one for each pair of members, and what they disagree in."""
    rules: dict[tuple[str, str], tuple[str, ...]] = {}
    notes = []
    for bearing in bearings:
        for above in bearing.above:
            pair = (names[above], names[bearing.below])
            if rules.setdefault(pair, bearing.free) != bearing.free:
                notes.append(f"bearings between {pair[0]} and {pair[1]} differ: the first counts for all of them")
    return [_rule(pair, free) for pair, free in rules.items()], notes


def _rule(pair: tuple[str, str], free: tuple[str, ...]) -> ConnectionBetween:
    if not free:
        return ConnectionBetween(members=pair, type="FIXED")
    return ConnectionBetween(members=pair, type="GENERIC", free=free)


def free_motions(element: Element, placement: Placement) -> tuple[tuple[str, ...], str]:
    """Return the motions that a bearing leaves free, along and about the bridge's axes, and where they are from."""
    given = library("util.element").get_psets(element.entity).get("Pset_BearingCommon", {})
    told = {motion: given[name] for motion, name in _PROPERTIES.items() if _are_truths(given.get(name))}
    turn = _turn_of(element.entity.ObjectPlacement)
    if told and turn is not None:
        axes = _axes(turn, placement)
        found = [f"{motion} {axes[number]}" for motion, truths in told.items() for number in np.flatnonzero(truths)]
        return tuple(sorted(found)), "its free motions are those of Pset_BearingCommon"
    lost = "its own axes follow an alignment, so that its Pset_BearingCommon does not count; " if told else ""
    if element.facts.predefined in _FREE_OF_TYPE:
        free = _FREE_OF_TYPE[element.facts.predefined]
        return free, f"{lost}free as {element.facts.predefined} bearings are: {', '.join(free)}"
    return _FREE_OTHERWISE, f"{lost}the file does not say what it leaves free, taken for {', '.join(_FREE_OTHERWISE)}"


def _turn_of(placed: Any) -> np.ndarray | None:
    """Return the matrix (3, 3) of a placement, whose columns are its own axes; None where it follows an alignment."""
    each = placed
    while each is not None:
        if not each.is_a("IfcLocalPlacement"):
            return None
        each = each.PlacementRelTo
    return np.array(library("util.placement").get_local_placement(placed))[:3, :3]


def _are_truths(value: Any) -> bool:
    return isinstance(value, list | tuple) and len(value) == 3 and all(isinstance(each, bool) for each in value)


def _axes(turn: np.ndarray, placement: Placement) -> list[str]:
    """Return which axis of the bridge is nearest to each axis (3, 3) of an element."""
    in_plan = transformed(placement.turn, turn[:2].T).T
    return ["xyz"[number] for number in np.abs(np.vstack((in_plan, turn[2:]))).argmax(axis=0)]
