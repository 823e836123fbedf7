"""Fields of Blender and Bullet that are read: byte offsets from the start of each structure, 64-bit.

Bullet 3.07 as Blender 4.2 to 5.2 compiles it, in double precision. The Linux and macOS columns follow the System V
C++ ABI and were measured on Linux; the Windows columns follow Microsoft's ABI, where vectors are aligned to 16 bytes.
They are confirmed with the Windows build of bpy 5.0.1 under wine: `scripts/test_windows` passes all of `tests/bullet`
and the tests of elastic connections there. A table is never trusted for its platform's sake: `checks` holds every
entry that is written as a number against values of Blender.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass, replace


@dataclass(frozen=True, slots=True)
class Behind:
    """Offset of a field that lies so many bytes behind another field of its structure."""

    field: str
    distance: int

    def __get__(self, structure: object, _class: type) -> int:
        return int(getattr(structure, self.field)) + self.distance


@dataclass(frozen=True, slots=True)
class SpringRows:
    """Offsets of a value in the six rows of a spring, from where its shifts and its first rotation begin."""

    linear: int
    angular: int

    def __get__(self, spring: SpringLayout, _class: type) -> tuple[int, ...]:
        shifts = (spring.linear + self.linear + 8 * row for row in range(3))
        rotations = (spring.angular + self.angular + spring.angular_size * row for row in range(3))
        return (*shifts, *rotations)


@dataclass(frozen=True, slots=True)
class BlenderLayout:
    """Blender's own structures, the same on every platform."""

    body_shared: int = 80
    world_shared: int = 40
    world_substeps: int = 76
    shared_physics_world: int = 24
    connection_physics: int = 144
    physics_world_dispatcher: int = 16
    physics_world_broadphase: int = 24
    physics_world_solver: int = 32

    world_last_frame = Behind("world_shared", -4)  # frame simulated last, a float
    world_iterations = Behind("world_substeps", 2)  # of the solver, a short
    world_time_scale = Behind("world_substeps", 8)  # behind the two shorts and the flags


@dataclass(frozen=True, slots=True)
class BodyLayout:
    """btRigidBody.

    Velocities have no counterpart in Blender to be checked against, and are placed by their checked neighbour.
    """

    transform: int
    friction: int
    internal_type: int
    user_pointer: int
    inverse_mass: int
    gravity: int
    linear_damping: int

    inverse_inertia = Behind("inverse_mass", -160)  # three rows of the tensor in the axes of the world
    linear_velocity = Behind("inverse_mass", -64)
    angular_velocity = Behind("inverse_mass", -32)
    total_force = Behind("gravity", 96)  # in the coming step, with the weight
    total_torque = Behind("gravity", 128)
    collision_flags = Behind("user_pointer", -88)  # whether it is static or kinematic, and answers contacts
    activation = Behind("user_pointer", -72)  # state of activation
    deactivation_time = Behind("user_pointer", -64)  # how long the body has been slow
    ignored_bodies_count = Behind("user_pointer", 60)  # length of the list of bodies that it does not collide with
    ignored_bodies_data = Behind("user_pointer", 72)  # first entry of that list
    constraints = Behind("linear_damping", 80)  # array of those that keep the body from colliding


@dataclass(frozen=True, slots=True)
class ConstraintLayout:
    """btTypedConstraint. Its fields follow one another without gaps from the bodies on."""

    type: int = 8
    breaking_threshold: int = 24
    body_a: int = 40

    enabled = Behind("body_a", -8)  # set until the constraint breaks
    body_b = Behind("body_a", 8)
    applied_impulse = Behind("body_a", 16)  # of the last solver row, which is all that Bullet compares with thresholds
    drawing_size = Behind("body_a", 24)  # in debug drawings; Blender leaves it at its default
    joint_feedback = Behind("body_a", 32)  # where Bullet writes the constraint's loads, when set


@dataclass(frozen=True, slots=True)
class SpringLayout:
    """btGeneric6DofSpring2Constraint: Blender makes it for FIXED, and for springs of the second kind.

    Frames are three rows of four doubles and an origin. Limits of the three shifts lie beside one another; those of
    each rotation lie in a block of their own.
    """

    linear: int
    angular: int
    flags: int
    frame_a: int = 80
    frame_b: int = 208
    angular_size: int = 176

    lower = SpringRows(0, 0)  # lower limits
    upper = SpringRows(32, 8)  # upper limits
    correction = SpringRows(96, 24)  # shares of an error that are corrected in a sub-step (ERP)
    softness = SpringRows(128, 32)  # CFM


@dataclass(frozen=True, slots=True)
class WorldLayout:
    """btDiscreteDynamicsWorld, with the solver's settings (btContactSolverInfo) inside it."""

    dispatcher: int = 40
    broadphase: int = 128
    solver_settings: int = 176
    solver: int = 456

    bodies = Behind("dispatcher", -32)  # array of all bodies
    constraints = Behind("solver", 16)  # array of all constraints
    moving_bodies = Behind("solver", 48)  # array of the bodies that can move
    after_step = Behind("solver_settings", -24)  # function called after every step; Blender sets none
    before_step = Behind("solver_settings", -16)  # the same before it, once gravity is in the forces
    user_info = Behind("solver_settings", -8)  # for the user of the library; Blender does not use it
    step = Behind("solver_settings", 24)  # length of the last sub-step
    iterations = Behind("solver_settings", 40)
    warm_starting = Behind("solver_settings", 160)  # share of the last impulses that the solver starts with
    mode = Behind("solver_settings", 176)  # flags of the solver, an int
    rolling = Behind("solver_settings", 200)  # threshold of rolling friction, which Blender keeps
    least_change = Behind("solver_settings", 208)  # square of a change of velocity; a pass with less is the last
    slow_bounce = Behind("solver_settings", 216)  # speed up to which nothing bounces, which Blender keeps


