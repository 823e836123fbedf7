"""What the report of an import says of bars of steel."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..engineering.geometry.vectors import dot, length
from ..engineering.steelwork.bar_frames import BarAxes, BarFrame
from ..engineering.units import mass_text
from ..model.schema import given
from .assembly import Assembly
from .left_out import JointPlate
from .steel_elements import SteelElement
from .steel_supports import BarSupport

UNKNOWN_GRADE = "S235"
"""Grade of bars whose material does not say it: that of most old bridges, and the weakest."""

_TOLD_M = 0.001
"""How far an axis runs beside a node before that is said."""

_NAMED = 5


@dataclass(frozen=True, slots=True)
class SaidFrame:
    """A frame of bars, and what its rows are: elements by their numbers, bars and names, names of its nodes, and which
    of these have supports; with them the plates at its joints."""

    numbers: Sequence[int]
    bars: Sequence[SteelElement]
    names: Sequence[str]
    frame: BarFrame
    axes: BarAxes
    node_names: Sequence[str]
    supports: Mapping[int, BarSupport]
    plates: Sequence[JointPlate]


def steel_notes(assembly: Assembly, said: SaidFrame) -> Iterator[str]:
    """Yield the lines of the report on bars: sections, nodes, eccentricities of axes, supports, what is amiss."""
    bars, frame, names, plates = said.bars, said.frame, said.names, said.plates
    mass_kg = math.fsum(given(assembly.outcomes[number].member).mass_kg for number in said.numbers)
    sections = ", ".join(f"{name} ({found})" for name, found in Counter(bar.section for bar in bars).most_common())
    yield f"{len(bars)} elements, {mass_text(mass_kg).strip()}: {sections}"
    divided = Counter(piece.bar for piece in frame.pieces)
    more = sum(found > 1 for found in divided.values())
    yield (
        f"{len(frame.pieces)} bars between {len(frame.places_m)} nodes, with their axes as the file has them; {more} "
        "elements are divided where others end in them, or where they are supported"
    )
    yield from _on_axes(frame, names)
    for row, support in sorted(said.supports.items(), key=lambda item: float(frame.places_m[item[0]][0])):
        assumed = ", as the file does not say it" if support.is_assumed else ""
        yield f"{said.node_names[row]} on {support.held_by}: {support.kind}{assumed}"
    unknown = sum(bar.grade is None for bar in bars)
    if unknown:
        yield f"the file tells no grade of {unknown} elements: taken for {UNKNOWN_GRADE}; say it in steelwork.grade"
    if plates:
        mass = math.fsum(plate.mass_kg for plate in plates)
        yield f"{len(plates)} plates and stubs at joints are left out: their {mass_text(mass).strip()} are on nodes"
    yield from _amiss(frame, names, said.axes, set(said.supports))


def _on_axes(frame: BarFrame, names: Sequence[str]) -> Iterator[str]:
    beside = {bar: apart for bar, apart in frame.eccentricities_m.items() if apart > _TOLD_M}
    if not beside:
        yield "all axes meet in their nodes"
        return
    order = sorted(beside, key=lambda bar: -beside[bar])
    named = ", ".join(f"{names[bar]} by {1e3 * beside[bar]:.0f} mm" for bar in order[:_NAMED])
    more = f" and {len(order) - _NAMED} more" if len(order) > _NAMED else ""
    yield f"the axes of {len(beside)} elements run beside a node, and are joined to it by plates: {named}{more}"


def _amiss(frame: BarFrame, names: Sequence[str], axes: BarAxes, held: set[int]) -> Iterator[str]:
    """Yield what may not be as it was meant: free ends, bars that pass each other, and what is within a node.

    A bar with a support of its own, at the nodes that are `held`, may reach beyond it.
    """
    on_supports = {piece.bar for piece in frame.pieces if held & set(piece.nodes)}
    for bar, end in frame.free_ends:
        if bar not in on_supports:
            yield f"{names[bar]} ends free {_where(axes, bar, end, names)}"
    for one, other in frame.crossings[:_NAMED]:
        yield f"{names[one]} and {names[other]} pass each other between their ends, and are not joined there"
    if len(frame.crossings) > _NAMED:
        yield f"and {len(frame.crossings) - _NAMED} more pairs pass each other so"
    if frame.within_nodes:
        short = _some([names[bar] for bar in frame.within_nodes])
        yield f"too short beside what they join, and part of a node: {short}"
    if frame.radii_m:
        yield f"{len(frame.radii_m)} nodes are smaller than bars need to lie clear of each other: these overlap there"


def _where(axes: BarAxes, bar: int, end: int, names: Sequence[str]) -> str:
    """Return where the end of a bar is, and what is nearest to it."""
    place = (axes.begins_m, axes.ends_m)[end][bar]
    x, y, z = place.tolist()
    along = np.clip(dot(place - axes.begins_m, axes.ways), 0.0, axes.lengths_m)
    apart = length(axes.begins_m + along[:, None] * axes.ways - place)
    apart[bar] = np.inf
    where = f"at x = {x:.2f}, y = {y:.2f}, z = {z:.2f} m"
    if len(axes) < 2:
        return where
    nearest = int(apart.argmin())
    return f"{where}: the axis of {names[nearest]} is {apart[nearest]:.2f} m off"


def by_reason(assembly: Assembly, apart: Mapping[int, str]) -> Iterator[str]:
    """Yield why elements of steel are no bars, or fall; `apart` has the reasons by their numbers in the file."""
    found: dict[str, list[str]] = {}
    for number, why in apart.items():
        found.setdefault(why, []).append(assembly.outcomes[number].facts.name)
    for why, elements in found.items():
        yield f"{_some(elements)}: {why}"


def _some(names: Sequence[str]) -> str:
    more = f" and {len(names) - _NAMED} more" if len(names) > _NAMED else ""
    return ", ".join(names[:_NAMED]) + more
