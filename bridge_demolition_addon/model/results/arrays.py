"""Everything a run recorded, the files that keep it, and the digests that tell whether two runs are the same.

One holds what was built, one how everything moved and broke, and one the whole results. Where the first differs,
something else was simulated. Where only the others do, Blender's own arithmetic differs.
"""

from __future__ import annotations

import hashlib
import zipfile
import zlib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import Field, dataclass, fields, is_dataclass
from pathlib import Path
from typing import Any, ClassVar, Protocol, TypeVar

import numpy as np

from ...engineering.geometry.mesh import TriangleMesh
from ...engineering.geometry.vectors import transformed
from ...engineering.mechanics.frame_loads import FrameLoads
from ...engineering.mechanics.work import FrameWork
from ...engineering.terrain.surface import NamedSurface, RecordedGround, Surface
from ...errors import OutputError, UnreadableError
from ...system.array_files.archive import blocks_of, read_archive, write_archive
from ...system.array_files.table import stored_rows
from ...system.reading import check_file
from .checks import check_arrays
from .frames import BallHistory, ContactHistory, Frame, FrameSeries, Inventory

RESULTS_FILE = "results.npz"
FRAMES_FILE, BALLS_FILE, INVENTORY_FILE = "results_frames.npy", "results_balls.npy", "results_inventory.npz"
CONTACTS_FILE = "results_contacts.npy"
LEFT_FILES = (FRAMES_FILE, BALLS_FILE, CONTACTS_FILE, INVENTORY_FILE)
"""Files that grow during a run. They are deleted once the results are whole; a run that is killed leaves them."""


class _Dataclass(Protocol):
    __dataclass_fields__: ClassVar[dict[str, Field[Any]]]


_Part = TypeVar("_Part", bound=_Dataclass)

_OF_FRAMES = {
    "number": "frames",
    "time_s": "times_s",
    "positions_m": "places_m",
    "angular_velocities_rad_s": "spins_rad_s",
}

_STORED_NAMES = {
    Frame: _OF_FRAMES,
    FrameSeries: _OF_FRAMES,
    FrameWork: {
        "gravity_j": "work_of_gravity_j",
        "loads_j": "work_of_loads_j",
        "tools_j": "work_of_tools_j",
        "damping_j": "lost_to_damping_j",
        "dissipated_j": "dissipated_between_bodies_j",
        "yielding_j": "dissipated_by_bars_j",
        "crack_friction_j": "dissipated_by_crack_friction_j",
        "made_j": "made_by_solver_j",
    },
    BallHistory: {
        "bodies": "balls",
        "times_s": "ball_times_s",
        "impulses_ns": "ball_impulses_ns",
        "velocities_m_s": "ball_velocities_m_s",
    },
    ContactHistory: {
        "frames": "contact_frames",
        "bodies": "contact_bodies",
        "places_m": "contact_places_m",
        "normals": "contact_normals",
        "normal_impulses_ns": "contact_normal_impulses_ns",
        "friction_impulses_ns": "contact_friction_impulses_ns",
    },
}
"""What arrays are called in the files, where not as here. Files of earlier versions have these names."""

_LATER_WORK = ("yielding_j", "crack_friction_j")
"""Work that earlier versions did not record."""

_UNREADABLE = (
    OutputError,
    UnreadableError,
    AttributeError,
    EOFError,
    KeyError,
    MemoryError,
    NotImplementedError,
    OSError,
    RuntimeError,
    TypeError,
    ValueError,
    zipfile.BadZipFile,
    zlib.error,
)
"""What the archive's reader raises for a file that is damaged, encrypted, or says that it holds more than there is."""


