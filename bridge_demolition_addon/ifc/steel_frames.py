"""Bars of steel in an IFC file as the steelwork of a scenario: nodes where they meet, supports, and what is said of them.

Bars keep their axes. A node lies where those of its bars meet; one that runs beside it has eccentricities.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain, count

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.geometry.solids import from_manifold, to_manifold
from ..engineering.geometry.vectors import dot, length, transformed
from ..engineering.steelwork.bar_frames import BarAxes, BarFrame, BarStation, bar_frame
from ..engineering.steelwork.bars import bar_axes
from ..engineering.units import mass_text
from ..model.bridge.member import Member
from ..model.bridge.steelwork import steelwork_members
from ..model.scenario.steelwork import SteelMember, SteelNode, Steelwork
from ..model.schema import given
from .assembly import Assembly
from .contacts import NearbyMembers
from .outcome import BAR, CONNECTION, LEFT_OUT, MEMBER
from .steel_elements import STEEL, SteelElement
from .steel_supports import BarSupport, bar_supports, stronger, supports_of_loose

UNKNOWN_GRADE = "S235"
"""Grade of bars whose material does not say it: that of most old bridges, and the weakest."""

_PIECES, _PIECES_OF_BEAM, _LEAST_PIECES = 4, 8, 2
"""Pieces of a bar, of one that carries the road and is not divided, and of each part of one that is."""

_PLATE, _PLATE_GAP_M, _PLATE_MASS = 2.5, 0.003, 0.5
"""Longest extent of a plate at a joint by the size of the bar that it touches, its gap to that, and its mass by that of
the bar."""

_TOLD_M = 0.001
"""How far an axis runs beside a node before it is told."""

_DIGITS = 6
_NAMED = 5
_LEAST_M3 = 1e-6
_SAME_DENSITY = 0.01


@dataclass(frozen=True, slots=True)
class JointPlate:
    """A plate at a joint of bars: where it is (3,), and its mass."""

    place_m: np.ndarray
    mass_kg: float


@dataclass(frozen=True, slots=True)
class SteelFrame:
    """Steelwork of a scenario, the solids of its bars and nodes, and the lines of the report on it."""

    steelwork: Steelwork
    solids: tuple[TriangleMesh, ...]
    lines: tuple[str, ...]


def axes_of(bars: Sequence[SteelElement]) -> BarAxes:
    """Return the axes and sections of bars."""
    outlines, areas = [], []
    for bar in bars:
        own = bar_axes(bar.begin_m, bar.end_m, math.radians(bar.roll_deg))
        outlines.append(transformed(own[:, 1:], np.concatenate(bar.steel_section.rings)))
        areas.append(bar.steel_section.area_m2)
    begins, ends = (np.array([getattr(bar, name) for bar in bars]) for name in ("begin_m", "end_m"))
    return BarAxes(begins, ends, outlines, np.array(areas))


def joined_names(frame: BarFrame, names: Sequence[str]) -> list[tuple[str, str]]:
    """Return pairs of names of bars that meet in a node."""
    at_node: dict[int, list[str]] = {}
    for piece in frame.pieces:
        for node in piece.nodes:
            at_node.setdefault(node, []).append(names[piece.bar])
    for bar, node in frame.within_nodes.items():
        at_node.setdefault(node, []).append(names[bar])
    return [(found[0], other) for found in at_node.values() for other in found[1:] if other != found[0]]


def leave_out_plates(assembly: Assembly, bars: Mapping[int, SteelElement]) -> list[JointPlate]:
    """Leave out plates and stubs of steel at joints of bars, and return them: their mass goes to the nodes."""
    members = assembly.members()
    own = [(number, member) for number, member in members if number in bars]
    contacts = NearbyMembers([member.solid for _, member in own])
    plates = []
    for number, member in members:
        substance = assembly.outcomes[number].substance
        if number in bars or substance is None or substance.row.strength_name != STEEL:
            continue
        longest = float(np.ptp(member.solid.vertices, axis=0).max())
        for gap, row in contacts.near_to(member.solid):
            bar = bars[own[row][0]]
            is_small = longest <= _PLATE * float(bar.steel_section.size_m.max())
            if gap <= _PLATE_GAP_M and is_small and member.mass_kg <= _PLATE_MASS * own[row][1].mass_kg:
                plates.append(JointPlate(member.solid.bounds.mean(axis=0), member.mass_kg))
                outcome = assembly.outcomes[number]
                why = "a plate or stub at a joint of bars: its mass is on the node that is nearest to it"
                assembly.outcomes[number] = replace(outcome, member=None, substance=None, became=LEFT_OUT, why=why)
                break
    return plates


def with_no_bearings_on(
    assembly: Assembly, bars: Mapping[int, SteelElement], bearings: Sequence[TriangleMesh]
) -> dict[int, SteelElement]:
    """Return the bars that no bearing lies on; those that carry others through bearings become members again."""
    members = [(number, member) for number, member in assembly.members() if number in bars]
    contacts = NearbyMembers([member.solid for _, member in members])
    carrying: set[int] = set()
    for solid in bearings:
        down, up = contacts.reached(solid, -_PLATE_GAP_M), contacts.reached(solid, _PLATE_GAP_M)
        carrying |= {members[row][0] for row in down if down[row] > up.get(row, 0.0)}
    for number in carrying:
        outcome = assembly.outcomes[number]
        why = "; ".join(filter(None, (outcome.why, "a bearing lies on it: no bar")))
        assembly.outcomes[number] = replace(outcome, became=MEMBER, why=why)
    assembly.bars = frozenset(bars) - carrying
    return {number: bar for number, bar in bars.items() if number not in carrying}


def supported(assembly: Assembly, bars: Mapping[int, SteelElement], gap_m: float) -> list[BarSupport]:
    """Return the supports of bars, and have the assembly know what hangs together with them."""
    if not bars:
        return []
    numbers = sorted(bars)
    names = {number: given(assembly.outcomes[number].member).name for number in numbers}
    frame = bar_frame(axes_of([bars[number] for number in numbers]))
    assembly.joined += joined_names(frame, [names[number] for number in numbers])
    supports = bar_supports(assembly, bars, gap_m)
    assembly.joined += [(names[support.bar], support.held_by) for support in supports]
    more, notes = supports_of_loose(assembly, bars)
    assembly.joined += [(names[support.bar], support.held_by) for support in more]
    assembly.notes += notes
    return [*supports, *more]


def as_they_stand(
    assembly: Assembly, bars: Mapping[int, SteelElement], before: Mapping[int, np.ndarray]
) -> dict[int, SteelElement]:
    """Return the bars that are left, moved as their bodies were: `before` are the first vertices (3,) of these."""
    found = {}
    for number, bar in bars.items():
        outcome = assembly.outcomes[number]
        if outcome.became == BAR:
            shift = given(outcome.member).solid.vertices[0] - before[number]
            found[number] = replace(bar, begin_m=bar.begin_m + shift, end_m=bar.end_m + shift)
    return found


def steel_frame(
    assembly: Assembly,
    bars: Mapping[int, SteelElement],
    supports: Sequence[BarSupport],
    plates: Sequence[JointPlate],
    refused: Mapping[int, str],
) -> SteelFrame:
    """Return the steelwork of bars on supports, with the mass of plates on its nodes.

    `refused` says why other elements of steel are no bars. Outcomes of bars get notes.
    """
    numbers = sorted(bars)
    ordered = [bars[number] for number in numbers]
    rows = {number: row for row, number in enumerate(numbers)}
    held = [support for support in supports if support.bar in rows]
    stations = [_station(bars[support.bar], rows[support.bar], support) for support in held]
    axes = axes_of(ordered)
    frame = bar_frame(axes, stations)
    names = [given(assembly.outcomes[number].member).name for number in numbers]
    steel_kg_m3 = _density_kg_m3(assembly, numbers)
    node_names = _node_names(frame, {member.name for _, member in assembly.members()})
    of_nodes: dict[int, BarSupport] = {}
    for node, support in zip(frame.node_of_support, held, strict=True):
        of_nodes[node] = stronger(of_nodes[node], support) if node in of_nodes else support
    masses = _masses_kg(frame, axes, plates, steel_kg_m3)
    grades = Counter(bar.grade or UNKNOWN_GRADE for bar in ordered)
    grade = grades.most_common(1)[0][0]
    members = tuple(_tables(assembly, numbers, ordered, frame, node_names, grade))
    nodes = tuple(
        SteelNode(
            name=node_names[row],
            place_m=_rounded(place),
            support=of_nodes[row].kind if row in of_nodes else None,
            **({"held_by": of_nodes[row].held_by} if row in of_nodes else {}),
            mass_kg=round(masses.get(row, 0.0), 1),
            radius_m=round(frame.radii_m[row], _DIGITS) if row in frame.radii_m else None,
        )
        for row, place in enumerate(frame.places_m)
    )
    steelwork = Steelwork(grade=grade, density_kg_m3=steel_kg_m3, nodes=nodes, members=members)
    lines = tuple(_lines(assembly, numbers, ordered, frame, names, node_names, of_nodes, plates, refused, axes))
    return SteelFrame(steelwork, tuple(member.solid for member in steelwork_members(steelwork)), lines)


def cut_out(assembly: Assembly, frame: SteelFrame) -> None:
    """Cut bars and nodes out of all other members: nothing is cut off steelwork as a scenario is read."""
    boxes = np.array([solid.bounds for solid in frame.solids])
    for number, outcome in list(assembly.outcomes.items()):
        if outcome.member is None or outcome.became in (BAR, CONNECTION):
            continue
        low, high = outcome.member.solid.bounds
        near = np.flatnonzero(((boxes[:, 0] < high) & (boxes[:, 1] > low)).all(axis=1)).tolist()
        whole = to_manifold(outcome.member.solid)
        rest = whole
        for row in near:
            rest = rest - to_manifold(frame.solids[row])
        if whole.volume() - rest.volume() <= _LEAST_M3:
            continue
        if rest.volume() <= _LEAST_M3:
            assembly.leave_out(number, "bars of steel take all of its room")
            continue
        assembly.outcomes[number] = replace(outcome, member=replace(outcome.member, solid=from_manifold(rest)))
        assembly.notes.append(
            f"{outcome.member.name}: {whole.volume() - rest.volume():.2g} m³ cut off, where bars of steel are"
        )


def _station(bar: SteelElement, row: int, support: BarSupport) -> BarStation:
    along = float(dot(support.place_m - bar.begin_m, bar.along))
    return BarStation(row, min(max(along, 0.0), bar.length_m))


def _density_kg_m3(assembly: Assembly, numbers: Sequence[int]) -> float:
    """Return the density of all bars together, by their masses and volumes."""
    members = [given(assembly.outcomes[number].member) for number in numbers]
    mass = math.fsum(member.mass_kg for member in members)
    return float(f"{mass / math.fsum(member.volume_m3 for member in members):.6g}")


def _node_names(frame: BarFrame, taken: set[str]) -> list[str]:
    """Return names of nodes, counted along the road, then upwards and across it."""
    order = sorted(range(len(frame.places_m)), key=lambda row: tuple(frame.places_m[row][[0, 2, 1]].round(3).tolist()))
    free = (name for name in (f"node {number}" for number in count(1)) if name not in taken)
    names = dict(zip(order, free, strict=False))
    return [names[row] for row in range(len(frame.places_m))]


def _masses_kg(frame: BarFrame, axes: BarAxes, plates: Sequence[JointPlate], density_kg_m3: float) -> dict[int, float]:
    """Return the masses of plates, and of bars that are within nodes, by the nodes that they go to."""
    masses: dict[int, float] = {}
    for plate in plates:
        nearest = int(length(frame.places_m - plate.place_m).argmin())
        masses[nearest] = masses.get(nearest, 0.0) + plate.mass_kg
    for bar, node in frame.within_nodes.items():
        mass = density_kg_m3 * float(axes.areas_m2[bar] * axes.lengths_m[bar])
        masses[node] = masses.get(node, 0.0) + mass
    return masses


def _tables(
    assembly: Assembly,
    numbers: Sequence[int],
    bars: Sequence[SteelElement],
    frame: BarFrame,
    node_names: Sequence[str],
    grade: str,
) -> Iterator[SteelMember]:
    """Yield the bars of the scenario, and say in the outcomes of their elements what became of these."""
    taken = {member.name for _, member in assembly.members()} | set(node_names)
    for row, (number, bar) in enumerate(zip(numbers, bars, strict=True)):
        outcome = assembly.outcomes[number]
        member = given(outcome.member)
        pieces = [piece for piece in frame.pieces if piece.bar == row]
        names = _piece_names(member.name, len(pieces), taken)
        for name, piece in zip(names, pieces, strict=True):
            first, second = piece.nodes
            ends = frame.places_m[[first, second]] + piece.from_nodes_m
            own = replace(bar, begin_m=ends[0], end_m=ends[1])
            roll = round(own.roll_deg, 4)
            yield SteelMember(
                name=name,
                nodes=(node_names[first], node_names[second]),
                section=bar.section,
                kind=member.kind,
                grade=None if (bar.grade or UNKNOWN_GRADE) == grade else bar.grade or UNKNOWN_GRADE,
                roll_deg=0.0 if roll == 0.0 else roll,
                eccentricities_m=_eccentricities(piece.from_nodes_m),
                pieces=_pieces(member, len(pieces)),
            )
        notes = [outcome.why, f"{bar.section}, {bar.grade or f'grade not told, taken for {UNKNOWN_GRADE}'}"]
        if row in frame.within_nodes:
            notes.append(f"it is shorter than the node it is in, {node_names[frame.within_nodes[row]]}, and part of it")
        elif len(pieces) > 1:
            notes.append(f"divided into {len(pieces)} bars by nodes")
        assembly.outcomes[number] = replace(outcome, why="; ".join(filter(None, notes)))


def _piece_names(name: str, pieces: int, taken: set[str]) -> list[str]:
    """Return names of the bars that an element is divided into: its own where that is one."""
    if pieces == 1:
        return [name]
    names = []
    for number in range(1, pieces + 1):
        choices = chain([f"{name} {number}"], (f"{name} {number} ({more})" for more in count(2)))
        names.append(next(choice for choice in choices if choice not in taken))
        taken.add(names[-1])
    return names


def _pieces(member: Member, parts: int) -> int:
    if parts > 1:
        return max(_LEAST_PIECES, math.ceil(_PIECES_OF_BEAM / parts))
    return _PIECES_OF_BEAM if member.kind == "girder" else _PIECES


def _eccentricities(
    from_nodes_m: np.ndarray,
) -> tuple[tuple[float, float, float], tuple[float, float, float]] | None:
    if not from_nodes_m.any():
        return None
    return _rounded(from_nodes_m[0]), _rounded(from_nodes_m[1])


def _rounded(place_m: np.ndarray) -> tuple[float, float, float]:
    x, y, z = (place_m.round(_DIGITS) + 0.0).tolist()
    return x, y, z


def _lines(
    assembly: Assembly,
    numbers: Sequence[int],
    bars: Sequence[SteelElement],
    frame: BarFrame,
    names: Sequence[str],
    node_names: Sequence[str],
    supports: Mapping[int, BarSupport],
    plates: Sequence[JointPlate],
    refused: Mapping[int, str],
    axes: BarAxes,
) -> Iterator[str]:
    """Yield the lines of the report on bars: sections, nodes, how far axes run beside them, supports, and what is amiss."""
    mass_kg = math.fsum(given(assembly.outcomes[number].member).mass_kg for number in numbers)
    sections = ", ".join(f"{name} ({found})" for name, found in Counter(bar.section for bar in bars).most_common())
    yield f"{len(bars)} elements, {mass_text(mass_kg).strip()}: {sections}"
    divided = Counter(piece.bar for piece in frame.pieces)
    more = sum(found > 1 for found in divided.values())
    yield (
        f"{len(frame.pieces)} bars between {len(frame.places_m)} nodes, with their axes as the file has them; {more} "
        "elements are divided where others end in them, or where they are supported"
    )
    yield from _on_axes(frame, names)
    for row, support in sorted(supports.items(), key=lambda item: float(frame.places_m[item[0]][0])):
        assumed = ", as the file does not say it" if support.is_assumed else ""
        yield f"{node_names[row]} on {support.held_by}: {support.kind}{assumed}"
    unknown = sum(bar.grade is None for bar in bars)
    if unknown:
        yield f"the file tells no grade of {unknown} elements: taken for {UNKNOWN_GRADE}; say it in steelwork.grade"
    if plates:
        mass = math.fsum(plate.mass_kg for plate in plates)
        yield f"{len(plates)} plates and stubs at joints are left out: their {mass_text(mass).strip()} are on nodes"
    yield from _amiss(frame, names, axes)
    for why, elements in _by_reason(assembly, refused).items():
        yield f"no bar, and cut into shards: {_some(elements)}: {why}"


def _on_axes(frame: BarFrame, names: Sequence[str]) -> Iterator[str]:
    beside = {bar: apart for bar, apart in frame.eccentricities_m.items() if apart > _TOLD_M}
    if not beside:
        yield "all axes meet in their nodes"
        return
    order = sorted(beside, key=lambda bar: -beside[bar])
    named = ", ".join(f"{names[bar]} by {1e3 * beside[bar]:.0f} mm" for bar in order[:_NAMED])
    more = f" and {len(order) - _NAMED} more" if len(order) > _NAMED else ""
    yield f"the axes of {len(beside)} elements run beside a node, and are joined to it by plates: {named}{more}"


def _amiss(frame: BarFrame, names: Sequence[str], axes: BarAxes) -> Iterator[str]:
    """Yield what may not be as it was meant: ends that meet nothing, bars that pass each other, and what is in a node."""
    for bar, end in frame.free_ends:
        yield f"{names[bar]} ends free {_where(axes, bar, end, names)}"
    for one, other in frame.crossings[:_NAMED]:
        yield f"{names[one]} and {names[other]} pass each other between their ends, and are not joined there"
    if len(frame.crossings) > _NAMED:
        yield f"and {len(frame.crossings) - _NAMED} more pairs pass each other so"
    if frame.within_nodes:
        yield f"too short beside what they join, and part of a node: {_some([names[bar] for bar in frame.within_nodes])}"
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


def _by_reason(assembly: Assembly, refused: Mapping[int, str]) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for number, why in refused.items():
        if assembly.outcomes[number].became != LEFT_OUT:
            found.setdefault(why, []).append(assembly.outcomes[number].facts.name)
    return found


def _some(names: Sequence[str]) -> str:
    more = f" and {len(names) - _NAMED} more" if len(names) > _NAMED else ""
    return ", ".join(names[:_NAMED]) + more
