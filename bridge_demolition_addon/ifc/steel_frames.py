"""Bars of steel in an IFC file as the steelwork of a scenario: nodes where they meet, on supports.

Bars keep their axes. A node lies where the axes of its bars meet; an axis that misses it has eccentricities.
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
from ..engineering.steelwork.bar_frames import BarAxes, BarFrame, BarPiece, BarStation, bar_frame
from ..engineering.steelwork.bars import bar_axes
from ..model.bridge.member import Member
from ..model.bridge.steelwork import steelwork_members
from ..model.scenario.steelwork import SteelMember, SteelNode, Steelwork
from ..model.schema import given
from .assembly import Assembly
from .contacts import NearbyMembers
from .left_out import JOINT_GAP_M, JointPlate
from .outcome import BAR, CONNECTION, MEMBER, Outcome
from .steel_elements import SteelElement
from .steel_notes import UNKNOWN_GRADE, SaidFrame
from .steel_supports import BarSupport, bar_supports, stronger, supports_of_loose

_PIECES, _PIECES_OF_BEAM, _LEAST_PIECES = 4, 8, 2
"""Pieces of a bar, of a beam that is not divided, and of each part of one that is."""

_BEAM = "IfcBeam"

_MOST_ROUNDS = 6
"""Attempts at having nodes at the ends of bars clear of what holds these: each moves what the one before left."""

_CLEAR_M = 0.002
"""Gap between the plates of a node and what holds it where a bar ends there: what touches is more than its support."""

_DIGITS = 6
_LEAST_M3 = 1e-6


@dataclass(frozen=True, slots=True)
class SteelFrame:
    """Steelwork of a scenario, and the members that it has: bars and nodes."""

    steelwork: Steelwork
    members: tuple[Member, ...]

    @property
    def solids(self) -> tuple[TriangleMesh, ...]:
        """Solids of bars and nodes."""
        return tuple(member.solid for member in self.members)

    def solid_of(self, name: str) -> TriangleMesh:
        """Return the solid of a bar or node."""
        return next(member.solid for member in self.members if member.name == name)


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


def with_no_bearings_on(
    assembly: Assembly, bars: Mapping[int, SteelElement], bearings: Sequence[TriangleMesh]
) -> dict[int, SteelElement]:
    """Return the bars that no bearing lies on; those that carry others through bearings become members again."""
    members = [(number, member) for number, member in assembly.members() if number in bars]
    contacts = NearbyMembers([member.solid for _, member in members])
    carrying: set[int] = set()
    for solid in bearings:
        down, up = contacts.reached(solid, -JOINT_GAP_M), contacts.reached(solid, JOINT_GAP_M)
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
) -> tuple[SteelFrame, SaidFrame]:
    """Return the steelwork of bars on supports, with the mass of plates on its nodes, and what is said of it.

    Outcomes of bars get notes.
    """
    numbers = sorted(bars)
    rows = {number: row for row, number in enumerate(numbers)}
    held = [support for support in supports if support.bar in rows]
    within_m = [0.0] * len(held)
    for _ in range(_MOST_ROUNDS):
        stations = [
            _station(bars[support.bar], rows[support.bar], support, within)
            for support, within in zip(held, within_m, strict=True)
        ]
        frame, said = _frame(assembly, bars, held, stations, plates)
        reach = [
            _reach_m(bars[support.bar], support, frame, said.node_names[node])
            for support, node in zip(held, said.frame.node_of_support, strict=True)
        ]
        if max(reach, default=-_CLEAR_M) <= -_CLEAR_M / 2.0:
            break
        within_m = [within + max(further + _CLEAR_M, 0.0) for within, further in zip(within_m, reach, strict=True)]
    _note(assembly, said)
    return frame, said


def _reach_m(bar: SteelElement, support: BarSupport, frame: SteelFrame, node: str) -> float:
    """Return how far the plates of a node reach into what holds it at the end of a bar; other supports are clear."""
    if support.end is None:
        return -_CLEAR_M
    out = bar.along * (1.0 if support.end else -1.0)
    return float(dot(frame.solid_of(node).vertices - support.position_m, out).max())


def _frame(
    assembly: Assembly,
    bars: Mapping[int, SteelElement],
    held: Sequence[BarSupport],
    stations: Sequence[BarStation],
    plates: Sequence[JointPlate],
) -> tuple[SteelFrame, SaidFrame]:
    """Return the steelwork of bars that are held at stations, and what is said of it."""
    numbers = sorted(bars)
    ordered = [bars[number] for number in numbers]
    axes = axes_of(ordered)
    frame = bar_frame(axes, stations)
    names = [given(assembly.outcomes[number].member).name for number in numbers]
    steel_kg_m3 = _density_kg_m3(assembly, numbers)
    node_names = _node_names(frame, {member.name for _, member in assembly.members()})
    of_nodes: dict[int, BarSupport] = {}
    for node, support in zip(frame.node_of_support, held, strict=True):
        of_nodes[node] = stronger(of_nodes[node], support) if node in of_nodes else support
    masses = _masses_kg(frame, axes, plates, steel_kg_m3)
    grade = Counter(bar.grade or UNKNOWN_GRADE for bar in ordered).most_common(1)[0][0]
    members = tuple(_tables(assembly, numbers, ordered, frame, node_names, grade))
    nodes = tuple(
        SteelNode(
            name=node_names[row],
            position_m=_rounded(place),
            support=of_nodes[row].kind if row in of_nodes else None,
            **({"held_by": of_nodes[row].held_by} if row in of_nodes else {}),
            mass_kg=round(masses.get(row, 0.0), 1),
            radius_m=round(frame.radii_m[row], _DIGITS) if row in frame.radii_m else None,
        )
        for row, place in enumerate(frame.places_m)
    )
    steelwork = Steelwork(grade=grade, density_kg_m3=steel_kg_m3, nodes=nodes, members=members)
    said = SaidFrame(numbers, ordered, names, frame, axes, node_names, of_nodes, plates)
    return SteelFrame(steelwork, steelwork_members(steelwork)), said


def fallen(assembly: Assembly, taken: Mapping[int, SteelElement], left: Mapping[int, SteelElement]) -> dict[int, str]:
    """Return why bars that were taken are left out, by the numbers of their elements, with what is nearest to them."""
    said = {}
    for number in sorted(taken.keys() - left.keys()):
        bar = taken[number]
        begins, ends = (np.array([getattr(one, name) for one in left.values()]) for name in ("begin_m", "end_m"))
        where = ""
        if len(begins):
            apart = min(
                (float(length(_nearest(begins, ends, point) - point).min()), row)
                for row, point in enumerate((bar.begin_m, bar.end_m))
            )
            x, y, z = (bar.begin_m, bar.end_m)[apart[1]].tolist()
            at = f"x = {x:.2f}, y = {y:.2f}, z = {z:.2f} m"
            where = f"; of its ends that at {at} is nearest to an axis, {apart[0]:.2f} m off"
        said[number] = f"meets no other bar, and nothing holds it: left out{where}"
    return said


def _nearest(begins: np.ndarray, ends: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Return the points (n, 3) of lines that are nearest to a point (3,)."""
    ways = ends - begins
    share = np.clip(dot(point - begins, ways) / dot(ways, ways), 0.0, 1.0)
    return np.asarray(begins + share[:, None] * ways)


