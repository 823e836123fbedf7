"""Decks on girders of steel: where shards of a deck lie on pieces of girders, and the studs or the friction there."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from ...engineering.elasticity.bearings import PadSprings
from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.structure.connections import Connections
from ..bridge.member import Member
from ..scenario.girders import GirderSpan, StudRow, top_width_m
from ..scenario.scenario import JointName, deck_joint, studs_of
from ..scenario.steelwork import Steelwork
from ..schema import given
from .connection_source import ConnectionRows, ConnectionSource
from .model_bearings import ModelBearings

_SHORTEST_M = 1e-3
"""Length up to which a contact is rounding: pieces and shards end in one plane."""

_AS_LONG = 0.75
"""Part of the length of a piece from which on a shard above it counts as being as long."""

_ACROSS = 0.999
"""Part of a normal along the road from which on a face lies across the deck."""

_ALONG = (0.0, 0.0, 1.0)
"""Direction along the road in the axes of a level face whose normal points downwards."""

_TRAVEL_M = 0.2
"""Displacement at which a shard of a deck without studs has left the piece of girder that it lay on."""

_BED_N_M3 = 3e9
"""Stiffness of the bed between a deck without studs and its girders: a deck of 0.2 m presses it by 2 µm. With much
stiffer ones statics finds no rest, as friction follows what presses."""

_AT_GAUSS_POINTS = 1.0 / np.sqrt(3.0)
"""Where two springs resist turning as an even bed does, by half of its length."""

_GROWS = 1.0
"""Force of studs at failure by that at yield: they do not harden."""


@dataclass(frozen=True, slots=True, eq=False)
class DeckContacts:
    """c connections of a model that are contacts of a shard of a deck, the first, with a piece or node of a girder.

    Attributes
    ----------
    rows : (c,) int
        Their numbers among all connections, ascending.
    decks, girders : (c,) int
        Which deck of the steelwork each is of, and which of its girders, from 0.
    lengths_m, widths_m : (c,) float
        Length along the girder, and width of what touches in the mean.
    flanges_m : (c,) float
        Width of the flange, on which another shard may lie next to it.
    levers_m : (c,) float
        How far along the road from the contact what presses it acts: half-way between the points from which the
        stiffness of the two is measured. There both are as far as a beam that bends evenly is from its tangents.
    """

    rows: np.ndarray
    decks: np.ndarray
    girders: np.ndarray
    lengths_m: np.ndarray
    widths_m: np.ndarray
    flanges_m: np.ndarray
    levers_m: np.ndarray

    @property
    def studded_m(self) -> np.ndarray:
        """Length (c,) of girder whose studs each has: by its part of the flange."""
        return self.lengths_m * self.widths_m / self.flanges_m

    def only(self, mine: np.ndarray) -> DeckContacts:
        """Return some of them (c,)."""
        return DeckContacts(*(getattr(self, item.name)[mine] for item in fields(self)))


class DecksOnGirders(ConnectionSource):
    """Contacts of decks with the girders below them."""

    def takes(self, pairs: np.ndarray) -> np.ndarray:
        """Return which pairs (k, 2) are of a deck on girders and of steel."""
        of_steel = np.array([*(member.steel is not None for member in self.cut.members), False], bool)
        first, second = self.cut.members_of(pairs).T
        return np.asarray((self._of_decks[first] & of_steel[second]) | (of_steel[first] & self._of_decks[second]))

    def added(self, rows: ConnectionRows) -> ConnectionRows:
        """Return the contacts after the other connections: of the faces that all shards share, those on girders."""
        if not self._spans:
            return rows
        connections, contacts = self._contacts()
        is_over = np.isclose(
            contacts.flanges_m, np.array([top_width_m(span.sections[1]) for span in self._spans])[contacts.decks]
        )
        joints = [
            self.cut.joint_rows[JointName("deck", key)]
            for key in zip(contacts.decks.tolist(), is_over.tolist(), strict=True)
        ]
        loose = self._loose_bearings(contacts, connections)
        moments = _contact_moments(contacts)
        followed, moves = rows.followed_by(self.cut, "decks", connections, np.array(joints, int), moments)
        if loose:
            followed = followed.on_bearings(loose.among(moves, len(rows)))
        self._set_moments_across(followed)
        return followed.with_part(replace(contacts.only(moves), rows=np.arange(len(rows), len(followed))))

    def barred(self, rows: ConnectionRows) -> ConnectionRows:
        """Return bars across all connections, with studs, which yield along the girder until they fail."""
        contacts = rows.part(DeckContacts)
        if not contacts:
            return rows
        of_contacts = self._studs_of(contacts)
        mine = np.array([row is not None for row in of_contacts], bool)
        if not mine.any():
            return rows
        studs = [row for row in of_contacts if row is not None]
        chosen, factor = contacts.only(mine), self.cut.scenario.connections.strength_factor
        yields = np.array([factor * row.per_m * row.shear_n for row in studs]) * chosen.studded_m
        openings = np.array([row.slip_m for row in studs])
        at_yield = np.array([factor * row.shear_n / row.stiffness_n_m for row in studs])
        laws = np.column_stack((at_yield / openings, np.full(len(studs), _GROWS), np.ones(len(studs))))
        return replace(rows, bars=rows.bars_or_none.with_studs(chosen.rows, yields, openings, laws, _ALONG))

    def stiffen(self, rows: ConnectionRows, matrices: np.ndarray) -> None:
        """Set the stiffness of contacts, in their axes.

        Along the face studs slip by their stiffness. Across it the concrete up to the middle of the deck deforms. The
        contact turns as an even bed about the girder, and about an axis across the road by its share of the length of
        the deck alone, as faces that members have in common along their length (`interfaces`).
        """
        contacts = rows.part(DeckContacts)
        if not contacts:
            return
        pressed, sideways = self._pressed_n_m(contacts), self._sideways_n_m(contacts)
        lengths, widths = np.square(contacts.lengths_m) / 12.0, np.square(contacts.widths_m) / 12.0
        shares = contacts.lengths_m / np.array([span.length_m for span in self._spans])[contacts.decks]
        own = np.zeros((len(contacts.rows), 6, 6))
        turning = pressed * (shares * shares * lengths + np.square(contacts.levers_m))
        columns = (pressed, sideways, sideways, sideways * (lengths + widths), turning, pressed * widths)
        for row, values in enumerate(columns):
            own[:, row, row] = values
        own[:, 0, 4] = own[:, 4, 0] = pressed * contacts.levers_m
        matrices[contacts.rows] = own

    @property
    def _spans(self) -> Sequence[GirderSpan]:
        return self.cut.scenario.steelwork.decks if self.cut.scenario.steelwork else ()

    @property
    def _of_decks(self) -> np.ndarray:
        """Which members, and last the ground, (k + 1,) are decks on girders."""
        names = {span.deck_name for span in self._spans}
        return np.array([*(member.name in names for member in self.cut.members), False], bool)

    def _contacts(self) -> tuple[Connections, DeckContacts]:
        """Return the connections of decks with the girders below, and what these are, counted from 0."""
        cut, faces = self.cut, self.cut.faces
        deck_of, girder_of, width_of = _owners(self._spans, cut.members)
        first, second = cut.member_of_shard[faces.pairs].T
        lies = (deck_of[first] >= 0) & (girder_of[first] < 0) & (girder_of[second] >= 0)
        lies &= deck_of[first] == deck_of[second]
        widths = width_of[second]
        rows = np.flatnonzero(lies & (faces.areas > _SHORTEST_M * widths))
        connections = Connections(faces.pairs[rows], faces.centres[rows], faces.areas[rows], faces.normals[rows])
        on_deck, below = faces.pairs[rows].T
        pairs = zip(on_deck.tolist(), below.tolist(), strict=True)
        lengths = np.array([_in_common(cut.shards[one], cut.shards[other], 0) for one, other in pairs])
        steel = np.full(len(cut.member_of_shard), np.nan)
        is_steel = np.array([member.steel is not None for member in cut.members])
        steel[is_steel[cut.member_of_shard]] = np.concatenate(
            [_turns_as_m(member) for member in cut.members if member.steel]
        )
        middles = 0.5 * (cut.points_m[on_deck, 0] + steel[below])
        return connections, DeckContacts(
            np.arange(len(rows)),
            deck_of[first[rows]],
            girder_of[second[rows]],
            lengths,
            faces.areas[rows] / lengths,
            widths[rows],
            middles - connections.points[:, 0],
        )

    def _set_moments_across(self, rows: ConnectionRows) -> None:
        """Set second moments of faces across the parts of decks.

        There a shard meets several behind it, so that the mesh of none has the face. It is a rectangle as deep as both
        have in common, with the area of the face.
        """
        connections, shards = rows.connections, self.cut.shards
        is_across = np.abs(connections.normals[:, 0]) > _ACROSS
        for row in np.flatnonzero(is_across & self._of_decks[self.cut.members_of(connections.pairs)].all(axis=1)):
            one, other = connections.pairs[row].tolist()
            deep, area = _in_common(shards[one], shards[other], 2), float(connections.areas[row])
            wide = area / deep
            rows.moments_m4[row] = np.diag((area * deep * deep, area * wide * wide)) / 12.0

    def _loose_bearings(self, contacts: DeckContacts, connections: Connections) -> ModelBearings | None:
        """Return springs of the contacts of decks without studs, which press, slide and lift off.

        Each deck has a bearing on each girder. None where all decks have studs.
        """
        decks = self._spans
        loose = contacts.only(np.array([not decks[deck].studs_per_m for deck in contacts.decks.tolist()], bool))
        count = len(loose.rows)
        if not count:
            return None
        of_contacts = list(zip(loose.decks.tolist(), loose.girders.tolist(), strict=True))
        lines = sorted(set(of_contacts))
        names = tuple(f"{decks[deck].deck_name} on {decks[deck].girder_names[girder]}" for deck, girder in lines)
        arms = np.zeros((count, 2, 3))
        arms[:, :, 0] = loose.levers_m[:, None]
        arms[:, :, 1] = np.array((-0.5, 0.5)) * _AT_GAUSS_POINTS * loose.widths_m[:, None]
        places = connections.points[loose.rows][:, None] + arms
        bed = np.repeat(0.5 * _BED_N_M3 * loose.lengths_m * loose.widths_m, 2)
        springs = PadSprings(
            rows=loose.rows,
            parts=np.repeat(np.arange(count), 2),
            places_m=places.reshape(-1, 3),
            vertical_n_m=bed,
            sideways_n_m=np.column_stack((bed, bed)),
            friction=np.array([decks[deck].deck_friction for deck in loose.decks.tolist()], float),
            pulls=np.zeros(count, bool),
            travel_m=np.full(count, _TRAVEL_M),
            bearings=np.array([lines.index(line) for line in of_contacts], int),
            breaking_n=np.full(count, np.inf),
        )
        return ModelBearings(names, springs)

    def _studs_of(self, contacts: DeckContacts) -> list[StudRow | None]:
        of_decks = [studs_of(span, self.cut.scenario) for span in self._spans]
        return [of_decks[deck] for deck in contacts.decks.tolist()]

    def _pressed_n_m(self, contacts: DeckContacts) -> np.ndarray:
        """Stiffness (c,) of the concrete up to the middle of the deck, where it is pressed."""
        per_m2 = [
            given(deck_joint(self.cut.scenario, span).moduli).young_pa / (0.5 * given(span.deck_thickness_m))
            for span in self._spans
        ]
        return np.asarray(contacts.lengths_m * contacts.widths_m * np.array(per_m2)[contacts.decks])

    def _sideways_n_m(self, contacts: DeckContacts) -> np.ndarray:
        """Stiffness (c,) along the face, of studs; 0 without any, where springs are in place of it."""
        studs = self._studs_of(contacts)
        return np.array([row.per_m * row.stiffness_n_m if row else 0.0 for row in studs]) * contacts.studded_m


def points_above_girders(
    steelwork: Steelwork | None,
    members: Sequence[Member],
    member_of_shard: np.ndarray,
    shards: Sequence[TriangleMesh],
    points_m: np.ndarray,
) -> np.ndarray:
    """Return the points (n, 3) from which the stiffness of shards is measured, in decks above their girders.

    A shard as long as the piece below it turns and stretches with that: its point is where the piece's is along the
    road. Else studs would slip where neither slips in reality.
    """
    points = points_m.copy()
    names = {member.name: index for index, member in enumerate(members)}
    for span in steelwork.decks if steelwork else ():
        own = list(span.bars_of(span.girder_names[0]))
        on_line = {keys["name"] for keys in own} | {node for keys in own for node in keys["nodes"]}
        below = [member for member in members if member.name in on_line]
        places = np.sort(np.concatenate([_turns_as_m(member) for member in below]))
        ends = np.array([part.bounds[:, 0] for part in members[names[span.deck_name]].parts])
        for shard in np.flatnonzero(member_of_shard == names[span.deck_name]).tolist():
            begin, end = shards[shard].bounds[:, 0].tolist()
            strip = int(np.searchsorted(ends[:, 0], 0.5 * (begin + end)) - 1)
            if end - begin > _AS_LONG * float(ends[strip, 1] - ends[strip, 0]):
                points[shard, 0] = places[strip]
    return points


def _contact_moments(contacts: DeckContacts) -> np.ndarray:
    """Return second moments (c, 2, 2) of contacts, in their axes: y across the road, z along it."""
    moments = np.zeros((len(contacts.rows), 2, 2))
    areas = contacts.lengths_m * contacts.widths_m
    moments[:, 0, 0] = areas * np.square(contacts.lengths_m) / 12.0
    moments[:, 1, 1] = areas * np.square(contacts.widths_m) / 12.0
    return moments


def _owners(spans: Sequence[GirderSpan], members: Sequence[Member]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Deck (k,) that each member is, or is a girder or node of, its girder (k,), and width of its top (k,); else -1."""
    rows: dict[str, tuple[int, int, float]] = {}
    for number, span in enumerate(spans):
        rows[span.deck_name] = number, -1, 0.0
        for girder, name in enumerate(span.girder_names):
            for keys in span.bars_of(name):
                width = top_width_m(span.sections[keys["section"] != span.section])
                rows[keys["name"]] = number, girder, width
                for node in keys["nodes"]:
                    before = rows[node][2] if node in rows else 0.0
                    rows[node] = number, girder, max(width, before)
    found = [rows.get(member.name, (-1, -1, 0.0)) for member in members]
    decks, girders, widths = zip(*found, strict=True)
    return np.array(decks), np.array(girders), np.array(widths)


def _in_common(one: TriangleMesh, other: TriangleMesh, axis: int) -> float:
    """Return over what length two shards overlap along an axis."""
    (begin, end), (first, last) = one.bounds[:, axis].tolist(), other.bounds[:, axis].tolist()
    return float(min(end, last) - max(begin, first))


def _turns_as_m(member: Member) -> np.ndarray:
    """Where along the road the pieces of a bar, or a node, turn as the girder does, (s,)."""
    steel = given(member.steel)
    return steel.centre_m[:1] if steel.bar is None else steel.bar.at(steel.bar.turns_as_m)[:, 0]
