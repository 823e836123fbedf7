"""A whole demolition as Blender data: shards, connections, ground and tools."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import bpy

from ..engineering.elasticity.section_stiffness import DAMPING_RATIO
from ..engineering.mechanics.strength import Ductility, Strength
from ..errors import SimulationError
from ..model.blast.settings import Apply
from ..model.bridge.extent import room_around, surface_height
from ..model.scenario import Scenario
from ..model.structure.model import Model
from ..model.structure.start_motion import start_motions
from .blast.charges import charge_objects, create_charges
from .blast.force_fields import build_force_objects
from .blast.settings import keep_blast
from .bodies import bodies_of, create_flat_ground, create_shards, create_surface, create_terrain, is_marked, mark_member
from .connections.breaking_settings import Breaking, keep_bars, keep_breaking
from .connections.constraints import create_connections
from .connections.elasticity import forget_elasticity, keep_elasticity
from .connections.joints import set_joints
from .connections.soil import keep_soil
from .start_motion import keep_start_motion
from .structural_changes import keep_changes, keep_loads
from .time_scale import animate_time_scale, stop_animation
from .tools.ball import create_ball, create_hits
from .tools.cable import create_cable
from .tools.ground_motion import keep_ground_motion, move_with_ground
from .tools.jackhammer import create_jackhammer
from .world import START_FRAME, create_world, off_scene, remove_world, settings_restored_on_failure

FIRST_STEP_FRAME = START_FRAME + 2
"""First frame that time leads to: in the frame before, Blender makes the world and no time passes."""


def build_demolition(scene: bpy.types.Scene, scenario: Scenario, model: Model) -> list[bpy.types.Object]:
    """Put a model and everything around it into an empty scene, ready to be played from its start frame.

    Returns
    -------
    list of bpy.types.Object
        The shards, in the model's order.

    Raises
    ------
    GeometryError
        Nothing lies under the ball or under the beginning of a jackhammer's path; nothing was made.
    ScenarioError
        There is no record that the ground could move by; nothing was made.
    SimulationError
        Blender is not in object mode, which fields need; nothing is left of what was made.
    """
    surfaces = _surfaces(scenario, model)
    record = scenario.ground_record
    with settings_restored_on_failure(scene), _all_or_nothing(scene):
        shards = _build(scene, scenario, model, *surfaces)
        keep_ground_motion(scene, record, scenario.ground_motion.start_s if record else 0.0)
        if record:
            start_s = scenario.ground_motion.start_s
            move_with_ground(scene, record, start_s, FIRST_STEP_FRAME - 1, scenario.timeline)
        return shards


def check_replaceable(scene: bpy.types.Scene, scenario: Scenario, model: Model) -> None:
    """See that what was built in a scene can be removed and another model built in its place, and change nothing.

    Raises
    ------
    GeometryError
        As `build_demolition`.
    ScenarioError
        There is no record that the ground could move by.
    SimulationError
        The rigid-body world has bodies that were not built here, and would stay.
    """
    if others := [body.name for body in bodies_of(scene) if not is_marked(body)]:
        raise SimulationError(
            f"the rigid-body world has {len(others)} bodies that were not built here, such as {others[0]!r}: take them "
            "out of it, or build in a new scene"
        )
    _surfaces(scenario, model)
    _ = scenario.ground_record


def _surfaces(scenario: Scenario, model: Model) -> tuple[list[float], list[float]]:
    """Return the heights, m, under the targets of the ball and where jackhammers begin."""
    drops = scenario.ball.drops if scenario.ball else ()
    dropped = [surface_height(scenario, model.members, drop.target_m) for drop in drops]
    return dropped, [surface_height(scenario, model.members, hammer.path_m[0]) for hammer in scenario.jackhammers]


def _build(
    scene: bpy.types.Scene, scenario: Scenario, model: Model, surfaces: Sequence[float], hammered: Sequence[float]
) -> list[bpy.types.Object]:
    """Build on surfaces at these heights, m, under the targets of the ball and where jackhammers begin."""
    settings = scenario.ball
    world = create_world(scene, scenario.time, last_frame(scenario))
    ground = _create_ground(world, scenario, model)
    if settings:
        ball = create_ball(world, settings, surfaces[0] if surfaces else 0.0, START_FRAME, release_frame(scenario))
        if settings.cable:
            create_cable(world, ball, settings.cable)
        create_hits(ball, settings, surfaces, FIRST_STEP_FRAME, scenario.timeline)
    for hammer, surface in zip(scenario.jackhammers, hammered, strict=True):
        create_jackhammer(world, hammer, surface, FIRST_STEP_FRAME - 1, scenario.timeline)
    joints = scenario.joints
    keep_breaking(scene, _breaking(scenario, joints[0].strength))
    keep_changes(scene, scenario.changes)
    keep_loads(scene, scenario.loads)
    with off_scene(scene) as (bodies, connections):
        shards = create_shards(bodies, scenario.shards, model.shards, model.centres_m, model.masses_kg)
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
        if model.stiffness is None:
            forget_elasticity(scene)
        else:
            ratio = scenario.connections.damping_ratio
            ratio = DAMPING_RATIO if ratio is None else ratio
            keep_elasticity(scene, made, model.stiffness, ratio, model.thicknesses_m())
    if not charge_objects(scene):  # those that the user has placed stay the objects that they are
        create_charges(scene, scenario.charges)
    keep_blast(scene, scenario.blast)
    if scenario.charges and scenario.blast.apply == Apply.FIELDS:
        build_force_objects(scene, bodies_of(scene))
    animate_time_scale(scene, scenario.timeline, FIRST_STEP_FRAME)
    return shards


def _create_ground(world: bpy.types.RigidBodyWorld, scenario: Scenario, model: Model) -> bpy.types.Object:
    """Make the ground and the surfaces on it, and return the ground."""
    if model.ground.terrain is None:
        ground = create_flat_ground(world, room_around(scenario, model.members), scenario.ground)
    else:
        ground = create_terrain(world, model.ground.terrain.mesh, scenario.ground, model.ground.facts)
    for surface in model.ground.surfaces:
        create_surface(world, surface.mesh, surface.settings)
    return ground


@contextmanager
def _all_or_nothing(scene: bpy.types.Scene) -> Iterator[None]:
    """Remove the world and all data that were made in the block where it fails: there is no undo of half a button."""
    before = set(_all_data())
    try:
        yield
    except BaseException:
        stop_animation(scene)
        remove_world(scene)
        bpy.data.batch_remove([each for each in _all_data() if each not in before])
        raise


def _all_data() -> Iterator[bpy.types.ID]:
    """Give everything of the kinds that a demolition is made of."""
    for kind in (bpy.data.objects, bpy.data.meshes, bpy.data.collections, bpy.data.actions):
        yield from kind


def _breaking(scenario: Scenario, strength: Strength | None) -> Breaking:
    settings = scenario.connections
    if strength is None:
        return Breaking(warm_up_s=settings.warm_up_s, warm_up_damping=settings.warm_up_damping)
    elongation = settings.ductile_elongation_m
    ductility = None if elongation is None else Ductility(settings.ductile_share, elongation)
    return Breaking(strength, settings.warm_up_s, ductility, settings.warm_up_damping, scenario.steel)


def last_frame(scenario: Scenario) -> int:
    """Return the frame at which a scenario's duration is over."""
    return FIRST_STEP_FRAME - 1 + len(scenario.timeline)


def release_frame(scenario: Scenario) -> int:
    """Return the first frame towards which the ball falls freely."""
    return first_frame_after(scenario, scenario.ball.release_time_s)


def first_frame_after(scenario: Scenario, time_s: float) -> int:
    """Return the first frame that begins at a simulated time or later."""
    return FIRST_STEP_FRAME + scenario.timeline.frames_until(time_s)
