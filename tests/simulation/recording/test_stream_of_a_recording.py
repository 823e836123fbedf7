# SPDX-License-Identifier: GPL-3.0-or-later
"""A recording keeps its frames on the disk: memory does not grow, and what is in memory is what is in the files."""

import numpy as np
import pytest
from support.falling_pair import FRAMES, FallingPair, play
from support.processes import run_program

from bridge_demolition_addon.model.results.arrays import FRAMES_FILE, load_results, result_digest
from bridge_demolition_addon.simulation.blender_events import stop_recording

MANY = 150


@pytest.mark.long
def test_memory_does_not_grow_with_the_number_of_frames(tmp_path):
    done = run_program("memory_of_a_recording", tmp_path, MANY)
    assert done.returncode == 0, done.stderr
    grown, frame_bytes = map(int, done.stdout.split()[-2:])
    assert frame_bytes > 10_000
    # Measured: 35 kB with Python 3.11 and less than 26 kB with 3.13, of 3.8 MB that 300 frames take in memory.
    # Python's own tables and Blender's wrappers come and go by some kB, so a twentieth is allowed.
    assert grown < 0.05 * MANY * frame_bytes


@pytest.fixture
def pair(blender):
    return FallingPair()


def test_what_is_in_memory_is_what_is_in_the_file(pair, tmp_path):
    recording = pair.record(tmp_path)
    stop_recording()
    digest = result_digest(recording.results())
    assert result_digest(load_results(tmp_path)) == digest
    recording.results().save(tmp_path / "results.npz")
    recording.remove_stream()
    assert not (tmp_path / FRAMES_FILE).exists()
    kept = load_results(tmp_path)
    assert result_digest(kept) == result_digest(recording.results()) == digest
    for row, frame in enumerate(recording.frames):
        assert np.array_equal(frame.positions_m, kept.frames[row].positions_m)


def test_frames_are_read_while_they_are_recorded(pair, tmp_path):
    recording = pair.record(tmp_path)
    last = recording.frames[-1]
    assert load_results(tmp_path).frames.number[-1] == last.number == recording.last_frame == FRAMES + 1
    play(pair.scene, FRAMES + 2, FRAMES + 4)
    assert recording.recorded_frames == FRAMES + 3 and recording.frames[-4].time_s == last.time_s
    stop_recording()


def test_a_simulation_that_starts_again_leaves_what_was_read_of_the_one_before(pair, tmp_path):
    recording = pair.record(tmp_path)
    before = recording.results()
    digest, frames = result_digest(before), recording.frames
    pair.scene.rigidbody_world.substeps_per_frame = 7
    play(pair.scene, 1, 4)
    stop_recording()
    assert recording.frames is not frames
    assert recording.results().frames.number.tolist() == [2, 3, 4]
    assert result_digest(before) == digest


def test_a_recording_that_is_forgotten_has_nothing_and_leaves_no_file(pair, tmp_path):
    recording = pair.record(tmp_path)
    stop_recording()
    recording.forget()
    assert recording.recorded_frames == 0 and recording.last_frame is None
    assert not (tmp_path / FRAMES_FILE).exists()
