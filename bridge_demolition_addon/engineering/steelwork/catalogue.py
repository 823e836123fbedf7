"""Sections by name: rolled ones from a table, others by sizes in their name.

The table ``data/rolled_i_sections.csv`` has height, width, thickness of web and flanges, and root radius of the series
IPE, HEA, HEB and HEM: nominal dimensions of EN 10365:2017, which are facts under no licence. All else is worked out
from them. Sizes in names are in mm, with x between them.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Callable, Sequence
from difflib import get_close_matches
from functools import cache
from importlib import resources

from ...errors import ScenarioError
from .sections import (
    SteelSection,
    angle,
    channel,
    check_sizes,
    hollow_rectangle,
    plate_girder,
    rolled_i,
    solid_bar,
    tee,
    tube,
    welded_box,
)

_MM = 1e-3
_NEAREST = 3

_SIZE = r"[0-9]+(?:\.[0-9]+)?"
_SIZED = re.compile(rf"([A-Z]+) ?({_SIZE}(?: ?X ?{_SIZE})*)")
_ROLLED = re.compile(r"([A-Z]+?) ?([AMB]?) ?([0-9]+)(?: ?([AMB]))?")

SHAPES = {
    "I": "I height x width x web x flange, welded",
    "PG": "PG height x web x width of top flange x its thickness x width of bottom flange x its thickness, welded",
    "BOX": "BOX height x width x web x flange, welded",
    "RHS": "RHS height x width x thickness, hot finished",
    "SHS": "SHS side x thickness, hot finished",
    "CHS": "CHS diameter x thickness, hot finished",
    "L": "L height x width x thickness",
    "U": "U height x width x web x flange",
    "T": "T height x width x web x flange",
    "FLAT": "FLAT height x width",
}
"""Shapes that names with sizes may begin with, and what these sizes are."""


def section_named(name: str) -> SteelSection:
    """Return the section of a name, such as ``HEB 300`` or ``RHS 200x100x8``.

    Raises
    ------
    ScenarioError
        There is none of that name; the message has the nearest ones.
    """
    return _section(" ".join(name.upper().replace("×", "X").split()), name)


_LONGEST_NAME = 60
"""Letters of an unknown name in a message."""


@cache
def rolled_names() -> tuple[str, ...]:
    """Return the names of the table's rolled sections."""
    return tuple(rolled_sizes_mm())


@cache
def _section(upper: str, name: str) -> SteelSection:
    rolled = rolled_sizes_mm()
    if (same := _as_in_table(upper)) in rolled:
        return rolled_i(same, *(_MM * size for size in rolled[same]))
    sized = _SIZED.fullmatch(upper)
    if sized and sized[1] in SHAPES:
        return _by_sizes(name, sized[1], [float(size) for size in sized[2].split("X")])
    nearest = _nearest(same)
    known = f"such as {', '.join(nearest)}" if nearest else "of the series IPE, HEA, HEB or HEM"
    shapes = ", ".join(SHAPES)
    raise ScenarioError(
        f'section "{name[:_LONGEST_NAME]}" is unknown: expected one {known}, or a shape with sizes in mm: {shapes}'
    )


def _as_in_table(upper: str) -> str:
    """Return a name as the table has it: ``HE 300 B`` and ``HEB300`` are ``HEB 300``."""
    found = _ROLLED.fullmatch(upper)
    if not found:
        return upper
    series, before, size, behind = found.groups(default="")
    return f"{series}{before}{behind} {size}"


def _by_sizes(name: str, shape: str, sizes_mm: Sequence[float]) -> SteelSection:
    make, count, holes = _MAKERS[shape]
    if len(sizes_mm) != count:
        raise ScenarioError(f'section "{name}" has {len(sizes_mm)} sizes: expected {SHAPES[shape]}, in mm')
    check_sizes(name, sizes_mm, holes(sizes_mm))
    return make(name, [_MM * size for size in sizes_mm])


def _nearest(name: str) -> list[str]:
    """Return rolled sections of nearly that name: the same series and nearly its size."""
    series, _, size = name.rpartition(" ")
    alike = [known for known in rolled_names() if known.startswith(f"{series} ")]
    if series and alike and size.isdigit():
        return sorted(alike, key=lambda known: abs(int(known.rpartition(" ")[2]) - int(size)))[:_NEAREST]
    return get_close_matches(name, rolled_names(), n=_NEAREST)


@cache
def rolled_sizes_mm() -> dict[str, tuple[float, ...]]:
    """Return height, width, web, flange and root radius by name of the rolled section, in mm."""
    with (resources.files(__package__) / "data" / "rolled_i_sections.csv").open(encoding="utf-8") as file:
        _, *rows = csv.reader(file)
    return {name: tuple(map(float, sizes)) for name, *sizes in rows}


_Sizes = Sequence[float]

_MAKERS: dict[str, tuple[Callable[[str, _Sizes], SteelSection], int, Callable[[_Sizes], list[float]]]] = {
    "I": (lambda name, s: plate_girder(name, s[0], s[2], (s[1], s[3]), (s[1], s[3])), 4, lambda s: _clear(s)),
    "PG": (
        lambda name, s: plate_girder(name, s[0], s[1], (s[2], s[3]), (s[4], s[5])),
        6,
        lambda s: [s[0] - s[3] - s[5], s[2] - s[1], s[4] - s[1]],
    ),
    "BOX": (lambda name, s: welded_box(name, *s), 4, lambda s: [s[0] - 2 * s[3], s[1] - 2 * s[2]]),
    "RHS": (lambda name, s: hollow_rectangle(name, *s), 3, lambda s: [s[0] - 3 * s[2], s[1] - 3 * s[2]]),
    "SHS": (lambda name, s: hollow_rectangle(name, s[0], s[0], s[1]), 2, lambda s: [s[0] - 3 * s[1]]),
    "CHS": (lambda name, s: tube(name, *s), 2, lambda s: [s[0] - 2 * s[1]]),
    "L": (lambda name, s: angle(name, *s), 3, lambda s: [s[0] - s[2], s[1] - s[2]]),
    "U": (lambda name, s: channel(name, *s), 4, lambda s: _clear(s)),
    "T": (lambda name, s: tee(name, *s), 4, lambda s: [s[0] - s[3], s[1] - s[2]]),
    "FLAT": (lambda name, s: solid_bar(name, *s), 2, lambda s: []),
}
"""Of each shape: its maker by sizes in m, how many these are, and what plates leave between them, in mm."""


def _clear(sizes_mm: _Sizes) -> list[float]:
    height, width, web, flange = sizes_mm
    return [height - 2.0 * flange, width - web]
