"""The values that a scene was built from, and those in the panels that have changed since.

A run takes the values that were built, and as the panels show them those that do not take part in building.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import Field, dataclass, fields, replace
from functools import cache, lru_cache
from typing import Any

import bpy
import numpy as np

from ...engineering.single_precision import as_given, shortest
from ...errors import DemolitionError, ScenarioError
from ...model.scenario import Exclusion, Scenario, TimeSettings
from ...model.scenario.file import scenario_from_text, scenario_text
from ...model.scenario.kept import values_from_text, values_text
from ...model.schema import Table, holds_many, is_optional, key_fields, key_name, key_of, subtable_class
from ...scene.world import time_settings
from ..languages.words import translated
from .prop import USE, is_written_out, shown_tables, vector_length
from .values import inner_of, list_of, scenario_of, show_inner

_SITE = ("zones", "exclusion", "site", "neighbours", "equipment")
"""Parts of a scenario that only reports and stages read."""

_AS_SHOWN = ("title", "charges", "blast", "recording", "pictures", "report", *_SITE)
"""Parts of a scenario that a run takes as the panels show them when it begins."""

_BESIDE_RESULTS = ("title", "recording", "pictures", "report")
"""Parts of a scenario on which no result depends."""

_TIME_AS_SHOWN = ("stop_at_rest", "rest_speed_m_s", "rest_angular_velocity_rad_s", "rest_hold_s")
"""Keys of its time that a run takes so."""

_LISTED_IN_MESSAGE = 3

Kept = dict[str, Any] | None
"""Values of a table as its panel showed them when the scene was built; None where there was no such table."""


@dataclass(frozen=True, slots=True)
class ChangedValue:
    """A value that has changed since the scene was built.

    `key` is its name in a scenario, `shown` its text in the panel, and `built` the text of the built value, such as
    ``with 10 000 kg``.
    """

    key: str
    shown: str
    built: str


def keep_built(settings: bpy.types.PropertyGroup, scenario: Scenario) -> None:
    """Keep the scenario that a scene was built from, which its panels show."""
    settings.built_scenario = scenario_text(scenario)
    settings.built_values = values_text(_values(settings.scenario, Scenario))


def forget_built(settings: bpy.types.PropertyGroup) -> None:
    """Note that nothing is built."""
    settings.built_scenario = settings.built_values = ""


def show_built(settings: bpy.types.PropertyGroup) -> None:
    """Show the values that the scene was built from; those that a run takes from the panels stay."""
    built, group = scenario_from_text(settings.built_scenario), settings.scenario
    of_run = {name: getattr(group.time, name) for name in _TIME_AS_SHOWN}
    group.seed = built.seed
    for item in _built_tables(Scenario):
        show_inner(group, item, getattr(built, item.name))
    for name, value in of_run.items():
        setattr(group.time, name, value)
    keep_built(settings, built)


def built_values(settings: bpy.types.PropertyGroup) -> Kept:
    """Return all values as they were shown when the scene was built, table by table; None where it was not."""
    return _parsed(settings.built_values) if settings.built_values else None


def changes(settings: bpy.types.PropertyGroup) -> list[ChangedValue]:
    """Return all values that have changed since the scene was built; none where it was not."""
    kept = built_values(settings)
    return [] if kept is None else list(changes_in(settings.scenario, Scenario, kept))


def panels_show(settings: bpy.types.PropertyGroup, scenario: Scenario) -> bool:
    """Return whether the panels show a scenario, in all that its results depend on."""
    try:
        shown = scenario_of(settings)
    except DemolitionError:  # faulty panels have no results
        return False
    return _without(shown, _BESIDE_RESULTS) == _without(scenario, _BESIDE_RESULTS)


def is_built(settings: bpy.types.PropertyGroup, scenario: Scenario) -> bool:
    """Return whether what is built is of a scenario, as far as its values count in building."""
    if not settings.built_scenario:
        return False
    built = _parsed_scenario(settings.built_scenario)
    return _without(built, _AS_SHOWN) == _without(scenario, _AS_SHOWN)


def is_emptied(scene: bpy.types.Scene) -> bool:
    """Return whether the user has deleted all bodies that were built in a scene: it can be built in again."""
    world = scene.rigidbody_world
    return bool(scene.bda.built_scenario and world and world.collection and not world.collection.all_objects)


def has_changed(settings: bpy.types.PropertyGroup, tables: Collection[str]) -> bool:
    """Return whether a value in some tables of the scenario has changed since the scene was built."""
    kept = built_values(settings)
    items = () if kept is None else (item for item in _built_tables(Scenario) if item.name in tables)
    return any(True for item in items for _ in changes_of_table(settings.scenario, item, kept))


def changes_in(group: bpy.types.PropertyGroup, table_class: type[Table], kept: Kept) -> Iterator[ChangedValue]:
    """Return the values of a table, and of those in it, that are not as they were when the scene was built."""
    if kept is not None:
        for item, is_used, is_vector in _readings(
            table_class
        ):  # run at each redraw: only values that differ are looked up
            now = None if is_used and not getattr(group, is_used) else getattr(group, item.name)
            same = list(now) if is_vector and now is not None else now
            if same != kept.get(item.name) and (change := change_of(group, table_class, item, kept)):
                yield change
    for item in _built_tables(table_class):
        yield from changes_of_table(group, item, kept)


def changes_of_table(group: bpy.types.PropertyGroup, item: Field, kept: Kept) -> Iterator[ChangedValue]:
    """Return what has changed in the table, or the tables, of one field of a group."""
    if not counts_in_building(item):
        return
    inner_class, now, then = subtable_class(item), getattr(group, item.name), (kept or {}).get(item.name)
    change = change_of_use(group, item, kept)
    if change:
        yield change
    if holds_many(item):
        for number, (inner, values) in enumerate(zip(now, then or [], strict=False), start=1):
            for change in changes_in(inner, inner_class, values):
                yield replace(change, key=translated("{} (number {})").format(change.key, number))
    elif then is not None and not change:
        yield from changes_in(now, inner_class, then)


def change_of_use(group: bpy.types.PropertyGroup, item: Field, kept: Kept) -> ChangedValue | None:
    """Return whether a table is used now and was not, or the other way round, or that a list has another length."""
    if not counts_in_building(item):
        return None
    table, then = subtable_class(item).table, (kept or {}).get(item.name)
    if holds_many(item):
        now, built = len(getattr(group, item.name)), len(then or [])
        if now == built:
            return None
        return ChangedValue(table, translated("a list of {}").format(now), translated("with {} of them").format(built))
    is_used = not is_optional(item) or getattr(group, USE + item.name)
    if is_used == (then is not None):
        return None
    words = ("used", "without") if is_used else ("not used", "with it")
    return ChangedValue(table, *map(translated, words))


def change_of(group: bpy.types.PropertyGroup, table_class: type[Table], item: Field, kept: Kept) -> ChangedValue | None:
    """Return how one value differs from the built one; None where it does not, or there was no such table."""
    if kept is None or not counts_in_building(item):
        return None
    now, then = _value(group, item), kept.get(item.name)
    if now == then or (is_written_out(item) and _listed(now, item) == _listed(then, item)):
        return None
    built = "" if then is None else _value_text(item, then)
    if not isinstance(then, bool):  # which is built off, or on
        built = translated("with {}").format(built) if built else translated("without")
    shown = translated("not given") if now is None else _value_text(item, now)
    return ChangedValue(key_name(table_class, item), shown, built)


@cache
def counts_in_building(item: Field) -> bool:
    """Return whether a key or table of a scenario counts when it is built, and later changes do not."""
    if subtable_class(item) is None:
        return item.name not in ("title", *_TIME_AS_SHOWN)
    return item.name not in _AS_SHOWN


def shown_site(settings: bpy.types.PropertyGroup) -> dict[str, Any]:
    """Return the parts of a scenario that only reports read, as the panels show them."""
    fields = {item.name: item for item in shown_tables(Scenario)}
    return {name: inner_of(settings.scenario, fields[name]) for name in _SITE}


def shown_exclusion(settings: bpy.types.PropertyGroup) -> Exclusion | None:
    """Return the exclusion zone as the panels show it; None where it is not used."""
    (item,) = (item for item in shown_tables(Scenario) if item.name == Exclusion.table)
    return inner_of(settings.scenario, item)


def changed_in_blender(scene: bpy.types.Scene) -> list[ChangedValue]:
    """Return what of frames and sub-steps was changed in Blender since the scene was built; a run takes the scene's."""
    kept = built_values(scene.bda)
    if kept is None or scene.rigidbody_world is None:
        return []
    fields = {item.name: item for item in key_fields(TimeSettings)}
    return [
        ChangedValue(
            key_name(TimeSettings, fields[name]),
            _value_text(fields[name], value),
            translated("with {}").format(_value_text(fields[name], kept["time"][name])),
        )
        for name, value in time_settings(scene).items()
        if as_given(value, kept["time"][name]) != kept["time"][name]  # which were in single precision
    ]


