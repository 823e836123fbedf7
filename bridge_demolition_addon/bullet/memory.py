"""Reading and writing this process's memory by address.

`read` asks the operating system and cannot fault, whatever the address: it serves until an address is checked. All
others read and write many checked addresses at once with numpy. What is copied around every sub-step is copied by the
compiled core.
"""

from __future__ import annotations

import ctypes
import os
import struct
import sys
from collections.abc import Callable
from typing import Any

import numpy as np

from ..errors import LayoutError

_LOWEST = 4096
_HIGHEST = 2**47


def read(address: int, size: int) -> bytes | None:
    """`size` bytes at `address`, or None where that memory cannot be read. Never faults."""
    if address < _LOWEST or address + size >= _HIGHEST:
        return None
    return _read_own_process(address, size)


def read_value(address: int, format_: str) -> Any:
    """One value at `address`, in `struct` notation."""
    raw = read(address, struct.calcsize("<" + format_))
    if raw is None:
        raise LayoutError(f"address {address:#x} cannot be read")
    return struct.unpack("<" + format_, raw)[0]


def read_values(address: int, *fields: tuple[int, str]) -> tuple[Any, ...]:
    """Values at offsets in bytes from `address`, each in `struct` notation, of one structure that is read at once."""
    first = min(offset for offset, _ in fields)
    size = max(offset + struct.calcsize("<" + format_) for offset, format_ in fields) - first
    raw = read(address + first, size)
    if raw is None:
        raise LayoutError(f"address {address + first:#x} cannot be read")
    return tuple(struct.unpack_from("<" + format_, raw, offset - first)[0] for offset, format_ in fields)


def read_pointer(address: int) -> int:
    """Pointer at `address`, 0 where it is null."""
    return _as_pointer(address, read_value(address, "Q"))


def read_pointers_at(address: int, *offsets: int) -> list[int]:
    """Pointers at offsets in bytes from `address`, 0 where they are null, of one structure that is read at once."""
    pointers = read_values(address, *((offset, "Q") for offset in offsets))
    return [_as_pointer(address + offset, pointer) for offset, pointer in zip(offsets, pointers, strict=True)]


def _as_pointer(address: int, value: int) -> int:
    """Return a value that was read at an address, which has to be a pointer."""
    if value and (value < _LOWEST or value >= _HIGHEST or value % 8):
        raise LayoutError(f"no pointer at {address:#x} but {value:#x}")
    return value


def read_pointers(field: int, count: int, name: str) -> np.ndarray:
    """So many pointers (count,) uint64 in the array that the pointer in a field names; never faults."""
    raw = read(read_pointer(field), 8 * count) if count else b""
    if raw is None:
        raise LayoutError(f"{name} cannot be read")
    return np.frombuffer(raw, np.uint64)


