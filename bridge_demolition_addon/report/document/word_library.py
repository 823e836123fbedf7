"""python-docx, which writes Word files: an extra that a report without a Word file does not need.

A module of its own, as panels ask for it while matplotlib is not loaded.
"""

from __future__ import annotations

from importlib.util import find_spec

from ...errors import MissingLibraryError

WORD_LIBRARY = "docx"
"""Name that python-docx is imported by."""


def word_is_there() -> bool:
    """Return whether this Python has the library."""
    return find_spec(WORD_LIBRARY) is not None


def check_word() -> None:
    """Make sure that the library is there."""
    if not word_is_there():
        raise MissingLibraryError(
            "a Word file is written by python-docx, which this Python does not have: pip install "
            "'bridge-demolition-addon[word]', or use bda report --docx where that is installed"
        )
