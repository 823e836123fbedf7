"""The coarse scenario of a preview: the one of the panels in so few shards that its run takes seconds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ..bridge.member import Member
from ..scenario import Scenario

SHARDS, ELASTIC_SHARDS = 80, 50
"""Shards of a preview, where connections are rigid and where they are elastic: a sub-step of elastic connections takes
about ten times as long."""


def preview_scenario(scenario: Scenario, members: Sequence[Member]) -> Scenario:
    """Return a scenario in as few shards as a preview takes, and otherwise as it is; itself where it has no more.

    What is cut finer by numbers or points of the user's own is then cut by volume, as all else: these numbers add up to
    the scenario's. Connections stay rigid or elastic, as they are.

    Parameters
    ----------
    members
        All members of the scenario: each takes one shard at least, but those of steel, which have their own.
    """
    fracture = replace(scenario.fracture, recursion_share=0.0)
    most = ELASTIC_SHARDS if scenario.connections.is_elastic else SHARDS
    most = max(most, sum(member.steel is None for member in members))
    if fracture.shards > most:
        stretched = tuple(replace(rule, shards=None, share=None) for rule in fracture.members if rule.stretch)
        fracture = replace(fracture, shards=most, members=stretched, points=(), points_file=None)
    return scenario if fracture == scenario.fracture else replace(scenario, fracture=fracture)
