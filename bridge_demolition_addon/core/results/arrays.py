"""Everything a run recorded, as arrays over frames, bodies and connections."""

from __future__ import annotations

import zipfile
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np

from ..errors import OutputError


@dataclass(frozen=True, slots=True)
class Results:
    """A run: k recorded frames, n bodies, m connections.

    Loads are those of the whole frame when `reading` is ``every sub-step``, otherwise those of its last sub-step.
    Forces on a body are those of its connections and contacts together, without gravity. All vectors are in the world's
    axes.

    Attributes
    ----------
    reading
        Which sub-steps the loads come from, a text.
    frames, times_s
        (k,) Blender's frame and the simulated time since the start.
    substep_s
        (k,) length of the sub-steps that led to each frame; 0 for the first, in which no time passes.
    body_names, body_kinds, masses_kg, volumes_m3
        (n,) names, kinds (shard, ball, ground, tool, crane), masses and volumes; both 0 for a body that never moves.
    body_members, body_member_kinds
        (n,) name and kind of the member that each body is a piece of; empty where it is of none.
    vertices_m, vertex_counts
        (v, 3) vertices of all bodies, each in its own axes from its own place, and (n,) how many each body has.
    places_m, rotations, velocities_m_s, spins_rad_s
        (k, n, 3), (k, n, 3, 3), (k, n, 3) and (k, n, 3) at the end of each frame.
    asleep
        (k, n) bodies that are not simulated because they rest; they keep the loads that they fell asleep with.
    body_forces_n, body_peaks_n
        (k, n, 3) mean of the resultant, and (k, n) its largest magnitude.
    body_sums_n, body_peak_sums_n
        (k, n) mean and largest of the sum of the magnitudes.
    body_contact_impulses_ns
        (k, n, 3) impulse of the contacts in the frame.
    body_signed_2019_n
        (k, n) mean of what the add-on of 2019 calls the contact force: the numbers that Bullet keeps of its
        connections, added or taken off with their signs. For comparison only.
    blast_impulses_ns
        (k, n, 3) impulse of all blasts in the frame; it is no part of the forces.
    stresses_pa, von_mises_pa
        (k, n, 3, 3) average stress of each body under its mean loads, tension positive, and (k, n) its equivalent
        stress in the sub-step in which all loads together were largest.
    connection_names, pairs, points_m, areas_m2, normals, second_moments_m4
        (m,) names, (m, 2) indices of the connected bodies, (m, 3) first places, (m,) areas, (m, 3) first unit normals
        from the first body to the second, and (m, 2, 2) second moments of area about the sections' y and z axes.
    connection_forces_n, connection_moments_nm
        (k, m, 3) mean force on the first body of each pair, and moment about the connection's own point.
    connection_peaks_n, connection_peak_forces_n, connection_peak_moments_nm
        (k, m) largest magnitude of the force, and (k, m, 3) force and moment in the sub-step that had it.
    intact
        (k, m) whether each connection holds.
    balls, ball_times_s, ball_impulses_ns, ball_velocities_m_s
        (b,) indices of the balls, (s,) times of all sub-steps, (s, b, 3) impulses of their contacts in each, and
        velocities after it.
    """

    reading: np.ndarray
    frames: np.ndarray
    times_s: np.ndarray
    substep_s: np.ndarray
    body_names: np.ndarray
    body_kinds: np.ndarray
    masses_kg: np.ndarray
    volumes_m3: np.ndarray
    body_members: np.ndarray
    body_member_kinds: np.ndarray
    vertices_m: np.ndarray
    vertex_counts: np.ndarray
    places_m: np.ndarray
    rotations: np.ndarray
    velocities_m_s: np.ndarray
    spins_rad_s: np.ndarray
    asleep: np.ndarray
    body_forces_n: np.ndarray
    body_peaks_n: np.ndarray
    body_sums_n: np.ndarray
    body_peak_sums_n: np.ndarray
    body_contact_impulses_ns: np.ndarray
    body_signed_2019_n: np.ndarray
    blast_impulses_ns: np.ndarray
    stresses_pa: np.ndarray
    von_mises_pa: np.ndarray
    connection_names: np.ndarray
    pairs: np.ndarray
    points_m: np.ndarray
    areas_m2: np.ndarray
    normals: np.ndarray
    second_moments_m4: np.ndarray
    connection_forces_n: np.ndarray
    connection_moments_nm: np.ndarray
    connection_peaks_n: np.ndarray
    connection_peak_forces_n: np.ndarray
    connection_peak_moments_nm: np.ndarray
    intact: np.ndarray
    balls: np.ndarray
    ball_times_s: np.ndarray
    ball_impulses_ns: np.ndarray
    ball_velocities_m_s: np.ndarray

    def of_kind(self, kind: str) -> np.ndarray:
        """Indices of the bodies of a kind."""
        return np.flatnonzero(self.body_kinds == kind)

    def vertices_of(self, body: int) -> np.ndarray:
        """Vertices (v, 3) of a body in its own axes, m."""
        first = int(self.vertex_counts[:body].sum())
        return self.vertices_m[first : first + self.vertex_counts[body]]

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