class Values:
    """All values of a type in the address space of user programs, which numpy has as one array without a copy.

    Methods take checked addresses, one or (n,).
    """

    def __init__(self, type_: str):
        self.size = np.dtype(type_).itemsize
        shape = ((_HIGHEST - _LOWEST) // self.size,)
        self.__array_interface__ = {"data": (_LOWEST, False), "shape": shape, "typestr": type_, "version": 3}
        self.everywhere = np.asarray(self)

    def indices(self, addresses: np.ndarray | int) -> np.ndarray:
        """Return where in the array the values at addresses are."""
        shift = self.size.bit_length() - 1  # all sizes are powers of two
        return (np.asarray(addresses).astype(np.int64) >> shift) - (_LOWEST >> shift)

    def one(self, address: int) -> Any:
        """Return the value at a checked address as a number of Python."""
        return self.everywhere.item((address - _LOWEST) // self.size)

    def gather(self, addresses: np.ndarray) -> np.ndarray:
        """Copy the values at addresses."""
        return self.everywhere.take(self.indices(addresses))

    def write(self, addresses: np.ndarray | int, values: np.ndarray | np.generic | float) -> None:
        """Write values to addresses."""
        self.everywhere[self.indices(addresses)] = values


DOUBLES, FLOATS, BYTES, SHORTS, INTEGERS, POINTERS = map(Values, ("<f8", "<f4", "|u1", "<i2", "<i4", "<u8"))


def gather_doubles(addresses: np.ndarray, count: int = 1) -> np.ndarray:
    """So many doubles in a row (n, count) at each of the checked addresses (n,)."""
    return DOUBLES.everywhere.take(DOUBLES.indices(addresses)[:, None] + np.arange(count))


def write_vectors(addresses: np.ndarray, vectors: np.ndarray) -> None:
    """Write vectors (n, 3) of doubles to checked addresses (n,)."""
    DOUBLES.everywhere[DOUBLES.indices(addresses)[:, None] + np.arange(3)] = vectors


def add_vectors(addresses: np.ndarray, vectors: np.ndarray) -> None:
    """Add vectors (n, 3) to those at checked addresses (n,), each of which is named once."""
    write_vectors(addresses, gather_doubles(addresses, 3) + vectors)


def copy_pointers(address: int, count: int) -> np.ndarray:
    """So many pointers (count,) uint64 in a row, at a checked address."""
    first = (address - _LOWEST) // 8
    return POINTERS.everywhere[first : first + count].copy()


def _linux_reader() -> Callable[[int, int], bytes | None]:
    class IoVector(ctypes.Structure):
        _fields_ = (("base", ctypes.c_void_p), ("length", ctypes.c_size_t))

    library = ctypes.CDLL(None, use_errno=True)
    refused = (1, 38)  # EPERM, ENOSYS: some sandboxes forbid the call

    def read_linux(address: int, size: int) -> bytes | None:
        buffer = ctypes.create_string_buffer(size)
        local, remote = IoVector(ctypes.addressof(buffer), size), IoVector(address, size)
        done = library.process_vm_readv(os.getpid(), ctypes.byref(local), 1, ctypes.byref(remote), 1, 0)
        if done == size:
            return buffer.raw
        return read_through_pipe(address, size) if ctypes.get_errno() in refused else None

    def read_through_pipe(address: int, size: int) -> bytes | None:
        # The kernel copies into a pipe and answers EFAULT where the memory is not there.
        reading, writing = os.pipe()
        try:
            return os.read(reading, size) if library.write(writing, ctypes.c_void_p(address), size) == size else None
        finally:
            os.close(reading)
            os.close(writing)

    return read_linux


def _windows_reader() -> Callable[[int, int], bytes | None]:
    kernel = getattr(ctypes, "windll").kernel32  # noqa: B009, it is on Windows alone
    kernel.GetCurrentProcess.restype = ctypes.c_void_p
    process = ctypes.c_void_p(kernel.GetCurrentProcess())

    def read_windows(address: int, size: int) -> bytes | None:
        buffer, done = ctypes.create_string_buffer(size), ctypes.c_size_t()
        span = ctypes.c_void_p(address), buffer, ctypes.c_size_t(size)
        succeeded = kernel.ReadProcessMemory(process, *span, ctypes.byref(done))
        return buffer.raw if succeeded and done.value == size else None

    return read_windows


def _mac_reader() -> Callable[[int, int], bytes | None]:
    library = ctypes.CDLL(None)
    task = ctypes.c_uint32.in_dll(library, "mach_task_self_").value

    def read_mac(address: int, size: int) -> bytes | None:
        buffer, done = ctypes.create_string_buffer(size), ctypes.c_uint64()
        span = ctypes.c_uint64(address), ctypes.c_uint64(size), ctypes.c_uint64(ctypes.addressof(buffer))
        failed = library.mach_vm_read_overwrite(task, *span, ctypes.byref(done))
        return buffer.raw if not failed and done.value == size else None

    return read_mac


_READERS = {"linux": _linux_reader, "win32": _windows_reader, "darwin": _mac_reader}
_read_own_process = _READERS.get(sys.platform, lambda: lambda _address, _size: None)()
