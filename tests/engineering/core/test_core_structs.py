# SPDX-License-Identifier: GPL-3.0-or-later
"""Structs point to the arrays that they were given, and refuse those that the core would misread."""

import ctypes
from copy import deepcopy

import numpy as np
import pytest

from bridge_demolition_addon.engineering.core.structs import Count, Doubles, Indices, Struct, WrittenDoubles


class Example(Struct):
    _fields_ = (("count", Count), ("lengths_m", Doubles), ("bodies", Indices), ("forces_n", WrittenDoubles))


def test_a_field_leads_to_the_numbers_of_its_array():
    example = Example(count=4)
    example.point("lengths_m", np.array([1.0, 2.0, 3.0, 4.0]), 4)  # which nobody else keeps
    example.point("lengths_m", np.array([5.0, 6.0, 7.0, 8.0]), 4)
    assert ctypes.cast(example.lengths_m, ctypes.POINTER(ctypes.c_double))[:4] == [5.0, 6.0, 7.0, 8.0]
    assert example.count == 4


@pytest.mark.parametrize(
    ("name", "array", "size", "said"),
    [
        ("lengths_m", np.zeros(4, np.float32), 4, "lengths_m has numbers of type float32: expected float64"),
        ("lengths_m", np.zeros(4, ">f8"), 4, "lengths_m has numbers of type >f8: expected float64"),
        ("bodies", np.zeros(4, np.int32), 4, "bodies has numbers of type int32: expected int64"),
        ("lengths_m", np.zeros(3), 4, "lengths_m has 3 numbers: expected 4"),
        ("lengths_m", np.zeros(8)[::2], 4, "lengths_m is not one block in the order of C"),
        ("lengths_m", np.zeros((2, 2), order="F"), 4, "lengths_m is not one block in the order of C"),
        ("forces_n", np.broadcast_to(np.zeros(4), 4), 4, "forces_n cannot be written"),
    ],
)
def test_what_the_core_would_misread_is_named(name, array, size, said):
    with pytest.raises(ValueError, match=said):
        Example().point(name, array, size)


def test_an_array_that_is_kept_is_looked_at_again_for_another_size():
    example, lengths = Example(), np.zeros(4)
    example.point("lengths_m", lengths, 4)
    with pytest.raises(ValueError, match="expected 5"):
        example.point("lengths_m", lengths, 5)


def test_a_deep_copy_leads_to_numbers_of_its_own_also_to_those_of_whoever_is_copied_with_it():
    lengths = np.array([1.0, 2.0, 3.0, 4.0])
    example = Example(count=4)
    example.point("lengths_m", lengths, 4)
    copied, of_owner = deepcopy([example, lengths])
    of_owner[0] = 9.0
    assert ctypes.cast(copied.lengths_m, ctypes.POINTER(ctypes.c_double))[:4] == [9.0, 2.0, 3.0, 4.0]
    assert ctypes.cast(example.lengths_m, ctypes.POINTER(ctypes.c_double))[:4] == [1.0, 2.0, 3.0, 4.0]
    assert copied.count == 4
    copied.point("lengths_m", of_owner, 4)  # known already
