# SPDX-License-Identifier: GPL-3.0-or-later
"""Processes that tests start heed signals, and do not outlive a test that fails."""

import signal
import sys

import pytest
from support.processes import end_started, outcome, start


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signals")
@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_a_process_heeds_signals_that_this_one_ignores(name):
    before = signal.signal(getattr(signal, name), signal.SIG_IGN)
    try:
        program = f"import signal; print(signal.getsignal(signal.{name}) is signal.SIG_IGN)"
        assert outcome(start([sys.executable, "-c", program])) == (0, "False\n", "")
    finally:
        signal.signal(getattr(signal, name), before)


def test_what_is_left_running_is_ended():
    process = start([sys.executable, "-c", "import time; time.sleep(600)"])
    assert process.poll() is None
    end_started()
    assert process.poll() not in (None, 0)
