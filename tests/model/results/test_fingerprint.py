# SPDX-License-Identifier: GPL-3.0-or-later
"""Digests are the same for the same bits, and differ for any other."""

import hashlib

import numpy as np
import pytest
from support.sample_results import changed, hanging_chain

from bridge_demolition_addon.model.results.arrays import digest, known_parts, result_digest


def test_a_digest_is_the_sha_256_of_names_shapes_and_bytes():
    values = np.array([1.5, -2.0])
    expected = hashlib.sha256(b"loads:(2,):16:" + values.tobytes() + b"names:(2,):3:a\0b").hexdigest()
    assert digest({"names": np.array(["a", "b"]), "loads": values}) == expected


def test_integers_of_any_width_and_order_of_names_make_no_difference():
    wide, narrow = np.arange(3, dtype=np.int64), np.arange(3, dtype=np.int32)
    assert digest({"a": wide, "b": 1.0}) == digest({"b": 1.0, "a": narrow})


@pytest.mark.parametrize(
    "other",
    [
        {"a": np.nextafter(1.0, 2.0), "b": "x"},
        {"a": 1.0, "b": "y"},
        {"c": 1.0, "b": "x"},
        {"a": [1.0], "b": "x"},
        {"a": 1.0, "b": "x", "c": ()},
    ],
)
def test_whatever_differs_is_seen(other):
    assert digest(other) != digest({"a": 1.0, "b": "x"})


def test_one_bit_of_one_vertex_or_threshold_is_another_model():
    inventory = hanging_chain().inventory
    vertices = inventory.vertices_m.copy()
    vertices[3, 1] = np.nextafter(vertices[3, 1], np.inf)
    other = changed(hanging_chain(), vertices_m=vertices).inventory
    digests = {
        digest(known_parts(inventory) | {"thresholds_ns": [5.0, 5.0]}),
        digest(known_parts(other) | {"thresholds_ns": [5.0, 5.0]}),
        digest(known_parts(inventory) | {"thresholds_ns": [5.0, np.nextafter(5.0, 6.0)]}),
    }
    assert len(digests) == 3
    assert digest(known_parts(inventory) | {"thresholds_ns": [5.0, 5.0]}) in digests


def test_results_differ_in_the_last_bit_of_a_load():
    results = hanging_chain()
    sums = results.frames.loads.body_sums_n.copy()
    sums[2, 1] = np.nextafter(sums[2, 1], np.inf)
    assert result_digest(results) == result_digest(hanging_chain())
    assert result_digest(results) != result_digest(changed(results, body_sums_n=sums))
