"""Standard gravity, units at the end of names, and masses and volumes in their units as text."""

import math
from decimal import ROUND_CEILING, ROUND_FLOOR, Decimal

from .unit_systems import Quantity

STANDARD_GRAVITY_M_S2 = 9.80665
"""Standard acceleration of free fall, exact; 1 kgf is the weight of 1 kg under it."""

SIGNIFICANT_DIGITS = 3
"""Of an amount, at least so many are shown."""

_KG_PER_T = 1000.0

_ENDINGS = {
    "m_kg13": "m/kg^(1/3)",
    "percent": "%",
    "kn_m2": "kN/m²",
    "n_mm2": "N/mm²",
    "kg_m3": "kg/m³",
    "rad_s": "rad/s",
    "mm_s": "mm/s",
    "m_s2": "m/s²",
    "m_s": "m/s",
    "newton": "N",
    "kgf": "kgf",
    "degrees": "°",
    "deg": "°",
    "knm": "kN·m",
    "kn": "kN",
    "mpa": "MPa",
    "kpa": "kPa",
    "db": "dB",
    "pa": "Pa",
    "ns": "N·s",
    "nm": "N·m",
    "mj": "MJ",
    "kj": "kJ",
    "hz": "Hz",
    "m2": "m²",
    "m3": "m³",
    "m4": "m⁴",
    "mm": "mm",
    "kg": "kg",
    "ms": "ms",
    "n": "N",
    "j": "J",
    "m": "m",
    "s": "s",
    "t": "t",
}
"""Units by the ends of names after a low line, longer ones before those that end like them."""


def name_and_unit(name: str) -> tuple[str, str]:
    """Return a name without its unit, and the unit; empty for texts and plain numbers."""
    for ending, unit in _ENDINGS.items():
        if name.lower().endswith(f"_{ending}"):
            return name[: -len(ending) - 1], unit
    return name, ""


def with_digits(value: float, decimals: int, significant: int = SIGNIFICANT_DIGITS) -> str:
    """Return a number with `decimals` decimals, or with more where it would have too few significant digits."""
    if value == 0.0 or not math.isfinite(value):
        return f"{value:.{decimals}f}"
    return f"{value:.{max(decimals, significant - 1 - math.floor(math.log10(abs(value))))}f}"


def kilonewtons(force_n: float) -> str:
    """Return a force in kN with three digits: impacts hang on the sub-step, and more digits would say nothing."""
    return with_digits(float(f"{force_n / 1e3:.{SIGNIFICANT_DIGITS}g}"), 0)


def rounded_up(value: float, step: str) -> str:
    """Return a number, rounded up to a decimal step such as 0.1; rounding errors of binary fractions do not count."""
    return str(Decimal(f"{value:.9f}").quantize(Decimal(step), ROUND_CEILING))


def rounded_down(value: float, step: str) -> str:
    """Return a number, rounded down to a decimal step; see `rounded_up`."""
    return str(Decimal(f"{value:.9f}").quantize(Decimal(step), ROUND_FLOOR))


def mass_text(mass_kg: float, decimals: int = 3, *, width: int = 0) -> Quantity:
    """Return a mass in t with `decimals` decimals, below 1 t in kg; the number takes up a width at least."""
    if 0.0 < abs(mass_kg) < _KG_PER_T:
        return Quantity(with_digits(mass_kg, 0), "kg", f">{width}")
    return Quantity(with_digits(mass_kg / _KG_PER_T, decimals), "t", f">{width}")


def volume_text(volume_m3: float, decimals: int = 3, *, width: int = 0) -> Quantity:
    """Return a volume in m³ with `decimals` decimals; the number takes up a width at least."""
    return Quantity(with_digits(volume_m3, decimals), "m³", f">{width}")


def kilograms(mass_kg: float) -> Quantity:
    """Return a mass in kg, large ones with blanks between thousands."""
    if abs(mass_kg) < _KG_PER_T:
        return Quantity(with_digits(mass_kg, 0), "kg")
    return Quantity(f"{mass_kg:,.0f}".replace(",", " "), "kg")
