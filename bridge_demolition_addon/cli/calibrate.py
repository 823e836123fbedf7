"""``bda calibrate``: the law by which the ground of a site carries vibration, from events that were measured there."""

import argparse
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..engineering.blast.site_law import CONFIDENCE, SiteLaw
from ..errors import OutputError
from ..model.blast.site_events import SiteEvents, law_of_file
from ..model.blast.vibration_laws import OF_CHARGES, law_text

_ROWS = 5
_OF = {OF_CHARGES: "charges within a delay, Q in kg"}
_FALL = "what falls, Q its energy in kJ"


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "calibrate",
        description="Fits v = K (R/√Q)^-b to the events of a test blast or a drop test, and prints it as a table for a "
        "scenario file, with the band in which 95 % of new events lie. The first row of the file has heads with units, "
        "such as Distance (m), Charge (kg) or Mass (t) and Height (m), PPV (mm/s). See docs/ground_motion.md.",
        allow_abbrev=False,
    )
    parser.add_argument("events", metavar="EVENTS.csv", type=Path, help="table of events, one in each row")
    parser.add_argument("--output", metavar="LAW.toml", type=Path, help="new file for the table, too")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.set_defaults(execute=calibrate)


def calibrate(arguments: argparse.Namespace) -> None:
    """Print the law of a site; write its table, too, where a file is asked for."""
    events, law = law_of_file(arguments.events)
    table = law_text(law, events.of)
    if arguments.output:
        try:
            with arguments.output.open("x", encoding="utf-8", newline="\n") as file:
                file.write(table)
        except FileExistsError as error:
            raise OutputError(f"{arguments.output} is there already: expected a new file") from error
    if not arguments.quiet:
        for line in (*_lines(events, law), "", *table.splitlines()):
            print(line)


def _lines(events: SiteEvents, law: SiteLaw) -> Iterator[str]:
    unit = "m/√kg" if events.of == OF_CHARGES else "m/√kJ"
    yield f"v = {1e3 * law.velocity_m_s:.4g} mm/s (R/√Q)^-{law.exponent:.3g}, for {_OF.get(events.of, _FALL)}"
    yield f"{law.events} events, scatter of a factor of {float(np.exp(law.scatter)):.2f} (one standard deviation)"
    if events.frequencies_hz is not None:
        lowest, highest = events.frequencies_hz.min(), events.frequencies_hz.max()
        yield f"frequencies from {lowest:.3g} to {highest:.3g} Hz"
    yield ""
    yield f"{f'R/√Q, {unit}':<16}{'v, mm/s':>12}{f'{100 * CONFIDENCE:g} % of new events, mm/s':>36}"
    for scaled in np.geomspace(law.nearest, law.farthest, _ROWS):
        low, middle, high = (1e3 * float(of(scaled, 1.0)) for of in (law.at_least, law.velocity, law.at_most))
        yield f"{scaled:<16.3g}{middle:>12.3g}{f'{low:.3g} to {high:.3g}':>36}"
    yield "Nearer and farther than these it is extrapolated, and reports say so."
