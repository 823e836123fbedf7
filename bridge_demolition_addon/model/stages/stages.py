"""The stages of a demolition: the bridge at rest before each of its steps, and after the last, under its equipment."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from ...engineering.elasticity.tendons import LEAST_RELEASED_J
from ...engineering.geometry.vectors import unit
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...errors import ScenarioError
from ...texts import Text, joined
from ..actions import Fact
from ..changes.change import Event, schedule
from ..pulls import Pull
from ..scenario import DeadLoad, Equipment, Scenario
from ..schema import given
from ..sequence.lifts import model_structure, placed_lifts
from ..structure.blast_zones import zone_firings
from ..structure.cracking import FALLEN_SHARE
from ..structure.dead_loads import highest_under, lying_load
from ..structure.model import Model
from ..structure.section_use import SectionsWithBars
from .lifted import ChangedBridge, CraneWork, PartOnHook, PressedBars
from .reactions import supports_of
from .standing import MostUsed, Standing, StandingBridge, most_used_of

_TAKEN_OFF = "{} is taken off"
_BUILT, _MACHINES, _PULLS = "as it was built", "equipment comes or goes", "pull by {}"
_SLINGS, _LIFTED = "slings of {} take up {}", "{} is lifted away"
"""Steps without an event."""

_KINDS = ("removal", "lifting away", "saw cut", "severed member", "tendon cut", "weakening")
STEPS = (
    _PULLS,
    _SLINGS,
    _LIFTED,
    _TAKEN_OFF,
    *(f"{kind} of {{}}{of}" for of in (" connections", "") for kind in _KINDS),
)
"""Patterns of the steps that tables of stages have."""

_GRID = 8
"""Along each side of a footprint: its weight stands on a grid of so many by so many points."""


_LEAST_MACHINE_KG = 500.0
"""Lighter than the smallest excavators, of 800 kg: a mass below this was probably given in tonnes."""


@dataclass(frozen=True, slots=True, eq=False)
class Stage:
    """The bridge between two steps."""

    time_s: float  # when it begins
    step: str  # what was done then
    standing: Standing
    removed: np.ndarray  # (n,), shards that were taken away by then
    loose: np.ndarray  # (n,), shards without support: they fall, or lie on others by contact alone
    equipment: tuple[str, ...]  # names
    equipment_n: float  # its weight
    collapse_factor: float | None  # load factor at which it collapses; nan where part is not held, None if not sought
    most_used: MostUsed | None
    bars: tuple[PressedBars, ...] = ()  # that stand bare
    tendons: tuple[ReleasedTendon, ...] = ()  # that let go in this step
    lifts: tuple[PartOnHook, ...] = ()  # parts that a crane holds, or lifts away in this step


@dataclass(frozen=True, slots=True)
class Criticality:
    """Effect of taking one member from the bridge as it was built."""

    member: str
    falls_kg: float  # mass that comes down then, without the member itself
    share: float  # part of the mass that was held
    used: float  # highest utilisation of a connection of the others, before any breaks; nan where none is held
    most_used: int | None  # that connection


def stages_of(
    scenario: Scenario,
    bridge: StandingBridge,
    progress: Callable[[int, int], None],
    *,
    with_factor: bool = True,
    keep: Callable[[Sequence[Stage]], None] = lambda stages: None,
) -> list[Stage]:
    """Return the stages of a scenario; after each, call `progress` with the number done and the total.

    `keep` is called before with all that are done. Without factor the collapse load factor is not sought, which takes
    most of the time.
    """
    model = bridge.model
    sections = SectionsWithBars(scenario, model)
    crane, steps = _planned_steps(scenario, model)
    changed, states = ChangedBridge.as_built(model), []
    for time_s, events in steps:  # all of them first: what cannot be is refused before anything is worked out
        before, changed = changed, changed.after(events)
        lifted = crane.lifted_at(time_s, changed)
        gone = [crane.part(placed, changed, is_gone=True) for placed, _ in lifted]
        changed = changed.after([event for _, event in lifted])
        hanging, on_slings = crane.on_hooks(time_s, changed)
        machines = [machine for machine in scenario.equipment if machine.stands_at(time_s)]
        pulls = [pull for pull in scenario.pulls if pull.start_s <= time_s]
        lying = [load for load in scenario.dead_loads if load.until_s is not None and time_s < load.until_s]
        loads = (
            equipment_loads(model, machines, changed.removed) + pull_loads(model, pulls, changed.removed) + on_slings
        )
        loads += dead_loads(model, lying)
        stage = partial(
            Stage,
            time_s=time_s,
            step=_described_step(scenario, time_s, events, model, gone),
            removed=changed.removed,
            equipment=(
                *(machine.name for machine in machines),
                *(load.name for load in lying),
                *(pull.name for pull in pulls),
            ),
            equipment_n=STANDARD_GRAVITY_M_S2 * math.fsum(machine.mass_kg for machine in machines)
            + STANDARD_GRAVITY_M_S2 * math.fsum(lying_load(load, model.members).mass_kg for load in lying),
            lifts=(*gone, *hanging),
        )
        states.append((before, changed, loads, _among(hanging, model), stage))
    stages: list[Stage] = []
    for before, changed, loads, on_hooks, stage in states:
        state = changed.intact, changed.left, loads
        standing = bridge.rest(*state, bare=changed.bare, cuts=changed.cuts)
        there = ~changed.removed & ~model.fixed
        loose = there & ~standing.held & ~on_hooks
        factor: float | None = None
        if with_factor and model.masses_kg[loose].sum() > FALLEN_SHARE * model.masses_kg[there].sum():
            factor = math.nan
        elif with_factor:
            factor = bridge.collapse_factor(*state, changed.bare, changed.cuts)
        stages.append(
            stage(
                standing=standing,
                loose=loose,
                collapse_factor=factor,
                most_used=most_used_of(bridge, sections, standing),
                bars=changed.pressed_bars(standing.bare_n),
                tendons=released_tendons(bridge, before, changed),
            )
        )
        keep(stages)
        progress(len(stages), len(steps))
    return stages


def _among(parts: Sequence[PartOnHook], model: Model) -> np.ndarray:
    """Return which shards (n,) slings hold, maybe along with connections: bearings that they relieve hold nothing."""
    held = np.zeros(len(model.shards), bool)
    for part in parts:
        held[part.shards] = True
    return held


def criticality(bridge: StandingBridge, progress: Callable[[int, int], None]) -> list[Criticality]:
    """Return what comes down without each of the members, as `stages_of` does."""
    model = bridge.model
    count, ones = len(model.connections), np.ones(len(model.connections))
    nothing = np.zeros((6, len(model.shards)))
    held = bridge.unbroken(ones > 0.0).held
    effects = []
    for number, member in enumerate(model.members):
        own = model.member_of_shard == number
        gone = np.isin(model.connections.pairs, np.flatnonzero(own)).any(axis=1)
        intact = np.ones(count, bool) & ~gone
        without = bridge.unbroken(intact)
        loose = held & ~own & ~without.held
        loose |= bridge.comes_down(intact, ones, nothing, 1.0) & ~own
        falls_kg = float(model.masses_kg[loose].sum())
        share = falls_kg / float(model.masses_kg[held].sum() or 1.0)
        effects.append(Criticality(member.name, falls_kg, share, *_most_used(without, model)))
        progress(number + 1, len(model.members))
    return effects


def _most_used(standing: Standing, model: Model) -> tuple[float, int | None]:
    """Return the highest utilisation of a connection whose both sides are held, and which it is."""
    used = np.fmin(standing.alone, standing.together)
    there = np.append(standing.held | model.fixed, True)[model.connections.pairs].all(axis=1)
    used = np.where(there, used, np.nan)
    if not np.isfinite(used).any():
        return np.nan, None
    worst = int(np.nanargmax(used))
    return float(used[worst]), worst


def equipment_facts(scenario: Scenario, model: Model) -> Iterator[Fact]:
    """Yield what `bda check` says of machines on the bridge: mass, position, and whether the bridge is under them."""
    boxes, none = np.array([shard.bounds for shard in model.shards]), np.zeros(len(model.shards), bool)
    for machine in scenario.equipment:
        where = ", ".join(f"{coordinate:g}" for coordinate in machine.position_m)
        yield machine.name, f"{machine.mass_kg / 1000.0:g} t at ({where}) m"
        beside = int((highest_under(_grid(machine), boxes, none) < 0).sum())
        if beside:
            yield "", f"{beside / _GRID**2:.0%} of what it stands on is beside the bridge: move it"
        if machine.mass_kg < _LEAST_MACHINE_KG:
            yield "", f"equipment.mass_kg is {machine.mass_kg:g}: give it in kg, not in t"


def equipment_loads(model: Model, equipment: Sequence[Equipment], removed: np.ndarray) -> np.ndarray:
    """Return forces and moments (6, n) on the shards by what stands on them.

    Each part of a footprint stands on the highest shard under it. A force at the edge of a shard rotates it as well.
    """
    loads = np.zeros((6, len(model.shards)))
    for machine in equipment:
        weight_n = STANDARD_GRAVITY_M_S2 * machine.mass_kg / _GRID**2
        of_machine, beside = standing_loads(model, _grid(machine), weight_n, removed)
        if len(beside):
            where = ", ".join(f"{number:.2f}" for number in beside[0])
            raise ScenarioError(
                f"equipment {machine.name!r}: nothing of the bridge is under [{where}] m; move it, or take it "
                "away before what it stands on"
            )
        loads += of_machine
    return loads


def dead_loads(model: Model, lying: Sequence[DeadLoad]) -> np.ndarray:
    """Return forces and moments (6, n) on the shards by dead loads that are taken off later."""
    loads, none = np.zeros((6, len(model.shards))), np.zeros(len(model.shards), bool)
    for load in lying:
        parts = lying_load(load, model.members)
        weight_n = STANDARD_GRAVITY_M_S2 * float(parts.masses_kg[0])
        loads += standing_loads(model, parts.points_m, weight_n, none)[0]
    return loads


def standing_loads(
    model: Model, points: np.ndarray, weight_n: float, removed: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return forces and moments (6, n) on the highest shards under points (k, 2), and the points without any (b, 2).

    The same weight stands at each point.
    """
    loads, boxes = np.zeros((6, len(model.shards))), np.array([shard.bounds for shard in model.shards])
    shards = highest_under(points, boxes, removed)
    carried = shards >= 0
    rows = shards[carried]
    arms = points[carried] - model.centres_m[rows, :2]
    for part, values in ((2, np.ones(len(rows))), (3, arms[:, 1]), (4, -arms[:, 0])):
        np.subtract.at(loads[part], rows, values * weight_n)
    return loads, points[~carried]


