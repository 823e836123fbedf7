"""``bda report``: write what an engineer hands over, from the folder of a run or of several side by side."""

import argparse
import sys
from pathlib import Path

from ..model.run_folder.files import SINGLE_PAGES
from .arguments import add_report_options
from .progress import progress_on

_ALL = "all"


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "report",
        description="From one folder: a report beside its results. From several: a comparison, in --output.",
        allow_abbrev=False,
    )
    parser.add_argument(
        "folders",
        metavar="DIR",
        type=Path,
        nargs="+",
        help="folder that bda run, study, search, optimise or stages made",
    )
    parser.add_argument("--output", metavar="DIR", type=Path, help="folder for the report (the run's own)")
    parser.add_argument("--trajectories", action="store_true", help="draw the paths of the shards on the map of debris")
    parser.add_argument(
        "--stages", action="store_true", help="work out the stages of the run's scenario first, for a chapter on them"
    )
    parser.add_argument("--docx", action="store_true", help="also write it as a Word file (needs python-docx)")
    parser.add_argument(
        "--pages",
        metavar="WHO",
        type=_audiences,
        default=(),
        help=f"also write single pages of a run or a study: {', '.join(SINGLE_PAGES)}, with commas between, or all",
    )
    add_report_options(parser)
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.set_defaults(execute=report)


def _audiences(text: str) -> tuple[str, ...]:
    """Return for whom pages are asked."""
    names = tuple(name.strip() for name in text.split(","))
    if names == (_ALL,):
        return tuple(SINGLE_PAGES)
    for name in names:
        if name not in SINGLE_PAGES:
            raise argparse.ArgumentTypeError(f"is {name!r}: expected {', '.join(SINGLE_PAGES)} or {_ALL}")
    return names


def report(arguments: argparse.Namespace) -> None:
    """Write the report and say where it is."""
    # Loading matplotlib takes a second, which the other commands need not wait.
    from ..report.write import write_report

    progress = progress_on(sys.stdout, quiet=arguments.quiet)
    try:
        written = write_report(
            arguments.folders,
            arguments.output,
            trajectories=arguments.trajectories,
            stages=arguments.stages,
            word=arguments.docx,
            pages=arguments.pages,
            language=arguments.language,
            units=arguments.units,
            progress=progress,
        )
    finally:
        progress.finish()
    if not arguments.quiet:
        for path in written:
            print(path)
