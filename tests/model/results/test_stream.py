# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames that go to the disk as they come: what is in memory is what is in the files, whatever becomes of the run."""

import sys
from dataclasses import replace

import numpy as np
import pytest
from support.run_folders import flying_shards, stream_run
from support.sample_results import hanging_chain, with_contacts, without_connections

from bridge_demolition_addon.errors import OutputError
from bridge_demolition_addon.model.results.arrays import (
    BALLS_FILE,
    FRAMES_FILE,
    INVENTORY_FILE,
    RESULTS_FILE,
    load_results,
    result_digest,
    results_in,
)
from bridge_demolition_addon.model.results.frames import BallHistory, ContactHistory
from bridge_demolition_addon.model.results.stream import FrameStream

NEVER_FALLS_SHORT = 1e-6
"""Of single precision, which rounds by up to 6e-8."""


RUNS = pytest.mark.parametrize(
    "run",
    [
        hanging_chain(),
        without_connections(hanging_chain()),
        flying_shards(),
        replace(hanging_chain(), balls=BallHistory.unknown()),
        with_contacts(hanging_chain()),
    ],
    ids=["chain", "loose", "flying", "no ball", "contacts"],
)


@RUNS
def test_what_is_in_memory_is_what_is_in_the_files(tmp_path, run):
    stream = stream_run(tmp_path, run)
    results = stream.results()
    left = load_results(tmp_path)
    results.save(tmp_path / RESULTS_FILE)
    kept = load_results(tmp_path / RESULTS_FILE)
    assert result_digest(results) == result_digest(left) == result_digest(kept)
    for name, values in results.arrays().items():
        assert (
            np.asarray(values).dtype == np.asarray(kept.arrays()[name]).dtype == np.asarray(left.arrays()[name]).dtype
        )
    for row, frame in enumerate(stream):
        assert frame.number == kept.frames[row].number
        assert np.array_equal(frame.positions_m, kept.frames[row].positions_m)
        assert np.array_equal(frame.loads.stresses_pa, kept.frames[row].loads.stresses_pa, equal_nan=True)


@RUNS
def test_arrays_of_frames_are_kept_in_single_precision_and_all_else_as_it_is(tmp_path, run):
    kept = stream_run(tmp_path, run).results().arrays()
    assert kept.keys() == run.arrays().keys()
    for name, values in run.arrays().items():
        values, length = np.asarray(values), len(run.frames)
        if values.dtype.kind == "f" and values.ndim > 1 and values.shape[0] == length and not name.startswith("ball_"):
            assert kept[name].dtype == np.float32, name
            np.testing.assert_allclose(kept[name], values, rtol=NEVER_FALLS_SHORT, err_msg=name)
        else:
            np.testing.assert_array_equal(kept[name], values, err_msg=name)
            assert np.asarray(kept[name]).dtype.kind == values.dtype.kind


def test_results_take_at_most_half_of_what_they_took_in_double_precision(tmp_path):
    run = flying_shards(300, 30)
    stream_run(tmp_path, run).results().save(tmp_path / RESULTS_FILE)
    np.savez(tmp_path / "double.npz", **run.arrays())
    assert (tmp_path / RESULTS_FILE).stat().st_size <= 0.5 * (tmp_path / "double.npz").stat().st_size


