"""A scenario whose bodies have other friction and restitution by themselves, given as pairs where pairs make it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ...engineering.mechanics.contact_pairs import other_value, shard_value
from ...engineering.single_precision import shortest
from ...errors import ScenarioError
from .contacts import FRICTION, QUANTITIES, RESTITUTION, SHARDS, BodyInContact, ContactSettings, SurfaceValues
from .scenario import Scenario

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
    """Return pairs that make the values of all bodies; None where no pairs do."""
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
    """Return a quantity of each pair with a shard by those of single bodies; None where no pairs make these."""
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
    """Return the first number of which the value of a body is made, in Blender's single precision."""
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
