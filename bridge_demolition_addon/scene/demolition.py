"""A whole demolition as Blender data: shards, connections, ground and tools."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from itertools import chain
from typing import Any

import bpy

from ..engineering.elasticity.section_stiffness import DAMPING_RATIO
from ..engineering.mechanics.reinforcement import FaceBars
from ..engineering.mechanics.strength import Ductility, Strength
from ..errors import SimulationError
from ..model.actions import PlannedAction
from ..model.blast.settings import Apply
from ..model.bridge.preparation import room_around, surface_height
from ..model.pulls import Pull
from ..model.scenario import Ball, Jackhammer, Scenario
from ..model.sequence.checked_model import ModelWorksite, check_actions
from ..model.structure.model import Model, start_motions
from .as_built import keep_built_bodies
from .blast.charges import charge_objects, create_charges, keep_blast
from .blast.force_fields import build_force_objects
from .bodies import (
    bodies_of,
    create_flat_ground,
    create_shards,
    create_surface,
    create_terrain,
    is_marked,
    keep_start_motion,
    mark_member,
)
from .connections.constraints import Breaking, create_connections, keep_bars, keep_breaking, set_joints
from .connections.elasticity import (
    forget_elasticity,
    keep_elasticity,
    keep_pads,
    keep_soil,
    keep_tendons,
    name_bearings,
)
from .custom_properties import keep_run_tables, run_tables_of
from .tools.ball import create_ball
from .tools.build_site import BuildSite
from .tools.cables import create_cables
from .tools.ground_motion import keep_ground_motion, move_with_ground
from .tools.jackhammer import create_jackhammer
from .world import (
    FIRST_STEP_FRAME,
    animate_time_scale,
    create_world,
    off_scene,
    remove_world,
    settings_restored_on_failure,
    stop_animation,
)

TOOLS: dict[type[PlannedAction], Callable[[BuildSite, Any], object]] = {
    Ball: create_ball,
    Jackhammer: create_jackhammer,
}
"""Makers of the actions that are bodies of their own, in the order of a scenario's actions."""


def build_demolition(scene: bpy.types.Scene, scenario: Scenario, model: Model) -> list[bpy.types.Object]:
    """Put a model and everything around it into an empty scene, and return the shards in the model's order.

    The scene can be played from its start frame then.
    """
    record = scenario.ground_record
    with settings_restored_on_failure(scene), _all_or_nothing(scene):
        shards = _build(scene, scenario, model)
        start_s = scenario.ground_motion.start_s if scenario.ground_motion else 0.0
        keep_ground_motion(scene, record, start_s)
        if record:
            move_with_ground(scene, record, start_s, FIRST_STEP_FRAME - 1, scenario.timeline)
        return shards


def check_replaceable(scene: bpy.types.Scene, scenario: Scenario, model: Model) -> None:
    """Check that a model can be built in a scene in place of another, and change nothing."""
    if others := [body.name for body in bodies_of(scene) if not is_marked(body)]:
        raise SimulationError(
            f"the rigid-body world has {len(others)} bodies that were not built here, such as {others[0]!r}: take them "
            "out of it, or build in a new scene"
        )
    check_actions(scenario, model)


