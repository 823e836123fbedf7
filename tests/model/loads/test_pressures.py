# SPDX-License-Identifier: GPL-3.0-or-later
"""Pressures that change with time, against areas by hand, momentum and statics."""

import math
from dataclasses import replace

import numpy as np
import pytest
import trimesh
from support.blocks import Blocks
from support.bridges_of_meshes import block, scenario_of
from support.meshes import of_trimesh, turned

from bridge_demolition_addon.engineering.units import STANDARD_GRAVITY_M_S2
from bridge_demolition_addon.errors import ScenarioError
from bridge_demolition_addon.model.loads.pressures import PressedFaces, Pressure
from bridge_demolition_addon.model.scenario import (
    ConnectionSettings,
    FracturePoint,
    FractureSettings,
    Material,
    ShardSettings,
    TimeSettings,
)
from bridge_demolition_addon.model.sequence.checked_model import ModelWorksite, checked_model
from bridge_demolition_addon.report.sections.planned_sequence import means_text, planned_steps
from bridge_demolition_addon.scene.custom_properties import keep_tables, run_tables_of
from bridge_demolition_addon.scene.demolition import build_demolition
from bridge_demolition_addon.simulation.playback import Playing
from bridge_demolition_addon.simulation.recording.recorder import Recording

CONCRETE = Material(
    name="of the test",
    compression_n_mm2=1e3,
    tension_n_mm2=1e3,
    shear_n_mm2=1e3,
    torsion_n_mm2=1e3,
    bending_n_mm2=1e3,
    elastic_modulus_n_mm2=30000.0,
)
ELASTIC = ConnectionSettings(method="face", type="FIXED", stiffness="elastic", material=CONCRETE.name, foundation=True)
KEYS = {"name": "wind", "direction": (0.0, 2.0, 0.0), "times_s": (0.0, 1.0), "pressures_kpa": (0.0, 2.0)}
WALL_M = (4.0, 0.5, 3.0)


def of_solid(solid, folder, pressure=KEYS, shards=8, duration_s=1.0, **tables):
    parts = {"wall": ("wall", solid)}
    defaults = {
        "connections": ELASTIC,
        "materials": (CONCRETE,),
        "bearings": (),
        "fracture": FractureSettings(shards=shards),
    }
    scenario = scenario_of(parts, folder, None, **(defaults | tables))
    return replace(scenario, time=TimeSettings(duration_s=duration_s), pressures=(Pressure(**pressure),))


def faces_of(scenario):
    (pressure,) = scenario.pressures
    return pressure.faces(ModelWorksite(scenario, checked_model(scenario)))


def resultant(faces, pressure_pa=1000.0):
    force_n, point_m = faces.resultant(pressure_pa)
    return force_n.tolist(), point_m.tolist()


@pytest.mark.parametrize("shards", [1, 8, 30])
def test_only_the_outer_faces_of_the_side_are_pressed_however_the_wall_is_cut(tmp_path, shards):
    faces = faces_of(of_solid(block(WALL_M, (0.0, 0.0, 0.0)), tmp_path, shards=shards))
    assert math.fsum(faces.areas_m2) == pytest.approx(4.0 * 3.0, rel=1e-6)
    force_n, point_m = resultant(faces)
    assert force_n == pytest.approx([0.0, 12000.0, 0.0], abs=0.1)
    assert point_m == pytest.approx([2.0, 0.0, 1.5], abs=1e-4)


def test_a_turned_side_is_pressed_across_itself(tmp_path):
    wall = turned(block(WALL_M, (0.0, 0.0, 0.0)), math.radians(30.0), (0.0, 0.0, 1.0))
    force_n, _ = resultant(faces_of(of_solid(wall, tmp_path)))
    assert force_n == pytest.approx([-12000.0 * 0.5, 12000.0 * math.sqrt(0.75), 0.0], rel=1e-4, abs=0.1)


def test_a_round_column_has_the_force_on_its_shadow(tmp_path):
    """The normals of a prism add up to its width across the direction: 2 r for a polygon with corners there."""
    column = of_trimesh(trimesh.creation.cylinder(0.5, 4.0, sections=32))
    column = replace(column, vertices=column.vertices + np.array((0.0, 0.0, 2.0)))
    force_n, _ = resultant(faces_of(of_solid(column, tmp_path, KEYS | {"within_deg": 90.0}, shards=4)))
    assert force_n == pytest.approx([0.0, 1000.0 * 1.0 * 4.0, 0.0], rel=1e-4, abs=0.5)
    force_n, _ = resultant(faces_of(of_solid(column, tmp_path, KEYS, shards=4)))
    assert force_n[1] < 1000.0 * 0.8 * 4.0  # faces within 45° alone


