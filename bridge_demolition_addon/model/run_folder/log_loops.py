"""Lines of a log as a loop, which Numba compiles: import this only where it is installed.

Numbers have the text of Python's `%.9g`: the nine digits next to the exact value of a double. A number is multiplied by
a power of ten in twice its precision, so that the tenth digit and all after it are known to 21 digits. Where they are
that near the middle between two texts, or a number is not of ordinary size, no lines are given.

T. J. Dekker (1971), A floating-point technique for extending the available precision, Numerische Mathematik 18,
224-242.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np

from ...engineering.compilation import compiled

_LARGEST_EXPONENT = 290
"""Of ten, in numbers of ordinary size: their products with powers of ten neither overflow nor lose digits."""

_FIRST_POWER = 8 - _LARGEST_EXPONENT
_POWERS = [Fraction(10) ** exponent for exponent in range(_FIRST_POWER, _LARGEST_EXPONENT + 10)]
_HIGH = np.array([float(power) for power in _POWERS])
_LOW = np.array([float(power - Fraction(float(power))) for power in _POWERS])
"""Powers of ten as sums of two doubles."""

_SPLITTER = 2.0**27 + 1.0
_UNSURE = 1e-9
"""Distance from the middle between two texts below which the nearer one is not sought."""

_MOST_BYTES = 18
"""Of a number and its comma."""

_COMMA, _NEW_LINE, _ZERO, _POINT, _MINUS, _PLUS, _E, _N, _A = map(ord, ",\n0.-+ena")


@compiled
def lines(values: Any, start: Any, names: Any, ends: Any) -> Any:
    """Bytes of lines with values (n, k), each after the start and a name; none where a text is not known.

    The names lie one after the other, and end at `ends` (n,).
    """
    count, columns = values.shape
    text = np.empty(count * (len(start) + columns * _MOST_BYTES + 1) + len(names), np.uint8)
    digits, at, name = np.empty(9, np.uint8), 0, 0
    for row in range(count):
        for byte in start:
            text[at] = byte
            at += 1
        while name < ends[row]:
            text[at] = names[name]
            at, name = at + 1, name + 1
        for column in range(columns):
            text[at] = _COMMA
            at = _written(text, at + 1, values[row, column], digits)
            if at < 0:
                return text[:0]
        text[at] = _NEW_LINE
        at += 1
    return text[:at]


@compiled
def _written(text: Any, at: int, value: float, digits: Any) -> int:
    """Write a number, and return where it ends; -1 where its text is not known."""
    if np.isnan(value):
        text[at], text[at + 1], text[at + 2] = _N, _A, _N
        return at + 3
    if np.signbit(value):
        text[at] = _MINUS
        at += 1
    size = abs(value)
    if size == 0.0:
        text[at] = _ZERO
        return at + 1
    exponent, count = _rounded(size, digits)
    if not count:
        return -1
    if -4 <= exponent < 9:
        return _written_plainly(text, at, digits, count, exponent)
    at = _written_plainly(text, at, digits, count, 0)
    text[at], text[at + 1] = _E, _PLUS if exponent > 0 else _MINUS
    at, exponent = at + 2, abs(exponent)
    if exponent >= 100:
        text[at] = _ZERO + exponent // 100
        at += 1
    text[at], text[at + 1] = _ZERO + exponent // 10 % 10, _ZERO + exponent % 10
    return at + 2


@compiled
def _written_plainly(text: Any, at: int, digits: Any, count: int, exponent: int) -> int:
    """Write so many digits, of which the first counts for a power of ten, and return where they end."""
    if exponent < 0:
        text[at], text[at + 1] = _ZERO, _POINT
        at += 2
        for _ in range(-exponent - 1):
            text[at] = _ZERO
            at += 1
    for number in range(max(count, exponent + 1)):
        if number == exponent + 1 and exponent >= 0:
            text[at] = _POINT
            at += 1
        text[at] = digits[number]
        at += 1
    return at


@compiled
def _rounded(size: float, digits: Any) -> Any:
    """Find the nine digits of a positive number; return its exponent of ten, and how many digits end with no zero.

    There are none where the number is not of ordinary size, or lies in the middle.
    """
    if not 1e-290 < size < 1e290:
        return 0, 0
    exponent = int(np.floor(np.log10(size)))
    while True:
        whole, rest = _scaled(size, exponent)
        if whole < 1e8:
            exponent -= 1
        elif whole >= 1e9:
            exponent += 1
        else:
            break
    if abs(rest - 0.5) < _UNSURE:
        return 0, 0
    number, count = int(whole) + (rest > 0.5), 9
    if number == 1_000_000_000:
        number, exponent = 100_000_000, exponent + 1
    for place in range(8, -1, -1):
        digits[place] = _ZERO + number % 10
        number //= 10
    while digits[count - 1] == _ZERO:
        count -= 1
    return exponent, count


@compiled
def _scaled(size: float, exponent: int) -> Any:
    """Whole part and rest of a number times the power of ten that gives it nine digits."""
    power = 8 - exponent - _FIRST_POWER
    high, low = _product(size, _HIGH[power])
    low += size * _LOW[power]
    whole = np.floor(high)
    rest = (high - whole) + low
    if rest < 0.0:
        return whole - 1.0, rest + 1.0
    return (whole + 1.0, rest - 1.0) if rest >= 1.0 else (whole, rest)


@compiled
def _product(one: float, other: float) -> Any:
    """Product of two numbers, and what it is rounded by (Dekker 1971)."""
    product = one * other
    (first, second), (third, fourth) = _halves(one), _halves(other)
    return product, ((first * third - product) + first * fourth + second * third) + second * fourth


@compiled
def _halves(number: float) -> Any:
    """Two numbers with half of the digits each, whose sum is the number."""
    split = _SPLITTER * number
    upper = split - (split - number)
    return upper, number - upper
