"""What friction and restitution a scenario gives each pair of bodies that can meet."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from ...engineering.mechanics.contact_pairs import slowest_bounce_m_s
from ...texts import Quantity, Text, joined
from ..actions import Fact
from .contacts import BodyInContact, SurfaceValues
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
    """Yield friction and restitution of all pairs, and whether they come from values of single bodies."""
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
    """Return the keys of pairs that are given, and of which there is no body."""
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
