# SPDX-License-Identifier: GPL-3.0-or-later
"""Random scenarios, from what their tables say of the values that they take."""

from __future__ import annotations

import math
from dataclasses import MISSING, Field, fields, replace
from types import NoneType
from typing import Any, get_args, get_origin

import numpy as np

from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.scenario import Scenario
from bridge_demolition_addon.model.schema import Key, Table, holds_many, subtable_class

_TRIES = 40
_TEXTS = ("deck", "pier 1", 'a "quoted", text', "Brücke ×2", "pier cap", "#1 = [2]", "\\")


def varied(scenario: Scenario, random: np.random.Generator, changes: int = 60) -> Scenario:
    """A scenario with many of its values replaced by others, of as many digits as a number can have."""
    for _ in range(changes):
        scenario = _changed(scenario, random)
    return scenario


def _changed(table: Table, random: np.random.Generator) -> Table:
    """The table with one value changed anywhere in it; as it is where the new value contradicts another."""
    item = fields(table)[random.integers(len(fields(table)))]
    value = getattr(table, item.name)
    if isinstance(value, Table) and random.random() < 0.9:
        changed = _changed(value, random)
    elif isinstance(value, float) and value and random.random() < 0.7:
        changed = value * random.uniform(0.9, 1.1)
    else:
        changed = _value(item, random)
    try:
        return replace(table, **{item.name: changed})
    except ScenarioError:
        return table


def _value(item: Field, random: np.random.Generator) -> Any:
    kinds = get_args(item.type)
    if NoneType in kinds and random.random() < 0.3:
        return None
    held = next(kind for kind in kinds if kind is not NoneType) if NoneType in kinds else item.type
    table_class = subtable_class(item)
    if table_class and holds_many(item):
        made = [_table(table_class, random) for _ in range(random.integers(4))]
        return tuple(item for item in made if item)
    if table_class:
        return _table(table_class, random)
    return _plain(held, item.metadata["key"], random)


def _table(table_class: type[Table], random: np.random.Generator) -> Table | None:
    """A table of random values; None where they contradict each other every time."""
    for _ in range(_TRIES):
        given = [field for field in fields(table_class) if field.default is MISSING or random.random() < 0.5]
        given = [field for field in given if field.default_factory is MISSING]
        try:
            return table_class(**{field.name: _value(field, random) for field in given})
        except ScenarioError:
            continue
    return None


def _plain(held: Any, rule: Key, random: np.random.Generator) -> Any:
    if get_origin(held) is tuple:
        kinds = get_args(held)
        number = random.integers(1, 4) if Ellipsis in kinds else len(kinds)
        return tuple(_plain(kinds[0], rule, random) for _ in range(number))
    if held is bool:
        return bool(random.integers(2))
    if held is str:
        return str(random.choice(rule.choices or _TEXTS))
    lowest = max((limit for limit in (rule.above, rule.at_least) if limit is not None), default=-1000.0)
    highest = min(rule.at_most if rule.at_most is not None else math.inf, max(abs(lowest), 1.0) * 10.0**3)
    number = random.uniform(lowest, highest)
    return int(number) + 1 if held is int else number
