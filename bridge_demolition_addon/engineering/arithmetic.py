"""Exponentials, powers and angles that have the same bits on every processor and system.

Numpy and the C library choose another code by processor (with or without fused multiply-add, for example), and its last
bit differs. One bit in a load or in a vertex is enough for another collapse. These functions are made of additions,
multiplications, divisions and scaling by powers of two, which IEEE 754 rounds in one way.

All functions take numbers or arrays and calculate in float64. Their results are within about 1 unit in the last place
of the exact ones; of a `power` within 1e-15, relative.

Methods and coefficients of fdlibm 5.3, © 1993 Sun Microsystems, Inc., which freely grants to use, copy, modify and
distribute it. Exact products and sums: T. J. Dekker (1971), A floating-point technique for extending the available
precision, Numerische Mathematik 18, 224-242.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from .arrays import FloatArray

LARGEST_ANGLE = 2.0**20
"""Largest angle that `sine` and `cosine` take, rad."""


def coefficients(text: str) -> tuple[float, ...]:
    """Return the numbers of a text, such as the coefficients of a polynomial from the constant upwards."""
    return tuple(map(float, text.split()))


# Upper parts end in zeros, so that their products with small integers are exact.
_LN2_PARTS = 6.93147180369123816490e-01, 1.90821492927058770002e-10
_PER_LN2 = 1.44269504088896338700e00
_HALF_PI_PARTS = 1.57079632673412561417e00, 6.07710050630396597660e-11, 2.02226624879595063154e-21
PI_REST = 1.2246467991473531772e-16

_EXPONENTIAL = coefficients(
    "1.66666666666666019037e-01 -2.77777777770155933842e-03 6.61375632143793436117e-05 -1.65339022054652515390e-06 "
    "4.13813679705723846039e-08"
)
_LOGARITHM = coefficients(
    "6.666666666666735130e-01 3.999999999940941908e-01 2.857142874366239149e-01 2.222219843214978396e-01 "
    "1.818357216161805012e-01 1.531383769920937332e-01 1.479819860511658591e-01"
)
_SINE = coefficients(
    "-1.66666666666666324348e-01 8.33333333332248946124e-03 -1.98412698298579493134e-04 2.75573137070700676789e-06 "
    "-2.50507602534068634195e-08 1.58969099521155010221e-10"
)
_COSINE = coefficients(
    "4.16666666666666019037e-02 -1.38888888888741095749e-03 2.48015872894767294178e-05 -2.75573143513906633035e-07 "
    "2.08757232129817482790e-09 -1.13596475577881948265e-11"
)
ARCTANGENT = coefficients(
    "3.33333333333329318027e-01 -1.99999999998764832476e-01 1.42857142725034663711e-01 -1.11111104054623557880e-01 "
    "9.09088713343650656196e-02 -7.69187620504482999495e-02 6.66107313738753120669e-02 -5.83357013379057348645e-02 "
    "4.97687799461593236017e-02 -3.65315727442169155270e-02 1.62858201153657823623e-02"
)
ARCTANGENT_LIMITS = np.array([7.0, 11.0, 19.0, 39.0]) / 16.0
ARCTANGENT_STARTS = np.array(
    [
        (0.0, 0.0),
        (4.63647609000806093515e-01, 2.26987774529616870924e-17),
        (7.85398163397448278999e-01, 3.06161699786838301793e-17),
        (9.82793723247329054082e-01, 1.39033110312309984516e-17),
        (1.57079632679489655800e00, 6.12323399573676603587e-17),
    ]
)


def exponential(x: ArrayLike) -> FloatArray:
    """e to the power of x: infinity where that is too large for a number."""
    return _exponential(np.asarray(x, float), 0.0)[()]


def logarithm(x: ArrayLike) -> FloatArray:
    """Natural logarithm of x: minus infinity at 0, not a number below."""
    upper, lower = _logarithm(np.asarray(x, float))
    return (upper + lower)[()]


def power(base: ArrayLike, exponent: ArrayLike) -> FloatArray:
    """Base, not negative, to the power of the exponent."""
    base, exponent = np.asarray(base, float), np.asarray(exponent, float)
    upper, lower = _logarithm(base)
    finite = np.isfinite(upper)
    product, rest = _product(np.where(finite, upper, 0.0), exponent)
    with np.errstate(invalid="ignore"):
        endless = np.where(exponent == 0.0, 0.0, upper * exponent)
    return _exponential(np.where(finite, product, endless), rest + lower * exponent)[()]


def cube_root(x: ArrayLike) -> FloatArray:
    """The number whose cube is x."""
    x = np.asarray(x, float)
    size = np.abs(x)
    root = power(size, 1.0 / 3.0)
    # One step by Newton, because a third is not exact.
    with np.errstate(invalid="ignore"):
        error = (root - np.divide(size, root * root, out=np.zeros(x.shape), where=root > 0.0)) / 3.0
    signed: FloatArray = np.copysign(np.where(np.isfinite(size), root - error, root), x)[()]
    return signed


def sine(angle: ArrayLike) -> FloatArray:
    """Sine of an angle in rad."""
    return _sine_after(0, angle)


def cosine(angle: ArrayLike) -> FloatArray:
    """Cosine of an angle in rad."""
    return _sine_after(1, angle)


def arctangent(y: ArrayLike, x: ArrayLike = 1.0) -> FloatArray:
    """Angle of the point (x, y) from the x axis, -π to π."""
    y, x = np.broadcast_arrays(np.asarray(y, float), np.asarray(x, float))
    with np.errstate(divide="ignore", over="ignore"):
        slope = np.abs(np.divide(y, x, out=np.zeros(y.shape), where=y != 0.0))
        region = np.searchsorted(ARCTANGENT_LIMITS, slope, side="right")
        conditions = [region == 0, region == 1, region == 2, region == 3]
        finite = np.minimum(slope, 4.0)  # where the slope is larger, its reciprocal is taken
        shorter = np.select(
            conditions,
            [
                finite,
                (2.0 * finite - 1.0) / (2.0 + finite),
                (finite - 1.0) / (finite + 1.0),
                (finite - 1.5) / (1.0 + 1.5 * finite),
            ],
            -1.0 / slope,
        )
    upper, lower = np.moveaxis(ARCTANGENT_STARTS[region], -1, 0)
    square = shorter * shorter
    less = shorter * square * _polynomial(square, ARCTANGENT)
    angle = upper - ((less - lower) - shorter)
    left = np.signbit(x) & (slope < np.inf)
    signed: FloatArray = np.copysign(np.where(left, np.pi - (angle - PI_REST), angle), y)[()]
    return signed


def _exponential(x: FloatArray, rest: FloatArray | float) -> FloatArray:
    """e to the power of the sum of x and a rest that is small against it."""
    limited = np.clip(x, -750.0, 710.0)
    doublings = np.rint(limited * _PER_LN2)
    doublings = np.where(np.isnan(doublings), 0.0, doublings)
    upper, lower = limited - doublings * _LN2_PARTS[0], doublings * _LN2_PARTS[1] - rest
    short = upper - lower
    square = short * short
    bend = short - square * _polynomial(square, _EXPONENTIAL)
    with np.errstate(over="ignore", under="ignore"):
        scaled: FloatArray = np.ldexp(1.0 - ((lower - short * bend / (2.0 - bend)) - upper), doublings.astype(np.int32))
        return scaled


def _logarithm(x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Logarithm of x as a sum of two numbers, the second of them the rounding of the first."""
    usable = (x > 0.0) & (x < np.inf)
    mantissa, exponent = np.frexp(np.where(usable, x, 1.0))
    low = mantissa < 0.70710678118654752440
    part, twos = np.where(low, 2.0 * mantissa, mantissa) - 1.0, exponent - low.astype(float)
    ratio = part / (2.0 + part)
    square = ratio * ratio
    product, product_rest = _product(part, part)
    upper, rest = _sum(part, -0.5 * product)
    lower = rest + (ratio * (0.5 * product + square * _polynomial(square, _LOGARITHM)) - 0.5 * product_rest)
    upper, rest = _sum(twos * _LN2_PARTS[0], upper)
    upper, lower = _sum(upper, rest + (lower + twos * _LN2_PARTS[1]))
    outside = np.where(x == 0.0, -np.inf, np.where(x == np.inf, np.inf, np.nan))
    return np.where(usable, upper, outside), np.where(usable, lower, 0.0)