def test_check_report_and_summary_say_force_and_weight(tmp_path):
    scenario = of_solid(block(WALL_M, (0.0, 0.0, 0.0)), tmp_path)
    (pressure,) = scenario.pressures
    (first, second) = pressure.facts(ModelWorksite(scenario, checked_model(scenario)))
    assert first == ("wind", "0 kPa at 0 s, 2 kPa at 1 s, towards (0, 2, 0)")
    share = 24000.0 / (2400.0 * 6.0 * STANDARD_GRAVITY_M_S2)
    assert second[1].startswith("on 12.00 m² of wall: up to 24.0 kN at (2, 0, 1.5) m, ")
    assert f"{share:.0%} of their weight" in second[1]
    assert means_text(scenario) == "1 pressure"
    (step,) = planned_steps(scenario)
    assert (step.begins_s, step.ends_s, step.what) == (0.0, 1.0, "wind: pressure of up to 2 kPa")


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"direction": (0.0, 0.0, 0.0)}, r"pressures\.direction is .*all 0: expected a direction"),
        ({"times_s": (0.0, 1.0, 2.0)}, r"pressures\.pressures_kpa .*as many as pressures\.times_s, 3"),
        ({"times_s": (1.0, 1.0)}, r"pressures\.times_s\.2 is 1\.0: expected more than the one before"),
        ({"within_deg": 0.0}, r"pressures\.within_deg is 0\.0"),
        ({"members": ("deck",)}, r'pressures\.members names "deck"'),
        ({"direction": (1.0, 1.0, 0.0), "within_deg": 30.0}, r"pressures\.direction .*a face on the surface"),
        ({"times_s": (3.0, 4.0)}, r"pressures\.times_s\.1 is 3\.0: expected less than time\.duration_s"),
    ],
)
def test_what_cannot_press_is_refused(tmp_path, keys, message):
    with pytest.raises(ScenarioError, match=message):
        faces_of(of_solid(block(WALL_M, (0.0, 0.0, 0.0)), tmp_path, KEYS | keys))


def test_its_mean_in_a_step_is_the_integral_by_the_step():
    """Over a corner, before the first time, after the last, and below 0."""
    faces = pressed((1.0, 2.0, 4.0), (10.0, -10.0, 2.0))
    fine = np.linspace(0.0, 6.0, 600_001)
    values = 1000.0 * np.where(fine < 1.0, 0.0, np.interp(fine, (1.0, 2.0, 4.0), (10.0, -10.0, 2.0)))
    for start_s, step_s in ((0.0, 0.5), (0.5, 1.0), (1.2, 1.0), (1.5, 3.0), (4.5, 0.5)):
        rows = (fine >= start_s - 1e-9) & (fine <= start_s + step_s + 1e-9)
        within = values[rows]
        mean = 0.5 * (within[1:] + within[:-1]).mean()
        assert faces.mean_size(start_s, step_s) == pytest.approx(mean, abs=0.2)


def pressed(times_s, pressures_kpa, centre=(0.0, 0.0, 1.0), point=(-0.25, 0.0, 1.0), area_m2=2.0):
    """A pressure along x on one side of a block."""
    return PressedFaces(
        name="jack",
        centres_m=(centre,),
        points_m=(point,),
        normals=((-1.0, 0.0, 0.0),),
        areas_m2=(area_m2,),
        times_s=times_s,
        pressures_kpa=pressures_kpa,
    )


def test_a_wall_tips_when_the_pressure_has_the_moment_of_its_weight(blender, tmp_path):
    """p h · h / 2 = m g · b / 2 about its edge, by friction of 1: from 0 to twice that in a second."""
    blocks, mass_kg = Blocks(substeps_per_frame=20, solver_iterations=100), 2400.0
    ground, wall = blocks.block((0, 0, -0.5), size_m=(20, 20, 1)), blocks.block((0, 0, 1), mass_kg, (0.5, 1, 2))
    for body in (ground, wall):
        body.rigid_body.friction = 1.0
    tips_kpa = 1e-3 * mass_kg * STANDARD_GRAVITY_M_S2 * 0.5 / 2.0**2
    keep_tables(blocks.scene, "loads", [pressed((0.0, 1.0), (0.0, 2.0 * tips_kpa))])
    results = blocks.play(tmp_path, 24)
    moved_m = results.frames.positions_m[:, 1, 0]
    times = results.frames.time_s
    assert abs(moved_m[times <= 0.49]).max() < 1e-3
    # It turns about its edge: (4 / 3 of m r²) of a slab of b by h, with a moment that grows by m g b per second.
    inertia = mass_kg * (0.5**2 + 2.0**2) / 3.0
    at_s = 0.25
    turned_rad = mass_kg * STANDARD_GRAVITY_M_S2 * 0.5 * at_s**3 / 6.0 / inertia
    frame = int(np.argmin(abs(times - 0.75)))
    assert moved_m[frame] == pytest.approx(1.0 * turned_rad, rel=0.15)


