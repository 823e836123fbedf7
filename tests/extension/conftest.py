# SPDX-License-Identifier: GPL-3.0-or-later
"""One release that all tests of a session look at: wheels of three Pythons are packed once."""

import os
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from support.checkout import ROOT

PLATFORM = {"linux": "linux-x64", "darwin": "macos-arm64", "win32": "windows-x64"}[sys.platform]


PATIENCE_S = 600.0


@pytest.fixture(scope="session")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the files of a release for this system, as the checkout is."""
    base = tmp_path_factory.getbasetemp()
    folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "release"
    with _in_turn(folder.with_name("release.begun")) as is_first:
        if is_first:
            output = tmp_path_factory.mktemp("releases")
            command = [sys.executable, ROOT / "scripts" / "release.py", "--draft", "--output", output]
            subprocess.run([*command, "--platform", PLATFORM], check=True)
            (made,) = output.iterdir()
            made.rename(folder)
    return folder


@contextmanager
def _in_turn(path: Path) -> Iterator[bool]:
    """Whether this process is the first one here; all others wait until it is done."""
    done = path.with_suffix(".ended")
    try:
        path.open("x").close()
    except FileExistsError:
        until = time.monotonic() + PATIENCE_S
        while not done.exists():
            assert time.monotonic() < until, "the process that builds the release takes too long"
            time.sleep(0.2)
        yield False
    else:
        try:
            yield True
        finally:
            done.touch()
