"""Files of earlier versions: bodies had friction and restitution of their own, and a new scene had other values."""

from __future__ import annotations

import logging
from collections.abc import Iterator

import bpy

from ...errors import ScenarioError
from ...model.scenario import Ball, ContactSettings, Ground, GroundSurface, Jackhammer, Scenario, ShardSettings
from ...model.scenario.contacts import BodyInContact
from ...model.scenario.file import read_scenario, scenario_from_text
from ...model.schema import Table, holds_many, is_optional, subtable_class
from ...model.toml_tables import toml_value
from .prop import DEFAULT_PRESET, EARLIER_DEFAULT, USE, default_value, is_written_out, shown_keys, shown_tables

_CONSOLE = logging.getLogger(__name__)


@bpy.app.handlers.persistent
def read_earlier_bodies(*_arguments: object) -> None:
    """Called by Blender when a file is loaded."""
    for scene in bpy.data.scenes:
        if tick_own_values(scene.bda):
            _CONSOLE.warning("%s: friction and restitution are those of single bodies, as saved", scene.name)


@bpy.app.handlers.persistent
def mark_defaults(*_arguments: object) -> None:
    """Called by Blender before a file is saved: keep whose values those are that the file does not hold."""
    for scene in bpy.data.scenes:
        if not scene.library:
            scene.bda.defaults_of = DEFAULT_PRESET.stem


@bpy.app.handlers.persistent
def read_earlier_defaults(*_arguments: object) -> None:
    """Called by Blender when a file is loaded."""
    for scene in bpy.data.scenes:
        settings = scene.bda
        is_used = bool(settings.built_scenario) or _is_set(settings.scenario, Scenario)
        if is_used and not settings.defaults_of and not scene.library:
            _set_missing(settings.scenario, Scenario, read_scenario(EARLIER_DEFAULT))


def _is_set(group: bpy.types.PropertyGroup, table_class: type[Table]) -> bool:
    """Return whether any value of a table, or of a table in it, was ever set."""
    tables = shown_tables(table_class)
    names = [item.name for item in shown_keys(table_class)]
    names += [USE + item.name for item in (*shown_keys(table_class), *tables) if is_optional(item)]
    return any(map(group.is_property_set, names)) or any(
        len(inner) > 0 if holds_many(item) else _is_set(inner, subtable_class(item))
        for item in tables
        for inner in [getattr(group, item.name)]
    )


def _set_missing(group: bpy.types.PropertyGroup, table_class: type[Table], defaults: Table | None) -> None:
    """Set all values that were never set to those of a table, or to those of its class without a table."""
    for item in shown_keys(table_class):
        value = default_value(item, defaults)
        if is_optional(item) and not group.is_property_set(USE + item.name):
            setattr(group, USE + item.name, value is not None)
        if value is not None and not group.is_property_set(item.name):
            setattr(group, item.name, toml_value(value) if is_written_out(item) else value)
    for item in shown_tables(table_class):
        if holds_many(item):
            continue
        inner = getattr(defaults, item.name, None)
        if is_optional(item) and not group.is_property_set(USE + item.name):
            setattr(group, USE + item.name, inner is not None)
        _set_missing(getattr(group, item.name), subtable_class(item), inner)


def tick_own_values(settings: bpy.types.PropertyGroup) -> bool:
    """Tick friction and restitution of bodies that are set or were built without a check box; return whether any is."""
    built = _built(settings)
    ticked = [
        _tick(group, name, body)
        for group, body, table_class in _bodies(settings.scenario, built)
        for name in table_class.older_values
    ]
    if any(ticked):
        setattr(settings.scenario, USE + ContactSettings.table, False)
    return any(ticked)


def _tick(group: bpy.types.PropertyGroup, name: str, built: BodyInContact | None) -> bool:
    if group.is_property_set(USE + name):
        return False
    if group.is_property_set(name):
        setattr(group, USE + name, True)
        return True
    value = getattr(built, name, None)
    if value is not None:
        setattr(group, name, value)  # which ticks it
    return value is not None


def _built(settings: bpy.types.PropertyGroup) -> Scenario | None:
    """Return the scenario that a scene was built from; None where nothing is built, or its text was edited."""
    try:
        return scenario_from_text(settings.built_scenario) if settings.built_scenario else None
    except ScenarioError:  # which says so once it is run
        return None


def _bodies(
    group: bpy.types.PropertyGroup, built: Scenario | None
) -> Iterator[tuple[bpy.types.PropertyGroup, BodyInContact | None, type[BodyInContact]]]:
    """Yield the groups of all bodies, with what was built of each and its class."""
    levels, hammers = (built.ground.surfaces, built.jackhammers) if built else ((), ())
    yield group.shards, built and built.shards, ShardSettings
    yield group.ground, built and built.ground, Ground
    yield group.ball, built and built.ball, Ball
    for number, level in enumerate(group.ground.surfaces):
        yield level, levels[number] if number < len(levels) else None, GroundSurface
    for number, hammer in enumerate(group.jackhammers):
        yield hammer, hammers[number] if number < len(hammers) else None, Jackhammer
