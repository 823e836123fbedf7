# SPDX-License-Identifier: GPL-3.0-or-later
"""Blast loads in Blender: the impulse that bodies really get, measured by their velocities."""

import csv
import math

import bpy  # noqa: F401  mathutils is there once it is imported
import numpy as np
import pytest
from mathutils import Euler
from support.blast_scenes import ARRIVAL_AT_5_S, END_AT_5_S, IMPULSE_AT_5_PA_S, charge, set_off, weightless
from support.blocks import Blocks
from support.long_cases import long_but

from bridge_demolition_addon.bullet import layout
from bridge_demolition_addon.engineering.blast.pulses import blast_pulses
from bridge_demolition_addon.engineering.timing.timeline import SlowMotion, Timeline
from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import SimulationError
from bridge_demolition_addon.scene.blast.force_fields import build_force_objects, force_objects
from bridge_demolition_addon.scene.bodies import bodies_of
from bridge_demolition_addon.scene.world import animate_time_scale
from bridge_demolition_addon.simulation.blender_events import start_recording, stop_recording
from bridge_demolition_addon.simulation.recording.recorder import Recording

STEPS = {
    "24 × 10": {"frames_per_second": 24, "substeps_per_frame": 10},
    "24 × 1": {"frames_per_second": 24, "substeps_per_frame": 1},
    "60 × 10": {"frames_per_second": 60, "substeps_per_frame": 10},
    "240 × 1": {"frames_per_second": 240, "substeps_per_frame": 1},
    "29.97 × 10": {"frames_per_second": 30, "frames_per_second_base": 1.001, "substeps_per_frame": 10},
    "slow 24 × 10": {"frames_per_second": 24, "substeps_per_frame": 10, "time_scale": 0.05},
    "slow 60 × 1": {"frames_per_second": 60, "substeps_per_frame": 1, "time_scale": 0.05},
}
WAYS = ("fields", "direct")
MASS_KG = 1000.0
PROMISE = 1e-3
"""Of the impulse. The table's own last digit is 1e-4 of it, and the body moves by 1e-4 of the stand-off meanwhile."""

every_way = pytest.mark.parametrize("apply", WAYS)
every_step = pytest.mark.parametrize("step", STEPS.values(), ids=STEPS)


def frames_for(blocks, seconds):
    return max(3, math.ceil(seconds / blocks.time.step.frame_s) + 1)


@every_way
@every_step
def test_one_charge_gives_the_impulse_of_the_table(blender, tmp_path, apply, step):
    blocks = weightless(**step)
    blocks.block((10.0, 0.0, 0.0), MASS_KG)
    set_off(blocks, [charge("a", (0, 0, 0), 8.0)], apply)
    results = blocks.play(tmp_path, frames_for(blocks, 0.05))
    # 8 kg stretch the times and impulses of 1 kg by 2; a cube of 1 m shows 1 m² to the charge.
    expected = 2.0 * IMPULSE_AT_5_PA_S
    assert MASS_KG * results.frames.velocities_m_s[-1, 0] == pytest.approx([expected, 0.0, 0.0], rel=PROMISE, abs=0.01)
    assert results.frames.blast_impulses_ns.sum(axis=0)[0] == pytest.approx([expected, 0.0, 0.0], rel=PROMISE, abs=0.01)


@every_way
@every_step
def test_three_charges_with_delays_on_a_turned_body(blender, tmp_path, apply, step):
    blocks = weightless(**step)
    body = blocks.block((0.0, 0.0, 0.0), MASS_KG)
    body.rotation_euler = (0.0, 0.0, math.pi / 4.0)
    charges = [
        charge("west", (-5, 0, 0), 1.0),
        charge("south", (0, -10, 0), 8.0, delay_s=0.017),
        charge("below", (0, 0, -15), 27.0, delay_s=0.002),
    ]
    set_off(blocks, charges, apply, start_s=0.01)
    results = blocks.play(tmp_path, frames_for(blocks, 0.12))
    # Turned by an eighth, a cube shows √2 m² to its sides.
    expected = IMPULSE_AT_5_PA_S * np.array([np.sqrt(2.0), 2.0 * np.sqrt(2.0), 3.0])
    assert MASS_KG * results.frames.velocities_m_s[-1, 0] == pytest.approx(expected, rel=PROMISE)


