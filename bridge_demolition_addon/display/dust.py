"""What shows where connections break: dust and chips that fly, and bars that stick out of cracks; for looks only."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh, joined_meshes
from ..engineering.terrain.surface import RecordedGround
from ..model.results.arrays import Results
from ..model.results.frames import Inventory
from ..model.scenario.steelwork import NODE_KIND
from .dressing import DrawnPart, Stuff, rod

MOST_PUFFS = 60
"""Clouds that a renderer still draws in a reasonable time."""

MOST_TOUCHDOWNS = 30
"""The same of those where bodies come down."""

_FAST_M_S, _NEAR_M = 1.5, 0.3
"""Least speed downwards before a body comes down, and how near to the ground its lowest corner is then."""

_RADIUS_OF_MASS = 0.11
"""Radius of such a cloud, m, by the cube root of the mass, kg."""

STEEL_KG_M3 = 5000.0
"""Least density of a body that is of steel: it makes no dust, and no chips."""

_LEAST_RADIUS_M, _RADIUS_OF_AREA = 0.6, 1.2
"""Radius of a fully grown cloud: at least, and for a square of broken area of 1 m²."""


@dataclass(frozen=True, slots=True)
class Puff:
    """A cloud of dust: the frame in which it appears, its middle, and its radius when fully grown."""

    frame: int
    position_m: tuple[float, float, float]
    radius_m: float


def puffs(results: Results, most: int = MOST_PUFFS, opened: np.ndarray | None = None) -> list[Puff]:
    """Return the clouds where connections broke, the largest ones where there would be more than `most`.

    Connections that break in one frame and in one cube of space make one cloud. How large it becomes goes with the
    broken area; that is a picture, and no forecast of dust. Connections break where `opened` (k, m) says that
    they have by each frame, by default as they were recorded.
    """
    frames, inventory = results.frames, results.inventory
    intact = np.asarray(frames.intact)
    if len(intact) < 2 or not intact.shape[1]:
        return []
    holds = intact if opened is None else ~opened
    rows, broken = np.nonzero(holds[:-1] & ~holds[1:] & ~are_steel(inventory)[inventory.pairs].all(axis=1))
    span = np.ptp(inventory.points_m, axis=0).max(initial=1.0)
    cell = max(span / 12.0, 1.0)
    cubes: dict[tuple, list[int]] = {}
    positions = _places(results, rows, broken)
    for number, (row, position) in enumerate(zip(rows.tolist(), positions, strict=True)):
        cubes.setdefault((row, *np.floor(position / cell).astype(int).tolist()), []).append(number)
    clouds = [
        Puff(
            int(frames.number[row + 1]),
            tuple(positions[members].mean(axis=0).tolist()),
            max(_LEAST_RADIUS_M, _RADIUS_OF_AREA * float(inventory.areas_m2[broken[members]].sum()) ** 0.5),
        )
        for (row, *_), members in cubes.items()
    ]
    largest = sorted(clouds, key=lambda cloud: -cloud.radius_m)[:most]
    return sorted(largest, key=lambda cloud: cloud.frame)


def are_steel(inventory: Inventory) -> np.ndarray:
    """Return which bodies (n,) are of steel: heavy for their volume, or nodes of bars, whose shape is a mere symbol."""
    return (inventory.masses_kg > STEEL_KG_M3 * inventory.volumes_m3) | (inventory.body_member_kinds == NODE_KIND)


def touchdowns(results: Results, most: int = MOST_TOUCHDOWNS) -> list[Puff]:
    """Return a cloud where each of the bodies with the largest momentum comes to the ground, up to a number of them."""
    frames, inventory = results.frames, results.inventory
    if len(frames) < 2:
        return []
    falling = frames.velocities_m_s[:, :, 2]
    stopped = np.maximum(falling[1:] - falling[:-1], 0.0) * inventory.masses_kg
    stopped[falling[:-1] > -_FAST_M_S] = 0.0
    rows, bodies = stopped.argmax(axis=0), np.arange(stopped.shape[1])
    largest = np.argsort(-stopped[rows, bodies], kind="stable")[:most]
    vertices, ground, clouds = inventory.vertices_by_body(), results.ground(), []
    for body in largest.tolist():
        row = int(rows[body]) + 1
        corners = vertices[body] @ frames.rotations[row, body].T + frames.positions_m[row, body]
        foot = corners[corners[:, 2].argmin()]
        floor = float(ground.heights_at(foot[:2]))
        if stopped[row - 1, body] <= 0.0 or foot[2] - floor > _NEAR_M:
            continue
        radius = max(_LEAST_RADIUS_M, _RADIUS_OF_MASS * float(inventory.masses_kg[body]) ** (1.0 / 3.0))
        place = (float(corners[:, 0].mean()), float(corners[:, 1].mean()), floor + 0.2 * radius)
        clouds.append(Puff(int(frames.number[row]), place, radius))
    return sorted(clouds, key=lambda cloud: cloud.frame)


def _places(results: Results, rows: np.ndarray, broken: np.ndarray) -> np.ndarray:
    """Return where connections were in the last frames in which they held, (b, 3) float, m."""
    first, points = results.frames[0], results.inventory.points_m
    bodies = results.inventory.pairs[broken, 0]
    arms = points[broken] - first.positions_m[bodies]
    turns = results.frames.rotations[rows, bodies] @ first.rotations[bodies].transpose(0, 2, 1)
    return results.frames.positions_m[rows, bodies] + np.einsum("bij,bj->bi", turns, arms)


_GRAVITY_M_S2 = 9.81
_OF_RADIUS, _MOST = 10.0, 24
"""Chips for each metre of the radius of a cloud, and at most in one."""

_SIZES_M = (0.04, 0.16)
_SPEED_M_S, _UPWARDS_M_S = 1.2, 1.5
_SPIN_RAD_S = 9.0
_SEED = 7

_CORNERS = np.array(((1, 0, 0), (-0.8, 0.2, 0), (0.1, 0.9, 0), (0, -1, 0.1), (0, 0.1, 0.7), (0.1, 0, -0.6)), float)
_FACES = np.array(((0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)))


@dataclass(frozen=True, slots=True, eq=False)
class Chips:
    """c chips: when they fly off and how long they fly, s, from where (c, 3), m, how fast, m/s, sizes, m, and turns."""

    since_s: np.ndarray
    places_m: np.ndarray
    velocities_m_s: np.ndarray
    sizes_m: np.ndarray
    turns: np.ndarray
    lands_after_s: np.ndarray

    def at(self, time_s: float) -> TriangleMesh | None:
        """Return all chips that have flown off by a time as one mesh; None where there are none."""
        flown = np.flatnonzero(self.since_s <= time_s)
        if not len(flown):
            return None
        passed = np.minimum(time_s - self.since_s[flown], self.lands_after_s[flown])
        centres = self.places_m[flown] + self.velocities_m_s[flown] * passed[:, None]
        centres[:, 2] -= 0.5 * _GRAVITY_M_S2 * passed**2
        angles = self.turns[flown] + _SPIN_RAD_S * passed
        cosines, sines = np.cos(angles), np.sin(angles)
        corners = self.sizes_m[flown, None, None] / 2.0 * _CORNERS
        turned = np.stack(
            (
                cosines[:, None] * corners[..., 0] - sines[:, None] * corners[..., 2],
                corners[..., 1],
                sines[:, None] * corners[..., 0] + cosines[:, None] * corners[..., 2],
            ),
            axis=-1,
        )
        vertices = (turned + centres[:, None]).reshape(-1, 3)
        faces = (_FACES[None] + len(_CORNERS) * np.arange(len(flown))[:, None, None]).reshape(-1, 3)
        return TriangleMesh(vertices, faces)


def chips_of(clouds: list[Puff], times_s: dict[int, float], ground: RecordedGround) -> Chips:
    """Return the chips of clouds of dust, which appear at times by their frames; the same for every call."""
    random = np.random.default_rng(_SEED)
    numbers = [int(np.clip(_OF_RADIUS * cloud.radius_m, 3, _MOST)) for cloud in clouds]
    total = sum(numbers)
    since = np.repeat([times_s[cloud.frame] for cloud in clouds], numbers)
    middles = np.repeat(np.array([cloud.position_m for cloud in clouds]).reshape(-1, 3), numbers, axis=0)
    radii = np.repeat([cloud.radius_m for cloud in clouds], numbers)
    places = middles + 0.4 * radii[:, None] * random.uniform(-1.0, 1.0, (total, 3))
    sizes = _SIZES_M[0] * (_SIZES_M[1] / _SIZES_M[0]) ** random.uniform(0.0, 1.0, total) ** 2
    velocities = _SPEED_M_S * random.normal(size=(total, 3))
    velocities[:, 2] = random.uniform(-0.5, 1.0, total) * _UPWARDS_M_S
    floor = ground.heights_at(places[:, :2]) + 0.25 * sizes if total else np.zeros(0)
    places[:, 2] = np.maximum(places[:, 2], floor)
    upwards, above = velocities[:, 2], places[:, 2] - floor
    lands = (upwards + np.sqrt(upwards**2 + 2.0 * _GRAVITY_M_S2 * above)) / _GRAVITY_M_S2
    return Chips(since, places, velocities, sizes, random.uniform(0.0, 6.3, total), lands)


_MOST_CONNECTIONS = 80
_BARS_PER_FACE = 3
_THICKNESS_M = 0.03
"""Somewhat thicker than a bar, so that it is seen."""

_STRAIGHT_M, _BENT_M = 0.12, 0.28
_BAR_SEED = 11


def bent_bars(results: Results, opened: np.ndarray) -> list[DrawnPart]:
    """Return bars out of the faces of connections within a member that have opened (m,), where they were at first."""
    inventory = results.inventory
    if not len(inventory.pairs):
        return []
    first, second = inventory.pairs.T
    members = inventory.body_members
    wanted = opened & (members[first] == members[second]) & (members[first] != "")
    largest = np.flatnonzero(wanted)
    largest = largest[np.argsort(-inventory.areas_m2[largest], kind="stable")]
    broken = largest[:_MOST_CONNECTIONS].tolist()
    parts = []
    for connection in broken:
        random = np.random.default_rng((_BAR_SEED, connection))
        side = 0.35 * float(inventory.areas_m2[connection]) ** 0.5
        for body, out in zip(inventory.pairs[connection].tolist(), (1.0, -1.0), strict=True):
            normal = out * np.asarray(inventory.normals[connection], float)
            parts.append(_bars(random, np.asarray(inventory.points_m[connection], float), normal, side, body))
    return parts


def _bars(random: np.random.Generator, middle: np.ndarray, normal: np.ndarray, side: float, body: int) -> DrawnPart:
    rods = []
    for _ in range(_BARS_PER_FACE):
        offset = random.uniform(-side, side, 3)
        start = middle + offset - normal * float(offset @ normal)
        elbow = start + _STRAIGHT_M * normal
        bent = normal + 0.9 * random.normal(size=3)
        end = elbow + _BENT_M * bent / np.linalg.norm(bent)
        rods += [rod(start - 0.05 * normal, elbow, _THICKNESS_M), rod(elbow, end, _THICKNESS_M)]
    return DrawnPart(Stuff.RUST, joined_meshes(rods), body)
