"""All arrays of a run in one file for MATLAB and Octave: The MathWorks, MAT-File Format, version 5.

Every element has its kind and length before it. An array is an element of others: flags, shape, name, values.
"""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import numpy as np

from ..errors import OutputError
from ..model.results.arrays import Results
from ..system.progress import Progress

MOST_BYTES = 2**31 - 1
"""Of an array in such a file."""

_HEADER = struct.pack("<116s8xH2s", b"MATLAB 5.0 MAT-file, Bridge Demolition Add-on".ljust(116), 0x0100, b"IM")

_INT8, _INT32, _UINT32, _MATRIX, _COMPRESSED, _UTF8 = 1, 5, 6, 14, 15, 16
"""Kinds of elements."""

_CELL, _CHAR, _LOGICAL = 1, 4, 0x0209
"""Classes of arrays; that of truths is the class of bytes, with a flag."""

_CLASS_AND_KIND = {
    "f8": (6, 9),
    "f4": (7, 7),
    "i1": (8, _INT8),
    "u1": (9, 2),
    "i2": (10, 3),
    "u2": (11, 4),
    "i4": (12, _INT32),
    "u4": (13, _UINT32),
    "i8": (14, 12),
    "u8": (15, 13),
    "b1": (_LOGICAL, 2),
}


def write_mat(results: Results, path: Path, progress: Progress) -> None:
    """Write all arrays under the names that they have in ``results.npz``; texts become cell arrays."""
    arrays = {name: np.asarray(values) for name, values in results.arrays().items()}
    progress.stage(f"writing {len(arrays)} arrays")
    for name, values in arrays.items():
        if values.nbytes > MOST_BYTES:
            raise OutputError(f"{path}: {name} takes {values.nbytes / 1e9:.1f} GB, and a MAT file can hold 2.1 of each")
    with path.open("wb") as file:
        file.write(_HEADER)
        for name, values in arrays.items():
            packed = zlib.compress(_array(values, name))
            file.write(struct.pack("<II", _COMPRESSED, len(packed)) + packed)
    progress.part(len(arrays), len(arrays), "arrays written")


def _array(values: np.ndarray, name: str = "") -> bytes:
    """Return numbers, or texts, with the two axes that MATLAB's arrays have at least: one alone is a column."""
    shape = values.shape if values.ndim > 1 else (values.size, 1)
    if values.dtype.kind != "U":
        kind, of_values = _CLASS_AND_KIND[values.dtype.str[1:]]
        return _matrix(kind, shape, name, _element(of_values, values.tobytes("F")))
    if values.ndim:
        return _matrix(_CELL, shape, name, b"".join(_array(text) for text in values.ravel("F")))
    text = str(values)
    return _matrix(_CHAR, (min(len(text), 1), len(text)), name, _element(_UTF8, text.encode()))


def _matrix(kind: int, shape: tuple[int, ...], name: str, values: bytes) -> bytes:
    flags, sizes = struct.pack("<II", kind, 0), struct.pack(f"<{len(shape)}i", *shape)
    parts = _element(_UINT32, flags), _element(_INT32, sizes), _element(_INT8, name.encode()), values
    return _element(_MATRIX, b"".join(parts))


def _element(kind: int, content: bytes) -> bytes:
    return struct.pack("<II", kind, len(content)) + content + bytes(-len(content) % 8)