@dataclass(frozen=True, slots=True, eq=False)
class Results:
    """A run: bodies and connections, motion and loads, hits of the balls.

    Where `load_sampling` is ``every sub-step``, loads cover the whole frame, otherwise its last sub-step. `contacts`
    are those in the last sub-step of each frame; None where they were not recorded.
    """

    load_sampling: str
    inventory: Inventory
    frames: FrameSeries
    balls: BallHistory
    contacts: ContactHistory | None = None

    @classmethod
    def of_arrays(cls, arrays: Mapping[str, np.ndarray]) -> Results:
        """Return the results in arrays by their names in the files."""
        parts = _part(Inventory, arrays), frames_of(arrays), balls_of(arrays), contacts_of(arrays)
        return cls(str(arrays["reading"]), *parts)

    def arrays(self) -> dict[str, np.ndarray]:
        """Return all arrays by their names in the files."""
        return dict(named_arrays(self))

    def ground(self) -> RecordedGround:
        """Return the ground that the run was on, as it lay at first."""
        inventory, terrain, surfaces = self.inventory, None, []
        for body in inventory.of_kind("ground"):
            triangles = inventory.triangles_of(body)
            if not len(triangles):
                continue
            turned = transformed(self.frames.rotations[0, body], inventory.vertices_of(body))
            surface = Surface(TriangleMesh(turned + self.frames.positions_m[0, body], triangles))
            if name := str(inventory.body_members[body]):
                surfaces.append(NamedSurface(name, str(inventory.body_member_kinds[body]), surface))
            else:
                terrain = surface
        return RecordedGround(terrain, tuple(surfaces))

    def save(self, path: Path) -> None:
        """Write all arrays into one file that `numpy.load` and `load_results` read."""
        arrays = self.arrays()
        known = dict(named_arrays(self.inventory))
        # What has one bit in a byte, and what everybody needs as a whole. A frame is read from all else without it.
        packed = {name for name, values in arrays.items() if name in known or np.asarray(values).dtype.kind == "b"}
        write_archive(path, arrays, packed)


_STORED_NAMES[Results] = {"load_sampling": "reading"}


def load_results(path: Path) -> Results:
    """Read what `Results.save` wrote, or the frames of a run that was killed, by its file or the folder of the run.

    Large arrays are mapped from copies: they are read as far as needed, and stay as they are when the files change.

    Raises
    ------
    OutputError
        The file is missing or was not written by a run.
    """
    path = results_in(path) if path.is_dir() else path
    try:
        check_file(path)
        arrays = _left_arrays(path) if path.name == FRAMES_FILE else read_archive(path)
        check_arrays(arrays)
        return Results.of_arrays(arrays)
    except _UNREADABLE as error:
        raise OutputError(f"{path}: expected the results of a run ({error})") from error


def results_in(folder: Path) -> Path:
    """Return the file in the folder of a run that its results are read from: a whole run's, if there is one."""
    left = folder / FRAMES_FILE
    return left if left.exists() and not (folder / RESULTS_FILE).exists() else folder / RESULTS_FILE


def named_arrays(part: Any) -> Iterator[tuple[str, np.ndarray]]:
    """Yield the arrays of a dataclass and of those in it, by their names in the files; None is left out."""
    for field in fields(part):
        value = getattr(part, field.name)
        if is_dataclass(value):
            yield from named_arrays(value)
        elif value is not None:
            yield _stored_name(type(part), field.name), value


def frames_of(arrays: Mapping[str, np.ndarray]) -> FrameSeries:
    """Return the frames in arrays by their names in the files."""
    return _part(FrameSeries, arrays, loads=_part(FrameLoads, arrays), work=_work(arrays))


def balls_of(arrays: Mapping[str, np.ndarray]) -> BallHistory:
    """Return the history of the balls in arrays by their names in the files."""
    return _part(BallHistory, arrays)


def contacts_of(arrays: Mapping[str, np.ndarray]) -> ContactHistory | None:
    """Return the contacts in arrays by their names in the files; None where they were not recorded."""
    return _part(ContactHistory, arrays) if "contact_frames" in arrays else None


def contacts_until(rows: np.ndarray, frame: int) -> ContactHistory:
    """Return the contacts in rows of a table up to one of Blender's frames: later ones have no whole frame."""
    until = np.searchsorted(rows["contact_frames"], frame, side="right")
    return _part(ContactHistory, columns(rows[:until]))


def columns(rows: np.ndarray) -> dict[str, np.ndarray]:
    """Return the arrays (k, …) of rows (k,) by their names."""
    return {name: rows[name] for name in rows.dtype.names or ()}


