"""From a scenario to the model that is simulated: shards with their masses, and the connections between them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from functools import partial

import numpy as np

from . import connections as connecting
from .bridge import Member, bridge_density, bridge_members
from .connection_rules import rules_of_pairs
from .connections import Connections
from .errors import GeometryError
from .face_sections import second_moments
from .fracture import Shard, SharedFaces, fracture, touching_faces
from .scenario import ConnectionSettings, Scenario


@dataclass(frozen=True, slots=True)
class Model:
    """A bridge cut into shards, and its connections.

    Attributes
    ----------
    members
        Members of the bridge before they were cut.
    density_kg_m3
        Density of all members.
    shards
        The n shards' closed meshes, in the bridge's coordinates.
    member_of_shard
        (n,) index of the member that each shard was cut from.
    masses_kg
        (n,) mass of each shard.
    centres_m
        (n, 3) centre of mass of each shard.
    connections
        Connections between shards and to the ground.
    joint_of_connection
        (m,) what each connection has in common with others: index of one of the scenario's joints.
    second_moments_m4
        (m, 2, 2) second moments of area of the connections' faces; 0 for one without a face.
    """

    members: tuple[Member, ...]
    density_kg_m3: float
    shards: tuple[Shard, ...]
    member_of_shard: np.ndarray
    masses_kg: np.ndarray
    centres_m: np.ndarray
    connections: Connections
    joint_of_connection: np.ndarray
    second_moments_m4: np.ndarray


def build_model(scenario: Scenario) -> Model:
    """Bridge, shards and connections of a scenario; the same scenario gives the same model.

    Raises
    ------
    GeometryError
        The bridge cannot be cut into that many shards.
    """
    members = bridge_members(scenario.bridge)
    density = bridge_density(scenario.bridge, members)
    counts = shards_per_member(np.array([member.volume_m3 for member in members]), scenario.fracture.shards)
    seeds = np.random.SeedSequence(scenario.seed).generate_state(len(members))
    parts = [
        fracture(member.solid, int(count), int(seed))
        for member, count, seed in zip(members, counts, seeds, strict=True)
    ]
    shards = tuple(shard for part in parts for shard in part.shards)
    member_of_shard = np.repeat(np.arange(len(members)), counts)
    centres = np.concatenate([part.centres for part in parts])
    faces = _all_faces([part.faces for part in parts], shards, member_of_shard, counts)
    rules = scenario.connections.between
    rules_of = partial(rules_of_pairs, rules, members, member_of_shard)
    excluded = np.array([False, *(rule.none for rule in rules)])
    connections = _connections(scenario.connections, shards, centres, faces, lambda pairs: ~excluded[rules_of(pairs)])
    return Model(
        members=members,
        density_kg_m3=density,
        shards=shards,
        member_of_shard=member_of_shard,
        masses_kg=density * np.concatenate([part.volumes for part in parts]),
        centres_m=centres,
        connections=connections,
        joint_of_connection=rules_of(connections.pairs),
        second_moments_m4=second_moments(
            shards, connections.pairs[:, 0], connections.areas, connections.points, connections.normals
        ),
    )


def shards_per_member(volumes: np.ndarray, shard_count: int) -> np.ndarray:
    """How many shards each member (k,) is cut into: by volume, at least one each, `shard_count` together.

    Raises
    ------
    GeometryError
        There are fewer shards than members.
    """
    if shard_count < len(volumes):
        raise GeometryError(
            f"fracture.shards is {shard_count}: expected at least {len(volumes)}, one for each member of the bridge"
        )
    shares = volumes / volumes.sum() * (shard_count - len(volumes))
    counts = 1 + np.floor(shares).astype(int)
    largest_remainders = np.argsort(-(shares - np.floor(shares)), kind="stable")
    counts[largest_remainders[: shard_count - counts.sum()]] += 1
    return counts


def _all_faces(
    within: list[SharedFaces], shards: tuple[Shard, ...], member_of_shard: np.ndarray, counts: np.ndarray
) -> SharedFaces:
    """Faces shared within each member, and those where two members touch."""
    first_shards = np.cumsum(counts) - counts
    numbered = [replace(faces, pairs=faces.pairs + first) for faces, first in zip(within, first_shards, strict=True)]
    parts = [*numbered, touching_faces(shards, member=member_of_shard)]
    return SharedFaces(*(np.concatenate([getattr(part, item.name) for part in parts]) for item in fields(SharedFaces)))


def _connections(
    settings: ConnectionSettings,
    shards: tuple[Shard, ...],
    centres: np.ndarray,
    faces: SharedFaces,
    allowed: Callable[[np.ndarray], np.ndarray],
) -> Connections:
    """Connections between shards and to the ground, of those pairs (k, 2) that are allowed (k,)."""
    match settings.method:
        case "face":
            pairs, distances = connecting.neighbours_by_face(faces)
        case "centre":
            pairs, distances = connecting.neighbours_by_centre(centres, settings.search_radius_m)
        case "vertex":
            pairs, distances = connecting.neighbours_by_vertex(shards, settings.search_radius_m)
        case "nearest":
            pairs, distances = connecting.neighbours_by_count(centres, settings.neighbours)
    kept = allowed(pairs)
    between = connecting.connect(centres, faces, pairs[kept], distances[kept], settings.limit_per_shard)
    if not settings.foundation:
        return between
    standing = connecting.foundations(shards)
    return connecting.joined([between, standing.only(allowed(standing.pairs))])