def _grid(equipment: Equipment) -> np.ndarray:
    """Middles (k, 2) of the parts of a footprint."""
    steps = (np.arange(_GRID) + 0.5) / _GRID - 0.5
    length_m, width_m = equipment.footprint_m
    x, y = np.meshgrid(steps * length_m, steps * width_m)
    return np.column_stack((x.ravel(), y.ravel())) + np.array(equipment.position_m)


def pull_loads(model: Model, pulls: Sequence[Pull], removed: np.ndarray) -> np.ndarray:
    """Return forces and moments (6, n) on the shards by cables, each with the largest force that it comes to.

    They pull towards their anchors from where the bridge was built; what was removed is not pulled.
    """
    loads = np.zeros((6, len(model.shards)))
    if not pulls:
        return loads
    structure = model_structure(model)
    for number, pull in enumerate(pulls, start=1):
        placed = pull.placed(structure, number)
        shard = int(placed.bodies[0])
        if removed[shard]:
            continue
        force_n = pull.most_n * unit(np.subtract(pull.anchor_m, pull.point_m))
        loads[:3, shard] += force_n
        loads[3:, shard] += np.cross(placed.arms_m[0], force_n)
    return loads


def reactions_n(model: Model, stage: Stage) -> np.ndarray:
    """Return the sum (3,) of the supports' forces on the bridge in a stage, N."""
    forces = [support.reaction(stage.standing.loads)[0] for support in supports_of(model)]
    return np.sum(forces, axis=0) if forces else np.zeros(3)


