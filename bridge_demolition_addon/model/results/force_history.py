"""Loads over a whole run: histories of contact forces and bearings, what was most loaded, and what broke."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.geometry.vectors import length
from ...texts import Text
from ..scenario.bearings import Bearing
from .arrays import Results


@dataclass(frozen=True, eq=False, slots=True)
class ContactForces:
    """Contact forces over k recorded steps, (k,), each the mean over its frame.

    Attributes
    ----------
    total_n
        Over all pairs of bodies in contact, as far as recorded: half the sum of the resultants of the contacts on
        every body. Contacts that press a body from two sides cancel in its resultant, so that it is a lower bound.
    largest_n
        Largest of these resultants on a shard.
    ground_n
        Upward force of the ground by contacts; foundations that still hold are connections and not in it.
    """

    times_s: np.ndarray
    total_n: np.ndarray
    largest_n: np.ndarray
    ground_n: np.ndarray


def contact_forces(results: Results) -> ContactForces:
    """Return the contact forces from the impulses of contacts in each frame; nan where these are unknown."""
    durations = np.diff(results.frames.time_s, prepend=results.frames.time_s[0])
    impulses = results.frames.loads.body_contact_impulses_ns
    known = durations > 0.0
    forces = np.divide(impulses, durations[:, None, None], out=np.zeros_like(impulses), where=known[:, None, None])
    magnitudes = length(forces)
    return ContactForces(
        times_s=results.frames.time_s,
        total_n=magnitudes.sum(axis=1) / 2.0,
        largest_n=largest_on_a_shard(results, magnitudes),
        ground_n=-forces[:, results.inventory.of_kind("ground"), 2].sum(axis=1),
    )


def largest_on_a_shard(results: Results, magnitudes: np.ndarray) -> np.ndarray:
    """Return the largest magnitude (k,) on any shard, from the bodies' (k, n); 0 without shards."""
    return magnitudes[:, results.inventory.of_kind("shard")].max(axis=1, initial=0.0)


@dataclass(frozen=True, slots=True)
class Peak:
    """The largest load of a body or connection, the row, in a recorded step."""

    row: int
    step: int
    force_n: float


def most_loaded(magnitudes_n: np.ndarray, rows: np.ndarray, count: int = 10) -> list[Peak]:
    """Return the rows (r,) with the largest load of the whole run, the largest first.

    `magnitudes_n` (k, n) is the largest load of each row in each step; nan where it is not known.
    """
    if not len(rows) or not len(magnitudes_n):
        return []
    known = np.nan_to_num(magnitudes_n[:, rows], nan=-1.0)
    largest = known.max(axis=0)
    order = np.argsort(-largest, kind="stable")[:count]
    return [
        Peak(int(rows[position]), int(known[:, position].argmax()), float(largest[position]))
        for position in order
        if largest[position] > 0
    ]


def peak_near(results: Results, time_s: float, within_s: float) -> Peak | None:
    """Return the largest resultant on a shard at most `within_s` from a time; None without a load there.

    Where no frame is that near, the nearest frame counts.
    """
    times, shards = np.asarray(results.frames.time_s), results.inventory.of_kind("shard")
    if not len(times) or not len(shards):
        return None
    near = np.flatnonzero(abs(times - time_s) <= within_s)
    steps = near if len(near) else np.array([abs(times - time_s).argmin()])
    forces = np.nan_to_num(np.asarray(results.frames.loads.body_peaks_n[steps])[:, shards])
    step, shard = np.unravel_index(forces.argmax(), forces.shape)
    force_n = float(forces[step, shard])
    return Peak(int(shards[shard]), int(steps[step]), force_n) if force_n > 0.0 else None


@dataclass(frozen=True, eq=False, slots=True)
class BreakingByKind:
    """How many connections of a kind there are, and how many have cracked or are torn at each recorded step, (k,).

    `torn` are those that no bars hold any more; None where that was not recorded.

    The kind says which members they join, such as ``deck - pier cap``, or ``foundation``.
    """

    kind: str
    count: int
    broken: np.ndarray
    torn: np.ndarray | None = None