@pytest.mark.parametrize("cut", [0, 1, 5000])
def test_what_is_left_of_a_run_that_was_killed_is_read(tmp_path, cut):
    stream_run(tmp_path, hanging_chain())
    path = tmp_path / FRAMES_FILE
    with path.open("rb+") as file:
        file.truncate(path.stat().st_size - min(cut, 888 * 2 + 3))
    left = load_results(tmp_path)
    frames = 5 - -(-min(cut, 888 * 2 + 3) // 888)
    assert len(left.frames) == frames and left.load_sampling == "every sub-step"
    # Ten sub-steps in each frame but the first.
    assert len(left.balls.times_s) == 10 * (frames - 1) and left.balls.bodies.tolist() == [3]
    assert left.balls.times_s[-1] == pytest.approx(left.frames.time_s[-1])


def test_contacts_of_a_run_that_was_killed_are_those_of_whole_frames(tmp_path):
    run = with_contacts(hanging_chain())
    stream_run(tmp_path, run)
    path = tmp_path / FRAMES_FILE
    with path.open("rb+") as file:
        file.truncate(path.stat().st_size - 1)
    left = load_results(tmp_path).contacts
    assert left.frames.tolist() == [3] and left.normal_impulses_ns.tolist() == [2.0]


def test_a_run_without_contacts_leaves_none_of_one_before_it(tmp_path):
    stream_run(tmp_path, with_contacts(hanging_chain()))
    stream = stream_run(tmp_path, hanging_chain())
    assert stream.results().contacts is None and load_results(tmp_path).contacts is None


def test_contacts_that_were_asked_for_and_of_which_there_were_none_are_kept_as_none(tmp_path):
    run = replace(hanging_chain(), contacts=ContactHistory.none())
    stream = stream_run(tmp_path, run)
    stream.results().save(tmp_path / RESULTS_FILE)
    for results in (stream.results(), load_results(tmp_path), load_results(tmp_path / FRAMES_FILE)):
        assert len(results.contacts) == 0 and results.contacts.bodies.shape == (0, 2)


def test_whole_results_come_before_what_was_left(tmp_path):
    stream = stream_run(tmp_path, hanging_chain(), 3)
    assert results_in(tmp_path).name == FRAMES_FILE
    hanging_chain().save(tmp_path / RESULTS_FILE)
    assert results_in(tmp_path).name == RESULTS_FILE and len(load_results(tmp_path).frames) == 5
    stream.remove()
    if sys.platform != "win32":  # where open files go with the stream
        assert [path.name for path in tmp_path.iterdir()] == [RESULTS_FILE]
    assert len(stream) == 3 and stream[-1].number == 4 and len(stream.results().frames) == 3
    stream.discard()
    assert [path.name for path in tmp_path.iterdir()] == [RESULTS_FILE]


@pytest.mark.skipif(sys.platform == "win32", reason="Windows replaces no open file")
def test_a_stream_in_the_place_of_another_leaves_its_results(tmp_path):
    before = stream_run(tmp_path, hanging_chain()).results()
    digest = result_digest(before)
    after = stream_run(tmp_path, replace(hanging_chain(), balls=BallHistory.unknown()), 2)
    assert result_digest(before) == digest
    assert len(load_results(tmp_path).frames) == 2 and not len(load_results(tmp_path).balls.times_s)
    after.remove()


@pytest.mark.parametrize("name", [RESULTS_FILE, FRAMES_FILE])
def test_results_that_are_read_outlive_their_files(tmp_path, name):
    stream = stream_run(tmp_path, flying_shards(300, 30))
    stream.results().save(tmp_path / RESULTS_FILE)
    digest = result_digest(stream.results())
    read = load_results(tmp_path / name)
    for path in tmp_path.iterdir():
        if path.name in (name, BALLS_FILE, INVENTORY_FILE):
            path.write_bytes(b"")  # which would end a process that has mapped them
    assert result_digest(read) == digest


@pytest.mark.parametrize("missing", [INVENTORY_FILE, FRAMES_FILE])
def test_frames_that_cannot_be_read_are_named(tmp_path, missing):
    stream_run(tmp_path, hanging_chain())
    (tmp_path / missing).unlink()
    with pytest.raises(OutputError, match="expected the results of a run"):
        load_results(tmp_path)


def test_a_run_that_was_killed_before_its_first_frame_has_no_results(tmp_path):
    FrameStream(tmp_path, "every sub-step", hanging_chain().inventory)
    with pytest.raises(OutputError, match=r"results\.npz: expected the results of a run"):
        load_results(tmp_path)


def test_a_part_of_the_frames_is_a_list(tmp_path):
    stream = stream_run(tmp_path, hanging_chain())
    assert [frame.number for frame in stream[1:]] == [3, 4, 5, 6]
    assert [frame.number for frame in stream[-1:0:-2]] == [6, 4] and stream[5:] == []


@pytest.mark.parametrize("row", [5, -6])
def test_there_are_no_frames_beyond_the_last(tmp_path, row):
    stream = stream_run(tmp_path, hanging_chain())
    with pytest.raises(IndexError):
        stream[row]
