# SPDX-License-Identifier: GPL-3.0-or-later
"""What ParaView is given, read by meshio."""

import csv
from xml.etree import ElementTree

import meshio
import numpy as np
import pytest
from support.exported_runs import SMALLEST_M, corners_m, in_order, turning_run, with_ground
from support.sample_results import hanging_chain, with_contacts

from bridge_demolition_addon.cli.progress import Silence
from bridge_demolition_addon.exports.paraview import WITHOUT_CONTACTS, write_paraview
from bridge_demolition_addon.model.results.energy import energy_of


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """The folder, and what is in it."""
    folder, results = tmp_path_factory.mktemp("paraview"), with_ground(turning_run())
    write_paraview(results, folder, Silence())
    return folder, results


def series(folder, name):
    """Times and meshes of a series."""
    times, files = files_of_series(folder, name)
    return times, [meshio.read(file) for file in files]


def files_of_series(folder, name):
    """Its times and files."""
    sets = ElementTree.parse(folder / f"{name}.pvd").findall("./Collection/DataSet")
    return [float(part.get("timestep")) for part in sets], [folder / part.get("file") for part in sets]


def of_cells(mesh, name):
    """The values of cells that are all of one type."""
    (values,) = mesh.cell_data[name]
    return values


def test_a_series_has_every_frame_at_its_time(written):
    folder, results = written
    for name in ("bodies", "centres", "connections"):
        times, meshes = series(folder, name)
        assert times == results.frames.time_s.tolist()
        assert len(meshes) == len(results.frames)


def test_corners_of_all_bodies_are_where_they_were_in_every_frame(written):
    folder, results = written
    for row, mesh in enumerate(series(folder, "bodies")[1]):
        (cells,) = mesh.cells
        bodies = of_cells(mesh, "body")
        for body in range(len(results.inventory.body_names)):
            found = mesh.points[np.unique(cells.data[bodies == body])]
            assert in_order(found) == pytest.approx(in_order(corners_m(results, row, body)), abs=SMALLEST_M)


