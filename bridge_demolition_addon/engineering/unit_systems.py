"""Systems of units that people read, and conversion from SI units into US customary ones.

All factors follow from three that are exact: the international foot of 0.3048 m and pound of 0.45359237 kg (agreement
of 1959), and standard gravity, by which a pound-force is the weight of a pound (NIST SP 811, appendix B).
"""

from __future__ import annotations

from dataclasses import dataclass
from decimal import ROUND_DOWN, ROUND_HALF_EVEN, ROUND_UP, Decimal
from enum import StrEnum
from typing import Any, Self

FOOT_M = Decimal("0.3048")
INCH_M = FOOT_M / 12
YARD_M = FOOT_M * 3
MILE_M = FOOT_M * 5280
POUND_KG = Decimal("0.45359237")
SHORT_TON_KG = POUND_KG * 2000
GRAVITY_M_S2 = Decimal("9.80665")
POUND_FORCE_N = POUND_KG * GRAVITY_M_S2
KIP_N = POUND_FORCE_N * 1000
PSI_PA = POUND_FORCE_N / INCH_M**2

LEAST_DIGITS = 3
"""Significant digits that a converted number has at least, as what a user chose, such as 5 m, is often exact."""

_COARSER = Decimal("1.4")
"""How much coarser than the last digit of the metric number that of the converted one may be: so 1 kJ is 1 kip·ft."""


class UnitSystem(StrEnum):
    """System of the units that people read."""

    METRIC = "metric"
    """SI units, with tonnes, millimetres and degrees, as European engineers use them."""

    IMPERIAL = "imperial"
    """US customary units, as bridge engineers in the United States use them: ft, in, lb, kip, ksi, psi."""


class Rounding(StrEnum):
    """To which side a converted number is rounded."""

    NEAREST = ROUND_HALF_EVEN

    UP = ROUND_UP
    """Away from zero, so that a distance to keep is never less."""

    DOWN = ROUND_DOWN
    """Towards zero."""


NEAREST, UP, DOWN = Rounding


class Unit(str):
    """The symbol of a unit, such as in the heading of a column, and the side that numbers in it are rounded to."""

    __slots__ = ("rounding",)

    rounding: Rounding

    def __new__(cls, symbol: str, rounding: Rounding = NEAREST) -> Self:
        """Make it of its metric symbol."""
        unit = super().__new__(cls, symbol)
        unit.rounding = rounding
        return unit

    def __str__(self) -> str:
        """Return itself."""
        return self

    def __getnewargs__(self) -> tuple[Any, ...]:
        """Return what it is made of, for copies."""
        return str.__str__(self), self.rounding


class Quantity(str):
    """A number with its unit, and the side that it is rounded to in other units.

    `form` is Python's format of the number. Where several numbers share a unit that stands behind the last of them, the
    others are not `shown` with it.
    """

    __slots__ = ("number", "rounding", "shown", "unit")

    number: str
    unit: str
    rounding: Rounding
    shown: bool

    def __new__(
        cls, value: float | str, unit: str, form: str = "", rounding: Rounding = NEAREST, *, shown: bool = True
    ) -> Self:
        """Write a number in a metric unit."""
        number = format(value, form)
        quantity = super().__new__(cls, f"{number} {unit}" if shown else number)
        quantity.number, quantity.unit, quantity.rounding, quantity.shown = number, unit, rounding, shown
        return quantity

    def __str__(self) -> str:
        """Return itself."""
        return self

    def __getnewargs_ex__(self) -> tuple[tuple[Any, ...], dict[str, Any]]:
        """Return what it is made of, for copies."""
        return (self.number, self.unit, "", self.rounding), {"shown": self.shown}


def distance_to_keep(value: float | str, form: str = "") -> Quantity:
    """Return a distance in m that people keep or debris may reach: it is never rounded down."""
    return Quantity(value, "m", form, UP)


@dataclass(frozen=True, slots=True)
class Conversion:
    """From a metric unit into a US customary one.

    Attributes
    ----------
    unit
        Symbol of the US customary unit.
    metric_size, own_size
        Size of the metric unit and of this one, both in the same SI unit.
    """

    unit: str
    metric_size: Decimal
    own_size: Decimal

    @property
    def factor(self) -> float:
        """How many US customary units are one metric unit."""
        return float(self.metric_size / self.own_size)

    def converted(self, value: float) -> float:
        """Return a number in the metric unit as one in this unit, with all digits."""
        return float(Decimal(value) * self.metric_size / self.own_size)

    def number(self, text: str, rounding: Rounding = Rounding.NEAREST) -> str:
        """Return a written number in the metric unit as one in this unit, about as fine as it was, and no finer.

        Parameters
        ----------
        text
            The number as `Decimal` reads it, such as ``12.40`` or ``-3e-05``.
        rounding
            The side that it is rounded to.
        """
        metric = Decimal(text)
        if metric.is_zero():
            return text
        value = metric * self.metric_size / self.own_size
        least = LEAST_DIGITS if rounding is Rounding.NEAREST else LEAST_DIGITS + 1
        last = min(self.last_digit(text), value.adjusted() + 1 - least)
        rounded = value.quantize(Decimal(1).scaleb(min(last, 0)), rounding.value)
        return f"{rounded:e}" if "e" in text.lower() else f"{rounded:f}"

    def last_digit(self, text: str) -> int:
        """Return the power of ten of the last digit that a number has in this unit, by the metric number's."""
        exponent = Decimal(text).as_tuple().exponent
        assert isinstance(exponent, int)  # no infinity is written
        return (Decimal(1).scaleb(exponent) * self.metric_size / self.own_size * _COARSER).adjusted()


