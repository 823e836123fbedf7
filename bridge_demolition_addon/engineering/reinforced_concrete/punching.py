"""Punching of a slab under a round load, without links and without factors of safety."""

from __future__ import annotations

import math

_MEGA = 1e6
_LARGEST_RATIO = 0.02


def punching_stress_pa(depth_m: float, ratio: float, strength_pa: float) -> float:
    """Return the shear stress that a slab resists on the control perimeter: EN 1992-1-1:2004, equation 6.47.

    `ratio` is the mean of the bars both ways, √(ρ_x ρ_y). Without γ_c = 1.5 its factors are 0.18, and 0.0525 for the
    least stress, where the design values are 0.12 and 0.035 (equation 6.3N).
    """
    size, f_ck = min(1.0 + math.sqrt(0.2 / depth_m), 2.0), strength_pa / _MEGA
    by_bars = 0.18 * size * math.cbrt(100.0 * min(ratio, _LARGEST_RATIO) * f_ck)
    return _MEGA * max(by_bars, 0.0525 * math.sqrt(size**3 * f_ck))


def punching_n(depth_m: float, loaded_m: float, ratio: float, strength_pa: float) -> float:
    """Return the force that punches, on a circle of a diameter: control perimeter 2 d around it, 6.4.2 (1)."""
    return punching_stress_pa(depth_m, ratio, strength_pa) * math.pi * (loaded_m + 4.0 * depth_m) * depth_m
