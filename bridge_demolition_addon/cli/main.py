"""Command line ``bda``: its commands, and what each kind of failure prints and returns."""

import argparse
import re
import signal
import sys
from collections.abc import Sequence
from contextlib import suppress
from difflib import get_close_matches
from importlib import import_module
from typing import NamedTuple, NoReturn

from ..errors import (
    BlastError,
    ClusterError,
    DemolitionError,
    GeometryError,
    IfcError,
    MissingLibraryError,
    OutputError,
    ScenarioError,
    text_of,
)
from ..system.signals import Interrupted, ignore_from_now_on, interrupt_by_system, interrupted_afterwards
from ..version import VERSION
from .console import StandardStream, end_process

DONE = 0
RUN_FAILED = 1
WRONG_INPUT = 2
SIGNALLED = 128
"""Added to the number of the signal that ended a command, as shells do: 130 for Ctrl-C."""


class Command(NamedTuple):
    """A command: its module in this folder, and what it does, as the list of commands says."""

    module: str
    does: str


COMMANDS = {
    "new": Command("new", "write a scenario to start from, by six questions"),
    "explain": Command("explain", "print what a key of a file means, and which values it takes"),
    "check": Command("check", "read a scenario and say what follows from it"),
    "import": Command("exchange.import_ifc", "make a scenario of a bridge in an IFC file"),
    "run": Command("run", "run a scenario and keep its results in a folder"),
    "stages": Command(
        "stages", "say how the bridge stands between the steps of its demolition, and which members hold it"
    ),
    "plan": Command("plan", "write the charge plan of a scenario with blast zones, without running it"),
    "study": Command("study", "run a scenario many times with inputs that vary by chance"),
    "search": Command(
        "search", "find the charge, drop height or strength at which a demolition succeeds as often as it has to"
    ),
    "optimise": Command(
        "search",
        "find the charges, delays, positions or order of steps that do best, where a demolition has to succeed",
    ),
    "report": Command("report", "make a report, as a page, a PDF and a Word file, from the folder of a run"),
    "export": Command("exchange.export", "write a run for ParaView, spreadsheets, browsers or programs for films"),
    "section": Command("section", "cut the debris of a run by an upright plane, and draw what is cut"),
    "compare": Command("compare", "compare a scan of the debris with the forecast of a run"),
    "charge": Command(
        "charge", "find the smallest charge for a wanted load, or the effects of a charge around it or in drill holes"
    ),
    "charts": Command("charts", "draw the charts to choose charges by"),
    "calibrate": Command("calibrate", "fit the law by which the ground of a site shakes to events measured there"),
}


class UsageError(DemolitionError):
    """The command line names no command, an unknown option or lacks a needed one."""


class Parser(argparse.ArgumentParser):
    """A parser whose errors are printed as all others are: one line, without the usage."""

    @property
    def options(self) -> list[str]:
        """Names of the options, groups included: a wrong one may be like one of them."""
        return [name for name in self._option_string_actions if name.startswith("--")]

    def error(self, message: str) -> NoReturn:
        """Refuse a command line."""
        raise UsageError(f"{message}; see {self.prog} --help")


def main(argv: Sequence[str] | None = None) -> int:
    """Run a command, by default the one in Python's arguments, and return the exit status.

    0 done, 1 the run failed, 2 the input is wrong, 130 interrupted; 143 where the system asked for the end, 129 where
    the terminal was closed.
    """
    try:
        arguments = _arguments(sys.argv[1:] if argv is None else argv)
        arguments.execute(arguments)
    except (
        UsageError,
        ScenarioError,
        GeometryError,
        BlastError,
        ClusterError,
        IfcError,
        MissingLibraryError,
        OutputError,
    ) as error:
        return _failed(error, WRONG_INPUT)
    except (DemolitionError, OSError) as error:  # a full disk, for one
        return _failed(error, RUN_FAILED)
    except KeyboardInterrupt as interruption:
        _say("interrupted")
        return SIGNALLED + (interruption.signal_number if isinstance(interruption, Interrupted) else signal.SIGINT)
    except SystemExit as leaving:  # argparse, after --help
        return int(leaving.code or DONE)
    return DONE


