# SPDX-License-Identifier: GPL-3.0-or-later
"""Ground that moves, in Blender's own simulation: what stands on it follows, rocks and tips as theory says."""

import math

import numpy as np
import pytest
from support.blocks import Blocks

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.engineering.ground_motion import GroundRecord, integrated
from bridge_demolition_addon.engineering.timing.timeline import Timeline
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.model.ground_motion.settings import GroundMotion, Sweep
from bridge_demolition_addon.model.ground_motion.sources import ground_record
from bridge_demolition_addon.model.results.arrays import load_results
from bridge_demolition_addon.model.scenario.file import read_scenario
from bridge_demolition_addon.scene.tools.ground_motion import keep_ground_motion, move_with_ground
from bridge_demolition_addon.simulation.run import run_scenario

FRAMES_PER_SECOND = 24


def on_ground(folder, record: GroundRecord, size_m, friction: float, duration_s: float):
    """A block on ground that moves: how it went."""
    scene = Blocks(frames_per_second=FRAMES_PER_SECOND, substeps_per_frame=10)
    ground = scene.block((0.0, 0.0, -0.5), size_m=(40.0, 40.0, 1.0))
    block = scene.block((0.0, 0.0, size_m[2] / 2.0), 1000.0, size_m)
    for body in (ground, block):
        body.rigid_body.friction = math.sqrt(friction)  # Bullet multiplies both
    keep_ground_motion(scene.scene, record)
    move_with_ground(scene.scene, record, 0.0, 2, Timeline.of(1.0 / FRAMES_PER_SECOND, duration_s, ()))
    return scene.play(folder, round(duration_s * FRAMES_PER_SECOND))


def test_ground_and_a_block_on_it_follow_a_sweep(blender, tmp_path):
    """Friction of 0.8 holds a block under 2 m/s² in two directions. Frames are 1/24 s long, and the record has 5 Hz:
    between frames the ground does not go in straight lines. The block slips by some micrometres."""
    sweep = Sweep(from_hz=1.0, to_hz=5.0, duration_s=2.0, acceleration_m_s2=2.0)
    record = ground_record(GroundMotion(directions=("along", "across", "up"), sweep=sweep), seed=0)
    frames = on_ground(tmp_path, record, (1.0, 1.0, 1.0), 0.8, 1.7).frames
    wanted = np.array([record.displacement_at(time_s) for time_s in frames.time_s.tolist()])
    largest = abs(wanted).max()
    ground, block = (frames.positions_m[:, row] - frames.positions_m[0, row] for row in (0, 1))
    assert largest > 0.02
    assert ground == pytest.approx(wanted, abs=1e-6)
    shown = blender.data.objects["Block 0"].evaluated_get(blender.context.evaluated_depsgraph_get()).matrix_world
    assert np.array(shown.translation) - (0.0, 0.0, -0.5) == pytest.approx(wanted[-1], abs=1e-6)
    assert block[:, :2] == pytest.approx(wanted[:, :2], abs=0.001 * largest)  # the issue asks for 1 %
    assert block[:, 2] == pytest.approx(wanted[:, 2], abs=0.01 * largest)


def test_a_block_slips_where_friction_ends(blender, tmp_path):
    """On ground that is accelerated by 4 m/s² for 1 s, friction of 0.2 leaves the block 0.2 g: it lags by (4 - 0.2 g)
    t² / 2. 1 %: half a sub-step of 1/240 s."""
    record = integrated(np.array([0.0, 1.0, 1.001, 9.0]), np.outer([4.0, 4.0, 0.0, 0.0], [1.0, 0.0, 0.0]))
    frames = on_ground(tmp_path, record, (2.0, 2.0, 0.5), 0.2, 1.0).frames
    lag = frames.positions_m[-1, 0, 0] - frames.positions_m[-1, 1, 0]
    expected = 0.5 * (4.0 - 0.2 * STANDARD_GRAVITY_M_S2) * frames.time_s[-1] ** 2
    assert lag == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize(("share", "tips"), [(0.9, False), (1.1, True)])
