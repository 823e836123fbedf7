"""Fragments of a zone that are smaller than shards: their sizes, speeds and flight with drag.

Known within a factor of 2: neither sizes nor speeds have been measured for concrete in columns. Fragments are sampled
so that each stands for the same mass.

Largest distances of flyrock by published rules are as if nothing covered the holes. They are no safety distances.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..arithmetic import cosine, cube_root, exponential, logarithm, power, sine
from ..arrays import BoolArray, FloatArray
from ..units import STANDARD_GRAVITY_M_S2

AIR_KG_M3 = 1.225
"""Density of air at sea level and 15 °C (ISO 2533)."""

DRAG_COEFFICIENT = 1.0
"""Of tumbling cubes, 0.8 to 1.2."""

EXPLOSIVE_ENERGY_J_KG = 4e6
SPEED_SHARE = 0.06
"""Part of the explosive's energy that moves fragments: 14 m/s at 1 kg/m³. Shares of 0.02 to 0.2 give 8 to 26 m/s, and
burdens of rock move with 6 to 30 m/s."""

SPEED_SCATTER = 0.5
"""Standard deviation of the logarithm of their speeds."""

ROCK_FACTOR, UNIFORMITY = 7.0, 1.1
"""A (4 to 13) and n (0.8 to 1.5) of Kuz-Ram: not calibrated on concrete."""

_FRAGMENT_AREA = 1.5
"""Mean area that a tumbling cube shows, by its volume to the power of 2/3: a quarter of its surface (A. Cauchy)."""

_TNT_RWS = 115.0
_CM_PER_M = 100.0
_FACING = 4.0
"""Fragments leave a face by the cosine of the angle to its normal to this power."""

_STEP_S = 0.005
_LONGEST_FLIGHT_S = 120.0

HeightsAt = Callable[[FloatArray], FloatArray]
"""Heights (n,) of the ground at positions (n, 2), m."""


@dataclass(frozen=True, slots=True, eq=False)
class Fragments:
    """n fragments as they leave their zone; each stands for the same mass."""

    sizes_m: FloatArray  # (n,), cube roots of their volumes
    positions_m: FloatArray  # (n, 3)
    velocities_m_s: FloatArray  # (n, 3)
    density_kg_m3: float | FloatArray  # common, or of each (n,)

    def of(self, chosen: BoolArray) -> Fragments:
        """Return those that are chosen (n,)."""
        density = np.broadcast_to(self.density_kg_m3, self.sizes_m.shape)[chosen]
        return Fragments(self.sizes_m[chosen], self.positions_m[chosen], self.velocities_m_s[chosen], density)

    @classmethod
    def joined(cls, parts: Sequence[Fragments]) -> Fragments:
        """Join the fragments of several zones."""
        return cls(
            np.concatenate([part.sizes_m for part in parts]),
            np.concatenate([part.positions_m for part in parts]),
            np.concatenate([part.velocities_m_s for part in parts]),
            np.concatenate([np.broadcast_to(part.density_kg_m3, part.sizes_m.shape) for part in parts]),
        )

    @property
    def masses_kg(self) -> FloatArray:
        """Masses (n,) of single fragments."""
        return self.density_kg_m3 * self.sizes_m * self.sizes_m * self.sizes_m


@dataclass(frozen=True, slots=True)
class Ranges:
    """Distances on plan that parts of the fragments' mass stay within, and the largest distance, m."""

    half_m: float
    most_m: float  # 99 %
    nearly_all_m: float  # 99.9 %
    largest_m: float


def mean_size_m(
    specific_kg_m3: float, charge_a_hole_kg: float, relative_strength: float = 100.0, rock_factor: float = ROCK_FACTOR
) -> float:
    """Return the size that half of the mass is smaller than, X50 = A q^-0.8 Q^(1/6) (115 / RWS)^(19/30) cm.

    C. V. B. Cunningham (1987), Fragmentation estimations and the Kuz-Ram model, 2nd International Symposium on Rock
    Fragmentation by Blasting, 475-487.
    """
    by_strength = power(_TNT_RWS / relative_strength, 19.0 / 30.0)
    by_charge = power(specific_kg_m3, -0.8) * power(charge_a_hole_kg, 1.0 / 6.0)
    return float(rock_factor * by_charge * by_strength) / _CM_PER_M


def passing_share(size_m: ArrayLike, mean_m: float, uniformity: float = UNIFORMITY) -> FloatArray:
    """Return the part of the mass in fragments up to a size, 1 - exp(-ln 2 (x / X50)^n).

    P. Rosin and E. Rammler (1933), The laws governing the fineness of powdered coal, Journal of the Institute of Fuel
    7, 29-36.
    """
    share: FloatArray = 1.0 - exponential(-np.log(2.0) * power(np.asarray(size_m, float) / mean_m, uniformity))
    return share


