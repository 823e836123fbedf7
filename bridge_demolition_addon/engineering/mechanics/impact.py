"""Hits: their impulse from the recorded steps, and an estimate of the force that rigid bodies cannot give.

The force of a rigid-body impact is impulse by step, and grows without limit as the step shrinks. The impulse does not
depend on the step. With a contact time, from Hertz's theory or from a measurement, it gives a peak force that does not
either. K. L. Johnson (1985), Contact Mechanics, Cambridge University Press, has the equations.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..arithmetic import power
from ..arrays import FloatArray
from ..geometry.vectors import length

_HERTZ_TIME = 4.0 * math.sqrt(math.pi) / 5.0 * math.gamma(2.0 / 5.0) / math.gamma(9.0 / 10.0)
"""2 ∫ dx / √(1 - x^(5/2)) from 0 to 1: contact time by time to cross the largest compression at full speed, 2.943."""


@dataclass(frozen=True, slots=True)
class Elasticity:
    """Elastic constants of a material."""

    young_modulus_pa: float
    poisson_ratio: float


STEEL = Elasticity(young_modulus_pa=210e9, poisson_ratio=0.3)
"""EN 1993-1-1:2005, 3.2.6."""

CONCRETE = Elasticity(young_modulus_pa=30e9, poisson_ratio=0.2)
"""C20/25 uncracked, EN 1992-1-1:2004, table 3.1 and 3.1.3."""


@dataclass(frozen=True, eq=False, slots=True)
class Hit:
    """Consecutive steps in which a body was hit."""

    first_step: int
    last_step: int
    start_s: float  # when the first step began
    end_s: float  # when the last step ended
    impulse_ns: FloatArray  # (3,), on the body over all of them
    raw_peak_force_n: float  # largest impulse of one step by the step: it grows as the step shrinks
    raw_step_s: float  # that step

    @property
    def impulse_magnitude_ns(self) -> float:
        """Magnitude of the impulse."""
        return float(length(self.impulse_ns))


def hits(impulses_ns: FloatArray, steps_s: FloatArray, start_s: float = 0.0, resting_force_n: float = 0.0) -> list[Hit]:
    """Hits of a body, in order of time, from its contact impulses (k, 3) in steps (k,): sub-steps or frames.

    A step belongs to a hit when its force is above `resting_force_n`. With 0 every contact does, and a body that comes
    to rest is being hit for ever; a few times its weight separates the two. Steps in which no time passes, or whose
    impulse is nan, belong to no hit.
    """
    impulses_ns, steps_s = np.asarray(impulses_ns, dtype=float), np.asarray(steps_s, dtype=float)
    magnitudes = length(impulses_ns)
    ends_s = start_s + np.cumsum(steps_s)
    hit = (magnitudes > resting_force_n * steps_s) & (steps_s > 0.0)
    changes = np.flatnonzero(np.diff(hit, prepend=False, append=False))
    of_body = []
    for first, after in changes.reshape(-1, 2):
        rows = slice(first, after)
        raw_forces = magnitudes[rows] / steps_s[rows]
        peak = raw_forces.argmax()
        of_body.append(
            Hit(
                first_step=int(first),
                last_step=int(after - 1),
                start_s=float(ends_s[first] - steps_s[first]),
                end_s=float(ends_s[after - 1]),
                impulse_ns=impulses_ns[rows].sum(axis=0),
                raw_peak_force_n=float(raw_forces[peak]),
                raw_step_s=float(steps_s[rows][peak]),
            )
        )
    return of_body


@dataclass(frozen=True, slots=True)
class Contact:
    """Two bodies that meet at a point, as Hertz's theory sees them: reduced to one mass, one radius and one modulus."""

    mass_kg: float  # 1/m = 1/m₁ + 1/m₂
    radius_m: float  # 1/R = 1/R₁ + 1/R₂
    modulus_pa: float  # 1/E* = (1 - ν₁²)/E₁ + (1 - ν₂²)/E₂

    @classmethod
    def between(
        cls,
        first: Elasticity,
        second: Elasticity,
        first_mass_kg: float,
        first_radius_m: float,
        second_mass_kg: float = math.inf,
        second_radius_m: float = math.inf,
    ) -> Contact:
        """A sphere with a half-space that does not move, or with another sphere where mass and radius are given.

        Johnson, equations 4.3, 4.5 and 11.20.
        """
        return cls(
            mass_kg=1.0 / (1.0 / first_mass_kg + 1.0 / second_mass_kg),
            radius_m=1.0 / (1.0 / first_radius_m + 1.0 / second_radius_m),
            modulus_pa=1.0 / (_compliance(first) + _compliance(second)),
        )