@dataclass(frozen=True, slots=True)
class ContactPointLayout:
    """btManifoldPoint. Around the normal its fields follow one another without gaps; the lateral directions end it."""

    size: int
    normal: int = 128

    position_on_b = Behind("normal", -64)
    position_on_a = Behind("normal", -32)
    distance = Behind("normal", 32)  # between the two bodies, negative inside each other
    friction = Behind("normal", 40)  # of the two bodies combined
    normal_impulse = Behind("normal", 104)
    lateral_impulses = Behind("normal", 120)  # along the two lateral directions
    lateral_directions = Behind("size", -64)  # one after the other


@dataclass(frozen=True, slots=True)
class ManifoldLayout:
    """btPersistentManifold: up to four contact points in a row, then the two bodies and how many points there are."""

    points: int
    point: ContactPointLayout

    body_b = Behind("body_a", 8)
    count = Behind("body_a", 16)  # number of contact points

    @property
    def body_a(self) -> int:
        """First body."""
        return self.points + 4 * self.point.size


@dataclass(frozen=True, slots=True)
class DispatcherLayout:
    """btCollisionDispatcher: its array of pointers to all manifolds, from its pool and beyond."""

    manifolds: int = 16

    manifold_count = Behind("manifolds", 4)
    manifold_data = Behind("manifolds", 16)  # first entry


@dataclass(frozen=True, slots=True)
class ArrayLayout:
    """btAlignedObjectArray."""

    count: int = 4
    capacity: int = 8
    data: int = 16


@dataclass(frozen=True, slots=True)
class Layout:
    """All offsets of one platform."""

    name: str
    body: BodyLayout
    manifold: ManifoldLayout
    spring: SpringLayout
    dispatcher: DispatcherLayout = DispatcherLayout()
    blender: BlenderLayout = BlenderLayout()
    constraint: ConstraintLayout = ConstraintLayout()
    world: WorldLayout = WorldLayout()
    array: ArrayLayout = ArrayLayout()


SYSTEM_V = Layout(
    name="System V",
    body=BodyLayout(
        transform=8,
        friction=440,
        internal_type=488,
        user_pointer=496,
        inverse_mass=784,
        gravity=824,
        linear_damping=984,
    ),
    manifold=ManifoldLayout(points=8, point=ContactPointLayout(size=376)),
    spring=SpringLayout(linear=1344, angular=1904, flags=2876),
)

MICROSOFT = replace(
    SYSTEM_V,
    name="Microsoft",
    body=BodyLayout(
        transform=16,
        friction=448,
        internal_type=496,
        user_pointer=504,
        inverse_mass=800,
        gravity=848,
        linear_damping=1008,
    ),
    manifold=ManifoldLayout(points=16, point=ContactPointLayout(size=384)),
    spring=SpringLayout(linear=1392, angular=1968, flags=2948),
)

SPRING_TYPE = 12
"""Bullet's number of a btGeneric6DofSpring2Constraint."""

SPRING_CORRECTION = 0.2
"""Bullet's default share of an error that is corrected: a mark to know the rows of a constraint by."""

ALL_ROWS_SET = sum(3 << (4 * row) for row in range(6))
"""Flags which say that correction and softness of all six rows count."""

RIGID_BODY = 2
"""Bullet's internal type of a rigid body (btCollisionObject::CO_RIGID_BODY)."""

AWAKE, WANTS_SLEEP, ASLEEP, DISABLED = 1, 3, 2, 5
"""Activation states of a body: simulated, about to rest, at rest until something wakes it, and never simulated."""

SLEEPING = frozenset({ASLEEP, DISABLED})
"""Activation states in which a body is not simulated."""

ACTIVATION_STATES = frozenset({AWAKE, ASLEEP, WANTS_SLEEP, 4, DISABLED})
"""All activation states; 4 is that of a body that never sleeps."""

FIXED_FLAGS, NO_CONTACT_RESPONSE = 3, 4
"""Flags of bodies that are static (1) or kinematic (2), and of one whose contacts push nothing (btCollisionObject)."""

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

WARM_STARTING = 0.85
"""Bullet's default warm-starting factor, which Blender keeps: a mark to know the solver's settings by."""

ONE_DIRECTION, TWO_DIRECTIONS = 4 | 256, 4 | 256 | 16
"""Flags of the solver: warm starting, what it works with, and friction across the direction of sliding, too."""

ROLLING, SLOW_BOUNCE_M_S = 1e30, 0.2
"""Bullet's defaults beside the least change that makes another pass, in single precision: marks to know it by."""

DRAWING_SIZE = 0.05
"""Bullet's default size for debug drawings of constraints, in single precision: a mark to know a constraint by."""

FIRST_STEP_S = 1.0 / 60.0
"""Step of a new world's solver before it has taken any, in single precision."""


def platform_layout() -> Layout:
    """Return the layout of the platform that Blender runs on."""
    return MICROSOFT if sys.platform == "win32" else SYSTEM_V
