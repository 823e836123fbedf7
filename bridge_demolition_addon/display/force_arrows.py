"""Arrows for forces: where they start, which way they point, how long they are."""

from __future__ import annotations

import numpy as np

from ..model.results.frames import Frame

_HEAD_SHARE = 0.25
_HEAD_SLOPE = 0.35


def body_forces(frame: Frame) -> tuple[np.ndarray, np.ndarray]:
    """Return the bodies' centres (n, 3) in m, and resultants of connections and contacts (n, 3) in N."""
    return frame.positions_m, frame.loads.body_forces_n


def contact_forces(frame: Frame, frame_s: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the contacts' centres (n, 3) in m, and mean forces (n, 3) in N, over a frame of `frame_s`."""
    impulses = frame.loads.body_contact_impulses_ns
    return frame.positions_m, impulses / frame_s if frame_s > 0.0 else np.zeros_like(impulses)


def connection_forces(
    frame: Frame, first: Frame, pairs: np.ndarray, points_m: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return where connections that hold are, (h, 3) in m, and their forces on their first bodies, (h, 3) in N.

    Connections move with their first bodies: `pairs` (m, 2) are the bodies, `points_m` (m, 3) their positions in the
    frame `first`.
    """
    holds = frame.intact
    bodies = pairs[holds, 0]
    arms = points_m[holds] - first.positions_m[bodies]
    turns = frame.rotations[bodies] @ first.rotations[bodies].transpose(0, 2, 1)
    return frame.positions_m[bodies] + np.einsum("hij,hj->hi", turns, arms), frame.loads.connection_forces_n[holds]


def arrows(starts: np.ndarray, forces: np.ndarray, metres_per_newton: float, least_m: float = 0.0) -> np.ndarray:
    """Return arrows as lines, ends (6 k, 3): three for each of the k forces whose arrow is longer than `least_m`.

    Forces (n, 3) are in N, their starts (n, 3) in m; a force that is not known has no arrow.
    """
    along = forces * metres_per_newton
    lengths = np.linalg.norm(along, axis=1)
    drawn = np.isfinite(lengths) & (lengths > least_m)
    starts, along, lengths = starts[drawn], along[drawn], lengths[drawn, None]
    ends = starts + along
    side = _across(along / lengths) * lengths * _HEAD_SHARE * _HEAD_SLOPE
    back = ends - _HEAD_SHARE * along
    return np.stack((starts, ends, ends, back + side, ends, back - side), axis=1).reshape(-1, 3)


def _across(directions: np.ndarray) -> np.ndarray:
    """Return unit vectors (n, 3) at right angles to others, level where that can be."""
    upright = abs(directions[:, 2]) > 0.99
    across = np.cross(directions, np.where(upright[:, None], (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)))
    return across / np.linalg.norm(across, axis=1, keepdims=True)