def cut_out(assembly: Assembly, frame: SteelFrame) -> None:
    """Cut bars and nodes out of the other members: nothing is cut off steelwork as a scenario is read."""
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


def _station(bar: SteelElement, row: int, support: BarSupport, within_m: float) -> BarStation:
    """Return where the node of a support is on a bar, so far within its end."""
    along = float(dot(support.position_m - bar.begin_m, bar.along)) + within_m * (-1.0 if support.end else 1.0)
    return BarStation(row, min(max(along, 0.0), bar.length_m))


def _density_kg_m3(assembly: Assembly, numbers: Sequence[int]) -> float:
    """Return the mean density of the bars, by their masses and volumes."""
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
        nearest = int(length(frame.places_m - plate.position_m).argmin())
        masses[nearest] = masses.get(nearest, 0.0) + plate.mass_kg
    for bar, node, lost_m in _lost(frame, axes):
        masses[node] = masses.get(node, 0.0) + density_kg_m3 * float(axes.areas_m2[bar]) * lost_m
    return masses


def _lost(frame: BarFrame, axes: BarAxes) -> Iterator[tuple[int, int, float]]:
    """Yield what of bars is within nodes, or reaches beyond the last one: the bar, the node, and the length, m."""
    for bar, node in frame.within_nodes.items():
        yield bar, node, float(axes.lengths_m[bar])
    by_bar: dict[int, list[BarPiece]] = {}
    for piece in frame.pieces:
        by_bar.setdefault(piece.bar, []).append(piece)
    for bar, pieces in by_bar.items():
        for piece, end in ((pieces[0], 0), (pieces[-1], 1)):
            node = piece.nodes[end]
            foot = frame.places_m[node] + piece.from_nodes_m[end]
            along = float(dot(foot - axes.begins_m[bar], axes.ways[bar]))
            beyond_m = along if end == 0 else float(axes.lengths_m[bar]) - along
            if beyond_m > 0.0:
                yield bar, node, beyond_m


def _tables(
    assembly: Assembly,
    numbers: Sequence[int],
    bars: Sequence[SteelElement],
    frame: BarFrame,
    node_names: Sequence[str],
    grade: str,
) -> Iterator[SteelMember]:
    """Yield the bars of the scenario."""
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
                pieces=_pieces(outcome, len(pieces)),
            )


def _note(assembly: Assembly, said: SaidFrame) -> None:
    """Note in the outcomes of elements which bars they are."""
    pieces = Counter(piece.bar for piece in said.frame.pieces)
    for row, (number, bar) in enumerate(zip(said.numbers, said.bars, strict=True)):
        outcome = assembly.outcomes[number]
        notes = [outcome.why, f"{bar.section}, {bar.grade or f'grade not known, taken for {UNKNOWN_GRADE}'}"]
        if row in said.frame.within_nodes:
            node = said.node_names[said.frame.within_nodes[row]]
            notes.append(f"it is shorter than the node it is in, {node}, and part of it")
        elif pieces[row] > 1:
            notes.append(f"divided into {pieces[row]} bars by nodes")
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


def _pieces(outcome: Outcome, parts: int) -> int:
    if parts > 1:
        return max(_LEAST_PIECES, math.ceil(_PIECES_OF_BEAM / parts))
    return _PIECES_OF_BEAM if _BEAM in outcome.facts.classes else _PIECES


def _eccentricities(
    from_nodes_m: np.ndarray,
) -> tuple[tuple[float, float, float], tuple[float, float, float]] | None:
    if not from_nodes_m.any():
        return None
    return _rounded(from_nodes_m[0]), _rounded(from_nodes_m[1])


def _rounded(position_m: np.ndarray) -> tuple[float, float, float]:
    x, y, z = (position_m.round(_DIGITS) + 0.0).tolist()
    return x, y, z
