"""The stages of a demolition: the bridge at rest before each of its steps, and after the last."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from ...engineering.units import STANDARD_GRAVITY_M_S2
from ..scenario import Scenario
from ..sequence.events import Event, model_structure, schedule
from ..structure.model import Model
from .equipment_loads import equipment_loads
from .standing import Standing, StandingBridge

_BUILT, _MACHINES = "as it was built", "equipment comes or goes"
"""What is done where nothing is done to the bridge."""


@dataclass(frozen=True, slots=True, eq=False)
class Stage:
    """The bridge between two steps.

    Attributes
    ----------
    time_s : float
        When it begins.
    step : str
        What was done then.
    standing : Standing
        How it stands.
    removed : (n,) bool
        Shards that were taken away by then.
    loose : (n,) bool
        Shards that nothing holds: they fall, or lie on others by contact alone.
    equipment : tuple of str
        What stands on it.
    equipment_n : float
        Weight of that.
    collapse_factor : float
        At how many times all its loads it begins to come down.
    """

    time_s: float
    step: str
    standing: Standing
    removed: np.ndarray
    loose: np.ndarray
    equipment: tuple[str, ...]
    equipment_n: float
    collapse_factor: float


@dataclass(frozen=True, slots=True)
class Criticality:
    """What becomes of the bridge, as it was built, without one of its members.

    Attributes
    ----------
    member : str
    falls_kg : float
        Mass of what comes down then, without the member itself.
    share : float
        Part of the mass of all that was held.
    """

    member: str
    falls_kg: float
    share: float


def stages_of(scenario: Scenario, bridge: StandingBridge, told: Callable[[int, int], None]) -> list[Stage]:
    """Return the stages of a scenario.

    Parameters
    ----------
    scenario, bridge
        What is done, and to what.
    told
        Is told how many stages are done, of how many.
    """
    model = bridge.model
    steps = _steps(scenario, schedule(scenario.changes, model_structure(model)))
    intact, left = np.ones(len(model.connections), bool), np.ones(len(model.connections))
    removed, stages = np.zeros(len(model.shards), bool), []
    for number, (time_s, events) in enumerate(steps):
        for event in events:
            removed[event.bodies] = True
            left[event.connections] *= event.factor
            intact[event.connections] &= event.factor > 0.0
        stands_there = [each for each in scenario.equipment if each.stands_at(time_s)]
        loads = equipment_loads(model, stands_there, removed)
        safe = np.where(left > 0.0, left, 1.0)
        standing = bridge.rest(intact, safe, loads)
        stages.append(
            Stage(
                time_s=time_s,
                step=", ".join(_told(event, model) for event in events) or (_MACHINES if number else _BUILT),
                standing=standing,
                removed=removed.copy(),
                loose=~standing.held & ~removed & ~model.fixed,
                equipment=tuple(each.name for each in stands_there),
                equipment_n=STANDARD_GRAVITY_M_S2 * sum(each.mass_kg for each in stands_there),
                collapse_factor=bridge.collapse_factor(intact, safe, loads),
            )
        )
        told(number + 1, len(steps))
    return stages


def criticality(bridge: StandingBridge, told: Callable[[int, int], None]) -> list[Criticality]:
    """Return what comes down without each of the members; parameters are those of `stages_of`."""
    model = bridge.model
    count, ones = len(model.connections), np.ones(len(model.connections))
    nothing = np.zeros((6, len(model.shards)))
    held = bridge.rest(ones > 0.0, ones, nothing).held
    found = []
    for number, member in enumerate(model.members):
        own = model.member_of_shard == number
        gone = np.isin(model.connections.pairs, np.flatnonzero(own)).any(axis=1)
        intact = np.ones(count, bool) & ~gone
        loose = held & ~own & ~bridge.rest(intact, ones, nothing).held
        loose |= bridge.comes_down(intact, ones, nothing, 1.0) & ~own
        falls_kg = float(model.masses_kg[loose].sum())
        found.append(Criticality(member.name, falls_kg, falls_kg / float(model.masses_kg[held].sum() or 1.0)))
        told(number + 1, len(model.members))
    return found


def reactions_n(model: Model, stage: Stage) -> np.ndarray:
    """Return the forces (3,) of all supports on the bridge in a stage, N."""
    first, second = model.connections.pairs.T
    fixed = np.append(model.fixed, True)
    forces = stage.standing.loads.forces_n
    return forces[fixed[second] & ~fixed[first]].sum(axis=0) - forces[fixed[first] & ~fixed[second]].sum(axis=0)


def _steps(scenario: Scenario, events: Sequence[Event]) -> list[tuple[float, list[Event]]]:
    """Times at which something changes, from 0 on, and the changes."""
    times = {0.0, *(event.time_s for event in events)}
    for each in scenario.equipment:
        times |= {each.from_s} | ({each.until_s} if each.until_s is not None else set())
    return [(time_s, [event for event in events if event.time_s == time_s]) for time_s in sorted(times)]


def _told(event: Event, model: Model) -> str:
    if len(event.bodies):
        names = {model.members[each].name for each in model.member_of_shard[event.bodies]}
        return f"{event.kind} of {', '.join(sorted(names))}"
    return f"{event.kind} of {len(event.connections)} connections"
