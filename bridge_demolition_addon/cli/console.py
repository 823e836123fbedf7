"""Standard streams that outlive their reader, and say their name where they cannot be written."""

import io
import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Self


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
