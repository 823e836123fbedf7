"""Steelwork in the structural model: pieces of bars and nodes as shards, joints of bars, and supports of nodes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import numpy as np

from ...engineering.elasticity.bearings import PadSprings
from ...engineering.fracture.shards import Fracture
from ...engineering.fracture.shared_faces import NO_FACES, SharedFaces
from ...engineering.geometry.vectors import dot, product
from ...engineering.mechanics.section_cuts import section_axes
from ...engineering.steelwork.bars import SteelBar, extruded, in_other_axes, joint_stiffness
from ...engineering.steelwork.resistance import STEEL_MODULI, plastic_second_moments, section_hinge
from ...engineering.structure.connections import GROUND, Connections
from ..bridge.member import Member, members_named
from ..scenario.bearings import FIXED, ROCKER, UNYIELDING_MN_M
from ..scenario.joint_settings import GROUND_NAME
from ..scenario.scenario import JointName
from ..scenario.steelwork import SteelNode, Steelwork, bending_to_axial_ratio_of
from ..schema import given
from .connection_source import ConnectionRows, ConnectionSource, CutMembers
from .model_bearings import ModelBearings

_TRAVEL_M = 0.2
"""Displacement at which a node has left a support that turns or moves."""

_SUPPORT = 1e4
"""Stiffness of a support over that of the stoutest bar at its node."""


@dataclass(frozen=True, slots=True, eq=False)
class BarJoints:
    """j joints of bars, in the order of bars and along each.

    Attributes
    ----------
    members, numbers : (j,) int
        Index of the member that each is of, and its number along that, from 0.
    pairs : (j, 2) int
        Shards on its two sides, along the bar.
    """

    members: np.ndarray
    numbers: np.ndarray
    pairs: np.ndarray

    @property
    def numbered(self) -> list[tuple[int, int]]:
        """Member and number along it of each joint."""
        return list(zip(self.members.tolist(), self.numbers.tolist(), strict=True))


def steel_fracture(member: Member) -> Fracture:
    """Return the pieces of a bar, or a node, as shards; the mass of a node is at its position."""
    part = given(member.steel)
    if part.bar is None:
        volumes, centres = np.array([member.volume_m3]), part.centre_m[None]
        return Fracture((member.solid,), volumes, centres, centres, NO_FACES)
    bar, cuts = part.bar, part.bar.cuts_m
    ends = bar.at(cuts)
    shards = tuple(extruded(bar.section, bar.axes, *ends[row : row + 2]) for row in range(bar.pieces))
    centres = bar.at(0.5 * (cuts[1:] + cuts[:-1]))
    volumes = bar.section.area_m2 * np.diff(cuts)
    return Fracture(shards, volumes, centres, centres, NO_FACES)


def bar_joints(members: Sequence[Member], member_of_shard: np.ndarray) -> BarJoints:
    """Return all joints of bars between shards, given the member's index of each shard (n,)."""
    first_shards = np.searchsorted(member_of_shard, np.arange(len(members)))
    node_shards = {
        member.name: int(first_shards[index])
        for index, member in enumerate(members)
        if member.steel and not member.steel.bar
    }
    owners, numbers, pairs = [], [], []
    for index, member in enumerate(members):
        if member.steel is None or member.steel.bar is None:
            continue
        begin, end = (node_shards[name] for name in member.steel.nodes)
        pieces = first_shards[index] + np.arange(member.steel.bar.pieces)
        chain = np.concatenate(([begin], pieces, [end]))
        pairs.append(np.column_stack((chain[:-1], chain[1:])))
        numbers.append(np.arange(len(chain) - 1))
        owners.append(np.full(len(chain) - 1, index))
    if not pairs:
        return BarJoints(np.zeros(0, int), np.zeros(0, int), np.zeros((0, 2), int))
    return BarJoints(np.concatenate(owners), np.concatenate(numbers), np.concatenate(pairs))


