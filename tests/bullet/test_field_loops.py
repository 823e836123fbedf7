# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiled copies of fields in memory, and what is written, are those of numpy."""

import numpy as np
import pytest

from bridge_demolition_addon.bullet import body_motion, memory
from bridge_demolition_addon.bullet.memory import BYTES, DOUBLES, INTEGERS, POINTERS, Fields, field_loops

STRUCTURES, SIZE = 50, 96


@pytest.fixture
def block():
    """Memory with structures of 96 bytes in it, and their addresses in another order."""
    rng = np.random.default_rng(3)
    content = rng.normal(size=STRUCTURES * SIZE // 8)
    return content, content.ctypes.data + SIZE * rng.permutation(STRUCTURES).astype(np.uint64)


@pytest.fixture
def without_numba(monkeypatch):
    def leave_out():
        monkeypatch.setattr(memory, "field_loops", lambda: None)

    return leave_out


@pytest.mark.parametrize(
    "values", [DOUBLES, INTEGERS, BYTES, POINTERS], ids=["doubles", "integers", "bytes", "pointers"]
)
def test_copies_are_those_of_numpy(block, without_numba, values):
    content, addresses = block
    fields = Fields(addresses, [0, 8, 40, 88], values)
    compiled = fields.copy()
    without_numba()
    plain = fields.copy()
    assert compiled.dtype == plain.dtype and compiled.shape == plain.shape == (4, STRUCTURES)
    np.testing.assert_array_equal(compiled, plain)
    assert content.any()


def test_what_is_written_is_written_by_numpy_too(block, without_numba):
    content, addresses = block
    before, written = content.copy(), np.random.default_rng(4).normal(size=(3, STRUCTURES - 5))
    DOUBLES.write_fields(addresses[5:], np.array([16, 0, 80]), written)
    compiled, content[:] = content.copy(), before
    without_numba()
    DOUBLES.write_fields(addresses[5:], np.array([16, 0, 80]), written)
    np.testing.assert_array_equal(compiled, content)
    assert (content != before).sum() == written.size


@pytest.mark.parametrize("number", [-1e-3, np.nan, np.inf], ids=["negative", "none", "endless"])
def test_wrong_inertias_are_found_either_way(number):
    tensors = np.repeat(np.diag([1.0, 2.0, 0.0])[..., None], 4, axis=-1)
    ways = body_motion.are_inertias, lambda of: field_loops().are_inertias(of, body_motion.SYMMETRIC)
    assert all(way(tensors) for way in ways)
    for place in ((0, 0), (0, 1)):
        wrong = tensors.copy()
        wrong[(*place, 2)] = number
        with np.errstate(invalid="ignore"):  # endless less endless
            assert not any(way(wrong) for way in ways)
