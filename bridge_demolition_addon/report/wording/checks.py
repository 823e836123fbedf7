"""What tests check, against what, and how closely it agrees: reports and pages quote it from here."""

from __future__ import annotations

from typing import NamedTuple


class Check(NamedTuple):
    """A quantity, what it is compared with, and the tolerance of the test."""

    what: str
    against: str
    within: str


CHECKS = (
    Check("throw of a block launched in Blender", "v² sin 2α / g", "0.5 %"),
    Check(
        "energy of a spinning block in free flight in Blender", "itself at the launch", "0.5 % of the height it falls"
    ),
    Check(
        "energy of a block that swings on a point in Blender, a seventh of it rotation", "itself at the start", "2 %"
    ),
    Check("energy lost by a block that lands and stays", "m·g·h", "1 %"),
    Check("all works on a tower that is toppled and breaks, added up", "its kinetic energy", "2 % of the largest"),
    Check("energy made as two overlapping blocks are thrown apart", "their kinetic energy", "5 %"),
    Check("energy with which a body lands", "m g h", "1 %, on the safe side"),
    Check("forces of connections at rest: hanging block, chain, cantilever", "statics", "1e-6"),
    Check("forces on the bodies of a falling pile", "change of momentum", "1e-6 of the largest impulse"),
    Check("load at which a deck comes down, by strength of material", "beam theory", "20 %; in 40 and 90 shards 15 %"),
    Check("load at which a cantilever collapses, by statics", "beam theory", "15 %"),
    Check("blast: peak, duration, impulse, arrival", "published tables and formulas", "their last digit"),
    Check("velocity of the ground by touchdown", "the formula, worked out apart", "0.06 mm/s"),
    Check("footprints, buffers, piles of boxes", "formulas of geometry", "1e-6 m², 0.2 % of circles, 1 % of volumes"),
    Check("when a box enters a zone", "speed and distance", "1 ms"),
    Check("degrees on earth", "tables of the ellipsoid", "1 mm"),
)
