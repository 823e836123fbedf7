"""Joints of steel that have ruptured, whose bodies meet each other again once they are apart.

A plastic hinge turns its two bodies into each other, as they are rigid and the section between them is not. Bullet
would push them apart as soon as they may collide, and throw light pieces of a bar by tens of metres.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...bullet.body_motion import BodyMotion, BodyMotionReader
from ...engineering.elasticity.joint_rows import components_last
from ...engineering.geometry.turned_boxes import TurnedBoxes, lie_in_each_other
from ...engineering.geometry.vectors import product, transformed, transformed_back
from ...engineering.mechanics.reinforcement import FaceBars
from ...engineering.mechanics.section_cuts import ConnectedFaces
from ...engineering.mechanics.section_forces import section_axes
from ...model.results.inventory import Inventory


class RupturedJoints:
    """Those of the connections (m,) of bodies that are joints of steel (m,), and have ruptured after they yielded.

    Vertices (v, 3) of bodies are in their own axes. `reader` reads where these are, at first as they were built.
    """

    def __init__(
        self, are_joints: np.ndarray, faces: ConnectedFaces, vertices_m: Sequence[np.ndarray], reader: BodyMotionReader
    ):
        self._are_joints, self._pairs, self._reader = are_joints, faces.pairs, reader
        along, built = section_axes(faces.normals), reader.read()
        self._boxes = [
            _boxes_of(faces.pairs[:, side], along, vertices_m, components_last(built.rotation_components))
            for side in (0, 1)
        ]
        self._yielded = np.zeros(len(are_joints), bool)
        self._lie_in_each_other = np.zeros(len(are_joints), bool)

    def lie_in_each_other(self, cracked: np.ndarray, holding: np.ndarray) -> np.ndarray:
        """Return the joints (m,) whose bodies have not been apart since they ruptured.

        Of all connections (m,), `cracked` says which hold on past their strength, and `holding` which hold at all.
        Bodies are taken as the boxes around them, along the bar of the joint.
        """
        self._lie_in_each_other |= self._yielded & ~holding
        self._yielded = (self._yielded | cracked & self._are_joints) & holding
        if self._lie_in_each_other.any():
            rows, motion = np.flatnonzero(self._lie_in_each_other), self._reader.read()
            first, second = (self._now(side, rows, motion) for side in (0, 1))
            self._lie_in_each_other[rows] = lie_in_each_other(first, second)
        return self._lie_in_each_other

    def _now(self, side: int, rows: np.ndarray, motion: BodyMotion) -> TurnedBoxes:
        """Return the boxes around the first or the second bodies of joints (r,) as these have moved."""
        bodies, built = self._pairs[rows, side], self._boxes[side]
        turns, places_m = (
            components_last(motion.rotation_components[..., bodies]),
            motion.position_components_m[:, bodies].T,
        )
        middles_m = places_m + transformed(turns, built.middles_m[rows])
        return TurnedBoxes(middles_m, product(turns, built.axes[rows]), built.halves_m[rows])


def joints_of_steel(bars: FaceBars | None, inventory: Inventory, reader: BodyMotionReader) -> RupturedJoints | None:
    """Return the joints of steel among connections with bars, of which none has ruptured yet; None without any."""
    if bars is None or not bars.are_hinges.any():
        return None
    return RupturedJoints(bars.are_hinges, inventory.faces, inventory.vertices_by_body(), reader)


def _boxes_of(
    bodies: np.ndarray, along: np.ndarray, vertices_m: Sequence[np.ndarray], rotations: np.ndarray
) -> TurnedBoxes:
    """Return boxes around bodies (m,) in their own axes, with edges along axes (m, 3, 3) of the world."""
    axes = product(np.swapaxes(rotations[bodies], 1, 2), along)
    spans_m = np.zeros((len(bodies), 2, 3))
    for row, body in enumerate(bodies.tolist()):
        there = transformed_back(axes[row], vertices_m[body])
        spans_m[row] = there.min(axis=0), there.max(axis=0)
    middles_m = transformed(axes, spans_m.mean(axis=1))
    return TurnedBoxes(middles_m, axes, 0.5 * (spans_m[:, 1] - spans_m[:, 0]))
