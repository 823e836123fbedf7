"""A run as series for ParaView: the bodies' surfaces, their centres, their connections and their contacts."""

from __future__ import annotations

import csv
import zlib
from base64 import b64encode
from collections.abc import Callable, Iterable, Mapping, Sequence
from math import prod
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import numpy as np

from ..engineering.geometry.vectors import carried_points, length
from ..model.results.arrays import Results
from ..model.results.energy import kinetic_energies, moments_of_inertia
from ..model.results.frames import ContactHistory, Frame
from ..system.progress import Progress
from .shapes import ConnectionPositions, body_meshes

POINT, TRIANGLE = 1, 5
"""Types of cells."""

_TYPES = {"f4": "Float32", "f8": "Float64", "i4": "Int32", "i8": "Int64", "u1": "UInt8"}
_FAST = 1
"""Level of zlib: higher ones take several times as long for a tenth less."""

_VTKS_BLOCK = 32768
"""Bytes of a block as VTK writes it, which its files name also where there is none."""

_HEAD = '<?xml version="1.0"?>\n<VTKFile type="{}" version="1.0" byte_order="LittleEndian" header_type="UInt64"{}>\n'


class Topology:
    """The cells of a mesh by their points (c, v), all of one type, encoded once for many files."""

    def __init__(self, cells: np.ndarray, cell_type: int):
        count, corners = cells.shape
        self.count = count
        self.text = "".join(
            (
                "<Cells>\n",
                data_array("connectivity", cells.ravel().astype(np.int64)),
                data_array("offsets", np.arange(1, count + 1, dtype=np.int64) * corners),
                data_array("types", np.full(count, cell_type, np.uint8)),
                "</Cells>\n",
            )
        )


def write_vtu(
    path: Path,
    topology: Topology,
    points_m: np.ndarray,
    cell_data: Mapping[str, np.ndarray],
    encoded: Iterable[str] = (),
) -> None:
    """Write one mesh: points (p, 3), in double precision, and arrays (c, …) of its cells by name.

    `encoded` are further arrays of cells, as `data_array` gives them.
    """
    with path.open("w", encoding="ascii", newline="\n") as file:
        file.write(_HEAD.format("UnstructuredGrid", ' compressor="vtkZLibDataCompressor"'))
        file.write(f'<UnstructuredGrid>\n<Piece NumberOfPoints="{len(points_m)}" NumberOfCells="{topology.count}">\n')
        file.write(f"<Points>\n{data_array('Points', points_m.astype(float))}</Points>\n{topology.text}<CellData>\n")
        file.writelines(encoded)
        file.writelines(data_array(name, values) for name, values in cell_data.items())
        file.write("</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n")


def write_series(path: Path, times_s: Iterable[float], files: Iterable[str]) -> None:
    """Write a collection: the file, relative to its own folder, of each time."""
    lines = (
        f'<DataSet timestep="{float(time)!r}" part="0" file={quoteattr(file)}/>\n'
        for time, file in zip(times_s, files, strict=True)
    )
    text = _HEAD.format("Collection", "") + f"<Collection>\n{''.join(lines)}</Collection>\n</VTKFile>\n"
    path.write_text(text, encoding="utf-8", newline="\n")


def data_array(name: str, values: np.ndarray) -> str:
    """Return an array (c, …) as an element of such a file."""
    kind = values.dtype.newbyteorder("<")
    content = np.ascontiguousarray(values, kind).tobytes()
    packed = zlib.compress(content, _FAST) if content else b""
    # One block, none of them cut short; or none, as VTK itself writes it.
    sizes = np.array([1, len(content), 0, len(packed)] if content else [0, _VTKS_BLOCK, 0], "<u8").tobytes()
    components = f' NumberOfComponents="{prod(values.shape[1:])}"' if values.ndim > 1 else ""
    return (
        f'<DataArray type="{_TYPES[kind.str[1:]]}" Name={quoteattr(name)}{components} format="binary">'
        f"{b64encode(sizes).decode()}{b64encode(packed).decode()}</DataArray>\n"
    )


FRAME_FOLDER = "frames"
BODIES, CENTRES, CONNECTIONS, CONTACTS = "bodies", "centres", "connections", "contacts"
"""Names of the series, and of the tables of names."""

