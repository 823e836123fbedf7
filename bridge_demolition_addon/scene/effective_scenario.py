"""What was changed in Blender since a scene was built, taken over into the scenario that it was built from."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np

from ..engineering.single_precision import as_given
from ..errors import ScenarioError
from ..model.scenario import Scenario, SurfaceValues
from ..model.scenario.contact_facts import with_surfaces
from ..model.scenario.contacts import QUANTITIES, BodyInContact
from ..model.schema import Table
from .bodies import SHARD_PROPERTIES, Kind
from .body_settings import BodySettings
from .world import START_FRAME, TimeOfScene

_Table = TypeVar("_Table", bound=Table)

_DEFAULT_MARGIN_M = 0.04
"""Collision margin of a body for which none is set (Bullet's CONVEX_DISTANCE_MARGIN)."""

_BALL = {"mass_kg": "mass", "angular_damping": "angular_damping"}
"""Keys of a scenario, and the properties of Blender's rigid bodies that they set."""


@contextmanager
def _refused(reason: str) -> Iterator[None]:
    """Put a reason before what the model says of values that no scenario can have."""
    try:
        yield
    except ScenarioError as error:
        raise ScenarioError(f"{reason} ({error})") from error


@_refused("settings of bodies that no scenario can have")
def with_bodies(bodies: BodySettings, scenario: Scenario) -> Scenario:
    """Take over mass and surface of ground, ball and shards; of shards what all of them have."""
    rows = {kind: [row for row in bodies.of_kind(kind) if bodies.is_marked[row]] for kind in Kind}
    shards = _common(bodies, rows[Kind.SHARD], SHARD_PROPERTIES, scenario.shards)
    own = zip(bodies.rigid["use_margin"], bodies.rigid["collision_margin"], strict=True)
    margins = [margin if is_used else _DEFAULT_MARGIN_M for is_used, margin in own]
    if len(common := {margins[row] for row in rows[Kind.SHARD]}) == 1:
        shards |= _read({"collision_margin_m": common.pop()}, scenario.shards)
    if not shards.get("use_deactivation", True):
        shards["start_deactivated"] = False  # which Blender ignores there
    scenario = replace(scenario, shards=_replaced(scenario.shards, shards))
    if scenario.ball is not None:
        ball = _common(bodies, rows[Kind.BALL], _BALL, scenario.ball)
        scenario = replace(scenario, ball=_replaced(scenario.ball, ball))
    return with_surfaces(scenario, _surfaces_of(bodies, rows, scenario))


def _surfaces_of(
    bodies: BodySettings, rows: Mapping[Kind, Sequence[int]], scenario: Scenario
) -> dict[BodyInContact, SurfaceValues]:
    """Return friction and restitution that bodies in Blender have by themselves, by their tables.

    Where bodies of one table differ, it has what the scenario says.
    """
    rows_of: dict[BodyInContact, Sequence[int]] = {scenario.shards: rows[Kind.SHARD]}
    named: dict[str, list[int]] = {}
    for row in rows[Kind.GROUND]:
        named.setdefault(bodies.members[row], []).append(row)
    rows_of |= {surface: named.get(surface.name, ()) for surface in scenario.ground.surfaces}
    rows_of[scenario.ground] = named.get("", ())
    if scenario.ball is not None:
        rows_of[scenario.ball] = rows[Kind.BALL]
    rows_of |= dict.fromkeys(scenario.jackhammers, rows[Kind.TOOL])
    return {table: _surface_in(bodies, own, scenario.surface_of(table)) for table, own in rows_of.items()}


def _surface_in(bodies: BodySettings, rows: Sequence[int], built: SurfaceValues) -> SurfaceValues:
    values = {name: bodies.common(name, rows) for name in QUANTITIES}
    return replace(
        built, **{name: as_given(found[0], getattr(built, name)) for name, found in values.items() if len(found) == 1}
    )


@_refused("frames of another length than what is planned and animated allows")
def with_time_step(time: TimeOfScene, scenario: Scenario) -> Scenario:
    """Take over frame rate, sub-steps, solver and speed. What is animated keeps its frames, and its times change."""
    changed = _replaced(scenario.time, _read(time.settings, scenario.time))
    factor = changed.step.frame_s / scenario.time.step.frame_s
    if changed == scenario.time:
        return scenario
    if factor == 1.0:
        return replace(scenario, time=changed)
    if time.is_animated:
        raise ScenarioError("slow motion was animated for frames of another length")
    changed = replace(changed, duration_s=scenario.time.duration_s * factor)
    return replace(scenario, time=changed, **scenario.actions_scaled_in_time(factor))


def with_duration(time: TimeOfScene, scenario: Scenario) -> Scenario:
    """Take over the last frame."""
    lengths = time.frame_lengths_s
    if len(lengths) == len(scenario.timeline):
        return scenario
    with _refused(f"the last frame, {time.last_frame}, which is before all that is planned"):
        return replace(scenario, time=replace(scenario.time, duration_s=float(lengths.sum())))


def with_speed(time: TimeOfScene, scenario: Scenario) -> Scenario:
    """Refuse played frames that are not as long as planned; Blender has single precision."""
    lengths, planned = time.frame_lengths_s, scenario.timeline.frame_lengths_s
    count = min(len(lengths), len(planned))
    if not np.allclose(lengths[:count], planned[:count], rtol=1e-6, atol=0.0):
        raise ScenarioError("the speed of the simulation, which is animated")
    return scenario


def with_first_frame(time: TimeOfScene, scenario: Scenario) -> Scenario:
    """Refuse another start frame than `START_FRAME`."""
    if time.start_frame != START_FRAME:
        raise ScenarioError(f"the first frame, {time.start_frame}")
    return scenario


def _common(bodies: BodySettings, rows: Sequence[int], names: Mapping[str, str], table: Table) -> dict[str, Any]:
    """Return the values that all of some bodies have in common, by the keys of their table."""
    values = {key: bodies.common(name, rows) for key, name in names.items()}
    return _read({key: common[0] for key, common in values.items() if len(common) == 1}, table)


def _read(values: Mapping[str, Any], table: Table) -> dict[str, Any]:
    """Return Blender's single-precision values in the decimals of the table where they mean the same."""
    return {name: as_given(value, getattr(table, name)) for name, value in values.items()}


def _replaced(table: _Table, values: Mapping[str, Any]) -> _Table:
    return replace(table, **values) if any(getattr(table, name) != value for name, value in values.items()) else table
