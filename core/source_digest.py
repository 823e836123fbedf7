# SPDX-License-Identifier: GPL-3.0-or-later
"""Tell whether a core is of these sources: what is built holds their digest."""

import hashlib
from pathlib import Path

FOLDER = Path(__file__).parent
SOURCES = FOLDER / "src"
DIGITS = 32


def digest() -> str:
    """Return a digest of all that decides what the library does: its sources, and the flags in build_core.py."""
    found = hashlib.sha256()
    for path in (*sorted(SOURCES.glob("*.[ch]")), FOLDER / "build_core.py"):
        text = path.read_bytes()
        found.update(f"{path.name} {len(text)}\n".encode() + text)
    return found.hexdigest()[:DIGITS]