def test_surfaces_enclose_the_volumes_of_their_bodies(written):
    folder, results = written
    mesh = series(folder, "bodies")[1][-1]
    (cells,) = mesh.cells
    corners = mesh.points[cells.data]
    sixths = np.einsum("ti,ti->t", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6.0
    volumes = np.bincount(of_cells(mesh, "body"), sixths)
    assert volumes[:-1] == pytest.approx(results.inventory.volumes_m3[:-1], rel=1e-5)  # recorded with seven digits


def test_ground_that_is_not_flat_has_its_own_triangles(written):
    folder, results = written
    mesh = series(folder, "bodies")[1][0]
    (cells,) = mesh.cells
    corners = mesh.points[cells.data[of_cells(mesh, "body") == len(results.inventory.body_names) - 1]]
    doubled = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert len(corners) == 2
    assert doubled[:, 2].sum() / 2.0 == pytest.approx(90.0 * 65.0)


def test_centres_are_to_the_bit_what_was_recorded(written):
    folder, results = written
    for row, mesh in enumerate(series(folder, "centres")[1]):
        assert (mesh.points == results.frames.positions_m[row]).all()
        assert of_cells(mesh, "velocity_m_s") == pytest.approx(results.frames.velocities_m_s[row])


def test_connections_move_with_their_first_bodies(written):
    folder, results = written
    frames, inventory = results.frames, results.inventory
    for row, mesh in enumerate(series(folder, "connections")[1]):
        for connection, (first, _) in enumerate(inventory.pairs):
            start, now = frames.rotations[0, first].astype(float), frames.rotations[row, first].astype(float)
            arm = now @ np.linalg.inv(start) @ (inventory.points_m[connection] - frames.positions_m[0, first])
            # Matrices in single precision are no rotations to the last digit: 1e-7 of an arm of some 10 m.
            assert mesh.points[connection] == pytest.approx(frames.positions_m[row, first] + arm, abs=1e-5)
        assert (of_cells(mesh, "intact") == frames.intact[row]).all()


def test_loads_speeds_and_connections_are_those_of_the_hanging_chain(tmp_path):
    write_paraview(hanging_chain(), tmp_path, Silence())
    times, meshes = series(tmp_path, "centres")
    upper, lower, ball = 1, 2, 3
    # The ball of 1000 kg has fallen for two frames of 0.04 s; the chain hangs at rest.
    speed = 9.80665 * 2 * 0.04
    assert times[3] == pytest.approx(0.12)
    assert of_cells(meshes[3], "speed_m_s")[ball] == pytest.approx(speed)
    assert of_cells(meshes[3], "kinetic_energy_j")[ball] == pytest.approx(1000.0 * speed**2 / 2)
    assert of_cells(meshes[3], "kinetic_energy_j")[[upper, lower]].tolist() == [0.0, 0.0]
    # 200 kg hang from a section of 0.5 m²; by the last frame that connection has broken.
    connections = series(tmp_path, "connections")[1]
    assert of_cells(connections[1], "peak_force_n")[1] == pytest.approx(200.0 * 9.80665, rel=1e-6)
    assert of_cells(connections[3], "intact").tolist() == [1, 1]
    assert of_cells(connections[4], "intact").tolist() == [1, 0]
    assert of_cells(meshes[3], "intact_connections").tolist() == [1, 2, 1, 0]
    assert of_cells(meshes[4], "intact_connections").tolist() == [1, 1, 0, 0]


def test_contacts_are_points_with_their_bodies_and_impulses(tmp_path):
    write_paraview(with_contacts(hanging_chain()), tmp_path, Silence())
    times, files = files_of_series(tmp_path, "contacts")
    assert times == pytest.approx(0.04 * np.arange(5))
    pieces = [ElementTree.parse(file).find("./UnstructuredGrid/Piece") for file in files]
    assert [piece.get("NumberOfPoints") for piece in pieces] == ["0", "1", "0", "0", "3"]
    assert [piece.get("NumberOfCells") for piece in pieces] == ["0", "1", "0", "0", "3"]
    assert len(meshio.read(files[1]).points) == 1  # it reads no files without any cells
    last = meshio.read(files[-1])
    assert last.points.tolist() == [[3, 4, 5], [6, 7, 8], [9, 10, 11]]
    assert of_cells(last, "first_body").tolist() == [1, 0, 0] and of_cells(last, "second_body").tolist() == [0, 1, 1]
    assert of_cells(last, "impulse_ns").tolist() == [[0, 4, 3], [3, 0, -4], [0.5, 0, 0]]
    assert of_cells(last, "impulse_magnitude_ns").tolist() == [5, 5, 0.5]  # 3, 4 and 5


class Listening(Silence):
    """Keeps what is said."""

    def __init__(self):
        self.said = []

    def stage(self, text):
        self.said.append(text)


def test_a_run_that_recorded_no_contacts_says_how_to_get_them(tmp_path):
    listening = Listening()
    write_paraview(hanging_chain(), tmp_path, listening)
    assert WITHOUT_CONTACTS in listening.said and "contacts = true under [recording]" in WITHOUT_CONTACTS
    assert not (tmp_path / "contacts.pvd").exists()


def test_energies_of_bodies_add_up_to_that_of_the_run(written):
    folder, results = written
    totals = [of_cells(mesh, "kinetic_energy_j").sum() for mesh in series(folder, "centres")[1]]
    assert totals == pytest.approx(energy_of(results).kinetic_j, rel=1e-5)  # written in single precision


def test_what_numbers_stand_for_is_in_tables(written):
    folder, results = written
    with (folder / "bodies.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["name"] for row in rows] == results.inventory.body_names.tolist()
    members = {row["member"]: row["member_name"] for row in rows}
    assert members == {"0": "deck", "1": "pier 1", "-1": ""}
    mesh = series(folder, "centres")[1][0]
    assert of_cells(mesh, "member").tolist() == [int(row["member"]) for row in rows]
