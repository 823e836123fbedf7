"""A record of the ground's motion: from accelerations to velocities and displacements, and their baseline.

Between two samples the acceleration goes in a straight line. Then velocity and displacement are known exactly: with a
and b at both ends of a step h they grow by h (a + b) / 2 and h v + h² (2 a + b) / 6.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..errors import ScenarioError
from .arrays import FloatArray
from .units import STANDARD_GRAVITY_M_S2

LARGEST_ACCELERATION_M_S2 = 5.0 * STANDARD_GRAVITY_M_S2
"""More was not recorded on the ground: 4.36 g at Iwate-Miyagi in 2008, all three components together (S. Aoi, T.
Kunugi and H. Fujiwara, 2008, Science 322, 727). A record that has more is in another unit."""

LARGEST_DISPLACEMENT_M = 20.0
"""Ground moves by less in an earthquake, but on the fault itself; a record that drifts has more."""

_STILL = 0.01
"""Share of its largest velocity with which the ground may stop at the end of a record."""


@dataclass(frozen=True, slots=True, eq=False)
class GroundRecord:
    """Motion of the ground at k times."""

    times_s: FloatArray  # (k,), from 0 on
    accelerations_m_s2: FloatArray  # (k, 3), along x, y and z
    velocities_m_s: FloatArray
    displacements_m: FloatArray  # from where the ground rests before

    @property
    def duration_s(self) -> float:
        """Duration of the record."""
        return float(self.times_s[-1])

    def displacement_at(self, time_s: float) -> FloatArray:
        """Return the displacement (3,) at a time: 0 before the record, and its last one after it."""
        if time_s <= 0.0:
            return np.zeros(3)
        if time_s >= self.times_s[-1]:
            return np.array(self.displacements_m[-1])
        row = int(np.searchsorted(self.times_s, time_s, side="right")) - 1
        step, passed = self.times_s[row + 1] - self.times_s[row], time_s - self.times_s[row]
        before, after = self.accelerations_m_s2[row], self.accelerations_m_s2[row + 1]
        now = before + (after - before) * (passed / step)
        displacement: FloatArray = self.displacements_m[row] + passed * (
            self.velocities_m_s[row] + passed * (2.0 * before + now) / 6.0
        )
        return displacement

    def peaks(self) -> dict[str, list[float]]:
        """Return the largest acceleration, velocity and displacement along x, y and z, ready for JSON."""
        return {
            name: abs(getattr(self, name)).max(axis=0).tolist()
            for name in ("accelerations_m_s2", "velocities_m_s", "displacements_m")
        }


def integrated(times_s: FloatArray, accelerations_m_s2: FloatArray) -> GroundRecord:
    """Return the motion, from rest, by accelerations (k, 3) at times (k,)."""
    steps = np.diff(times_s)[:, None]
    before, after = accelerations_m_s2[:-1], accelerations_m_s2[1:]
    start = np.zeros((1, accelerations_m_s2.shape[1]))
    velocities = np.concatenate((start, np.cumsum(steps * (before + after) / 2.0, axis=0)))
    shifts = steps * velocities[:-1] + steps * steps * (2.0 * before + after) / 6.0
    return GroundRecord(
        times_s - times_s[0], accelerations_m_s2, velocities, np.concatenate((start, np.cumsum(shifts, axis=0)))
    )


def corrected(times_s: FloatArray, accelerations_m_s2: FloatArray, baseline: str) -> GroundRecord:
    """Return the motion by accelerations (k, 3) at times (k,), with a baseline taken off them."""
    taken_off: dict[str, Callable[[GroundRecord], FloatArray]] = {"linear": _line, "parabola": _parabola}
    record = integrated(times_s, accelerations_m_s2)
    if baseline in taken_off:
        record = integrated(times_s, accelerations_m_s2 - taken_off[baseline](record))
    at_end, largest = abs(record.velocities_m_s[-1]).max(), abs(record.velocities_m_s).max()
    if at_end > _STILL * largest:
        raise ScenarioError(
            f'ground_motion.baseline is "{baseline}", and the record ends with {at_end:.3g} m/s, '
            f"{at_end / largest:.0%} of its largest velocity: expected one that ends at rest; take linear or parabola"
        )
    farthest = abs(record.displacements_m).max()
    if farthest > LARGEST_DISPLACEMENT_M:
        raise ScenarioError(
            f"ground_motion moves the ground by {farthest:.0f} m: expected at most {LARGEST_DISPLACEMENT_M:g} m; check "
            "ground_motion.unit, or take another ground_motion.baseline"
        )
    return record


def _line(record: GroundRecord) -> FloatArray:
    """Accelerations (k, 3) of the line after which velocity and displacement end at 0."""
    even, rising = _powers(record.times_s, 0), _powers(record.times_s, 1)
    constant, slope = _ending_as(record, even, rising)
    return even.accelerations_m_s2 * constant + rising.accelerations_m_s2 * slope


def _parabola(record: GroundRecord) -> FloatArray:
    """Accelerations (k, 3) of the parabola after which both end at 0, and the mean square velocity is least."""
    line = _line(record)
    bent = _powers(record.times_s, 2)
    even, rising = _powers(record.times_s, 0), _powers(record.times_s, 1)
    constant, slope = _ending_as(bent, even, rising)
    ends_at_rest = bent.accelerations_m_s2 - constant * even.accelerations_m_s2 - slope * rising.accelerations_m_s2
    shape = integrated(record.times_s, ends_at_rest).velocities_m_s
    left = integrated(record.times_s, record.accelerations_m_s2 - line).velocities_m_s
    amount = (left * shape).sum(axis=0) / (shape * shape).sum()
    return line + amount * ends_at_rest


def _powers(times_s: FloatArray, exponent: int) -> GroundRecord:
    """Motion by the acceleration (k, 1) that is a power of the time, by the whole time."""
    share = (times_s - times_s[0]) / (times_s[-1] - times_s[0])
    values = np.ones(len(times_s))
    for _ in range(exponent):
        values = values * share
    return integrated(times_s, values[:, None])


def _ending_as(record: GroundRecord, one: GroundRecord, other: GroundRecord) -> tuple[FloatArray, FloatArray]:
    """Parts of two motions that together end with velocity and displacement of another, in each direction."""
    (a,), (b,) = one.velocities_m_s[-1], other.velocities_m_s[-1]
    (c,), (d,) = one.displacements_m[-1], other.displacements_m[-1]
    velocity, displacement = record.velocities_m_s[-1], record.displacements_m[-1]
    determinant = a * d - b * c
    return (d * velocity - b * displacement) / determinant, (a * displacement - c * velocity) / determinant
