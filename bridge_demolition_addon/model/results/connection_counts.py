"""How many connections have cracked and hold by bars, how many of these have yielded, and how many are torn."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...engineering.elasticity.crack_state import BARS_HOLD, BARS_YIELDED
from .arrays import Results


@dataclass(frozen=True, slots=True)
class ConnectionCounts:
    """Connections at some moment of a run; None where it did not record whether bars hold.

    Attributes
    ----------
    connections : int
    broken : int
        Those whose concrete has cracked, held by bars or not.
    cracked : int or None
        Those that bars hold.
    yielded : int or None
        Of these, those whose bars have yielded.
    torn : int or None
        Those that nothing but contact holds any more: without bars, with bars that ruptured, cut or blasted.
    """

    connections: int
    broken: int
    cracked: int | None = None
    yielded: int | None = None
    torn: int | None = None

    @classmethod
    def of_frame(cls, intact: np.ndarray, bars: np.ndarray | None) -> ConnectionCounts:
        """Return the counts of connections (m,) that are intact or not, by what `FrameLoads` has of their bars (m,)."""
        broken = ~np.asarray(intact)
        count, all_broken = len(broken), int(broken.sum())
        if bars is None or np.isnan(bars).any():
            return cls(count, all_broken)
        cracked, yielded = (int((broken & (bars >= state)).sum()) for state in (BARS_HOLD, BARS_YIELDED))
        return cls(count, all_broken, cracked, yielded, all_broken - cracked)

    @classmethod
    def of_results(cls, results: Results, row: int = -1) -> ConnectionCounts:
        """Return the counts of a recorded row."""
        bars = results.frames.loads.connection_bars
        return cls.of_frame(results.frames.intact[row], None if bars is None else bars[row])

    @classmethod
    def of_summary(cls, summary: Mapping[str, Any]) -> ConnectionCounts:
        """Return the counts at the end of a run, by its summary; those of runs of before as far as these say."""
        known, bars = summary["connections"], summary.get("reinforcement")
        if known.get("cracked") is None and bars:
            cracked = bars["held_at_end"]
            return cls(known["count"], known["broken"], cracked, None, known["broken"] - cracked)
        return cls(known["count"], known["broken"], *(known.get(name) for name in ("cracked", "yielded", "torn")))

    def to_json(self) -> dict[str, int | None]:
        """Those that `broken` does not tell apart, ready for JSON."""
        return {"cracked": self.cracked, "yielded": self.yielded, "torn": self.torn}

    @property
    def text(self) -> str:
        """All of them in a line."""
        if self.cracked is None:
            return f"cracked or torn: {self.broken} of {self.connections} connections"
        torn = f"torn: {self.torn} of {self.connections} connections"
        if not self.cracked:
            return torn
        yielded = "" if self.yielded is None else f", of these yielded: {self.yielded}"
        return f"cracked (bars hold): {self.cracked}{yielded}; {torn}"
