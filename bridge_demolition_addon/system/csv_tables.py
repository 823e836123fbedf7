"""Tables as CSV: read row by row, whatever is in the file, and written so that no text becomes a formula."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TextIO

from ..errors import UnreadableError
from .reading import check_file

_LONGEST_LINE = 1_000_000
"""Letters: a line of the tables of this program has some hundreds, and one with all that varies some thousands."""

_FORMULAS = ("=", "+", "-", "@")
"""What formulas of spreadsheets begin with."""


def csv_rows(path: Path, most_bytes: int) -> Iterator[list[str]]:
    """Yield the rows of a table in UTF-8, in little memory; raise `UnreadableError` where it is damaged or large."""
    check_file(path, most_bytes)
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            yield from csv.reader(_lines(file))
    except UnicodeDecodeError as error:
        raise UnreadableError("is no text in UTF-8: it is damaged, or of another program") from error
    except csv.Error as error:
        raise UnreadableError(f"is no table: {error}") from error
    except OSError as error:
        raise UnreadableError(f"cannot be read: {error.strerror}") from error


def csv_cell(value: Any) -> Any:
    """Return a value for a cell: a text that a spreadsheet would work out has an apostrophe before it."""
    return f"'{value}" if isinstance(value, str) and value.startswith(_FORMULAS) and not _is_number(value) else value


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _lines(file: TextIO) -> Iterator[str]:
    while line := file.readline(_LONGEST_LINE):
        if len(line) == _LONGEST_LINE:
            raise UnreadableError(f"has a line of more than {_LONGEST_LINE} letters: expected a table")
        yield line
