"""Where Blender and Bullet keep what is read: byte offsets from the start of each structure, 64-bit.

Bullet 3.07 as Blender 4.2 to 5.2 compiles it, in double precision. The Linux and macOS columns follow the System V
C++ ABI and were measured on Linux; the Windows columns follow Microsoft's ABI, where vectors are aligned to 16 bytes,
and are derived from its compiler's rules. A table is never trusted for its platform's sake: `checks` holds every
entry against values that Blender itself gives out.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass, replace


@dataclass(frozen=True, slots=True)
class BlenderLayout:
    """Blender's own structures, the same on every platform."""

    body_shared: int = 80
    world_shared: int = 40
    world_substeps: int = 76
    world_iterations: int = 78
    world_time_scale: int = 84
    shared_physics_world: int = 24
    connection_physics: int = 144
    physics_world_dispatcher: int = 16
    physics_world_broadphase: int = 24
    physics_world_solver: int = 32


@dataclass(frozen=True, slots=True)
class BodyLayout:
    """btRigidBody. The transform is three rows of four doubles, then the origin."""

    transform: int
    activation: int
    friction: int
    internal_type: int
    user_pointer: int
    linear_velocity: int
    angular_velocity: int
    inverse_mass: int
    linear_damping: int

    @property
    def origin(self) -> int:
        """The origin of the transform, behind its 3 × 4 matrix."""
        return self.transform + 96


@dataclass(frozen=True, slots=True)
class ConstraintLayout:
    """btTypedConstraint."""

    type: int = 8
    breaking_threshold: int = 24
    enabled: int = 32
    body_a: int = 40
    body_b: int = 48
    joint_feedback: int = 72


@dataclass(frozen=True, slots=True)
class WorldLayout:
    """btDiscreteDynamicsWorld, with the solver's settings inside it."""

    dispatcher: int = 40
    broadphase: int = 128
    user_info: int = 168
    step: int = 200
    iterations: int = 216
    warm_starting: int = 336
    solver: int = 456


@dataclass(frozen=True, slots=True)
class Layout:
    """All offsets of one platform."""

    name: str
    body: BodyLayout
    blender: BlenderLayout = BlenderLayout()
    constraint: ConstraintLayout = ConstraintLayout()
    world: WorldLayout = WorldLayout()


SYSTEM_V = Layout(
    name="System V",
    body=BodyLayout(
        transform=8,
        activation=424,
        friction=440,
        internal_type=488,
        user_pointer=496,
        linear_velocity=720,
        angular_velocity=752,
        inverse_mass=784,
        linear_damping=984,
    ),
)

MICROSOFT = replace(
    SYSTEM_V,
    name="Microsoft",
    body=BodyLayout(
        transform=16,
        activation=432,
        friction=448,
        internal_type=496,
        user_pointer=504,
        linear_velocity=736,
        angular_velocity=768,
        inverse_mass=800,
        linear_damping=1008,
    ),
)

RIGID_BODY = 2
"""Bullet's internal type of a rigid body (btCollisionObject::CO_RIGID_BODY)."""

CONSTRAINT_TYPES = {
    "POINT": frozenset({3}),
    "HINGE": frozenset({4}),
    "GENERIC": frozenset({6}),
    "MOTOR": frozenset({6}),
    "SLIDER": frozenset({7}),
    "PISTON": frozenset({7}),
    "GENERIC_SPRING": frozenset({9, 12}),
    "FIXED": frozenset({12}),
}
"""Bullet's number (btTypedConstraintType) for each kind of constraint that Blender makes."""

ACTIVATION_STATES = frozenset({1, 2, 3, 4, 5})
"""Active, sleeping, wants to sleep, never sleeps, disabled."""

WARM_STARTING = 0.85
"""Bullet's default warm-starting factor, which Blender leaves alone: a mark to know the solver's settings by."""


def platform_layout() -> Layout:
    """Layout of the platform that Blender runs on."""
    return MICROSOFT if sys.platform == "win32" else SYSTEM_V