def _sine_after(quarters: int, angle: ArrayLike) -> FloatArray:
    """Sine of an angle plus a number of right angles."""
    angle = np.asarray(angle, float)
    if (np.abs(angle) > LARGEST_ANGLE).any():
        raise ValueError(f"An angle must lie within {LARGEST_ANGLE:.0f} rad; give one that is less by whole turns.")
    turns = np.rint(angle * 6.36619772367581382433e-01)
    first, second, third = _HALF_PI_PARTS
    upper, rest = _sum(angle - turns * first, -turns * second)
    short, rest = _sum(upper, rest - turns * third)
    square = short * short
    by_sine = short + (short * square * _polynomial(square, _SINE) + rest * (1.0 - 0.5 * square))
    fall = 1.0 - 0.5 * square
    by_cosine = fall + (((1.0 - fall) - 0.5 * square) + (square * square * _polynomial(square, _COSINE) - short * rest))
    quadrant = (turns + quarters) % 4.0
    value = np.where(quadrant % 2.0 == 1.0, by_cosine, by_sine)
    return np.where(quadrant >= 2.0, -value, value)[()]


def _polynomial(x: FloatArray, coefficients: Sequence[float]) -> FloatArray:
    """Value of a polynomial, by Horner; coefficients from the constant upwards."""
    value = np.full_like(x, coefficients[-1])
    for coefficient in coefficients[-2::-1]:
        value = coefficient + x * value
    return value


def _sum(one: FloatArray, other: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Sum, and the rest that its rounding left out."""
    total = one + other
    of_other = total - one
    return total, (one - (total - of_other)) + (other - of_other)


def _product(one: FloatArray, other: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Product, and the rest that its rounding left out."""
    product = one * other
    (one_high, one_low), (other_high, other_low) = _halves(one), _halves(other)
    rest = ((one_high * other_high - product) + one_high * other_low + one_low * other_high) + one_low * other_low
    return product, rest


def _halves(x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Upper and lower 26 bits of x."""
    scaled = 134217729.0 * x
    upper = scaled - (scaled - x)
    return upper, x - upper