def _compliance(elasticity: Elasticity) -> float:
    """(1 - ν²)/E of a body, 1/Pa."""
    return (1.0 - elasticity.poisson_ratio * elasticity.poisson_ratio) / elasticity.young_modulus_pa


def hertz_compression(contact: Contact, speed_m_s: float) -> float:
    """Largest approach of two elastic bodies that meet at a speed, m: (15 m v² / (16 √R E*))^(2/5), Johnson, 11.23."""
    energy = contact.mass_kg * speed_m_s * speed_m_s
    return float(power(15.0 * energy / (16.0 * math.sqrt(contact.radius_m) * contact.modulus_pa), 0.4))


def hertz_contact_time(contact: Contact, speed_m_s: float) -> float:
    """Time for which two elastic bodies that meet at a speed above 0 touch, s: 2.87 (m² / (R E*² v))^(1/5).

    A body that also yields or crushes touches for longer: this is the least time, and the force from it the largest.
    Johnson, equation 11.24; the number is 2.868, here not rounded.
    """
    return _HERTZ_TIME * hertz_compression(contact, speed_m_s) / speed_m_s


def hertz_peak_force(contact: Contact, speed_m_s: float) -> float:
    """Largest force between two elastic bodies that meet at a speed, N: 4/3 E* √R δ^(3/2) at the largest compression δ.

    It holds for a hit that is elastic throughout, which for mild steel ends at some millimetres a second (Johnson,
    section 11.5; the force by equations 4.23 and 11.23). In any other, steel yields or concrete crushes at a lower
    force, and this is an upper bound. The theory also takes the bodies to be much larger than the contact, and not to
    bend: good for a pier or an abutment, an upper bound for a slab.
    """
    compression = hertz_compression(contact, speed_m_s)
    return 4.0 / 3.0 * contact.modulus_pa * math.sqrt(contact.radius_m) * compression * math.sqrt(compression)


def half_sine_peak_force(impulse_ns: float, contact_time_s: float) -> float:
    """Largest force of an impulse that comes and goes as half a sine wave, N: π J / (2 t).

    With the whole impulse of an elastic hit, 2 m v, and Hertz's contact time it is 0.854 of Hertz's own peak force: his
    pulse is a little more pointed than a sine (W. Goldsmith, 1960, Impact, Edward Arnold, chapter 4).
    """
    return math.pi * impulse_ns / (2.0 * contact_time_s)


@dataclass(frozen=True, slots=True)
class ImpactEstimate:
    """Forces of a hit that do not depend on the step."""

    contact_time_s: float
    half_sine_peak_force_n: float  # from the recorded impulse and the contact time
    hertz_peak_force_n: float  # of an elastic hit at the same speed: an upper bound


def estimate(
    impulse_ns: float, speed_m_s: float, contact: Contact, contact_time_s: float | None = None
) -> ImpactEstimate:
    """Estimate the forces of a hit, from its impulse and the speed (above 0) at which the bodies met.

    `contact_time_s` is a measured one; without it, Hertz's.
    """
    time_s = hertz_contact_time(contact, speed_m_s) if contact_time_s is None else contact_time_s
    return ImpactEstimate(
        contact_time_s=time_s,
        half_sine_peak_force_n=half_sine_peak_force(impulse_ns, time_s),
        hertz_peak_force_n=hertz_peak_force(contact, speed_m_s),
    )
