"""Bearings of a model: where their pads are, which shards these connect, and the forces that they carry."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.elasticity.bearings import PadSprings
from ...engineering.geometry.level_contacts import LevelContact, level_contacts
from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.solids import contains, from_manifold, to_manifold
from ...engineering.geometry.vectors import cross, dot
from ...engineering.mechanics.section_cuts import ConnectionLoads
from ...engineering.structure.connections import Connections
from ...errors import ScenarioError
from ..bridge.member import Member
from ..scenario.bearings import Bearing, BearingOfBridge, names_one
from ..schema import shown

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
class PlacedBearing:
    """A bearing between two members, by their indices."""

    table: int  # which table of the scenario says how it is
    above: int
    below: int
    contacts: tuple[LevelContact, ...]


@dataclass(frozen=True, slots=True, eq=False)
class ModelBearings:
    """The b bearings of a model, and the springs of their pads in its connections."""

    names: tuple[str, ...]
    springs: PadSprings

    def followed_by(self, springs: PadSprings, names: tuple[str, ...]) -> ModelBearings:
        """Return these bearings and others, whose springs count on from theirs."""
        return ModelBearings((*self.names, *names), self.springs.followed_by(springs))

    def rows_of(self, bearing: int) -> np.ndarray:
        """Return the connections (k,) of a bearing."""
        return self.springs.rows[self.springs.bearings == bearing]

    def forces(self, loads: ConnectionLoads) -> list[BearingForce]:
        """Return the force of each bearing, by the loads of all connections on their first bodies."""
        return [self._force(number, loads) for number in range(len(self.names))]

    def utilisations(self, loads: ConnectionLoads, intact: np.ndarray, left: np.ndarray) -> np.ndarray:
        """Return the part (c,) of its breaking force that the bearing of each of its connections carries.

        All connections (m,) are `intact` or not, and have a part `left` of their strength.
        """
        rows = self.springs.rows
        return self.springs.utilisations((loads.forces_n[rows] * intact[rows, None]).T, left[rows])

    def broken_together(self, rows: np.ndarray) -> np.ndarray:
        """Return connections (k,) that break, with all others of the bearings among them."""
        bearings = self.springs.bearings[np.isin(self.springs.rows, rows)]
        return np.union1d(rows, self.springs.rows[np.isin(self.springs.bearings, bearings)])

    def _force(self, number: int, loads: ConnectionLoads) -> BearingForce:
        rows = self.rows_of(number)
        of_springs = np.isin(self.springs.parts, np.flatnonzero(self.springs.bearings == number))
        axis = self.springs.places_m[of_springs].mean(axis=0) if len(rows) else np.zeros(3)
        moments = loads.moments_nm[rows] + cross(loads.points_m[rows] - axis, loads.forces_n[rows])
        return BearingForce(self.names[number], axis, loads.forces_n[rows].sum(axis=0), moments.sum(axis=0))


@dataclass(frozen=True, slots=True, eq=False)
class BearingForce:
    """Force of a bearing on what lies above it, N, and its moment about the middle of its axis, N·m; all (3,)."""

    name: str
    axis_m: np.ndarray
    force_n: np.ndarray
    moment_nm: np.ndarray


def placed_bearings(tables: Sequence[Bearing], members: Sequence[Member]) -> list[PlacedBearing]:
    """Return the bearings between all members that tables name and that lie on each other."""
    placed: dict[tuple[int, int], PlacedBearing] = {}
    for number, table in enumerate(tables):
        above, below = (_named(members, name, _source(table, number)) for name in table.members)
        pairs = [(one, other) for one in above for other in below if one != other]
        found = [
            PlacedBearing(number, one, other, tuple(contacts))
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


def have_bearing(placed: Sequence[PlacedBearing], member_of_shard: np.ndarray, pairs: np.ndarray) -> np.ndarray:
    """Return which pairs (k, 2) of shards, or of one and the ground, are of two members with a bearing."""
    of_body = np.append(member_of_shard, -1)[pairs]
    found = np.zeros(len(pairs), bool)
    for bearing in placed:
        for one, other in ((bearing.above, bearing.below), (bearing.below, bearing.above)):
            found |= (of_body[:, 0] == one) & (of_body[:, 1] == other)
    return found


def bearing_connections(
    placed: Sequence[PlacedBearing],
    tables: Sequence[Bearing],
    members: Sequence[Member],
    member_of_shard: np.ndarray,
    shards: Sequence[TriangleMesh],
    first_row: int,
    strength_factor: float,
) -> tuple[Connections, ModelBearings, np.ndarray]:
    """Return the connections at pads, their bearings, and the table of each (c,); rows are counted from `first_row`.

    Of each connection the first shard lies above. Its area is its share of that where the members touch. Breaking
    forces are as many times as large as their tables say.
    """
    names, groups = [], []
    for number, bearing in enumerate(placed):
        table = tables[bearing.table]
        name = f"{members[bearing.above].name} on {members[bearing.below].name}"
        names.append(name)
        pads = list(_pads(table, bearing, name))
        places = np.concatenate([pad.places_m for pad in pads])
        sides = ((bearing.above, _INTO_M), (bearing.below, -_INTO_M))
        pairs = [
            shards_at(places + np.array([0.0, 0.0, into_m]), np.flatnonzero(member_of_shard == member), shards)
            for member, into_m in sides
        ]
        groups += _groups(number, name, pads, np.column_stack(pairs))
    return _joined(groups, tables, placed, first_row, names, strength_factor)


def raised_shards(
    shards: tuple[TriangleMesh, ...],
    placed: Sequence[PlacedBearing],
    tables: Sequence[Bearing],
    member_of_shard: np.ndarray,
) -> tuple[TriangleMesh, ...]:
    """Return shards of which those on bearings are thinner from below: only the pads touch both members."""
    changed = list(shards)
    for bearing in placed:
        for shard in np.flatnonzero(member_of_shard == bearing.above).tolist():
            for contact in bearing.contacts:
                changed[shard] = _raised(changed[shard], contact, tables[bearing.table].height_m)
    return tuple(changed)


@dataclass(frozen=True, slots=True, eq=False)
class _Pad:
    """Springs of one pad (p,)."""

    places_m: np.ndarray
    area_m2: float  # share of the area where the members touch
    row: np.ndarray  # (p,), before or behind its axis, if it has two rows


@dataclass(frozen=True, slots=True, eq=False)
class _Group:
    """Springs of a connection."""

    bearing: int
    pair: tuple[int, int]
    places_m: np.ndarray
    shares: np.ndarray  # (p,), of the stiffness of a pad
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


def _pads(table: Bearing, bearing: PlacedBearing, name: str) -> Iterator[_Pad]:
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
            yield _Pad(places, contact.area_m2 / len(spots), np.repeat(rows, len(along)))


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
    """Return the springs of all pads by the pair of shards (p, 2) that they are between."""
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
    chosen = np.flatnonzero(share > 0.0)
    unique, of_pair = np.unique(pairs[chosen], axis=0, return_inverse=True)
    of_pair = of_pair.ravel()
    return [
        _Group(
            number,
            (int(pair[0]), int(pair[1])),
            places[chosen[of_pair == row]],
            share[chosen[of_pair == row]],
            float((areas * share)[chosen[of_pair == row]].sum()),
        )
        for row, pair in enumerate(unique)
    ]


def _joined(
    groups: Sequence[_Group],
    tables: Sequence[Bearing],
    placed: Sequence[PlacedBearing],
    first_row: int,
    names: Sequence[str],
    strength_factor: float,
) -> tuple[Connections, ModelBearings, np.ndarray]:
    count = len(groups)
    table_of = np.array([placed[group.bearing].table for group in groups], int)
    of_groups = [tables[table] for table in table_of.tolist()]
    columns = list(zip(groups, of_groups, strict=True))
    springs = PadSprings(
        rows=first_row + np.arange(count),
        parts=np.repeat(np.arange(count), [len(group.shares) for group in groups]),
        places_m=np.concatenate([group.places_m for group in groups]),
        vertical_n_m=np.concatenate([table.vertical_n_m * group.shares for group, table in columns]),
        sideways_n_m=np.concatenate([np.multiply.outer(group.shares, table.sideways_n_m) for group, table in columns]),
        friction=np.array([table.slides_at for table in of_groups], float),
        pulls=np.array([table.tension for table in of_groups], bool),
        travel_m=np.array([table.travel_m for table in of_groups], float),
        bearings=np.array([group.bearing for group in groups], int),
        breaking_n=strength_factor * np.array([table.breaking_force_n or np.inf for table in of_groups], float),
    )
    connections = Connections(
        np.array([group.pair for group in groups], int).reshape(count, 2),
        springs.middles_m(),
        np.array([group.area_m2 for group in groups], float),
        np.tile([0.0, 0.0, -1.0], (count, 1)),
    )
    return connections, ModelBearings(tuple(names), springs), table_of


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
