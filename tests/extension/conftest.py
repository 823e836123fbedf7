# SPDX-License-Identifier: GPL-3.0-or-later
"""One release that all tests of a session look at: wheels of three Pythons are packed once."""

import os
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pytest
from support.checkout import ROOT

PLATFORM = {"linux": "linux-x64", "darwin": "macos-arm64", "win32": "windows-x64"}[sys.platform]


@pytest.fixture(scope="session")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the files of a release for this system, as the checkout is."""
    base = tmp_path_factory.getbasetemp()
    folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "release"
    if not folder.exists():
        output = tmp_path_factory.mktemp("releases")
        command = [sys.executable, ROOT / "scripts" / "release.py", "--draft", "--output", output]
        subprocess.run([*command, "--platform", PLATFORM], check=True)
        (made,) = output.iterdir()
        with suppress(OSError):  # another process was first
            made.rename(folder)
    return folder
