"""Frames that are recorded one by one, and kept on the disk."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ...errors import SimulationError
from ...model.results.arrays import Results
from ...model.results.collapse import ConnectionCounts
from ...model.results.frames import BallHistory, ContactHistory, Frame, Inventory
from ...model.results.stream import FrameStream
from ...model.schema import given


class RecordedFrames:
    """What has been recorded of a simulation so far; inventory and last frame are None before the first frame."""

    def __init__(self) -> None:
        self.inventory: Inventory | None = None
        self.last: Frame | None = None
        self._stream: FrameStream | None = None

    @property
    def frames(self) -> Sequence[Frame]:
        """Frames recorded so far; each is read from the disk when it is asked for."""
        return () if self._stream is None else self._stream

    @property
    def recorded_frames(self) -> int:
        """Number of frames recorded so far."""
        return len(self.frames)

    @property
    def last_frame(self) -> int | None:
        """Number of the last frame recorded; None before the first."""
        return self.last.number if self.last else None

    @property
    def counts(self) -> ConnectionCounts:
        """Connections that have cracked, yielded or torn by now."""
        last = self.last
        return ConnectionCounts.of_frame(last.intact, last.loads.connection_bars) if last else ConnectionCounts(0, 0)

    def motion(self) -> tuple[float, np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Return time in s, positions (n, 3), rotations (n, 3, 3), sleep (n,) and masses (n,) in the last frame."""
        last = self.frames[-1]
        return last.time_s, last.positions_m, last.rotations, last.asleep, given(self.inventory).masses_kg

    def results(self) -> Results:
        """Return everything recorded, mapped from the disk: only what is used is read."""
        if self._stream is None or not self.recorded_frames:
            raise SimulationError("nothing was recorded: play the timeline from its start frame")
        return self._stream.results()

    def remove_stream(self) -> None:
        """Remove the files with the frames, as the results are kept by now; the recording can still be read."""
        if self._stream is not None:
            self._stream.remove()

    def forget(self) -> None:
        """Discard all that was recorded, and close its files: Windows replaces none that is open."""
        self.last = None
        if self._stream is not None:
            self._stream.discard()
            self._stream = None

    def _begin_frames(self, folder: Path, load_sampling: str, inventory: Inventory, *, contacts: bool) -> None:
        """Begin again, with frames of these bodies and connections."""
        self.forget()
        self.inventory = inventory
        self._stream = FrameStream(folder, load_sampling, inventory, contacts=contacts)

    def _append(self, frame: Frame, balls: BallHistory, contacts: ContactHistory | None) -> None:
        given(self._stream).append(frame, balls, contacts)
        self.last = frame
