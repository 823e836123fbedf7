"""Names of things in scenario and scene, which no language translates: what users chose, and what logs say."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any

from ..model.scenario import Scenario
from .run_folder import ReportedRun

_NAMES = ("name", "title", "member", "members", "where", "tendons", "supports")
"""Keys of a scenario that hold such names."""


def names_of(scenario: Scenario | None) -> frozenset[str]:
    """Return the names in a scenario."""
    return frozenset(_names_in(scenario)) - {""}


def names_in_run(run: ReportedRun) -> frozenset[str]:
    """Return the names in a run: those of its scenario, and of its bodies and members."""
    names = {run.title, run.name, *names_of(run.scenario)}
    if run.results is not None:
        inventory = run.results.inventory
        names.update(map(str, inventory.body_names), map(str, inventory.body_members))
        names.update(map(str, inventory.connection_names))
    return frozenset(names) - {""}


def _names_in(value: Any, key: str = "") -> Iterator[str]:
    if isinstance(value, str):
        if key in _NAMES:
            yield value
    elif isinstance(value, tuple | list):
        for item in value:
            yield from _names_in(item, key)
    elif is_dataclass(value):
        for item in fields(value):
            yield from _names_in(getattr(value, item.name), item.name)
