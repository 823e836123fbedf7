"""The most that bars across cracks did in a run, for its summary."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ...engineering.elasticity.crack_state import ALL_RUPTURED, AT_YIELD, FrameCracks
from .inventory import Inventory


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

    def summary(self) -> dict[str, Any]:
        """Return the numbers of connections, the largest use of the rupture strain, and both by kind of member."""
        kinds = self._kinds()
        cracked = self._cracked & self._have_bars
        return {
            "with_bars": int(self._have_bars.sum()),
            **self._of(self._have_bars),
            "largest_use": self._largest() if (cracked & (self._use > 0.0)).any() else None,
            "by_kind": [
                {"kind": str(kind), **self._of(cracked & (kinds == kind))} for kind in np.unique(kinds[cracked])
            ],
        }

    def _of(self, chosen: np.ndarray) -> dict[str, Any]:
        """Return the numbers of some connections (m,), and their largest use with its time."""
        cracked = self._cracked & chosen
        most = int(np.argmax(np.where(cracked, self._use, -1.0))) if cracked.any() else None
        return {
            "cracked": int(cracked.sum()),
            "held_at_end": int((cracked & self._held).sum()),
            "yielded": int((cracked & (self._yield_shares >= AT_YIELD)).sum()),
            "ruptured_in_part": int((cracked & (self._ruptured > 0.0) & (self._ruptured < ALL_RUPTURED)).sum()),
            "ruptured": int((cracked & (self._ruptured >= ALL_RUPTURED)).sum()),
            "largest_use_share": 0.0 if most is None else float(self._use[most]),
            "largest_use_s": None if most is None else float(self._use_s[most]),
        }

    def _largest(self) -> dict[str, Any]:
        """Return where bars used most of their rupture strain, and when."""
        inventory, row = self._inventory, int(np.argmax(np.where(self._have_bars, self._use, -1.0)))
        first, second = members_of(inventory, np.array([row]))[0]
        return {
            "share": float(self._use[row]),
            "time_s": float(self._use_s[row]),
            "connection": str(inventory.connection_names[row]),
            "first_member": first,
            "second_member": second,
        }

    def _kinds(self) -> np.ndarray:
        """Kinds of members (m,) that the connections are in, or of both where they are between two."""
        pairs = np.append(self._inventory.body_member_kinds.astype(object), "")[self._inventory.pairs]
        return np.array([first if first == second else f"{first} and {second}" for first, second in pairs], object)


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
    members = " and ".join(dict.fromkeys(filter(None, (largest["first_member"], largest["second_member"]))))
    return (
        f"{largest['share']:.0%} of the rupture strain at {largest['time_s']:.3f} s, {members}, {largest['connection']}"
    )
