"""Criteria: what makes a run count as a success, judged from the outputs of its outcome."""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from ...errors import ScenarioError
from ...texts import Text
from ..results.collapse import FALLEN, STANDS
from ..scenario import Scenario
from ..schema import Table, given, key, shown
from ..toml_tables import dotted

_LOST_AT_END = re.compile(r"(spans|piers)\.(\d+)\.lost_share")
"""Names of outputs about a part of the bridge that says whether it came down."""

COLLAPSED = "collapsed_share"
"""Output that says how far the collapse is at the end."""


@dataclass(frozen=True, slots=True)
class CriterionKind:
    """What a kind of criterion asks."""

    needs: tuple[str, ...]  # keys that it cannot do without
    output: Callable[["Criterion"], str]  # name of the output that it is judged from
    holds: Callable[[Any, "Criterion"], bool]  # whether a value of that output meets the criterion
    share: float | None = None  # where none is given; None for a kind that takes none


KINDS = {
    "collapsed": CriterionKind((), lambda _: COLLAPSED, lambda value, asked: value >= asked.limit_share, FALLEN),
    "span down": CriterionKind(
        ("span",),
        lambda asked: span_output(given(asked.span), "lost_share"),
        lambda value, asked: value >= asked.limit_share,
        FALLEN,
    ),
    "span stands": CriterionKind(
        ("span",),
        lambda asked: span_output(given(asked.span), "most_lost_share"),
        lambda value, asked: value <= asked.limit_share,
        STANDS,
    ),
    "zone not entered": CriterionKind(
        ("zone",), lambda asked: zone_output(given(asked.zone), "entered"), lambda value, _: not value
    ),
    "pressure below": CriterionKind(
        ("neighbour", "limit_kpa"),
        lambda asked: neighbour_output(given(asked.neighbour), "pressure_kPa"),
        lambda value, asked: value < asked.limit_kpa,
    ),
    "vibration below": CriterionKind(
        ("neighbour", "limit_mm_s"),
        lambda asked: neighbour_output(given(asked.neighbour), "vibration_mm_s"),
        lambda value, asked: value < asked.limit_mm_s,
    ),
    "touchdown below": CriterionKind(
        ("neighbour", "limit_mm_s"),
        lambda asked: neighbour_output(given(asked.neighbour), "touchdown_mm_s"),
        lambda value, asked: value < asked.limit_mm_s,
    ),
}
"""All kinds, by what a study file calls them."""


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
        choices=tuple(KINDS),
    )
    share: float | None = key(
        "Least share of the height that `collapsed` and `span down` ask for, 0.5 where it is left out; the largest "
        "that `span stands` allows, 0.1.",
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
        kind = KINDS[self.kind]
        value = outputs.get(kind.output(self))
        return value is not None and kind.holds(value, self)

    @property
    def limit_share(self) -> float | None:
        """The share that is asked for, or its kind's."""
        return KINDS[self.kind].share if self.share is None else self.share

    def check_against(self, scenario: Scenario) -> None:
        """Check that the scenario has the span, zone or neighbour."""
        spans = len(scenario.bridge.span_lengths_m) if scenario.bridge else 1
        if self.span is not None and self.span > spans:
            raise self.unexpected("span", f"a whole number up to {spans}, as the scenario has no more spans")
        for name, tables in (("zone", scenario.zones), ("neighbour", scenario.neighbours)):
            names = [table.name for table in tables]
            if getattr(self, name) is not None and getattr(self, name) not in names:
                listed = ", ".join(map(shown, names)) or f"none, as the scenario has no [[{name}s]]"
                raise self.unexpected(name, f"one of {listed}" if names else listed)

    def _check_together(self) -> None:
        kind = KINDS[self.kind]
        for name in ("share", "span", "zone", "neighbour", "limit_kpa", "limit_mm_s"):
            is_given = getattr(self, name) is not None
            if is_given and name not in kind.needs and (name != "share" or kind.share is None):
                raise self.unexpected(name, f'none with kind "{self.kind}"')
            if not is_given and name in kind.needs:
                raise self.unexpected(name, f'it with kind "{self.kind}"')


def check_criteria(criteria: tuple[Criterion, ...], scenario: Scenario) -> None:
    """Check that criteria fit the scenario."""
    for number, criterion in enumerate(criteria, start=1):
        try:
            criterion.check_against(scenario)
        except ScenarioError as error:
            raise ScenarioError(f"[[{Criterion.table}]] number {number}: {error}") from error


def span_output(span: int, quantity: str) -> str:
    """Return the name of an output about a span, by its number from 1."""
    return f"spans.{span}.{quantity}"


def pier_output(pier: int, quantity: str) -> str:
    """Return the name of an output about a pier, by its number from 1."""
    return f"piers.{pier}.{quantity}"


def part_of_output(name: str) -> Text | None:
    """Return the span or pier whose loss of height at the end an output gives; None of others."""
    found = _LOST_AT_END.fullmatch(name)
    if not found:
        return None
    return Text("span {}" if found[1] == "spans" else "pier {}", int(found[2]))


def zone_output(zone: str, quantity: str) -> str:
    """Return the name of an output about a zone."""
    return f"{dotted('zones', zone)}.{quantity}"


def neighbour_output(neighbour: str, quantity: str) -> str:
    """Return the name of an output about a neighbour."""
    return f"{dotted('neighbours', neighbour)}.{quantity}"
