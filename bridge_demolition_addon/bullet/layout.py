"""Where Blender and Bullet keep what is read: byte offsets from the start of each structure, 64-bit.

Bullet 3.07 as Blender 4.2 to 5.2 compiles it, in double precision. The Linux and macOS columns follow the System V
C++ ABI and were measured on Linux; the Windows columns follow Microsoft's ABI, where vectors are aligned to 16 bytes.
They are confirmed with the Windows build of bpy 5.0.1 under wine: `scripts/test_windows` passes all of `tests/bullet`
and the tests of elastic connections there. A table is never trusted for its platform's sake: `checks` holds every
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
    shared_physics_world: int = 24
    connection_physics: int = 144
    physics_world_dispatcher: int = 16
    physics_world_broadphase: int = 24
    physics_world_solver: int = 32

    @property
    def world_last_frame(self) -> int:
        """Frame simulated last, a float before the shared part."""
        return self.world_shared - 4

    @property
    def world_iterations(self) -> int:
        """Iterations of the solver, a short after the sub-steps."""
        return self.world_substeps + 2

    @property
    def world_time_scale(self) -> int:
        """Time scale, behind the two shorts and the flags."""
        return self.world_substeps + 8


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

    @property
    def linear_velocity(self) -> int:
        """Two vectors before the inverse mass."""
        return self.inverse_mass - 64

    @property
    def angular_velocity(self) -> int:
        """The vector before the inverse mass."""
        return self.inverse_mass - 32

    @property
    def inverse_inertia(self) -> int:
        """Inverse tensor of inertia in the axes of the world, three rows just before the linear velocity."""
        return self.inverse_mass - 160

    @property
    def total_force(self) -> int:
        """Sum of the forces of the coming step, three vectors after the body's weight; the torque follows."""
        return self.gravity + 96

    @property
    def activation(self) -> int:
        """State of activation, in the block of settings that ends with the user pointer."""
        return self.user_pointer - 72

    @property
    def deactivation_time(self) -> int:
        """How long the body has been slow, behind its state of activation."""
        return self.activation + 8

    @property
    def ignored_bodies_count(self) -> int:
        """Length of the list of bodies that this one does not collide with."""
        return self.user_pointer + 60

    @property
    def ignored_bodies_data(self) -> int:
        """First entry of that list."""
        return self.user_pointer + 72

    @property
    def constraints(self) -> int:
        """Array of the constraints that keep the body from colliding, behind damping and motion state."""
        return self.linear_damping + 80


@dataclass(frozen=True, slots=True)
class ConstraintLayout:
    """btTypedConstraint. Its fields follow one another without gaps from the bodies on."""

    type: int = 8
    breaking_threshold: int = 24
    body_a: int = 40

    @property
    def enabled(self) -> int:
        """Set until the constraint breaks."""
        return self.body_a - 8

    @property
    def body_b(self) -> int:
        """The other body."""
        return self.body_a + 8

    @property
    def applied_impulse(self) -> int:
        """Impulse of the constraint's last solver row, which is all that Bullet itself compares and shows."""
        return self.body_a + 16

    @property
    def drawing_size(self) -> int:
        """Size for debug drawings, which Blender leaves at its default."""
        return self.body_a + 24

    @property
    def joint_feedback(self) -> int:
        """Where Bullet writes the constraint's loads, when set."""
        return self.body_a + 32


@dataclass(frozen=True, slots=True)
class SpringLayout:
    """btGeneric6DofSpring2Constraint: what Blender makes of FIXED, and of springs of the second kind.

    Frames are three rows of four doubles and an origin. Limits of the three shifts lie beside one another; those of
    each turn lie in a block of their own.
    """

    linear: int
    angular: int
    flags: int
    frame_a: int = 80
    frame_b: int = 208
    angular_size: int = 176

    @property
    def lower(self) -> tuple[int, ...]:
        """Lower limits of the six rows."""
        return self._rows(0, 0)

    @property
    def upper(self) -> tuple[int, ...]:
        """Upper limits."""
        return self._rows(32, 8)

    @property
    def correction(self) -> tuple[int, ...]:
        """Shares of an error that are corrected in a sub-step (ERP)."""
        return self._rows(96, 24)

    @property
    def softness(self) -> tuple[int, ...]:
        """How much the rows give way (CFM)."""
        return self._rows(128, 32)

    def _rows(self, linear: int, angular: int) -> tuple[int, ...]:
        shifts = (self.linear + linear + 8 * row for row in range(3))
        turns = (self.angular + angular + self.angular_size * row for row in range(3))
        return (*shifts, *turns)


