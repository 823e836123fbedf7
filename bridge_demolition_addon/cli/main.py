"""Command line ``bda``: its commands, and what each kind of failure prints and returns."""

import argparse
import io
import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import NoReturn, Self

from ..core.errors import BlastError, DemolitionError, GeometryError, OutputError, ScenarioError
from . import charge, charts, check, report, run

DONE = 0
RUN_FAILED = 1
WRONG_INPUT = 2
INTERRUPTED = 130

COMMANDS = (check, run, report, charge, charts)


class UsageError(DemolitionError):
    """The command line names no command, an unknown option or lacks a needed one."""


class Parser(argparse.ArgumentParser):
    """A parser whose errors are printed as all others are: one line, without the usage."""

    def error(self, message: str) -> NoReturn:
        """Refuse a command line."""
        raise UsageError(f"{message}; see {self.prog} --help")


class _Stream(io.TextIOWrapper):
    """A standard stream whose errors name it, as those of files do."""

    @classmethod
    def of(cls, stream: io.TextIOWrapper) -> Self:
        """Return a stream in the place of another, which shows letters that a console lacks as numbers."""
        encoding, by_lines = stream.encoding, stream.line_buffering
        return cls(stream.detach(), encoding, "backslashreplace", line_buffering=by_lines)

    def write(self, text: str) -> int:
        with self._naming():
            return super().write(text)

    def flush(self) -> None:
        with self._naming():
            super().flush()

    @contextmanager
    def _naming(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            raise OSError(error.errno, error.strerror, self.name) from error


def main(argv: Sequence[str] | None = None) -> int:
    """Run a command and return the exit status.

    Parameters
    ----------
    argv
        The arguments after the program's name; by default those that Python was started with.

    Returns
    -------
    int
        0 done, 1 the run failed, 2 the input is wrong, 130 interrupted.
    """
    try:
        arguments = _parser().parse_args(argv)
        arguments.execute(arguments)
    except (UsageError, ScenarioError, GeometryError, BlastError, OutputError) as error:
        return _failed(error, WRONG_INPUT)
    except BrokenPipeError:
        raise
    except DemolitionError as error:
        return _failed(error, RUN_FAILED)
    except OSError as error:  # a full disk, for one
        return _failed(error, RUN_FAILED)
    except KeyboardInterrupt:
        _say("interrupted")
        return INTERRUPTED
    except SystemExit as leaving:  # argparse, after --help
        return leaving.code or DONE
    return DONE


def entry() -> NoReturn:
    """Run the command line and end the process with its exit status."""
    sys.stdout, sys.stderr = _Stream.of(sys.stdout), _Stream.of(sys.stderr)
    try:
        status = main()
        sys.stdout.flush()
    except BrokenPipeError:  # whoever read the output, such as head, has seen enough
        _drop_output()
        status = RUN_FAILED
    except OSError as error:
        _drop_output()
        status = _failed(error, RUN_FAILED)
    if "bpy" in sys.modules:
        os._exit(status)  # Blender's own clean-up may hang or crash when Python ends
    sys.exit(status)


def _parser() -> Parser:
    parser = Parser(prog="bda", description="Plan the demolition of a bridge.", allow_abbrev=False)
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for command in COMMANDS:
        command.add_to(commands)
    return parser


def _drop_output() -> None:
    """Send what is still to be written to standard output nowhere: Python would try again when it ends."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _failed(error: DemolitionError | OSError, status: int) -> int:
    named = isinstance(error, OSError) and error.filename is not None
    text = f"{error.filename}: {error.strerror}" if named else str(error)
    _say(f"error: {' '.join(text.split())}")
    return status


def _say(text: str) -> None:
    with suppress(OSError):  # where not even this can be written, the status has to say it
        print(f"bda: {text}", file=sys.stderr, flush=True)
