# SPDX-License-Identifier: GPL-3.0-or-later
"""Run a command on a screen of its own, that nobody sees: session.py SECONDS COMMAND...

Ends with the command's status, or with that of `timeout` where the command takes longer.
"""

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager

TIMED_OUT = 124


@contextmanager
def screen(size: str = "1280x800x24") -> Iterator[str]:
    """An X server on a display that is free; gives the display's name."""
    numbers, told = os.pipe()
    command = ["Xvfb", "-displayfd", str(told), "-screen", "0", size, "-nolisten", "tcp"]
    server = subprocess.Popen(command, pass_fds=[told], stderr=subprocess.DEVNULL)
    os.close(told)
    with os.fdopen(numbers) as announcement:
        display = announcement.readline().strip()
    try:
        if not display:
            sys.exit("session: Xvfb did not start")
        yield f":{display}"
    finally:
        server.terminate()
        server.wait()


def main(seconds: float, command: list[str]) -> int:
    with screen() as display:
        try:
            return subprocess.run(command, env=os.environ | {"DISPLAY": display}, timeout=seconds).returncode
        except subprocess.TimeoutExpired:
            return TIMED_OUT


if __name__ == "__main__":
    sys.exit(main(float(sys.argv[1]), sys.argv[2:]))
