"""CSV files of positions: points to cut around, and painted positions with their weights."""

from __future__ import annotations

import csv
import io
import re
from pathlib import Path

import numpy as np

from ...errors import ScenarioError, UnreadableError
from ...system.reading import MEGABYTE, csv_rows

MOST_BYTES = 1000 * MEGABYTE
"""Size up to which points are read: tens of millions of them."""

_AMOUNTS = {3: "three", 4: "four"}
_NUMBER = re.compile(r"""[\s"']*[-+]?(\.?\d|(nan|inf|infinity)\s*$)""", re.IGNORECASE)
"""How a number begins, also one with a slip in it, such as ``1O.5`` or ``1.5;2;3``."""


def points_from_file(path: Path) -> np.ndarray:
    """Return the points of a CSV file, (n, 3) in m: x, y and z in a row; a first row without a number is skipped."""
    return _numbers(path, "points_file", 3)


def paint_from_file(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Return painted positions of a CSV file, (n, 3) in m, and their weights (n,): x, y, z and weight in a row."""
    rows = _numbers(path, "painted_file", 4)
    if not len(rows) or (rows[:, 3] < 0.0).any() or (rows[:, 3] > 1.0).any():
        raise ScenarioError(f"{path}: expected rows of x, y, z (m) and a weight from 0 to 1")
    return rows[:, :3], rows[:, 3]


def paint_text(points_m: np.ndarray, weights: np.ndarray) -> str:
    """Write painted positions (n, 3) in m and their weights (n,), as `paint_from_file` reads them."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("x_m", "y_m", "z_m", "weight"))
    writer.writerows(np.column_stack((points_m, weights)).tolist())
    return text.getvalue()


def _numbers(path: Path, key: str, columns: int) -> np.ndarray:
    try:
        lines = csv_rows(path, MOST_BYTES)
        rows = [(number, row) for number, row in enumerate(lines, start=1) if any(map(str.strip, row))]
    except UnreadableError as error:
        raise ScenarioError(f'fracture.{key} is "{path}": {error}') from error
    numbered = [_row(path, number, row, columns) for number, row in rows]
    return np.array([row for row in numbered if row is not None], dtype=float).reshape(-1, columns)


def _row(path: Path, number: int, row: list[str], columns: int) -> list[float] | None:
    """Return the numbers in a row; None for a first row of names."""
    if number == 1 and not any(map(_begins_with_number, row)):
        return None
    try:
        numbers = [float(value) for value in row]
    except ValueError:
        numbers = []
    if len(numbers) != columns:
        raise ScenarioError(
            f"{path}, row {number}: expected {_AMOUNTS[columns]} numbers (m) with commas between them, "
            f"found {', '.join(row)}"
        )
    if not np.isfinite(numbers).all():
        raise ScenarioError(
            f"{path}, row {number}: expected {_AMOUNTS[columns]} finite numbers (m), found {', '.join(row)}"
        )
    return numbers


def _begins_with_number(text: str) -> bool:
    return _NUMBER.match(text) is not None
