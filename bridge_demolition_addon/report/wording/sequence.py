"""The planned sequence of a scenario: what is done to the bridge, where and when, one line each."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ...engineering.units import mass_text
from ...model.actions import PlannedAction
from ...model.blast.charges import Charge
from ...model.ground_motion.settings import GroundMotion
from ...model.lifts import Lift
from ...model.loads import Load
from ...model.pulls import Pull
from ...model.scenario import Ball, BlastZone, Change, Equipment, Jackhammer, MemberCut, Scenario, TendonCut, Weakening
from ...model.schema import given


@dataclass(frozen=True, slots=True)
class PlannedStep:
    """Something that is planned: when it begins and ends on the clock of the run, s, what it is, and where."""

    begins_s: float  # infinite where it is planned not to happen
    ends_s: float
    what: str
    where: str


def planned_steps(scenario: Scenario) -> list[PlannedStep]:
    """Return all that is planned, machines on the bridge included, in order of time."""
    steps = [step for action in scenario.actions for step in _steps_of(action, scenario)]
    steps += [_standing(machine) for machine in scenario.equipment]
    return sorted(steps, key=lambda step: step.begins_s)


def means_text(scenario: Scenario) -> str:
    """Return by which means the bridge is brought down, in a few words."""
    return "; ".join(_means(scenario)) or "nothing is done to the bridge"


def _means(scenario: Scenario) -> Iterator[str]:
    zones, charges = scenario.blast_zones, [charge for charge in scenario.charges if charge.mass_kg > 0.0]
    if scenario.ball:
        times = max(len(scenario.ball.drops), 1)
        yield f"ball of {mass_text(scenario.ball.mass_kg, 1)}, let go {'once' if times == 1 else f'{times} times'}"
    if zones:
        mass_kg = math.fsum(zone.mass_kg for zone in zones)
        last_ms = 1e3 * max(zone.row_times_s()[-1] for zone in zones)
        yield f"{_count(len(zones), 'blast zone')} with {mass_kg:.3g} kg in drill holes, fired within {last_ms:.0f} ms"
    if charges:
        yield f"{_count(len(charges), 'bare charge')} with {math.fsum(charge.mass_kg for charge in charges):.3g} kg"
    counted = (
        (scenario.cuts, "severed member"),
        (scenario.removals, "removal"),
        (scenario.saw_cuts, "saw cut"),
        (scenario.weakenings, "weakening"),
        (scenario.tendon_cuts, "tendon cut"),
        (scenario.jackhammers, "jackhammer"),
        (scenario.loads, "load"),
        (scenario.pulls, "pull"),
        (scenario.lifts, "lift"),
        (scenario.equipment, "machine"),
    )
    yield from (_count(len(tables), name) for tables, name in counted if tables)
    if scenario.ground_motion:
        yield "motion of the ground"


def _count(number: int, name: str) -> str:
    return f"{number} {name}{'' if number == 1 else 's'}"


def _steps_of(action: PlannedAction, scenario: Scenario) -> Iterator[PlannedStep]:
    if isinstance(action, Ball):
        yield from _hits(action)
        return
    what, where = _described(action)
    begins_s, ends_s = action.begins_s(scenario), action.ends_s(scenario)
    if isinstance(action, BlastZone) and math.isfinite(begins_s):
        ends_s = scenario.detonation_s(action.row_times_s()[-1])  # as planned, without what detonators scatter
    yield PlannedStep(begins_s, ends_s, what, where)


def _hits(ball: Ball) -> Iterator[PlannedStep]:
    what = f"ball of {mass_text(ball.mass_kg, 1)} is let go"
    if ball.cable:
        yield PlannedStep(ball.release_time_s, ball.release_time_s, f"{what} on its cable", "")
    for drop in ball.drops:
        lands_s = drop.release_time_s + drop.fall_time_s
        height = f"{what}, {given(drop.drop_height_m):g} m above the deck"
        yield PlannedStep(drop.release_time_s, lands_s, height, f"above {_point(given(drop.target_m))}")


def _described(action: PlannedAction) -> tuple[str, str]:
    match action:
        case BlastZone():
            rows = "a row" if action.rows == 1 else f"{action.rows} rows"
            holes = f"{rows}, {action.holes} holes, {action.mass_kg:.3g} kg of {action.explosive}"
            return f"{action.name} fires: {holes}", action.member
        case MemberCut():
            return f"{action.name} severs a member: {action.mass_kg:.3g} kg", action.member
        case Charge():
            bare = f"{action.mass_kg:.3g} kg of {action.explosive}, bare"
            return f"{action.name} detonates: {bare}", _point(action.place_m)
        case Weakening():
            return f"weakening to {100.0 * action.factor:g} % of the strength", action.where or "everywhere"
        case TendonCut():
            return f"{action.kind}: {', '.join(action.tendons or ('all',))}", action.where or "at their anchorages"
        case Change():
            return action.kind, action.where or "everywhere"
        case Load():
            return f"load of up to {max(action.forces_n) / 1e3:g} kN", action.where
        case Pull():
            return f"{action.name} pulls with up to {action.most_n / 1e3:g} kN", f"from {_point(action.anchor_m)}"
        case Lift():
            return f"{action.name}: slings hold with {action.pretension:.0%}, then it is lifted away", action.where
        case Jackhammer():
            return "jackhammer works", f"from {_point(action.path_m[0])} to {_point(action.path_m[-1])}"
        case GroundMotion():
            return "the ground moves", ""
    return action.heading.lower(), ""


def _standing(machine: Equipment) -> PlannedStep:
    until_s = math.inf if machine.until_s is None else machine.until_s
    what = f"{machine.name} of {mass_text(machine.mass_kg, 1)} stands on the bridge"
    return PlannedStep(machine.from_s, until_s, what, _point(machine.place_m))


def _point(position_m: Sequence[float]) -> str:
    return f"({', '.join(f'{value:g}' for value in position_m)}) m"
