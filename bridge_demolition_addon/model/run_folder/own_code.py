"""Digest of this program's own code: which program calculated a run; a version in the making has many."""

from __future__ import annotations

import hashlib
from functools import cache
from pathlib import Path

from ...engineering.core.library import core_sources, missing_core

_PACKAGE = Path(__file__).resolve().parents[2]
_CALCULATING = ("bullet", "engineering", "model", "scene", "simulation", "system")
"""Layers of this package that decide the result."""

_SHORT = 12


@cache
def own_code() -> str:
    """Return the digest of the layers that calculate, and of the compiled core where there is one, in hexadecimal."""
    digest = hashlib.sha256(b"" if missing_core() else core_sources().encode())
    for layer in _CALCULATING:
        for path in sorted((_PACKAGE / layer).rglob("*.py")):
            digest.update(path.relative_to(_PACKAGE).as_posix().encode() + b"\0")
            digest.update(path.read_bytes().replace(b"\r\n", b"\n") + b"\0")
    return digest.hexdigest()[:_SHORT]