def test_a_block_tips_after_the_pulse_that_housner_gives(blender, tmp_path, share, tips):
    """G. W. Housner (1963), The behavior of inverted pendulum structures during earthquakes, Bulletin of the
    Seismological Society of America 53, 403-417: under a constant acceleration a it tips after a time t with
    cosh(p t) = 1 + 1 / (2 (a / g α) (a / g α - 1)), p² = 3 g / 4 R. His α is small; here tan α stands for it. A tenth
    shorter or longer: which of both it does is not chaotic."""
    height, width, ratio = 2.0, 0.5, 2.0
    radius, slope = math.hypot(height, width) / 2.0, width / height
    own = math.sqrt(3.0 * STANDARD_GRAVITY_M_S2 / (4.0 * radius))
    pulse_s = share * math.acosh(1.0 + 1.0 / (2.0 * ratio * (ratio - 1.0))) / own
    acceleration = ratio * slope * STANDARD_GRAVITY_M_S2
    times = np.array([0.0, pulse_s, pulse_s + 1e-4, 9.0])
    record = integrated(times, np.outer([acceleration, acceleration, 0.0, 0.0], [1.0, 0.0, 0.0]))
    frames = on_ground(tmp_path, record, (width, width, height), 25.0, 2.0).frames
    upright = frames.rotations[-1, 1, 2, 2]
    assert upright < 0.1 if tips else upright > 0.99


COLUMN = """
[scenario]
title = "a column on ground that shakes"

[time]
duration_s = 1.2
frames_per_second = 24
substeps_per_frame = 10

[[geometry]]
name = "column"
file = "column.obj"
density_kg_m3 = 2400.0

[fracture]
shards = 3

[connections]
type = "FIXED"
method = "face"
material = "reinforced concrete column"
{stiffness}

[shards]
linear_damping = 0.0

[[supports]]
member = "column"
face = "bottom"

[ground_motion]
file = "ramp.csv"
unit = "m/s2"
directions = ["along"]
baseline = "none"
start_s = 0.1
"""


@pytest.fixture
def column(tmp_path):
    import trimesh

    mesh = trimesh.creation.box((1.0, 1.0, 3.0))
    mesh.apply_translation((0.0, 0.0, 1.5))
    mesh.export(tmp_path / "column.obj")
    times = np.linspace(0.0, 9.0, 901)
    rising = np.minimum(times / 0.4, 1.0) * (times < 2.0)
    falling = np.interp(times, [4.0, 4.4, 6.0, 6.4], [0.0, 1.0, 1.0, 0.0])
    values = rising - falling * rising.sum() / falling.sum()
    np.savetxt(tmp_path / "ramp.csv", np.column_stack((times, values)), delimiter=",")

    def written(stiffness):
        path = tmp_path / "column.toml"
        path.write_text(COLUMN.format(stiffness=stiffness), encoding="utf-8")
        return read_scenario(path)

    return written


@pytest.mark.parametrize("stiffness", ["", 'stiffness = "elastic"'])
def test_a_column_fixed_to_the_ground_pulls_as_its_mass(blender, column, tmp_path, stiffness):
    """After the ramp the ground is accelerated by 1 m/s²: the connections to the held shards bear mass times that. The
    column is stiff, and swings about it by some percent where it is elastic."""
    run_scenario(column(stiffness), tmp_path / "run", overwrite=True, pictures=False, progress=Silence())
    results = load_results(tmp_path / "run" / "results.npz")
    frames, inventory = results.frames, results.inventory
    held = np.flatnonzero((inventory.body_kinds == "shard") & ~inventory.moves)
    feet = np.flatnonzero(np.isin(inventory.pairs, held).any(axis=1))
    assert len(feet) and frames.intact.all()
    late = frames.time_s > 0.7
    sums = np.linalg.norm(frames.loads.connection_forces_n[late][:, feet].sum(axis=1)[:, :2], axis=1)
    moving_kg = inventory.masses_kg.sum()
    assert sums.mean() == pytest.approx(moving_kg * 1.0, rel=0.01)
    # The supports move as the ground does.
    ground = inventory.of_kind("ground")[0]
    shift = frames.positions_m[-1] - frames.positions_m[0]
    assert shift[held, 0] == pytest.approx(np.full(len(held), shift[ground, 0]), abs=1e-6)
    assert shift[ground, 0] > 0.1
