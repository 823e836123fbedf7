"""``bda run``: run a scenario and keep its results in a folder."""

import argparse
import os
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import Any

from ..core.errors import SimulationError
from ..core.scenario import Scenario
from ..core.scenario.file import read_scenario
from ..simulation.output import RESULT_FILES
from .progress import Progress, progress_on


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser("run", help="run a scenario and keep its results in a folder", allow_abbrev=False)
    parser.add_argument("scenario", metavar="SCENARIO.toml", help="scenario file, see docs/scenario.md")
    parser.add_argument("--output", metavar="DIR", type=Path, required=True, help="folder for the results, made if new")
    parser.add_argument("--overwrite", action="store_true", help="replace the results of an earlier run in that folder")
    parser.add_argument("--no-pictures", action="store_true", help="render no pictures")
    parser.add_argument(
        "--film", action="store_true", help="make a film with contours of force, contours.mp4; it takes minutes"
    )
    parser.add_argument("--report", action="store_true", help="make a report of the run at its end")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.set_defaults(execute=run)


def run(arguments: argparse.Namespace) -> None:
    """Run the scenario, say how far it is, and then where the results are."""
    scenario = read_scenario(arguments.scenario)
    progress = progress_on(sys.stdout, quiet=arguments.quiet)
    try:
        with _blender_silenced() if arguments.quiet else nullcontext():
            summary = _run_scenario(scenario, arguments, progress)
            report = _report(arguments, progress) if arguments.report else []
    finally:
        progress.finish()
    if not arguments.quiet:
        _print_results(summary, arguments.output, report)


def _run_scenario(scenario: Scenario, arguments: argparse.Namespace, progress: Progress) -> Mapping[str, Any]:
    try:
        from ..simulation.run import run_scenario  # a scenario can be checked where Blender is not installed
    except ModuleNotFoundError as error:
        if error.name != "bpy":
            raise
        raise SimulationError("Blender is not there: install the bpy package or run inside Blender") from error
    return run_scenario(
        scenario,
        arguments.output,
        overwrite=arguments.overwrite,
        pictures=not arguments.no_pictures,
        film=arguments.film,
        progress=progress,
    )


@contextmanager
def _blender_silenced() -> Iterator[None]:
    """Drop what is written to standard output, also past Python: Blender tells of each file it saves."""
    sys.stdout.flush()
    standard_output = os.dup(1)
    with open(os.devnull, "wb") as nowhere:
        os.dup2(nowhere.fileno(), 1)
    try:
        yield
    finally:
        sys.stdout.flush()  # Blender says part of it through Python
        os.dup2(standard_output, 1)
        os.close(standard_output)


def _report(arguments: argparse.Namespace, progress: Progress) -> list[Path]:
    from ..report.write import write_report

    return write_report([arguments.output], None, progress=progress)


def _print_results(summary: Mapping[str, Any], output: Path, report: Sequence[Path]) -> None:
    print()
    for name, value in _result_facts(summary):
        print(f"{name:<24}{value}")
    print()
    for path in (output / name for name in RESULT_FILES):
        if path.exists() and path not in report:
            print(path)
    for path in report:
        print(path)


def _result_facts(summary: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    connections, force = summary["connections"], summary["largest_force_sum"]
    yield "broken connections", f"{connections['broken']} of {connections['count']}"
    if force:
        place = f"on {force['body']} at {force['time_s']:.3f} s"
        yield "largest sum of forces", f"{force['force_N'] / 1000.0:.1f} kN {place}"
    if impact := summary["impact"]:
        yield "impact of the ball", f"{impact['time_s']:.3f} s, frame {impact['frame']}"
    if summary["came_to_rest_s"] is not None:
        yield "everything rests from", f"{summary['came_to_rest_s']:.3f} s"
    if throw := summary["largest_throw"]:
        yield "largest throw", f"{throw['throw_m']:.2f} m, {throw['body']}"