@every_way
@pytest.mark.parametrize("step", [STEPS["24 × 10"], STEPS["240 × 1"]], ids=["24 × 10", "240 × 1"])
def test_bodies_of_a_touching_deck_each_get_their_own_load(blender, tmp_path, apply, step):
    blocks = weightless(**step)
    positions = np.array([(x, y, 4.0) for x in range(5) for y in range(4)], float)
    charges = [charge("a", (1.2, 1.4, 0.0), 2.0), charge("b", (4.4, -2.0, 3.0), 1.0, delay_s=0.003)]
    for row, position in enumerate(positions):
        block = blocks.block(position, 10_000.0)
        # Each in a collision group of its own: they touch all along, but only the blast pushes them.
        block.rigid_body.collision_collections = [group == row for group in range(20)]
    set_off(blocks, charges, apply)
    results = blocks.play(tmp_path, frames_for(blocks, 0.05))
    differences = positions[:, None] - np.array([placed.position_m for placed in charges])[None]
    stand_offs = np.linalg.norm(differences, axis=2)
    directions = differences / stand_offs[..., None]
    areas = abs(directions).sum(axis=2)  # of a cube of 1 m whose faces look along the axes
    pulses = blast_pulses(stand_offs, [2.0, 1.0], [0.0, 0.003], ["air", "air"])
    expected = np.einsum("nc,nci->ni", pulses.impulses_pa_s * areas, directions)
    got = 10_000.0 * results.frames.velocities_m_s[-1]
    assert np.linalg.norm(got - expected, axis=1) == pytest.approx(0.0, abs=PROMISE * np.linalg.norm(expected))
    assert (np.linalg.norm(got - expected, axis=1) < PROMISE * np.linalg.norm(expected, axis=1)).all()


@every_way
def test_nothing_pushes_before_the_front_arrives_or_after_it_has_passed(blender, tmp_path, apply):
    blocks = weightless(frames_per_second=1000, substeps_per_frame=1)
    blocks.block((5.0, 0.0, 0.0), MASS_KG)
    set_off(blocks, [charge("a", (0, 0, 0), 1.0)], apply, start_s=0.004)
    results = blocks.play(tmp_path, 40)
    speeds, times = np.linalg.norm(results.frames.velocities_m_s[:, 0], axis=1), results.frames.time_s
    before, after = times <= 0.004 + ARRIVAL_AT_5_S, times > 0.004 + END_AT_5_S + 1e-3
    assert before.sum() > 10 < after.sum()
    np.testing.assert_array_equal(speeds[before], 0.0)
    assert np.ptp(speeds[after]) == 0.0 < speeds[-1]
    assert (np.diff(speeds[~before & ~after]) > 0.0).all()
    np.testing.assert_array_equal(results.frames.blast_impulses_ns[before | after], 0.0)


@every_way
def test_nothing_stays_switched_on(blender, tmp_path, apply):
    blocks = weightless(frames_per_second=1000, substeps_per_frame=1)
    blocks.block((5.0, 0.0, 0.0), MASS_KG)
    set_off(blocks, [charge("a", (0, 0, 0), 1.0)], apply)
    start_recording(recording := Recording(blocks.scene, tmp_path))
    for frame in range(1, 15):  # into the middle of the positive phase
        blocks.scene.frame_set(frame)
    stop_recording()
    speeds = recording.results().frames.velocities_m_s[:, 0, 0]
    assert speeds[-1] > speeds[-2] > 0.0
    graph = blender.context.view_layer.depsgraph
    fields = force_objects(blocks.scene).values()
    assert [field.field.strength for field in fields] == [0.0] * len(fields)
    assert [field.evaluated_get(graph).field.strength for field in fields] == [0.0] * len(fields)
    positions = []
    for frame in range(15, 25):
        blocks.scene.frame_set(frame)
        positions.append(blocks.world.collection.objects[0].matrix_world.translation.x)
    # Unpushed, it goes on at the speed it had; single precision of places is 5e-7 m here.
    assert np.diff(positions) * 1000.0 == pytest.approx(speeds[-1], abs=2e-3)


