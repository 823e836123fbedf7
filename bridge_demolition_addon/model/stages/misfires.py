"""What stands if a blast zone fails: the bridge at rest after all other changes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...engineering.units import STANDARD_GRAVITY_M_S2, mass_text
from ..changes.change import Event, schedule
from ..changes.zone_firings import ZoneFiring
from ..scenario import Scenario
from ..sequence.lifts import model_structure
from ..structure.blast_zones import zone_firings
from .lifted import ChangedBridge
from .standing import StandingBridge

MISFIRES_FILE = "misfires.csv"
MISFIRE_COLUMNS = ("fails", "stands_kg", "falls_kg", "falls_share", "members_that_stand", "falls_at_most_kg")

ALL_FIRE = "none: all zones fire"

_INCLINATION = 1.0 / 200.0
"""Of a structure that is not quite upright, rad: EN 1992-1-1:2004, 5.2 (5)."""

_STANDS = 0.99
"""Part of a member's mass that has to be held for it to stand."""


@dataclass(frozen=True, slots=True)
class Misfire:
    """The bridge after all changes but one zone. Masses count what a connection to a support held at first."""

    fails: str  # name of the zone, or `ALL_FIRE`
    stands_kg: float
    falls_kg: float  # without what the zones themselves throw out
    falls_share: float  # part of what was held
    members: tuple[str, ...]  # those that stand
    falls_at_most_kg: float  # the same where bare bars are pressed at once, and the bridge can sway on them


def misfires(scenario: Scenario, bridge: StandingBridge, progress: Callable[[int, int], None]) -> list[Misfire]:
    """Return what comes down if all zones fire, and without each that does; nothing where there are none.

    Equipment does not stand on the bridge then. `progress` is called with the number done and the total.
    """
    model = bridge.model
    firings = zone_firings(scenario, model.members)
    if not firings:
        return []
    events = schedule((*scenario.changes, *firings), model_structure(model))
    whole = np.ones(len(model.connections), bool)
    held = bridge.rest(whole, whole.astype(float), np.zeros((6, len(model.shards)))).held
    cases: list[ZoneFiring | None] = [None, *firings]
    found = []
    for number, fails in enumerate(cases, start=1):
        fired = [event for event in events if event.change is not fails]
        found.append(_without(bridge, fired, held, fails.name if fails else ALL_FIRE))
        progress(number, len(cases))
    return found


def _without(bridge: StandingBridge, events: Sequence[Event], held: np.ndarray, fails: str) -> Misfire:
    masses, changed = bridge.model.masses_kg, ChangedBridge.as_built(bridge.model).after(events)
    down = _coming_down(bridge, changed, held)
    at_most = down
    if changed.bare and not down[held & ~changed.removed].all():
        at_most = down | _coming_down(bridge, changed, held, at_worst=True)
    stands = held & ~down & ~changed.removed
    stands_kg, falls_kg, at_most_kg = (float(masses[which].sum()) for which in (stands, down, at_most))
    whole_kg = float(masses[held].sum() or 1.0)
    return Misfire(fails, stands_kg, falls_kg, falls_kg / whole_kg, _standing(bridge, stands), at_most_kg)


def _coming_down(
    bridge: StandingBridge, changed: ChangedBridge, held: np.ndarray, *, at_worst: bool = False
) -> np.ndarray:
    """Return which shards (n,) come down of those that were held.

    At worst bare bars are pressed at once and hold nothing sideways, and the bridge is inclined.
    """
    model, loads = bridge.model, np.zeros((6, len(bridge.model.shards)))
    if at_worst:
        loads[:2] = _INCLINATION * STANDARD_GRAVITY_M_S2 * np.where(model.fixed, 0.0, model.masses_kg)
    down = ~bridge.rest(
        changed.intact, changed.left, loads, bare=changed.bare, at_worst=at_worst, cuts=changed.cuts
    ).held
    if changed.bare is None:
        down |= bridge.comes_down(changed.intact, changed.left, loads, 1.0, changed.cuts)
    falls: np.ndarray = held & down & ~changed.removed
    return falls


def _standing(bridge: StandingBridge, stands: np.ndarray) -> tuple[str, ...]:
    """Return the names of members that stand; what supports hold is not among them."""
    model = bridge.model
    names = []
    for number, member in enumerate(model.members):
        own = (model.member_of_shard == number) & ~model.fixed
        mass_kg = model.masses_kg[own].sum()
        if mass_kg and model.masses_kg[own & stands].sum() >= _STANDS * mass_kg:
            names.append(member.name)
    return tuple(names)


def misfire_row(misfire: Misfire) -> dict[str, Any]:
    """Return the row of a zone that fails."""
    members = ", ".join(misfire.members)
    masses = misfire.stands_kg, misfire.falls_kg, misfire.falls_share
    values = misfire.fails, *masses, members, misfire.falls_at_most_kg
    return dict(zip(MISFIRE_COLUMNS, values, strict=True))


def misfire_sentences(found: Sequence[Misfire]) -> list[str]:
    """Return what stands if a zone fails, as sentences without a full stop."""
    sentences = []
    for misfire in found:
        case = "if all zones fire" if misfire.fails == ALL_FIRE else f"if {misfire.fails} fails"
        falls = "nothing comes down"
        if misfire.falls_kg:
            falls = f"{mass_text(misfire.falls_kg, 1)} come down, {misfire.falls_share:.0%}"
        more_kg = misfire.falls_at_most_kg - misfire.falls_kg
        if more_kg > 0.0:
            falls += (
                f" at rest, and up to {mass_text(misfire.falls_at_most_kg, 1)} where bars are pressed at once and sway"
            )
        left = f"; {', '.join(misfire.members)} stand" if misfire.members else "; no member stands"
        sentences.append(f"{case}: {falls}{left}")
    return sentences
