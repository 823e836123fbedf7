# SPDX-License-Identifier: GPL-3.0-or-later
"""The ball's crane and the jackhammer's excavator stand where they cut no part of the bridge, and hold their tools."""

from dataclasses import replace

import numpy as np
import pytest
from support.sample_results import CUBE, changed, hanging_chain

from bridge_demolition_addon.display.crawlers import (
    StandingRoom,
    ball_cranes,
    boxes_around,
    breaker_excavators,
    excavator_parts,
)
from bridge_demolition_addon.display.dressing import DrawnPart, Stuff
from bridge_demolition_addon.engineering.geometry.solids import box, to_manifold

pytestmark = pytest.mark.slow

DEBRIS_M = np.array((4.0, 21.0, 0.5))
"""Where a piece comes to lie in the end: where the crane would stand otherwise."""

TOOL_HIGH_M = 2.0


def run(width_m, height_m, kind="ball"):
    """A run of a deck of 20 m along the road at a height, a piece that flies away, and a ball or a tool over them."""
    results = hanging_chain()
    vertices, positions = np.array(results.arrays()["vertices_m"]), np.array(results.frames.positions_m)
    vertices[8:16] = np.array((20.0, width_m, 1.0)) / 2.0 * CUBE
    vertices[16:24] = 0.5 * CUBE
    vertices[24:32] = np.array((0.2, 0.2, TOOL_HIGH_M)) / 2.0 * (CUBE + np.array((0.0, 0.0, 1.0)))
    positions[:, 1] = (0.0, 0.0, height_m - 0.5)
    positions[:, 2] = (0.0, 0.0, height_m - 1.5)
    positions[-1, 2] = DEBRIS_M
    positions[:, 3] = (0.0, 0.0, height_m + 1.0)
    kinds = np.array(["ground", "shard", "shard", kind])
    of_bridge = np.array(["", "deck", "deck", ""])
    results = changed(results, vertices_m=vertices, body_kinds=kinds, body_member_kinds=of_bridge)
    return moved_to(results, positions)


def moved_to(results, positions_m):
    """The same run with its bodies at other places."""
    return replace(results, frames=replace(results.frames, positions_m=positions_m))


def shared_m3(parts, solid):
    """Return which volume parts have in common with a solid, by the engine of booleans."""
    return sum((to_manifold(part.solid) ^ to_manifold(solid)).volume() for part in parts)


def excavators_in(results, row, room):
    return excavator_parts(results, row, room, breaker_excavators(results, room))


@pytest.mark.parametrize("width_m", [3.0, 12.0, 30.0])
@pytest.mark.parametrize("height_m", [2.0, 6.0, 20.0])
@pytest.mark.parametrize("kind, draw", [("ball", ball_cranes), ("tool", excavators_in)])
def test_machines_cut_neither_the_bridge_nor_what_falls_beside_it(width_m, height_m, kind, draw):
    results = run(width_m, height_m, kind)
    room = StandingRoom.of_run(results)
    machine = [part for part in draw(results, 0, room) if not is_held(part)]
    deck = box((20.0, width_m, 1.0), (0.0, 0.0, height_m - 0.5))
    assert len(machine) > 8
    assert shared_m3(machine, deck) == 0.0
    assert shared_m3(machine, box((1.0, 1.0, 1.0), DEBRIS_M)) == 0.0


def is_held(part):
    """Return whether a part is the rope or the hammer, which reach down to the deck."""
    ((low, high),) = boxes_around([part])
    return part.stuff == Stuff.BLACK and bool((np.maximum(-high, low)[:2] < 0.0).all())


def test_room_says_what_is_cut():
    room = StandingRoom.of_run(run(6.0, 5.0))
    beside, within = np.array([[[0.0, 10.0, 0.0], [2.0, 12.0, 3.0]], [[0.0, 1.0, 0.0], [2.0, 3.0, 5.0]]])[:, None]
    over = np.array([[[0.0, 10.0, 2.0], [0.0, 5.0, 9.0], [0.0, 0.0, 7.0]]])
    through = np.array([[[0.0, 10.0, 2.0], [0.0, 0.0, 7.0]]])
    assert room.cuts(beside, over, 0.5) == 0
    assert room.cuts(within, over, 0.5) > 0
    assert room.cuts(beside, through, 0.5) > 0
    drawn = [DrawnPart(Stuff.SOIL, box((4.0, 4.0, 4.0), (0.0, 11.0, 0.0)))]
    assert StandingRoom.of_run(run(6.0, 5.0), drawn).cuts(beside, over, 0.5) > 0


def test_an_excavator_holds_its_hammer_around_the_chisel_and_stays_where_it_is():
    results = run(6.0, 5.0, "tool")
    positions = np.array(results.frames.positions_m)
    positions[-1, 3] += (0.5, 0.0, -0.6)
    results = moved_to(results, positions)
    room = StandingRoom.of_run(results)
    first, last = (excavators_in(results, row, room) for row in (0, len(positions) - 1))
    for row, parts in ((0, first), (-1, last)):
        chisel = box((0.2, 0.2, TOOL_HIGH_M), positions[row, 3] + (0.0, 0.0, TOOL_HIGH_M / 2.0))
        (hammer,) = [part for part in parts if shared_m3([part], chisel) > 0.0 and part.stuff == Stuff.BLACK]
        arm = [part for part in parts if part.stuff == Stuff.YELLOW and shared_m3([part], hammer.solid) > 0.0]
        assert arm
    base = [part.solid.vertices for part in first if part.solid.vertices[:, 2].min() < 0.5]
    again = [part.solid.vertices for part in last if part.solid.vertices[:, 2].min() < 0.5]
    assert len(base) >= 2 and all(np.array_equal(*pair) for pair in zip(base, again, strict=True))
