"""Command line ``bda``: its commands, and what each kind of failure prints and returns."""

import argparse
import os
import sys
from collections.abc import Sequence
from typing import NoReturn

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
    except (DemolitionError, OSError) as error:  # a full disk, for one
        return _failed(error, RUN_FAILED)
    except KeyboardInterrupt:
        print("bda: interrupted", file=sys.stderr)
        return INTERRUPTED
    except SystemExit as leaving:  # argparse, after --help
        return leaving.code or DONE
    return DONE


def entry() -> NoReturn:
    """Run the command line and end the process with its exit status."""
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="backslashreplace")  # a title may hold letters that the console lacks
    try:
        status = main()
        sys.stdout.flush()
    except BrokenPipeError:  # whoever read the output, such as head, has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        status = RUN_FAILED
    sys.stderr.flush()
    if "bpy" in sys.modules:
        os._exit(status)  # Blender's own clean-up may hang or crash when Python ends
    sys.exit(status)


def _parser() -> Parser:
    parser = Parser(prog="bda", description="Plan the demolition of a bridge.", allow_abbrev=False)
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    for command in COMMANDS:
        command.add_to(commands)
    return parser


def _failed(error: DemolitionError | OSError, status: int) -> int:
    print(f"bda: error: {' '.join(str(error).split())}", file=sys.stderr)
    return status