def size_of_share_m(share: ArrayLike, mean_m: float, uniformity: float = UNIFORMITY) -> FloatArray:
    """Return the size that a part of the mass, below 1, is smaller than: the inverse of `passing_share`."""
    return mean_m * power(-logarithm(1.0 - np.asarray(share, float)) / np.log(2.0), 1.0 / uniformity)


def mean_speed_m_s(specific_kg_m3: ArrayLike, density_kg_m3: float = 2400.0, share: float = SPEED_SHARE) -> FloatArray:
    """Return the mean speed of fragments, v = √(2 η e q / ρ), by a share η of the explosive's energy."""
    energy_j_m3 = share * EXPLOSIVE_ENERGY_J_KG * np.asarray(specific_kg_m3, float)
    speed: FloatArray = np.sqrt(2.0 * energy_j_m3 / density_kg_m3)
    return speed


def sampled_speeds_m_s(count: int, mean_m_s: float, largest_m_s: float, generator: np.random.Generator) -> FloatArray:
    """Return speeds (count,): log-normal with a mean, and those above the largest replaced by it."""
    spread = SPEED_SCATTER * _normal(count, generator)
    speeds = mean_m_s * exponential(spread - SPEED_SCATTER * SPEED_SCATTER / 2.0)
    return np.minimum(speeds, largest_m_s)


def sampled_directions(count: int, normal: ArrayLike, generator: np.random.Generator) -> FloatArray:
    """Return unit vectors (count, 3) about a unit normal: their density goes by the cosine to it to the power of 4."""
    axis = np.asarray(normal, float)
    across = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    across /= np.sqrt((across * across).sum())
    upwards = np.cross(axis, across)
    along = power(generator.random(count), 1.0 / (_FACING + 1.0))
    aside, turn = np.sqrt(np.maximum(1.0 - along * along, 0.0)), 2.0 * np.pi * generator.random(count)
    by_across, by_upwards = aside * cosine(turn), aside * sine(turn)
    directions: FloatArray = along[:, None] * axis + by_across[:, None] * across + by_upwards[:, None] * upwards
    return directions


def landings_m(
    fragments: Fragments,
    heights_at: HeightsAt | None = None,
    *,
    drag_coefficient: float = DRAG_COEFFICIENT,
    gravity_m_s2: float = STANDARD_GRAVITY_M_S2,
) -> FloatArray:
    """Return where fragments come down first (n, 3), on ground at height 0 or with such heights.

    m dv/dt = m g - ½ ρ C_d A v², solved by Runge and Kutta's method of fourth order in steps of 5 ms.
    """
    landings = fragments.positions_m.copy()
    flying = np.arange(len(landings))
    # By components (3, n), whose sums are of whole rows.
    positions, velocities = fragments.positions_m.T.copy(), fragments.velocities_m_s.T.copy()
    slowing = 0.5 * AIR_KG_M3 * drag_coefficient * _FRAGMENT_AREA / (fragments.density_kg_m3 * fragments.sizes_m)
    gravity = np.array([[0.0], [0.0], [-gravity_m_s2]])
    clear = _clearance(positions, heights_at)
    for _ in range(round(_LONGEST_FLIGHT_S / _STEP_S)):
        if not len(flying):
            break
        after, velocities = _step(positions, velocities, slowing, gravity)
        after_clear = _clearance(after, heights_at)
        landed: BoolArray = after_clear <= 0.0
        if landed.any():
            before, fall = clear[landed], clear[landed] - after_clear[landed]
            share = np.clip(before / fall, 0.0, 1.0)
            began = positions[:, landed]
            landings[flying[landed]] = (began + share * (after[:, landed] - began)).T
            flying, after, velocities = flying[~landed], after[:, ~landed], velocities[:, ~landed]
            slowing, after_clear = slowing[~landed], after_clear[~landed]
        positions, clear = after, after_clear
    landings[flying] = positions.T
    return landings


def ranges_m(origin_m: ArrayLike, landings: FloatArray, masses_kg: FloatArray, least_kg: float = 0.1) -> Ranges:
    """Return distances on plan from a position of landings (n, 3) of fragments that have a mass (n,) at least.

    Of fragments that are all lighter, every distance is 0.
    """
    origin = np.asarray(origin_m, float)
    flown = np.hypot(landings[:, 0] - origin[0], landings[:, 1] - origin[1])[masses_kg >= least_kg]
    if not len(flown):
        return Ranges(0.0, 0.0, 0.0, 0.0)
    half, most, nearly_all = np.quantile(flown, [0.5, 0.99, 0.999], method="inverted_cdf")
    return Ranges(float(half), float(most), float(nearly_all), float(flown.max()))