def breaking_by_kind(results: Results) -> list[BreakingByKind]:
    """Return connections by what they join, the most numerous kind first."""
    kinds, intact, bars = _kinds(results), results.frames.intact, results.frames.loads.connection_bars
    torn = None if bars is None or np.isnan(bars).any() else ~(intact | (bars > 0.0))
    by_kind = []
    for kind in np.unique(kinds):
        of_kind = kinds == kind
        of_torn = None if torn is None else torn[:, of_kind].sum(axis=1)
        broken = (~intact[:, of_kind]).sum(axis=1)
        by_kind.append(BreakingByKind(_kind_text(str(kind)), int(of_kind.sum()), broken, of_torn))
    return sorted(by_kind, key=lambda breaking: -breaking.count)


def _kind_text(kind: str) -> Text:
    first, _, second = kind.partition(" - ")
    if second:
        return Text("{} - {}", Text(first), Text(second))
    return Text("within {}", Text(kind.removeprefix("within "))) if kind.startswith("within ") else Text(kind)


def _kinds(results: Results) -> np.ndarray:
    """Return the kind of each connection, (m,) str."""
    inventory, pairs = results.inventory, results.inventory.pairs
    if not len(pairs):
        return np.zeros(0, str)
    named = np.where(inventory.body_member_kinds != "", inventory.body_member_kinds, inventory.body_kinds)[pairs]
    members = inventory.body_members[pairs]
    first, second = np.sort(named, axis=1).T
    joined = np.char.add(np.char.add(first, " - "), second)
    within = (members[:, 0] == members[:, 1]) & (members[:, 0] != "")
    kinds = np.where(within, np.char.add("within ", named[:, 0]), joined)
    return np.where((inventory.body_kinds[pairs] == "ground").any(axis=1), "foundation", kinds)


@dataclass(frozen=True, slots=True, eq=False)
class BearingHistory:
    """Force of a bearing on what lies above it, at k recorded steps.

    Attributes
    ----------
    name
        The member above ``on`` the one below.
    forces_n
        (k, 3), each the mean over its frame; nan where it is not known, as on bodies that have slept so far.
    intact
        (k,) part of its connections that are there.
    """

    name: str
    forces_n: np.ndarray
    intact: np.ndarray


def bearing_histories(results: Results, tables: Sequence[Bearing]) -> list[BearingHistory]:
    """Return the forces of a scenario's bearings, by name; a bearing is all that connects its two members."""
    inventory = results.inventory
    if not tables or not len(inventory.pairs):
        return []
    above, below = inventory.pairs.T
    names, kinds = inventory.body_members, inventory.body_member_kinds
    histories = []
    for pair in np.unique(names[inventory.pairs], axis=0).tolist():
        rows = np.flatnonzero((names[above] == pair[0]) & (names[below] == pair[1]))
        of_pair = tuple((str(names[body]), str(kinds[body])) for body in (above[rows[0]], below[rows[0]]))
        if pair[0] != pair[1] and any(table.joins(*of_pair) for table in tables):
            forces_n = results.frames.loads.connection_forces_n[:, rows].astype(float).sum(axis=1)
            intact = results.frames.intact[:, rows].mean(axis=1)
            forces_n[_unsolved(results, rows) & (intact > 0.0)] = np.nan
            histories.append(BearingHistory(f"{pair[0]} on {pair[1]}", forces_n, intact))
    return histories


def _unsolved(results: Results, rows: np.ndarray) -> np.ndarray:
    """Return the steps (k,) at which some connections had no forces as their bodies had slept until then."""
    frames = results.frames
    sleep = frames.asleep[:, results.inventory.pairs[rows]].any(axis=2).all(axis=1)
    return sleep & ~frames.loads.connection_forces_n[:, rows].any(axis=(1, 2))
