"""Frames of a recording, on the disk as they come."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import overload

import numpy as np

from ...system.array_files.archive import write_archive
from ...system.array_files.table import GrowingTable
from ...system.disk import writing
from .arrays import (
    BALLS_FILE,
    CONTACTS_FILE,
    FRAMES_FILE,
    INVENTORY_FILE,
    Results,
    balls_of,
    columns,
    contacts_until,
    frames_of,
    named_arrays,
)
from .frames import BallHistory, ContactHistory, Frame, Inventory

_FRACTIONS = np.float32
"""Of arrays in a frame: seven digits, in half the space. Single numbers, such as works, keep all of theirs."""


class FrameStream(Sequence[Frame]):
    """The frames of a recording, each on the disk as soon as it is added, none in memory.

    What another stream has left in the folder, which exists, is replaced. `contacts` says whether contacts are kept.
    """

    def __init__(self, folder: Path, load_sampling: str, inventory: Inventory, *, contacts: bool = False):
        self._folder, self._load_sampling, self._inventory = folder, load_sampling, inventory
        self._has_contacts = contacts
        self._balls = np.flatnonzero(inventory.body_kinds == "ball")
        self._frames: GrowingTable | None = None
        self._substeps: GrowingTable | None = None
        self._contacts: GrowingTable | None = None
        known = dict(named_arrays(inventory)) | {"reading": np.array(load_sampling), "balls": self._balls}
        with writing(folder):
            for name in (FRAMES_FILE, BALLS_FILE, CONTACTS_FILE):
                (folder / name).unlink(missing_ok=True)
            write_archive(folder / INVENTORY_FILE, known)

    def __len__(self) -> int:
        return 0 if self._frames is None else len(self._frames)

    @overload
    def __getitem__(self, row: int) -> Frame: ...

    @overload
    def __getitem__(self, row: slice) -> list[Frame]: ...

    def __getitem__(self, row: int | slice) -> Frame | list[Frame]:
        if isinstance(row, slice):
            return [self[number] for number in range(len(self))[row]]
        number = range(len(self))[row]
        assert self._frames is not None  # it has a row
        return frames_of(columns(self._frames.row(number)))[0]

    def append(self, frame: Frame, balls: BallHistory, contacts: ContactHistory | None = None) -> None:
        """Add a frame, what hit the balls in its sub-steps, and its contacts, where there are any and they are kept."""
        arrays = {name: np.asarray(values)[None] for name, values in named_arrays(frame)}
        frames = self._begin(arrays) if self._frames is None else self._frames
        if len(balls.times_s) and self._substeps is not None:  # first, so that no whole frame is without them
            self._substeps.append(_rows(_substeps(balls), self._substeps.row_type))
        if self._contacts is not None and contacts:
            self._contacts.append(_rows(dict(named_arrays(contacts)), self._contacts.row_type))
        frames.append(_rows(arrays, frames.row_type))

    def results(self) -> Results:
        """Return everything so far, mapped: only what is looked at is read. There has to be a frame."""
        assert self._frames is not None
        balls = BallHistory.unknown()
        if self._substeps:
            balls = balls_of(columns(self._substeps.rows()) | {"balls": self._balls})
        frames, contacts = frames_of(columns(self._frames.rows())), None
        if self._contacts is not None:
            contacts = contacts_until(self._contacts.rows(), frames.number[-1])
        return Results(self._load_sampling, self._inventory, frames, balls, contacts)

    def remove(self) -> None:
        """Take the files away; what is in them can be read as long as the stream is there."""
        self._remove_inventory()
        for table in self._tables:
            table.remove()

    def discard(self) -> None:
        """Take the files away with all that is in them; only what is mapped can still be read."""
        self._remove_inventory()
        for table in self._tables:
            table.discard()

    def _begin(self, arrays: Mapping[str, np.ndarray]) -> GrowingTable:
        """Make all files with the first frame: the folder may be moved later, and they with it."""
        if len(self._balls):
            nothing = np.zeros((0, len(self._balls), 3))
            substeps = _substeps(BallHistory(self._balls, np.zeros(0), nothing, nothing))
            self._substeps = GrowingTable(self._folder / BALLS_FILE, _row_type(substeps, np.float64))
        if self._has_contacts:
            row_type = _row_type(dict(named_arrays(ContactHistory.none())), _FRACTIONS)
            self._contacts = GrowingTable(self._folder / CONTACTS_FILE, row_type)
        self._frames = GrowingTable(self._folder / FRAMES_FILE, _row_type(arrays, _FRACTIONS))
        return self._frames

    def _remove_inventory(self) -> None:
        if self._frames is not None and self._frames.is_in_place:  # or the folder is elsewhere, or another one
            (self._folder / INVENTORY_FILE).unlink(missing_ok=True)

    @property
    def _tables(self) -> list[GrowingTable]:
        return [table for table in (self._frames, self._substeps, self._contacts) if table is not None]


def _substeps(balls: BallHistory) -> dict[str, np.ndarray]:
    """Return the arrays (s, …) of a history by their names in the files."""
    return {name: values for name, values in named_arrays(balls) if name != "balls"}


def _row_type(arrays: Mapping[str, np.ndarray], fractions: type[np.floating]) -> np.dtype:
    """Return the type of rows of arrays (k, …), in which arrays of fractions have that precision."""
    columns_of_row = [(name, _column_type(values, fractions), values.shape[1:]) for name, values in arrays.items()]
    columns_of_row.sort(key=lambda column: -np.dtype(column[1]).itemsize)  # so that all are aligned without gaps
    return np.dtype(columns_of_row, align=True)


def _column_type(values: np.ndarray, fractions: type[np.floating]) -> type[np.generic]:
    if values.dtype.kind == "f":
        return fractions if values.ndim > 1 else np.float64
    return np.bool_ if values.dtype.kind == "b" else np.int64


def _rows(arrays: Mapping[str, np.ndarray], row_type: np.dtype) -> np.ndarray:
    rows = np.zeros(len(next(iter(arrays.values()))), row_type)
    with np.errstate(over="ignore"):  # what is too large for single precision is infinite in it
        for name, values in arrays.items():
            rows[name] = values
    return rows