def entry() -> NoReturn:
    """Run the command line and end the process with its exit status."""
    sys.stdout, sys.stderr = StandardStream.of(sys.stdout), StandardStream.of(sys.stderr)
    interrupt_by_system()
    try:
        status = main()
        sys.stdout.flush()
    except OSError as error:
        sys.stdout.drop()  # or Python would try again when it ends
        status = _failed(error, RUN_FAILED)
    ignore_from_now_on()
    if "bpy" in sys.modules:
        end_process(status)
    sys.exit(status)


def _arguments(words: Sequence[str]) -> argparse.Namespace:
    """Return the arguments of a command line, or say what was meant by one that is wrong."""
    if words and words[0] not in COMMANDS and not words[0].startswith("-"):
        raise UsageError(f"{_unknown_command(words[0])}; see bda --help")
    parser, parsers = _parser(words)
    known = [option for command in parsers for option in command.options]
    try:
        arguments, unknown = parser.parse_known_args(words)
    except UsageError as error:  # what is missing may be there under another name, or without one
        if meant := _meant_by(parser, words, str(error)):
            raise UsageError(f"{meant}; see bda {words[0]} --help") from error
        unknown = [word for word in words[1:] if word.startswith("--") and word.partition("=")[0] not in known]
        if not unknown:
            raise
    if unknown:
        raise UsageError(f"{_unknown_arguments(unknown, known)}; see bda {words[0]} --help")
    return arguments


def _meant_by(parser: Parser, words: Sequence[str], error: str) -> str:
    """Return what to write where an option is missing, and its value stands without its name; empty if it does not."""
    missing = re.search(r"are required: (--[\w-]+);", error)
    if missing is None:
        return ""
    with suppress(UsageError):
        _, left = parser.parse_known_args([*words, missing[1], "1"])
        if len(left) == 1 and not left[0].startswith("-"):
            return f"{missing[1]} is missing: write {missing[1]} {left[0]}"
    return ""


def _unknown_command(word: str) -> str:
    if word.endswith(".toml"):
        return f"{word} stands where a command is expected: write bda run {word} or bda check {word}"
    alike = get_close_matches(word, COMMANDS, n=1)
    return f"{word!r} is no command: " + (f"did you mean {alike[0]}?" if alike else f"expected {', '.join(COMMANDS)}")


def _unknown_arguments(unknown: Sequence[str], known: Sequence[str]) -> str:
    alike = get_close_matches(unknown[0].partition("=")[0], known, n=1) if unknown[0].startswith("-") else []
    return f"unrecognized arguments: {' '.join(unknown)}" + (f": did you mean {alike[0]}?" if alike else "")


def _parser(argv: Sequence[str]) -> tuple[Parser, list[Parser]]:
    """Return the parser of the called command, or of every command; a list of commands needs none."""
    parser = Parser(prog="bda", description="Plan the demolition of a bridge.", allow_abbrev=False)
    parser.add_argument("--version", action="version", version=f"bda {VERSION}", help="print the version")
    if argv[:1] == ["--version"]:
        return parser, []
    commands = parser.add_subparsers(title="commands", metavar="COMMAND", required=True)
    if not argv or argv[0] in ("-h", "--help"):
        for name, command in COMMANDS.items():
            commands.add_parser(name, help=command.does)
        return parser, []
    called = argv[:1] if argv[0] in COMMANDS else COMMANDS
    with interrupted_afterwards():  # while they load, some libraries take an interrupt for a missing part
        for module in dict.fromkeys(COMMANDS[name].module for name in called):
            import_module(f".{module}", __package__).add_to(commands)
    return parser, [command for command in commands.choices.values() if isinstance(command, Parser)]


def _failed(error: DemolitionError | OSError, status: int) -> int:
    """Print each fault of an error as one line."""
    for fault in error.faults if isinstance(error, ScenarioError) else [text_of(error)]:
        _say(f"error: {' '.join(fault.split())}")
    return status


def _say(text: str) -> None:
    with suppress(OSError):  # where not even this can be written, the status has to say it
        print(f"bda: {text}", file=sys.stderr, flush=True)
