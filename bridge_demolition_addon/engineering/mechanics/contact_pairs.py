"""Friction and restitution of pairs of surfaces, and the values of single bodies that Bullet multiplies to have them.

A contact in Bullet has the product of the values of its two bodies (`btManifoldResult`, `calculateCombinedFriction` and
`calculateCombinedRestitution`). Shards touch shards as well as all other bodies. So their value is the root of the
value of a pair of shards, and each other body has what makes its pair with a shard.
"""

from __future__ import annotations

import math

LARGEST_FRICTION = 10.0
"""Largest friction of a contact in Bullet, which takes this where the product is larger."""

CONTACT_DISTANCE = 0.02
"""Distance from which on Bullet has a contact of two bodies, as a part of half the diagonal of the smaller one's
bounding box (`btCollisionShape::getContactBreakingThreshold`)."""


def shard_value(of_two_shards: float) -> float:
    """Return the value of a shard from the value of a contact of two shards."""
    return math.sqrt(of_two_shards)


def other_value(with_shard: float, of_two_shards: float) -> float:
    """Return the value of another body from the values of its contact with a shard and of two shards; 0 by 0 is 0.

    Raises
    ------
    ZeroDivisionError
        Two shards have 0, and the body has to have more with a shard: no value makes that.
    """
    return with_shard / shard_value(of_two_shards) if with_shard else 0.0


def contact_friction(first: float, second: float) -> float:
    """Return the friction of the contact of two bodies by their own values."""
    return min(first * second, LARGEST_FRICTION)


def contact_restitution(first: float, second: float) -> float:
    """Return the restitution of the contact of two bodies by their own values."""
    return first * second


def slowest_bounce_m_s(restitution: float, half_diagonal_m: float, substep_s: float) -> float:
    """Return the speed of approach below which two round bodies do not part again in Bullet, m/s.

    Bullet slows down bodies in contact to the velocity gap / sub-step - e v, and parts them where that is below 0. One
    that is found at a distance therefore only ends the approach. Bodies part where they come, within one sub-step, from
    farther than `CONTACT_DISTANCE` to nearer than e v Δt: then (1 + e) v Δt is longer than that distance.
    Flat faces meet in corners that Bullet finds one after the other, and may part below it.
    """
    return CONTACT_DISTANCE * half_diagonal_m / ((1.0 + restitution) * substep_s)
