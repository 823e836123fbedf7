"""What tests check, against what, and how closely it agrees; how cases of the validation agree with measurements.

`scripts/validate` writes the table, ``measurements.csv``, from what it keeps of each case.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import NamedTuple

from ...texts import Quantity, Text, joined


class Check(NamedTuple):
    """A quantity, what it is compared with, and the tolerance of the test."""

    what: str
    against: str
    within: str


CHECKS = (
    Check("throw of a block launched in Blender", Text("v² sin 2α / g"), "0.5 %"),
    Check(
        "energy of a spinning block in free flight in Blender",
        Text("itself at the launch"),
        Text("0.5 % of the height it falls"),
    ),
    Check(
        "energy of a block that swings on a point in Blender, a seventh of it rotation",
        Text("itself at the start"),
        "2 %",
    ),
    Check("energy lost by a block that lands and stays", "m·g·h", "1 %"),
    Check(
        "all works on a tower that is toppled and breaks, added up",
        Text("its kinetic energy"),
        Text("2 % of the largest"),
    ),
    Check("energy made as two overlapping blocks are thrown apart", Text("their kinetic energy"), "5 %"),
    Check("energy with which a body lands", "m g h", Text("1 %, on the safe side")),
    Check("forces of connections at rest: hanging block, chain, cantilever", Text("statics"), "1e-6"),
    Check("forces on the bodies of a falling pile", Text("change of momentum"), Text("1e-6 of the largest impulse")),
    Check(
        "load at which a deck comes down, by strength of material",
        Text("beam theory"),
        Text("20 %; in 40 and 90 shards 15 %"),
    ),
    Check("load at which a cantilever collapses, by statics", Text("beam theory"), "15 %"),
    Check("blast: peak, duration, impulse, arrival", Text("published tables and formulas"), Text("their last digit")),
    Check("velocity of the ground by touchdown", Text("the formula, worked out apart"), Quantity("0.06", "mm/s")),
    Check(
        "footprints, buffers, piles of boxes",
        Text("formulas of geometry"),
        Text("{}, 0.2 % of circles, 1 % of volumes", Quantity("1e-6", "m²")),
    ),
    Check("when a box enters a zone", Text("speed and distance"), "1 ms"),
    Check("degrees on earth", Text("tables of the ellipsoid"), Quantity("1", "mm")),
)


TABLE = Path(__file__).with_name("measurements.csv")


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