def _build(scene: bpy.types.Scene, scenario: Scenario, model: Model) -> list[bpy.types.Object]:
    world = create_world(scene, scenario.time, last_frame(scenario))
    ground = _create_ground(world, scenario, model)
    height_at = partial(surface_height, scenario, model.members)
    site = BuildSite(world, scenario.timeline, height_at, scenario.surface_of)
    for action in scenario.actions:
        if make := TOOLS.get(type(action)):
            make(site, action)
    joints = scenario.joints
    keep_breaking(scene, _breaking(scenario, joints[0].strength, model.bars))
    worksite = ModelWorksite(scenario, model)
    keep_run_tables(scene, [table for action in scenario.actions for table in action.in_run(worksite)])
    with off_scene(scene) as (bodies, connections):
        surface = scenario.surface_of(scenario.shards)
        shards = create_shards(bodies, scenario.shards, surface, model.shards, model.centres_m, model.masses_kg)
        for shard, row in zip(shards, model.member_of_shard, strict=True):
            mark_member(shard, model.members[row].name, model.members[row].kind)
        for row in model.fixed.nonzero()[0]:
            shards[row].rigid_body.type = "PASSIVE"
        keep_start_motion(shards, *start_motions(scenario.geometry, model))
        made = create_connections(connections, model.connections, shards, ground, model.second_moments_m4)
        if model.bars:
            keep_bars(made, model.bars)
        set_joints(made, joints, model.joint_of_connection, scenario.time.step)
        if model.soil:
            keep_soil(made, model.soil)
        if model.bearings:
            name_bearings(made, model.bearings.names, model.bearings.springs)
            if model.stiffness is not None:
                keep_pads(made, model.bearings.springs)
        keep_tendons(scene, model.tendons, shards, made)
        forget_elasticity(scene)
        if model.stiffness is not None:
            ratio = scenario.connections.damping_ratio
            ratio = DAMPING_RATIO if ratio is None else ratio
            keep_elasticity(scene, made, model.stiffness, ratio, model.thicknesses_m())
    if not charge_objects(scene):  # charges that the user has placed stay
        create_charges(scene, scenario.charges)
    keep_blast(scene, scenario.blast)
    if scenario.charges and scenario.blast.apply == Apply.FIELDS:
        build_force_objects(scene, bodies_of(scene))
    animate_time_scale(scene, scenario.timeline, FIRST_STEP_FRAME)
    keep_built_bodies(scene)
    create_cables(scene, run_tables_of(scene, Pull.kept_in), worksite.structure, shards)
    return shards


def _create_ground(world: bpy.types.RigidBodyWorld, scenario: Scenario, model: Model) -> bpy.types.Object:
    """Make the ground and the surfaces on it, and return the ground."""
    terrain, of_ground = model.ground.terrain, scenario.surface_of(scenario.ground)
    if terrain is None:
        ground = create_flat_ground(world, room_around(scenario, model.members), of_ground)
    else:
        ground = create_terrain(world, terrain.mesh, of_ground, model.ground.facts)
    for surface in model.ground.surfaces:
        create_surface(world, surface.mesh, surface.settings, scenario.surface_of(surface.settings))
    return ground


@contextmanager
def _all_or_nothing(scene: bpy.types.Scene) -> Iterator[None]:
    """Remove the world and all data that the block made where it fails: Blender does not undo half an operator."""
    before = set(_all_data())
    try:
        yield
    except BaseException:
        stop_animation(scene)
        remove_world(scene)
        bpy.data.batch_remove(set(_all_data()) - before)
        raise


def _all_data() -> Iterator[bpy.types.ID]:
    """Give all data of the kinds that a demolition is made of."""
    return chain(bpy.data.objects, bpy.data.meshes, bpy.data.collections, bpy.data.actions)


def _breaking(scenario: Scenario, strength: Strength | None, bars: FaceBars | None) -> Breaking:
    settings = scenario.connections
    if strength is None:
        return Breaking(warm_up_s=settings.warm_up_s, warm_up_damping=settings.warm_up_damping)
    elongation = settings.ductile_elongation_m
    ductility = None if elongation is None else Ductility(settings.ductile_share, elongation)
    return Breaking(strength, settings.warm_up_s, ductility, settings.warm_up_damping, scenario.steel, bars)


def last_frame(scenario: Scenario) -> int:
    """Return the frame at which a scenario's duration is over."""
    return FIRST_STEP_FRAME - 1 + len(scenario.timeline)


def first_frame_after(scenario: Scenario, time_s: float) -> int:
    """Return the first frame that begins at a simulated time or later."""
    return FIRST_STEP_FRAME + scenario.timeline.frames_until(time_s)
