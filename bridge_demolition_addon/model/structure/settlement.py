"""How far footings on soil have settled, tilted and slid at the end of a run."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ...engineering.arithmetic import arctangent
from ...engineering.geometry.vectors import length, transformed, transformed_back
from ..foundations import Foundation
from ..results.arrays import Results
from ..results.motion import relative_to_ground


def settlements(results: Results, foundations: Sequence[Foundation]) -> list[dict[str, Any]]:
    """Return how the footings of each member on soil have moved, ready for JSON.

    ``settled_m`` is the mean downwards over its shards that stand on the ground, ``most_settled_m`` the largest in any
    frame, ``slid_m`` along the ground, and ``tilt_rad`` the tilt of the shard that leans most at the end.
    """
    inventory, seen = results.inventory, relative_to_ground(results)
    ground = set(inventory.of_kind("ground").tolist())
    rows = [row for row, pair in enumerate(inventory.pairs.tolist()) if ground.intersection(pair)]
    standing = np.array([next(b for b in inventory.pairs[row].tolist() if b not in ground) for row in rows], int)
    named = [{foundation.member for foundation in foundations} & {*_names(results, body)} for body in standing.tolist()]
    is_on_soil = np.array([bool(names) for names in named], bool)
    members = inventory.body_members[standing]
    footings = []
    for member in dict.fromkeys(members[is_on_soil].tolist()):
        chosen = np.flatnonzero(is_on_soil & (members == member))
        bodies, points = standing[chosen], inventory.points_m[np.array(rows)[chosen]]
        moved = _moved(seen, bodies, points)
        down = -moved[..., 2].mean(axis=1)
        upwards = np.asarray(seen.frames.rotations[-1, bodies, :, 2], float)
        footings.append(
            {
                "member": member,
                "settled_m": float(down[-1]),
                "most_settled_m": float(down.max()),
                "slid_m": float(length(moved[-1, :, :2].mean(axis=0))),
                "tilt_rad": float(arctangent(length(upwards[:, :2]), upwards[:, 2]).max()),
            }
        )
    return footings


def _names(results: Results, body: int) -> tuple[str, str]:
    return str(results.inventory.body_members[body]), str(results.inventory.body_member_kinds[body])


def _moved(results: Results, bodies: np.ndarray, points_m: np.ndarray) -> np.ndarray:
    """Return the displacement of points (b, 3) that are fixed in bodies (b,) by each frame, (k, b, 3)."""
    positions, rotations = results.frames.positions_m[:, bodies], results.frames.rotations[:, bodies]
    own = transformed_back(rotations[0], points_m - positions[0])
    return positions + transformed(rotations, np.broadcast_to(own, positions.shape)) - points_m
