# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's Bullet, as recorded here, against Bullet built and driven by somebody else.

The two share the mathematics of their solver; what is compared is everything around it: how bodies, time, gravity and
materials reach the engine, and what is read back.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from support.blocks import Blocks

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2

pybullet = pytest.importorskip("pybullet", reason="pybullet is not installed: its wheel is for Python 3.11 on Linux")

STEPS_PER_SECOND = 240
STEP_S = 1 / STEPS_PER_SECOND
FRICTION = 0.5
"""Blender's default."""

AGREEMENT = 0.02
"""Asked of impulses and of forces at rest. Where in a step a contact is found moves the speed of impact by up to
g × step, 0.5 % here; and bodies at rest still settle against each other by parts of a percent of their weight."""

GROUND = {"place": (1, 0, -0.5), "size_m": (8, 8, 1)}
SECONDS_TO_REST = 3


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
    """What was recorded of a ball that falls on a plate."""
    blocks = scene_in_engine_steps()
    plate = blocks.block((0, 0, -0.5), size_m=(6, 6, 1))
    ball = blocks.block((0, 0, height_m + radius_m), mass_kg, np.full(3, 2 * radius_m))
    ball.rigid_body.collision_shape = "SPHERE"
    ball["bda_kind"] = "ball"
    for body in (plate, ball):
        body.rigid_body.restitution = np.sqrt(restitution)  # Bullet multiplies those of the two bodies
    return blocks.play(folder, STEPS_PER_SECOND)


def fall_in_engine(engine, mass_kg, radius_m, height_m, restitution):
    """The same in pybullet: velocity, height above the plate and impulse of the contacts, (k, 3) after each step."""
    surface = np.sqrt(restitution)
    block_in_engine(engine, (0, 0, -0.5), size_m=(6, 6, 1), restitution=surface)
    position = (0, 0, height_m + radius_m)
    ball = body_in_engine(engine, pybullet.GEOM_SPHERE, position, mass_kg, surface, radius=radius_m)
    fall = []
    for _ in range(STEPS_PER_SECOND):
        pybullet.stepSimulation(physicsClientId=engine)
        velocity, _ = pybullet.getBaseVelocity(ball, physicsClientId=engine)
        centre, _ = pybullet.getBasePositionAndOrientation(ball, physicsClientId=engine)
        force = forces_in_engine(engine, [ball])[0][0]
        fall.append((velocity[2], centre[2] - radius_m, force[2] * STEP_S))
    return np.array(fall)


def forces_in_engine(engine, bodies):
    """Resultant (n, 3) and sum of magnitudes (n,) of the contact forces on each of the n bodies in the last step."""
    resultants, sums = np.zeros((len(bodies), 3)), np.zeros(len(bodies))
    for contact in pybullet.getContactPoints(physicsClientId=engine):
        normal, magnitude, *friction = contact[7], *contact[9:14]
        directions = np.array((normal, friction[1], friction[3]))
        force = np.array((magnitude, friction[0], friction[2])) @ directions
        for body, sign in ((contact[1], 1.0), (contact[2], -1.0)):
            if body in bodies:
                resultants[bodies.index(body)] += sign * force
                sums[bodies.index(body)] += np.linalg.norm(force)
    return resultants, sums


def come_to_rest(engine):
    for _ in range(SECONDS_TO_REST * STEPS_PER_SECOND):
        pybullet.stepSimulation(physicsClientId=engine)


def places_in_engine(engine, bodies):
    return np.array([pybullet.getBasePositionAndOrientation(body, physicsClientId=engine)[0] for body in bodies])


@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_impulse_of_a_ball_that_falls_on_a_plate(blender, tmp_path, engine, restitution):
    mass, height, radius = 1000.0, 3.0, 0.5
    ball = {"mass_kg": mass, "radius_m": radius, "height_m": height, "restitution": restitution}
    recorded, computed = fall_in_blender(tmp_path, **ball), fall_in_engine(engine, **ball)
    impulses = recorded.balls.impulses_ns[:, 0, 2]
    np.testing.assert_allclose(
        recorded.frames.loads.body_contact_impulses_ns[1:, 1, 2], impulses, rtol=1e-7
    )  # a frame is a step, and is kept with seven digits
    hit, hit_computed = int(impulses.argmax()), int(computed[:, 2].argmax())
    assert hit == hit_computed
    # Without restitution a second step takes up what the first has left of the fall.
    impulse = impulses[hit : hit + 2].sum()
    assert impulse == pytest.approx(computed[hit : hit + 2, 2].sum(), rel=AGREEMENT)

    # By hand: what the velocity changed by, but for gravity's share. Blender keeps gravity in single precision.
    velocities = recorded.balls.velocities_m_s[:, 0, 2]
    change = velocities[hit + 1] - velocities[hit - 1] + STANDARD_GRAVITY_M_S2 * 2 * STEP_S
    assert impulse == pytest.approx(mass * change, rel=1e-6)

    # By hand. Bullet finds a contact before it closes and lets the rest of the gap be covered in that step: a rebound
    # is slower by gap / step than restitution alone would have it. Without restitution the ball just comes to rest.
    speed = np.sqrt(2 * STANDARD_GRAVITY_M_S2 * height)
    gap = recorded.frames.positions_m[hit, 1, 2] - radius
    rebound = restitution * speed - gap / STEP_S if restitution else 0.0
    assert impulse == pytest.approx(mass * (speed + rebound), rel=AGREEMENT)


