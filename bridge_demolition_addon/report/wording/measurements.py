"""How cases of the validation agree with what was measured: reports count hits and misses from here.

`scripts/validate` writes the table, ``measurements.csv``, from what it keeps of each case.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from ...texts import joined

TABLE = Path(__file__).with_suffix(".csv")


@dataclass(frozen=True, slots=True)
class Measured:
    """A case held against measurements: numbers within their tolerance, and what was found over what was measured."""

    case: str
    within: int
    of: int
    ratios: tuple[float, ...]  # the least and the largest; empty where ranges were measured

    @property
    def ratios_text(self) -> str | None:
        """Return the least and the largest ratio; None without any."""
        return joined("{} to {}", dict.fromkeys(f"{ratio:.2f}" for ratio in self.ratios)) or None


@cache
def measured_cases() -> tuple[Measured, ...]:
    """Return all cases, those that miss most first."""
    with TABLE.open(encoding="utf-8", newline="") as file:
        cases = [
            Measured(
                row["case"],
                int(row["within"]),
                int(row["of"]),
                tuple(float(row[name]) for name in ("least_ratio", "largest_ratio") if row[name]),
            )
            for row in csv.DictReader(file)
        ]
    return tuple(sorted(cases, key=lambda case: case.within / case.of))
