# SPDX-License-Identifier: GPL-3.0-or-later
"""Thrust, reactions and moments of arches and frames at rest, against closed formulas and a plane frame in these tests.

Frames: A. Kleinlogel (1952), Rigid Frame Formulas. Arches: the parabola under an even load, H = w L² / (8 f), less what
the arch shortens by: S. P. Timoshenko, D. H. Young (1965), Theory of Structures.
"""

import numpy as np
import pytest
from support.arches_and_frames import (
    ARCH,
    ARCH_SPANS,
    FRAME,
    FRAME_SPANS,
    WEIGHT_N_M3,
    AtRest,
    scenario_of,
)
from support.plane_frames import PlaneFrame

from bridge_demolition_addon.engineering.geometry.mesh import volumes_and_centres
from bridge_demolition_addon.model.scenario.bridge_checks import arch_axis, axes_m, axes_on_arch_m

pytestmark = pytest.mark.slow

# Of the portal: axes of legs and deck, load of the deck, relative stiffness.
SPAN_M, HEIGHT_M = 15.0, 5.5 + 0.35
DECK_N_M = WEIGHT_N_M3 * 2.0 * 0.7
STIFFNESS = (0.7 / 0.8) ** 3 * HEIGHT_M / SPAN_M
FOOT_NM = DECK_N_M * SPAN_M**2 / (12.0 * (STIFFNESS + 2.0))
CORNER_NM = 2.0 * FOOT_NM
THRUST_N = 3.0 * FOOT_NM / HEIGHT_M
MIDDLE_NM = DECK_N_M * SPAN_M**2 / 8.0 - CORNER_NM


def test_the_plane_frame_of_these_tests_is_kleinlogels_portal():
    """Of a tenth of the depths, which leaves nothing of shear and of bars that shorten."""
    frame = PlaneFrame()
    frame.line([(x, HEIGHT_M) for x in np.linspace(0.0, SPAN_M, 61)], 0.07, 2.0, DECK_N_M)
    for x in (0.0, SPAN_M):
        frame.line([(x, z) for z in np.linspace(0.0, HEIGHT_M, 11)], 0.08, 2.0)
        frame.fixed.add(frame.node(x, 0.0))
    thrust, _, foot = frame.reaction(frame.solved(), frame.node(0.0, 0.0))
    assert thrust == pytest.approx(THRUST_N, rel=0.002)
    assert abs(foot) == pytest.approx(FOOT_NM, rel=0.002)


@pytest.mark.parametrize(("shards", "seed"), [(120, 1), (120, 2), (240, 3)])
def test_a_portal_has_kleinlogels_thrust_and_moments(shards, seed):
    """Thrust within 5 %, the corner and the middle of the deck within 8 %, feet within 12 % of the corner's moment.

    Legs meet the deck over their thickness and not at a point, and irregular shards are no beams.
    """
    at_rest = AtRest(scenario_of(FRAME, FRAME_SPANS, shards=shards, seed=seed))
    force, moment = at_rest.on("leg 1", "ground", (0.0, 0.0, 0.0))
    assert force[0] == pytest.approx(THRUST_N, rel=0.05)
    assert abs(moment[1]) == pytest.approx(FOOT_NM, abs=0.12 * CORNER_NM)
    assert force[0] * HEIGHT_M - abs(moment[1]) == pytest.approx(CORNER_NM, rel=0.08)
    both = force[2] + at_rest.on("leg 2", "ground", (0.0, 0.0, 0.0))[0][2]
    assert both == pytest.approx(DECK_N_M * 15.8 + 2.0 * WEIGHT_N_M3 * 2.0 * 0.8 * 5.5, rel=1e-4)


def test_a_portal_in_prisms_has_kleinlogels_moment_in_the_middle():
    """Half of it is cut free between two prisms of the deck, so that the section is plane."""
    places = [f"[[fracture.points]]\nplace_m = [{x:.4f}, 0.0, 5.85]" for x in -0.4 + 15.8 * (np.arange(32) + 0.5) / 32]
    at_rest = AtRest(scenario_of(FRAME, FRAME_SPANS, shards=62, points="\n".join(places)))
    force, moment = at_rest.beyond(7.5, (7.5, 0.0, HEIGHT_M))
    assert -force[0] == pytest.approx(THRUST_N, rel=0.04)
    assert abs(force[2]) < 0.01 * DECK_N_M * SPAN_M
    assert abs(moment[1]) == pytest.approx(MIDDLE_NM, rel=0.08)


