"""``bda export``: write a run in the files of other programs."""

import argparse
import sys
from pathlib import Path

from ...exports.formats import FORMATS, new_export
from ..progress import progress_on


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "export",
        description="Write a run in the files of another program: all bodies in every frame.",
        allow_abbrev=False,
    )
    parser.add_argument("folder", metavar="RUN", type=Path, help="folder that bda run made")
    parser.add_argument(
        "--to",
        required=True,
        choices=list(FORMATS),
        help="; ".join(f"{form.name}: {form.content}" for form in FORMATS.values()),
    )
    parser.add_argument(
        "--output",
        metavar="PATH",
        type=Path,
        help="new file, or new folder where many are written (export in the folder of the run, counted up)",
    )
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.set_defaults(execute=export)


def export(arguments: argparse.Namespace) -> None:
    """Write the files and say where they are."""
    from ...exports.write import export_run  # what a format needs is loaded only where it is written

    form = FORMATS[arguments.to]
    output = arguments.output or new_export(arguments.folder, form)
    progress = progress_on(sys.stdout, quiet=arguments.quiet)
    try:
        export_run(arguments.folder, form, output, progress)
    finally:
        progress.finish()
    if not arguments.quiet:
        print(output)