WITHOUT_CONTACTS = (
    f"no {CONTACTS}.pvd, as the run did not record where bodies touched: put contacts = true under [recording] in its "
    "scenario, and run it again"
)

_Writer = Callable[[Path, Frame], None]


def write_paraview(results: Results, folder: Path, progress: Progress) -> None:
    """Write a run into an empty folder."""
    progress.stage(f"writing {len(results.frames)} frames for ParaView")
    (folder / FRAME_FOLDER).mkdir()
    writers: dict[str, _Writer] = {BODIES: _Surfaces(results).write, CENTRES: _Centres(results).write}
    if len(results.inventory.pairs):
        writers[CONNECTIONS] = _Connections(results).write
    if results.contacts is None:
        progress.stage(WITHOUT_CONTACTS)
    else:
        writers[CONTACTS] = _Contacts(results.contacts).write
    files: dict[str, list[str]] = {name: [] for name in writers}
    for row in range(len(results.frames)):
        frame = results.frames[row]
        for name, write in writers.items():
            files[name].append(f"{FRAME_FOLDER}/{name}_{int(frame.number):05d}.vtu")
            write(folder / files[name][-1], frame)
        progress.part(row + 1, len(results.frames), "frames written")
    for name, written in files.items():
        write_series(folder / f"{name}.pvd", results.frames.time_s, written)
    _write_names(results, folder)


class _Quantities:
    """What is known of each body in a frame."""

    def __init__(self, results: Results):
        inventory = results.inventory
        self._masses_kg, self._moments_kg_m2 = inventory.masses_kg, moments_of_inertia(results)
        self._pairs, self._count = inventory.pairs, len(inventory.body_names)
        self.members = _member_numbers(inventory.body_members)

    def of(self, frame: Frame) -> dict[str, np.ndarray]:
        """Return arrays (n,) by name."""
        energies = kinetic_energies(frame, self._masses_kg, self._moments_kg_m2)
        loads = frame.loads
        return {
            "force_n": _single(length(loads.body_forces_n)),
            "peak_force_n": _single(loads.body_peaks_n),
            "von_mises_pa": _single(loads.von_mises_pa),
            "speed_m_s": _single(length(frame.velocities_m_s)),
            "kinetic_energy_j": _single(energies),
            "intact_connections": self._counted(frame.intact),
            "asleep": frame.asleep.astype(np.uint8),
        }

    def _counted(self, intact: np.ndarray) -> np.ndarray:
        ends = self._pairs[intact].ravel()
        return np.bincount(ends[ends >= 0], minlength=self._count).astype(np.int32)


class _Surfaces:
    """The bodies' triangles; what is known of a body is known of each of its triangles."""

    def __init__(self, results: Results):
        meshes = body_meshes(results.inventory)
        counts = [len(mesh.vertices) for mesh in meshes]
        starts = np.concatenate([[0], np.cumsum(counts)[:-1]])
        triangles = [mesh.triangles + start for mesh, start in zip(meshes, starts, strict=True)]
        self._topology = Topology(np.concatenate(triangles), TRIANGLE)
        self._vertices_m = np.concatenate([mesh.vertices for mesh in meshes])
        self._of_vertices = np.repeat(np.arange(len(meshes)), counts)
        self._of_cells = np.repeat(np.arange(len(meshes)), [len(mesh.triangles) for mesh in meshes])
        self._quantities = _Quantities(results)
        members = self._quantities.members[self._of_cells]
        self._fixed = (data_array("body", self._of_cells.astype(np.int32)), data_array("member", members))

    def write(self, path: Path, frame: Frame) -> None:
        """Write a frame."""
        bodies = self._of_vertices
        turns = frame.rotations.astype(float)[bodies]
        points_m = carried_points(self._vertices_m, frame.positions_m.astype(float)[bodies], turns)
        cells = {name: values[self._of_cells] for name, values in self._quantities.of(frame).items()}
        write_vtu(path, self._topology, points_m, cells, self._fixed)


