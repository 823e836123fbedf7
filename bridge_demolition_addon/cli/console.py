"""Standard streams that outlive their reader, and the end of a process whose clean-up may hang or crash."""

import io
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, NoReturn, Self


class StandardStream(io.TextIOWrapper):
    """A standard stream that goes nowhere once its reader, such as ``head``, has gone. Other errors name it."""

    @classmethod
    def of(cls, stream: Any) -> Self:
        """Return a stream in the place of another, which shows letters that a console lacks as numbers."""
        encoding, by_lines = stream.encoding, stream.line_buffering
        return cls(stream.detach(), encoding, "backslashreplace", line_buffering=by_lines)

    def write(self, text: str) -> int:
        with self._outliving():
            super().write(text)
        return len(text)

    def flush(self) -> None:
        with self._outliving():
            super().flush()

    def drop(self) -> None:
        """Send all that is still to be written nowhere, also what Blender writes past Python."""
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, self.fileno())
        os.close(nowhere)

    @contextmanager
    def _outliving(self) -> Iterator[None]:
        try:
            yield
        except BrokenPipeError:
            self.drop()
        except OSError as error:
            raise OSError(error.errno, error.strerror, self.name) from error


def end_process(status: int) -> NoReturn:
    """End this process, with Blender in it, at once with an exit status. Nothing is flushed or cleaned up.

    Windows informs all libraries of a process even when it ends by `os._exit`; Blender's then prints memory that was
    not freed as an error, to users who can do nothing about it. A process that is terminated informs none.
    """
    if sys.platform == "win32":
        import ctypes

        kernel = ctypes.WinDLL("kernel32")
        kernel.GetCurrentProcess.restype = ctypes.c_void_p
        kernel.TerminateProcess.argtypes = (ctypes.c_void_p, ctypes.c_uint)
        kernel.TerminateProcess(kernel.GetCurrentProcess(), status)
    os._exit(status)
