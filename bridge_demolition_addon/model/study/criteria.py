"""Criteria: what makes a run count as a success, judged from the outputs of its outcome."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from ...errors import ScenarioError
from ..scenario import Scenario
from ..schema import Table, key, shown
from ..toml_tables import dotted

_NEEDED = {
    "collapsed": (),
    "span down": ("span",),
    "span stands": ("span",),
    "zone not entered": ("zone",),
    "pressure below": ("neighbour", "limit_kpa"),
    "vibration below": ("neighbour", "limit_mm_s"),
    "touchdown below": ("neighbour", "limit_mm_s"),
}
"""Keys that a kind of criterion cannot do without."""

_SHARES = {"collapsed": 0.5, "span down": 0.5, "span stands": 0.1}
"""Kinds that take a share, and which where none is given."""

COLLAPSED = "collapsed_share"
"""Output that says how far the collapse is at the end."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Criterion(Table):
    """What makes a run count as a success: each of these by itself, and all of them together. A run that did not finish
    is none."""

    table: ClassVar[str] = "criteria"

    name: str = key("What it is called in tables and reports.")
    kind: str = key(
        "What is asked. `collapsed`: so much of the height of the shards' common centre of mass is lost at the end. "
        "`span down`, `span stands`: so much of the height of a span's centre of mass is lost at the end, or never. "
        "`zone not entered`: no shard and no ball reaches into a zone at any time. `pressure below`, `vibration "
        "below`: what the charges do to a neighbour stays below a limit; the fall of the bridge, which shakes the "
        "ground as well, is not in it. `touchdown below`: the fall shakes the ground at a neighbour by less, as it is "
        "estimated.",
        choices=tuple(_NEEDED),
    )
    share: float | None = key(
        "Least share of the height that `collapsed` and `span down` ask for, 0.5 where it is left out; the largest "
        "that `span stands` bears, 0.1.",
        default=None,
        above=0,
        at_most=1,
    )
    span: int | None = key("Number of the span, from 1, along the road.", default=None, at_least=1, at_most=10_000)
    zone: str | None = key("Name of the zone, from `[[zones]]` of the scenario.", default=None)
    neighbour: str | None = key("Name of the neighbour, from `[[neighbours]]` of the scenario.", default=None)
    limit_kpa: float | None = key("Limit of the overpressure, in the free field.", default=None, unit="kPa", above=0)
    limit_mm_s: float | None = key("Limit of the ground's peak particle velocity.", default=None, unit="mm/s", above=0)

    @property
    def output(self) -> str:
        """Name of the output that says whether it is met."""
        return dotted("criteria", self.name)

    def is_met(self, outputs: Mapping[str, Any]) -> bool:
        """Return whether a run meets it, from the outputs of its outcome.

        What is not known is not met, such as a span without shards of its own.
        """
        value = outputs.get(self._judged)
        if value is None:
            return False
        match self.kind:
            case "collapsed" | "span down":
                return value >= self._share
            case "span stands":
                return value <= self._share
            case "zone not entered":
                return not value
            case "pressure below":
                return value < self.limit_kpa
            case _:
                return value < self.limit_mm_s

    def check_against(self, scenario: Scenario) -> None:
        """Check that the scenario has what is asked about.

        Raises
        ------
        ScenarioError
            It has not.
        """
        spans = len(scenario.bridge.span_lengths_m) if scenario.bridge else 1
        if self.span is not None and self.span > spans:
            raise self.unexpected("span", f"a whole number up to {spans}, as the scenario has no more spans")
        for name, tables in (("zone", scenario.zones), ("neighbour", scenario.neighbours)):
            names = [each.name for each in tables]
            if getattr(self, name) is not None and getattr(self, name) not in names:
                listed = ", ".join(map(shown, names)) or f"none, as the scenario has no [[{name}s]]"
                raise self.unexpected(name, f"one of {listed}" if names else listed)

    @property
    def _judged(self) -> str:
        """Name of the output that it is judged from."""
        match self.kind:
            case "collapsed":
                return COLLAPSED
            case "span down":
                return span_output(self.span, "lost_share")
            case "span stands":
                return span_output(self.span, "most_lost_share")
            case "zone not entered":
                return zone_output(self.zone, "entered")
            case "pressure below":
                return neighbour_output(self.neighbour, "pressure_kPa")
            case "touchdown below":
                return neighbour_output(self.neighbour, "touchdown_mm_s")
            case _:
                return neighbour_output(self.neighbour, "vibration_mm_s")

    @property
    def _share(self) -> float:
        return _SHARES[self.kind] if self.share is None else self.share

    def _check_together(self) -> None:
        taken = {*_NEEDED[self.kind], *(("share",) if self.kind in _SHARES else ())}
        for name in ("share", "span", "zone", "neighbour", "limit_kpa", "limit_mm_s"):
            is_given = getattr(self, name) is not None
            if is_given and name not in taken:
                raise self.unexpected(name, f'none with kind "{self.kind}"')
            if not is_given and name in _NEEDED[self.kind]:
                raise self.unexpected(name, f'it with kind "{self.kind}"')


def check_criteria(criteria: tuple[Criterion, ...], scenario: Scenario) -> None:
    """Check that criteria differ by name, and that the scenario has what they ask about.

    Raises
    ------
    ScenarioError
        Two have one name, or one asks about nothing; the text gives its number.
    """
    names = [each.name for each in criteria]
    for number, each in enumerate(criteria, start=1):
        try:
            if names.count(each.name) > 1:
                raise each.unexpected("name", "another name for each")
            each.check_against(scenario)
        except ScenarioError as error:
            raise ScenarioError(f"[[{Criterion.table}]] number {number}: {error}") from error


def span_output(span: int, what: str) -> str:
    """Return the name of an output about a span, by its number from 1."""
    return f"spans.{span}.{what}"


def zone_output(zone: str, what: str) -> str:
    """Return the name of an output about a zone."""
    return f"{dotted('zones', zone)}.{what}"


def neighbour_output(neighbour: str, what: str) -> str:
    """Return the name of an output about a neighbour."""
    return f"{dotted('neighbours', neighbour)}.{what}"
