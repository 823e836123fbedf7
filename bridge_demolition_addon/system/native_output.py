"""What Blender prints past Python, without the lines that say nothing to the user."""

from __future__ import annotations

import ctypes
import io
import os
import re
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout, suppress

_SILENT = re.compile(
    r"(\d+:\d\d\.\d{3}  \S+ +\| )?"  # what Blender 5 begins its lines with: time and category
    r"("
    r"(Info: )?Saved (as )?\".*\""
    r"|Saved: '.*'"
    r"|Time: \d+:\d\d\.\d\d \(Saving: .*\)"
    r"|EGL Error \(0x3009\): EGL_BAD_MATCH: .*"  # no screen: Blender then renders without one, as it has to
    r"|"
    r")\s*"
)
"""Whole lines that are left out: files that were saved, and what Blender tries before it renders without a screen."""


@contextmanager
def without_noise() -> Iterator[None]:
    """Leave lines of `_SILENT` out of what is printed within; all others appear after it, in their streams.

    What Blender prints does not pass through Python, so the descriptors of the process lead to files meanwhile. If the
    process is killed, what it said since then is lost.
    """
    said = io.StringIO()
    try:
        with _without_noise(1), _without_noise(2), redirect_stdout(said):
            yield
    finally:
        sys.stdout.write("".join(map(_kept, said.getvalue().splitlines(keepends=True))))


@contextmanager
def _without_noise(descriptor: int) -> Iterator[None]:
    try:
        original = os.dup(descriptor)
    except OSError:  # it leads nowhere, as in a window of Windows
        yield
        return
    with tempfile.TemporaryFile() as file:
        _flush()
        os.dup2(file.fileno(), descriptor)
        try:
            yield
        finally:
            _flush()
            os.dup2(original, descriptor)
            os.close(original)
            file.seek(0)
            lines = file.read().decode(errors="surrogateescape").splitlines(keepends=True)
            _write(descriptor, "".join(map(_kept, lines)).encode(errors="surrogateescape"))


def _kept(line: str) -> str:
    return "" if _SILENT.fullmatch(line) else line


def _flush() -> None:
    """Write what Python and the C library hold back, each to where its descriptor leads now."""
    for stream in (sys.stdout, sys.stderr):
        stream.flush()
    ctypes.CDLL("ucrtbase" if sys.platform == "win32" else None).fflush(None)


def _write(descriptor: int, content: bytes) -> None:
    with suppress(BrokenPipeError):  # its reader, such as `head`, has gone
        while content:
            content = content[os.write(descriptor, content) :]
