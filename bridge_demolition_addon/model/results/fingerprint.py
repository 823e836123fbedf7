"""Digests by which two people see whether they have the same run: the same bits give the same digest.

One is of what was built, one of how everything moved and broke, and one of all results. Where the first differs,
something else was simulated. Where only the others do, Blender's own arithmetic differs.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np

from ...system.array_files.archive import blocks_of
from .arrays import Results

SHORT = 8
"""Digits of a digest that are enough to tell runs apart by eye."""

_OF_BARS = ("dissipated_by_bars_j", "dissipated_by_crack_friction_j", "connection_bars")
"""Arrays that say something of runs with bars alone; the others have the digests that they had before these."""

_KEPT_AS = {"i": np.dtype("<i8"), "u": np.dtype("<i8"), "f": np.dtype("<f8")}
"""One width on every system, by the kind of number: numpy's default integers had 32 bits on Windows before numpy 2."""


def digest(parts: Mapping[str, Any]) -> str:
    """Return the SHA-256 of named arrays, numbers and texts, as hexadecimal digits; their order does not count."""
    sha = hashlib.sha256()
    for name in sorted(parts):
        values = np.asarray(parts[name])
        if values.dtype.kind == "U":
            text = "\0".join(values.ravel().tolist()).encode()
            contents: Iterable[bytes] = [text]
            size = len(text)
        else:
            kept = _KEPT_AS.get(values.dtype.kind, np.dtype("u1"))
            contents = (block.astype(kept).tobytes() for block in blocks_of(values))
            size = values.size * kept.itemsize
        sha.update(f"{name}:{values.shape}:{size}:".encode())
        for content in contents:
            sha.update(content)
    return sha.hexdigest()


def known_parts(record: Any) -> dict[str, Any]:
    """Return the fields of a dataclass that are not None, by name."""
    parts = {item.name: getattr(record, item.name) for item in fields(record)}
    return {name: values for name, values in parts.items() if values is not None}


def motion_digest(results: Results) -> str:
    """Return the digest of how all bodies moved, what broke and what exploded: all of frames but loads and work.

    It is the same whether loads were recorded or not.
    """
    parts = {field.name: getattr(results.frames, field.name) for field in fields(results.frames)}
    return digest({name: part for name, part in parts.items() if not is_dataclass(part)})


def result_digest(results: Results) -> str:
    """Return the digest of everything that was recorded."""
    return digest({name: values for name, values in results.arrays().items() if _counts(name, values)})


def _counts(name: str, values: np.ndarray) -> bool:
    return name not in _OF_BARS or bool(np.nan_to_num(values).any())
