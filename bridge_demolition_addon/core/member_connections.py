"""Which connections lie between two members or kinds of members, such as a deck's bearings on its abutments."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .errors import ScenarioError
from .member import Member

GROUND_NAME = "ground"
"""Stands for the ground beside the names and kinds of members."""


def connections_between(
    pairs: np.ndarray, member_of_shard: np.ndarray, members: Sequence[Member], first: str, second: str
) -> np.ndarray:
    """Whether each connection lies between two members, in either order.

    Parameters
    ----------
    pairs
        (m, 2) indices of the connected shards; below 0 for the ground.
    member_of_shard
        (n,) index of the member that each shard was cut from.
    members
        The members.
    first, second
        Name or kind of a member each, or ``ground``. Where both are the same kind, connections between two different
        members of it are meant.

    Returns
    -------
    (m,) bool

    Raises
    ------
    ScenarioError
        A name is that of no member and no kind.
    """
    of_pair = np.where(pairs < 0, -1, np.append(member_of_shard, -1)[pairs])
    one, other = (_is_meant(members, name)[of_pair] for name in (first, second))
    met = (one[:, 0] & other[:, 1]) | (one[:, 1] & other[:, 0])
    return met & (of_pair[:, 0] != of_pair[:, 1])


def _is_meant(members: Sequence[Member], name: str) -> np.ndarray:
    """Whether a name means each of the k members, and last, where the index -1 leads, the ground, (k + 1,)."""
    meant = np.array([name in (member.name, member.kind) for member in members] + [name == GROUND_NAME])
    if not meant.any():
        known = sorted({member.name for member in members} | {member.kind for member in members} | {GROUND_NAME})
        raise ScenarioError(f'"{name}" is no member: expected one of {", ".join(known)}')
    return meant
