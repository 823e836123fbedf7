# SPDX-License-Identifier: GPL-3.0-or-later
import hashlib
import math

import numpy as np
import pytest

from bridge_demolition_addon.engineering.arithmetic import (
    LARGEST_ANGLE,
    arctangent,
    cosine,
    cube_root,
    exponential,
    logarithm,
    power,
    sine,
)

RANDOM = np.random.default_rng(1)
AROUND_ONE = RANDOM.uniform(-1.0, 1.0, 2000)
SIZES = np.concatenate([RANDOM.uniform(0.5, 2.0, 2000), np.ldexp(RANDOM.random(2000) + 0.5, np.arange(2000) - 1000)])
ANGLES = np.concatenate([AROUND_ONE * 10.0, AROUND_ONE * LARGEST_ANGLE, np.arange(-500, 500) * np.pi / 2])


def check(results: np.ndarray, exact: list[float], units: float = 1.0) -> None:
    assert (np.abs(results - exact) <= units * np.spacing(np.abs(exact))).all()


def test_exponentials_are_those_of_the_c_library():
    x = np.concatenate([AROUND_ONE, AROUND_ONE * 700.0])
    check(exponential(x), [math.exp(number) for number in x])


def test_logarithms_are_those_of_the_c_library():
    check(logarithm(SIZES), [math.log(size) for size in SIZES])


@pytest.mark.parametrize("exponent", [1.0 / 3.0, -0.5, 2.0, 3.0, 6.0, 10.0])
def test_powers_are_those_of_the_c_library(exponent):
    base = RANDOM.uniform(0.01, 100.0, 2000)
    check(power(base, exponent), [math.pow(number, exponent) for number in base], 2.0)


def test_cube_roots_are_exact_for_cubes():
    numbers = np.arange(-300.0, 300.0)
    assert np.array_equal(cube_root(numbers**3), numbers)
    assert cube_root(np.inf) == np.inf


@pytest.mark.parametrize(("function", "exact"), [(sine, math.sin), (cosine, math.cos)])
def test_sines_and_cosines_are_those_of_the_c_library(function, exact):
    check(function(ANGLES), [exact(angle) for angle in ANGLES])


def test_angles_of_which_too_little_is_known_are_refused():
    with pytest.raises(ValueError, match="within 1048576 rad"):
        sine([0.0, 2.0 * LARGEST_ANGLE])


def test_arctangents_are_those_of_the_c_library():
    y, x = RANDOM.uniform(-1.0, 1.0, (2, 4000)) * SIZES[:4000]
    check(arctangent(y, x), [math.atan2(*pair) for pair in zip(y, x, strict=True)], 2.0)


@pytest.mark.parametrize("y", [0.0, -0.0, 1.0, -1.0])
@pytest.mark.parametrize("x", [0.0, -0.0, 1.0, -1.0])
def test_arctangents_on_axes_keep_their_sign(y, x):
    assert str(float(arctangent(y, x))) == str(math.atan2(y, x))


def test_limits():
    assert exponential([-np.inf, -800.0, 800.0, np.inf]).tolist() == [0.0, 0.0, np.inf, np.inf]
    assert logarithm([0.0, 1.0, np.inf]).tolist() == [-np.inf, 0.0, np.inf]
    assert np.isnan(logarithm(-1.0)) and np.isnan(exponential(np.nan))
    assert power([0.0, 0.0, 0.0, np.inf], [0.0, 2.0, -1.0, -1.0]).tolist() == [1.0, 0.0, np.inf, 0.0]


def test_bits_are_the_same_on_every_machine():
    results = [
        exponential(AROUND_ONE * 700.0),
        logarithm(SIZES),
        power(SIZES[:2000], AROUND_ONE * 10.0),
        cube_root(SIZES),
        sine(ANGLES),
        cosine(ANGLES),
        arctangent(AROUND_ONE, SIZES[:2000]),
    ]
    digest = hashlib.sha256(b"".join(result.astype("<f8").tobytes() for result in results)).hexdigest()
    assert digest[:16] == "b46567c632a6c952"
