"""Archives of arrays as numpy's ``.npz``, written and read in little memory: large arrays are mapped."""

from __future__ import annotations

import struct
import zipfile
from collections.abc import Container, Iterator, Mapping
from pathlib import Path

import numpy as np

from ..disk import whole_file
from .own_copy import mapped_copy

_ENDING = ".npy"

_MAPPED_FROM = 1 << 16
"""Bytes from which on an array is mapped; a smaller one is read, which takes less."""

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

    Large arrays are mapped from a copy, and stay as they are, whatever happens to the archive.
    """
    with zipfile.ZipFile(path) as archive:
        members = [member for member in archive.infolist() if member.filename.endswith(_ENDING)]
        return {member.filename.removesuffix(_ENDING): _array(archive, member) for member in members}


def blocks_of(values: np.ndarray) -> Iterator[np.ndarray]:
    """Give an array in pieces along its first axis, in order, so that work on it takes little memory."""
    values = np.atleast_1d(values)
    rows = max(1, _NUMBERS // max(1, values[:1].size))
    for first in range(0, len(values), rows):
        yield values[first : first + rows]


def _array(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> np.ndarray:
    with archive.open(member) as content:
        if member.compress_type != zipfile.ZIP_STORED or member.file_size < _MAPPED_FROM:
            return np.lib.format.read_array(content, allow_pickle=False)
        read_header = _HEADER_READERS[np.lib.format.read_magic(content)]
        shape, is_fortran, dtype = read_header(content)
        if dtype.hasobject:
            raise ValueError(f"{member.filename}: holds objects")
        return mapped_copy(content, dtype, shape, is_fortran=is_fortran)  # read to its end, where the checksum is
