"""Numbers on the command line, refused with what was expected instead."""

import argparse
import math

SMALLEST, LARGEST = 1e-6, 1e9
"""What a mass, a distance or a load on the command line has to lie between."""


def quantity(text: str) -> float:
    """A number for something that there is: above 0, and of a size that means something.

    Raises
    ------
    argparse.ArgumentTypeError
        It is none; the parser adds the option's name.
    """
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not SMALLEST <= number <= LARGEST:
        raise argparse.ArgumentTypeError(f"{text!r} is wrong: expected a number from {SMALLEST:g} to {LARGEST:g}")
    return number
