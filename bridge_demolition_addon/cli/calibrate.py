"""``bda calibrate``: the law by which the ground of a site carries vibration, from events that were measured there."""

import argparse
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ..engineering.blast.site_law import CONFIDENCE, SiteLaw, scaled_by_root, station_distances_m
from ..engineering.units import STANDARD_GRAVITY_M_S2
from ..errors import BlastError, OutputError
from ..model.blast.site_events import SiteEvents, law_of_file
from ..model.blast.vibration_laws import OF_CHARGES, law_text
from ..model.debris.touchdown import landings, shaking_at
from ..model.results.arrays import load_results
from ..model.run_folder.files import SCENARIO_FILE
from ..model.scenario.file import read_scenario
from .arguments import quantity

_J_PER_KJ = 1e3
_ROWS = 5
_OF = {OF_CHARGES: "charges within a delay, Q in kg"}
_FALL = "what falls, Q its energy in kJ"


def add_to(commands: argparse._SubParsersAction) -> None:
    """Add the command to the command line."""
    parser = commands.add_parser(
        "calibrate",
        description="Fits v = K (R/√Q)^-b to the events of a test blast or a drop test, and prints it as a table for a "
        "scenario file, with the band in which 95 % of new events lie. The first row of the file has heads with units, "
        "such as Distance (m), Charge (kg) or Mass (t) and Height (m), PPV (mm/s). With --plan: where to measure as a "
        "weight is dropped. See docs/ground_motion.md.",
        allow_abbrev=False,
    )
    parser.add_argument("events", metavar="EVENTS.csv", type=Path, nargs="?", help="table of events, one in each row")
    parser.add_argument(
        "--plan",
        metavar="RUN",
        type=Path,
        help="instead of events, the folder of a run: where to measure as a weight is dropped, for its neighbours",
    )
    parser.add_argument("--mass-t", metavar="M", type=quantity, help="with --plan: mass of the weight")
    parser.add_argument("--height-m", metavar="H", type=quantity, help="with --plan: height that it falls")
    parser.add_argument("--output", metavar="LAW.toml", type=Path, help="new file for the table, too")
    parser.add_argument("--quiet", action="store_true", help="print nothing but errors")
    parser.set_defaults(execute=calibrate)


def calibrate(arguments: argparse.Namespace) -> None:
    """Print the law of a site, and write its table where a file is asked for; or plan a drop test."""
    _check_together(arguments)
    if arguments.plan:
        for line in _planned(arguments):
            print(line)
        return
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


def _check_together(arguments: argparse.Namespace) -> None:
    if (arguments.events is None) == (arguments.plan is None):
        raise BlastError("expected either a table of events, EVENTS.csv, or --plan RUN")
    for option in ("mass_t", "height_m"):
        if (getattr(arguments, option) is None) == (arguments.plan is not None):
            raise BlastError(f"--{option.replace('_', '-')} goes with --plan RUN: expected both or neither")


def _planned(arguments: argparse.Namespace) -> Iterator[str]:
    """Yield the scaled distances of a run's neighbours, and where to measure so that a law has them."""
    scenario, landed = read_scenario(arguments.plan / SCENARIO_FILE), landings(load_results(arguments.plan))
    found = [(neighbour.name, shaking_at(neighbour.position_m, landed)) for neighbour in scenario.neighbours]
    shaken = [(name, shaking) for name, shaking in found if shaking is not None]
    if not shaken:
        raise OutputError(
            f"{arguments.plan}: nothing fell, or it has no neighbours: expected a run with [[neighbours]]"
        )
    energy_kj = arguments.mass_t * arguments.height_m * STANDARD_GRAVITY_M_S2
    yield f"{arguments.mass_t:g} t from {arguments.height_m:g} m: {energy_kj:.4g} kJ"
    needed = []
    for name, shaking in shaken:
        needed.append(scaled_by_root(shaking.distance_m, shaking.energy_j / _J_PER_KJ))
        yield (
            f"{name}: {shaking.energy_j / _J_PER_KJ:.4g} kJ land {shaking.distance_m:.3g} m away, R/√E "
            f"{needed[-1]:.3g} m/√kJ, as {needed[-1] * math.sqrt(energy_kj):.3g} m from the weight"
        )
    distances = ", ".join(f"{distance_m:.3g}" for distance_m in station_distances_m(needed, energy_kj))
    yield f"Measure at {distances} m from where it lands."


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
