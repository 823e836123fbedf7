"""A whole demolition as Blender data: a model's shards and connections, the ground and the ball."""

from __future__ import annotations

import math

import bpy

from ..core.bridge import deck_top
from ..core.model import Model
from ..core.scenario import BlastSettings, ConnectionSettings, Scenario
from ..core.strength import MATERIALS, Ductility
from .bodies import bodies_of, create_ball, create_ground, create_shards
from .breaking import Breaking, keep_breaking
from .cable import create_cable
from .changes import keep_changes, mark_member
from .charges import create_charges
from .connections import create_connections
from .explosion import Apply, ExplosionSettings, keep_explosion
from .force_fields import build_force_objects
from .jackhammer import create_jackhammer
from .joints import set_joints
from .lifts import create_hits
from .slow_motion import animate_time_scale
from .world import START_FRAME, create_world, off_scene

FIRST_STEP_FRAME = START_FRAME + 2
"""First frame that time leads to: Blender makes the world in the frame before, in which no time passes."""

_DEBRIS_ROOM = 10.0
"""Ground to each side of the bridge, as a multiple of its height; debris of a felled bridge stays well inside."""


def build_demolition(scene: bpy.types.Scene, scenario: Scenario, model: Model) -> None:
    """Put a model and everything around it into an empty scene, ready to be played from its start frame."""
    world = create_world(scene, scenario.time, last_frame(scenario))
    ground = create_ground(world, _ground_half_size(scenario), scenario.ground)
    if scenario.ball:
        top = deck_top(scenario.bridge)
        ball = create_ball(world, scenario.ball, top, START_FRAME, release_frame(scenario))
        if scenario.ball.cable:
            create_cable(world, ball, scenario.ball.cable)
        create_hits(ball, scenario.ball, top, FIRST_STEP_FRAME, scenario.timeline)
    for hammer in scenario.jackhammers:
        create_jackhammer(world, hammer, deck_top(scenario.bridge), FIRST_STEP_FRAME - 1, scenario.timeline)
    keep_breaking(scene, _breaking(scenario.connections))
    keep_changes(scene, scenario.changes)
    with off_scene(scene) as (bodies, connections):
        shards = create_shards(bodies, scenario.shards, model.shards, model.centres_m, model.masses_kg)
        for shard, row in zip(shards, model.member_of_shard, strict=True):
            mark_member(shard, model.members[row].name, model.members[row].kind)
        made = create_connections(connections, model.connections, shards, ground, model.second_moments_m4)
        set_joints(made, scenario.connections.joints, model.joint_of_connection, scenario.time.step)
    create_charges(scene, scenario.placed_charges)
    keep_explosion(scene, _explosion(scenario.blast))
    if scenario.charges and scenario.blast.apply == Apply.FIELDS:
        build_force_objects(scene, bodies_of(scene))
    animate_time_scale(scene, scenario.timeline, FIRST_STEP_FRAME)


def _breaking(settings: ConnectionSettings) -> Breaking:
    if settings.material is None:
        return Breaking(warm_up_s=settings.warm_up_s, warm_up_damping=settings.warm_up_damping)
    share, elongation = settings.ductile_share, settings.ductile_elongation_m
    ductility = Ductility(share, elongation) if share > 0.0 else None
    return Breaking(MATERIALS[settings.material], settings.warm_up_s, ductility, settings.warm_up_damping)


def _explosion(settings: BlastSettings) -> ExplosionSettings:
    return ExplosionSettings(settings.explosion, Apply(settings.apply), settings.options)


def last_frame(scenario: Scenario) -> int:
    """Frame at which a scenario's duration is over."""
    return FIRST_STEP_FRAME - 1 + len(scenario.timeline)


def release_frame(scenario: Scenario) -> int:
    """First frame towards which the ball falls freely."""
    return FIRST_STEP_FRAME + scenario.timeline.frames_until(scenario.ball.release_time_s)


def _ground_half_size(scenario: Scenario) -> float:
    bridge = scenario.bridge
    top = deck_top(bridge)
    height = max(top, scenario.ball.largest_height_m(top) if scenario.ball else 0.0)
    return math.hypot(bridge.length_m, bridge.deck.width_m) + _DEBRIS_ROOM * height
