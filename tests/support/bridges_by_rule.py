# SPDX-License-Identifier: GPL-3.0-or-later
"""Bridges with bars by a rule, and their schedules."""

from functools import cache

from bridge_demolition_addon.model.bridge.preparation import prepared_members
from bridge_demolition_addon.model.reinforcement.design import bar_schedule
from bridge_demolition_addon.model.scenario import (
    Bridge,
    BridgeReinforcement,
    ConnectionSettings,
    Deck,
    FractureSettings,
    PierCaps,
    Piers,
    Scenario,
    TimeSettings,
)

PIERS = Piers(columns=2, column_length_m=0.7, column_width_m=0.7, height_m=4.9)
CAPS = PierCaps(length_m=1.2, width_m=3.7, height_m=0.6)
LM1 = BridgeReinforcement(designed_for="LM1")
OWN_WEIGHT = BridgeReinforcement(designed_for="own weight")


def bridge(rule=LM1, *, spans=(13.0,), deck=None, **parts):
    """A bridge of slabs that is one lane wide, unless other parts are given."""
    deck = deck or Deck(width_m=3.7, thickness_m=0.6)
    parts = {"piers": PIERS, "pier_caps": CAPS} | parts
    return Bridge(span_lengths_m=spans, density_kg_m3=2400.0, deck=deck, reinforcement=rule, **parts)


def scenario(of_bridge, **tables):
    """A scenario of a bridge that breaks by the strength of reinforced concrete."""
    has_bars = of_bridge.reinforcement or "reinforcement" in tables
    connections = ConnectionSettings(
        type="FIXED",
        method="face",
        material="reinforced concrete slab",
        ductile_elongation_m=0.05 if has_bars else None,
    )
    tables = {"connections": connections, "fracture": FractureSettings(shards=20)} | tables
    return Scenario(title="By rule", time=TimeSettings(duration_s=1.0), bridge=of_bridge, **tables)


@cache
def scheduled(of_bridge):
    """The schedule of a bridge."""
    plan = scenario(of_bridge)
    return bar_schedule(plan, prepared_members(plan).members)


def layer(schedule, member, side, along, at_m=None):
    """The rows of a schedule of a member's layers at a side, or of those that go through a position along them."""
    rows = [
        row for row in schedule.bars if member in row.members and (row.layer.side, row.layer.along) == (side, along)
    ]
    return [row for row in rows if at_m is None or row.layer.ends_m[0] <= at_m <= row.layer.ends_m[1]]


def links(schedule, member):
    """The row with the links of a member."""
    (row,) = [row for row in schedule.links if member in row.members]
    return row
