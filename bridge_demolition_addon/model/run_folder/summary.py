"""The summary of a run: its main numbers, in ``summary.json``."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Any

from ...errors import UnreadableError
from ...system.disk import write_whole_text
from ...system.reading import MEGABYTE, file_text
from ..results.collapse import ConnectionCounts, Rested
from ..results.records import (
    BarsAtEnd,
    BearingOfRun,
    ConnectionsOfRun,
    Creeping,
    EnergyOfRun,
    EventOfRun,
    Fall,
    HitOfRun,
    KeyFrame,
    LargestThrow,
    LiftOfRun,
    LoadOfRun,
    MomentOfRun,
    PeakForce,
    PullOfRun,
    StillMoving,
    TendonOfRun,
    record_of,
)
from ..results.stability import Stability
from ..results.summary import first_hit_s
from ..schema import given
from ..terrain.built import TerrainFacts
from .files import SUMMARY_FILE

_MOST_BYTES = 100 * MEGABYTE
"""Size up to which a summary is read, which lists every frame."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RunSummary:
    """What is read again of a summary, by its keys in the file; `lacks` names those that an earlier version left out.

    Attributes
    ----------
    completed : bool
        Whether the run went on for as long as planned.
    made_by_hand : tuple of str
        Changes made in Blender, which the scenario does not hold.
    terrain : TerrainFacts or None
        None where the ground is flat.
    impact : MomentOfRun or None
        Frame in which the ball hit; None where it did not, or this is unknown.
    shortest_substep_s : float or None
        None where no time passed.
    fingerprint, wall_time_s : dict
        Digests and programs, and what took how long, by name.
    """

    title: str = ""
    completed: bool = True
    only_motion_because: str | None = None
    blender: str = ""
    density_kg_m3: float | None = None
    made_by_hand: tuple[str, ...] = ()
    changed_bodies: tuple[str, ...] = ()
    terrain: TerrainFacts | None = None
    frames: int = 0
    simulated_s: float = 0.0
    substep_s: float = 0.0
    shortest_substep_s: float | None = None
    mass_kg: dict[str, float] | None = None
    connections: ConnectionsOfRun | None = None
    impact: MomentOfRun | None = None
    key_frame: KeyFrame = field(default_factory=KeyFrame)
    hits_of_the_ball: tuple[HitOfRun, ...] = ()
    largest_resultant: PeakForce | None = None
    largest_throw: LargestThrow | None = None
    energy: EnergyOfRun | None = None
    creeping: Creeping | None = None
    moving_at_end: StillMoving | None = None
    came_to_rest_s: float | None = None
    ended_before: str | None = None
    fell_by_itself: Fall | None = None
    stability: Stability | None = None
    plain_concrete: tuple[str, ...] = ()
    bearings: tuple[BearingOfRun, ...] = ()
    reinforcement: BarsAtEnd | None = None
    tendons: tuple[TendonOfRun, ...] = ()
    pulls: tuple[PullOfRun, ...] = ()
    loads: tuple[LoadOfRun, ...] = ()
    lifts: tuple[LiftOfRun, ...] = ()
    events: tuple[EventOfRun, ...] = ()
    charges: dict[str, Any] | None = None
    blast: dict[str, Any] | None = None
    fingerprint: dict[str, str] | None = None
    wall_time_s: dict[str, float] | None = None
    lacks: tuple[str, ...] = ()

    @classmethod
    def of(cls, values: Any, *, is_checked: bool = False) -> RunSummary:
        """Return a summary from its values by key; keys of a file are checked.

        Raises
        ------
        OutputError
            It holds something that no run writes.
        """
        read = record_of(cls, values, "the whole", is_checked=is_checked)
        stability = read.stability and Stability.of_json(values["stability"])
        return replace(read, stability=stability, lacks=tuple({part.name for part in fields(cls)} - set(values)))

    @property
    def first_hit_s(self) -> float | None:
        """When the ball hit, to a sub-step where its hits were recorded; None as for `impact`."""
        return first_hit_s(self.impact, self.hits_of_the_ball)

    @property
    def rested(self) -> Rested | None:
        """When everything came to rest; None of runs that did not note it."""
        return None if "came_to_rest_s" in self.lacks else Rested(self.came_to_rest_s)

    @property
    def counts(self) -> ConnectionCounts:
        """Connections at the end of the run."""
        return ConnectionCounts.at_end(given(self.connections), self.reinforcement)

    @property
    def has_blast(self) -> bool:
        """Whether charges loaded the bridge, or were to."""
        return bool(self.charges or self.blast)

    @property
    def result_digest(self) -> str:
        """Digest of the results."""
        return given(self.fingerprint)["result"]


def read_summary(folder: Path) -> RunSummary:
    """Read the summary in a run's folder; errors do not name the file.

    Raises
    ------
    UnreadableError, ValueError
        The file cannot be read, or is no JSON.
    OutputError
        It holds something that no run writes.
    """
    return RunSummary.of(_read(folder), is_checked=True)


def write_summary(folder: Path, values: Mapping[str, Any]) -> None:
    """Write a summary, in place of one that is there."""
    write_whole_text(folder / SUMMARY_FILE, json.dumps(values, indent=2) + "\n")


def result_digest_in(folder: Path) -> str | None:
    """Return the digest of the results in a folder; None if unreadable."""
    try:
        return _read(folder)["fingerprint"]["result"]
    except (UnreadableError, ValueError, KeyError, TypeError):
        return None


def _read(folder: Path) -> Any:
    try:
        return json.loads(file_text(folder / SUMMARY_FILE, _MOST_BYTES))
    except RecursionError as error:
        raise ValueError(str(error)) from error
