"""The most and the least that bearings carried and bars across cracks did in a run, for its summary."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any, NamedTuple, Self

import numpy as np

from ...engineering.elasticity.crack_state import ALL_RUPTURED, AT_YIELD, FrameCracks
from ...engineering.mechanics.bearing_loads import BearingLoads
from ...texts import Text
from .frames import Inventory

OPEN_SHARE = 0.999
"""From this share of its area on, a bearing that has lifted off there has opened."""

SLIPPED_M = 1e-4
"""Bullet has positions in single precision: within a bridge of 100 m they are within a tenth of this."""


class AtTime(NamedTuple):
    """A value, and the end of the frame in which it was."""

    value: float
    time_s: float


_NONE, _NO_LEAST = AtTime(-math.inf, 0.0), AtTime(math.inf, 0.0)


@dataclass(frozen=True, slots=True)
class BearingExtreme:
    """What one bearing carried so far.

    Attributes
    ----------
    slept : bool
        Whether bodies slept at first, so that nothing was known of it.
    was_read : bool
        Whether it was there in a frame after the warm-up.
    at_rest_up_n : float or None
        Force in the first of these; None where bodies slept before.
    slip_m : float or None
        None where connections are rigid, which slide without friction.
    gone_s : float or None
        When nothing of it was left.
    """

    name: str
    slept: bool = False
    was_read: bool = False
    at_rest_up_n: float | None = None
    largest_up_n: AtTime = _NONE
    least_up_n: AtTime = _NO_LEAST
    largest_horizontal_n: AtTime = _NONE
    largest_moment_y_nm: AtTime = _NONE
    opened_s: float | None = None
    largest_open_share: float = 0.0
    slip_m: float | None = None
    largest_displacement_m: float = 0.0
    left_share: float = 1.0
    gone_s: float | None = None

    def after(self, time_s: float, loads: BearingLoads, number: int, left: float) -> Self:
        """Return it after a frame that ends then, with its number among bearings, and the part of it that is left."""
        if self.gone_s is not None:
            return self
        if np.isnan(loads.largest_up_n[number]):
            return replace(self, slept=True)
        known = replace(
            self,
            largest_up_n=_larger(self.largest_up_n, loads.largest_up_n[number], time_s),
            largest_horizontal_n=_larger(self.largest_horizontal_n, loads.largest_horizontal_n[number], time_s),
            largest_moment_y_nm=_larger(self.largest_moment_y_nm, loads.largest_moment_y_nm[number], time_s),
            left_share=left,
        )
        # The rest of the frame in which it went says nothing of it.
        return known._with_motion(time_s, loads, number) if left > 0.0 else replace(known, gone_s=time_s)

    def _with_motion(self, time_s: float, loads: BearingLoads, number: int) -> Self:
        along, across, _ = loads.displacements_m[number].tolist()
        open_share, slip_m = float(loads.open_shares[number]), float(loads.slips_m[number])
        at_first_n = None if self.slept else float(loads.forces_n[number, 2])
        least_n = float(loads.least_up_n[number])
        return replace(
            self,
            was_read=True,
            at_rest_up_n=self.at_rest_up_n if self.was_read else at_first_n,
            least_up_n=AtTime(least_n, time_s) if least_n < self.least_up_n.value else self.least_up_n,
            largest_displacement_m=max(float(np.sqrt(along * along + across * across)), self.largest_displacement_m),
            largest_open_share=max(open_share, self.largest_open_share),
            opened_s=time_s if open_share >= OPEN_SHARE and self.opened_s is None else self.opened_s,
            slip_m=self.slip_m if np.isnan(slip_m) else max(slip_m, self.slip_m or 0.0),
        )

    def to_json(self) -> dict[str, str | float | bool | None]:
        """Return it as a summary has it. Times are the ends of frames."""
        return {
            "name": self.name,
            "at_rest_up_N": self.at_rest_up_n,
            "largest_up_N": self.largest_up_n.value,
            "largest_up_s": self.largest_up_n.time_s,
            "least_up_N": self.least_up_n.value,
            "least_up_s": self.least_up_n.time_s,
            "largest_horizontal_N": self.largest_horizontal_n.value,
            "largest_horizontal_s": self.largest_horizontal_n.time_s,
            "largest_moment_y_Nm": self.largest_moment_y_nm.value,
            "largest_moment_y_s": self.largest_moment_y_nm.time_s,
            "opened": self.opened_s is not None,
            "opened_s": self.opened_s,
            "largest_open_share": self.largest_open_share,
            "slid": None if self.slip_m is None else self.slip_m > SLIPPED_M,
            "slip_m": self.slip_m,
            "largest_displacement_m": self.largest_displacement_m,
            "left_share": self.left_share,
            "gone_s": self.gone_s,
        }


class BearingExtremes:
    """Notes the extremes of b bearings, frame by frame, as long as each is there and after a warm-up."""

    def __init__(self, names: Sequence[str], warm_up_s: float):
        self._warm_up_s = warm_up_s
        self._bearings = [BearingExtreme(name) for name in names]

    def note(self, time_s: float, loads: BearingLoads, left: np.ndarray) -> None:
        """Take over a frame that ends then, with the part (b,) of the connections of each bearing that is left."""
        if time_s > self._warm_up_s:
            self._bearings = [
                bearing.after(time_s, loads, number, float(left[number]))
                for number, bearing in enumerate(self._bearings)
            ]

    def known(self) -> list[BearingExtreme]:
        """Return the extremes of the bearings that were read."""
        return [bearing for bearing in self._bearings if bearing.was_read]


def _larger(before: AtTime, value: float, time_s: float) -> AtTime:
    return AtTime(float(value), time_s) if math.isinf(before.value) or value > before.value else before


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
