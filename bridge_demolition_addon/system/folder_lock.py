"""One writer at a time: a process that writes to a folder locks it against all others."""

from __future__ import annotations

import io
import os
import platform
import sys
from contextlib import suppress
from datetime import datetime
from pathlib import Path
from types import TracebackType
from typing import Self

from ..errors import OutputError
from .disk import check_no_link, is_in_place, writing

LOCK_FILE = "run.lock"
"""Keeps others out of the folder while one writes to it; gone, or of no effect, afterwards."""

_LONGEST_HOLDER = 500
"""Bytes that are read of a lock."""

if sys.platform == "win32":
    import msvcrt

    _LOCKED_BYTE = 1 << 20  # beyond the text, which others have to be able to read

    def _lock(descriptor: int) -> None:
        os.lseek(descriptor, _LOCKED_BYTE, os.SEEK_SET)
        msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
        os.lseek(descriptor, 0, os.SEEK_SET)

else:
    import fcntl

    def _lock(descriptor: int) -> None:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)


class FolderLock:
    """An existing folder that only its holder writes to, from when this is made until it is released.

    The system holds the lock as long as the process lives. A killed process leaves a file without effect, which the
    next one takes over. `is_new` says whether the folder was made for this holder, `work` in a word or two what it does
    there: ages of files would not say which of two began first, as a clock may be set back.
    """

    def __init__(self, folder: Path, *, is_new: bool = False, work: str = "") -> None:
        self.folder, self.is_new = folder, is_new
        self._path = folder / LOCK_FILE
        with writing(folder):
            self._file = _locked_file(self._path)
            since = f"since {datetime.now():%Y-%m-%d %H:%M:%S}"
            holder = ", ".join(filter(None, (f"process {os.getpid()} on {platform.node()}", since, work)))
            self._file.truncate(0)
            self._file.write(holder.encode())

    @property
    def in_place(self) -> bool:
        """Whether the folder is still where it was; it may have been moved or deleted."""
        return is_in_place(self._file.fileno(), self._path)

    def release(self) -> None:
        """Let others write to the folder."""
        if self._file.closed:
            return
        in_place = self.in_place
        if in_place and sys.platform != "win32":  # where no open file can be removed
            self._path.unlink(missing_ok=True)
        self._file.close()
        if in_place and sys.platform == "win32":
            with suppress(PermissionError):  # another process has opened it in between, and owns it now
                self._path.unlink(missing_ok=True)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.release()


def check_unlocked(folder: Path) -> None:
    """Raise `OutputError` where a process writes to a folder; nothing in it is changed."""
    path = folder / LOCK_FILE
    if path.is_file():
        with writing(folder), path.open("rb+", buffering=0) as file:
            _take(file.fileno(), path)


def writer_in(folder: Path) -> str | None:
    """Return the process that writes to a folder, None where none does or it is unknown; nothing is changed."""
    path = folder / LOCK_FILE
    if not path.is_file():
        return None
    try:
        file = path.open("rb", buffering=0)
    except OSError:  # it has gone just now, or this user may not read it
        return None
    with file:
        try:
            _take(file.fileno(), path)
        except OutputError:
            return _holder(path)
    return None


def _locked_file(path: Path) -> io.FileIO:
    """Open and lock the file; one that its holder has removed meanwhile is no lock, and another is made."""
    while True:
        check_no_link(path)
        file = open(path, "ab+", buffering=0, opener=_opened)  # noqa: SIM115 - it stays open as long as the lock
        try:
            if os.fstat(file.fileno()).st_nlink > 1:
                raise OutputError(f"{path}: is a file of another name, too: expected the lock alone; delete it")
            _take(file.fileno(), path)
        except BaseException:
            file.close()
            raise
        if is_in_place(file.fileno(), path):
            return file
        file.close()


def _opened(path: str, flags: int) -> int:
    return os.open(path, flags | getattr(os, "O_NOFOLLOW", 0), 0o666)


def _take(descriptor: int, path: Path) -> None:
    try:
        _lock(descriptor)
    except (BlockingIOError, PermissionError) as error:
        raise OutputError(
            f"{path.parent}: is being written to by {_holder(path)}: wait for its end, or choose another folder"
        ) from error


def _holder(path: Path) -> str:
    with path.open("rb") as file:
        return file.read(_LONGEST_HOLDER).decode(errors="replace") or "a process that has just begun"
