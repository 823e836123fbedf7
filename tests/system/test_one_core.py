# SPDX-License-Identifier: GPL-3.0-or-later
"""What is loaded on one core counts one, as Blender does; afterwards the process has all that it had."""

import os
import subprocess
import sys
import threading

import pytest

from bridge_demolition_addon.system.processor import on_one_core
from bridge_demolition_addon.system.programs import program_command

pytestmark = pytest.mark.slow

COUNT_THREADS = """
import os, bpy
print(len(os.listdir("/proc/self/task")), len(os.sched_getaffinity(0)), flush=True)
os._exit(0)
"""
on_linux = pytest.mark.skipif(sys.platform != "linux", reason="only Linux holds a process to a core")


@on_linux
def test_the_cores_are_those_from_before_again_for_threads_of_the_block_too():
    allowed, asked = os.sched_getaffinity(0), threading.Event()
    thread = threading.Thread(target=asked.wait)
    with on_one_core():
        assert len(os.sched_getaffinity(0)) == 1
        thread.start()
        assert os.sched_getaffinity(thread.native_id) == os.sched_getaffinity(0)
    assert os.sched_getaffinity(0) == os.sched_getaffinity(thread.native_id) == allowed
    asked.set()
    thread.join()


@on_linux
def test_an_error_in_the_block_gives_the_cores_back():
    allowed = os.sched_getaffinity(0)
    with pytest.raises(ValueError), on_one_core():
        raise ValueError
    assert os.sched_getaffinity(0) == allowed


def test_nothing_changes_where_a_process_cannot_be_held(monkeypatch):
    monkeypatch.delattr(os, "sched_setaffinity", raising=False)
    with on_one_core():
        assert not hasattr(os, "sched_setaffinity")


@on_linux
@pytest.mark.skipif(os.cpu_count() == 1, reason="there is one core")
def test_blender_makes_fewer_threads_and_may_run_everywhere():
    loaded = "from bridge_demolition_addon.system.processor import load_on_one_core; load_on_one_core('bpy'); "
    threads, cores = zip(*(_counts(start + COUNT_THREADS) for start in ("", loaded)), strict=True)
    assert threads[1] < threads[0]
    assert cores[1] == cores[0]


def test_a_program_of_blender_is_started_with_one_thread():
    command = program_command("studies.run_program", "/a/blender", one_thread=True)
    assert command[command.index("--threads") + 1] == "1"
    assert "--threads" not in program_command("studies.run_program", "/a/blender")


def _counts(program):
    done = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True)
    return map(int, done.stdout.splitlines()[-1].split())  # Blender may print lines of its own before