def scenario_to_run(settings: bpy.types.PropertyGroup) -> Scenario | None:
    """Return the scenario of a run: as built, and as shown where a run takes that; None where nothing is built."""
    if not settings.built_scenario:
        return None
    built, shown = scenario_from_text(settings.built_scenario), scenario_of(settings)
    time = replace(built.time, **{name: getattr(shown.time, name) for name in _TIME_AS_SHOWN})
    to_run = replace(built, time=time, **{name: getattr(shown, name) for name in _AS_SHOWN})
    if to_run != shown:
        raise ScenarioError(_sentence(changes(settings)))
    if not np.array_equal(to_run.timeline.frame_lengths_s, built.timeline.frame_lengths_s):
        raise ScenarioError("slow motion was animated for the charges that the scene was built with: build it again")
    return to_run


def _sentence(changed: list[ChangedValue]) -> str:
    pattern = translated("{} ({}, built {})")
    listed = [pattern.format(change.key, change.shown, change.built) for change in changed[:_LISTED_IN_MESSAGE]]
    if len(changed) > _LISTED_IN_MESSAGE:
        listed.append(translated("{} more").format(len(changed) - _LISTED_IN_MESSAGE))
    reason = translated("the scene was built from other values than the panels show")
    if listed:
        reason = translated("values have changed since the scene was built: {}").format(", ".join(listed))
    return translated("{}; build it again, or show the values that it was built with").format(reason)


