"""Arrays in copies of files that nobody else can reach."""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path
from typing import BinaryIO

import numpy as np

from ..errors import writing

_BLOCK = 1 << 20


def mapped_copy(content: BinaryIO, dtype: np.dtype, shape: tuple[int, ...], *, is_fortran: bool = False) -> np.ndarray:
    """Copy a file from where it stands to its end, and return the array that this is, mapped: it takes no memory.

    The copy has no name, and goes with the array. A mapped file that another program cuts short or empties would end
    the process.

    Raises
    ------
    OutputError
        The folder for temporary files has no room for the copy.
    ValueError
        The content is less than the array.
    """
    with writing(Path(tempfile.gettempdir())), tempfile.TemporaryFile() as copy:
        shutil.copyfileobj(content, copy, _BLOCK)
        copy.flush()
        return np.asarray(np.memmap(copy, dtype, "r", 0, shape, "F" if is_fortran else "C"))
