"""Chips: small pieces that fly where connections break, fall and stay on the ground; for looks only, no forecast."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..engineering.geometry.mesh import TriangleMesh
from ..engineering.terrain.recorded import RecordedGround
from .dust import Puff

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
