# SPDX-License-Identifier: GPL-3.0-or-later
"""Binary files of other programs are read in processes of their own: what ends these is said in one sentence."""

import sys

import numpy as np
import pytest
from support.terrain_files import write_tif

from bridge_demolition_addon.engineering.geometry.solids import box
from bridge_demolition_addon.errors import DemolitionError, UnreadableError
from bridge_demolition_addon.model.bridge.mesh_files import exported
from bridge_demolition_addon.model.mesh_reading import MESH_FILES, read_mesh
from bridge_demolition_addon.model.terrain.geotiff import read_geotiff
from bridge_demolition_addon.system import isolated

pytestmark = pytest.mark.slow

CRASHING = [sys.executable, "-c", "import os, signal; os.kill(os.getpid(), signal.SIGSEGV)"]


def mesh_file(tmp_path, suffix):
    path = tmp_path / f"box{suffix}"
    path.write_bytes(exported(box((1.0, 2.0, 3.0)), suffix))
    return path


@pytest.mark.slow
@pytest.mark.parametrize("suffix", MESH_FILES)
def test_a_mesh_is_read_as_it_is(suffix, tmp_path):
    mesh = read_mesh(mesh_file(tmp_path, suffix))
    assert mesh.volume == pytest.approx(6.0)
    assert np.ptp(mesh.vertices, axis=0) == pytest.approx((1.0, 2.0, 3.0))


@pytest.mark.parametrize("suffix", [suffix for suffix in MESH_FILES if suffix != ".obj"])
def test_a_reader_of_meshes_that_crashes_is_named(suffix, tmp_path, monkeypatch):
    path = mesh_file(tmp_path, suffix)
    monkeypatch.setattr(isolated, "program_command", lambda *_words, **_options: CRASHING)
    with pytest.raises(DemolitionError, match=rf"box\{suffix}: crashed its reader .*: it is damaged; export it again"):
        read_mesh(path)


def test_a_reader_of_heights_that_crashes_is_named(tmp_path, monkeypatch):
    path = write_tif(tmp_path / "heights.tif")
    monkeypatch.setattr(isolated, "program_command", lambda *_words, **_options: CRASHING)
    with pytest.raises(DemolitionError, match="crashed its reader"):
        read_geotiff(path, None, 1.0)


def test_a_reader_that_takes_too_long_is_ended(tmp_path):
    with pytest.raises(UnreadableError, match=r"took its reader longer than 0.01 s"):
        isolated.isolated("model.mesh_program", {"path": "x", "is_cloud": False, "kept": "y"}, 0.01)


def test_a_face_without_its_vertices_is_a_damaged_file(tmp_path):
    """A triangle of a binary PLY that names vertex 1000 of three."""
    head = (
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    )
    head += "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "<f4").tobytes()
    path = tmp_path / "triangle.ply"
    path.write_bytes(head.encode() + points + b"\x03" + np.array([0, 1, 1000], "<i4").tobytes())
    with pytest.raises(DemolitionError, match=r"triangle\.ply: (has faces with vertices|cannot be)"):
        read_mesh(path)
