"""All members cut into shards, and the faces that shards have in common, within a member and between two."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import chain, pairwise
from pathlib import Path

import numpy as np

from ...engineering.fracture.gaps import with_gaps
from ...engineering.fracture.options import (
    FractureOptions,
    PointDensity,
    Recursion,
    densest,
    density_around,
    painted_density,
    through_thickness,
)
from ...engineering.fracture.seeds import random_points
from ...engineering.fracture.shards import Fracture, fracture, joined_fractures, voronoi_cells
from ...engineering.fracture.shared_faces import SharedFaces, joined_faces, touching_faces
from ...engineering.fracture.slabs import cut_out, cut_through, inclined_fracture, slabs
from ...engineering.geometry.convex_parts import convex_parts
from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.road_lines import road_prism
from ...engineering.geometry.solids import contains
from ...engineering.geometry.vectors import AXES
from ...errors import GeometryError
from ..actions import CutBox, CutOfMembers, CutPlane, CutThrough
from ..bridge.member import Member, members_named
from ..bridge.superstructure import cast_decks
from ..reinforcement.concrete_members import names_with_bars
from ..scenario import FractureSettings, Scenario
from ..scenario.fracture import MemberFracture
from ..schema import SHORTEST_LENGTH_M, given
from .point_files import paint_from_file, points_from_file
from .slabs_on_columns import SlabOnColumns, slabs_on_columns, supports_below
from .steelwork import bar_joints, joint_faces, steel_fracture

_DENSITY_SAMPLES = 4000
"""Points that the mean density of a member is taken over: it is off by some percent at most, and so is a number of
shards."""

_MOST_CONVEX_PARTS = 12
_MOST_CONVEX_IN_PIECE = 8
"""Parts into which a member that has fewer shards is cut, and a piece of a slender one, so that these are convex."""

_LEAST_PART = 0.05
"""Part of a mean shard's volume that a convex part has to have. The pads of bearings stay with the pier cap that they
are on: a shard of 60 kg that is pressed between two a hundred times as heavy is pushed away by Bullet, with energy that
is not there."""

_THROUGH_PART = 20.0
"""Length of shards over their width with which they go through a part of a deck: only inclined by a twentieth."""

_KEPT_SOLIDS = 512
"""Solids whose convex parts are kept: those of an imported bridge, of 20 kB each."""

_MOST_ATTEMPTS = 8

_SPANNING = ("deck", "girder", "arch", "parapet", "pier cap")
_SLENDER, _LONGEST_PIECE = 4.0, 3.0
"""Length by the size of the section of a member that is cut across it first, and of its pieces."""

_FEW = 2
"""Shards of a piece of a girder or its slab up to which these are cut across alone."""

_THIN_M = 0.05
"""Slices of girders and slab that are not cut off beside a plane that something else cuts along."""

_DECIMALS = 9
"""To which corners of straight parts are the same."""

_LEAST_IN_CLEAR = 2
"""Pieces of a girder between two supports, beside those above them: with fewer it is hardly a beam."""

_LEAST_OF_BOX, _SHORTEST_OF_BOX = 4, 0.25
"""Pieces of a box girder in each span, beside those above supports: with two, single bearings are off by 12 %; and the
length of a piece by the depth of the box, from which on plates are cut into more shards."""

_SHARDS_OF_PIECE, _MOST_PIECES = 6, 12
"""Shards of a piece of a member with many, and number of pieces of wide ones: what is cambered is straight in each."""


@dataclass(frozen=True, slots=True)
class FracturedMembers:
    """The members' n shards, one member after the other, without gaps.

    `member_of_shard` (n,) holds indices of members, `centres_m` (n, 3) centres of mass, and `points_m` (n, 3) the
    points whose Voronoi cells the shards are. `faces` are those that neighbouring shards share, the joints of steelwork
    among them. `in_lattices` (k,) says which members are cut around a lattice of points.
    """

    shards: tuple[TriangleMesh, ...]
    member_of_shard: np.ndarray
    masses_kg: np.ndarray
    centres_m: np.ndarray
    points_m: np.ndarray
    faces: SharedFaces
    in_lattices: np.ndarray


def fractured_members(
    scenario: Scenario, members: Sequence[Member], planes: Sequence[CutPlane | CutOfMembers] = ()
) -> FracturedMembers:
    """Return members in shards as a scenario asks for, cut along planes and boxes; a seed always gives the same."""
    settings = scenario.fracture
    density = _density(settings)
    own_points = _points_by_member(settings, members)
    rules = _rules(settings, members)
    with_bars = names_with_bars(scenario)
    counts = _counts(scenario, members, rules, own_points, density)
    seeds = np.random.SeedSequence(scenario.seed).generate_state(len(members))
    stations = _stations_m(scenario, members, counts, rules, own_points)
    if not density:
        stations |= _stations_of_boxes(scenario, members, counts, rules, own_points)
    own_cut = [len(points) > 0 or bool(rule and rule.stretch) for points, rule in zip(own_points, rules, strict=True)]
    on_columns = [slab for slab in slabs_on_columns(scenario, members) if not (density or own_cut[slab.member])]
    lattices = _lattices(on_columns, members, counts, scenario.seed)
    in_a_row = {row for slab in on_columns for row in slab.columns_in_a_row(members, counts) if not own_cut[row]}
    parts = []
    for index, member in enumerate(members):
        if member.steel is not None:
            parts.append(steel_fracture(member))
            continue
        rule = rules[index]
        options = FractureOptions(
            density=density,
            noise=settings.noise,
            stretch=rule.stretch if rule and rule.stretch else _along_parts(member) or settings.stretch,
            through_plates=bool({member.name, member.kind} & with_bars),
            recursion=_recursion(settings),
        )
        of_stations = len(member.parts or (member,)) * (1 + len(stations.get(index, ())))
        is_across = index in stations and counts[index] < _FEW * of_stations
        if index in in_a_row:
            is_across, options = True, replace(options, stretch=(_THROUGH_PART, _THROUGH_PART, 1.0))
        elif is_across:
            options = replace(options, stretch=options.stretch or (1.0, _THROUGH_PART, _THROUGH_PART))
        own_planes = [plane for plane in planes if isinstance(plane, CutPlane) and plane.member == member.name]
        cuts = [cut for cut in planes if isinstance(cut, CutOfMembers) and cut.cuts((member.name, member.kind))]
        whole = member
        if not len(own_points[index]):
            places = _clear_of_cuts(stations.get(index, ()), member, cuts)
            whole = _in_convex_parts(_across(member, places), int(counts[index]))
        cut = _cut_along(whole, own_planes, own_points[index]) if own_planes else whole
        if cuts and not len(own_points[index]) and (pieces := _in_pieces(cut, cuts)) is not cut:
            cut, options = pieces, replace(options, stretch=options.stretch or through_thickness(member.solid))
        # Each part takes one shard at least, but of those that a bridge is made of by rule.
        keeps_parts = member.keeps_parts or member.is_in_pieces or member.takes_all_parts
        as_planned = cut is whole and not (keeps_parts or index in stations)
        count = int(counts[index]) if as_planned else max(int(counts[index]), len(cut.parts))
        try:
            if index in lattices:
                found = _around_lattice(cut, lattices[index], options)
            else:
                found = _fractured(cut, count, own_points[index], int(seeds[index]), options)
            parts.append(replace(found, points=found.centres) if is_across else found)
        except GeometryError as error:
            files = [f"{table.file}: " for table in scenario.geometry if table.name == member.name]
            raise GeometryError(f"{files[0] if files else ''}{error}") from error
    shards = tuple(shard for part in parts for shard in part.shards)
    member_of_shard = np.repeat(np.arange(len(members)), [len(part) for part in parts])
    joints = bar_joints(members, member_of_shard)
    return FracturedMembers(
        shards=shards,
        member_of_shard=member_of_shard,
        masses_kg=np.concatenate([_masses(*pair, settings.mass) for pair in zip(members, parts, strict=True)]),
        centres_m=np.concatenate([part.centres for part in parts]),
        points_m=np.concatenate([part.points for part in parts]),
        faces=_all_faces(
            [part.faces for part in parts], joint_faces(joints, members), members, shards, member_of_shard
        ),
        in_lattices=np.isin(np.arange(len(members)), list(lattices)),
    )


def _along_parts(member: Member) -> tuple[float, float, float] | None:
    """Return the stretch of shards that go through their part of a deck on girders, along the road and upwards."""
    return (_THROUGH_PART, 1.0, _THROUGH_PART) if member.keeps_parts else None


def shards_with_gaps(fractured: FracturedMembers, members: Sequence[Member], gap_m: float) -> tuple[TriangleMesh, ...]:
    """Return the shards with gaps between shards of one member."""
    bounds = np.searchsorted(fractured.member_of_shard, np.arange(len(members) + 1))
    return tuple(
        shard
        for index, member in enumerate(members)
        for shard in with_gaps(
            fractured.shards[bounds[index] : bounds[index + 1]], member.solid, 0.0 if member.steel else gap_m
        )
    )


def shards_per_member(volumes: np.ndarray, shard_count: int) -> np.ndarray:
    """Return how many shards each member (k,) is cut into: by volume, at least one, `shard_count` together."""
    if shard_count < len(volumes):
        raise GeometryError(
            f"fracture.shards is {shard_count}: expected at least {len(volumes)}, one for each member of the bridge"
        )
    shares = volumes / volumes.sum() * (shard_count - len(volumes))
    counts = 1 + np.floor(shares).astype(int)
    largest_remainders = np.argsort(-(shares - np.floor(shares)), kind="stable")
    counts[largest_remainders[: shard_count - counts.sum()]] += 1
    return counts


def _density(settings: FractureSettings) -> PointDensity | None:
    densities = []
    if settings.finer:
        positions = np.array([position.position_m for position in settings.finer])
        radii, factors = (
            [position.radius_m for position in settings.finer],
            [position.factor for position in settings.finer],
        )
        densities.append(density_around(positions, radii, factors))
    if settings.painted_file is not None:
        densities.append(painted_density(*paint_from_file(Path(settings.painted_file)), settings.painted_factor))
    return densest(densities) if densities else None


def _in_convex_parts(member: Member, shards: int) -> Member:
    """Return a member to be cut into a number of shards, with convex parts: few of a user's own files are convex."""
    if member.parts:
        return member
    least_m3 = _LEAST_PART * member.volume_m3 / shards
    parts = _convex_parts(member.solid, max(shards, _MOST_CONVEX_PARTS), least_m3)
    if len(parts) > 1 and member.kind in _SPANNING and (pieces := _pieces_of_slender(member.solid, shards)):
        most = max(shards // len(pieces), _MOST_CONVEX_IN_PIECE)
        parts = tuple(part for piece in pieces for part in _convex_parts(piece, most, least_m3))
    return replace(member, parts=parts) if len(parts) > 1 else member


def _convex_parts(solid: TriangleMesh, most: int, least_m3: float) -> tuple[TriangleMesh, ...]:
    """Return a solid in convex parts; whole where one of them could not be cut."""
    vertices, triangles = np.ascontiguousarray(solid.vertices), np.ascontiguousarray(solid.triangles)
    parts = _parts_by_content(vertices.tobytes(), triangles.tobytes(), most, least_m3)
    return parts or (solid,)


@lru_cache(maxsize=_KEPT_SOLIDS)
def _parts_by_content(vertices: bytes, triangles: bytes, most: int, least_m3: float) -> tuple[TriangleMesh, ...]:
    """Return a solid in convex parts, kept: another cut of a bridge has the same; none where one could not be cut."""
    solid = TriangleMesh(np.frombuffer(vertices).reshape(-1, 3), np.frombuffer(triangles, np.int64).reshape(-1, 3))
    parts = convex_parts(solid, most, least_m3)
    return parts if len(parts) > 1 and all(_can_be_cut(part) for part in parts) else ()


def _can_be_cut(part: TriangleMesh) -> bool:
    try:
        fracture(part, 1)
    except GeometryError:
        return False
    return True


def _pieces_of_slender(solid: TriangleMesh, shards: int) -> tuple[TriangleMesh, ...]:
    """Return a slender solid in pieces across its length, before these become convex; none of any other.

    Convex parts of a long edge beam are as long as it is. As rigid as shards are, they would stiffen the deck.
    """
    lengths = np.ptp(solid.vertices, axis=0)
    axis = int(lengths.argmax())
    longest, middle, _ = sorted(lengths.tolist(), reverse=True)
    if longest < _SLENDER * middle:
        return ()
    count = max(math.ceil(longest / (_LONGEST_PIECE * middle)), min(shards // _SHARDS_OF_PIECE, _MOST_PIECES))
    count = min(count, shards)
    begin = float(solid.vertices[:, axis].min())
    pieces = slabs(solid, axis, [begin + longest * number / count for number in range(1, count)])
    return pieces if all(_can_be_cut(piece) for piece in pieces) else ()


def _fractured(member: Member, count: int, points: np.ndarray, seed: int, options: FractureOptions) -> Fracture:
    if member.volume_m3 / count < SHORTEST_LENGTH_M * SHORTEST_LENGTH_M * SHORTEST_LENGTH_M:
        raise GeometryError(
            f"{member.name}: {count} shards do not fit into {member.volume_m3:.4g} m³, as each would be smaller than "
            f"{SHORTEST_LENGTH_M} m; ask for fewer."
        )
    try:
        if len(points):
            return voronoi_cells(member.solid, points, seed, options)
        if 1 < len(member.parts) <= count or member.directions:
            return _fractured_in_parts(member, count, seed, options)
        return fracture(member.solid, count, seed, options)
    except GeometryError as error:
        raise GeometryError(f"{member.name}: {error}") from error


def _cut_along(member: Member, planes: Sequence[CutPlane], points: np.ndarray) -> Member:
    """Return a member whose parts end at planes, all across one axis, so that no shard lies across one."""
    if len(points):
        raise GeometryError(
            f"{member.name} has {planes[0].table}, along which it is cut, and {len(points)} points of fracture.points "
            "or its file: take these points out of it"
        )
    axis = AXES.index(planes[0].along)
    positions_m = [plane.position_m for plane in planes]
    pieces = [slabs(part, axis, positions_m) for part in member.parts or (member.solid,)]
    columns = zip(pieces, member.directions, strict=True) if member.directions else ()
    directions = tuple(direction for own, direction in columns for _ in own)
    return replace(member, parts=tuple(chain.from_iterable(pieces)), directions=directions)


def _stations_m(
    scenario: Scenario,
    members: Sequence[Member],
    counts: np.ndarray,
    rules: Sequence[MemberFracture | None],
    own_points: Sequence[np.ndarray],
) -> dict[int, list[float]]:
    """Return where girders and the slab that they are cast with are cut across together, by the members' indices.

    Cut elsewhere, each would hold the cuts of the other closed, and single girders be up to a fifth too stiff or soft.
    No piece is shorter than half of the depth of the T-beam; where there are more shards, each piece is cut into some.
    """
    found: dict[int, list[float]] = {}
    if scenario.bridge is None or scenario.bridge.girders is None:
        return found
    index_of = {member.name: index for index, member in enumerate(members)}
    for deck, girders in cast_decks(scenario.bridge):
        rows = [index_of[name] for name in (deck, *girders) if name in index_of]
        if len(rows) <= len(girders):
            continue
        along = members[rows[0]].without_skew(members[rows[0]].solid.vertices)[:, 0]
        begin, length = float(along.min()), float(np.ptp(along))
        shortest = 0.5 * (scenario.bridge.girders.depth_m + scenario.bridge.deck.thickness_m)
        alike = int(counts[rows].sum()) // (2 * len(girders))
        if min(alike, *counts[rows[1:]].tolist()) < 2 or counts[rows[0]] < 2 * len(girders):
            continue
        if alike * shortest < length and not any(rules[row] or len(own_points[row]) for row in rows):
            rest = int(counts[rows].sum()) - 2 * len(girders) * alike
            counts[rows] = [len(girders) * alike, *[alike] * len(girders)]
            others = [row for row in np.flatnonzero(counts).tolist() if row not in rows] or rows[:1]
            counts[max(others, key=lambda row: members[row].volume_m3)] += rest
        pieces = min(int(counts[rows[0]]) // len(girders), *counts[rows[1:]].tolist(), int(length / shortest))
        draw = np.random.default_rng([scenario.seed, rows[0]])
        # Rigid connections share no load by their stiffness, and are cut as they were in 2019.
        _, below_m = supports_below(members, rows[1], rows)
        supports = sorted(below_m[:, 0].tolist()) if scenario.connections.is_elastic else []
        places = _pieces_m(begin, begin + length, supports, pieces, shortest, draw)
        road = members[rows[0]].line
        if road is not None and road.bends_m is not None:
            places = _at_bends(road.bends_m, begin, begin + length, pieces)
        counts[rows] = np.maximum(counts[rows], (len(places) + 1) * np.array([len(girders), *[1] * len(girders)]))
        found |= dict.fromkeys(rows, places)
    return found


def _stations_of_boxes(
    scenario: Scenario,
    members: Sequence[Member],
    counts: np.ndarray,
    rules: Sequence[MemberFracture | None],
    own_points: Sequence[np.ndarray],
) -> dict[int, list[float]]:
    """Return where straight box girders are cut across, all of their plates together, by the members' indices.

    Cut elsewhere, each plate would hold the cuts of the others closed, and single bearings have up to twice their
    share. Each plate of a piece is one shard, but where there are more than twice as many.
    """
    found: dict[int, list[float]] = {}
    bridge = scenario.bridge
    if bridge is None or bridge.box_girder is None or not scenario.connections.is_elastic or scenario.fracture.stretch:
        return found
    deep = bridge.box_girder.depth_m + bridge.deck.thickness_m
    for row, member in enumerate(members):
        if member.kind != "deck" or not member.parts or member.line or rules[row] or len(own_points[row]):
            continue
        along, plates = member.without_skew(member.solid.vertices)[:, 0], len(member.parts)
        begin, end = float(along.min()), float(along.max())
        _, below_m = supports_below(members, row, [row])
        supports = np.unique(below_m[:, 0].round(_DECIMALS)).tolist()
        least = len(supports) + _LEAST_OF_BOX * max(len(supports) - 1, 1)
        pieces = max(min(int(counts[row]) // plates, int((end - begin) / (_SHORTEST_OF_BOX * deep))), least)
        draw = np.random.default_rng([scenario.seed, row])
        found[row] = _pieces_m(begin, end, supports, pieces, 0.5 * deep, draw)
        each = plates * (len(found[row]) + 1)
        counts[row] = each if counts[row] < _FEW * each else counts[row]
    return found


def _lattices(
    on_columns: Sequence[SlabOnColumns], members: Sequence[Member], counts: np.ndarray, seed: int
) -> dict[int, np.ndarray]:
    """Return the points that slabs on columns are cut around, by the members' indices."""
    found = {}
    for slab in on_columns:
        points = slab.points_m(int(counts[slab.member]), np.random.default_rng([seed, slab.member]))
        if len(points):
            found[slab.member] = members[slab.member].with_skew(points)
    return found


def _around_lattice(member: Member, points: np.ndarray, options: FractureOptions) -> Fracture:
    """Cut each part of a member around the points that are in it, or whole where none is."""
    parts = member.parts or (member.solid,)
    within = [points[contains(part, points)] for part in parts]
    own = [
        inside if len(inside) else part.vertices.mean(axis=0)[None] for part, inside in zip(parts, within, strict=True)
    ]
    return joined_fractures([voronoi_cells(part, inside, 0, options) for part, inside in zip(parts, own, strict=True)])


def _pieces_m(
    begin: float, end: float, supports_m: Sequence[float], pieces: int, shortest: float, draw: np.random.Generator
) -> list[float]:
    """Return where girders between two ends are cut into pieces: into short ones above supports, if there are enough.

    What lies on a support does not twist there. Were it longer, the slab next to it would not either, and would carry
    far too much from one girder to the next.
    """
    edges = [begin]
    for at in supports_m:
        low, high = at - 0.5 * shortest, at + 0.5 * shortest
        # An end just beyond a support is part of the piece above that.
        if low - begin < shortest:
            low, high = begin, max(high, 2.0 * at - begin)
        if end - high < shortest:
            low, high = min(low, 2.0 * at - end), end
        edges += [low, high]
    clear = [stretch for stretch in np.reshape([*edges, end], (-1, 2)).tolist() if stretch[0] != stretch[1]]
    lengths = np.array([high - low for low, high in clear])
    rest = max(pieces - len(supports_m), _LEAST_IN_CLEAR * len(clear) * bool(supports_m))
    if not supports_m or (lengths < _LEAST_IN_CLEAR * shortest).any():
        clear, lengths, rest = [[begin, end]], np.array([end - begin]), max(pieces, 1)
    places = []
    for (low, high), count in zip(clear, shards_per_member(lengths, rest).tolist(), strict=True):
        moved = 0.5 * draw.random(count - 1) - 0.25
        places += [low, *(low + (high - low) * (np.arange(1, count) + moved) / count).tolist(), high]
    return sorted(place for place in places if begin < place < end)


def _at_bends(bends_m: np.ndarray, begin: float, end: float, pieces: int) -> list[float]:
    """Return where girders on a curve are cut: at all of its bends, so that pieces are convex, and evenly between."""
    ends = [begin, *(bend for bend in bends_m.tolist() if begin + _THIN_M < bend < end - _THIN_M), end]
    counts = [max(round(pieces * (after - before) / (end - begin)), 1) for before, after in pairwise(ends)]
    parts = [np.linspace(*side, count + 1)[:-1].tolist() for side, count in zip(pairwise(ends), counts, strict=True)]
    return [place for part in parts for place in part][1:]


def _clear_of_cuts(stations_m: Sequence[float], member: Member, cuts: Sequence[CutOfMembers]) -> list[float]:
    """Return the stations that leave no thin slice along a plane or the side of a box, along which a member ends."""
    if not len(stations_m) or not cuts:
        return list(stations_m)
    along = [member.without_skew(part.vertices)[:, 0] for part in _in_pieces(member, cuts).parts]
    ends = np.array([(part.min(), part.max()) for part in along]).ravel()
    return [station for station in stations_m if not (abs(ends - station) < _THIN_M).any()]


def _across(member: Member, stations_m: Sequence[float]) -> Member:
    """Return a member in parts that end at stations along the road, square to its own axis."""
    if not len(stations_m):
        return member
    parts = [replace(part, vertices=member.without_skew(part.vertices)) for part in member.parts or (member.solid,)]
    # On a road that bends, corners are needed where it does, though a straight part has none there.
    cut = slabs if member.line is None else _prisms
    pieces = (piece for part in parts for piece in cut(part, 0, stations_m))
    return replace(member, parts=tuple(replace(piece, vertices=member.with_skew(piece.vertices)) for piece in pieces))


def _prisms(part: TriangleMesh, axis: int, stations_m: Sequence[float]) -> Iterator[TriangleMesh]:
    """Yield a straight part, level on both sides, between stations, with all its corners along and across the road."""
    x, y = (np.unique(part.vertices[:, side].round(_DECIMALS)) for side in (axis, 1 - axis))
    low, high = float(part.vertices[:, 2].min()), float(part.vertices[:, 2].max())
    ends = [x[0], *(station for station in stations_m if x[0] < station < x[-1]), x[-1]]
    for begin, end in pairwise(ends):
        along = [begin, *x[(x > begin + _THIN_M) & (x < end - _THIN_M)], end]
        yield road_prism(along, y.tolist(), [low] * len(along), [high] * len(along))


def _in_pieces(member: Member, cuts: Sequence[CutOfMembers]) -> Member:
    """Return a member whose parts end at planes and the sides of boxes; the member itself where none meets it."""
    parts, directions = member.parts or (member.solid,), member.directions
    # Boxes first, so that a plane along the side of one cuts nothing more.
    for cut in sorted(cuts, key=lambda cut: isinstance(cut, CutThrough)):
        pieces = [_pieces(part, cut) for part in parts]
        columns = zip(pieces, directions, strict=True) if directions else ()
        directions = tuple(direction for own, direction in columns for _ in own)
        parts = tuple(chain.from_iterable(pieces))
    if len(parts) == len(member.parts or (member.solid,)):
        return member
    return replace(member, parts=parts, directions=directions)


def _pieces(part: TriangleMesh, cut: CutOfMembers) -> tuple[TriangleMesh, ...]:
    match cut:
        case CutBox():
            return cut_out(part, cut.box)
        case CutThrough():
            return cut_through(part, np.array(cut.point_m), np.array(cut.normal), cut.box)
    raise TypeError(cut)


def _fractured_in_parts(member: Member, count: int, seed: int, options: FractureOptions) -> Fracture:
    """Cut each convex part by itself, so that no shard extends around a corner."""
    amounts = np.array([_amount(part, options.density, seed) for part in member.parts])
    seeds = np.random.SeedSequence(seed).generate_state(len(member.parts))
    counts = shards_per_member(amounts, count)
    directions = member.directions or (None,) * len(member.parts)
    columns = zip(member.parts, counts.tolist(), seeds.tolist(), directions, strict=True)
    return joined_fractures([_fractured_part(*column, options) for column in columns])


def _fractured_part(
    part: TriangleMesh, count: int, seed: int, direction: tuple[float, float] | None, options: FractureOptions
) -> Fracture:
    """Cut a convex part; at other points where its seed's points meet what is left of a warped face."""
    for attempt in range(_MOST_ATTEMPTS - 1):
        try:
            return _fractured_once(part, count, seed + attempt, direction, options)
        except GeometryError:
            continue
    return _fractured_once(part, count, seed + _MOST_ATTEMPTS - 1, direction, options)


def _fractured_once(
    part: TriangleMesh, count: int, seed: int, direction: tuple[float, float] | None, options: FractureOptions
) -> Fracture:
    if direction is None:
        return fracture(part, count, seed, options)
    return inclined_fracture(part, count, seed, options, direction)


def _masses(member: Member, part: Fracture, mass: str) -> np.ndarray:
    density = given(member.density_kg_m3)
    if mass == "uniform":
        return np.full(len(part), density * part.volumes.sum() / len(part))
    return density * part.volumes


def _recursion(settings: FractureSettings) -> Recursion | None:
    if settings.recursion_share == 0.0:
        return None
    return Recursion(settings.recursion_share, settings.recursion_shards, settings.recursion_smallest_m3)


def _rules(settings: FractureSettings, members: Sequence[Member]) -> list[MemberFracture | None]:
    """Return the table for each member by its name, or else for its kind."""
    by_name = {rule.member: rule for rule in settings.members}
    for name in by_name:
        members_named(name, members, "fracture.members.member")
    return [by_name.get(member.name) or by_name.get(member.kind) for member in members]


def _counts(
    scenario: Scenario,
    members: Sequence[Member],
    rules: Sequence[MemberFracture | None],
    own_points: Sequence[np.ndarray],
    density: PointDensity | None,
) -> np.ndarray:
    """Return the shards of each member (k,); 0 of steelwork, which is cut into pieces of its own."""
    settings = scenario.fracture
    cut = np.array([member.steel is None for member in members])
    counts = np.zeros(len(members), int)
    if not cut.any():
        return counts
    amounts = np.array([_amount(member.solid, density, scenario.seed) for member in members if member.steel is None])
    cut_rules = [rules[index] for index in np.flatnonzero(cut).tolist()]
    own = _explicit_counts(cut_rules, [own_points[index] for index in np.flatnonzero(cut).tolist()])
    own = _shared_counts(own, settings, cut_rules, amounts)
    counts[cut] = _distribute_rest(own, amounts, settings.shards)
    return counts


def _explicit_counts(rules: Sequence[MemberFracture | None], own_points: Sequence[np.ndarray]) -> np.ndarray:
    """Return shards (k,) of members with points or a number of their own; 0 of any other."""
    columns = zip(own_points, rules, strict=True)
    return np.array([len(points) or (rule.shards if rule else None) or 0 for points, rule in columns])


def _shared_counts(
    counts: np.ndarray, settings: FractureSettings, rules: Sequence[MemberFracture | None], amounts: np.ndarray
) -> np.ndarray:
    """Return the counts (k,), with the counts of members (k,) that together get a share of the shards."""
    counts = counts.copy()
    for rule in settings.members:
        alike = np.array([other is rule for other in rules]) & (counts == 0)
        if rule.share is not None and alike.any():
            together = max(int(alike.sum()), round(rule.share * settings.shards))
            counts[alike] = shards_per_member(amounts[alike], together)
    return counts


def _distribute_rest(counts: np.ndarray, amounts: np.ndarray, wanted: int) -> np.ndarray:
    """Return the counts (k,), with the rest distributed by volume among members that have none yet."""
    is_open, taken = counts == 0, int(counts.sum())
    if is_open.all():
        return shards_per_member(amounts, wanted)
    if not is_open.any():
        if taken == wanted:
            return counts
        raise GeometryError(
            f"fracture.shards is {wanted}: expected {taken}, as every member has points or a number of its own"
        )
    if wanted - taken < is_open.sum():
        raise GeometryError(
            f"fracture.shards is {wanted}: expected at least {taken + int(is_open.sum())}, as {taken} are for members "
            "with points or a number of their own and the others need one each"
        )
    counts = counts.copy()
    counts[is_open] = shards_per_member(amounts[is_open], wanted - taken)
    return counts


def _amount(solid: TriangleMesh, density: PointDensity | None, seed: int) -> float:
    """Return the volume of a solid, m³; where points lie closer it counts as many times."""
    if density is None:
        return solid.volume
    samples = random_points(solid, _DENSITY_SAMPLES, np.random.default_rng(seed))
    return solid.volume * float(density.at(samples).mean())


def _points_by_member(settings: FractureSettings, members: Sequence[Member]) -> list[np.ndarray]:
    """Return the points of the user's own in each member, (p, 3) in m."""
    positions = [point.position_m for point in settings.points]
    if settings.points_file is not None:
        positions += points_from_file(Path(settings.points_file)).tolist()
    points = np.array(positions, dtype=float).reshape(-1, 3)
    if not len(points):
        return [points] * len(members)
    inside = np.array([contains(member.solid, points) for member in members])
    outside = np.flatnonzero(~inside.any(axis=0))
    if len(outside):
        raise GeometryError(
            f"{len(outside)} of {len(points)} points of fracture.points and its file lie in no member, the first at "
            f"{points[outside[0]].tolist()} m; move or drop them."
        )
    first = inside.argmax(axis=0)
    return [points[first == index] for index in range(len(members))]


def _all_faces(
    within: list[SharedFaces],
    of_joints: SharedFaces,
    members: Sequence[Member],
    shards: tuple[TriangleMesh, ...],
    member_of_shard: np.ndarray,
) -> SharedFaces:
    """Return the faces within members, of joints of bars, and where members touch; steelwork does only at joints."""
    first_shards = np.searchsorted(member_of_shard, np.arange(len(within)))
    numbered = [replace(faces, pairs=faces.pairs + first) for faces, first in zip(within, first_shards, strict=True)]
    is_steel = np.array([member.steel is not None for member in members])
    groups = np.where(is_steel[member_of_shard], -1, member_of_shard)
    return joined_faces([*numbered, of_joints, touching_faces(shards, member=groups)])