def count_of_stages(scenario: Scenario, model: Model) -> int:
    """Return how many stages a scenario has: one as it was built, and one after each of its steps."""
    return len(_planned_steps(scenario, model)[1])


def _planned_steps(scenario: Scenario, model: Model) -> tuple[CraneWork, list[tuple[float, list[Event]]]]:
    """Return what cranes do, and the times at which something changes, from 0 on, with the changes."""
    planned = (change for change in scenario.changes if not change.by_crane)
    changes, structure = (*planned, *zone_firings(scenario, model.members)), model_structure(model)
    crane = CraneWork(placed_lifts(scenario.lifts, model), model, structure)
    return crane, _steps(scenario, schedule(changes, structure), crane.times())


def _steps(scenario: Scenario, events: Sequence[Event], lifts_s: set[float]) -> list[tuple[float, list[Event]]]:
    """Return times at which something changes, from 0 on, and the changes; `lifts_s` are the lifts' times."""
    times = {0.0, *(event.time_s for event in events)} | lifts_s
    times |= {pull.start_s for pull in scenario.pulls}
    times |= {load.until_s for load in scenario.dead_loads if load.until_s is not None}
    for machine in scenario.equipment:
        times |= {machine.from_s} | ({machine.until_s} if machine.until_s is not None else set())
    return [(time_s, [event for event in events if event.time_s == time_s]) for time_s in sorted(times)]