_ONE, _THOUSAND, _MILLION = Decimal(1), Decimal(1000), Decimal(1_000_000)
_THOUSANDTH, _HUNDREDTH = Decimal("0.001"), Decimal("0.01")
_CUBE_ROOT_OF_POUND = POUND_KG ** (_ONE / 3)

IMPERIAL = {
    "mm": Conversion("in", _THOUSANDTH, INCH_M),
    "cm": Conversion("in", _HUNDREDTH, INCH_M),
    "m": Conversion("ft", _ONE, FOOT_M),
    "km": Conversion("mi", _THOUSAND, MILE_M),
    "mm²": Conversion("in²", _THOUSANDTH**2, INCH_M**2),
    "mm²/m": Conversion("in²/ft", _THOUSANDTH**2, INCH_M**2 / FOOT_M),
    "cm²": Conversion("in²", _HUNDREDTH**2, INCH_M**2),
    "m²": Conversion("ft²", _ONE, FOOT_M**2),
    "m³": Conversion("yd³", _ONE, YARD_M**3),
    "m⁴": Conversion("ft⁴", _ONE, FOOT_M**4),
    "mm/s": Conversion("in/s", _THOUSANDTH, INCH_M),
    "cm/s": Conversion("in/s", _HUNDREDTH, INCH_M),
    "m/s": Conversion("ft/s", _ONE, FOOT_M),
    "km/h": Conversion("mph", _THOUSAND, MILE_M),
    "m/s²": Conversion("ft/s²", _ONE, FOOT_M),
    "g": Conversion("lb", _THOUSANDTH, POUND_KG),
    "kg": Conversion("lb", _ONE, POUND_KG),
    "t": Conversion("short tons", _THOUSAND, SHORT_TON_KG),
    "g/t": Conversion("lb/short ton", _THOUSANDTH / _THOUSAND, POUND_KG / SHORT_TON_KG),
    "kg/m": Conversion("lb/ft", _ONE, POUND_KG / FOOT_M),
    "kg/m³": Conversion("lb/yd³", _ONE, POUND_KG / YARD_M**3),
    "N": Conversion("lbf", _ONE, POUND_FORCE_N),
    "kgf": Conversion("lbf", GRAVITY_M_S2, POUND_FORCE_N),
    "kN": Conversion("kip", _THOUSAND, KIP_N),
    "MN": Conversion("kip", _MILLION, KIP_N),
    "N/m": Conversion("lbf/ft", _ONE, POUND_FORCE_N / FOOT_M),
    "kN/m": Conversion("kip/ft", _THOUSAND, KIP_N / FOOT_M),
    "N·m": Conversion("lbf·ft", _ONE, POUND_FORCE_N * FOOT_M),
    "kN·m": Conversion("kip·ft", _THOUSAND, KIP_N * FOOT_M),
    "kNm": Conversion("kip·ft", _THOUSAND, KIP_N * FOOT_M),
    "Pa": Conversion("psi", _ONE, PSI_PA),
    "kPa": Conversion("psi", _THOUSAND, PSI_PA),
    "MPa": Conversion("ksi", _MILLION, PSI_PA * 1000),
    "GPa": Conversion("ksi", _MILLION * 1000, PSI_PA * 1000),
    "N/mm²": Conversion("ksi", _MILLION, PSI_PA * 1000),
    "kN/m²": Conversion("kip/ft²", _THOUSAND, KIP_N / FOOT_M**2),
    "kN/m³": Conversion("lbf/ft³", _THOUSAND, POUND_FORCE_N / FOOT_M**3),
    "N·s": Conversion("lbf·s", _ONE, POUND_FORCE_N),
    "kN·s": Conversion("kip·s", _THOUSAND, KIP_N),
    "Pa·s": Conversion("psi·s", _ONE, PSI_PA),
    "Pa·ms": Conversion("psi·ms", _ONE, PSI_PA),
    "kPa·ms": Conversion("psi·ms", _THOUSAND, PSI_PA),
    "J": Conversion("ft·lbf", _ONE, POUND_FORCE_N * FOOT_M),
    "kJ": Conversion("ft·kip", _THOUSAND, KIP_N * FOOT_M),
    "MJ": Conversion("ft·kip", _MILLION, KIP_N * FOOT_M),
    "m/kg^(1/3)": Conversion("ft/lb^(1/3)", _ONE, FOOT_M / _CUBE_ROOT_OF_POUND),
}
"""US customary units by the symbols of the metric ones that people read; what is not here is the same in both."""
