"""Files of earlier versions: bodies had friction and restitution of their own, and a new scene had other values."""

from __future__ import annotations

import logging
import re
from collections.abc import Iterator, MutableMapping
from typing import Any

import bpy

from ...errors import ScenarioError
from ...model.scenario import Ball, ContactSettings, Ground, GroundSurface, Jackhammer, Scenario, ShardSettings
from ...model.scenario.contacts import BodyInContact
from ...model.scenario.file import read_scenario, scenario_from_text
from ...model.schema import EARLIER_NAMES, Table, holds_many, is_optional, subtable_class
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


@bpy.app.handlers.persistent
def read_earlier_keys(*_arguments: object) -> None:
    """Called by Blender when a file is loaded: keys that had another name before have their values under it."""
    for scene in bpy.data.scenes:
        settings = scene.bda
        _move_renamed(settings.scenario, Scenario)
        built = settings.built_values
        for earlier, name in EARLIER_NAMES.items():
            built = re.sub(rf"\b{earlier}\b", name, built)
        if built != settings.built_values:
            settings.built_values = built


def _move_renamed(group: bpy.types.PropertyGroup, table_class: type[Table]) -> None:
    """Give the keys of a table, and of the tables in it, values that a file has under their earlier names."""
    kept = _as_saved(group)
    keys = {item.name: item for item in shown_keys(table_class)}
    for earlier, name in EARLIER_NAMES.items():
        if name not in keys:
            continue
        for prefix in ("", USE):
            if prefix + earlier in kept and not group.is_property_set(prefix + name):
                value = kept[prefix + earlier]
                value = bool(value) if prefix else value if isinstance(value, str | int | float) else tuple(value)
                setattr(group, prefix + name, value)
                del kept[prefix + earlier]
    for item in shown_tables(table_class):
        inner = getattr(group, item.name)
        for one in inner if holds_many(item) else (inner,):
            _move_renamed(one, subtable_class(item))


def _as_saved(group: bpy.types.PropertyGroup) -> MutableMapping[str, Any]:
    """Return the values of a group as a file has them; before Blender 5.0 they are its custom properties."""
    return (group.bl_system_properties_get() or {}) if hasattr(group, "bl_system_properties_get") else group


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
    """Set all values that were never set to a table's, or to its class's without a table."""
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
    """Yield the groups of the bodies, with what was built of each and its class."""
    levels, hammers = (built.ground.surfaces, built.jackhammers) if built else ((), ())
    yield group.shards, built and built.shards, ShardSettings
    yield group.ground, built and built.ground, Ground
    yield group.ball, built and built.ball, Ball
    for number, level in enumerate(group.ground.surfaces):
        yield level, levels[number] if number < len(levels) else None, GroundSurface
    for number, hammer in enumerate(group.jackhammers):
        yield hammer, hammers[number] if number < len(hammers) else None, Jackhammer