@pytest.mark.parametrize("kpa", [30.0, -30.0])
def test_a_free_block_of_many_shards_gets_the_impulse_of_pressure_and_area(blender, tmp_path, kpa):
    """It falls meanwhile: m v = ∫ p A dt level, and the work is its kinetic energy of that."""
    solid, mass_kg = block((1.0, 1.0, 1.0), (0.0, 0.0, 30.0)), 2400.0
    keys = KEYS | {"times_s": (0.1, 0.2, 0.4), "pressures_kpa": (0.0, kpa, 0.0), "direction": (1.0, 0.0, 0.0)}
    free = replace(ELASTIC, foundation=False)
    scenario = of_solid(solid, tmp_path, keys, shards=5, connections=free, duration_s=0.5)
    scenario = replace(scenario, shards=ShardSettings(linear_damping=0.0, angular_damping=0.0))
    recording, results = played(blender, tmp_path, scenario)
    momentum = (results.inventory.masses_kg[:, None] * results.frames.velocities_m_s[-1])[
        results.inventory.of_kind("shard")
    ]
    impulse_ns = 1000.0 * kpa * 0.5 * 0.3
    assert momentum.sum(axis=0)[0] == pytest.approx(impulse_ns, rel=1e-3)
    (load,) = recording.loads.summary()
    assert load["name"] == "wind"
    assert load["impulse_Ns"] == pytest.approx([impulse_ns, 0.0, 0.0], rel=1e-3, abs=20.0)  # it turns a little
    assert load["largest_force_N"] == pytest.approx(1000.0 * abs(kpa), rel=0.02)
    assert load["work_J"] == pytest.approx(impulse_ns**2 / (2.0 * mass_kg), rel=0.02)
    assert np.nansum(results.frames.work.loads_j) == pytest.approx(load["work_J"], rel=0.02)


def played(blender, folder, scenario):
    build_demolition(blender.context.scene, scenario, checked_model(scenario))
    assert run_tables_of(blender.context.scene, "loads")[0].name == "wind"
    playing = Playing(Recording(blender.context.scene, folder))
    while not playing.finished:
        playing.step()
    playing.end()
    return playing.recording, playing.recording.results()


def test_a_column_bends_as_a_cantilever_under_even_pressure(blender, tmp_path):
    """w = p b L⁴ / (8 E I) at its top, and the shear p b L and the moment p b L² / 2 at its foot."""
    length_m, width_m, kpa = 10.0, 1.0, 20.0
    solid = block((width_m, width_m, length_m), (-0.5, -0.5, 0.0))
    keys = KEYS | {"direction": (1.0, 0.0, 0.0), "times_s": (0.0, 1.0), "pressures_kpa": (0.0, kpa)}
    points = tuple(FracturePoint(position_m=(0.0, 0.0, 0.5 + slice_m)) for slice_m in range(10))
    cut = FractureSettings(shards=10, points=points)
    scenario = of_solid(solid, tmp_path, keys, fracture=cut, duration_s=1.5)
    _, results = played(blender, tmp_path, scenario)
    shards = results.inventory.of_kind("shard")
    top = shards[results.frames.positions_m[0, shards, 2].argmax()]
    moved_m = (results.frames.positions_m[:, top, 0] - results.frames.positions_m[0, top, 0])[-6:].mean()
    height_m = results.frames.positions_m[0, top, 2]
    load, stiffness = 1000.0 * kpa * width_m, 30e9 / 12.0
    x = height_m
    expected_m = load * x**2 * (x**2 - 4.0 * length_m * x + 6.0 * length_m**2) / (24.0 * stiffness)
    assert moved_m == pytest.approx(expected_m, rel=0.03)
