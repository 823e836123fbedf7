"""The most that bars across cracks did in a run, for its summary."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from ...engineering.elasticity.crack_state import ALL_RUPTURED, AT_YIELD, FrameCracks
from ...texts import Text, joined
from .inventory import Inventory


@dataclass(frozen=True, slots=True)
class CrackCounts:
    """Connections that cracked, how many of them bars held or lost, and the largest use of the rupture strain."""

    cracked: int
    held_at_end: int
    yielded: int
    ruptured_in_part: int
    ruptured: int
    largest_use_share: float
    largest_use_s: float | None


@dataclass(frozen=True, slots=True)
class LargestUse:
    """Where bars used most of their rupture strain, and when."""

    share: float
    time_s: float
    connection: str
    first_member: str
    second_member: str


@dataclass(frozen=True, slots=True)
class BarsOfRun:
    """What bars across cracks did in a run: all of them, and by kind of member."""

    with_bars: int
    counts: CrackCounts
    largest_use: LargestUse | None  # None where they used nothing
    by_kind: Mapping[str, CrackCounts]

    def to_json(self) -> dict[str, Any]:
        """Return it as a summary has it."""
        return {
            "with_bars": self.with_bars,
            **asdict(self.counts),
            "largest_use": self.largest_use and asdict(self.largest_use),
            "by_kind": [{"kind": kind, **asdict(counts)} for kind, counts in self.by_kind.items()],
        }


class BarExtremes:
    """Notes what bars across the cracks of m connections did, frame by frame; `have_bars` (m,) says which have any."""

    def __init__(self, inventory: Inventory, have_bars: np.ndarray):
        self._inventory, self._have_bars = inventory, have_bars
        count = len(have_bars)
        self._cracked, self._held = np.zeros((2, count), bool)
        self._yield_shares, self._use, self._use_s, self._ruptured = np.zeros((4, count))

    def note(self, time_s: float, cracks: FrameCracks) -> None:
        """Take over a frame that ends then."""
        rows = cracks.rows
        self._cracked[rows] = True
        self._held[:] = False
        self._held[rows] = cracks.ruptured_shares < ALL_RUPTURED
        self._yield_shares[rows] = np.maximum(self._yield_shares[rows], cracks.yield_shares)
        self._ruptured[rows] = np.maximum(self._ruptured[rows], cracks.ruptured_shares)
        more = rows[cracks.rupture_shares > self._use[rows]]
        self._use[rows] = np.maximum(self._use[rows], cracks.rupture_shares)
        self._use_s[more] = time_s

    def so_far(self) -> BarsOfRun:
        """Return the numbers of connections, the largest use of the rupture strain, and both by kind of member."""
        kinds = self._kinds()
        cracked = self._cracked & self._have_bars
        return BarsOfRun(
            with_bars=int(self._have_bars.sum()),
            counts=self._of(self._have_bars),
            largest_use=self._largest() if (cracked & (self._use > 0.0)).any() else None,
            by_kind={str(kind): self._of(cracked & (kinds == kind)) for kind in np.unique(kinds[cracked])},
        )

    def _of(self, chosen: np.ndarray) -> CrackCounts:
        """Return the numbers of some connections (m,), and their largest use with its time."""
        cracked = self._cracked & chosen
        most = int(np.argmax(np.where(cracked, self._use, -1.0))) if cracked.any() else None
        return CrackCounts(
            cracked=int(cracked.sum()),
            held_at_end=int((cracked & self._held).sum()),
            yielded=int((cracked & (self._yield_shares >= AT_YIELD)).sum()),
            ruptured_in_part=int((cracked & (self._ruptured > 0.0) & (self._ruptured < ALL_RUPTURED)).sum()),
            ruptured=int((cracked & (self._ruptured >= ALL_RUPTURED)).sum()),
            largest_use_share=0.0 if most is None else float(self._use[most]),
            largest_use_s=None if most is None else float(self._use_s[most]),
        )

    def _largest(self) -> LargestUse:
        inventory, row = self._inventory, int(np.argmax(np.where(self._have_bars, self._use, -1.0)))
        first, second = members_of(inventory, np.array([row]))[0]
        use, use_s = float(self._use[row]), float(self._use_s[row])
        return LargestUse(use, use_s, str(inventory.connection_names[row]), first, second)

    def _kinds(self) -> np.ndarray:
        """Kinds of members (m,) that the connections are in, or of both where they are between two."""
        pairs = np.append(self._inventory.body_member_kinds.astype(object), "")[self._inventory.pairs]
        return np.array(
            [first if first == second else Text("{} and {}", Text(first), Text(second)) for first, second in pairs],
            object,
        )


def members_of(inventory: Inventory, rows: np.ndarray) -> list[tuple[str, str]]:
    """Return the two members that each of some connections (r,) is between; empty where a body is of none."""
    names = np.append(inventory.body_members.astype(object), "")
    return [(str(first), str(second)) for first, second in names[inventory.pairs[rows]]]


def bars_text(summary: Mapping[str, Any]) -> str:
    """Return in a line how many cracks bars held, and how many of them yielded or ruptured; empty without bars."""
    bars = summary.get("reinforcement")
    if not bars:
        return ""
    counts = f"{bars['cracked']} of {bars['with_bars']} connections with bars cracked"
    in_part = f", {bars['ruptured_in_part']} in part" if bars["ruptured_in_part"] else ""
    return f"{counts}, {bars['yielded']} yielded, {bars['ruptured']} ruptured{in_part}"


def largest_use_text(summary: Mapping[str, Any]) -> str:
    """Return in a line where bars used most of their rupture strain; empty where they used nothing."""
    bars = summary.get("reinforcement")
    largest = bars and bars["largest_use"]
    if not largest:
        return ""
    members = dict.fromkeys(filter(None, (largest["first_member"], largest["second_member"])))
    return Text(
        "{} of the rupture strain at {} s, {}, {}",
        f"{largest['share']:.0%}",
        f"{largest['time_s']:.3f}",
        joined("{} and {}", members),
        largest["connection"],
    )
