"""``bda charts``: draw the charts to choose charges by, as pictures in a folder."""

import argparse
import sys
from contextlib import nullcontext
from functools import partial
from pathlib import Path

from ..engineering.blast.pulses import BlastModel
from ..engineering.blast.wave import Burst
from ..model.blast.charges import LARGEST_CHARGE_KG
from ..system.progress import Progress
from .arguments import add_blast_options, quantity
from .progress import StepsOfLongWork


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser("charts", allow_abbrev=False)
    parser.add_argument("--output", metavar="DIR", type=Path, default="charts", help="folder, made if new (charts)")
    parser.add_argument("--unit", choices=["kpa", "ratio"], default="kpa", help="overpressure in kPa, or over ambient")
    parser.add_argument("--scaled", action="store_true", help="distances and times divided by the charge's cube root")
    parser.add_argument(
        "--pulse-kg", type=quantity, default=1e4, metavar="W", help="TNT whose pulses are drawn over time (10000)"
    )
    parser.add_argument(
        "--pier-kg",
        type=partial(quantity, largest=LARGEST_CHARGE_KG),
        default=1e3,
        metavar="W",
        help="TNT at each pier of the bridge of two spans (1000)",
    )
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    add_blast_options(parser)
    parser.set_defaults(execute=charts)


def charts(arguments: argparse.Namespace) -> None:
    """Draw the charts and say where they are."""
    # Loading matplotlib takes a second, which the other commands need not wait.
    from ..charts.blast_design import CHARTS, ChartSettings, write_charts

    settings = ChartSettings(
        model=BlastModel(arguments.model),
        burst=Burst(arguments.burst),
        as_ratio=arguments.unit == "ratio",
        scaled=arguments.scaled,
        pulse_charge_kg=arguments.pulse_kg,
        pier_charge_kg=arguments.pier_kg,
    )
    with nullcontext(Progress()) if arguments.quiet else StepsOfLongWork(sys.stderr, len(CHARTS)) as progress:

        def drawn(count: int, of: int) -> None:
            if count < of:
                progress.stage("draws the charts")

        drawn(0, len(CHARTS))
        paths = write_charts(arguments.output, settings, drawn)
    if not arguments.quiet:
        for path in paths:
            print(path)