def _described_step(
    scenario: Scenario, time_s: float, events: Sequence[Event], model: Model, gone: Sequence[PartOnHook]
) -> str:
    done = [_described(event, model) for event in events]
    done += [Text(_PULLS, pull.name) for pull in scenario.pulls if pull.start_s == time_s]
    done += [Text(_LIFTED, part.lift.name) for part in gone]
    done += [Text(_SLINGS, lift.name, f"{lift.pretension:.0%}") for lift in scenario.lifts if lift.from_s == time_s]
    done += [Text(_TAKEN_OFF, load.name) for load in scenario.dead_loads if load.until_s == time_s]
    return joined("{}, {}", done) or Text(_MACHINES if time_s > 0.0 else _BUILT)


def _described(event: Event, model: Model) -> str:
    if event.change.step:
        return event.change.step
    of_kind = f"{event.kind} of {{}}"
    if len(event.bodies):
        names = {model.members[member].name for member in model.member_of_shard[event.bodies]}
        return Text(of_kind, joined("{}, {}", sorted(names)))
    if event.tendons and not len(event.connections):
        cut = sorted({cut.tendon for cut in event.tendons})
        return Text(of_kind, joined("{}, {}", [given(model.tendons).names[tendon] for tendon in cut]))
    return Text(f"{of_kind} connections", len(event.connections))


@dataclass(frozen=True, slots=True)
class ReleasedTendon:
    """A tendon that is cut, and the energy that it lets go."""

    name: str
    released_j: float


def released_tendons(bridge: StandingBridge, before: ChangedBridge, after: ChangedBridge) -> tuple[ReleasedTendon, ...]:
    """Return what the tendons of a bridge let go by changes."""
    first, then = (bridge.tendons(changed.intact, changed.cuts) for changed in (before, after))
    if first is None or then is None:
        return ()
    released_j = (first.stored_j() - then.stored_j()).tolist()
    pairs = zip(given(bridge.model.tendons).names, released_j, strict=True)
    return tuple(ReleasedTendon(name, energy_j) for name, energy_j in pairs if energy_j > LEAST_RELEASED_J)
