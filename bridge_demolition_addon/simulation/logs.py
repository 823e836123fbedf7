"""The logs of a run: CSV files that grow by whole lines, frame by frame."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from pathlib import Path
from types import TracebackType
from typing import Self

import numpy as np

FORCE_COLUMNS = ("frame", "time_s", "body", "force_x_N", "force_y_N", "force_z_N", "force_sum_N")
DEBRIS_COLUMNS = ("frame", "time_s", "body", "x_m", "y_m", "z_m", "distance_m", "throw_m")

_STEP_MARK = "\0"


class BodyLog:
    """CSV file with one line per body and logged frame.

    Parameters
    ----------
    path
        File to write; one that is there is replaced.
    columns
        Header, beginning with frame, time and body.
    bodies
        Names of the n bodies.
    """

    def __init__(self, path: Path, columns: Sequence[str], bodies: Sequence[str]):
        values = ",".join(["%.9g"] * (len(columns) - 3))
        # One template for all lines of a frame: formatting line by line takes several times as long.
        self._lines = "".join(f"{_STEP_MARK},{_csv_text(name)},{values}\n" for name in bodies)
        self._file = path.open("w", encoding="utf-8", newline="")
        self._write(",".join(columns) + "\n")

    def write(self, frame: int, time_s: float, values: np.ndarray) -> None:
        """Add one line per body with its values (n, columns)."""
        self._write((self._lines % tuple((values + 0.0).ravel().tolist())).replace(_STEP_MARK, f"{frame},{time_s:.9g}"))

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None):
        self.close()

    def _write(self, text: str) -> None:
        self._file.write(text)
        self._file.flush()  # a run that is killed keeps every frame it has logged


def _csv_text(name: str) -> str:
    """A name as CSV writes it, safe inside a formatting template."""
    buffer = io.StringIO()
    csv.writer(buffer).writerow([name])
    return buffer.getvalue().removesuffix("\r\n").replace("%", "%%")
