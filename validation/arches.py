# SPDX-License-Identifier: GPL-3.0-or-later
"""Segmental arches of voussoirs: as meshes, as scenarios, and as a linear program that gives their limit load."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from case import RIGID_BODIES, simulated
from scipy.optimize import linprog
from solids import prism

from bridge_demolition_addon.model.results.arrays import Results
from bridge_demolition_addon.model.results.energy import energy_of

G = 9.80665
FRICTION = 0.6


@dataclass(frozen=True, slots=True)
class Arch:
    """An arch of equal voussoirs, whose intrados is an arc.

    Attributes
    ----------
    span_m, rise_m : float
        Of the intrados.
    ring_m, width_m : float
        Thickness of the ring, and its width across.
    density_kg_m3 : float
    voussoirs : int
    fill_n_m3, cover_m : float
        Weight of the fill, and its depth over the crown; 0 where there is none.
    pressure : float
        Horizontal pressure with which fill resists a back that moves towards it, over its weight above; 0 where it does
        not resist.
    """

    span_m: float
    rise_m: float
    ring_m: float
    width_m: float
    density_kg_m3: float
    voussoirs: int
    fill_n_m3: float = 0.0
    cover_m: float = 0.0
    pressure: float = 0.0

    @property
    def inner_m(self) -> float:
        """Radius of the intrados."""
        return (self.span_m**2 / 4.0 + self.rise_m**2) / (2.0 * self.rise_m)

    @property
    def angles(self) -> np.ndarray:
        """Directions of the joints (n + 1,), from the vertical, left to right."""
        half = math.acos(1.0 - self.rise_m / self.inner_m)
        return np.linspace(-half, half, self.voussoirs + 1)

    def on_arc(self, radius_m: float, angle: float) -> np.ndarray:
        """Return a place (x, z): x from the middle of the span, z from the springings."""
        down = self.inner_m - self.rise_m
        return np.array([radius_m * math.sin(angle), radius_m * math.cos(angle) - down])

    def outlines(self) -> list[np.ndarray]:
        """Corners (4, 2) of each voussoir, counter-clockwise."""
        inner, outer = self.inner_m, self.inner_m + self.ring_m
        return [
            np.array([self.on_arc(r, a) for r, a in ((inner, low), (inner, high), (outer, high), (outer, low))])
            for low, high in pairwise(self.angles)
        ]

    def fill(self) -> list[tuple[np.ndarray, float]]:
        """Where on its back the fill over each voussoir weighs (x, z), and how much, N."""
        top = self.rise_m + self.ring_m + self.cover_m
        weights = []
        for corners in self.outlines() if self.fill_n_m3 else ():
            (right, low), (left, high) = corners[2], corners[3]
            depths = np.array([top - high, top - low])
            area = abs(right - left) * depths.mean()
            share = (depths[0] + 2.0 * depths[1]) / (3.0 * depths.sum())  # centre of a trapezium, from the left
            position = np.array([left + share * (right - left), high + share * (low - high)])
            weights.append((position, self.fill_n_m3 * self.width_m * area))
        return weights

    def pushes(self) -> list[tuple[np.ndarray, float]]:
        """Where on its back the fill pushes each voussoir (x, z) towards the middle, and with how much at most, N."""
        top = self.rise_m + self.ring_m + self.cover_m
        pushes = []
        for corners in self.outlines():
            position = (corners[2] + corners[3]) / 2.0
            height = abs(corners[2, 1] - corners[3, 1])
            pressure = self.pressure * self.fill_n_m3 * (top - position[1])
            pushes.append((position, pressure * height * self.width_m))
        return pushes

    def back_at(self, x_m: float) -> np.ndarray:
        """Place (x, z) on the back of the ring."""
        for corners in self.outlines():
            (right, low), (left, high) = corners[2], corners[3]
            if left <= x_m <= right:
                return np.array([x_m, high + (x_m - left) / (right - left) * (low - high)])
        raise ValueError(f"{x_m} m is beside the arch")


@dataclass(frozen=True, slots=True, eq=False)
class Limit:
    """The limit load of an arch, N, and with how much fill then pushes each voussoir (n,) towards the middle, N."""

    load_n: float
    pushes_n: np.ndarray


_STRIPS = 41
"""Lines that a load which spreads is divided into."""


def load_shares(arch: Arch, load_x_m: float, spread_m: float = 0.0) -> list[tuple[int, np.ndarray, float]]:
    """Return what a load acts on that spreads along the road: voussoirs, where on their backs (x, z), and parts."""
    lines = np.linspace(load_x_m - spread_m / 2.0, load_x_m + spread_m / 2.0, _STRIPS) if spread_m else [load_x_m]
    shares = []
    for row, corners in enumerate(arch.outlines()):
        on_it = [x for x in lines if corners[3, 0] <= x < corners[2, 0]]
        if on_it:
            shares.append((row, arch.back_at(float(np.mean(on_it))), len(on_it) / len(lines)))
    return shares


def limit_load_n(arch: Arch, load_x_m: float, bond_pa: float = 0.0, spread_m: float = 0.0) -> float:
    """Return the load at which an arch comes down by limit analysis, N: that of `limit_of`."""
    return limit_of(arch, load_x_m, bond_pa, spread_m).load_n


def limit_of(arch: Arch, load_x_m: float, bond_pa: float = 0.0, spread_m: float = 0.0) -> Limit:
    """Return the limit load of an arch of rigid blocks by limit analysis (Livesley 1978).

    The largest for which forces at the edges of all joints exist that press, hold by friction and balance each block.
    Mortar that holds on with a constant stress however far it opens lets each edge pull with half of that on the joint.
    Fill pushes each voussoir with any force up to its most: all of it on those that move towards it as the arch comes
    down, and nothing on those that move away from it, as the largest load is found (complementary slackness).
    """
    pull = bond_pa * arch.ring_m * arch.width_m / 2.0
    outlines, angles = arch.outlines(), arch.angles
    inner, outer = arch.inner_m, arch.inner_m + arch.ring_m
    count = arch.voussoirs
    of_load = 3 * (count + 1)
    balance = np.zeros((3 * count, of_load + 1 + count))
    given = np.zeros(3 * count)
    fill, pushes = arch.fill(), arch.pushes()
    for row, point, share in load_shares(arch, load_x_m, spread_m):
        balance[3 * row : 3 * row + 3, of_load] = _wrench(point, np.array([0.0, -share]))
    for row, corners in enumerate(outlines):
        area, centre = _area_and_centre(corners)
        forces = [(centre, -area * arch.width_m * arch.density_kg_m3 * G)]
        forces += [(position, -weight) for position, weight in fill[row : row + 1]]
        for position, upwards in forces:
            given[3 * row : 3 * row + 3] -= _wrench(position, np.array([0.0, upwards]))
        push_at = pushes[row][0]
        balance[3 * row : 3 * row + 3, of_load + 1 + row] = _wrench(push_at, np.array([-np.sign(push_at[0]), 0.0]))
        for joint, sign in ((row, 1.0), (row + 1, -1.0)):
            angle = angles[joint]
            along, across = np.array([math.cos(angle), -math.sin(angle)]), np.array([math.sin(angle), math.cos(angle)])
            columns = (
                (arch.on_arc(outer, angle), along),
                (arch.on_arc(inner, angle), along),
                (arch.on_arc(inner, angle), across),
            )
            for offset, (position, direction) in enumerate(columns):
                balance[3 * row : 3 * row + 3, 3 * joint + offset] += _wrench(position, sign * direction)
    slides = np.zeros((2 * (count + 1), balance.shape[1]))
    for joint in range(count + 1):
        for row, sign in ((2 * joint, 1.0), (2 * joint + 1, -1.0)):
            slides[row, 3 * joint : 3 * joint + 3] = -FRICTION, -FRICTION, sign
    holds = np.full(len(slides), 2.0 * FRICTION * pull)
    scale = abs(given).max()
    bounds = [(-pull / scale, None), (-pull / scale, None), (None, None)] * (count + 1) + [(0.0, None)]
    bounds += [(0.0, most / scale) for _, most in pushes]
    cost = np.zeros(balance.shape[1])
    cost[of_load] = -1.0
    found = linprog(
        cost,
        A_ub=slides,
        b_ub=holds / scale,
        A_eq=balance,
        b_eq=given / scale,
        bounds=bounds,
        method="highs",
    )
    if found.status != 0:
        return Limit(0.0, np.zeros(count))
    return Limit(float(found.x[of_load]) * scale, found.x[of_load + 1 :] * scale)


_PARTS = 10
"""Straight beams that a voussoir is divided into, for beam theory."""


def first_crack_n(arch: Arch, load_x_m: float, bond_pa: float) -> float:
    """Return the load at which the stress at the edge of a joint first reaches that of the bond, by beam theory, N.

    The ring is elastic, whole and built in at both springings: N / A + M / W of its own weight and the load.
    """
    area, modulus = arch.ring_m * arch.width_m, arch.width_m * arch.ring_m**2 / 6.0
    half = arch.angles[-1]
    middle = arch.inner_m + arch.ring_m / 2.0
    nodes = np.array([arch.on_arc(middle, angle) for angle in np.linspace(-half, half, _PARTS * arch.voussoirs + 1)])
    count = len(nodes)
    weight, unit = np.zeros((2, 3 * count))
    stiffness = np.zeros((3 * count, 3 * count))
    beams = []
    for row, (start, end) in enumerate(pairwise(nodes)):
        length = math.dist(start, end)
        turn = np.eye(6)
        (cosine, sine) = (end - start) / length
        turn[:2, :2] = turn[3:5, 3:5] = [[cosine, sine], [-sine, cosine]]
        own = np.zeros((6, 6))
        own[np.ix_((0, 3), (0, 3))] = area / length * np.array([[1.0, -1.0], [-1.0, 1.0]])
        bends = np.array(
            [
                [12.0, 6.0 * length, -12.0, 6.0 * length],
                [6.0 * length, 4.0 * length**2, -6.0 * length, 2.0 * length**2],
                [-12.0, -6.0 * length, 12.0, -6.0 * length],
                [6.0 * length, 2.0 * length**2, -6.0 * length, 4.0 * length**2],
            ]
        )
        own[np.ix_((1, 2, 4, 5), (1, 2, 4, 5))] = modulus * arch.ring_m / 2.0 / length**3 * bends
        positions = np.arange(3 * row, 3 * row + 6)
        stiffness[np.ix_(positions, positions)] += turn.T @ own @ turn
        weight[[3 * row + 1, 3 * row + 4]] -= arch.density_kg_m3 * G * area * length / 2.0
        beams.append((own @ turn, positions))
    unit[3 * int(np.argmin(abs(nodes[:, 0] - load_x_m))) + 1] = -1.0
    free = np.arange(3, 3 * count - 3)
    edges = []
    for forces in (weight, unit):
        moved = np.zeros(3 * count)
        moved[free] = np.linalg.solve(stiffness[np.ix_(free, free)], forces[free])
        ends = np.array([beam @ moved[positions] for beam, positions in beams])
        pull = np.append(-ends[::_PARTS, 0], ends[-1, 3])
        bend = np.append(ends[::_PARTS, 2], -ends[-1, 5])
        edges.append(np.concatenate((pull / area + bend / modulus, pull / area - bend / modulus)))
    return min((bond_pa - own) / by_unit for own, by_unit in zip(*edges, strict=True) if by_unit > 0.0)


def _wrench(position: np.ndarray, force: np.ndarray) -> np.ndarray:
    return np.array([force[0], force[1], position[0] * force[1] - position[1] * force[0]])


def _area_and_centre(corners: np.ndarray) -> tuple[float, np.ndarray]:
    following = np.roll(corners, -1, axis=0)
    crosses = corners[:, 0] * following[:, 1] - corners[:, 1] * following[:, 0]
    area = crosses.sum() / 2.0
    return area, ((corners + following) * crosses[:, None]).sum(axis=0) / (6.0 * area)


@dataclass(frozen=True, slots=True)
class Course:
    """How an arch came down, frame by frame.

    Attributes
    ----------
    sag_m : (k,) float
        How far the loaded voussoir had come down.
    load_n : (k,) float
        The load.
    resistance_n : (k,) float
        What the arch bore of it: the load less what it gave to motion, by the work of both.
    cracked_n : float
        The load as the first joint cracked; infinite where none was to.
    """

    sag_m: np.ndarray
    load_n: np.ndarray
    resistance_n: np.ndarray
    cracked_n: float

    def borne_n(self, farthest_m: float) -> float:
        """Return the most that the arch bore until the voussoir had come down that far."""
        return float(self.resistance_n[self.sag_m <= farthest_m].max())

    def load_at_n(self, sag_m: float) -> float:
        """Return the load under which the voussoir had come down that far."""
        return float(self.load_n[int(np.argmax(self.sag_m >= sag_m))])


_FRAMES = 4
"""Over which work and motion are compared: a joint that opens with a jerk is no change of what is borne."""


def course_of(results: Results, bodies: Mapping[int, float], load_n: np.ndarray) -> Course:
    """Return how an arch came down, under a load (k,) of which bodies have their parts."""
    broken = np.flatnonzero((~results.frames.intact).any(axis=1))
    cracked = (load_n[broken[0] - 1] + load_n[broken[0]]) / 2.0 if len(broken) else math.inf
    heights = results.frames.positions_m[:, list(bodies), 2].astype(float) @ np.array(list(bodies.values()))
    sag = heights[0] - heights
    kinetic = energy_of(results).kinetic_j
    start = int(np.argmax(load_n > 0.0))  # while it settles, what little moves says nothing
    sag, kinetic, load_n = sag[start:], kinetic[start:], load_n[start:]
    before, after = slice(None, -_FRAMES), slice(_FRAMES, None)
    gone = sag[after] - sag[before]
    mean = (load_n[after] + load_n[before]) / 2.0
    inertia = np.divide(kinetic[after] - kinetic[before], gone, out=np.zeros_like(gone), where=gone > 0.0)
    middle = slice(_FRAMES // 2, -_FRAMES // 2)
    return Course(sag[middle], load_n[middle], mean - inertia, float(cracked))


def loaded(
    folder: Path,
    name: str,
    arch: Arch,
    load_x_m: float,
    course: Sequence[tuple[float, float]],
    *,
    spread_m: float = 0.0,
    limit: Limit | None = None,
    connections: str = "",
    substeps_per_frame: int = 320,
    iterations: int = 60,
) -> Course:
    """Load an arch as a course of (time, N) says, in a run that ends with it.

    Fill pushes voussoirs as at the limit. Until the load is there it does so in proportion to the load: as arches stand
    without both and with both, they stand in between, by the theorem of the safe state.
    """
    depth = arch.width_m / 2.0
    base_m = 1.0
    meshes = {f"voussoir_{row:02d}.obj": prism(outline, -depth, depth) for row, outline in enumerate(arch.outlines())}
    for side, corners in _springers(arch).items():
        meshes[f"springer_{side}.obj"] = prism(corners, -depth, depth)
    members = "".join(
        f"""
