# SPDX-License-Identifier: GPL-3.0-or-later
"""Entry points of the core refuse wrong arrays in words, and read and write nothing beyond right ones."""

import sys
import time

import build_core
import pytest
from support.processes import run_program
from support.sanitized import sanitized_core


def fuzz(seconds, *library, **environment):
    """Try random cases with another seed each time: that of a fault is printed last."""
    done = run_program("fuzz_core", seconds, time.time_ns() % 10**9, *library, **environment)
    assert done.returncode == 0, (done.stdout[-200:], done.stderr[-3000:])


@pytest.mark.slow
def test_random_arrays_are_used_or_refused():
    fuzz(10)


@pytest.mark.long
@pytest.mark.skipif(build_core.own_compiler() is None, reason="this machine has no C compiler")
@pytest.mark.skipif(sys.platform != "linux", reason="only here are sanitizers preloaded")
def test_sanitizers_find_nothing_in_random_calls(tmp_path):
    fuzz(60, tmp_path, **sanitized_core(tmp_path))
