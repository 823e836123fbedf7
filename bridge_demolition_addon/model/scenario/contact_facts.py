"""Friction and restitution of each pair of bodies that can meet, also where bodies have values of their own."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any

import numpy as np

from ...engineering.mechanics.contact_pairs import other_value, shard_value, slowest_bounce_m_s
from ...engineering.single_precision import shortest
from ...errors import ScenarioError
from ...texts import Quantity, Text, joined
from ..actions import Fact
from .contacts import FRICTION, QUANTITIES, RESTITUTION, SHARDS, BodyInContact, ContactSettings, SurfaceValues
from .scenario import Scenario

_SIZES_M = (0.2, 1.0)
"""Sides of shards for which it is said from which speed on they bounce."""


@dataclass(frozen=True, slots=True)
class BodySurface:
    """A body, or several alike, with friction and restitution by itself."""

    name: str
    values: SurfaceValues
    moves: bool  # pushed by others: of two that are not, Bullet makes no contact


def contact_pairs(scenario: Scenario) -> Iterator[tuple[str, SurfaceValues]]:
    """Yield each pair that can meet, such as ``shard on ground``, with its friction and restitution."""
    shards, *others = _surfaces(scenario)
    yield Text("{} on {}", shards.name, shards.name), shards.values.with_other(shards.values)
    for first, second in combinations((shards, *others), 2):
        if first.moves:
            yield Text("{} on {}", first.name, second.name), first.values.with_other(second.values)


def contact_facts(scenario: Scenario) -> Iterator[Fact]:
    """Yield friction and restitution of every pair, and whether they come from values of single bodies."""
    if sentence := own_values_sentence(scenario):
        yield "given", sentence
    pairs = list(contact_pairs(scenario))
    if unused := _unused_keys(scenario):
        yield Text("of no use"), Text("{}: no such body is in the scenario", ", ".join(unused))
    for name, values in pairs:
        yield name, values_text(values)
    if largest := max(values.restitution for _, values in pairs):
        substep_s = scenario.time.step.substep_s
        speeds = (slowest_bounce_m_s(largest, size_m * math.sqrt(0.75), substep_s) for size_m in _SIZES_M)
        named = [
            Text("{} of one of {}", Quantity(speed, "m/s", ".2g"), Quantity(size_m, "m", "g"))
            for size_m, speed in zip(_SIZES_M, speeds, strict=True)
        ]
        yield (
            "bounce",
            Text(
                "not to be relied on below {}, with sub-steps of {} ms: of what is round none, of flat faces less than "
                "given",
                joined("{} and {}", named),
                f"{1000.0 * substep_s:.3g}",
            ),
        )


def _unused_keys(scenario: Scenario) -> list[str]:
    """Return the given keys of pairs without a body."""
    if scenario.contacts is None:
        return []
    there = {body.contact for body in scenario.bodies_in_contact}
    return [name for name in scenario.contacts.given_keys if name.split(".")[1] not in there]


def own_values_sentence(scenario: Scenario) -> str:
    """Return values of single bodies, as older files give them; empty where pairs are given."""
    if scenario.contacts is not None:
        return ""
    of_bodies = [
        Text("{} {} and {}", surface.name, f"{surface.values.friction:g}", f"{surface.values.restitution:g}")
        for surface in _surfaces(scenario)
    ]
    return Text(
        "for single bodies, as in older files: {}, where those left out are as they were; a contact has the products",
        joined("{}, {}", of_bodies),
    )


def values_text(values: SurfaceValues) -> str:
    return Text("friction {}, restitution {}", f"{values.friction:.3g}", f"{values.restitution:.3g}")


def _surfaces(scenario: Scenario) -> list[BodySurface]:
    """Return shards, ball, ground, surfaces on it and jackhammers, as far as there are any."""

    def named(name: str, body: BodyInContact, *, moves: bool = False) -> BodySurface:
        return BodySurface(name, scenario.surface_of(body), moves)

    ball = [] if scenario.ball is None else [named(Text("ball"), scenario.ball, moves=True)]
    levels = [named(surface.name, surface) for surface in scenario.ground.surfaces]
    hammers = [named(Text("jackhammer {}", number), body) for number, body in enumerate(scenario.jackhammers, start=1)]
    return [
        named(Text("shard"), scenario.shards, moves=True),
        *ball,
        named(Text("ground"), scenario.ground),
        *_together(Text("surfaces"), levels),
        *_together(Text("jackhammer"), hammers),
    ]


def _together(name: str, surfaces: Sequence[BodySurface]) -> Sequence[BodySurface]:
    """Return bodies as one where all have the same values."""
    if not surfaces or any(surface.values != surfaces[0].values for surface in surfaces):
        return surfaces
    return [BodySurface(name, surfaces[0].values, surfaces[0].moves)]


Surfaces = Mapping[BodyInContact, SurfaceValues]
"""Friction and restitution that bodies have by themselves, by their tables."""


def with_surfaces(scenario: Scenario, surfaces: Surfaces) -> Scenario:
    """Return a scenario whose bodies have these values in single precision, by themselves.

    It gives pairs of surfaces, or values of single bodies where it does so already or no pairs make these.

    Raises
    ------
    ScenarioError
        Neither can say it.
    """
    if all(scenario.surface_of(body) == surface for body, surface in surfaces.items()):
        return scenario
    if scenario.contacts is not None:
        contacts = _contacts(scenario.contacts, surfaces)
        if contacts is not None:
            return replace(scenario, contacts=contacts)
    return _with_own_values(scenario, surfaces)


def _contacts(built: ContactSettings, surfaces: Surfaces) -> ContactSettings | None:
    """Return pairs that make every body's values; None where no pairs do."""
    values: dict[str, SurfaceValues] = {}
    for body, surface in surfaces.items():
        if values.setdefault(body.contact, surface) != surface:
            return None
    pairs: dict[str, dict[str, float]] = {name: {} for name in values}
    for quantity in QUANTITIES:
        of_bodies = {name: float(getattr(surface, quantity)) for name, surface in values.items()}
        of_pairs = _pairs(built, quantity, of_bodies)
        if of_pairs is None:
            return None
        for name, pair in of_pairs.items():
            pairs[name][quantity] = pair
    try:
        changed: dict[str, Any] = {name: replace(built.with_shard(name), **pair) for name, pair in pairs.items()}
        contacts = replace(built, **changed)
        contacts.check_possible(values)
    except ScenarioError:
        return None
    return contacts