[[geometry]]
name = "{mesh.replace("_", " ").removesuffix(".obj")}"
kind = "{mesh.split("_")[0]}"
file = "{mesh}"
position_m = [0.0, 0.0, {base_m}]
density_kg_m3 = {arch.density_kg_m3}
"""
        for mesh in meshes
    )
    loads = "".join(
        _load(f"voussoir {row:02d}", position, base_m, ((0.0, weight),))
        for row, (position, weight) in enumerate(arch.fill())
    )
    shares = load_shares(arch, load_x_m, spread_m)
    loads += "".join(
        _load(f"voussoir {row:02d}", point, base_m, [(time_s, share * force) for time_s, force in course])
        for row, point, share in shares
    )
    if limit:
        loads += _pushes(arch, limit, course, base_m)
    scenario = f"""
[scenario]
title = "{name.replace("_", " ")}"

[time]
duration_s = {course[-1][0]}
frames_per_second = 48
substeps_per_frame = {substeps_per_frame}
solver_iterations = {iterations}
{members}{loads}
[[supports]]
member = "springer"

[fracture]
shards = {arch.voussoirs + 2}
{connections or LOOSE_JOINTS}
{RIGID_BODIES.format(shards=FRICTION, ground=FRICTION)}"""
    results = simulated(folder, name, scenario, meshes)
    members = results.inventory.body_members
    bodies = {int(np.flatnonzero(members == f"voussoir {row:02d}")[0]): share for row, _, share in shares}
    times, forces = zip(*course, strict=True)
    return course_of(results, bodies, np.interp(results.frames.time_s, times, forces, left=0.0))


LOOSE_JOINTS = """
[connections]
type = "FIXED"
method = "face"
breaking_force_n = 1e12

