"""Records that a run's summary is made of, as frozen classes, and how they are read from JSON."""

from __future__ import annotations

import math
import types
from collections.abc import Mapping
from dataclasses import MISSING, Field, dataclass, fields, is_dataclass
from functools import cache
from typing import Any, ClassVar, Protocol, TypeVar, Union, get_args, get_origin, get_type_hints

import numpy as np

from ...errors import OutputError
from ..schema import LARGEST_NUMBER, shown
from .checks import can_be_written


class Record(Protocol):
    """A frozen class whose fields are the keys of a table in JSON; symbols of units have their capitals there alone."""

    __dataclass_fields__: ClassVar[dict[str, Field[Any]]]


_Record = TypeVar("_Record", bound=Record)


@dataclass(frozen=True, slots=True)
class MomentOfRun:
    """A frame, and the time at its end."""

    time_s: float
    frame: int = 0


@dataclass(frozen=True, slots=True)
class KeyFrame:
    """The frame that shows most, and which moment it is."""

    time_s: float = 0.0
    frame: int = 0
    reason: str = ""


@dataclass(frozen=True, slots=True)
class HitOfRun:
    """A hit of a ball; one from behind has no estimates of its force."""

    ball: str
    time_s: float
    lasted_s: float
    approach_m_s: float
    impulse_ns: float
    raw_peak_force_n: float
    half_sine_peak_force_n: float | None = None
    hertz_peak_force_n: float | None = None


@dataclass(frozen=True, slots=True)
class PeakForce:
    """The largest resultant on a shard."""

    force_n: float
    body: str = ""
    frame: int = 0
    time_s: float = 0.0


@dataclass(frozen=True, slots=True)
class LargestThrow:
    """The largest throw of a shard."""

    throw_m: float
    body: str


@dataclass(frozen=True, slots=True)
class Fall:
    """What broke and moved before anything was done to a bridge; `until_s` is None where nothing was ever done."""

    until_s: float | None
    first_break_s: float | None
    broken: int
    connections: int
    largest_move_m: float


@dataclass(frozen=True, slots=True)
class StillMoving:
    """Shards that move at the end of a run, and the fastest of them."""

    shards: int
    of_shards: int
    mass_kg: float
    fastest_m_s: float
    body: str
    member: str


@dataclass(frozen=True, slots=True)
class CreepingShard:
    """A shard that creeps, its mean speed, and its distance from where it was at first."""

    body: str
    member: str
    speed_m_s: float
    moved_m: float


@dataclass(frozen=True, slots=True)
class Creeping:
    """Shards that creep at the end of a run, the fastest of them first."""

    shards: int
    mass_kg: float
    fastest: tuple[CreepingShard, ...]


@dataclass(frozen=True, slots=True)
class SolverEnergy:
    """Energy that the solver made, its share of what was dissipated, and the share that counts for a doubt."""

    share_of_dissipated: float = 0.0
    share_that_counts: float | None = None
    j: float = 0.0

    @property
    def counted_share(self) -> float:
        """The share that counts; earlier versions took the share of what was dissipated."""
        return self.share_of_dissipated if self.share_that_counts is None else self.share_that_counts


@dataclass(frozen=True, slots=True)
class EnergyOfRun:
    """Energies of a run; `dissipated_by_bars_j` is None where it is not known."""

    made_by_solver: SolverEnergy
    dissipated_j: float = 0.0
    dissipated_by_bars_j: float | None = None
    doubtful_throws: int = 0


@dataclass(frozen=True, slots=True)
class ConnectionsOfRun:
    """Connections at the end of a run; None for what earlier versions did not tell apart."""

    count: int
    broken: int
    cracked: int | None = None
    yielded: int | None = None
    torn: int | None = None


@dataclass(frozen=True, slots=True)
class BearingOfRun:
    """The largest and the least that a bearing carried; `gone_s` is None where it stayed."""

    name: str
    at_rest_up_n: float | None
    largest_up_n: float
    least_up_n: float
    largest_horizontal_n: float
    largest_moment_y_nm: float
    largest_open_share: float
    largest_displacement_m: float
    left_share: float
    opened: bool
    opened_s: float | None
    gone_s: float | None
    slid: bool | None
    largest_up_s: float | None = None
    slip_m: float | None = None


@dataclass(frozen=True, slots=True)
class BarsOfKind:
    """Connections with bars of one kind of member that cracked."""

    kind: str
    cracked: int
    held_at_end: int
    yielded: int
    ruptured_in_part: int
    ruptured: int


