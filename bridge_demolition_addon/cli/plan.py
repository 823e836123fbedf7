"""``bda plan``: write the charge plan of a scenario, as a page, a PDF, tables and a workbook."""

import argparse
import sys
from pathlib import Path

from ..errors import ScenarioError
from ..model.scenario.file import read_scenario
from .arguments import add_report_options, naming
from .progress import progress_on


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "plan",
        description="Write drill holes, charges, firing sequence, totals, neighbours and fragments as a page, a PDF, "
        "tables (CSV) and a workbook (XLSX), see docs/drilled_charges.md.",
        allow_abbrev=False,
    )
    parser.add_argument("scenario", metavar="SCENARIO.toml", type=Path, help="scenario file with [[blast_zones]]")
    parser.add_argument("--output", metavar="DIR", type=Path, required=True, help="folder for the plan, made if new")
    add_report_options(parser)
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.set_defaults(execute=plan)


def plan(arguments: argparse.Namespace) -> None:
    """Write the charge plan and say where it is."""
    # Loading matplotlib takes a second, which the other commands need not wait.
    from ..report.write import write_charge_plan

    scenario = read_scenario(arguments.scenario)
    if not (scenario.blast_zones or scenario.cuts):
        raise ScenarioError(
            f"{arguments.scenario}: has no [[blast_zones]] and no [[cuts]], which a charge plan is made from"
        )
    progress = progress_on(sys.stdout, quiet=arguments.quiet)
    try:
        with naming(arguments.scenario):
            written = write_charge_plan(scenario, arguments.output, progress, arguments.language, arguments.units)
    finally:
        progress.finish()
    if not arguments.quiet:
        for path in written:
            print(path)
