"""Criteria: what makes a run count as a success."""

from dataclasses import dataclass
from typing import ClassVar

from ..schema import Table, key

_NEEDED = {
    "collapsed": (),
    "span down": ("span",),
    "span stands": ("span",),
    "zone not entered": ("zone",),
    "pressure below": ("neighbour", "limit_kpa"),
    "vibration below": ("neighbour", "limit_mm_s"),
}
"""Keys that a kind of criterion cannot do without."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Criterion(Table):
    """What makes a run count as a success: each of these by itself, and all of them together."""

    table: ClassVar[str] = "criteria"

    name: str = key("What it is called in tables and reports.")
    kind: str = key("What is asked.", choices=tuple(_NEEDED))

    @property
    def column(self) -> str:
        """Name of its column in the table of runs, without ``out.``."""
        return self.name
