"""Recorded arrays: forces per body by statics, and files that come back as they were written."""

from dataclasses import fields

import numpy as np
import pytest
from sample_results import hanging_chain, without_connections

from bridge_demolition_addon.core.errors import OutputError
from bridge_demolition_addon.core.results import Results, load_results

G = 9.80665
# Some units in the last place of numbers around 5000.
ROUNDING_N = 1e-11


def test_resultants_of_bodies_at_rest_are_their_weights():
    resultants = hanging_chain().resultants()
    assert resultants.shape == (5, 4, 3)
    upper, lower = resultants[0, 1], resultants[0, 2]
    np.testing.assert_allclose([upper, lower], [[0, 0, 300 * G], [0, 0, 200 * G]], atol=ROUNDING_N)


def test_forces_cancel_over_all_bodies_in_every_frame():
    np.testing.assert_allclose(hanging_chain().resultants().sum(axis=1), 0.0, atol=ROUNDING_N)


def test_sums_of_magnitudes():
    sums = hanging_chain().magnitude_sums()
    assert sums.shape == (5, 4)
    np.testing.assert_allclose(sums[0], [500 * G, 700 * G, 200 * G, 0.0], atol=ROUNDING_N)
    # In frame 5 the lower connection pulls with its 200 kg and 1 kN across.
    assert sums[3, 2] == pytest.approx(((200 * G) ** 2 + 1000**2) ** 0.5)


def test_bodies_of_a_kind():
    results = hanging_chain()
    assert results.of_kind("shard").tolist() == [1, 2]
    assert results.of_kind("ball").tolist() == [3]
    assert results.of_kind("charge").tolist() == []


def test_without_connections_nothing_is_held():
    results = without_connections(hanging_chain())
    assert results.resultants().shape == (5, 4, 3)
    assert not results.resultants().any() and not results.magnitude_sums().any()


@pytest.mark.parametrize("results", [hanging_chain(), without_connections(hanging_chain())], ids=["chain", "loose"])
def test_files_come_back_as_they_were_written(tmp_path, results):
    path = tmp_path / "results.npz"
    results.save(path)
    again = load_results(path)
    for item in fields(Results):
        written, read = getattr(results, item.name), getattr(again, item.name)
        assert written.dtype == read.dtype and np.array_equal(written, read), item.name


def test_a_file_is_readable_without_us(tmp_path):
    hanging_chain().save(tmp_path / "results.npz")
    with np.load(tmp_path / "results.npz", allow_pickle=False) as stored:
        assert stored["masses_kg"].tolist() == [0, 300, 200, 1000]


def write_no_file(path):
    pass


def write_nothing(path):
    path.write_bytes(b"")


def write_text(path):
    path.write_text("frame,time_s\n")


def write_lone_array(path):
    with path.open("wb") as file:
        np.save(file, np.zeros(3))


def write_other_arrays(path):
    np.savez(path, frames=np.zeros(3))


def write_half(path):
    hanging_chain().save(path)
    path.write_bytes(path.read_bytes()[:2000])


def write_damaged(path):
    hanging_chain().save(path)
    content = path.read_bytes()
    middle = content.index(np.float64(500 * G).tobytes())
    path.write_bytes(content[:middle] + bytes(8) + content[middle + 8 :])


@pytest.mark.parametrize(
    "write", [write_nothing, write_text, write_lone_array, write_other_arrays, write_half, write_damaged, write_no_file]
)
def test_other_files_are_refused(tmp_path, write):
    path = tmp_path / "results.npz"
    write(path)
    with pytest.raises(OutputError, match=r"results\.npz: expected the results of a run"):
        load_results(path)