@every_way
def test_a_run_from_the_start_gives_the_same_again(blender, tmp_path, apply):
    blocks = weightless(frames_per_second=100, substeps_per_frame=5)
    blocks.block((5.0, 1.0, 0.0), MASS_KG)
    blocks.block((6.5, 1.0, 0.0), MASS_KG)
    set_off(blocks, [charge("a", (0, 0, 0), 1.0), charge("b", (3, 3, 3), 1.0, delay_s=0.01)], apply)
    velocities, logs = [], []
    for name in ("first", "second", "third"):
        (folder := tmp_path / name).mkdir()
        blocks.world.substeps_per_frame = 5  # makes Blender forget the frames that it played
        velocities.append(blocks.play(folder, 8).frames.velocities_m_s)
        logs.append((folder / "explosion_log.csv").read_bytes())
    assert np.linalg.norm(velocities[0][-1], axis=1).min() > 0.0
    assert velocities[1].tobytes() == velocities[2].tobytes()
    assert logs[0] == logs[1] == logs[2]
    # The first world that Blender makes in a file differs by single precision's last digit.
    np.testing.assert_allclose(velocities[0], velocities[1], rtol=2e-7)


@every_way
def test_a_sleeping_body_is_woken(blender, tmp_path, apply):
    blocks = Blocks(frames_per_second=1000, substeps_per_frame=1)
    body = blocks.block((5.0, 0.0, 0.0), MASS_KG)
    body.rigid_body.use_deactivation = body.rigid_body.use_start_deactivated = True
    body.rigid_body.deactivate_linear_velocity = body.rigid_body.deactivate_angular_velocity = 0.0
    set_off(blocks, [charge("a", (0, 0, 0), 1.0)], apply)
    results = blocks.play(tmp_path, 40)
    assert results.frames.asleep[results.frames.time_s <= ARRIVAL_AT_5_S, 0].all()
    assert not results.frames.asleep[results.frames.time_s > END_AT_5_S, 0].any()
    velocity = results.frames.velocities_m_s[-1, 0]
    assert MASS_KG * velocity[0] == pytest.approx(IMPULSE_AT_5_PA_S, rel=PROMISE)
    # It begins to fall when the front arrives, to within a step.
    fallen_s = results.frames.time_s[-1] - ARRIVAL_AT_5_S
    assert -velocity[2] == pytest.approx(STANDARD_GRAVITY_M_S2 * fallen_s, abs=STANDARD_GRAVITY_M_S2 * 1.001e-3)


def blocks_under_a_ball():
    blocks = Blocks()
    blocks.block((0, 0, -0.5), size_m=(20, 20, 1))
    first, second = blocks.block((0, 0, 0.5), MASS_KG), blocks.block((1, 0, 0.5), MASS_KG)
    blocks.connect("FIXED", (0.5, 0, 0.5), first, second, 5e4)
    blocks.block((0.2, 0.1, 3.0), 3.0 * MASS_KG)
    return blocks


