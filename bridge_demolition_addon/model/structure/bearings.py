"""Bearings between members: where their pads are, and which shards these connect."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.elasticity.bearings import PadSprings
from ...engineering.geometry.level_contacts import LevelContact, level_contacts
from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.solids import contains, from_manifold, to_manifold
from ...engineering.geometry.vectors import dot
from ...engineering.structure.connections import Connections
from ...errors import ScenarioError
from ..bridge.member import Member
from ..scenario.bearings import Bearing, BearingOfBridge, names_one
from ..scenario.scenario import JointName, bearing_tables
from ..schema import shown
from .connection_source import ConnectionRows, ConnectionSource, CutBridge
from .model_bearings import ModelBearings

_SPRINGS_OF_LINE = 64
_SPRINGS_OF_PAD = 16
"""Springs across the road, along a line and under a pad: with them shards beside each other share it within 2 %."""

_INTO_M = 1e-3
"""How far into both members the shards at a spring are looked for."""

_NUDGES_M = 1e-3 * np.array([(0.0, 0.0, 0.0), (1.0, 0.5, 0.0), (-1.0, 0.5, 0.0), (0.5, -1.0, 0.0), (-0.5, -1.0, 0.0)])
"""What is just between two shards is looked for beside that."""

_BESIDE_M = 0.25
"""How far from the area in which members touch the one above is made thinner: shards move that far at most."""

_ON_PLANE_M = 1e-4


@dataclass(frozen=True, slots=True, eq=False)
class _PlacedBearing:
    """A bearing between two members, by their indices."""

    table: int  # which table of the scenario says how it is
    above: int
    below: int
    contacts: tuple[LevelContact, ...]


class Pads(ConnectionSource):
    """Connections at the pads of bearings: of each the first shard lies above."""

    def __init__(self, cut: CutBridge):
        super().__init__(cut)
        self._tables = bearing_tables(cut.scenario)
        self._placed = _placed_bearings(self._tables, cut.members)

    def takes(self, pairs: np.ndarray) -> np.ndarray:
        """Return which pairs (k, 2) are of two members with a bearing."""
        members, found = self.cut.members_of(pairs), np.zeros(len(pairs), bool)
        for bearing in self._placed:
            for one, other in ((bearing.above, bearing.below), (bearing.below, bearing.above)):
                found |= (members[:, 0] == one) & (members[:, 1] == other)
        return found

    def added(self, rows: ConnectionRows) -> ConnectionRows:
        """Return the connections at pads: the area of each is its share of that where the members touch."""
        if not self._placed:
            return rows
        cut, names, groups = self.cut, [], []
        for number, bearing in enumerate(self._placed):
            name = f"{cut.members[bearing.above].name} on {cut.members[bearing.below].name}"
            names.append(name)
            pads = list(_pads(self._tables[bearing.table], bearing, name))
            places = np.concatenate([pad.places_m for pad in pads])
            sides = ((bearing.above, _INTO_M), (bearing.below, -_INTO_M))
            pairs = [
                shards_at(
                    places + np.array([0.0, 0.0, into_m]), np.flatnonzero(cut.member_of_shard == member), cut.shards
                )
                for member, into_m in sides
            ]
            groups += _groups(number, name, pads, np.column_stack(pairs))
        tables = [self._placed[group.bearing].table for group in groups]
        springs = _springs(groups, [self._tables[table] for table in tables], cut.scenario.connections.strength_factor)
        connections = Connections(
            np.array([group.pair for group in groups], int).reshape(len(groups), 2),
            springs.middles_m(),
            np.array([group.area_m2 for group in groups], float),
            np.tile([0.0, 0.0, -1.0], (len(groups), 1)),
        )
        joints = np.array([cut.joint_rows[JointName("bearing", table)] for table in tables], int)
        followed, moves = rows.followed_by(cut, "pads", connections, joints)
        return followed.on_bearings(ModelBearings(tuple(names), springs).among(moves, len(rows)))

    def shaped(self, shards: tuple[TriangleMesh, ...]) -> tuple[TriangleMesh, ...]:
        """Thin shards on bearings from below: only the pads touch both members."""
        changed = list(shards)
        for bearing in self._placed:
            for shard in np.flatnonzero(self.cut.member_of_shard == bearing.above).tolist():
                for contact in bearing.contacts:
                    changed[shard] = _raised(changed[shard], contact, self._tables[bearing.table].height_m)
        return tuple(changed)


def _placed_bearings(tables: Sequence[Bearing], members: Sequence[Member]) -> list[_PlacedBearing]:
    """Return the bearings between all members that tables name and that lie on each other."""
    placed: dict[tuple[int, int], _PlacedBearing] = {}
    for number, table in enumerate(tables):
        above, below = (_named(members, name, _source(table, number)) for name in table.members)
        pairs = [(one, other) for one in above for other in below if one != other]
        found = [
            _PlacedBearing(number, one, other, tuple(contacts))
            for one, other in pairs
            if (contacts := level_contacts(members[one].solid, members[other].solid))
        ]
        if not found:
            turned = any(level_contacts(members[other].solid, members[one].solid) for one, other in pairs)
            hint = "the first lies below: give it as the second" if turned else "the first to lie on the second"
            raise ScenarioError(
                f"{_source(table, number)}: members are {' and '.join(map(shown, table.members))}: expected "
                f"{hint}, with level faces that touch"
            )
        for bearing in found:
            placed.setdefault((bearing.above, bearing.below), bearing)
    return list(placed.values())


@dataclass(frozen=True, slots=True, eq=False)
class _Pad:
    """Springs of one pad (p,)."""

    places_m: np.ndarray
    area_m2: float  # share of the area where the members touch
    vertical_n_m: float
    row: np.ndarray  # (p,), before or behind its axis, if it has two rows


@dataclass(frozen=True, slots=True, eq=False)
class _Group:
    """Springs of a connection."""

    bearing: int
    pair: tuple[int, int]
    places_m: np.ndarray
    shares: np.ndarray  # (p,), of the stiffness of a pad
    vertical_n_m: np.ndarray  # (p,), stiffness
    area_m2: float


def _source(table: Bearing, number: int) -> str:
    """Where a scenario says a bearing, for a message."""
    return table.source if isinstance(table, BearingOfBridge) else f"[[bearings]] number {number + 1}"


def _named(members: Sequence[Member], pattern: str, source: str) -> list[int]:
    chosen = [index for index, member in enumerate(members) if names_one(pattern, member.name, member.kind)]
    if not chosen:
        known = ", ".join(sorted({member.name for member in members} | {member.kind for member in members}))
        raise ScenarioError(
            f"{source}: members has {shown(pattern)}: expected names or kinds of members, such as {known}"
        )
    return chosen


def _pads(table: Bearing, bearing: _PlacedBearing, name: str) -> Iterator[_Pad]:
    """Yield the pads of a bearing, in each area where its members touch."""
    for contact in bearing.contacts:
        chords = contact.axis_chords(table.offset_m)
        if not len(chords):
            raise ScenarioError(
                f"bearings.offset_m is {table.offset_m:g}: expected an axis where {name} touch, around "
                f"x = {contact.middle_m[0]:g} m"
            )
        width = float((chords[:, 1] - chords[:, 0]).sum()) * float(contact.direction[1])
        arm = table.arm_m(contact.area_m2 / width)
        is_line = table.pads is None and table.positions_m is None
        vertical_n_m = table.line_n_m(width) if is_line else table.vertical_n_m
        spots = list(_spots(table, chords))
        if not all(map(len, spots)):
            raise ScenarioError(
                f"a pad of the bearing {name} lies beside the area where they touch: expected fewer, narrower or "
                f"closer ones, on {chords[-1, 1] - chords[0, 0]:.4g} m"
            )
        for along in spots:
            rows = (-1.0, 1.0) if arm else (0.0,)
            shifts = np.concatenate([np.full(len(along), table.offset_m + row * arm) for row in rows])
            places = contact.at(np.tile(along, len(rows)), shifts)
            yield _Pad(places, contact.area_m2 / len(spots), vertical_n_m, np.repeat(rows, len(along)))


def _spots(table: Bearing, chords: np.ndarray) -> Iterator[np.ndarray]:
    """Yield the positions (p,) of the springs of each pad along the axis, m."""
    low, high = chords[0, 0], chords[-1, 1]
    if table.pads is None and table.positions_m is None:
        yield _spread(chords, _SPRINGS_OF_LINE)
        return
    middle = 0.5 * (low + high)
    if table.positions_m is not None:
        centres = middle + np.array(table.positions_m)
    else:
        count = table.pads or 1
        spacing = (high - low) / count if table.spacing_m is None else table.spacing_m
        centres = middle + spacing * (np.arange(count) - 0.5 * (count - 1))
    for centre in centres.tolist():
        if table.pad_m is None:
            along = np.array([centre])
        else:
            half = 0.5 * table.pad_m[1]
            along = _spread(np.array([[centre - half, centre + half]]), _SPRINGS_OF_PAD)
        within = ((along[:, None] >= chords[:, 0]) & (along[:, None] <= chords[:, 1])).any(axis=1)
        yield along[within]


def _spread(chords: np.ndarray, count: int) -> np.ndarray:
    """Return the middles (count,) of even parts of stretches (k, 2)."""
    lengths = chords[:, 1] - chords[:, 0]
    ends = np.cumsum(lengths)
    along = ends[-1] * (np.arange(count) + 0.5) / count
    chord = np.searchsorted(ends, along)
    return np.asarray(chords[chord, 0] + along - (ends - lengths)[chord])


def shards_at(points_m: np.ndarray, candidates: np.ndarray, shards: Sequence[TriangleMesh]) -> np.ndarray:
    """Return the shard (p,) of some that each point (p, 3) is in, or -1; between two shards it is in one of them."""
    found = np.full(len(points_m), -1)
    for nudge_m in _NUDGES_M:
        nudged = points_m + nudge_m
        for shard in candidates.tolist():
            low, high = shards[shard].bounds
            near = np.flatnonzero((found < 0) & (nudged >= low).all(axis=1) & (nudged <= high).all(axis=1))
            if len(near):
                found[near[contains(shards[shard], nudged[near])]] = shard
        if (found >= 0).all():
            break
    return found


def _groups(number: int, name: str, pads: Sequence[_Pad], pairs: np.ndarray) -> list[_Group]:
    """Return the springs of pads by the pair of shards (p, 2) that they are between."""
    shares = []
    first = 0
    for pad in pads:
        of_pad = slice(first, first + len(pad.places_m))
        first = of_pad.stop
        lies = (pairs[of_pad] >= 0).all(axis=1)
        rows = np.unique(pad.row)
        if not all(lies[pad.row == row].any() for row in rows.tolist()):
            raise ScenarioError(
                f"a pad of the bearing {name} is longer than the area where they touch: expected a shorter "
                "bearings.pad_m, or a smaller bearings.rotation_mnm_rad"
            )
        counts = np.array([np.count_nonzero(lies & (pad.row == row)) for row in pad.row.tolist()])
        shares.append(np.where(lies, 1.0 / (np.maximum(counts, 1) * len(rows)), 0.0))
    share = np.concatenate(shares)
    areas = np.concatenate([np.full(len(pad.places_m), pad.area_m2) for pad in pads])
    places = np.concatenate([pad.places_m for pad in pads])
    vertical = share * np.concatenate([np.full(len(pad.places_m), pad.vertical_n_m) for pad in pads])
    chosen = np.flatnonzero(share > 0.0)
    unique, of_pair = np.unique(pairs[chosen], axis=0, return_inverse=True)
    of_pair = of_pair.ravel()
    return [
        _Group(
            number,
            (int(pair[0]), int(pair[1])),
            places[chosen[of_pair == row]],
            share[chosen[of_pair == row]],
            vertical[chosen[of_pair == row]],
            float((areas * share)[chosen[of_pair == row]].sum()),
        )
        for row, pair in enumerate(unique)
    ]


def _springs(groups: Sequence[_Group], tables: Sequence[Bearing], strength_factor: float) -> PadSprings:
    """Return the springs of connections, each with its table."""
    count, columns = len(groups), list(zip(groups, tables, strict=True))
    return PadSprings(
        rows=np.arange(count),
        parts=np.repeat(np.arange(count), [len(group.shares) for group in groups]),
        places_m=np.concatenate([group.places_m for group in groups]),
        vertical_n_m=np.concatenate([group.vertical_n_m for group in groups]),
        sideways_n_m=np.concatenate([np.multiply.outer(group.shares, table.sideways_n_m) for group, table in columns]),
        friction=np.array([table.slides_at for table in tables], float),
        pulls=np.array([table.tension for table in tables], bool),
        travel_m=np.array([table.travel_m for table in tables], float),
        bearings=np.array([group.bearing for group in groups], int),
        breaking_n=strength_factor * np.array([table.breaking_force_n or np.inf for table in tables], float),
    )


def _raised(shard: TriangleMesh, contact: LevelContact, height_m: float) -> TriangleMesh:
    """Return a shard cut off above the plane of a contact, if it stands on that plane near the contact."""
    corners = np.concatenate(contact.rings)
    low, high = corners.min(axis=0) - _BESIDE_M, corners.max(axis=0) + _BESIDE_M
    if (shard.bounds[1, :2] < low).any() or (shard.bounds[0, :2] > high).any():
        return shard
    normal, offset_m = contact.plane
    heights = dot(shard.vertices, normal) - offset_m
    if abs(heights.min()) > _ON_PLANE_M:
        return shard
    height_m = min(height_m, 0.5 * float(heights.max()))
    return from_manifold(to_manifold(shard).trim_by_plane(normal.tolist(), offset_m + height_m))
