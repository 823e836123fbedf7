"""``bda compare``: compare a survey of the debris with the forecast of a run."""

import argparse
import math
import sys
from pathlib import Path

from ..model.run_folder.files import SURVEY_FOLDER
from .arguments import add_report_options, quantity
from .progress import progress_on


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "compare",
        description="Says how heights and footprints of debris agree, and makes a report. See docs/survey.md.",
        allow_abbrev=False,
    )
    parser.add_argument("run", metavar="RUN", type=Path, help="folder of a run")
    parser.add_argument(
        "--survey",
        metavar="FILE",
        type=Path,
        required=True,
        help="scan of the site: LAS, LAZ, PLY, XYZ, CSV, ASC, TIF or a mesh",
    )
    parser.add_argument(
        "--origin",
        metavar=("EASTING", "NORTHING", "HEIGHT"),
        type=_number,
        nargs=3,
        help="where the scenario's origin is in the scan, in its units (that of the ground)",
    )
    parser.add_argument(
        "--bearing", metavar="DEG", type=_number, help="direction of the x axis, clockwise from the scan's north"
    )
    parser.add_argument("--scale", metavar="METRES", type=quantity, help="metres in one unit of the scan")
    parser.add_argument("--cell", metavar="METRES", type=quantity, default=0.5, help="side of the cells in plan (0.5)")
    parser.add_argument(
        "--above", metavar="METRES", type=quantity, default=0.2, help="height from which on something is debris (0.2)"
    )
    parser.add_argument(
        "--limit", metavar="METRES", type=quantity, help="distance from the bridge that debris was to keep to"
    )
    parser.add_argument(
        "--output", metavar="DIR", type=Path, help=f"folder for the report ({SURVEY_FOLDER} in the run)"
    )
    add_report_options(parser)
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.set_defaults(execute=compare)


def compare(arguments: argparse.Namespace) -> None:
    """Compare, say how they agree, and where the report is."""
    # Loading matplotlib takes a second, which the other commands need not wait.
    from ..model.debris.survey import SurveySettings
    from ..report.write import write_survey

    settings = SurveySettings(cell_m=arguments.cell, above_m=arguments.above, limit_m=arguments.limit)
    progress = progress_on(sys.stderr, quiet=arguments.quiet)
    try:
        rows, written = write_survey(
            arguments.run,
            arguments.survey,
            (arguments.origin, arguments.bearing, arguments.scale),
            settings,
            arguments.output or arguments.run / SURVEY_FOLDER,
            progress,
            arguments.language,
            arguments.units,
        )
    finally:
        progress.finish()
    if not arguments.quiet:
        for name, value in rows:
            print(f"{name:<30}{value}")
        for path in written:
            print(path)


def _number(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise argparse.ArgumentTypeError(f"{text!r} is wrong: expected a number")
    return number
