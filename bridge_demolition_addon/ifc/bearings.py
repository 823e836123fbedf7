"""Bearings as connections: the members below and above each, and the motions that it leaves free."""

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
"""How far a bearing is let into what it lies on, so that the two become one solid in spite of rounding."""

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

_PROPERTIES = {"move": "DisplacementAccommodated", "turn": "RotationAccommodated"}
"""Of Pset_BearingCommon: three truths each, along the bearing's own x, y and z."""


@dataclass(frozen=True, slots=True)
class BearingElement:
    """A bearing between members, given by their numbers in the list of members.

    It becomes part of the member below. `source` says where its free motions are from.
    """

    below: int
    above: tuple[int, ...]
    free: tuple[str, ...]
    source: str


def bearing_of(
    element: Element, solid: TriangleMesh, contacts: NearbyMembers, names: Sequence[str], placement: Placement
) -> BearingElement | str:
    """Return what a bearing with a solid connects of the members with these names, or why it is left out."""
    down, up = contacts.reached(solid, -TOUCHING_M), contacts.reached(solid, TOUCHING_M)
    # One that it is sunk into, or that is sunk into it, lies on the side that it reaches further into.
    below = sorted((index for index in down if down[index] > up.get(index, 0.0)), key=lambda index: -down[index])
    above = sorted(index for index in up if up[index] > down.get(index, 0.0))
    if not below or not above:
        return f"nothing touches it from {'below' if not below else 'above'}{_gaps(solid, contacts, names)}"
    free, source = free_motions(element, placement)
    return BearingElement(below[0], tuple(above), free, source)


def seated(solid: TriangleMesh) -> TriangleMesh:
    """Return a bearing that is let into what it lies on."""
    return union([solid, TriangleMesh(solid.vertices - (0.0, 0.0, SEAT_M), solid.triangles)])


def _gaps(solid: TriangleMesh, contacts: NearbyMembers, names: Sequence[str]) -> str:
    apart = [(gap, index) for gap, index in contacts.near_to(solid) if gap > TOUCHING_M]
    if not apart:
        return ""
    gap_m, index = apart[0]
    return f"; {names[index]} is {1e3 * gap_m:.1f} mm off: close that gap in the program that the file was made with"


def bearing_rules(
    bearings: Sequence[BearingElement], names: Sequence[str]
) -> tuple[list[ConnectionBetween], list[str]]:
    """Return the connections of bearings, one for each pair of members, and notes on bearings that differ."""
    rules: dict[tuple[str, str], tuple[str, ...]] = {}
    notes = []
    for bearing in bearings:
        for above in bearing.above:
            pair = (names[above], names[bearing.below])
            if rules.setdefault(pair, bearing.free) != bearing.free:
                notes.append(f"bearings between {pair[0]} and {pair[1]} differ: the first counts for all of them")
    connections = [
        ConnectionBetween(members=pair, type="GENERIC" if free else "FIXED", free=free) for pair, free in rules.items()
    ]
    return connections, notes


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
    return _FREE_OTHERWISE, f"{lost}the file does not say what it leaves free, taken for {', '.join(_FREE_OTHERWISE)}"


def _rotation_of(placement: Any) -> np.ndarray | None:
    """Return the axes of a placement as columns (3, 3); None where it follows an alignment."""
    above = placement
    while above is not None:
        if not above.is_a("IfcLocalPlacement"):
            return None
        above = above.PlacementRelTo
    return np.array(library("util.placement").get_local_placement(placement))[:3, :3]


def _are_truths(value: Any) -> bool:
    return isinstance(value, list | tuple) and len(value) == 3 and all(isinstance(truth, bool) for truth in value)


def _axes(rotation: np.ndarray, placement: Placement) -> list[str]:
    """Return which axis of the bridge is nearest to each axis (3, 3) of an element."""
    in_plan = transformed(placement.turn, rotation[:2].T).T
    return ["xyz"[number] for number in np.abs(np.vstack((in_plan, rotation[2:]))).argmax(axis=0)]