@dataclass(frozen=True, slots=True)
class BarsAtEnd:
    """What bars across cracks did in a run: in total, and by kind of member."""

    with_bars: int
    cracked: int
    held_at_end: int
    yielded: int
    ruptured_in_part: int
    ruptured: int
    by_kind: tuple[BarsOfKind, ...] = ()

    @property
    def text(self) -> str:
        """How many cracks bars held, and how many of them yielded or ruptured, in a line."""
        in_part = f", {self.ruptured_in_part} in part" if self.ruptured_in_part else ""
        counts = f"{self.cracked} of {self.with_bars} connections with bars cracked"
        return f"{counts}, {self.yielded} yielded, {self.ruptured} ruptured{in_part}"


@dataclass(frozen=True, slots=True)
class TendonRelease:
    """Energy that a tendon let go at once, and how."""

    time_s: float
    how: str
    energy_j: float


@dataclass(frozen=True, slots=True)
class TendonOfRun:
    """What a tendon stored at first, and what it let go."""

    name: str
    member: str
    force_n: float
    stored_j: float
    released: tuple[TendonRelease, ...]


@dataclass(frozen=True, slots=True)
class PullOfRun:
    """What a cable pulled with; None where it was not paid out, or held to the end."""

    name: str
    largest_force_n: float
    largest_force_s: float
    paid_out_s: float | None
    ended: str | None
    ended_s: float | None
    let_go_j: float | None
    work_j: float


@dataclass(frozen=True, slots=True)
class LoadOfRun:
    """What a load or a pressure did."""

    name: str
    largest_force_n: float
    largest_force_s: float
    impulse_ns: tuple[float, float, float]
    work_j: float


@dataclass(frozen=True, slots=True)
class LiftOfRun:
    """The largest load on a hook, and the weight of its part: of its shards, and by volume where that is known."""

    name: str
    largest_hook_n: float
    largest_hook_s: float
    weight_n: float
    volume_weight_n: float | None = None


@dataclass(frozen=True, slots=True)
class EventOfRun:
    """A change to the structure: what held the part of a lift, and what pressed the bare bars of a zone."""

    zone: str = ""
    lift: str = ""
    held_by: tuple[str, ...] = ()
    cage_compression_n: float = 0.0
    cage_pressed_n: float = 0.0
    cage_folded_m: float = 0.0


def record_of(kind: type[_Record], values: Any, name: str, *, is_checked: bool = True) -> _Record:
    """Return a record from a table in JSON; keys that it does not have are left out.

    Parameters
    ----------
    kind
        Its class; fields without a default are required.
    values
        What stands in the file.
    name
        How errors call the table.
    is_checked
        False for what a run has just worked out.

    Raises
    ------
    OutputError
        A key is missing, or its value cannot be of a run.
    """
    if not isinstance(values, dict):
        raise OutputError(f"{name}: is {shown(values)}, expected a table")
    known, hints = {key.lower(): key for key in values}, _hints(kind)
    found = {}
    for field in fields(kind):
        if field.name in known:
            key = known[field.name]
            found[field.name] = _value(hints[field.name], values[key], key, is_checked=is_checked)
        elif field.default is MISSING and field.default_factory is MISSING:
            raise OutputError(f"{name}: has no {field.name}")
    return kind(**found)


@cache
def _hints(kind: type) -> dict[str, Any]:
    return get_type_hints(kind)


def _value(hint: Any, value: Any, key: str, *, is_checked: bool) -> Any:
    """Return a value of a type from JSON."""
    if get_origin(hint) in (types.UnionType, Union):
        if value is None:
            return None
        (hint,) = (part for part in get_args(hint) if part is not types.NoneType)
    if isinstance(hint, type) and is_dataclass(hint):
        if not isinstance(value, dict) and not key.endswith("]"):
            raise OutputError(_not_written(key, value))
        return record_of(hint, value, key, is_checked=is_checked)
    if get_origin(hint) is tuple:
        if not isinstance(value, list | tuple):
            raise OutputError(_not_written(key, value))
        of_each, *more = get_args(hint)
        if more != [...] and len(value) != 1 + len(more):
            raise OutputError(_not_written(key, value))
        rows = enumerate(value)
        return tuple(_value(of_each, row, f"{key}[{number}]", is_checked=is_checked) for number, row in rows)
    if is_checked and not _HOLDS[get_origin(hint) or hint](value):
        raise OutputError(_not_written(key, value))
    return value


def _not_written(key: str, value: Any) -> str:
    return f"{key}: is {shown(value)}, which no run writes"


def _is_number(value: Any) -> bool:
    if isinstance(value, bool) or not isinstance(value, int | float):
        return False
    return -LARGEST_NUMBER <= value <= LARGEST_NUMBER and math.isfinite(value)


_HOLDS = {
    float: _is_number,
    int: _is_number,
    bool: lambda value: isinstance(value, bool),
    str: lambda value: isinstance(value, str) and can_be_written(np.array(value)),
    dict: lambda value: isinstance(value, Mapping),
}
"""What a value of each type has to be."""
