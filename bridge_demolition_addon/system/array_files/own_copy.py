"""Arrays in copies of files that no other program can change."""

from __future__ import annotations

import math
import shutil
import tempfile
from typing import IO, Literal

import numpy as np

_BLOCK = 1 << 20


def mapped_copy(content: IO[bytes], dtype: np.dtype, shape: tuple[int, ...], *, is_fortran: bool = False) -> np.ndarray:
    """Copy a file from where it stands to its end, and return its array, mapped: it takes no memory.

    The copy has no name, and goes with the array. A mapped file that another program cuts short or empties would end
    the process. Where there is no room for the copy on the disk, it is in memory.
    """
    order: Literal["F", "C"] = "F" if is_fortran else "C"
    start = content.tell()
    try:
        with tempfile.TemporaryFile() as copy:
            shutil.copyfileobj(content, copy, _BLOCK)
            copy.flush()
            return np.asarray(np.memmap(copy, dtype, "r", 0, shape, order))
    except OSError:
        content.seek(start)
        return np.frombuffer(content.read(), dtype, math.prod(shape)).reshape(shape, order=order)
