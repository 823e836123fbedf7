"""Structs of C that point to arrays of numpy: what is handed to the core is checked here, once for each array."""

from __future__ import annotations

import ctypes
from copy import deepcopy
from typing import Any, ClassVar, Self

import numpy as np
import numpy.typing as npt

Count = ctypes.c_int64


class NotFinite(ctypes.Structure):
    """Quantity that is not finite, and the body or connection that it is of: `bda_not_finite`."""

    _fields_ = (("quantity", Count), ("row", Count))


_Byte = ctypes.c_char


def address_of(array: npt.NDArray[Any]) -> int:
    """Return the address of the numbers of an array; `array.ctypes` takes three times as long."""
    if array.flags.writeable and array.size:
        return ctypes.addressof(_Byte.from_buffer(array))
    return array.ctypes.data


class Pointer(ctypes.c_void_p):
    """A field that points to the numbers of an array, which the core reads."""

    dtype: ClassVar[np.dtype[Any]]
    written: ClassVar[bool] = False

    @classmethod
    def checked(cls, name: str, array: npt.NDArray[Any], size: int) -> npt.NDArray[Any]:
        """Return an array that can be handed over, which has this number of elements.

        Raises
        ------
        ValueError
            The array is of another type or size, is not in the order of C, or cannot be written and has to be.
        """
        flags = array.flags
        if array.dtype is cls.dtype and array.size == size and flags.carray:  # the same for all but a few
            return array
        if array.dtype != cls.dtype:
            raise ValueError(f"{name} has numbers of type {array.dtype}: expected {cls.dtype}")
        if array.size != size:
            raise ValueError(f"{name} has {array.size} numbers: expected {size}")
        if not (flags.c_contiguous and flags.aligned):
            raise ValueError(f"{name} is not one block in the order of C: use numpy.ascontiguousarray")
        if cls.written and not flags.writeable:
            raise ValueError(f"{name} cannot be written, and the core writes to it")
        return array


class Doubles(Pointer):
    """`const double *`."""

    dtype = np.dtype(np.float64)


class WrittenDoubles(Doubles):
    """`double *`."""

    written = True


class Indices(Pointer):
    """`const int64_t *`."""

    dtype = np.dtype(np.int64)


class WrittenIndices(Indices):
    """`int64_t *`."""

    written = True


class Addresses(Pointer):
    """`const uint64_t *`."""

    dtype = np.dtype(np.uint64)


class WrittenAddresses(Addresses):
    """`uint64_t *`."""

    written = True


class Flags(Pointer):
    """`const uint8_t *`, each 0 or 1."""

    dtype = np.dtype(np.bool_)


class WrittenFlags(Flags):
    """`uint8_t *`, each 0 or 1."""

    written = True


class Struct(ctypes.Structure):
    """A struct of the core. It keeps the arrays that its fields point to; list the fields in `_fields_` as in C."""

    _pointers: ClassVar[dict[str, type[Pointer]]]

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        cls._pointers = {name: kind for name, kind, *_ in cls._fields_ if issubclass(kind, Pointer)}

    def __init__(self, **values: int | float) -> None:
        super().__init__(**values)
        self._kept: dict[str, npt.NDArray[Any]] = {}
        self._referred: dict[str, Struct | None] = {}

    def point(self, name: str, array: npt.NDArray[Any], size: int) -> None:
        """Let a field point to an array, which has this number of elements; an array that cannot be handed over raises.

        The error of an array of another type, size or order is a ValueError.
        """
        if self._kept.get(name) is array and array.size == size:
            return
        self._pointers[name].checked(name, array, size)
        setattr(self, name, address_of(array))
        self._kept[name] = array

    def refer(self, **structs: Struct | None) -> None:
        """Let fields point to other structs, or to nothing."""
        for name, struct in structs.items():
            if self._referred.get(name) is not struct or name not in self._referred:
                setattr(self, name, None if struct is None else ctypes.addressof(struct))
                self._referred[name] = struct

    def keep(self, name: str, struct: Struct) -> None:
        """Keep what a field is a copy of."""
        self._referred[name] = struct

    def take(self, **arrays: tuple[npt.NDArray[Any], int]) -> Self:
        """Let fields point to arrays, each with its number of elements, and return the struct.

        The core gets a copy of what it reads that is in another order.

        Raises
        ------
        ValueError
            As of `point`.
        """
        for name, (array, size) in arrays.items():
            is_ready = array.flags.c_contiguous or self._pointers[name].written
            self.point(name, array if is_ready else np.ascontiguousarray(array), size)
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Self:
        """Return one that points to copies of the arrays: those of this one may be gone before it."""
        other = type(self).from_buffer_copy(self)
        other._kept, other._referred = {}, {}
        memo[id(self)] = other
        for name, array in self._kept.items():
            copied = deepcopy(array, memo)
            setattr(other, name, copied.ctypes.data)
            other._kept[name] = copied
        return other
