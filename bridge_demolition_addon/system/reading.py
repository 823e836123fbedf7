"""Files of the user, read only where they are files, and no larger than expected; tables as CSV."""

from __future__ import annotations

import csv
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TextIO

from ..errors import UnreadableError

MEGABYTE = 1_000_000


def check_file(path: Path, most_bytes: int | None = None) -> None:
    """Raise `UnreadableError` where a path leads to no file, cannot be read, or to more than `most_bytes`.

    A pipe would be waited for, and a device read without end. The text does not name the path.
    """
    try:
        status = path.stat()
    except FileNotFoundError as error:
        raise UnreadableError("no such file") from error
    except OSError as error:
        raise UnreadableError(f"cannot be read: {error.strerror}") from error
    except ValueError as error:
        raise UnreadableError(f"no path of a file: {error}") from error
    if stat.S_ISDIR(status.st_mode):
        raise UnreadableError("is a directory")
    if not stat.S_ISREG(status.st_mode):
        raise UnreadableError("is a pipe or a device, not a file")
    if most_bytes is not None and status.st_size > most_bytes:
        raise UnreadableError(f"has {status.st_size / MEGABYTE:.1f} MB: expected at most {most_bytes / MEGABYTE:g} MB")


def file_text(path: Path, most_bytes: int) -> str:
    """Return the text of a file in UTF-8, without the mark that editors on Windows may put at its beginning.

    Raise `UnreadableError` as `check_file`, and where it is no such text.
    """
    check_file(path, most_bytes)
    try:
        content = path.read_bytes()
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise UnreadableError(_not_utf8(content, error.start)) from error
    except OSError as error:
        raise UnreadableError(f"cannot be read: {error.strerror}") from error
    if "\0" in text[:_FIRST_LETTERS]:  # every other byte of a text in UTF-16 without a mark of its order
        raise UnreadableError(_WIDE.format("UTF-16 or UTF-32"))
    return text


_FIRST_LETTERS = 4
_WIDE = "a text in {}: save it again as UTF-8 (in Notepad, Save As, Encoding)"
_MARKS = {b"\xff\xfe\0\0": "UTF-32", b"\0\0\xfe\xff": "UTF-32", b"\xff\xfe": "UTF-16", b"\xfe\xff": "UTF-16"}
_NO_TEXT = {
    b"PK\x03\x04": "is a spreadsheet, a document or a ZIP file, not a text",
    b"%PDF": "is a PDF, not a text",
    b"BLENDER": "is a file of Blender, not a text",
    b"\x28\xb5\x2f\xfd": "is a compressed file, such as one of Blender, not a text",
    b"\x1f\x8b": "is a compressed file, not a text",
}
"""What files are, by their first bytes."""


def _not_utf8(content: bytes, position: int) -> str:
    for mark, name in _MARKS.items():
        if content.startswith(mark):
            return _WIDE.format(name)
    for beginning, text in _NO_TEXT.items():
        if content.startswith(beginning):
            return text
    return f"not a text in UTF-8, at byte {position}: save it again as UTF-8"


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
