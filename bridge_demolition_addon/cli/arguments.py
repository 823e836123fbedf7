"""Arguments that several commands have in common, refused with what was expected instead."""

import argparse
import math
from collections.abc import Iterator
from contextlib import contextmanager

from ..engineering.blast.pulses import BlastModel
from ..engineering.blast.wave import Burst
from ..engineering.unit_systems import UnitSystem
from ..errors import BlastError, GeometryError, ScenarioError
from ..report.languages.translation import ENGLISH, language_names

SMALLEST, LARGEST = 1e-6, 1e9
"""Limits of a mass, a distance or a load on the command line."""


def quantity(text: str, largest: float = LARGEST) -> float:
    """Return a number above 0, of a size that makes sense."""
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not SMALLEST <= number <= largest:
        raise argparse.ArgumentTypeError(f"{text!r} is wrong: expected a number from {SMALLEST:g} to {largest:g}")
    return number


@contextmanager
def naming(path: str) -> Iterator[None]:
    """Put a scenario file's name before errors in it that are found after it was read."""
    try:
        yield
    except ScenarioError as error:
        raise error.within(path) from error
    except (BlastError, GeometryError) as error:
        raise type(error)(f"{path}: {error}") from error


def add_blast_options(parser: argparse.ArgumentParser) -> None:
    """Add where the charge detonates, and where the wave comes from."""
    parser.add_argument(
        "--burst",
        choices=[burst.value for burst in Burst],
        default=Burst.AIR.value,
        help="where the charge detonates: free in the air, or on the ground, which sends its wave back up (air)",
    )
    parser.add_argument(
        "--model",
        choices=[model.value for model in BlastModel],
        default=BlastModel.KINGERY_BULMASH.value,
        help="formulas for the blast wave (kingery-bulmash)",
    )


def add_report_options(parser: argparse.ArgumentParser) -> None:
    """Add the language and the units of reports; without them those that the scenario asks for count."""
    parser.add_argument(
        "--language",
        choices=language_names(),
        help=f"language of the report: {', '.join(language_names())}, see docs/languages.md (that of the scenario, "
        f"else {ENGLISH})",
    )
    parser.add_argument(
        "--units",
        choices=tuple(system.value for system in UnitSystem),
        help="units of the report and of what is printed: metric, or imperial for ft, in, lb, kip, ksi and psi; files "
        f"for programs stay in SI units (those of the scenario, else {UnitSystem.METRIC.value})",
    )