@every_way
@pytest.mark.parametrize(
    "masses_kg", long_but([(0.0,)], [(), (0.0,), (0.0, 0.0)]), ids=["no charge", "0 kg", "twice 0 kg"]
)
def test_ticking_explosion_without_a_charge_changes_nothing(blender, tmp_path, apply, masses_kg):
    logs = []
    for explosion in (False, True):
        blender.ops.wm.read_factory_settings(use_empty=True)
        blocks = blocks_under_a_ball()
        charges = [charge(f"charge {number}", (0, number, 1), mass) for number, mass in enumerate(masses_kg)]
        set_off(blocks, charges, apply, explosion=explosion)
        (folder := tmp_path / str(explosion)).mkdir()
        blocks.play(folder, 30)
        logs.append({path.name: path.read_bytes() for path in folder.iterdir()})
    assert logs[0] == logs[1]
    assert "explosion_log.csv" not in logs[0]


@every_way
def test_charges_do_nothing_while_explosion_is_not_ticked(blender, tmp_path, apply):
    blocks = weightless()
    blocks.block((5.0, 0.0, 0.0), MASS_KG)
    set_off(blocks, [charge("a", (0, 0, 0), 1.0)], apply, explosion=False)
    np.testing.assert_array_equal(blocks.play(tmp_path, 5).frames.velocities_m_s, 0.0)


@every_way
def test_a_charge_in_the_middle_of_a_body_pushes_it_upwards(blender, tmp_path, apply):
    blocks = weightless()
    blocks.block((5.0, 2.0, 3.0), 1e6)
    set_off(blocks, [charge("a", (5.0, 2.0, 3.0), 1.0)], apply)
    results = blocks.play(tmp_path, 5)
    # The smallest stand-off stands for all that are smaller: that of the charge's own surface.
    expected = blast_pulses([[0.0]], [1.0], [0.0], ["air"]).impulses_pa_s.item()
    assert 1e6 * results.frames.velocities_m_s[-1, 0] == pytest.approx([0.0, 0.0, expected], rel=PROMISE, abs=1e-3)


