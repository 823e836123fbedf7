"""Joints of steel that have ruptured, whose bodies meet each other again once they are apart.

A plastic hinge turns its two bodies into each other, as they are rigid and the section between them is not. Bullet
would push them apart as soon as they may collide, and throw light pieces of a bar by tens of metres.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...bullet.body_motion import BodyMotion, BodyMotionReader


class RupturedJoints:
    """Those of m connections that are joints of steel (m,), and have ruptured after they yielded.

    Connections are between `pairs` (m, 2) of n bodies, whose vertices (v, 3) are in their own axes.
    """

    def __init__(
        self, are_joints: np.ndarray, pairs: np.ndarray, vertices_m: Sequence[np.ndarray], reader: BodyMotionReader
    ):
        self._are_joints, self._pairs, self._vertices_m, self._reader = are_joints, pairs, vertices_m, reader
        self._yielded = np.zeros(len(are_joints), bool)
        self._lie_in_each_other = np.zeros(len(are_joints), bool)

    def lie_in_each_other(self, cracked: np.ndarray, holding: np.ndarray) -> np.ndarray:
        """Return the joints (m,) whose bodies have not been apart since they ruptured.

        Of all connections (m,), `cracked` says which hold on past their strength, and `holding` which hold at all.
        Bodies are taken as apart when the boxes around them do not meet.
        """
        self._lie_in_each_other |= self._yielded & ~holding
        self._yielded = (self._yielded | cracked & self._are_joints) & holding
        if rows := np.flatnonzero(self._lie_in_each_other).tolist():
            motion = self._reader.read()
            for row in rows:
                self._lie_in_each_other[row] = self._boxes_meet(row, motion)
        return self._lie_in_each_other

    def _boxes_meet(self, row: int, motion: BodyMotion) -> bool:
        """Whether the boxes around the two bodies of a connection meet."""
        (lower_a, upper_a), (lower_b, upper_b) = (self._box(body, motion) for body in self._pairs[row].tolist())
        return bool((lower_a <= upper_b).all() and (lower_b <= upper_a).all())

    def _box(self, body: int, motion: BodyMotion) -> tuple[np.ndarray, np.ndarray]:
        """Return the lowest and the highest corner (3,) of the box around a body."""
        turned = self._vertices_m[body] @ motion.rotation_components[:, :, body].T
        return (
            motion.position_components_m[:, body] + turned.min(axis=0),
            motion.position_components_m[:, body] + turned.max(axis=0),
        )
