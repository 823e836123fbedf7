"""A bridge after some changes, and its parts on the hook of a crane: load on the hook, slings, what holds them.

Until a part is free, slings pull with the share of its weight that they took up; with the load factor of a collapse
this share grows as the weight does. Once no connection holds it, it hangs, and the hook carries all of its weight.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from ...engineering.drilled_charges.cages import BareBars
from ...engineering.elasticity.tendons import CutTendon
from ...engineering.units import STANDARD_GRAVITY_M_S2, mass_text, with_digits
from ..as_built import Structure
from ..changes.bare_bars import StandingBars
from ..changes.change import Event
from ..lifts import Lift, Pick
from ..sequence.lifts import PlacedLift
from ..structure.cracking import FALLEN_SHARE
from ..structure.model import Model

if TYPE_CHECKING:
    from .stages import Stage


@dataclass(frozen=True, slots=True)
class BaredZone:
    """A blast zone whose bars stand bare, and what they resist."""

    bars: StandingBars
    groups: np.ndarray  # (k,), which of the groups of bars stand


@dataclass(frozen=True, slots=True)
class PressedBars:
    """What the bars of a blast zone carry at rest, above 0 in tension, and what they resist that way."""

    zone: str
    force_n: float
    resisted_n: float

    @property
    def used(self) -> float:
        """Utilisation at rest. Where their load comes upon them at once, it is up to twice as much."""
        return abs(self.force_n) / self.resisted_n if self.resisted_n else np.inf


@dataclass(frozen=True, slots=True, eq=False)
class ChangedBridge:
    """A bridge of m connections between n shards after changes."""

    intact: np.ndarray  # (m,)
    left: np.ndarray  # (m,), part of its strength that each has; 1 for those that are gone
    removed: np.ndarray  # (n,), shards that were taken away or thrown out
    zones: tuple[BaredZone, ...] = ()
    cuts: tuple[CutTendon, ...] = ()  # of tendons

    @classmethod
    def as_built(cls, model: Model) -> Self:
        """Return a bridge before any change."""
        count = len(model.connections)
        return cls(np.ones(count, bool), np.ones(count), np.zeros(len(model.shards), bool))

    def after(self, events: Sequence[Event]) -> ChangedBridge:
        """Return it after events, in their order."""
        bridge = self
        for event in events:
            bridge = bridge._after_one(event)
        return bridge

    @property
    def bare(self) -> BareBars | None:
        """Return all bars that stand bare, at points of the bridge as it was built; None without any."""
        if not any(len(zone.groups) for zone in self.zones):
            return None
        bodies = np.concatenate([zone.bars.bodies[zone.groups] for zone in self.zones])
        points_m = np.concatenate([zone.bars.points_m[zone.groups] for zone in self.zones])
        each = [
            np.concatenate([np.full(len(zone.groups), getattr(zone.bars, name)) for zone in self.zones])
            for name in ("count", "diameter_m", "yield_pa")
        ]
        return BareBars(bodies[:, 0], bodies[:, 1], points_m[:, 0].T, points_m[:, 1].T, *each)

    def pressed_bars(self, forces_n: np.ndarray) -> tuple[PressedBars, ...]:
        """Return what the bars of each zone carry, by the forces (g,) of `bare`."""
        found, begun = [], 0
        for zone in self.zones:
            force_n = float(forces_n[begun : begun + len(zone.groups)].sum())
            begun += len(zone.groups)
            if force_n:  # bars that have folded or ruptured are gone
                resisted_n = zone.bars.tension_n if force_n > 0.0 else zone.bars.compression_n
                found.append(PressedBars(zone.bars.zone, force_n, resisted_n))
        return tuple(found)

    def _after_one(self, event: Event) -> ChangedBridge:
        intact, left, removed = self.intact.copy(), self.left.copy(), self.removed.copy()
        zones = self.zones
        if bars := event.bars:
            holds = intact[bars.connections].all(axis=1) & ~self._is_gone(bars.bodies)
            zones = (*zones, BaredZone(bars, np.flatnonzero(holds)))
        removed[event.bodies] = True
        intact[event.connections] &= event.factor > 0.0
        if event.factor > 0.0:
            left[event.connections] *= event.factor
        changed, cuts = ChangedBridge(intact, left, removed), (*self.cuts, *event.tendons)
        kept = (_without(zone, changed._is_gone(zone.bars.bodies)) for zone in zones)
        return ChangedBridge(intact, left, removed, tuple(kept), cuts)

    def _is_gone(self, bodies: np.ndarray) -> np.ndarray:
        """Return whether one of the two bodies (k, 2) was taken away; the ground is none of the shards."""
        gone: np.ndarray = np.append(self.removed, False)[bodies].any(axis=1)
        return gone


def _without(zone: BaredZone, is_gone: np.ndarray) -> BaredZone:
    groups = zone.groups[~is_gone[zone.groups]]
    return BaredZone(zone.bars, groups)


HELD, HANGS, GONE = "held", "hangs free", "lifted away"
"""Whether connections still hold a part beside its slings, none do, or it was lifted away in this stage."""

LIFTS_FILE = "lifts.csv"
LIFT_COLUMNS = (
    "stage",
    "time_s",
    "lift",
    "state",
    "part_kg",
    "hook_kN",
    "hook_t",
    "capacity_t",
    "hook_used",
    "radius_m",
    "slings_kN",
    "tilt_deg",
    "held_by",
    "not_on_slings_kg",
    "volume_kg",
)

_KILO = 1000.0

_LEVEL_DEG = 1.0
"""Tilt up to which a part hangs as it was built."""

_SLACK = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class PartOnHook:
    """A part that a crane holds in a stage, or lifts away at its beginning.

    Attributes
    ----------
    state : str
        One of `STATES`.
    shards : (h,) int
        Those that slings hold.
    pick : Pick
        What the whole part weighs.
    forces_n : (k,) float
        Forces of the slings.
    hook_n, tilt_rad : float
        Load on the hook, and the angle by which the part turns until it hangs at rest.
    held_by : tuple of str
        Members that hold it, or the ground.
    overdue : bool
        Whether it should have been lifted away by now, and is held.
    not_on_slings_kg : float
        Mass of what was cut free of the slings.
    """

    lift: Lift
    state: str
    shards: np.ndarray
    pick: Pick
    forces_n: np.ndarray
    hook_n: float
    tilt_rad: float
    radius_m: float | None
    held_by: tuple[str, ...]
    overdue: bool
    not_on_slings_kg: float

    @property
    def used(self) -> float:
        """Load on the hook, by what the crane lifts: of its shards or of its volume, whichever is heavier."""
        return self.pick.heavier_by * self.hook_n / (STANDARD_GRAVITY_M_S2 * self.lift.capacity_kg)


class CraneWork:
    """Lifts of a scenario, stage by stage."""

    def __init__(self, lifts: Sequence[PlacedLift], model: Model, structure: Structure):
        self._model = model
        self._waiting = list(lifts)
        self._leaves = {placed.lift.name: placed.lift.lifting_away().event(structure) for placed in lifts}

    def times(self) -> set[float]:
        """Return when slings begin to hold, and when parts are lifted away."""
        return {time_s for placed in self._waiting for time_s in (placed.lift.from_s, placed.lift.lift_s)}

    def lifted_at(self, time_s: float, changed: ChangedBridge) -> list[tuple[PlacedLift, Event]]:
        """Return the parts that are lifted away at a time, as nothing holds them any more, and take them off the list.

        What is held stays, and is lifted away in the first stage after it is free.
        """
        lifted = [
            placed
            for placed in self._waiting
            if placed.lift.lift_s <= time_s and not placed.held_by(self._model, changed.intact, when_lifted=True)
        ]
        self._waiting = [placed for placed in self._waiting if placed not in lifted]
        return [(placed, self._leaves[placed.lift.name]) for placed in lifted]

    def on_hooks(self, time_s: float, changed: ChangedBridge) -> tuple[list[PartOnHook], np.ndarray]:
        """Return the parts that slings hold at a time, and forces and moments (6, n) on those that are not free."""
        loads, parts = np.zeros((6, len(self._model.shards))), []
        for placed in self._waiting:
            if placed.lift.from_s > time_s:
                continue
            part = self.part(placed, changed, is_overdue=placed.lift.lift_s <= time_s)
            if part.state == HELD:
                loads += placed.loads(self._model, part.forces_n)
            parts.append(part)
        return parts, loads

    def part(
        self, placed: PlacedLift, changed: ChangedBridge, *, is_gone: bool = False, is_overdue: bool = False
    ) -> PartOnHook:
        """Return a part on the hook of a bridge after some changes."""
        model, lift = self._model, placed.lift
        held_by = () if is_gone else placed.held_by(model, changed.intact)
        on_slings, tilt_rad = placed.shards, 0.0
        if held_by:
            forces_n = placed.taken_up_n
            hook_n, not_on_slings_kg = placed.vertical_n(forces_n), 0.0
        else:
            on_slings = placed.on_slings(model, changed.intact)
            hangs = placed.hanging(on_slings, model)
            forces_n, tilt_rad = hangs.forces_n, hangs.tilt_rad
            held_kg = math.fsum(model.masses_kg[on_slings].tolist())
            hook_n, not_on_slings_kg = STANDARD_GRAVITY_M_S2 * held_kg, placed.pick.shards_kg - held_kg
        return PartOnHook(
            lift=lift,
            state=GONE if is_gone else HELD if held_by else HANGS,
            shards=on_slings,
            pick=placed.pick,
            forces_n=forces_n,
            hook_n=hook_n,
            tilt_rad=tilt_rad,
            radius_m=placed.radius_m,
            held_by=held_by,
            overdue=is_overdue,
            not_on_slings_kg=not_on_slings_kg,
        )


def lift_rows(stages: Sequence[Stage]) -> Iterator[dict[str, Any]]:
    """Yield a row for each part on a hook in each stage."""
    for number, stage in enumerate(stages, start=1):
        for part in stage.lifts:
            yield _row(number, stage.time_s, part)


def _row(number: int, time_s: float, part: PartOnHook) -> dict[str, Any]:
    values = (
        number,
        time_s,
        part.lift.name,
        part.state,
        part.pick.shards_kg,
        part.hook_n / _KILO,
        part.hook_n / STANDARD_GRAVITY_M_S2 / _KILO,
        part.lift.capacity_kg / _KILO,
        part.used,
        part.radius_m,
        " ".join(f"{force_n / _KILO:.1f}" for force_n in part.forces_n.tolist()),
        math.degrees(part.tilt_rad),
        ", ".join(part.held_by),
        part.not_on_slings_kg,
        part.pick.volume_kg,
    )
    return dict(zip(LIFT_COLUMNS, values, strict=True))


def hook_cells(parts: Sequence[PartOnHook]) -> Mapping[str, Any]:
    """Return what the row of a stage says of the hooks together; nothing is known where there are none."""
    on_hooks = [part for part in parts if part.state != GONE]
    if not on_hooks:
        return {"on_hooks_kN": None, "hook_used": None}
    return {
        "on_hooks_kN": math.fsum(part.hook_n for part in on_hooks) / _KILO,
        "hook_used": max(part.used for part in on_hooks),
    }


def lift_sentences(parts: Sequence[PartOnHook], fallen_kg: float) -> list[str]:
    """Return what is said of parts on hooks in a stage, and of a mass that neither connections nor slings hold."""
    sentences = [sentence for part in parts for sentence in _of_part(part)]
    if parts and fallen_kg:
        sentences.append(
            f"{mass_text(fallen_kg, 1)} are held by no connection and by no sling: sling them before they are cut "
            "free, or make sure of what they lie on"
        )
    return sentences


def _of_part(part: PartOnHook) -> Iterator[str]:
    load = f"{with_digits(part.hook_n / _KILO, 0)} kN ({part.hook_n / STANDARD_GRAVITY_M_S2 / _KILO:.1f} t)"
    radius = "" if part.radius_m is None else f" at {part.radius_m:.1f} m"
    slings = " and ".join(with_digits(force_n / _KILO, 0) for force_n in part.forces_n.tolist())
    many = len(part.forces_n) > 1
    state = "lifted away, " if part.state == GONE else "hangs free, " if part.state == HANGS else ""
    shares = f"; slings carry {slings} kN" if many else ""
    yield f"{part.lift.name}: {state}{load} on the hook, {part.used:.0%} of what the crane lifts{radius}{shares}"
    if part.pick.warning:
        yield part.pick.warning
    if part.used > 1.0:
        yield f"{part.lift.name} is too heavy for the crane: cut it into smaller parts, or choose a larger crane"
    if part.overdue:
        yield (
            f"{part.lift.name} cannot be lifted away at {part.lift.lift_s:g} s: it still holds to "
            f"{', '.join(part.held_by)}; cut it first"
        )
    if (tilt_deg := math.degrees(part.tilt_rad)) > _LEVEL_DEG:
        yield f"{part.lift.name} turns by {tilt_deg:.0f}° as it comes free: move slings or hook over its middle"
    if many and float(part.forces_n.min()) < _SLACK * float(part.forces_n.max()):
        yield f"a sling of {part.lift.name} is slack"
    if part.not_on_slings_kg > FALLEN_SHARE * part.pick.shards_kg:
        yield f"{mass_text(part.not_on_slings_kg, 1)} of {part.lift.name} are cut off from its slings"