def joint_faces(joints: BarJoints, members: Sequence[Member]) -> SharedFaces:
    """Return the joints of bars as faces that shards share: the whole section of the bar, where the joint lies."""
    bars = [_bar(members[index]) for index in joints.members.tolist()]
    if not bars:
        return NO_FACES
    signs = np.where(joints.pairs[:, 0] < joints.pairs[:, 1], 1.0, -1.0)
    positions = [bar.at(bar.joints_m[[number]])[0] for bar, (_, number) in zip(bars, joints.numbered, strict=True)]
    return SharedFaces(
        pairs=np.sort(joints.pairs, axis=1),
        areas=np.array([bar.section.area_m2 for bar in bars]),
        centres=np.array(positions),
        normals=signs[:, None] * np.array([bar.axes[:, 0] for bar in bars]),
    )


@dataclass(frozen=True, slots=True, eq=False)
class SteelConnections:
    """Connections of a model that are joints of bars, or supports of nodes.

    Attributes
    ----------
    rows : (s,) int
        Their numbers among all connections, ascending.
    joints : BarJoints
        The joints that the first of them are, (j,); the rest are supports.
    support_nodes : (s - j,) int
        Indices of the members whose support each of these is.
    """

    rows: np.ndarray
    joints: BarJoints
    support_nodes: np.ndarray


