# SPDX-License-Identifier: GPL-3.0-or-later
"""Sub-steps worked out beside Bullet: the same to the bit, errors are told, and no thread stays behind."""

import itertools
import threading

import numpy as np
import pytest
from support.blocks import Blocks

from bridge_demolition_addon.errors import LayoutError
from bridge_demolition_addon.model.results.arrays import result_digest
from bridge_demolition_addon.simulation.blender_events import start_recording, stop_recording
from bridge_demolition_addon.simulation.recording import frame_sums
from bridge_demolition_addon.simulation.recording.frame_sums import THREAD_NAME, BackgroundWork, FrameSums
from bridge_demolition_addon.simulation.recording.meter import Meter
from bridge_demolition_addon.simulation.recording.recorder import Recording
from bridge_demolition_addon.simulation.recording.substeps import SubstepRecorder

FRAMES = 12


def falling_row():
    """Blocks that fall in a row on the ground, connected so that some break."""
    blocks = Blocks(frames_per_second=24, substeps_per_frame=10)
    ground = blocks.block((0, 0, -0.5), size_m=(40, 40, 1))
    bodies = [blocks.block((1.01 * x, 0, 0.6 + 0.3 * x), 100.0 + x) for x in range(6)]
    blocks.connect("FIXED", (0, 0, 0.1), ground, bodies[0], 1e4)
    for one, other in itertools.pairwise(bodies):
        position = (np.array(one.location) + np.array(other.location)) / 2
        blocks.connect("FIXED", tuple(position), one, other, 1e4)
    return blocks


@pytest.fixture
def row(blender):
    yield falling_row()
    stop_recording()


def threads():
    return [thread for thread in threading.enumerate() if thread.name.startswith(THREAD_NAME)]


def hand_over(monkeypatch, size):
    """Have every sub-step handed over that takes more than so many bytes; return the threads of the jobs."""
    monkeypatch.setattr(frame_sums, "BATCH_BYTES", size)
    monkeypatch.setattr(frame_sums, "WORTH_HANDING_OVER_BYTES", size)
    used, work_out = set(), FrameSums.work_out

    def noted(sums, substeps, *, work_counts):
        if substeps:
            used.add(threading.current_thread().name.startswith(THREAD_NAME))
        work_out(sums, substeps, work_counts=work_counts)

    monkeypatch.setattr(FrameSums, "work_out", noted)
    return used


def users_of(monkeypatch, class_, name):
    """Objects of a class on which a method is called from now on."""
    original, users = getattr(class_, name), []

    def noted(user, *arguments):
        users.append(user)
        return original(user, *arguments)

    monkeypatch.setattr(class_, name, noted)
    return users


def test_same_results_to_the_bit_beside_bullet_and_not(blender, tmp_path, monkeypatch):
    digests = []
    for size, in_the_thread in ((1e12, {False}), (0, {True}), (4000, {True})):
        with monkeypatch.context() as patch:
            used = hand_over(patch, size)
            blender.ops.wm.read_factory_settings(use_empty=True)
            results = falling_row().play(tmp_path, FRAMES)
        assert (~results.frames.intact[-1]).any()
        digests.append(result_digest(results))
        assert in_the_thread <= used
        assert (size > 0) or used == {True}
        assert threads() == []
    assert len(set(digests)) == 1


def test_error_beside_bullet_ends_the_recording_with_its_message(row, tmp_path, monkeypatch):
    hand_over(monkeypatch, 0)
    loads, thread = Meter.loads, []

    def broken(meter, readings):
        thread.append(threading.current_thread().name)
        if len(thread) == 25:
            raise LayoutError("a contact names a body that is not in the scene")
        return loads(meter, readings)

    monkeypatch.setattr(Meter, "loads", broken)
    recording = Recording(row.scene, tmp_path)
    start_recording(recording)
    for frame in range(1, FRAMES):
        row.scene.frame_set(frame)
    assert thread[24].startswith(THREAD_NAME)
    assert "names a body that is not in the scene" in str(recording.error)
    assert recording.recorded_frames == 3  # the first, and two of ten sub-steps
    assert threads() == []


def test_recording_closed_within_a_frame_leaves_no_thread(row, tmp_path, monkeypatch):
    """Closed while a job runs, which ends first; nothing reaches the frame that was never finished."""
    hand_over(monkeypatch, 0)
    recorders = users_of(monkeypatch, SubstepRecorder, "after_substep")
    backgrounds = users_of(monkeypatch, BackgroundWork, "begin")
    recording = Recording(row.scene, tmp_path)
    start_recording(recording)
    for frame in range(1, 6):
        row.scene.frame_set(frame)
    assert len(threads()) == 1
    goes_on, ended = threading.Event(), []

    def job():
        goes_on.wait(10.0)
        ended.append(True)

    backgrounds[-1].begin(job)
    threading.Timer(0.1, goes_on.set).start()
    stop_recording()
    assert ended == [True]
    assert threads() == []
    assert recording.recorded_frames == 4
    recorders[-1].after_substep(0.01)  # as from a world that could not be reached any more
    assert recorders[-1].error is not None


def test_jobs_come_one_after_the_other_and_errors_at_the_next():
    background, order = BackgroundWork(), []
    for number in range(20):
        background.begin(lambda number=number: order.append(number))
    background.finish()
    assert order == list(range(20))
    background.begin(lambda: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        background.begin(lambda: order.append(20))
    background.finish()
    assert len(order) == 20
    background.begin(lambda: 1 / 0)
    background.close()  # whoever closes does not ask any more
    assert threads() == []
