"""Blender's Bullet, as recorded here, against Bullet built and driven by somebody else.

The two share the mathematics of their solver; what is compared is everything around it: how bodies, time, gravity and
materials reach the engine, and what is read back.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from blocks import Blocks

from bridge_demolition_addon.core.scenario import STANDARD_GRAVITY_M_S2

pybullet = pytest.importorskip("pybullet", reason="pybullet is not installed: its wheel is for Python 3.11 on Linux")

STEPS_PER_SECOND = 240
STEP_S = 1 / STEPS_PER_SECOND
FRICTION = 0.5
"""Blender's default."""

AGREEMENT = 0.02
"""Asked of an impulse. Where in a step a contact is found moves the speed of impact by up to g × step, 0.5 % here."""


@pytest.fixture
def engine() -> Iterator[int]:
    """An empty pybullet world in the steps of the Blender scenes here."""
    client = pybullet.connect(pybullet.DIRECT)
    pybullet.setGravity(0, 0, -STANDARD_GRAVITY_M_S2, physicsClientId=client)
    pybullet.setPhysicsEngineParameter(fixedTimeStep=STEP_S, numSolverIterations=50, physicsClientId=client)
    yield client
    pybullet.disconnect(physicsClientId=client)


def body_in_engine(engine, shape, place, mass_kg=0.0, restitution=0.0, **size):
    shape = pybullet.createCollisionShape(shape, physicsClientId=engine, **size)
    body = pybullet.createMultiBody(mass_kg, shape, basePosition=place, physicsClientId=engine)
    pybullet.changeDynamics(
        body,
        -1,
        restitution=restitution,
        lateralFriction=FRICTION,
        linearDamping=0.0,
        angularDamping=0.0,
        physicsClientId=engine,
    )
    return body


def block_in_engine(engine, place, mass_kg=0.0, size_m=(1, 1, 1), restitution=0.0):
    return body_in_engine(engine, pybullet.GEOM_BOX, place, mass_kg, restitution, halfExtents=np.array(size_m) / 2)


def scene_in_engine_steps() -> Blocks:
    """A Blender scene in which a frame is a step."""
    return Blocks(frames_per_second=STEPS_PER_SECOND, substeps_per_frame=1, solver_iterations=50)


def fall_in_blender(folder, mass_kg, radius_m, height_m, restitution):
    """Velocity of a ball that falls on a plate, and its height above it, (k, 2) after each step."""
    blocks = scene_in_engine_steps()
    plate = blocks.block((0, 0, -0.5), size_m=(6, 6, 1))
    ball = blocks.block((0, 0, height_m + radius_m), mass_kg, np.full(3, 2 * radius_m))
    ball.rigid_body.collision_shape = "SPHERE"
    for body in (plate, ball):
        body.rigid_body.restitution = np.sqrt(restitution)  # Bullet multiplies those of the two bodies
    results = blocks.play(folder, STEPS_PER_SECOND)
    return np.column_stack((results.velocities_m_s[:, 1, 2], results.places_m[:, 1, 2] - radius_m))


def fall_in_engine(engine, mass_kg, radius_m, height_m, restitution):
    """The same in pybullet."""
    surface = np.sqrt(restitution)
    block_in_engine(engine, (0, 0, -0.5), size_m=(6, 6, 1), restitution=surface)
    place = (0, 0, height_m + radius_m)
    ball = body_in_engine(engine, pybullet.GEOM_SPHERE, place, mass_kg, surface, radius=radius_m)
    fall = [(0.0, height_m)]
    for _ in range(STEPS_PER_SECOND):
        pybullet.stepSimulation(physicsClientId=engine)
        velocity, _ = pybullet.getBaseVelocity(ball, physicsClientId=engine)
        centre, _ = pybullet.getBasePositionAndOrientation(ball, physicsClientId=engine)
        fall.append((velocity[2], centre[2] - radius_m))
    return np.array(fall)


def hit_of(fall):
    """Step of a fall (k, 2) before the hit, and change of velocity by the plate alone, without gravity's, m/s."""
    velocities = fall[:, 0]
    step = int(np.argmax(np.diff(velocities)))
    around = velocities[step : step + 3]
    return step, around[-1] - around[0] + STANDARD_GRAVITY_M_S2 * STEP_S * (len(around) - 1)


@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_impulse_of_a_ball_that_falls_on_a_plate(blender, tmp_path, engine, restitution):
    mass, height = 1000.0, 3.0
    ball = {"mass_kg": mass, "radius_m": 0.5, "height_m": height, "restitution": restitution}
    recorded, computed = fall_in_blender(tmp_path, **ball), fall_in_engine(engine, **ball)
    (step, change), (_, change_computed) = hit_of(recorded), hit_of(computed)
    assert mass * change == pytest.approx(mass * change_computed, rel=AGREEMENT)

    # By hand. Bullet finds a contact before it closes and lets the rest of the gap be covered in that step: a rebound
    # is slower by gap / step than restitution alone would have it. Without restitution the ball just comes to rest.
    speed = np.sqrt(2 * STANDARD_GRAVITY_M_S2 * height)
    rebound = restitution * speed - recorded[step, 1] / STEP_S if restitution else 0.0
    assert mass * change == pytest.approx(mass * (speed + rebound), rel=AGREEMENT)


def test_heights_of_a_pile_at_rest(blender, tmp_path, engine):
    """Six blocks of 1 m in three layers, each across two of the layer below, dropped from 5 mm above one another."""
    gap, seconds = 0.005, 3
    layers = np.array([0, 0, 0, 1, 1, 2])
    along = np.array([0.0, 1.1, 2.2, 0.5, 1.6, 1.0])
    places = np.column_stack((along, np.zeros(6), 0.5 + layers + gap * (layers + 1)))
    masses = [500.0, 700.0, 600.0, 400.0, 300.0, 800.0]
    ground = {"place": (1, 0, -0.5), "size_m": (8, 8, 1)}

    blocks = scene_in_engine_steps()
    blocks.block(**ground)
    for place, mass in zip(places, masses, strict=True):
        blocks.block(place, mass)
    results = blocks.play(tmp_path, seconds * STEPS_PER_SECOND)

    block_in_engine(engine, **ground)
    pile = [block_in_engine(engine, place, mass) for place, mass in zip(places, masses, strict=True)]
    for _ in range(seconds * STEPS_PER_SECOND):
        pybullet.stepSimulation(physicsClientId=engine)
    computed = np.array([pybullet.getBasePositionAndOrientation(body, physicsClientId=engine)[0] for body in pile])

    # Bullet lets bodies at rest overlap by up to some hundredths of a millimetre.
    np.testing.assert_allclose(results.places_m[-1, 1:, 2], computed[:, 2], atol=1e-4)
    np.testing.assert_allclose(computed[:, 2], 0.5 + layers, atol=1e-4)
    # Landing moves them sideways by up to a quarter of a millimetre.
    np.testing.assert_allclose(results.places_m[-1, 1:, :2], computed[:, :2], atol=1e-3)
    # At rest: below 0.1 mm/s.
    assert abs(results.velocities_m_s[-1]).max() < 1e-3
