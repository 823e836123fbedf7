"""Files of versions in which bodies had friction and restitution of their own, without a check box beside them."""

from __future__ import annotations

import logging
from collections.abc import Iterator

import bpy

from ...errors import ScenarioError
from ...model.scenario import Ball, ContactSettings, Ground, GroundSurface, Jackhammer, Scenario, ShardSettings
from ...model.scenario.contacts import BodyInContact
from ...model.scenario.file import scenario_from_text
from .prop import USE

_CONSOLE = logging.getLogger(__name__)


@bpy.app.handlers.persistent
def read_earlier_bodies(*_arguments: object) -> None:
    """Called by Blender when a file is loaded."""
    for scene in bpy.data.scenes:
        if tick_own_values(scene.bda):
            _CONSOLE.warning("%s: friction and restitution are those of single bodies, as saved", scene.name)


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
