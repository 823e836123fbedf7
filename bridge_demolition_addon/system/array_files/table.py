"""Tables that grow on the disk row by row, as files of numpy that any process can read at any time."""

from __future__ import annotations

import sys
import threading
import weakref
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from typing import BinaryIO

import numpy as np

from ...errors import OutputError
from ..disk import is_in_place, writing
from .archive import mapped_copy

_MAGIC = np.lib.format.magic(2, 0)

_ANY_COUNT = 10**18
"""More rows than any file has: a header with this number is as long as headers get."""

_ALIGNMENT = 64
"""Bytes; where the rows begin, as numpy has it."""


class GrowingTable:
    """A file ``.npy`` of rows with named columns, each row on the disk as soon as it is added.

    A file that is at the path is replaced. The rows can be read while it grows, also from other threads. A process that
    is killed leaves a file with all whole rows. Rows that were read or mapped stay as they are, whatever happens to the
    table.
    """

    def __init__(self, path: Path, row_type: np.dtype):
        self.path, self.row_type = path, row_type
        self._start = len(_header(row_type, 0))
        self._count = 0
        self._lock = threading.Lock()
        with writing(path):
            path.unlink(missing_ok=True)  # a process that has mapped it would crash if it was emptied
            self._file = path.open("x+b", buffering=0)
        self._unwanted: list[bool] = []
        self._finish = weakref.finalize(self, _finish, self._file, path, self._unwanted)
        with writing(path):
            self._write(0, _header(row_type, 0))

    def __len__(self) -> int:
        return self._count

    @property
    def is_in_place(self) -> bool:
        """Whether the file is still where it was made."""
        return not self._file.closed and is_in_place(self._file.fileno(), self.path)

    def append(self, rows: np.ndarray) -> None:
        """Add rows (k,)."""
        count = self._count + len(rows)
        with writing(self.path), self._lock:
            self._write(self._start + self._count * self.row_type.itemsize, rows.view(np.uint8).data)
            self._write(0, _header(self.row_type, count))
        self._count = count

    def row(self, number: int) -> np.ndarray:
        """Return one row as rows (1,), read from the file."""
        row = np.empty(1, self.row_type)
        left = memoryview(row.view(np.uint8))
        with self._lock:
            self._file.seek(self._start + number * self.row_type.itemsize)
            while left:
                read = self._file.readinto(left)
                if not read:
                    raise OutputError(f"{self.path}: was cut short while it was written to")
                left = left[read:]
        return row

    def rows(self) -> np.ndarray:
        """Return all rows (k,) so far, mapped: only the rows in use are read."""
        with self._lock:
            return _mapped(self._file, self.row_type, self._start, self._count)

    def remove(self) -> None:
        """Take the file away; its rows can be read as long as the table is there.

        Windows removes no open file: there it goes with the table.
        """
        if sys.platform == "win32":
            self._unwanted.append(True)
        elif self.is_in_place:
            self.path.unlink()

    def discard(self) -> None:
        """Take the file away with all its rows; rows that were mapped stay."""
        self._unwanted.append(True)
        self._finish()

    def _write(self, position: int, content: bytes | memoryview) -> None:
        self._file.seek(position)
        left = memoryview(content)
        while left:
            left = left[self._file.write(left) :]


def stored_rows(path: Path) -> np.ndarray:
    """Return the whole rows (k,) of a table that was left, or that still grows, mapped from a copy."""
    with path.open("rb") as file:
        if np.lib.format.read_magic(file) != (2, 0):
            raise ValueError("no table")
        shape, is_fortran, row_type = np.lib.format.read_array_header_2_0(file)
        if len(shape) != 1 or is_fortran or row_type.hasobject or row_type.names is None or not row_type.itemsize:
            raise ValueError("no table")
        whole = (path.stat().st_size - file.tell()) // row_type.itemsize
        count = min(shape[0], whole)
        return mapped_copy(file, row_type, (count,)) if count else np.empty(0, row_type)


def _mapped(file: BinaryIO, row_type: np.dtype, start: int, count: int) -> np.ndarray:
    if not count:
        return np.empty(0, row_type)
    return np.asarray(np.memmap(file, row_type, "r", start, (count,)))


def _header(row_type: np.dtype, count: int) -> bytes:
    """Return the header before the rows: as long for any number of them."""
    longest = len(_description(row_type, _ANY_COUNT))
    length = -(-(len(_MAGIC) + 4 + longest + 1) // _ALIGNMENT) * _ALIGNMENT - len(_MAGIC) - 4
    return _MAGIC + length.to_bytes(4, "little") + _description(row_type, count).ljust(length - 1) + b"\n"


def _description(row_type: np.dtype, count: int) -> bytes:
    return f"{{'descr': {_described(row_type)}, 'fortran_order': False, 'shape': ({count},), }}".encode("latin1")


@lru_cache(maxsize=4)  # every row asks for it
def _described(row_type: np.dtype) -> str:
    return repr(np.lib.format.dtype_to_descr(row_type))


def _finish(file: BinaryIO, path: Path, unwanted: list[bool]) -> None:
    """Close a table that is no longer used, and remove it if it is unwanted."""
    is_to_go = unwanted and is_in_place(file.fileno(), path)
    file.close()
    if is_to_go:
        with suppress(PermissionError):  # Windows removes no mapped file either: the next run in the folder does
            path.unlink(missing_ok=True)