class _Centres:
    """A point at the centre of mass of each body, also for vectors, such as the impulse of its contacts."""

    def __init__(self, results: Results):
        count = len(results.inventory.body_names)
        self._topology = Topology(np.arange(count)[:, None], POINT)
        self._quantities = _Quantities(results)
        self._fixed = (
            data_array("body", np.arange(count, dtype=np.int32)),
            data_array("member", self._quantities.members),
            data_array("mass_kg", results.inventory.masses_kg.astype(float)),
        )

    def write(self, path: Path, frame: Frame) -> None:
        """Write a frame."""
        vectors = {
            "velocity_m_s": _single(frame.velocities_m_s),
            "angular_velocity_rad_s": _single(frame.angular_velocities_rad_s),
            "mean_force_n": _single(frame.loads.body_forces_n),
            "contact_impulse_ns": _single(frame.loads.body_contact_impulses_ns),
            "blast_impulse_ns": _single(frame.blast_impulses_ns),
            "stress_pa": _single(frame.loads.stresses_pa),
        }
        write_vtu(path, self._topology, frame.positions_m, self._quantities.of(frame) | vectors, self._fixed)


class _Connections:
    """A point for each connection, which moves with its first body, also when it has broken."""

    def __init__(self, results: Results):
        inventory = results.inventory
        count = len(inventory.pairs)
        self._topology = Topology(np.arange(count)[:, None], POINT)
        self._places = ConnectionPositions(results)
        first, second = inventory.pairs.T.astype(np.int32)
        self._fixed = (
            data_array("connection", np.arange(count, dtype=np.int32)),
            data_array("first_body", first),
            data_array("second_body", second),
            data_array("area_m2", inventory.areas_m2.astype(float)),
        )

    def write(self, path: Path, frame: Frame) -> None:
        """Write a frame."""
        loads = frame.loads
        known = {
            "intact": frame.intact.astype(np.uint8),
            "mean_force_n": _single(loads.connection_forces_n),
            "mean_moment_nm": _single(loads.connection_moments_nm),
            "peak_force_n": _single(loads.connection_peaks_n),
        }
        write_vtu(path, self._topology, self._places.at(frame), known, self._fixed)


class _Contacts:
    """A point for each contact in the last sub-step of a frame."""

    def __init__(self, contacts: ContactHistory):
        self._contacts = contacts

    def write(self, path: Path, frame: Frame) -> None:
        """Write a frame."""
        contacts = self._contacts.of_frame(int(frame.number))
        first, second = contacts.bodies.T.astype(np.int32)
        impulses_ns = contacts.impulses_ns
        known = {
            "first_body": first,
            "second_body": second,
            "normal": _single(contacts.normals),
            "impulse_ns": _single(impulses_ns),
            "impulse_magnitude_ns": _single(length(impulses_ns)),
            "normal_impulse_ns": _single(contacts.normal_impulses_ns),
            "friction_impulse_ns": _single(contacts.friction_impulses_ns),
        }
        write_vtu(path, Topology(np.arange(len(contacts))[:, None], POINT), contacts.places_m, known)


def _write_names(results: Results, folder: Path) -> None:
    """Write which body, member and connection each number stands for."""
    inventory = results.inventory
    bodies = {
        "body": np.arange(len(inventory.body_names)),
        "name": inventory.body_names,
        "kind": inventory.body_kinds,
        "member": _member_numbers(inventory.body_members),
        "member_name": inventory.body_members,
        "member_kind": inventory.body_member_kinds,
        "mass_kg": inventory.masses_kg,
        "volume_m3": inventory.volumes_m3,
    }
    _write_table(folder / f"{BODIES}.csv", bodies)
    if len(inventory.pairs):
        connections = {"connection": np.arange(len(inventory.pairs)), "name": inventory.connection_names}
        _write_table(folder / f"{CONNECTIONS}.csv", connections)


def _write_table(path: Path, columns: Mapping[str, np.ndarray]) -> None:
    rows: Iterable[Sequence[Any]] = zip(*(values.tolist() for values in columns.values()), strict=True)
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(rows)


def _member_numbers(names: np.ndarray) -> np.ndarray:
    """Return a number for the member of each body (n,), in alphabetical order; -1 for what is of none."""
    members = sorted(set(names.tolist()) - {""})
    number = {name: row for row, name in enumerate(members)}
    return np.array([number.get(name, -1) for name in names.tolist()], np.int32)


def _single(values: np.ndarray) -> np.ndarray:
    return np.asarray(values, np.float32)
