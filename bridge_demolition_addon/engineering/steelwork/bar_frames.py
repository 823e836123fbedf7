"""Nodes of bars whose axes are known: which ends meet, where a bar is divided, and where each node lies.

Bars of drawings and models end where they are cut, clear of what they are joined to by plates, and their axes do not
always meet in one point. Two are joined where the axis of one, made longer at its end, passes the other near enough for
their sections to touch. Bars keep their axes: nodes are where these meet, and the eccentricity of an axis at its node
is part of the result.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np

from ..arrays import FloatArray
from ..geometry.vectors import cross, dot, length
from .bars import node_radius_m

_LEANS = 0.17
"""Sine of the angle, 10°, below which bars are in one line or side by side."""

_TOUCH, _TOUCH_M = 0.55, 0.01
"""How far apart axes may pass that are joined, by the sum of the sizes of their sections, and beside that in m."""

_SPLICED = 0.3
"""The same of bars in one line."""

_PLATE, _PLATE_THERE = 1.0, 0.5
"""How far the axis of a bar is made longer beyond where it would touch the other bar, by the sizes of both sections: as
far as plates reach at which it ends."""

_SAME_STATION = 0.5
"""Distance along a bar, by the size of the larger section, within which two joints are one."""

_WITHIN, _CAPPED = 0.45, 0.4
"""Part of a bar that may lie within one node, as in `model.bridge.steelwork`, and part of it to which a node is made
smaller."""

_STUB = 2.0
"""Length of a piece of a bar, by the size of its section, up to which nodes that leave it no room become one."""

_MET_M = 5e-5
"""How far an axis may run beside a node that it is taken to meet."""


@dataclass(frozen=True, eq=False)
class BarAxes:
    """Axes and sections of n bars.

    Attributes
    ----------
    begins_m, ends_m : (n, 3) float
    outlines : n of (p, 3) float
        Corners of their sections about their axes.
    areas_m2 : (n,) float
    """

    begins_m: FloatArray
    ends_m: FloatArray
    outlines: Sequence[FloatArray]
    areas_m2: FloatArray

    @cached_property
    def sizes_m(self) -> FloatArray:
        """Sizes (n,) of the sections about the axes."""
        return np.array([2.0 * float(np.sqrt(dot(points, points)).max()) for points in self.outlines])

    @cached_property
    def lengths_m(self) -> FloatArray:
        """Lengths (n,) of the axes."""
        return length(self.ends_m - self.begins_m)

    @cached_property
    def ways(self) -> FloatArray:
        """Directions (n, 3) from beginning to end."""
        return (self.ends_m - self.begins_m) / self.lengths_m[:, None]

    def __len__(self) -> int:
        return len(self.begins_m)

    def at(self, bar: int, along_m: float) -> FloatArray:
        """Return a position (3,) on the axis of a bar, so far from its beginning."""
        return np.asarray(self.begins_m[bar] + along_m * self.ways[bar])


@dataclass(frozen=True, slots=True)
class BarStation:
    """A position on the axis of a bar, m from its beginning."""

    bar: int
    along_m: float


@dataclass(frozen=True, slots=True, eq=False)
class BarPiece:
    """A bar, or a part of one, from node to node.

    Attributes
    ----------
    from_nodes_m : (2, 3) float
        From each of its nodes to the end of its axis.
    """

    bar: int
    nodes: tuple[int, int]
    from_nodes_m: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class BarFrame:
    """Bars that are joined in k nodes.

    Attributes
    ----------
    places_m : (k, 3) float
    pieces
        From node to node, in the order of bars and along each.
    radii_m
        How far from a node its bars begin, where they would not leave each other room otherwise.
    node_of_support
        The node that each support is at, in the order of these.
    within_nodes
        Bars that are too short for their sections, and the node that each is within.
    free_ends
        Ends, 0 or 1, of bars that meet no other bar, and are on no support.
    crossings
        Pairs of bars that pass each other between their ends, near enough to touch, and are not joined.
    """

    places_m: FloatArray
    pieces: tuple[BarPiece, ...]
    radii_m: dict[int, float]
    node_of_support: tuple[int, ...]
    within_nodes: dict[int, int]
    free_ends: tuple[tuple[int, int], ...]
    crossings: tuple[tuple[int, int], ...]

    @property
    def eccentricities_m(self) -> dict[int, float]:
        """Largest eccentricity of each bar at its nodes."""
        found: dict[int, float] = {}
        for piece in self.pieces:
            apart = float(length(piece.from_nodes_m).max())
            found[piece.bar] = max(found.get(piece.bar, 0.0), apart)
        return found


def bar_frame(axes: BarAxes, supports: Sequence[BarStation] = ()) -> BarFrame:
    """Return the nodes that join bars, and the nodes of supports, which divide bars."""
    joints = _Joints(axes)
    for support in supports:
        joints.support(support)
    crossings = joints.join_ends()
    capped: dict[int, float] = {}
    while True:
        frame, clusters = _built(axes, joints, capped, crossings)
        tight = _tightest(axes, frame)
        if tight is None:
            return replace(frame, radii_m=_given_radii(axes, frame))
        piece, limit_m = tight
        size = float(axes.sizes_m[piece.bar])
        both_held = set(piece.nodes) <= set(frame.node_of_support)
        if _length_m(frame, piece) <= _STUB * size and not both_held:
            joints.unite(*(clusters[node] for node in piece.nodes))
        else:
            for node in piece.nodes:
                capped[clusters[node]] = min(capped.get(clusters[node], math.inf), limit_m)


class _Joints:
    """Positions on bars; joined ones belong to one cluster."""

    def __init__(self, axes: BarAxes) -> None:
        self.axes = axes
        self.stations: list[BarStation] = []
        self.on_bar: list[list[int]] = [[] for _ in range(len(axes))]
        self.supports: list[int] = []
        self._above: list[int] = []
        for bar, whole in enumerate(axes.lengths_m.tolist()):
            self._add(BarStation(bar, 0.0))
            self._add(BarStation(bar, whole))

    def root(self, row: int) -> int:
        while self._above[row] != row:
            row = self._above[row]
        return row

    def unite(self, one: int, other: int) -> None:
        first, second = sorted((self.root(one), self.root(other)))
        self._above[second] = first

    def support(self, station: BarStation) -> None:
        """Add a support; its cluster lies where it is."""
        near = 0.5 * _SAME_STATION * float(self.axes.sizes_m[station.bar])
        row = self._near(station, near)
        if row is None or row in self.supports:
            row = self._add(station)
        else:
            self.stations[row] = station
        self.supports.append(row)

    def join_ends(self) -> tuple[tuple[int, int], ...]:
        """Join all ends of bars to what they meet, and return the pairs that only pass each other."""
        axes, passing = self.axes, []
        for bar in range(len(axes)):
            for end in (0, 1):
                for other, along_m in _met(axes, bar, end):
                    near = _SAME_STATION * max(float(axes.sizes_m[bar]), float(axes.sizes_m[other]))
                    station = BarStation(other, along_m)
                    row = self._near(station, near)
                    self.unite(self.on_bar[bar][end], self._add(station) if row is None else row)
        for bar in range(len(axes)):
            for other in _passed(axes, bar):
                mine = {self.root(row) for row in self.on_bar[bar]}
                if other > bar and mine.isdisjoint(self.root(row) for row in self.on_bar[other]):
                    passing.append((bar, other))
        return tuple(passing)

    def _near(self, station: BarStation, within_m: float) -> int | None:
        apart = [(abs(self.stations[row].along_m - station.along_m), row) for row in self.on_bar[station.bar]]
        nearest, row = min(apart)
        inside = -within_m <= station.along_m <= float(self.axes.lengths_m[station.bar]) + within_m
        return row if nearest <= within_m or not inside else None

    def _add(self, station: BarStation) -> int:
        row = len(self.stations)
        self.stations.append(station)
        self.on_bar[station.bar].append(row)
        self._above.append(row)
        return row


def _met(axes: BarAxes, bar: int, end: int) -> list[tuple[int, float]]:
    """Return the bars that the end of a bar is joined to, and where on these, m from their beginnings."""
    place = (axes.begins_m, axes.ends_m)[end][bar]
    out = axes.ways[bar] * (1.0 if end else -1.0)
    own, sizes = float(axes.sizes_m[bar]), axes.sizes_m
    to = place - axes.begins_m
    leans = length(cross(np.broadcast_to(out, axes.ways.shape), axes.ways))
    cosines, ahead, along = dot(axes.ways, out), dot(to, out), dot(axes.ways, to)
    with np.errstate(divide="ignore", invalid="ignore"):
        beyond = (cosines * along - ahead) / (leans * leans)
        at = (along - cosines * ahead) / (leans * leans)
        apart = length(to + beyond[:, None] * out - at[:, None] * axes.ways)
        meets = leans > _LEANS
        meets &= apart <= _TOUCH * (own + sizes) + _TOUCH_M
        meets &= (beyond <= 0.5 * sizes / leans + _PLATE * own + _PLATE_THERE * sizes) & (
            beyond >= -0.5 * (sizes / leans + own)
        )
        slack = 0.5 * own / leans + _SAME_STATION * sizes
        meets &= (at >= -slack) & (at <= axes.lengths_m + slack)
    meets[bar] = False
    found = [(other, float(at[other])) for other in np.flatnonzero(meets).tolist()]
    for other in np.flatnonzero(leans <= _LEANS).tolist():
        if other == bar:
            continue
        for other_end in (0, 1):
            there = (axes.begins_m, axes.ends_m)[other_end][other]
            leads_away = float(dot(axes.ways[other], out)) * (1.0 if other_end else -1.0) < 0.0
            gap = float(dot(there - place, out))
            beside = float(length(there - place - gap * out))
            both = own + float(sizes[other])
            if leads_away and abs(gap) <= _SAME_STATION * both and beside <= _SPLICED * both + _TOUCH_M:
                found.append((other, float(axes.lengths_m[other]) * other_end))
    return sorted(found)


def _passed(axes: BarAxes, bar: int) -> list[int]:
    """Return the bars that a bar passes between its ends, near enough for their sections to touch."""
    way = axes.ways[bar]
    to = axes.begins_m[bar] - axes.begins_m
    leans = length(cross(np.broadcast_to(way, axes.ways.shape), axes.ways))
    cosines, ahead, along = dot(axes.ways, way), dot(to, way), dot(axes.ways, to)
    with np.errstate(divide="ignore", invalid="ignore"):
        mine = (cosines * along - ahead) / (leans * leans)
        theirs = (along - cosines * ahead) / (leans * leans)
        apart = length(to + mine[:, None] * way - theirs[:, None] * axes.ways)
        passes = (leans > _LEANS) & (apart <= 0.5 * (axes.sizes_m[bar] + axes.sizes_m))
        passes &= (mine > 0.0) & (mine < axes.lengths_m[bar]) & (theirs > 0.0) & (theirs < axes.lengths_m)
    passes[bar] = False
    return [int(other) for other in np.flatnonzero(passes)]


def _built(
    axes: BarAxes, joints: _Joints, capped: dict[int, float], crossings: tuple[tuple[int, int], ...]
) -> tuple[BarFrame, list[int]]:
    """Return the frame of the clusters, and the cluster of each node."""
    members: dict[int, list[int]] = {}
    for row in range(len(joints.stations)):
        members.setdefault(joints.root(row), []).append(row)
    places = {cluster: _place(axes, joints, rows) for cluster, rows in members.items()}
    pieces: list[tuple[int, int, int, FloatArray]] = []
    within: dict[int, int] = {}
    for bar in range(len(axes)):
        clusters = {joints.root(row) for row in joints.on_bar[bar]}
        feet = sorted(
            (float(dot(places[cluster] - axes.begins_m[bar], axes.ways[bar])), cluster) for cluster in clusters
        )
        if len(feet) == 1:
            within[bar] = feet[0][1]
        for (begin, first), (end, second) in pairwise(feet):
            offsets = np.array(
                [axes.at(bar, along) - places[cluster] for along, cluster in ((begin, first), (end, second))]
            )
            offsets[length(offsets) <= _MET_M] = 0.0
            pieces.append((bar, first, second, offsets))
    radii: dict[int, float] = {}
    for cluster, radius in capped.items():
        root = joints.root(cluster)
        radii[root] = min(radii.get(root, radius), radius)
    used = sorted({cluster for _, first, second, _ in pieces for cluster in (first, second)})
    number = {cluster: row for row, cluster in enumerate(used)}
    within = {bar: number[cluster] for bar, cluster in within.items() if cluster in number}
    frame = BarFrame(
        places_m=np.array([places[cluster] for cluster in used]).reshape(-1, 3),
        pieces=tuple(BarPiece(bar, (number[one], number[other]), offsets) for bar, one, other, offsets in pieces),
        radii_m={number[cluster]: radius for cluster, radius in radii.items() if cluster in number},
        node_of_support=tuple(number[joints.root(row)] for row in joints.supports),
        within_nodes=within,
        free_ends=_free_ends(joints, members),
        crossings=crossings,
    )
    return frame, used


def _place(axes: BarAxes, joints: _Joints, rows: Sequence[int]) -> FloatArray:
    """Return where a node lies: on the axis of its stoutest bar, where the other axes come nearest to it in the mean.

    A node on a support lies there, on the axis of the bar that it holds.
    """
    held = [row for row in rows if row in joints.supports]
    if held:
        station = joints.stations[held[0]]
        return axes.at(station.bar, station.along_m)
    bars = sorted({joints.stations[row].bar for row in rows}, key=lambda bar: (-stoutness(axes, bar), bar))
    main, *others = bars
    way, begin = axes.ways[main], axes.begins_m[main]
    along, weights = [], []
    for other in others:
        cosine = float(dot(axes.ways[other], way))
        leans = 1.0 - cosine * cosine
        if leans > _LEANS * _LEANS:
            to = axes.begins_m[other] - begin
            along.append((float(dot(to, way)) - cosine * float(dot(to, axes.ways[other]))) / leans)
            weights.append(stoutness(axes, other) * stoutness(axes, other))
    if not along:
        points = [axes.at(joints.stations[row].bar, joints.stations[row].along_m) for row in rows]
        along, weights = [float(dot(point - begin, way)) for point in points], [1.0] * len(points)
    mean = math.fsum(weight * value for weight, value in zip(weights, along, strict=True)) / math.fsum(weights)
    return axes.at(main, mean)


def stoutness(axes: BarAxes, bar: int) -> float:
    """Return the area of a bar by its size, m³, by which it keeps its axis before others."""
    return float(axes.areas_m2[bar] * axes.sizes_m[bar])


def _free_ends(joints: _Joints, members: dict[int, list[int]]) -> tuple[tuple[int, int], ...]:
    supports = {joints.root(row) for row in joints.supports}
    free = []
    for bar, rows in enumerate(joints.on_bar):
        for end in (0, 1):
            cluster = joints.root(rows[end])
            bars = {joints.stations[row].bar for row in members[cluster]}
            if bars == {bar} and cluster not in supports:
                free.append((bar, end))
    return tuple(free)


def _length_m(frame: BarFrame, piece: BarPiece) -> float:
    ends = frame.places_m[list(piece.nodes)] + piece.from_nodes_m
    return float(length(ends[1] - ends[0]))


def _tightest(axes: BarAxes, frame: BarFrame) -> tuple[BarPiece, float] | None:
    """Return the piece that lies deepest within a node, if too deep, and how large nodes may be there, m."""
    radii = _radii(axes, frame)
    shares = [
        (max(radii[node] for node in piece.nodes) / _length_m(frame, piece), row)
        for row, piece in enumerate(frame.pieces)
    ]
    share, row = max(shares, default=(0.0, 0))
    if share <= _WITHIN:
        return None
    piece = frame.pieces[row]
    return piece, _CAPPED * _length_m(frame, piece)


def _radii(axes: BarAxes, frame: BarFrame) -> dict[int, float]:
    """Return how far from each node its bars begin; those that are given count."""
    ends: dict[int, list[tuple[FloatArray, FloatArray, FloatArray]]] = {}
    for piece in frame.pieces:
        for end, node in enumerate(piece.nodes):
            way = axes.ways[piece.bar] * (1.0 if end == 0 else -1.0)
            ends.setdefault(node, []).append((way, axes.outlines[piece.bar], piece.from_nodes_m[end]))
    return {node: frame.radii_m[node] if node in frame.radii_m else _radius_m(own) for node, own in ends.items()}


def _given_radii(axes: BarAxes, frame: BarFrame) -> dict[int, float]:
    """Return the radii of nodes that a scenario has to give: where bars leave each other no room."""
    ways: dict[int, list[FloatArray]] = {}
    for piece in frame.pieces:
        for end, node in enumerate(piece.nodes):
            ways.setdefault(node, []).append(axes.ways[piece.bar] * (1.0 if end == 0 else -1.0))
    radii = _radii(axes, frame)
    return {
        node: radii[node]
        for node in sorted(radii)
        if node in frame.radii_m
        or any(_is_side_by_side(one, other) for row, one in enumerate(ways[node]) for other in ways[node][:row])
    }


def _radius_m(ends: Sequence[tuple[FloatArray, FloatArray, FloatArray]]) -> float:
    """Return the radius of a node by the directions, outlines and offsets of its bars; those side by side overlap."""
    pairs = [
        (one, other) for row, one in enumerate(ends) for other in ends[:row] if not _is_side_by_side(one[0], other[0])
    ]
    radius = 0.0
    for bars in [(end,) for end in ends] + pairs:
        ways, outlines, offsets = zip(*bars, strict=True)
        radius = max(radius, node_radius_m(np.array(ways), list(outlines), np.array(offsets)))
    return radius


def _is_side_by_side(one: FloatArray, other: FloatArray) -> bool:
    """Return whether two bars leave a node in nearly one direction."""
    return float(length(np.cross(one, other))) <= _LEANS and float(dot(one, other)) > 0.0
