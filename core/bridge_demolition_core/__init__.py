# SPDX-License-Identifier: GPL-3.0-or-later
"""The compiled core of the Bridge Demolition Add-on: a shared library, and where it is."""

import sys
from pathlib import Path

ENDINGS = {"win32": ".dll", "darwin": ".dylib"}


def library_path() -> Path:
    """Return the path of the shared library for this system."""
    return Path(__file__).with_name("bda_core" + ENDINGS.get(sys.platform, ".so"))
