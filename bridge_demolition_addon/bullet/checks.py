"""Comparing every offset with values that Blender itself shows, before any of it is trusted.

All reads here are fault-free, so that a wrong offset ends in a `LayoutError` and never in a crash.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import bpy
import numpy as np

from ..errors import LayoutError
from .layout import (
    ACTIVATION_STATES,
    CONSTRAINT_TYPES,
    DRAWING_SIZE,
    FIRST_STEP_S,
    ONE_DIRECTION,
    RIGID_BODY,
    ROLLING,
    SLOW_BOUNCE_M_S,
    WARM_STARTING,
    Layout,
)
from .memory import read, read_pointer, read_pointers_at, read_value, read_values

_LONGEST_S = 1e9

_FLOAT32 = 1e-6
"""Relative spacing of the 32-bit values in Blender, with room for one rounding more."""

_ROTATION = 1e-4
"""How far elements of two rotation matrices in single precision may differ."""


def check_settings(layout: Layout, world: bpy.types.RigidBodyWorld) -> None:
    """Blender's own world structure holds the sub-steps, iterations and time scale that Python shows."""
    blender = layout.blender
    fields = (blender.world_substeps, "h"), (blender.world_iterations, "h"), (blender.world_time_scale, "f")
    substeps, iterations, time_scale = read_values(world.as_pointer(), *fields)
    _expect("sub-steps of the world", substeps, world.substeps_per_frame)
    _expect("iterations of the world", iterations, world.solver_iterations)
    _expect_close("time scale of the world", time_scale, world.time_scale)


def is_physics_world(layout: Layout, address: int) -> bool:
    """Return whether an rbDynamicsWorld lies there: it names the same dispatcher, broadphase and solver as Bullet."""
    blender, bullet = layout.blender, layout.world
    of_blender = blender.physics_world_dispatcher, blender.physics_world_broadphase, blender.physics_world_solver
    try:
        dynamics, *here = read_pointers_at(address, 0, *of_blender)
        there = read_pointers_at(dynamics, bullet.dispatcher, bullet.broadphase, bullet.solver)
    except LayoutError:
        return False
    return here == there and all(here)


def check_solver(layout: Layout, dynamics: int, world: bpy.types.RigidBodyWorld, substep_s: float) -> None:
    """Bullet's solver settings are where they are expected."""
    _expect("solver iterations", read_value(dynamics + layout.world.iterations, "i"), world.solver_iterations)
    _expect("warm starting", read_value(dynamics + layout.world.warm_starting, "d"), WARM_STARTING)
    _expect("mode of the solver", read_value(dynamics + layout.world.mode, "i"), ONE_DIRECTION)
    _expect_close("rolling friction", read_value(dynamics + layout.world.rolling, "d"), ROLLING)
    _expect_close("speed without bounce", read_value(dynamics + layout.world.slow_bounce, "d"), SLOW_BOUNCE_M_S)
    step = read_value(dynamics + layout.world.step, "d")
    if not any(abs(step - known) <= _FLOAT32 * known for known in (FIRST_STEP_S, substep_s, 0.0)):
        raise LayoutError(f"solver step is {step:g} s, not {substep_s:g} s")


def check_bodies(
    layout: Layout, bodies: Iterable[tuple[bpy.types.Object, int, int]], depsgraph: bpy.types.Depsgraph
) -> None:
    """Each body's Bullet values are those that Python shows.

    A body is an object, the address of Blender's rbRigidBody and that of Bullet's btRigidBody. The dependency graph is
    evaluated for the present frame: it knows where the bodies are.
    """
    scene = depsgraph.scene
    gravity = np.array(scene.gravity, float) if scene.use_gravity else np.zeros(3)
    for body, holder, address in bodies:
        _check_body(layout, body, holder, address, gravity)
        _check_position(layout, body.evaluated_get(depsgraph), address)


def check_owners(layout: Layout, bodies: Iterable[tuple[bpy.types.Object, int, int]]) -> None:
    """Each of Bullet's bodies points back at Blender's; settings may have been edited, and are not compared."""
    for body, holder, address in bodies:
        _expect(f"user pointer of body {body.name!r}", read_pointer(address + layout.body.user_pointer), holder)


def check_connections(
    layout: Layout, connections: Iterable[tuple[bpy.types.Object, int]], bodies: dict, *, were_edited: bool = False
) -> None:
    """Each connection has a known type, its own two bodies and its own breaking threshold.

    A connection is an object and the address of Bullet's btTypedConstraint; addresses of bodies are by object. Where
    settings were edited, Bullet's constraints were made from others, and only types are compared.
    """
    for connection, address in connections:
        if were_edited:
            type_ = read_value(address + layout.constraint.type, "i")
            _expect_member(
                f"type of connection {connection.name!r}", type_, frozenset().union(*CONSTRAINT_TYPES.values())
            )
        else:
            _check_connection(layout, connection, address, bodies)