def rows_of(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


@every_way
def test_the_log_tells_every_load(blender, tmp_path, apply):
    blocks = weightless(frames_per_second=500, substeps_per_frame=4)
    body = blocks.block((3.0, 4.0, 0.0), MASS_KG)
    body.rotation_euler = Euler((0.0, 0.0, math.atan2(4.0, 3.0)))
    set_off(blocks, [charge("a, b", (0, 0, 0), 1.0)], apply)
    results = blocks.play(tmp_path, 30)
    rows = rows_of(tmp_path / "explosion_log.csv")
    assert {(row["body"], row["charge"]) for row in rows} == {("Block 0", "a, b")}
    frames = [int(row["frame"]) for row in rows]
    assert frames == list(range(frames[0], frames[-1] + 1))

    def column(name):
        return np.array([float(row[name]) for row in rows])

    assert column("stand_off_m") == pytest.approx(5.0)
    assert column("scaled_distance_m_kg13") == pytest.approx(5.0)
    assert column("projected_area_m2") == pytest.approx(1.0, rel=1e-6)
    directions = np.column_stack([column(f"direction_{axis}") for axis in "xyz"])
    assert directions == pytest.approx(np.tile([0.6, 0.8, 0.0], (len(rows), 1)))
    assert column("peak_pressure_Pa") == pytest.approx(31.30e3, rel=PROMISE)  # Kingery and Bulmash at Z = 5
    assert column("impulse_Ns").sum() == pytest.approx(IMPULSE_AT_5_PA_S, rel=PROMISE)
    frame_s = 1.0 / 500.0
    forces = np.column_stack([column(f"force_{axis}_N") for axis in "xyz"])
    np.testing.assert_allclose(forces, column("impulse_Ns")[:, None] / frame_s * directions, rtol=1e-6, atol=1e-6)
    np.testing.assert_allclose(
        column("mean_pressure_Pa") * column("projected_area_m2") * frame_s, column("impulse_Ns"), rtol=1e-6
    )
    in_results = results.frames.blast_impulses_ns[np.isin(results.frames.number, frames), 0]
    np.testing.assert_allclose(in_results, forces * frame_s, rtol=1e-6, atol=1e-6)


@every_way
def test_momentum_of_connected_bodies_is_that_of_the_blast(blender, tmp_path, apply):
    blocks = weightless()
    first, second = blocks.block((5, 0, 0), MASS_KG), blocks.block((5, 1, 0), MASS_KG)
    blocks.connect("FIXED", (5, 0.5, 0), first, second)
    set_off(blocks, [charge("a", (0, 0.3, 0), 4.0)], apply)
    results = blocks.play(tmp_path, 6)
    got = MASS_KG * results.frames.velocities_m_s[-1].sum(axis=0)
    # The joint only passes on what it gets; the solver leaves a part in 1e5.
    assert got == pytest.approx(results.frames.blast_impulses_ns.sum(axis=(0, 1)), rel=1e-4, abs=0.01)


@every_way
@pytest.mark.parametrize(("share", "holds"), ((0.95, False), (1.05, True)))
def test_thresholds_follow_slowed_time(blender, tmp_path, apply, share, holds):
    blocks = Blocks()
    weight = MASS_KG * STANDARD_GRAVITY_M_S2
    ceiling, block = blocks.block((0, 0, 10)), blocks.block((0, 0, 9), MASS_KG)
    blocks.connect("FIXED", (0, 0, 9.5), ceiling, block, 2.0 * weight)
    # Pulled down by a second weight of just less or more than the connection bears on top of the first.
    load = blocks.block((0, 0, 8), (2.0 / share - 1.0) * MASS_KG)
    blocks.connect("FIXED", (0, 0, 8.5), block, load)
    set_off(blocks, [charge("far away", (500, 0, 0), 1e-6)], apply)
    timeline = Timeline.of(blocks.time.step.frame_s, 0.5, [SlowMotion(0.1, 0.05, 0.002)])
    animate_time_scale(blocks.scene, timeline, 3)
    results = blocks.play(tmp_path, len(timeline))
    assert bool(results.frames.intact[-1][0]) is holds
    # What breaks does so at once, what holds does so in all frames, 25 of them twenty times shorter than the first.
    np.testing.assert_allclose(np.diff(results.frames.time_s), timeline.frame_lengths_s, rtol=1e-6)


@every_way
def test_slowed_time_keeps_the_impulse(blender, tmp_path, apply):
    blocks = weightless()
    blocks.block((5.0, 0.0, 0.0), MASS_KG)
    set_off(blocks, [charge("a", (0, 0, 0), 1.0)], apply, start_s=0.1)
    timeline = Timeline.of(blocks.time.step.frame_s, 0.2, [SlowMotion(0.1, 0.02, 0.001)])
    animate_time_scale(blocks.scene, timeline, 3)
    results = blocks.play(tmp_path, len(timeline))
    assert MASS_KG * results.frames.velocities_m_s[-1, 0, 0] == pytest.approx(IMPULSE_AT_5_PA_S, rel=PROMISE)
    assert results.frames.time_s[-1] == pytest.approx(timeline.ends_s[-1], rel=1e-6)
    # Of 3.333 ms of positive phase a frame of 1 ms shows at least three parts.
    assert (results.frames.blast_impulses_ns[:, 0, 0] > 0.0).sum() in (4, 5)


def limits_of(scene):
    return scene.view_layers[0].depsgraph.scene_eval.rigidbody_world.effector_weights


def test_fields_are_ignored_while_none_pushes_and_heeded_afterwards(blender, tmp_path):
    blocks = weightless(frames_per_second=1000, substeps_per_frame=1)
    blocks.block((5.0, 0.0, 0.0), MASS_KG)
    set_off(blocks, [charge("a", (0, 0, 0), 1.0)], "fields")
    start_recording(recording := Recording(blocks.scene, tmp_path))
    ignored = []
    for frame in range(1, 40):
        blocks.scene.frame_set(frame)
        ignored.append(limits_of(blocks.scene).collection is not None)
    stop_recording()
    assert recording.error is None
    pushes = np.array([frame.blast_impulses_ns.any() for frame in recording.frames[1:]])
    np.testing.assert_array_equal(ignored[2:], ~pushes)
    assert pushes.any() and not pushes.all()
    assert limits_of(blocks.scene).collection is None


def test_fields_of_the_users_own_push_on(blender, tmp_path):
    blocks = weightless(frames_per_second=24, substeps_per_frame=10)
    blocks.block((5.0, 0.0, 0.0), MASS_KG)
    set_off(blocks, [charge("a", (0, 0, 0), 1.0)], "fields", start_s=10.0)
    blender.ops.object.effector_add(type="FORCE", location=(0, 0, -2))
    wind = blender.context.object.field
    wind.shape, wind.strength, wind.falloff_power = "PLANE", 24.0 * MASS_KG, 0.0
    results = blocks.play(tmp_path, 20)
    # 1 N on every kg; Blender reckons in single precision.
    assert results.frames.velocities_m_s[-1, 0] == pytest.approx(
        [0.0, 0.0, results.frames.time_s[-1]], rel=1e-4, abs=1e-6
    )


def test_building_force_objects_again_updates_and_does_not_double(blender, tmp_path):
    blocks = weightless()
    bodies = [blocks.block((x, 0, 0), MASS_KG) for x in (5.0, 8.0)]
    set_off(blocks, [charge("a", (0, 0, 0), 1.0)], "fields")
    assert set(force_objects(blocks.scene)) == set(bodies)
    assert build_force_objects(blocks.scene, bodies_of(blocks.scene)).kept == 2
    added = blocks.block((11.0, 0, 0), MASS_KG)
    with pytest.raises(SimulationError, match="'Block 2' has no force field: build the force fields again"):
        blocks.play(tmp_path, 3)
    blender.data.objects.remove(bodies[0])
    built = build_force_objects(blocks.scene, bodies_of(blocks.scene))
    assert (built.made, built.kept, built.removed) == (1, 1, 1)
    assert set(force_objects(blocks.scene)) == {bodies[1], added}
    assert blocks.play(tmp_path, 3).frames.velocities_m_s[-1, :, 0].min() > 0.0


def test_force_objects_need_a_body_to_push(blender):
    blocks = weightless()
    blocks.block((0, 0, 0))
    with pytest.raises(SimulationError, match="no active body to push"):
        build_force_objects(blocks.scene, bodies_of(blocks.scene))
    assert not force_objects(blocks.scene)


def test_changing_a_force_object_while_it_pushes_ends_the_recording_and_says_so(blender, tmp_path):
    blocks = weightless(frames_per_second=1000, substeps_per_frame=1)
    blocks.block((5.0, 0.0, 0.0), MASS_KG)
    set_off(blocks, [charge("a", (0, 0, 0), 1.0)], "fields")
    (field,) = force_objects(blocks.scene).values()
    start_recording(recording := Recording(blocks.scene, tmp_path))
    for frame in range(1, 20):
        field.location.x += 0.1  # Blender makes a new evaluated copy, without our load
        blocks.scene.frame_set(frame)
    stop_recording()
    assert "force field was changed" in str(recording.error)


@pytest.mark.parametrize(
    "deleted_at, reason",
    [(2, "has no force field"), (4, "is deleted, switched off"), (10, "is deleted, switched off")],
    ids=["before the first frame", "before it pushes", "after it pushed"],
)
def test_deleting_force_objects_ends_the_recording_and_says_so(blender, tmp_path, deleted_at, reason):
    blocks = weightless(frames_per_second=1000, substeps_per_frame=1)
    pushed = [blocks.block((side * 5.0, 0.0, 0.0), MASS_KG) for side in (1, -1)]
    set_off(blocks, [charge("a", (0, 0, 0), 1.0)], "fields")
    fields = force_objects(blocks.scene)
    start_recording(recording := Recording(blocks.scene, tmp_path))
    for frame in range(1, 20):
        if frame == deleted_at:
            blender.data.objects.remove(fields[pushed[0]])
        blocks.scene.frame_set(frame)
    assert reason in str(recording.error)
    stop_recording()
    blocks.scene.frame_set(1)
    assert fields[pushed[1]].evaluated_get(blender.context.evaluated_depsgraph_get()).field.strength == 0.0
    with pytest.raises(SimulationError, match="has no force field: build the force fields again"):
        Recording(blocks.scene, tmp_path)


@pytest.mark.parametrize("switched_off", ["excluded", "disabled"])
def test_force_objects_that_would_push_nothing_are_named(blender, tmp_path, switched_off):
    blocks = weightless()
    blocks.block((5.0, 0.0, 0.0), MASS_KG)
    set_off(blocks, [charge("a", (0, 0, 0), 1.0)], "fields")
    (field,) = force_objects(blocks.scene).values()
    if switched_off == "excluded":
        blender.context.view_layer.layer_collection.children["Force objects"].exclude = True
    else:
        field.hide_viewport = True
    with pytest.raises(SimulationError, match="is deleted, switched off or excluded from the view layer"):
        blocks.play(tmp_path, 3)
    assert field.field.strength == 0.0


@pytest.mark.parametrize("mass", [-1.0, math.nan, math.inf])
def test_a_charge_that_cannot_be_is_refused(blender, tmp_path, mass):
    blocks = weightless()
    blocks.block((5.0, 0.0, 0.0), MASS_KG)
    set_off(blocks, [charge("a", (0, 0, 0), 1.0)], "fields")
    blender.data.objects["a"]["bda_mass_kg"] = mass
    with pytest.raises(Exception, match=r"a: charges.mass_kg is .*: expected a number from 0 to 1000000 \(kg\)"):
        blocks.play(tmp_path, 3)


@every_way
def test_a_body_without_volume_is_named(blender, tmp_path, apply):
    blocks = weightless()
    body = blocks.block((5.0, 0.0, 0.0), MASS_KG)
    for vertex in body.data.vertices:
        vertex.co.z = 0.0
    set_off(blocks, [charge("a", (0, 0, 0), 1.0)], apply)
    with pytest.raises(Exception, match="body 'Block 0' has no volume"):
        blocks.play(tmp_path, 3)


@pytest.fixture
def strange_blender(blender, monkeypatch):
    """A Blender that keeps its bodies elsewhere than any known one."""
    right = layout.platform_layout()
    wrong = layout.replace(right, body=layout.replace(right.body, friction=right.body.friction + 8))
    monkeypatch.setattr(layout, "SYSTEM_V", wrong)
    monkeypatch.setattr(layout, "MICROSOFT", wrong)
    return blender


@pytest.mark.parametrize("step", [STEPS["24 × 10"], STEPS["240 × 1"]], ids=["24 × 10", "240 × 1"])
def test_fields_need_nothing_of_bullets_memory(strange_blender, tmp_path, step):
    blocks = weightless(**step)
    blocks.block((10.0, 0.0, 0.0), MASS_KG)
    set_off(blocks, [charge("a", (0, 0, 0), 8.0)], "fields")
    results = blocks.play(tmp_path, frames_for(blocks, 0.08))
    assert results.load_sampling == "change of momentum between frames"
    assert MASS_KG * results.frames.velocities_m_s[-1, 0, 0] == pytest.approx(2.0 * IMPULSE_AT_5_PA_S, rel=PROMISE)


def test_direct_loads_are_refused_where_memory_is_strange(strange_blender, tmp_path):
    blocks = weightless()
    blocks.block((10.0, 0.0, 0.0), MASS_KG)
    set_off(blocks, [charge("a", (0, 0, 0), 8.0)], "direct")
    with pytest.raises(SimulationError, match="blast cannot be applied directly"):
        blocks.play(tmp_path, 3)
