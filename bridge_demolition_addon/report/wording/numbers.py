"""Numbers in sentences. What is stated with confidence is rounded to the side of safety."""

from __future__ import annotations

from collections.abc import Sequence

from ...engineering.units import rounded_down, rounded_up
from ...texts import Text, joined

_MOST_NAMES = 6


def listed(names: Sequence[str]) -> str:
    """Return names in a sentence; of many only how many there are."""
    if len(names) > _MOST_NAMES:
        return Text("{} quantities", len(names))
    return joined("{} and {}", [joined("{}, {}", names[:-1]), names[-1]] if len(names) > 1 else names)


def ordinal(rank: int) -> str:
    """Return ``largest``, ``2nd largest`` and so on."""
    if rank == 1:
        return Text("largest")
    ending = "th" if rank % 100 in (11, 12, 13) else {1: "st", 2: "nd", 3: "rd"}.get(rank % 10, "th")
    return Text(f"{{}}{ending} largest", rank)


def percent(share: float) -> str:
    """Return a share that a user chose, with the digits it has."""
    return f"{100.0 * share:.10g} %"


def percent_up(share: float) -> str:
    """Return a share in percent, rounded up to the second decimal."""
    return f"{rounded_up(100.0 * share, '0.01')} %"


def percent_down(share: float) -> str:
    """Return a share in percent, rounded down to the second decimal."""
    return f"{rounded_down(100.0 * share, '0.01')} %"


def four_digits(value: float) -> str:
    """Return a number with four digits, without an exponent where it need not have one."""
    return f"{float(f'{value:.4g}'):.10g}"
