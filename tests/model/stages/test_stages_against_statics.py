# SPDX-License-Identifier: GPL-3.0-or-later
"""Stages against statics: a hanging chain, a simple and a continuous beam; and after each cut against Blender."""

from dataclasses import replace

import numpy as np
import pytest
from support.stage_beams import (
    BLOCK_M,
    DENSITY_KG_M3,
    DEPTH_M,
    HEIGHT_M,
    MODULUS_M3,
    SCENARIO,
    WEIGHT_N_M,
    WIDTH_M,
    add_block,
    beam_file,
    beam_of_blocks,
    largest_stress_pa,
    staged,
)

from bridge_demolition_addon.engineering.mechanics.strength import MATERIALS
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.model.sequence.checked_model import checked_model
from bridge_demolition_addon.model.stages.reactions import supports_of
from bridge_demolition_addon.simulation.motion_run import motion_run

pytestmark = pytest.mark.slow

LINKS = 5


def chain_file(folder):
    """Cubes of a metre, one below the other, that hang from one that never moves."""
    text = SCENARIO.format(shards=LINKS + 1)
    for link in range(LINKS + 1):
        text += add_block(folder, f"link {link}", (1.0, 1.0, 1.0), (0.0, 0.0, 20.0 - link), fixed=link == 0)
    path = folder / "chain.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_a_hanging_chain_bears_what_hangs_below(tmp_path):
    [stage], bridge = staged(chain_file(tmp_path))
    link_n = DENSITY_KG_M3 * STANDARD_GRAVITY_M_S2
    assert len(bridge.model.connections) == LINKS
    below = np.array([LINKS - int(pair.min()) for pair in bridge.model.connections.pairs])
    # Determinate, in a plumb line, each face a square metre: no more than the rounding of the solution is left.
    used = below * link_n / MATERIALS["concrete"].tension_pa
    assert sorted(below) == [1, 2, 3, 4, 5]
    assert stage.standing.used == pytest.approx(used, rel=1e-5)
    assert set(bridge.governed_by(stage.standing)) == {"tension"}
    # It tears off at its top, whose face bears all; the factor is looked for within 1 %.
    assert stage.collapse_factor == pytest.approx(1.0 / used.max(), rel=0.01)


def moments_of_faces(bridge, stage):
    """Where the faces between blocks are along the beam, m, and their bending moments, N·m, in its order."""
    model = bridge.model
    blocks = [number for number, member in enumerate(model.members) if member.name.startswith("block")]
    within = np.isin(model.member_of_shard[model.connections.pairs], blocks).all(axis=1)
    rows = np.flatnonzero(within)[np.argsort(model.connections.points[within, 0])]
    return model.connections.points[rows, 0], abs(stage.standing.loads.moments_nm[rows, 1])


EXACT = 1e-3
"""Of the largest: loads are in the axes of shards that have turned a little as the beam sagged."""


def test_a_simple_beam_has_a_parabola_of_moments(tmp_path):
    blocks = 10
    [stage], bridge = staged(beam_of_blocks(tmp_path, blocks))
    length_m = blocks * BLOCK_M
    own_n = WEIGHT_N_M * length_m
    x, moments = moments_of_faces(bridge, stage)
    largest = own_n * length_m / 8.0
    assert len(x) == blocks - 1
    assert moments == pytest.approx(WEIGHT_N_M * x * (length_m - x) / 2.0, abs=EXACT * largest)
    # The face in the middle has no shear, and is used by bending alone: M / W over the strength.
    assert largest_stress_pa(stage) == pytest.approx(largest / MODULUS_M3, rel=EXACT)


def test_a_continuous_beam_of_two_spans_has_the_moments_of_its_reactions(tmp_path):
    blocks = 21
    [stage], bridge = staged(beam_of_blocks(tmp_path, blocks, prop=blocks // 2))
    span_m = blocks * BLOCK_M / 2.0
    on_span_n = WEIGHT_N_M * span_m
    start = next(support for support in supports_of(bridge.model) if support.name == "start")
    end_n = start.reaction(stage.standing.loads)[0][2]
    # Moments of that end reaction by equilibrium, along the first span.
    x, moments = moments_of_faces(bridge, stage)
    first = x < span_m
    by_statics = abs(end_n * x - WEIGHT_N_M * x * x / 2.0)[first]
    assert moments[first] == pytest.approx(by_statics, abs=2.0 * EXACT * on_span_n * span_m / 8.0)


LENGTH_M = 4.0
FIRST_S, SECOND_S = 0.25, 0.8
HANGERS = {"tip": (3.7, FIRST_S), "middle": (2.0, SECOND_S)}
CUT = """
[[saw_cuts]]
time_s = {}
point_m = [{}, 0.0, {}]
normal = [0.0, 0.0, 1.0]
members = ["{}"]
"""


@pytest.fixture(scope="module")
def cut_bridge(tmp_path_factory):
    """A cantilever that also hangs in its middle and at its tip, until that is cut off; and the factors of its stages.

    What is cut off touches nothing: stages know no contact.
    """
    folder, more = tmp_path_factory.mktemp("cut"), ""
    top_m = HEIGHT_M + DEPTH_M / 2.0
    for name, (x_m, time_s) in HANGERS.items():
        more += add_block(folder, name, (0.4, WIDTH_M, BLOCK_M), (x_m, 0.0, top_m + BLOCK_M / 2.0), fixed=True)
        more += CUT.format(time_s, x_m, top_m, name)
    path = beam_file(folder, LENGTH_M, shards=40, more=more)
    stages, _ = staged(path)
    return read_scenario(path), [stage.collapse_factor for stage in stages]


@pytest.mark.parametrize(
    ("stage", "factor", "falls_after"), [(1, 1.1, SECOND_S), (1, 0.9, FIRST_S), (2, 1.1, None), (2, 0.9, SECOND_S)]
)
def test_after_each_cut_it_falls_in_blender_exactly_where_its_factor_is_below_1(
    blender, cut_bridge, tmp_path, stage, factor, falls_after
):
    scenario, factors = cut_bridge
    assert factors[0] > factors[1] > 2.0 * factors[2]
    # All strengths alike, so that all factors are as many times as large. Sub-steps of 1/48 s damp what is cut by
    # π × 18 Hz / 48, more than critical: it comes to rest without a jerk, as a stage is at rest.
    connections = replace(scenario.connections, strength_factor=factor / factors[stage])
    time = replace(scenario.time, duration_s=1.3, substeps_per_frame=2)
    changed = replace(scenario, connections=connections, time=time)
    with motion_run(changed, checked_model(changed), tmp_path) as (results, _):
        heights = results.frames.positions_m[:, results.inventory.moves, 2]
        sunk_m = (heights[0] - heights).max(axis=1)
        times = np.array(results.frames.time_s)
    assert sunk_m[times < FIRST_S].max() < 0.001
    assert (sunk_m[times < SECOND_S].max() > 0.3) == (falls_after == FIRST_S)
    assert (sunk_m.max() > 0.3) == (falls_after is not None)