def test_slanted_legs_have_the_thrust_of_a_plane_frame():
    """Within 4 %, whose feet are 3 m outside."""
    at_rest = AtRest(scenario_of(FRAME + "lean_m = 3.0\n", FRAME_SPANS, shards=120))
    frame = PlaneFrame()
    frame.line([(x, HEIGHT_M) for x in np.linspace(0.0, SPAN_M, 61)], 0.7, 2.0, DECK_N_M)
    square = 0.8 * 5.5 / np.hypot(3.0, 5.5)  # thickness of a leg square to it
    for x, foot in ((0.0, -3.0), (SPAN_M, SPAN_M + 3.0)):
        points = [(foot, 0.0), *((foot + (x - foot) * z / 5.5, z) for z in np.linspace(0.55, 5.5, 10)), (x, HEIGHT_M)]
        frame.line(points, square, 2.0, WEIGHT_N_M3 * square * 2.0)
        frame.fixed.add(frame.node(foot, 0.0))
    thrust, up, _ = frame.reaction(frame.solved(), frame.node(-3.0, 0.0))
    force, _ = at_rest.on("leg 1", "ground", (-3.0, 0.0, 0.0))
    assert force[0] == pytest.approx(thrust, rel=0.04)
    assert force[2] == pytest.approx(up, rel=0.04)


def arch_frame(bridge, arch, weights):
    """An arch bridge as a plane frame: arch, columns and deck on their axes, with the weights of pieces and members."""
    axis, frame, deck_m = arch_axis(bridge), PlaneFrame(), 9.5 + 0.2
    volumes, centres = volumes_and_centres(arch.parts)
    x = np.concatenate((np.linspace(axis.begin_m, axis.end_m, 141), axes_on_arch_m(bridge), centres[:, 0]))
    points = axis.points_m(np.unique(np.round(x, 6)), 0.0)
    frame.line(points, 0.7, 5.0)
    for volume, point in zip(volumes, axis.points_m(np.round(centres[:, 0], 6), 0.0), strict=True):
        frame.load(frame.node(*point), WEIGHT_N_M3 * volume)
    frame.fixed |= {frame.node(*points[0]), frame.node(*points[-1])}
    along = np.unique(np.concatenate(([-0.4, 37.4], np.linspace(0.0, 37.0, 75))))
    frame.line([(position, deck_m) for position in along], 0.4, 6.0, weights["deck"] / 37.8)
    block_m = float(axis.points_m(np.array([axis.begin_m]), 1.0)[0, 1])
    for number, position in enumerate(axes_m(bridge), start=1):
        on_arch = position in axes_on_arch_m(bridge)
        foot_m = float(axis.points_m(np.array([round(position, 6)]), 0.0)[0, 1]) if on_arch else block_m
        foot, top = frame.node(position, foot_m), frame.node(position, deck_m)
        frame.line([frame.nodes[foot], frame.nodes[top]], 0.4, 5.0)
        if not on_arch:
            frame.fixed.add(foot)
        for node in (foot, top):
            frame.load(node, 0.5 * weights[f"pier {number}"])
    return frame


@pytest.mark.parametrize(
    ("more", "tolerance", "shards", "seed"),
    [("", 0.05, 120, 1), ("", 0.03, 120, 2), ("", 0.03, 240, 3), ('axis = "circle"\n', 0.07, 120, 1)],
)
def test_an_arch_has_the_thrust_of_its_weight(more, tolerance, shards, seed):
    """By a plane frame of its axes; a parabola by its weight too, as H = M / f of a simple beam, nearly w L² / (8 f).

    A fixed parabola loses 45/4 I / (A f²) of its thrust as it shortens, 0.9 % here. Its load is not quite even: it is
    heavier towards the springings, which gives less moment in the middle. The seats of the columns, and short columns,
    make the arch stiffer than its axis: it carries 1 to 5 % less as thrust, a circle up to 7 %.
    """
    at_rest = AtRest(scenario_of(ARCH + more, ARCH_SPANS, shards=shards, seed=seed))
    bridge, axis = at_rest.scenario.bridge, arch_axis(at_rest.scenario.bridge)
    weights = {member.name: member.mass_kg * 9.80665 for member in at_rest.model.members}
    arch = next(member for member in at_rest.model.members if member.kind == "arch")
    frame = arch_frame(bridge, arch, weights)
    thrust, up, _ = frame.reaction(frame.solved(), 0)
    about = (axis.begin_m, 0.0, axis.springing_m)
    force, _ = at_rest.on("arch", "thrust block 1", about)
    other, _ = at_rest.on("arch", "thrust block 2", about)
    assert force[0] == pytest.approx(thrust, rel=tolerance)
    assert force[0] + other[0] == pytest.approx(0.0, abs=0.01 * thrust)
    assert force[2] == pytest.approx(up, rel=0.02)
    if not more:
        # The arch, its six columns and the deck between the columns of the ends' spans, as an even load on its span.
        even = (
            weights["arch"] + sum(weights[f"pier {number}"] for number in range(2, 8)) + weights["deck"] * 31.0 / 37.8
        )
        assert force[0] == pytest.approx(even / 35.0 * 35.0**2 / (8.0 * 7.0) * (1.0 - 0.009), rel=0.07)