def test_pile_at_rest(blender, tmp_path, engine):
    """Six blocks of 1 m in three layers, each across two of the layer below, dropped from 5 mm above one another."""
    gap = 0.005
    layers = np.array([0, 0, 0, 1, 1, 2])
    along = np.array([0.0, 1.1, 2.2, 0.5, 1.6, 1.0])
    positions = np.column_stack((along, np.zeros(6), 0.5 + layers + gap * (layers + 1)))
    masses = np.array([500.0, 700.0, 600.0, 400.0, 300.0, 800.0])

    blocks = scene_in_engine_steps()
    blocks.block(**GROUND)
    for position, mass in zip(positions, masses, strict=True):
        blocks.block(position, mass)
    results = blocks.play(tmp_path, SECONDS_TO_REST * STEPS_PER_SECOND)

    ground = block_in_engine(engine, **GROUND)
    pile = [block_in_engine(engine, position, mass) for position, mass in zip(positions, masses, strict=True)]
    come_to_rest(engine)
    computed = places_in_engine(engine, pile)

    # Bullet lets bodies at rest overlap by up to some hundredths of a millimetre.
    np.testing.assert_allclose(results.frames.positions_m[-1, 1:, 2], computed[:, 2], atol=1e-4)
    np.testing.assert_allclose(computed[:, 2], 0.5 + layers, atol=1e-4)
    # Landing moves them sideways by up to a quarter of a millimetre.
    np.testing.assert_allclose(results.frames.positions_m[-1, 1:, :2], computed[:, :2], atol=1e-3)
    # At rest: below 0.1 mm/s.
    assert abs(results.frames.velocities_m_s[-1]).max() < 1e-3

    # The resultant on each is its own weight. How a block shares its load between the two under it is another matter:
    # statics leaves that open where faces touch faces, and it differs between the engines by a sixth.
    resultants, _ = forces_in_engine(engine, [ground, *pile])
    weights = STANDARD_GRAVITY_M_S2 * np.append(masses.sum(), masses)
    assert (abs(results.frames.loads.body_forces_n[-1] - resultants).max(axis=1) < AGREEMENT * weights).all()
    np.testing.assert_allclose(results.frames.loads.body_forces_n[-1, 1:, 2], weights[1:], rtol=AGREEMENT)


def test_forces_through_a_pile_at_rest(blender, tmp_path, engine):
    """Two blocks on one another, off the middle of a plank that lies on three balls: statics leaves nothing open."""
    radius, thickness = 0.5, 0.4
    supports = np.array([(-0.5, -1.0), (-0.5, 1.0), (2.5, 0.0)])
    top = 2 * radius + thickness
    boxes = {  # place, size, mass
        "plank": ((1.0, 0.0, 2 * radius + thickness / 2), (4.0, 3.0, thickness), 900.0),
        "lower": ((0.7, 0.2, top + 0.5), (1.0, 1.0, 1.0), 1500.0),
        "upper": ((0.7, 0.2, top + 1.5), (1.0, 1.0, 1.0), 700.0),
    }
    masses = np.array([200.0, 300.0, 250.0, *(mass for *_, mass in boxes.values())])

    blocks = scene_in_engine_steps()
    blocks.block(**GROUND)
    ground = block_in_engine(engine, **GROUND)
    pile = []
    for (x, y), mass in zip(supports, masses, strict=False):
        ball = blocks.block((x, y, radius), mass, np.full(3, 2 * radius))
        ball.rigid_body.collision_shape = "SPHERE"
        pile.append(body_in_engine(engine, pybullet.GEOM_SPHERE, (x, y, radius), mass, radius=radius))
    for position, size, mass in boxes.values():
        blocks.block(position, mass, size)
        pile.append(block_in_engine(engine, position, mass, size))
    results = blocks.play(tmp_path, SECONDS_TO_REST * STEPS_PER_SECOND)
    come_to_rest(engine)
    resultants, sums = forces_in_engine(engine, [ground, *pile])

    weights = STANDARD_GRAVITY_M_S2 * masses
    np.testing.assert_allclose(results.frames.loads.body_sums_n[-1], sums, rtol=AGREEMENT)
    np.testing.assert_allclose(results.frames.loads.body_forces_n[-1, :, 2], resultants[:, 2], rtol=AGREEMENT)
    np.testing.assert_allclose(results.frames.loads.body_forces_n[-1, 1:, 2], weights, rtol=AGREEMENT)

    # By hand: three supports, from the balance of forces and of moments about both axes.
    arms = np.vstack((np.ones(3), supports.T))
    centres = np.array([position[:2] for position, *_ in boxes.values()])
    loads = weights[3:] @ np.column_stack((np.ones(3), centres))
    carried = np.linalg.solve(arms, loads)
    lower, upper = weights[4:]
    by_hand = [*(2 * carried + weights[:3]), carried.sum() + lower + upper, lower + 2 * upper, upper]
    np.testing.assert_allclose(results.frames.loads.body_sums_n[-1], [weights.sum(), *by_hand], rtol=AGREEMENT)