def _pairs(built: ContactSettings, quantity: str, of_bodies: Mapping[str, float]) -> dict[str, float] | None:
    """Return a quantity of each pair with a shard from the values of single bodies; None where no pairs make these."""
    shard = of_bodies[SHARDS]
    of_two = _first_that_makes(shard, shard_value, [getattr(built.shards, quantity), *_products(shard, shard)])
    if of_two is None:
        return None
    pairs = {SHARDS: of_two}
    for name, value in of_bodies.items():
        if name == SHARDS:
            continue
        tried = [getattr(built.with_shard(name), quantity), *_products(value, shard_value(of_two))]
        pair = _first_that_makes(value, lambda pair: other_value(pair, of_two), tried)
        if pair is None:
            return None
        pairs[name] = pair
    return pairs


def _products(first: float, second: float) -> tuple[float, float]:
    """Return a product in few digits, and in all."""
    return shortest(first * second), first * second


def _first_that_makes(value: float, made: Callable[[float], float], tried: Iterable[float]) -> float | None:
    """Return the first number that makes the value of a body, in Blender's single precision."""
    for number in tried:
        try:
            if np.float32(made(number)) == np.float32(value):
                return number
        except ZeroDivisionError:
            continue
    return None


def _with_own_values(scenario: Scenario, surfaces: Surfaces) -> Scenario:
    """Return a scenario that gives values of single bodies."""

    def own(body: Any) -> Any:
        surface = surfaces[body]
        if RESTITUTION not in body.older_values and surface.restitution:
            raise ScenarioError(f"{body.table} have no key for a restitution of {surface.restitution:g} by themselves")
        values = {FRICTION: surface.friction, RESTITUTION: surface.restitution}
        return replace(body, **{name: values[name] for name in body.older_values})

    return replace(
        scenario,
        contacts=None,
        shards=own(scenario.shards),
        ground=replace(own(scenario.ground), surfaces=tuple(map(own, scenario.ground.surfaces))),
        ball=scenario.ball and own(scenario.ball),
        jackhammers=tuple(map(own, scenario.jackhammers)),
    )
