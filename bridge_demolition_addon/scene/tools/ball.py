"""The wrecking ball: released, lifted by animation, released again; and its cable on the tip of a crane."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np
from mathutils import Matrix

from ...engineering.geometry.solids import box, sphere
from ...model.scenario import Ball, BallCable
from ...model.scenario.ball import lift_path
from ...model.scenario.kept import values_text
from ...model.schema import given
from ..bodies import Kind, create_body, mesh_of, set_surface
from ..connections.constraints import mark_cable
from ..custom_properties import edited, kept_values
from ..world import START_FRAME
from .build_site import BuildSite
from .keyframes import key_values

_LIFTS = "bda_lifts"
_BALL_SEGMENTS = 88
_STEEL = (0.08, 0.09, 0.10, 1.0)
_CRANE_SIZE_M = 0.3
_APART_FROM_ALL = 19
"""Collision collection of the crane's tip alone, so that nothing hits it."""


def create_ball(site: BuildSite, settings: Ball) -> bpy.types.Object:
    """Make a wrecking ball above its target, or on its cable: fixed by animation up to its release, then free.

    In the release frame it is free for the first time, so that it falls in the step towards that frame.
    """
    surfaces_m = [site.height_at(given(drop.target_m)) for drop in settings.drops]
    radius = settings.diameter_m / 2.0
    ball = create_body(site.world, mesh_of("Wrecking ball", sphere(radius, _BALL_SEGMENTS)), Kind.BALL, "SPHERE")
    ball.location = settings.start_m(surfaces_m[0] if surfaces_m else 0.0)
    ball.color = _STEEL
    rigid = ball.rigid_body
    rigid.mass = settings.mass_kg
    set_surface(rigid, site.surface_of(settings), 0.0)
    # Air does not slow a ball of steel over a few metres; Blender's default damping would, by some percent.
    rigid.linear_damping, rigid.angular_damping = 0.0, settings.angular_damping
    rigid.use_deactivation = False
    for frame, is_fixed in ((START_FRAME, True), (site.frame_after(settings.release_time_s), False)):
        rigid.kinematic = is_fixed
        ball.keyframe_insert("rigid_body.kinematic", frame=frame)
    rigid.kinematic = True
    # Blender animates a body before it simulates it only where its position is animated; otherwise it may let go of the
    # ball a frame late, as its threads happen to run.
    ball.keyframe_insert("location", frame=START_FRAME)
    if settings.cable:
        _create_cable(site.world, ball, settings.cable)
    if settings.hits:
        _create_hits(site, ball, settings, surfaces_m)
    return ball


def _create_cable(world: bpy.types.RigidBodyWorld, ball: bpy.types.Object, settings: BallCable) -> None:
    """Fix a point of the ball's own solid to a crane by a constraint that never breaks and is no connection."""
    crane = create_body(world, mesh_of("Crane", box((_CRANE_SIZE_M,) * 3, (0.0, 0.0, 0.0))), Kind.CRANE, "BOX")
    crane.location = settings.crane_point_m
    crane.rigid_body.type = "PASSIVE"
    crane.rigid_body.collision_collections = [number == _APART_FROM_ALL for number in range(20)]
    cable = bpy.data.objects.new("Cable", None)
    cable.location = settings.crane_point_m
    world.constraints.objects.link(cable)
    constraint = cable.rigid_body_constraint
    constraint.type = "POINT"
    constraint.object1, constraint.object2 = crane, ball
    constraint.disable_collisions = False
    mark_cable(cable)


def _create_hits(site: BuildSite, ball: bpy.types.Object, settings: Ball, surfaces_m: Sequence[float]) -> None:
    """Animate all hits but the first; `surfaces_m` are the heights of the tops at every hit."""
    radius = settings.diameter_m / 2.0
    start = tuple(ball.location)
    release_frame = site.frame_after(settings.release_time_s)
    key_values(ball, "location", [START_FRAME, release_frame], [start, start])
    key_values(ball, "rotation_euler", [START_FRAME], [ball.rotation_euler], constant=True)
    along, across = given(settings.target_m)
    lying = (along, across, surfaces_m[0] + radius)
    for hit, surface in zip(settings.hits, surfaces_m[1:], strict=True):
        end = (*hit.target_m, surface + hit.drop_height_m + radius)
        first, last = (site.timeline.frames_until(time_s) for time_s in (hit.lift_time_s, hit.lift_end_s))
        times = np.concatenate(([0.0], np.cumsum(site.timeline.frame_lengths_s[first:last])))
        lift_frame, release_frame = site.frame_after(hit.lift_time_s), site.frame_after(hit.release_time_s)
        plan_lift(ball, lift_frame, times / times[-1], lying, end)
        key_values(ball, "rigid_body.kinematic", [lift_frame, release_frame], [1.0, 0.0], constant=True)
        key_values(ball, "location", [release_frame], [end])
        lying = (*hit.target_m, surface + radius)


def plan_lift(
    ball: bpy.types.Object,
    lift_frame: int,
    shares: np.ndarray,
    start_m: tuple[float, float, float],
    end_m: tuple[float, float, float],
) -> None:
    """Animate a lift of the ball; animation leads it for the first time in the step towards `lift_frame`.

    The shares (k,), 0 to 1, of the lift's time have passed in the frame before `lift_frame` and those after it. The
    start is a guess, which `lift_from` corrects.
    """
    lifts = kept_values(ball, _LIFTS, [])
    ball[_LIFTS] = values_text([*lifts, [lift_frame, np.asarray(shares).tolist(), list(end_m)]])
    key_values(ball, "location", _frames(lift_frame, shares), lift_path(start_m, end_m, shares))


def lifts_of(ball: bpy.types.Object) -> list[tuple[int, np.ndarray, np.ndarray]]:
    """Return first frame, shares of time (k,) and end (3,), m, of every planned lift."""
    lifts = kept_values(ball, _LIFTS, [])
    try:
        return [(int(frame), np.array(shares, float), np.array(end, float)) for frame, shares, end in lifts]
    except (TypeError, ValueError) as error:
        raise edited(ball, _LIFTS, "frames, shares and positions of lifts") from error


def begin_lifts(balls: Sequence[bpy.types.Object], frame: int, depsgraph: bpy.types.Depsgraph) -> None:
    """Have balls whose lift begins in the next frame go up from where they are."""
    for ball in balls:
        for lift_frame, shares, end in lifts_of(ball):
            if frame == lift_frame - 1:
                lift_from(ball, lift_frame, shares, end, ball.evaluated_get(depsgraph).matrix_world)


def lift_from(ball: bpy.types.Object, lift_frame: int, shares: np.ndarray, end_m: np.ndarray, matrix: Matrix) -> None:
    """Make a lift begin where the ball is in the frame before it, as its matrix says.

    Blender takes a body that animation begins to lead to its animated position and rotation within one frame, at any
    speed.
    """
    position, rotation, _ = matrix.decompose()
    frames = _frames(lift_frame, shares)
    key_values(ball, "location", frames, lift_path(np.array(position, float), end_m, shares))
    key_values(ball, "rotation_euler", frames[:1], [rotation.to_euler(ball.rotation_mode)], constant=True)


def _frames(lift_frame: int, shares: np.ndarray) -> np.ndarray:
    return lift_frame - 1 + np.arange(len(shares))