def _check_body(layout: Layout, body: bpy.types.Object, holder: int, address: int, gravity: np.ndarray) -> None:
    offsets, settings, name = layout.body, body.rigid_body, f"of body {body.name!r}"
    value = _structure(address, offsets.linear_damping + 8, name)
    _expect(f"user pointer {name}", value("Q", offsets.user_pointer), holder)
    _expect_member(f"activation state {name}", value("i", offsets.activation), ACTIVATION_STATES)
    slow_s = value("d", offsets.deactivation_time)
    if not 0.0 <= slow_s <= _LONGEST_S:
        raise LayoutError(f"time {name} at rest is {slow_s:g} s")
    _expect(f"internal type {name}", value("i", offsets.internal_type), RIGID_BODY)
    _expect_close(f"friction {name}", value("d", offsets.friction), settings.friction)
    _expect_close(f"damping {name}", value("d", offsets.linear_damping), settings.linear_damping)
    _check_inverse_mass(name, value("d", offsets.inverse_mass), settings)
    weight = [value("d", offsets.gravity + 8 * axis) for axis in range(3)]
    _check_weight(name, weight, value("d", offsets.inverse_mass), gravity)


def _check_inverse_mass(name: str, inverse_mass: float, settings: bpy.types.RigidBodyObject) -> None:
    if settings.type == "PASSIVE" or inverse_mass == 0.0:
        dynamic = settings.type == "ACTIVE" and settings.enabled and not settings.kinematic
        # Animation can hold a body still that Python already shows as free, or the other way round, within a frame.
        if inverse_mass != 0.0 or (dynamic and not _is_animated(settings)):
            raise LayoutError(f"inverse mass {name} is {inverse_mass:g}")
        return
    _expect_close(f"mass {name}", 1.0 / inverse_mass, settings.mass)


def _check_weight(name: str, weight: Sequence[float], inverse_mass: float, gravity: np.ndarray) -> None:
    """Bullet keeps the weight of every body that moves; Blender has just set it from the scene's gravity."""
    if inverse_mass == 0.0:
        return
    difference = np.array(weight, float) * inverse_mass - gravity
    _expect_close(f"weight {name}", abs(difference).max() / max(1.0, abs(gravity).max()), 0.0)


def _is_animated(settings: bpy.types.RigidBodyObject) -> bool:
    return settings.id_data.animation_data is not None


def _check_position(layout: Layout, body: bpy.types.Object, address: int) -> None:
    """Bullet's transform, three rows of four doubles and an origin, is that of the body without its scale."""
    raw = read(address + layout.body.transform, 15 * 8)
    if raw is None:
        raise LayoutError(f"transform of body {body.name!r} cannot be read")
    transform = np.frombuffer(raw)
    position, rotation, _ = body.matrix_world.decompose()
    expected = np.column_stack((np.array(rotation.to_matrix(), float), np.zeros(3)))
    size = 1.0 + np.abs(position).max()
    _expect_close(f"position of body {body.name!r}", abs(transform[12:] - position).max() / size, 0.0)
    # Rotations pass through single-precision quaternions, which costs some digits.
    off = abs(np.delete(transform[:12].reshape(3, 4) - expected, 3, axis=1)).max()
    if not off <= _ROTATION:
        raise LayoutError(f"rotation of body {body.name!r} is off by {off:g}")


def _check_connection(layout: Layout, connection: bpy.types.Object, address: int, bodies: dict) -> None:
    offsets, settings, name = layout.constraint, connection.rigid_body_constraint, f"of connection {connection.name!r}"
    value = _structure(address, offsets.drawing_size + 8, name)
    _expect_member(f"type {name}", value("i", offsets.type), CONSTRAINT_TYPES[settings.type])
    expected = {bodies.get(settings.object1), bodies.get(settings.object2)}
    if None not in expected:
        _expect(f"bodies {name}", {value("Q", offsets.body_a), value("Q", offsets.body_b)}, expected)
    if settings.use_breaking:
        threshold = value("d", offsets.breaking_threshold)
        _expect_close(f"breaking threshold {name}", threshold, settings.breaking_threshold)
    _expect_member(f"enabled flag {name}", value("B", offsets.enabled), {0, 1})
    _expect_close(f"drawing size {name}", value("d", offsets.drawing_size), DRAWING_SIZE)


def _structure(address: int, size: int, name: str) -> Callable[[str, int], Any]:
    """Read a structure, and return what gives one of its values, in `struct` notation, by its offset."""
    raw = read(address, size)
    if raw is None:
        raise LayoutError(f"memory {name} cannot be read")

    def value(format_: str, offset: int) -> Any:
        if not 0 <= offset <= size - struct.calcsize("<" + format_):
            raise LayoutError(f"a value {name} lies outside of it")
        return struct.unpack_from("<" + format_, raw, offset)[0]

    return value


def _expect(name: str, value: object, expected: object) -> None:
    if value != expected:
        raise LayoutError(f"{name} is {value}, not {expected}")


def _expect_close(name: str, value: float, expected: float) -> None:
    if not abs(value - expected) <= _FLOAT32 * max(1.0, abs(expected)):
        raise LayoutError(f"{name} is {value:g}, not {expected:g}")


def _expect_member(name: str, value: int, expected: Iterable[int]) -> None:
    if value not in expected:
        raise LayoutError(f"{name} is {value}")