[[connections.between]]
members = ["voussoir", "voussoir"]
none = true

[[connections.between]]
members = ["voussoir", "springer"]
none = true
"""
"""Voussoirs that only touch."""


def _springers(arch: Arch) -> dict[str, np.ndarray]:
    """Corners of the blocks that hold the arch, whose faces are its first and last joints."""
    inner, outer = arch.inner_m, arch.inner_m + arch.ring_m
    found = {}
    for side, sign in (("left", -1.0), ("right", 1.0)):
        angle = sign * arch.angles[-1]
        low, high = arch.on_arc(inner - arch.ring_m, angle), arch.on_arc(outer + arch.ring_m, angle)
        out = sign * arch.ring_m * np.array([math.cos(angle), -math.sin(angle)])
        corners = np.array([low, low + out, high + out, high])
        found[side] = corners if _area_and_centre(corners)[0] > 0.0 else corners[::-1]
    return found


def _pushes(arch: Arch, limit: Limit, course: Sequence[tuple[float, float]], base_m: float) -> str:
    """Fill that pushes in proportion to the load up to the limit, and no more than that."""
    (begins_s, _), (ends_s, most_n) = course
    at_limit_s = begins_s + (ends_s - begins_s) * limit.load_n / most_n
    return "".join(
        _load(
            f"voussoir {row:02d}",
            position,
            base_m,
            ((begins_s, 0.0), (at_limit_s, push)),
            (-float(np.sign(position[0])), 0.0, 0.0),
        )
        for row, ((position, _), push) in enumerate(zip(arch.pushes(), limit.pushes_n.tolist(), strict=True))
        if push > 0.0
    )


def _load(
    member: str,
    position: np.ndarray,
    base_m: float,
    course: Sequence[tuple[float, float]],
    direction: tuple[float, float, float] = (0.0, 0.0, -1.0),
) -> str:
    times, forces = ([float(value) for value in values] for values in zip(*course, strict=True))
    return f"""
[[loads]]
members = ["{member}"]
point_m = [{position[0]:.6f}, 0.0, {position[1] + base_m:.6f}]
direction = {list(direction)}
times_s = {times}
forces_n = {forces}
"""