def _step(
    positions: FloatArray, velocities: FloatArray, slowing: FloatArray, gravity: FloatArray
) -> tuple[FloatArray, FloatArray]:
    def acceleration(velocity: FloatArray) -> FloatArray:
        squares = velocity * velocity
        speed = np.sqrt(squares[0] + squares[1] + squares[2])
        gained: FloatArray = gravity - slowing * speed * velocity
        return gained

    half = 0.5 * _STEP_S
    first = acceleration(velocities)
    second_velocity = velocities + half * first
    second = acceleration(second_velocity)
    third_velocity = velocities + half * second
    third = acceleration(third_velocity)
    last_velocity = velocities + _STEP_S * third
    last = acceleration(last_velocity)
    moved = positions + _STEP_S / 6.0 * (velocities + 2.0 * second_velocity + 2.0 * third_velocity + last_velocity)
    return moved, velocities + _STEP_S / 6.0 * (first + 2.0 * second + 2.0 * third + last)


def _clearance(positions: FloatArray, heights_at: HeightsAt | None) -> FloatArray:
    """Heights (n,) of positions (3, n) above the ground; what is beyond its edge falls on height 0."""
    heights: FloatArray = positions[2].copy()
    if heights_at is not None:
        heights -= np.nan_to_num(heights_at(positions[:2].T), nan=0.0)
    return heights


def _normal(count: int, generator: np.random.Generator) -> FloatArray:
    """Return normal numbers (count,), from uniform ones, which are exact on every processor.

    G. E. P. Box and M. E. Muller (1958), A note on the generation of random normal deviates, Annals of Mathematical
    Statistics 29, 610-611.
    """
    size = np.sqrt(-2.0 * logarithm(1.0 - generator.random(count)))
    return size * cosine(2.0 * np.pi * generator.random(count))


RISKY_BURIAL = 0.8
"""Scaled depth of burial, m/kg^(1/3), below which flyrock is "violent": B. McKenzie (2009)."""

_INCH_M = 0.0254
_SHORT_HOLE_M = 0.1
_MM_PER_M = 1000.0


def lundborg_range_m(diameter_m: ArrayLike) -> FloatArray:
    """Return L = 260 d^(2/3), d in inches.

    N. Lundborg, A. Persson, A. Ladegaard-Pedersen and R. Holmberg (1975), Keeping the lid on flyrock in open-pit
    blasting, Engineering and Mining Journal 176, 95-100.
    """
    return 260.0 * power(np.asarray(diameter_m, float) / _INCH_M, 2.0 / 3.0)


def scaled_depth_of_burial(
    charge_length_m: ArrayLike, stemming_m: ArrayLike, diameter_m: ArrayLike, density_kg_m3: ArrayLike
) -> FloatArray:
    """Return D / M^(1/3), m/kg^(1/3), of the upper part of a charge: its mass M, and the depth D of its middle.

    That part is 10 diameters long at most, 8 in holes below 100 mm: C. McKenzie (2009), Flyrock range and fragment size
    prediction, 35th Conference on Explosives and Blasting Technique, ISEE, after R. F. Chiappetta.
    """
    diameter = np.asarray(diameter_m, float)
    diameters = np.where(diameter < _SHORT_HOLE_M, 8.0, 10.0)
    length = np.minimum(np.asarray(charge_length_m, float), diameters * diameter)
    mass = np.pi / 4.0 * np.square(diameter) * length * np.asarray(density_kg_m3, float)
    buried: FloatArray = (stemming_m + length / 2.0) / cube_root(mass)
    return buried


def mckenzie_range_m(diameter_m: ArrayLike, scaled_depth: ArrayLike) -> FloatArray:
    """Return R = 9.74 (d / SDoB^2.167)^(2/3), d in mm; C. McKenzie (2009), as above."""
    buried = power(np.asarray(scaled_depth, float), 2.167)
    return 9.74 * power(_MM_PER_M * np.asarray(diameter_m, float) / buried, 2.0 / 3.0)


def speed_for_range_m_s(range_m: ArrayLike) -> FloatArray:
    """Return the least speed with which something flies so far over level ground without drag: √(g R)."""
    speed: FloatArray = np.sqrt(STANDARD_GRAVITY_M_S2 * np.asarray(range_m, float))
    return speed