@dataclass(frozen=True, slots=True)
class WorldLayout:
    """btDiscreteDynamicsWorld, with the solver's settings (btContactSolverInfo) inside it."""

    dispatcher: int = 40
    broadphase: int = 128
    solver_settings: int = 176
    solver: int = 456

    @property
    def bodies(self) -> int:
        """Array of all bodies, just before the dispatcher."""
        return self.dispatcher - 32

    @property
    def constraints(self) -> int:
        """Array of all constraints, two pointers behind the solver."""
        return self.solver + 16

    @property
    def moving_bodies(self) -> int:
        """Array of the bodies that can move, behind that of the constraints."""
        return self.solver + 48

    @property
    def after_step(self) -> int:
        """Function that is called after every step; Blender sets none."""
        return self.solver_settings - 24

    @property
    def before_step(self) -> int:
        """Function that is called before every step, once gravity is in the forces; Blender sets none."""
        return self.solver_settings - 16

    @property
    def user_info(self) -> int:
        """Field for the user of the library, just before the solver's settings; Blender does not use it."""
        return self.solver_settings - 8

    @property
    def step(self) -> int:
        """Length of the last sub-step."""
        return self.solver_settings + 24

    @property
    def iterations(self) -> int:
        """Iterations of the solver."""
        return self.solver_settings + 40

    @property
    def warm_starting(self) -> int:
        """Share of the last impulses that the solver starts with."""
        return self.solver_settings + 160


@dataclass(frozen=True, slots=True)
class ContactPointLayout:
    """btManifoldPoint. Around the normal its fields follow one another without gaps; the lateral directions end it."""

    size: int
    normal: int = 128

    @property
    def place_on_b(self) -> int:
        """Where the contact is on the second body."""
        return self.normal - 64

    @property
    def place_on_a(self) -> int:
        """Where it is on the first body."""
        return self.normal - 32

    @property
    def distance(self) -> int:
        """How far apart the two bodies are, negative inside each other."""
        return self.normal + 32

    @property
    def friction(self) -> int:
        """Combined friction of the two bodies."""
        return self.normal + 40

    @property
    def normal_impulse(self) -> int:
        """Impulse along the normal."""
        return self.normal + 104

    @property
    def lateral_impulses(self) -> int:
        """Impulses along the two lateral directions."""
        return self.normal + 120

    @property
    def lateral_directions(self) -> int:
        """The two directions, one after the other."""
        return self.size - 64


@dataclass(frozen=True, slots=True)
class ManifoldLayout:
    """btPersistentManifold: up to four contact points in a row, then the two bodies and how many points there are."""

    points: int
    point: ContactPointLayout

    @property
    def body_a(self) -> int:
        """First body."""
        return self.points + 4 * self.point.size

    @property
    def body_b(self) -> int:
        """Second body."""
        return self.body_a + 8

    @property
    def count(self) -> int:
        """Number of contact points."""
        return self.body_a + 16


@dataclass(frozen=True, slots=True)
class DispatcherLayout:
    """btCollisionDispatcher: its array of pointers to all manifolds, from its pool and beyond."""

    manifolds: int = 16

    @property
    def manifold_count(self) -> int:
        """Length of the array."""
        return self.manifolds + 4

    @property
    def manifold_data(self) -> int:
        """First entry of the array."""
        return self.manifolds + 16


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
"""Activation states of a body that is simulated, that is about to rest, that rests until something wakes it, and of one
that is not simulated whatever happens to it.
"""

SLEEPING = frozenset({ASLEEP, DISABLED})
"""Activation states in which a body is not simulated: asleep and disabled."""

ACTIVATION_STATES = frozenset({1, 2, 3, 4, 5})
"""Active, sleeping, wants to sleep, never sleeps, disabled."""

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
"""Bullet's default warm-starting factor, which Blender leaves alone: a mark to know the solver's settings by."""

DRAWING_SIZE = 0.05
"""Bullet's default size for debug drawings of constraints, in single precision: a mark to know a constraint by."""

FIRST_STEP_S = 1.0 / 60.0
"""What the solver of a new world names as its step, in single precision, before it has taken any."""


def platform_layout() -> Layout:
    """Layout of the platform that Blender runs on."""
    return MICROSOFT if sys.platform == "win32" else SYSTEM_V