class SteelEnds(ConnectionSource):
    """Joints of bars, which are among the faces that shards share, and supports of nodes."""

    def takes(self, pairs: np.ndarray) -> np.ndarray:
        """Return pairs of steel and ground, and of a node on a support, or a bar that ends there, and what holds it.

        Where these touch, the support is all that is between them.
        """
        members, is_held = self.cut.members, np.zeros(len(pairs), bool)
        of_pairs = self.cut.members_of(pairs)
        of_steel = np.array([*(member.steel is not None for member in members), False])
        is_held |= (of_pairs == GROUND).any(axis=1) & of_steel[of_pairs].any(axis=1)
        for node in self._supported:
            if node.held_by == GROUND_NAME:
                continue
            holding = members_named(node.held_by, members, "steelwork.nodes.held_by")
            held = [
                index
                for index, member in enumerate(members)
                if member.steel and (member.name == node.name or node.name in member.steel.nodes)
            ]
            for first, second in ((0, 1), (1, 0)):
                is_held |= np.isin(of_pairs[:, first], held) & np.isin(of_pairs[:, second], holding)
        return is_held

    def added(self, rows: ConnectionRows) -> ConnectionRows:
        """Return the supports of nodes after the other connections, and which of these are joints of bars."""
        steelwork, members = self.cut.scenario.steelwork, self.cut.members
        if not steelwork:
            return rows
        connections, nodes = self._supports()
        ends, joints = _joints_among(bar_joints(members, self.cut.member_of_shard), rows.connections)
        tables = {table.name: table for table in steelwork.all_members}
        of_bars = [
            self._joint_row(steelwork.bar_key(tables[members[index].name], _end_of(_bar(members[index]), number)))
            for index, number in joints.numbered
        ]
        of_nodes = [self._joint_row(steelwork.support_key(node)) for node in self._supported]
        pins = self._pins()
        followed, moves = rows.followed_by(self.cut, "supports", connections, np.array(of_nodes, int))
        steel = SteelConnections(np.concatenate((ends, np.arange(len(rows), len(followed)))), joints, nodes[moves])
        followed.moments_m4[steel.rows] = _resisting_moments(steel, followed.connections, steelwork, members)
        followed = followed.claimed(ends, "steel", joints=np.array(of_bars, int))
        if pins.names:
            followed = followed.on_bearings(pins.among(moves, len(rows)))
        return followed.with_part(steel)

    def barred(self, rows: ConnectionRows) -> ConnectionRows:
        """Return bars across all connections, and sections of steel bars, which yield where they break."""
        steel = rows.part(SteelConnections)
        if not steel:
            return rows
        scenario, members = self.cut.scenario, self.cut.members
        steelwork, factor = given(scenario.steelwork), scenario.connections.strength_factor
        tables = {table.name: table for table in steelwork.all_members}
        yields, openings, hinges = [], [], []
        for index, number in steel.joints.numbered:
            table, bar = tables[members[index].name], _bar(members[index])
            end = _end_of(bar, number)
            share = factor if end is None else factor * steelwork.end_share(table, end)
            most_m = math.inf if end is None else steelwork.end_opening_m(table, end)
            hinge = section_hinge(bar.section, steelwork.yield_and_ultimate_pa(table)[0], most_m)
            yields.append(share * hinge.yield_n)
            openings.append(hinge.opening_m)
            hinges.append((hinge.yield_strain, hinge.hardening, hinge.rupture_strain))
        laws = np.array(yields), np.array(openings), np.array(hinges).reshape(-1, 3)
        return replace(rows, bars=rows.bars_or_none.with_hinges(steel.rows[: len(yields)], *laws))

    def stiffen(self, rows: ConnectionRows, matrices: np.ndarray) -> None:
        """Set the stiffness of joints by the sections of their bars, and of supports."""
        if steel := rows.part(SteelConnections):
            matrices[steel.rows] = _steel_stiffness(steel, rows.connections, self.cut.members)

    @property
    def _supported(self) -> list[SteelNode]:
        steelwork = self.cut.scenario.steelwork
        return [node for node in steelwork.all_nodes if node.support is not None] if steelwork else []

    def _joint_row(self, key: tuple[str, ...]) -> int:
        return self.cut.joint_rows[JointName("steel", key)]

    def _supports(self) -> tuple[Connections, np.ndarray]:
        """Return the connections between nodes and what holds them, and the index of the member of each node (s,)."""
        cut, held = self.cut, self._supported
        index_of = {member.name: index for index, member in enumerate(cut.members)}
        nodes = np.array([index_of[node.name] for node in held], int)
        pairs = np.zeros((len(held), 2), int)
        for row, node in enumerate(held):
            shard = int(np.searchsorted(cut.member_of_shard, nodes[row]))
            pairs[row] = shard, _holding_shard(node.held_by, np.array(node.position_m), cut)
        areas = [
            max(_bar(one).section.area_m2 for one in cut.members if one.steel and node.name in one.steel.nodes)
            for node in held
        ]
        places = np.array([node.position_m for node in held], float).reshape(-1, 3)
        return Connections(pairs, places, np.array(areas, float), np.tile((0.0, 0.0, -1.0), (len(held), 1))), nodes

    def _pins(self) -> ModelBearings:
        """Return the springs of supports that turn freely, as of bearings that hold uplift.

        A pin across the road is two springs as far from the node as its bars begin: they hold it upright.
        """
        held = self._supported
        rows = [row for row, node in enumerate(held) if node.support != FIXED]
        pins = [held[row] for row in rows]
        arms = [max(_within_m(self.cut.members, pin.name)) for pin in pins]
        places = [
            np.add(pin.position_m, (0.0, side * arm, 0.0))
            for pin, arm in zip(pins, arms, strict=True)
            for side in (-1, 1)
        ]
        count, half = len(pins), 0.5e6 * UNYIELDING_MN_M
        sideways = [(0.0 if pin.support == ROCKER else half, half) for pin in pins for _ in range(2)]
        springs = PadSprings(
            rows=np.array(rows, int),
            parts=np.repeat(np.arange(count), 2),
            places_m=np.array(places).reshape(-1, 3),
            vertical_n_m=np.full(2 * count, half),
            sideways_n_m=np.array(sideways).reshape(-1, 2),
            friction=np.full(count, np.inf),
            pulls=np.ones(count, bool),
            travel_m=np.full(count, _TRAVEL_M),
            bearings=np.arange(count),
            breaking_n=np.full(count, np.inf),
        )
        return ModelBearings(tuple(f"{pin.name} on {pin.held_by}" for pin in pins), springs)


def _joints_among(joints: BarJoints, connections: Connections) -> tuple[np.ndarray, BarJoints]:
    """Return which connections (k,) are joints of bars, in ascending order, and these."""
    count = 1 + int(max(connections.pairs.max(initial=0), joints.pairs.max(initial=0)))
    keys = connections.pairs[:, 0] * count + connections.pairs[:, 1]
    wanted = np.sort(joints.pairs, axis=1)
    wanted_keys = wanted[:, 0] * count + wanted[:, 1]
    order = np.argsort(keys, kind="stable")
    at = np.searchsorted(keys[order], wanted_keys)
    found = (at < len(keys)) & (keys[order[np.minimum(at, len(keys) - 1)]] == wanted_keys) if len(keys) else at < 0
    rows = order[at[found]]
    by_row = np.argsort(rows, kind="stable")
    return rows[by_row], BarJoints(*(getattr(joints, item.name)[found][by_row] for item in fields(BarJoints)))


