"""Archives of arrays as numpy's ``.npz``, written and read in little memory: large arrays are mapped."""

from __future__ import annotations

import math
import shutil
import struct
import tempfile
import zipfile
from collections.abc import Container, Iterator, Mapping
from pathlib import Path
from typing import IO, Literal

import numpy as np

from ..disk import whole_file

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


_ENDING = ".npy"

_MAPPED_FROM = 1 << 16
"""Bytes from which on an array is mapped; a smaller one is read, which takes less."""

MOST_PACKED = 1 << 28
"""Bytes of all arrays that are packed, or too small to be mapped: a file of a kilobyte can unpack to a thousand times
as many."""

_MOST_ARRAYS = 1000

_NUMBERS = 1 << 18
"""Numbers in a piece of an array: the results of a piece stay in the processor's cache."""

_ALIGNMENT = 64
"""Bytes; numpy works fastest on arrays that begin at multiples of them."""

_LOCAL_HEADER, _SIZES, _PADDING = 30, 20, 4
"""Bytes before an array in the archive: a header, its 64-bit sizes, and the mark and length of a padding."""

_PADDING_MARK = 0xD935
"""Mark of empty fields, as other programs that align archives use it."""

_HEADER_READERS = {(1, 0): np.lib.format.read_array_header_1_0, (2, 0): np.lib.format.read_array_header_2_0}


def write_archive(path: Path, arrays: Mapping[str, np.ndarray], packed: Container[str] = ()) -> None:
    """Write arrays of any size by their names, whole or not at all; the same arrays give the same file.

    Those in `packed` are packed, as small ones are. A packed array has to be read as a whole.
    """
    with whole_file(path) as part, part.open("w+b") as written, zipfile.ZipFile(written, "w") as archive:
        for name, values in arrays.items():
            values = np.asanyarray(values)
            member = zipfile.ZipInfo(f"{name}{_ENDING}")
            if name in packed or values.nbytes < _MAPPED_FROM:
                member.compress_type = zipfile.ZIP_DEFLATED
            else:
                before = written.tell() + _LOCAL_HEADER + len(member.filename.encode()) + _SIZES + _PADDING
                padding = -before % _ALIGNMENT
                member.extra = struct.pack("<HH", _PADDING_MARK, padding) + bytes(padding)
            with archive.open(member, "w", force_zip64=True) as file:
                np.lib.format.write_array(file, values, allow_pickle=False)


def read_archive(path: Path) -> dict[str, np.ndarray]:
    """Read all arrays of an archive by their names, and check that they are as they were written.

    Large arrays are mapped from a copy, and stay as they are, whatever happens to the archive. What claims to be larger
    than it can be raises `ValueError` before any of it is read.
    """
    with zipfile.ZipFile(path) as archive:
        members = [member for member in archive.infolist() if member.filename.endswith(_ENDING)]
        _check_sizes(members, path.stat().st_size)
        return {member.filename.removesuffix(_ENDING): _array(archive, member) for member in members}


def blocks_of(values: np.ndarray) -> Iterator[np.ndarray]:
    """Give an array in pieces along its first axis, in order, so that work on it takes little memory."""
    values = np.atleast_1d(values)
    rows = max(1, _NUMBERS // max(1, values[:1].size))
    for first in range(0, len(values), rows):
        yield values[first : first + rows]


def _is_mapped(member: zipfile.ZipInfo) -> bool:
    return member.compress_type == zipfile.ZIP_STORED and member.file_size >= _MAPPED_FROM


def _check_sizes(members: list[zipfile.ZipInfo], bytes_on_disk: int) -> None:
    if len(members) > _MOST_ARRAYS:
        raise ValueError(f"holds {len(members)} arrays, expected at most {_MOST_ARRAYS}")
    packed = sum(member.file_size for member in members if not _is_mapped(member))
    if packed > MOST_PACKED:
        raise ValueError(f"unpacks to {packed / 1e6:.0f} MB, expected at most {MOST_PACKED / 1e6:.0f} MB")
    if sum(member.file_size for member in members if _is_mapped(member)) > bytes_on_disk:
        raise ValueError("its arrays claim to be larger than the file")


def _array(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> np.ndarray:
    with archive.open(member) as content:
        version = np.lib.format.read_magic(content)
        if version not in _HEADER_READERS:
            raise ValueError(f"{member.filename}: is of version {version} of numpy's format, expected 1.0 or 2.0")
        shape, is_fortran, dtype = _HEADER_READERS[version](content)
        if dtype.hasobject:
            raise ValueError(f"{member.filename}: holds objects")
        size, left = math.prod(shape) * dtype.itemsize, member.file_size - content.tell()
        if size != left or not dtype.itemsize or min(shape, default=0) < 0:
            raise ValueError(
                f"{member.filename}: claims numbers {shape} of {dtype.itemsize} bytes, and holds {left} bytes"
            )
        if _is_mapped(member):
            return mapped_copy(content, dtype, shape, is_fortran=is_fortran)  # read to its end, where the checksum is
        values = bytearray(content.read())
        if len(values) != size:
            raise ValueError(f"{member.filename}: is cut short")
        return np.ndarray(shape, dtype, values, order="F" if is_fortran else "C")
