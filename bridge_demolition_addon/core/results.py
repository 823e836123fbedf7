"""Everything a run recorded, as arrays over frames, bodies and connections."""

from __future__ import annotations

import zipfile
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np

from . import forces
from .errors import OutputError


@dataclass(frozen=True, slots=True)
class Results:
    """A run: k recorded frames, n bodies, m connections.

    Attributes
    ----------
    frames, times_s
        (k,) Blender's frame and the simulated time since the start.
    substep_s
        (k,) length of the sub-steps that led to each frame; 0 for the first, in which no time passes.
    body_names, body_kinds, masses_kg
        (n,) names, kinds (shard, ball, ground) and masses; a body that never moves has mass 0.
    places_m, rotations, velocities_m_s
        (k, n, 3), (k, n, 3, 3) and (k, n, 3).
    connection_names, pairs
        (m,) names and (m, 2) indices of the connected bodies.
    connection_forces_n, connection_moments_nm
        (k, m, 3) force on the first body of each pair, and the moment about the connection's own point, in the world's
        axes, of the last sub-step before the frame. The second body gets the opposite.
    intact
        (k, m) whether each connection holds.
    """

    frames: np.ndarray
    times_s: np.ndarray
    substep_s: np.ndarray
    body_names: np.ndarray
    body_kinds: np.ndarray
    masses_kg: np.ndarray
    places_m: np.ndarray
    rotations: np.ndarray
    velocities_m_s: np.ndarray
    connection_names: np.ndarray
    pairs: np.ndarray
    connection_forces_n: np.ndarray
    connection_moments_nm: np.ndarray
    intact: np.ndarray

    def resultants(self) -> np.ndarray:
        """Vector sum of the connection forces on every body in every frame, (k, n, 3) in N."""
        count = len(self.body_names)
        return np.array([forces.resultants(self.pairs, each, count) for each in self.connection_forces_n])

    def magnitude_sums(self) -> np.ndarray:
        """Sum of the magnitudes of the connection forces on every body in every frame, (k, n) in N."""
        count = len(self.body_names)
        return np.array([forces.magnitude_sums(self.pairs, each, count) for each in self.connection_forces_n])

    def of_kind(self, kind: str) -> np.ndarray:
        """Indices of the bodies of a kind."""
        return np.flatnonzero(self.body_kinds == kind)

    def save(self, path: Path) -> None:
        """Write all arrays into one file that `numpy.load` and `load_results` read."""
        np.savez(path, **{field.name: getattr(self, field.name) for field in fields(self)})


def load_results(path: Path) -> Results:
    """Read what `Results.save` wrote.

    Raises
    ------
    OutputError
        The file is missing or was not written by a run.
    """
    try:
        with np.load(path, allow_pickle=False) as stored:
            return Results(**{field.name: stored[field.name] for field in fields(Results)})
    except (OSError, EOFError, KeyError, TypeError, ValueError, zipfile.BadZipFile) as error:
        raise OutputError(f"{path}: expected the results of a run ({error})") from error