def _end_of(bar: SteelBar, number: int) -> int | None:
    """Return at which end of a bar a joint is; None within it."""
    return {0: 0, bar.pieces: 1}.get(number)


def _resisting_moments(
    steel: SteelConnections, connections: Connections, steelwork: Steelwork, members: Sequence[Member]
) -> np.ndarray:
    """Return second moments (s, 2, 2) of the rectangles that stand for sections, in the axes of the connections."""
    count = len(steel.joints.members)
    moments = np.square(connections.areas[steel.rows])[:, None, None] / 12.0 * np.eye(2)
    tables = {table.name: table for table in steelwork.all_members}
    own = [
        plastic_second_moments(bar.section, bending_to_axial_ratio_of(steelwork, tables[name], _end_of(bar, number)))
        for name, bar, number in (
            (members[index].name, _bar(members[index]), number) for index, number in steel.joints.numbered
        )
    ]
    if count:
        across = _turns(steel, connections, members)[:, 1:, 1:]
        moments[:count] = product(np.swapaxes(across, 1, 2), product(np.array(own), across))
    return moments


def _steel_stiffness(steel: SteelConnections, connections: Connections, members: Sequence[Member]) -> np.ndarray:
    """Return the stiffness (s, 6, 6) of connections of steelwork, in the axes of their sections."""
    count = len(steel.joints.members)
    matrices = np.zeros((len(steel.rows), 6, 6))
    of_bars = {
        index: joint_stiffness(_bar(members[index]), STEEL_MODULI) for index in set(steel.joints.members.tolist())
    }
    if count:
        own = np.array([of_bars[index][number] for index, number in steel.joints.numbered])
        matrices[:count] = in_other_axes(own, _turns(steel, connections, members))
    for row, node in enumerate(steel.support_nodes.tolist(), start=count):
        matrices[row] = _support(members[node].name, members)
    return matrices


def _turns(steel: SteelConnections, connections: Connections, members: Sequence[Member]) -> np.ndarray:
    """Axes of connections (j, 3, 3) that are joints of bars, in the bars' axes, as columns."""
    count = len(steel.joints.members)
    axes = section_axes(connections.normals[steel.rows[:count]])
    own = np.array([_bar(members[index]).axes for index in steel.joints.members.tolist()])
    return product(np.swapaxes(own, 1, 2), axes)


def _support(node: str, members: Sequence[Member]) -> np.ndarray:
    """Stiffness (6, 6) of a support, much more than the bars at its node have."""
    bars = [_bar(member) for member in members if member.steel and node in member.steel.nodes]
    young = STEEL_MODULI.young_pa
    shifts = _SUPPORT * max(young * bar.section.area_m2 / bar.length_m for bar in bars)
    turns = _SUPPORT * max(
        young * float(np.diagonal(bar.section.shape.second_moments_m4).max()) / bar.length_m for bar in bars
    )
    return np.diag([shifts] * 3 + [turns] * 3)


def _holding_shard(name: str, position_m: np.ndarray, cut: CutMembers) -> int:
    """Return the shard of a member or kind that is nearest to a position; or the ground."""
    if name == GROUND_NAME:
        return GROUND
    chosen = members_named(name, cut.members, "steelwork.nodes.held_by")
    rows = np.flatnonzero(np.isin(cut.member_of_shard, chosen))
    beyond = []
    for row in rows.tolist():
        lower, upper = cut.shards[row].bounds
        outside = np.maximum(np.maximum(lower - position_m, position_m - upper), 0.0)
        beyond.append(float(dot(outside, outside)))
    return int(rows[int(np.argmin(beyond))])


def _within_m(members: Sequence[Member], node: str) -> list[float]:
    """How far from a node each of its bars begins."""
    return [
        float(_bar(member).within_m[member.steel.nodes.index(node)])
        for member in members
        if member.steel and node in member.steel.nodes
    ]


def _bar(member: Member) -> SteelBar:
    return given(given(member.steel).bar)
