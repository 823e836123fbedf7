"""Touchdown: what lands together, with which energy, and how it shakes the ground around.

The fall of a bridge often shakes the ground more than its charges. Chinese practice estimates it from what lands at
once, by the formula of Zhou Jiahan (*Engineering Blasting* 15(1), 2009, 1-4; as it is quoted, for the paper itself was
not at hand):

    v = Kt (R / (M g H / σ)^(1/3))^β

with v in cm/s, R in m, M in t, H in m and σ = 10 MPa as bare numbers. M g H is the energy of the fall in kJ, so what is
taken here is the kinetic energy with which bodies land. That delays and bodies on the way down take energy from it is
then in it. A factor of two to either side is usual.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from ...engineering.arithmetic import cube_root, power
from ...engineering.blast.site_law import SiteLaw
from ...engineering.geometry.vectors import distance
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ..results.arrays import Results
from ..results.motion import relative_to_ground
from ..scenario.fall_beds import FallBed, vibration_factors
from ..schema import given

TOGETHER_S = 0.2
"""What lands within this time shakes the ground as one."""

VELOCITY_M_S = 0.0337
"""Kt, the velocity at a scaled distance of 1; 3.37 to 4.09 cm/s are quoted for ground without ditches and banks."""

EXPONENT = 1.66
"""-β; 1.66 to 1.80 are quoted."""

_STRENGTH_MPA = 10.0
"""σ of the formula, for concrete and masonry."""

_LEAST_FALL_M_S = 1.0
"""Slower bodies settle, they do not fall: a fall of 5 cm."""

NEAREST_M = 20.0
"""Nearest distance of the formula, ours: nearer, what is known contradicts it. It has 95 mm/s at 9 m from a span
of the Shengli bridge and 327 mm/s at 10 m from a field of the Sinntal bridge, where an expert foresaw 20 mm/s at most
(infranken.de, 2013); bridges beside both were unharmed."""

_AT_LEAST_M = 1.0
"""A landing at the position itself counts with this distance."""


@dataclass(frozen=True, eq=False, slots=True)
class Landings:
    """Bodies (b,) that fell and were stopped, in the order in which they were.

    Each has the time at which it was fastest on its way down, the frame before it was slowed, the kinetic energy of
    its fall and its position (b, 3) then, and the part of its shaking that fall beds leave.
    """

    bodies: np.ndarray
    times_s: np.ndarray
    masses_kg: np.ndarray
    energies_j: np.ndarray
    places_m: np.ndarray
    vibration_factors: np.ndarray

    def __len__(self) -> int:
        return len(self.bodies)

    def together(self) -> list[slice]:
        """Return the landings within `TOGETHER_S` from each one on, as slices."""
        ends = np.searchsorted(self.times_s, self.times_s + TOGETHER_S, side="right")
        return [slice(begin, int(end)) for begin, end in enumerate(ends)]


@dataclass(frozen=True, slots=True)
class Shaking:
    """How the ground is shaken at a position by bodies that land together from a time on.

    `velocity_m_s` is the peak particle velocity by Zhou's formula or the site's law, `distance_m` in plan to their
    middle by energy. `at_most_m_s` is the upper line of that law, and without one the velocity; `is_extrapolated` says
    whether the law was measured at other scaled distances. Nearer than `NEAREST_M` neither is known without a law.
    """

    velocity_m_s: float | None
    time_s: float
    mass_kg: float
    energy_j: float
    distance_m: float
    at_most_m_s: float | None
    is_extrapolated: bool = False


def landings(results: Results, beds: Sequence[FallBed] = ()) -> Landings:
    """Return the shards and balls that fell and were stopped, by the ground or in fall beds.

    A frame lies between the fastest moment of a body and the one in which it is stopped, so that it may land with one
    frame of gravity more: this is counted as if it did.
    """
    inventory, frames = results.inventory, relative_to_ground(results).frames
    bodies = np.concatenate((inventory.of_kind("shard"), inventory.of_kind("ball")))
    downwards = -frames.velocities_m_s[:, bodies, 2]
    fastest = downwards.argmax(axis=0)
    columns = np.arange(len(bodies))
    speeds = downwards[fastest, columns]
    # One that is fastest in the last frame is still falling.
    landed = np.flatnonzero((speeds > _LEAST_FALL_M_S) & (fastest < len(frames.time_s) - 1))
    rows, bodies, speeds = fastest[landed], bodies[landed], speeds[landed]
    times = frames.time_s[rows]
    speeds = speeds + STANDARD_GRAVITY_M_S2 * (frames.time_s[rows + 1] - times)
    masses = inventory.masses_kg[bodies]
    order = np.argsort(times, kind="stable")
    places = frames.positions_m[rows, bodies]
    left = vibration_factors(beds, places[:, :2])
    columns_of_bodies = (bodies, times, masses, 0.5 * masses * np.square(speeds), places, left)
    return Landings(*(values[order] for values in columns_of_bodies))


def shaking_at(position_m: ArrayLike, landed: Landings, law: SiteLaw | None = None) -> Shaking | None:
    """Return the largest shaking of the ground at a position (3,), m, by the site's law; None where nothing landed.

    Without a law it is by Zhou's formula; None where what shakes most lands nearer than the formula holds.
    """
    worst = max(
        (_shaking(position_m, landed, together, law) for together in landed.together()),
        key=lambda shaking: given(shaking.at_most_m_s),
        default=None,
    )
    if worst is None or law is not None or worst.distance_m >= NEAREST_M:
        return worst
    return replace(worst, velocity_m_s=None, at_most_m_s=None)


def touchdown_velocity(distance_m: ArrayLike, energy_j: ArrayLike) -> np.ndarray:
    """Return the peak particle velocity, m/s, at distances, m, from what lands together with energies, J."""
    scaled = np.asarray(distance_m, float) / cube_root(np.asarray(energy_j, float) / 1e3 / _STRENGTH_MPA)
    return VELOCITY_M_S * power(scaled, -EXPONENT)


def _shaking(position_m: ArrayLike, landed: Landings, together: slice, law: SiteLaw | None) -> Shaking:
    energies = landed.energies_j[together]
    middle = (energies[:, None] * landed.places_m[together]).sum(axis=0) / energies.sum()
    distance_m = max(float(distance(np.asarray(position_m, float)[:2], middle[:2])), _AT_LEAST_M)
    energy_j = float(energies.sum())
    left = float((energies * landed.vibration_factors[together]).sum() / energies.sum())
    velocity = float(law.velocity(distance_m, energy_j / 1e3) if law else touchdown_velocity(distance_m, energy_j))
    at_most = left * (float(law.at_most(distance_m, energy_j / 1e3)) if law else velocity)
    velocity *= left
    mass = float(landed.masses_kg[together].sum())
    is_extrapolated = law is not None and not law.covers(distance_m, energy_j / 1e3)
    time_s = float(landed.times_s[together.start])
    return Shaking(velocity, time_s, mass, energy_j, distance_m, at_most, is_extrapolated)
