"""Names of things in scenario and scene, which no language translates: what users chose, and what logs say."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from typing import Any

from ..model.scenario import Scenario
from .run_folder import ReportedRun

_NAMES = ("name", "title", "member", "members", "where", "tendons", "supports")
"""Keys of a scenario that hold such names."""

_KINDS = "abutment, arch, beam, bearing, column, cross frame, deck, foundation, girder, ground, pier, pier cap, slab"
MEMBER_KINDS = frozenset(f"{_KINDS}, truss, wall, whole structure".split(", "))
"""Kinds of members, which the tables of languages have, also where a member is called by its kind alone."""


def names_of(scenario: Scenario | None) -> frozenset[str]:
    """Return the names in a scenario."""
    return frozenset(_names_in(scenario)) - MEMBER_KINDS - {""}


def names_in_run(run: ReportedRun) -> frozenset[str]:
    """Return the names in a run: those of its scenario, of its bodies and members, and of what its summary lists."""
    names = {run.title, run.name, *names_of(run.scenario)}
    if run.results is not None:
        inventory = run.results.inventory
        for texts in (inventory.body_names, inventory.body_members, inventory.body_member_kinds):
            names.update(map(str, texts))
        names.update(map(str, inventory.connection_names))
    if run.summary is not None:
        names.update(_listed_names(run.summary.values))
    return frozenset(names) - MEMBER_KINDS - {""}


def _listed_names(summary: Mapping[str, Any]) -> Iterator[str]:
    """Yield the names of bearings, cables and the like in the lists of a summary, and the version of Blender."""
    yield str(summary.get("blender", ""))
    for items in summary.values():
        for item in items if isinstance(items, list) else ():
            if isinstance(item, Mapping) and isinstance(item.get("name"), str):
                yield item["name"]


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
