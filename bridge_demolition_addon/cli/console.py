"""What the command line shares with the system: its streams, the end of its process, and Blender where it is needed.

Standard streams outlive their reader; the clean-up of a process with Blender in it may hang or crash.
"""

import io
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from importlib import import_module
from tempfile import gettempdir
from types import ModuleType
from typing import Any, NoReturn, Self

from ..errors import SimulationError
from ..system.processor import on_one_core
from ..system.signals import interrupted_afterwards


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


def simulation_module(name: str, *, one_thread: bool = False) -> ModuleType:
    """Return a module of `simulation`: scenarios can be read and checked where Blender is not installed.

    A command that renders nothing has it with `one_thread`, where Blender was not loaded before.
    """
    gettempdir()  # a run needs it when it saves its scene: without one it is refused before it begins
    try:
        with interrupted_afterwards(), on_one_core() if one_thread else nullcontext():
            return import_module(f"...simulation.{name}", __name__)
    except ModuleNotFoundError as error:
        if error.name != "bpy":
            raise
        raise SimulationError("Blender is not there: install the bpy package or run inside Blender") from error