@cache
def _built_keys(table_class: type[Table]) -> tuple[Field, ...]:
    return tuple(item for item in key_fields(table_class) if counts_in_building(item))


@cache
def _built_tables(table_class: type[Table]) -> tuple[Field, ...]:
    return tuple(item for item in shown_tables(table_class) if counts_in_building(item))


def _values(group: bpy.types.PropertyGroup, table_class: type[Table]) -> dict[str, Any]:
    """Return all values of a group that count in building, as JSON can hold them."""
    values = {item.name: _value(group, item) for item in _built_keys(table_class)}
    for item in _built_tables(table_class):
        inner, inner_class = getattr(group, item.name), subtable_class(item)
        if holds_many(item):
            values[item.name] = [_values(part, inner_class) for part in inner]
        elif is_optional(item) and not getattr(group, USE + item.name):
            values[item.name] = None
        else:
            values[item.name] = _values(inner, inner_class)
    return values


def _value(group: bpy.types.PropertyGroup, item: Field) -> Any:
    """Return the value of a key in Blender; None where it is not used."""
    is_used, is_vector = _reading(item)
    if is_used and not getattr(group, is_used):
        return None
    value = getattr(group, item.name)
    return list(value) if is_vector else value


@cache
def _readings(table_class: type[Table]) -> tuple[tuple[Field, str, bool], ...]:
    return tuple((item, *_reading(item)) for item in _built_keys(table_class))


@cache
def _reading(item: Field) -> tuple[str, bool]:
    """Return the name of the check box of a key, empty where it has none, and whether it is a vector."""
    return USE + item.name if is_optional(item) else "", vector_length(item) is not None


def _without(scenario: Scenario, names: Collection[str]) -> dict[str, Any]:
    return {item.name: getattr(scenario, item.name) for item in fields(Scenario) if item.name not in names}


@lru_cache(maxsize=8)
def _parsed_scenario(text: str) -> Scenario:
    return scenario_from_text(text)


@lru_cache(maxsize=8)
def _parsed(text: str) -> dict[str, Any]:
    return values_from_text(text, {})


def _listed(text: str | None, item: Field) -> Any:
    """Return the list of a text in TOML; the text itself where it is no list."""
    if text is None:
        return None
    try:
        return list_of(text, item.name, item)
    except ScenarioError:
        return text


def _value_text(item: Field, value: Any) -> str:
    if isinstance(value, bool):
        return translated("on") if value else translated("off")
    if isinstance(value, str) and is_written_out(item):
        listed = _listed(value, item)
        value = listed if isinstance(listed, list) and all(isinstance(part, int | float) for part in listed) else value
    if isinstance(value, list):
        text = ", ".join(map(_number, value))
    else:
        text = value if isinstance(value, str) else _number(value)
    unit = key_of(item).unit
    return f"{text} {unit}" if unit and unit != "1/s" else text


def _number(value: float) -> str:
    return f"{shortest(value):,.7g}".replace(",", " ") if isinstance(value, float) else f"{value:,}".replace(",", " ")
