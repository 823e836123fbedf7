# SPDX-License-Identifier: GPL-3.0-or-later
"""A wrong byte offset ends in a clear error: never in a crash, and never in a wrong force."""

from dataclasses import fields, replace

import numpy as np
import pytest
from support.blocks import Blocks

from bridge_demolition_addon.bullet.layout import platform_layout
from bridge_demolition_addon.bullet.tick import SubstepStage, Tick
from bridge_demolition_addon.bullet.world import BulletWorld, WorldState
from bridge_demolition_addon.errors import DemolitionError

GROUPS = ("blender", "body", "constraint", "world")


def offsets():
    """Every offset that stands in the tables on its own."""
    layout = platform_layout()
    return [(group, field.name) for group in GROUPS for field in fields(getattr(layout, group))]


@pytest.fixture
def stepped(blender):
    """A chain that has taken a step, and the graph that knows its constraints."""
    blocks = Blocks()
    bodies = [blocks.block((0, 0, 10)), blocks.block((0, 0, 9), 10.0), blocks.block((0, 0, 8), 25.0)]
    bodies[2].rigid_body.friction, bodies[2].rigid_body.linear_damping = 0.25, 0.04
    for kind, pair in (("FIXED", bodies[:2]), ("HINGE", bodies[1:])):
        blocks.connect(kind, pair[1].location, *pair, breaking_force_newton=1e6)
    blocks.scene.frame_set(1)
    blocks.scene.frame_set(2)
    return blocks, bodies, blender.context.view_layer.depsgraph


def bound(stepped, layout):
    blocks, bodies, graph = stepped
    world = BulletWorld(blocks.scene, bodies, list(blocks.world.constraints.objects), layout)
    return world, world.bind(graph)


def trusted(stepped, layout):
    """Whether a layout leads to a world; one that is not there is a clear answer too."""
    try:
        return bound(stepped, layout)[1] is not WorldState.ABSENT
    except DemolitionError:
        return False


def test_right_layout_is_trusted(stepped):
    world, state = bound(stepped, platform_layout())
    assert state is WorldState.NEW
    assert world.constraints.intact().all()
    world.release()


@pytest.mark.parametrize("shift", (-8, 8, -16, 16, 64))
@pytest.mark.parametrize(("group", "name"), offsets(), ids=lambda value: str(value))
def test_every_shifted_offset_is_refused(stepped, group, name, shift):
    layout = platform_layout()
    part = getattr(layout, group)
    shifted = replace(part, **{name: getattr(part, name) + shift})
    assert not trusted(stepped, replace(layout, **{group: shifted}))
    # Nothing was written: the right layout still finds the world as Blender made it, and it goes on.
    world, state = bound(stepped, layout)
    assert state is WorldState.NEW
    blocks, _, graph = stepped
    for frame in range(3, 9):
        blocks.scene.frame_set(frame)
    assert world.bind(graph) is WorldState.KNOWN
    assert world.snapshots(np.array([0])).take().load_components[2, 0] == pytest.approx(-35.0 * 9.80665, rel=1e-3)
    world.release()


CONTACT_OFFSETS = (
    ("manifold.point", "size"),
    ("manifold.point", "normal"),
    ("manifold", "points"),
    ("dispatcher", "manifolds"),
)


@pytest.fixture
def sliding(blender):
    """Blocks that slide over the ground, so that their contacts push and rub."""
    blocks = Blocks()
    blocks.scene.gravity = (3.0, 1.0, -9.81)
    bodies = [blocks.block((0, 0, -0.5), size_m=(60, 60, 1))]
    bodies += [blocks.block((3.0 * number, 0.3, 0.5), 10.0) for number in range(4)]
    for body, friction in zip(bodies, (0.3, 0.5, 0.6, 0.7, 0.8), strict=True):
        body.rigid_body.friction = friction
    for frame in range(1, 12):
        blocks.scene.frame_set(frame)
    return blocks, bodies, blender.context.view_layer.depsgraph


def contacts_of(sliding, layout):
    world, _ = bound(sliding, layout)
    try:
        taker, tick = world.snapshots(np.zeros(0, int)), Tick()
        tick.refer(bodies=world.bodies.core, connections=world.constraints.core)
        taken = taker.begin(tick, contacts=True)
        tick.next = SubstepStage.TAKE
        while tick.go_on():
            taker.make_room()
        return taker.contacts([taker.with_contacts(taken)])
    finally:
        world.release()


def test_right_layout_reads_contacts(sliding):
    contacts = contacts_of(sliding, platform_layout())
    assert len(contacts) == 16
    weights = 4 * 10.0 * 9.81 / 240.0
    assert abs(contacts.impulses_ns[:, 2]).sum() == pytest.approx(weights, rel=0.05)


@pytest.mark.parametrize("shift", (-8, 8, -16, 16, -32, 32, 64))
@pytest.mark.parametrize(("part", "name"), CONTACT_OFFSETS, ids=lambda value: str(value))
def test_every_shifted_offset_of_contacts_is_refused(sliding, part, name, shift):
    layout = platform_layout()
    if part == "manifold.point":
        point = layout.manifold.point
        wrong = replace(layout.manifold, point=replace(point, **{name: getattr(point, name) + shift}))
        shifted = replace(layout, manifold=wrong)
    else:
        group = getattr(layout, part)
        shifted = replace(layout, **{part: replace(group, **{name: getattr(group, name) + shift})})
    try:
        found = contacts_of(sliding, shifted)
    except DemolitionError:
        return
    # Nothing where there should be contacts is no wrong force either.
    assert len(found) == 0