def _left_arrays(path: Path) -> dict[str, np.ndarray]:
    """Return the arrays that a run was writing; of sub-steps and contacts, arrays of whole frames."""
    frames, inventory, balls = stored_rows(path), path.with_name(INVENTORY_FILE), path.with_name(BALLS_FILE)
    check_file(inventory)
    arrays = read_archive(inventory) | columns(frames) | _left_contacts(path.with_name(CONTACTS_FILE), frames)
    if not balls.exists():
        return arrays | dict(named_arrays(BallHistory.unknown()))
    check_file(balls)
    substeps = stored_rows(balls)
    if not len(substeps):
        return arrays | dict(named_arrays(BallHistory.unknown()))
    end_s = frames["times_s"][-1] if len(frames) else 0.0
    return arrays | columns(substeps[: np.searchsorted(substeps["ball_times_s"], end_s, side="right")])


def _left_contacts(path: Path, frames: np.ndarray) -> dict[str, np.ndarray]:
    if not path.exists() or not len(frames):
        return {}
    check_file(path)
    return dict(named_arrays(contacts_until(stored_rows(path), frames["frames"][-1])))


def _part(kind: type[_Part], arrays: Mapping[str, np.ndarray], **known: Any) -> _Part:
    """Return a part of the results, with the fields that are known already; arrays that may be None may be missing."""
    missing = {
        field.name for field in fields(kind) if field.default is None and _stored_name(kind, field.name) not in arrays
    }
    names = [field.name for field in fields(kind) if field.name not in known.keys() | missing]
    return kind(**{name: arrays[_stored_name(kind, name)] for name in names}, **known)


def _work(arrays: Mapping[str, np.ndarray]) -> FrameWork:
    """Return the work; earlier versions did not record every part."""
    unknown = FrameWork.unknown(*arrays["places_m"].shape[:2])
    if _STORED_NAMES[FrameWork]["made_j"] not in arrays:
        return unknown
    missing = [name for name in _LATER_WORK if _stored_name(FrameWork, name) not in arrays]
    return _part(FrameWork, arrays, **{name: getattr(unknown, name) for name in missing})


def _stored_name(kind: type, name: str) -> str:
    return _STORED_NAMES.get(kind, {}).get(name, name)


SHORT = 8
"""Digits of a digest that are enough to tell runs apart by eye."""

_OF_BARS = ("dissipated_by_bars_j", "dissipated_by_crack_friction_j", "connection_bars")
"""Arrays that say something of runs with bars alone; the others have the digests that they had before these."""

_KEPT_AS = {"i": np.dtype("<i8"), "u": np.dtype("<i8"), "f": np.dtype("<f8")}
"""One width on every system, by the kind of number: numpy's default integers had 32 bits on Windows before numpy 2."""


def digest(parts: Mapping[str, Any]) -> str:
    """Return the SHA-256 of named arrays, numbers and texts, as hexadecimal digits; their order does not count."""
    sha = hashlib.sha256()
    for name in sorted(parts):
        values = np.asarray(parts[name])
        if values.dtype.kind == "U":
            text = "\0".join(values.ravel().tolist()).encode()
            contents: Iterable[bytes] = [text]
            size = len(text)
        else:
            kept = _KEPT_AS.get(values.dtype.kind, np.dtype("u1"))
            contents = (block.astype(kept).tobytes() for block in blocks_of(values))
            size = values.size * kept.itemsize
        sha.update(f"{name}:{values.shape}:{size}:".encode())
        for content in contents:
            sha.update(content)
    return sha.hexdigest()


def known_parts(record: Any) -> dict[str, Any]:
    """Return the fields of a dataclass that are not None, by name."""
    parts = {item.name: getattr(record, item.name) for item in fields(record)}
    return {name: values for name, values in parts.items() if values is not None}


def motion_digest(results: Results) -> str:
    """Return the digest of how all bodies moved, what broke and what exploded: all of frames but loads and work.

    It is the same whether loads were recorded or not.
    """
    parts = {field.name: getattr(results.frames, field.name) for field in fields(results.frames)}
    return digest({name: part for name, part in parts.items() if not is_dataclass(part)})


def result_digest(results: Results) -> str:
    """Return the digest of everything that was recorded."""
    return digest({name: values for name, values in results.arrays().items() if _counts(name, values)})


def _counts(name: str, values: np.ndarray) -> bool:
    return name not in _OF_BARS or bool(np.nan_to_num(values).any())
