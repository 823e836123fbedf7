# SPDX-License-Identifier: GPL-3.0-or-later
"""The animated model of a run, read by trimesh, by the words of the specification, and by Blender."""

import json

import numpy as np
import pytest
import trimesh
from support.exported_runs import SMALLEST_M, corners_m, in_order, turning_run, with_ground

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.exports.gltf import animated_glb, write_gltf

TO_Y_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """The file, and the run that it is of."""
    results = with_ground(turning_run())
    path = tmp_path_factory.mktemp("gltf") / "run.glb"
    write_gltf(results, path, Silence())
    return path, results


def read(path):
    """The description in a GLB file and its accessors' values, as section 4.4 of the specification of glTF 2.0 says."""
    content = path.read_bytes()
    version, length, text_length = np.frombuffer(content[4:16], "<u4")
    assert (content[:4], version, length) == (b"glTF", 2, len(content))
    assert content[16:20] == b"JSON"
    described = json.loads(content[20 : 20 + text_length])
    binary = content[28 + text_length :]
    widths = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}

    def values(number):
        accessor = described["accessors"][number]
        view = described["bufferViews"][accessor["bufferView"]]
        kind = {5126: "<f4", 5125: "<u4"}[accessor["componentType"]]
        part = binary[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
        return np.frombuffer(part, kind).reshape(accessor["count"], widths[accessor["type"]])

    return described, values


def motions(path):
    """Times, places and quaternions (x, y, z, w) of the nodes that move, by name."""
    described, values = read(path)
    (animation,) = described["animations"]
    found = {}
    for channel in animation["channels"]:
        sampler = animation["samplers"][channel["sampler"]]
        assert sampler["interpolation"] == "LINEAR"
        name = described["nodes"][channel["target"]["node"]]["name"]
        found.setdefault(name, {})[channel["target"]["path"]] = values(sampler["output"])
        found[name]["time"] = values(sampler["input"])[:, 0]
    return found


def test_every_body_is_at_first_where_trimesh_finds_it(written):
    path, results = written
    scene = trimesh.load_scene(path)
    for body, name in enumerate(results.inventory.body_names):
        matrix, geometry = scene.graph[name]
        found = trimesh.transform_points(scene.geometry[geometry].vertices, matrix)
        expected = corners_m(results, 0, body) @ TO_Y_UP.T
        # Single precision of a vertex 50 m from the origin is 4e-6 m, half of which is lost at most, and once turned.
        assert in_order(np.unique(found, axis=0)) == pytest.approx(in_order(expected), abs=4e-6)


def test_places_of_all_bodies_in_every_frame_are_to_the_bit_those_recorded(written):
    path, results = written
    moving, frames = motions(path), results.frames
    times = (frames.time_s - frames.time_s[0]).astype(np.float32)
    for body, name in enumerate(results.inventory.body_names[:-1]):
        assert (moving[name]["time"] == times).all()
        assert (moving[name]["translation"] == frames.positions_m[:, body]).all()


def test_all_bodies_are_turned_in_every_frame_as_they_were(written):
    path, results = written
    moving, frames = motions(path), results.frames
    for body, name in enumerate(results.inventory.body_names[:-1]):
        x, y, z, w = moving[name]["rotation"].astype(float).T
        # The matrix of a unit quaternion, glTF 2.0 specification, appendix on animations; Shoemake 1985.
        rows = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
        turned = np.moveaxis(np.array(rows), -1, 0)
        assert turned == pytest.approx(frames.rotations[:, body], abs=SMALLEST_M)


def test_turns_go_the_short_way_from_key_to_key(written):
    for motion in motions(written[0]).values():
        assert ((motion["rotation"][1:] * motion["rotation"][:-1]).sum(axis=1) > 0.0).all()


def test_what_does_not_move_has_no_keys_and_what_rests_has_two(tmp_path):
    results = turning_run(frames=8)
    frames = results.frames
    frames.positions_m[3:, 0], frames.rotations[3:, 0] = frames.positions_m[3, 0], frames.rotations[3, 0]
    frames.positions_m[:, 1], frames.rotations[:, 1] = frames.positions_m[0, 1], frames.rotations[0, 1]
    write_gltf(results, tmp_path / "run.glb", Silence())
    moving, times = motions(tmp_path / "run.glb"), frames.time_s.astype(np.float32)
    assert moving["Shard 00000"]["time"].tolist() == times[[0, 1, 2, 3, 7]].tolist()
    assert "Shard 00001" not in moving


def test_limits_of_places_and_times_are_stated_as_the_specification_wants(written):
    described, values = read(written[0])
    samplers = described["animations"][0]["samplers"]
    stated = {sampler["input"] for sampler in samplers}
    stated |= {mesh["primitives"][0]["attributes"]["POSITION"] for mesh in described["meshes"]}
    for number in stated:
        accessor = described["accessors"][number]
        assert accessor["min"] == values(number).min(axis=0).tolist()
        assert accessor["max"] == values(number).max(axis=0).tolist()


def test_a_run_in_which_nothing_moves_has_no_animation(tmp_path):
    results = turning_run(frames=1)
    (tmp_path / "run.glb").write_bytes(animated_glb(results))
    assert "animations" not in read(tmp_path / "run.glb")[0]
    assert len(trimesh.load_scene(tmp_path / "run.glb").geometry) == len(results.inventory.body_names)


def test_blender_shows_the_bodies_where_they_were(written, blender):
    path, results = written
    scene, frames = blender.context.scene, results.frames
    blender.ops.import_scene.gltf(filepath=str(path))
    per_s = scene.render.fps / scene.render.fps_base
    for row in (0, 5, len(frames) - 1):
        at = (frames.time_s[row] - frames.time_s[0]) * per_s
        scene.frame_set(int(at), subframe=float(at - int(at)))
        for body in (0, 3, 5):
            shown = blender.data.objects[results.inventory.body_names[body]]
            corners = np.array([shown.matrix_world @ vertex.co for vertex in shown.data.vertices])
            # Blender's own matrices are in single precision, at places 15 m from the origin, after three turns.
            assert in_order(np.unique(corners, axis=0)) == pytest.approx(
                in_order(corners_m(results, row, body)), abs=2e-5
            )
