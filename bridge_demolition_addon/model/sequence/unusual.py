"""What of a bridge, and of what is done to it, is so far from all that is usual that it is said before any result."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from ...texts import Quantity, Text
from ..bridge.member import Member
from ..scenario import Scenario
from ..structure.blast_zones import RECORDED_G_T, grams_per_tonne, placed_zones
from ..structure.model import Model
from .checked_model import ModelWorksite

_LARGEST_G_T = 2000.0
"""Explosive by the mass of the bridge that bare charges reach where kilograms are given for grams."""

_POINT_M = 0.01
"""Radius of a position that lies in a member or not."""

_BESIDE_M = 1.0
"""Distance to a charge within which nothing stands that has to be kept whole."""

_MOST_MACHINES = 1.0
"""Mass of a machine over that of the bridge that it stands on."""


def unusual_texts(scenario: Scenario, model: Model) -> tuple[str, ...]:
    """Return it as sentences without full stops; none where nothing is."""
    site = ModelWorksite(scenario, model)
    zones = placed_zones(scenario, model.members, model.layers)
    return (
        *unusual_sizes(scenario, model.members),
        *(text for action in scenario.actions for text in action.unusual(site)),
        *(text for zone in zones for text in zone.unusual()),
        *_explosive(scenario, model),
        *_machines(scenario, site.mass_kg),
        *_neighbours(scenario, site),
    )


def _explosive(scenario: Scenario, model: Model) -> Iterator[str]:
    masses_kg = [charge.mass_kg for charge in scenario.charges] + [cut.mass_kg for cut in scenario.cuts]
    mass_kg = math.fsum(masses_kg)
    rate = grams_per_tonne(mass_kg, model.members)
    if rate > _LARGEST_G_T:
        least, most = RECORDED_G_T
        yield (
            Text(
                "{} of explosive beside drill holes are {} a tonne of the bridge, recorded jobs have "
                "{} to {} in holes (is it in kg?)",
                Quantity(mass_kg, "kg", ".4g"),
                Quantity(rate, "g", ".4g"),
                f"{least:g}",
                f"{most:g}",
            )
        )


def _machines(scenario: Scenario, bridge_kg: float) -> Iterator[str]:
    for machine in scenario.equipment:
        if machine.mass_kg > _MOST_MACHINES * bridge_kg:
            yield Text(
                "{} is {} times as heavy as the bridge (is it in kg?)",
                machine.name,
                f"{machine.mass_kg / bridge_kg:.3g}",
            )


def _neighbours(scenario: Scenario, site: ModelWorksite) -> Iterator[str]:
    for neighbour in scenario.neighbours:
        if inside := site.member_within(neighbour.position_m, _POINT_M):
            yield Text("{} lies in {}, as no neighbour does (is its place right?)", neighbour.name, inside)
        for charge in scenario.charges:
            distance_m = math.dist(neighbour.position_m, charge.position_m)
            if distance_m < _BESIDE_M:
                yield Text(
                    "{} is {} from {}, as no neighbour is (is its place right?)",
                    neighbour.name,
                    Quantity(distance_m, "m", ".2g"),
                    charge.name,
                )


USUAL_DENSITY_KG_M3 = (300.0, 9000.0)
"""From light timber to steel."""

USUAL_LENGTH_M = (0.05, 2000.0)
"""Of the longest side of a member: no part of a bridge that is a member is smaller, and no deck in one piece longer."""

USUAL_THICKNESS_M = (0.003, 30.0)
"""From the plates of a steel girder to a solid pier of a large bridge."""

USUAL_SPAN_OVER_DECK = (3.0, 60.0)
"""Span over the thickness of a deck: slabs have about 15 to 25, prestressed box girders up to 45."""

_MOST_NAMED = 5


def unusual_sizes(scenario: Scenario, members: Sequence[Member]) -> Iterator[str]:
    """Yield what is so large or small that it was probably given in another unit, as sentences without full stops."""
    found = [*_deck_sizes(scenario), *_member_sizes(members), *_densities(members)]
    yield from found[:_MOST_NAMED]


def _member_sizes(members: Sequence[Member]) -> Iterator[str]:
    for member in members:
        extents = np.ptp(member.solid.vertices, axis=0)
        longest = int(extents.argmax())
        if not _usual(extents[longest], USUAL_LENGTH_M):
            pattern = (
                "{} is {} long (is it in another unit?)",
                "{} is {} wide (is it in another unit?)",
                "{} is {} high (is it in another unit?)",
            )[longest]
            yield Text(pattern, member.name, Quantity(extents[longest], "m", ".4g"))
        elif not _usual(member.thickness_m, USUAL_THICKNESS_M):
            yield Text("{} is {} thick (is it in another unit?)", member.name, Quantity(member.thickness_m, "m", ".4g"))


def _densities(members: Sequence[Member]) -> Iterator[str]:
    by_density: dict[Quantity, list[str]] = {}
    for member in members:
        if member.steel and not member.steel.bar:
            continue  # a node carries what its body is too small for
        density = member.mass_kg / member.volume_m3
        if not _usual(density, USUAL_DENSITY_KG_M3):
            by_density.setdefault(Quantity(density, "kg/m³", ".4g"), []).append(member.name)
    for of_them, names in by_density.items():
        if len(names) == 1:
            yield Text("{} has {} (is it in another unit?)", names[0], of_them)
        else:
            yield Text("{} members, such as {}, have {} (is it in another unit?)", len(names), names[0], of_them)


def _deck_sizes(scenario: Scenario) -> Iterator[str]:
    bridge = scenario.bridge
    if bridge is None or bridge.girders or bridge.box_girder:  # their deck is but the slab on top
        return
    thickness_m = bridge.deck.thickness_m
    ratio = max(bridge.span_lengths_m) / thickness_m
    if not _usual(ratio, USUAL_SPAN_OVER_DECK):
        yield Text(
            "The deck is {} thick for spans of up to {} (is it in another unit?)",
            Quantity(thickness_m, "m", "g"),
            Quantity(max(bridge.span_lengths_m), "m", "g"),
        )


def _usual(value: float, limits: tuple[float, float]) -> bool:
    return limits[0] <= value <= limits[1]
