"""Everything a run recorded, and the file that keeps it."""

from __future__ import annotations

import zipfile
import zlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields, is_dataclass
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from ..disk import whole_file
from ..errors import OutputError, UnreadableError
from ..mechanics.frame_loads import FrameLoads
from ..mechanics.work import FrameWork
from ..reading import check_file
from .checks import check_arrays
from .frames import BallHistory, FrameSeries
from .inventory import Inventory

_Part = TypeVar("_Part")

_STORED_NAMES = {
    FrameSeries: {
        "number": "frames",
        "time_s": "times_s",
        "positions_m": "places_m",
        "angular_velocities_rad_s": "spins_rad_s",
    },
    FrameWork: {
        "gravity_j": "work_of_gravity_j",
        "loads_j": "work_of_loads_j",
        "tools_j": "work_of_tools_j",
        "damping_j": "lost_to_damping_j",
        "dissipated_j": "dissipated_between_bodies_j",
        "made_j": "made_by_solver_j",
    },
    BallHistory: {
        "bodies": "balls",
        "times_s": "ball_times_s",
        "impulses_ns": "ball_impulses_ns",
        "velocities_m_s": "ball_velocities_m_s",
    },
}
"""What arrays are called in the file, where not as here. Files of earlier versions have these names."""


_UNREADABLE = (
    OutputError,
    UnreadableError,
    AttributeError,  # a single array instead of an archive of them
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
    """A run.

    Attributes
    ----------
    reading : str
        Which sub-steps the loads come from. ``every sub-step``: loads are those of the whole frame. Otherwise they are
        those of its last sub-step.
    inventory : Inventory
        Bodies and connections.
    frames : FrameSeries
        Motion and loads.
    balls : BallHistory
        Hits of the balls.
    """

    reading: str
    inventory: Inventory
    frames: FrameSeries
    balls: BallHistory

    @classmethod
    def of_arrays(cls, arrays: Mapping[str, np.ndarray]) -> Results:
        """Results from what `arrays` gives."""
        frames = _part(FrameSeries, arrays, loads=_part(FrameLoads, arrays), work=_work(arrays))
        return cls(str(arrays["reading"]), _part(Inventory, arrays), frames, _part(BallHistory, arrays))

    def arrays(self) -> dict[str, np.ndarray]:
        """All arrays by their names in the file."""
        return dict(_named_arrays(self))

    def save(self, path: Path) -> None:
        """Write all arrays into one file that `numpy.load` and `load_results` read."""
        # As numpy.savez does, which in some versions leaves it to Python to close an archive on a full disk.
        with whole_file(path) as part, zipfile.ZipFile(part, "w") as archive:
            for name, values in self.arrays().items():
                with archive.open(f"{name}.npy", "w", force_zip64=True) as file:
                    np.lib.format.write_array(file, np.asanyarray(values), allow_pickle=False)


def load_results(path: Path) -> Results:
    """Read what `Results.save` wrote.

    Raises
    ------
    OutputError
        The file is missing or was not written by a run.
    """
    try:
        check_file(path)
        with np.load(path, allow_pickle=False) as stored:
            arrays = dict(stored)
        check_arrays(arrays)
        return Results.of_arrays(arrays)
    except _UNREADABLE as error:
        raise OutputError(f"{path}: expected the results of a run ({error})") from error


def _named_arrays(part: Any) -> Iterator[tuple[str, np.ndarray]]:
    """Arrays of a dataclass and of those in it, by their names in the file."""
    for each in fields(part):
        value = getattr(part, each.name)
        if is_dataclass(value):
            yield from _named_arrays(value)
        else:
            yield _stored_name(type(part), each.name), value


def _part(kind: type[_Part], arrays: Mapping[str, np.ndarray], **known: Any) -> _Part:
    """A part of the results, with the fields that are known already."""
    names = [each.name for each in fields(kind) if each.name not in known]
    return kind(**{name: arrays[_stored_name(kind, name)] for name in names}, **known)


def _work(arrays: Mapping[str, np.ndarray]) -> FrameWork:
    """Work, which earlier versions did not record."""
    if _STORED_NAMES[FrameWork]["made_j"] in arrays:
        return _part(FrameWork, arrays)
    return FrameWork.unknown(len(arrays["frames"]), len(arrays["body_names"]))


def _stored_name(kind: type, name: str) -> str:
    return _STORED_NAMES.get(kind, {}).get(name, name)
