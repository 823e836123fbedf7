"""What friction and restitution a scenario gives each pair of bodies that can meet."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from ..actions import Fact
from .contacts import BodyTable, SurfaceValues
from .scenario import Scenario


@dataclass(frozen=True, slots=True)
class NamedSurface:
    """A body, or several alike, with friction and restitution by itself."""

    name: str
    values: SurfaceValues
    moves: bool  # pushed by others: of two that are not, Bullet makes no contact


def contact_pairs(scenario: Scenario) -> Iterator[tuple[str, SurfaceValues]]:
    """Yield each pair that can meet, such as ``shard on ground``, with its friction and restitution."""
    shards, *others = _surfaces(scenario)
    yield f"{shards.name} on {shards.name}", shards.values.with_other(shards.values)
    for first, second in combinations((shards, *others), 2):
        if first.moves:
            yield f"{first.name} on {second.name}", first.values.with_other(second.values)


def contact_facts(scenario: Scenario) -> Iterator[Fact]:
    """Yield friction and restitution of all pairs, and whether they come from values of single bodies."""
    if sentence := own_values_sentence(scenario):
        yield "given", sentence
    for name, values in contact_pairs(scenario):
        yield name, values_text(values)


def own_values_sentence(scenario: Scenario) -> str:
    """Return values of single bodies, as older files give them; empty where pairs are given."""
    if scenario.contacts is not None:
        return ""
    of_bodies = ", ".join(
        f"{surface.name} {surface.values.friction:g} and {surface.values.restitution:g}"
        for surface in _surfaces(scenario)
    )
    return (
        f"for single bodies, as in older files: {of_bodies}, where those left out are as they were; a contact has the "
        "products"
    )


def values_text(values: SurfaceValues) -> str:
    return f"friction {values.friction:.3g}, restitution {values.restitution:.3g}"


def _surfaces(scenario: Scenario) -> list[NamedSurface]:
    """Return shards, ball, ground, surfaces on it and jackhammers, as far as there are any."""

    def named(name: str, body: BodyTable, *, moves: bool = False) -> NamedSurface:
        return NamedSurface(name, scenario.surface_of(body), moves)

    ball = [] if scenario.ball is None else [named("ball", scenario.ball, moves=True)]
    levels = [named(surface.name, surface) for surface in scenario.ground.surfaces]
    hammers = [named(f"jackhammer {number}", body) for number, body in enumerate(scenario.jackhammers, start=1)]
    return [
        named("shard", scenario.shards, moves=True),
        *ball,
        named("ground", scenario.ground),
        *_together("surfaces", levels),
        *_together("jackhammer", hammers),
    ]


def _together(name: str, surfaces: Sequence[NamedSurface]) -> Sequence[NamedSurface]:
    """Return bodies as one where all have the same values."""
    if not surfaces or any(surface.values != surfaces[0].values for surface in surfaces):
        return surfaces
    return [NamedSurface(name, surfaces[0].values, surfaces[0].moves)]
