"""Files that a kill, a full disk or another process may hit: written whole or not at all, or known to be gone."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..errors import OutputError


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """Give a file next to a path to write to, and have it take the place of the path once it is on the disk.

    The file at the path stays until then, and stays where writing fails; an error of the system names the path.
    """
    part = part_of(path)
    part.unlink(missing_ok=True)  # what was killed, or who made this folder, may have left a file or a link there
    try:
        yield part
        with part.open("rb+") as written:
            os.fsync(written.fileno())  # some file systems say only now that the disk is full
        os.replace(part, path)
    except BaseException as error:
        part.unlink(missing_ok=True)
        if isinstance(error, OSError) and error.errno and error.filename in (None, part, str(part)):
            raise OSError(error.errno, error.strerror, str(path)) from error
        raise


@contextmanager
def whole_folder(path: Path) -> Iterator[Path]:
    """Give a new folder next to a path to write to, and have it take the place of the path once all is in it.

    There must be nothing at the path. Where writing fails, nothing is left; an error of the system that does not say
    more names the path.
    """
    part = part_of(path)
    try:
        part.mkdir()
    except FileExistsError as error:
        raise FileExistsError(
            error.errno, "left by something that was killed while it wrote; delete it", str(part)
        ) from error
    try:
        yield part
        os.rename(part, path)
    except BaseException as error:
        shutil.rmtree(part, ignore_errors=True)
        if isinstance(error, OSError) and error.errno and str(error.filename or part).startswith(str(part)):
            raise OSError(error.errno, error.strerror, str(path)) from error
        raise


def part_of(path: Path) -> Path:
    """Return where a file is written until it is whole; its ending is kept, as that may choose the format."""
    return path.with_name(f"{path.stem}.part{path.suffix}")


def write_whole_text(path: Path, text: str, *, encoding: str = "utf-8", newline: str | None = None) -> None:
    """Write a text file whole or not at all."""
    with whole_file(path) as part:
        part.write_text(text, encoding=encoding, newline=newline)


def own_folder(path: Path) -> Path:
    """Make a folder inside one that is written to, if it is not there, and return it; a link is refused."""
    check_no_link(path)
    path.mkdir(exist_ok=True)
    return path


def check_no_link(path: Path) -> None:
    """Refuse a link: what is written or deleted there would be elsewhere. The folder may be from someone else."""
    if path.is_symlink():
        raise OutputError(
            f"{path}: is a link, to {os.readlink(path)}: expected no link, as files of this folder are written there; "
            "delete it, or choose another folder"
        )


def is_in_place(descriptor: int, path: Path) -> bool:
    """Return whether an open file is the one at a path, neither moved nor deleted with its folder or by itself."""
    try:
        return os.path.samestat(os.fstat(descriptor), path.stat())
    except (FileNotFoundError, NotADirectoryError):
        return False


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Raise `OutputError` with a path that cannot be written, where the block fails for it."""
    try:
        yield
    except OSError as error:
        raise OutputError(f"{path}: cannot be written ({error.strerror})") from error
