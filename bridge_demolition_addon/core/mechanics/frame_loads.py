"""Loads on bodies and connections over one frame, gathered from its sub-steps: means, peaks and impulses."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .forces import magnitude_sums, resultants
from .stress import average_stress, average_stress_of_moments, von_mises


@dataclass(frozen=True, slots=True)
class SubstepLoads:
    """Loads of one sub-step on n bodies by m connections and k contact points.

    Attributes
    ----------
    connection_forces_n, connection_moments_nm
        (m, 3) force on the first body of each connection, and moment about the connection's own point.
    connection_points_m
        (m, 3) where the connections are.
    signed_2019_n
        (m,) the one number that Bullet keeps of a connection, as a force.
    contact_pairs, contact_forces_n, contact_points_m
        (k, 2) bodies, (k, 3) force on the first of them and (k, 3) where it acts.
    centres_m, rotations
        (n, 3) centres of mass and (n, 3, 3) of all bodies.
    """

    connection_forces_n: np.ndarray
    connection_moments_nm: np.ndarray
    connection_points_m: np.ndarray
    signed_2019_n: np.ndarray
    contact_pairs: np.ndarray
    contact_forces_n: np.ndarray
    contact_points_m: np.ndarray
    centres_m: np.ndarray
    rotations: np.ndarray


class FrameLoads:
    """Gathers the loads of a frame.

    Stress is worked out twice a frame and not for every sub-step, which would cost more than all the rest: from the
    mean loads, and from those of the sub-step in which all loads together were largest.

    Parameters
    ----------
    pairs
        (m, 2) bodies of the connections.
    volumes_m3
        (n,) volumes of the bodies; 0 for a body without stress.
    normals_at
        Gives the unit normals (m, 3) of the connections under given rotations (n, 3, 3) of the bodies.
    """

    def __init__(self, pairs: np.ndarray, volumes_m3: np.ndarray, normals_at: Callable[[np.ndarray], np.ndarray]):
        self._pairs, self._volumes, self._normals_at = pairs, volumes_m3, normals_at
        self.begin()

    def begin(self) -> None:
        """Forget everything: a new frame begins."""
        connections, bodies = len(self._pairs), len(self._volumes)
        self._duration_s = 0.0
        self._last: SubstepLoads | None = None
        self._largest: SubstepLoads | None = None
        self._largest_sum_n = -1.0
        self._means = {
            "connection_forces_n": np.zeros((connections, 3)),
            "connection_moments_nm": np.zeros((connections, 3)),
            "body_sums_n": np.zeros(bodies),
            "body_signed_2019_n": np.zeros(bodies),
        }
        self._peaks = {
            "connection_peaks_n": np.zeros(connections),
            "body_peaks_n": np.zeros(bodies),
            "body_peak_sums_n": np.zeros(bodies),
        }
        self._at_peak = {
            "connection_peak_forces_n": np.zeros((connections, 3)),
            "connection_peak_moments_nm": np.zeros((connections, 3)),
        }
        self._contact_impulses = np.zeros((bodies, 3))
        self._contact_stresses = np.zeros((bodies, 3, 3))

    def add(self, loads: SubstepLoads, substep_s: float) -> None:
        """Add the loads of one sub-step of a length in s."""
        count = len(self._volumes)
        by_contacts = resultants(loads.contact_pairs, loads.contact_forces_n, count)
        resultant = resultants(self._pairs, loads.connection_forces_n, count) + by_contacts
        magnitudes = _lengths(loads.connection_forces_n)
        of_contacts = magnitude_sums(loads.contact_pairs, _lengths(loads.contact_forces_n), count)
        sums = magnitude_sums(self._pairs, magnitudes, count) + of_contacts
        self._note_peaks(loads, magnitudes, resultant, sums)
        for name, values in (
            ("connection_forces_n", loads.connection_forces_n),
            ("connection_moments_nm", loads.connection_moments_nm),
            ("body_sums_n", sums),
            ("body_signed_2019_n", self._signed(loads.signed_2019_n)),
        ):
            self._means[name] += substep_s * values
        self._contact_impulses += substep_s * by_contacts
        self._contact_stresses += substep_s * self._stresses_of_contacts(loads)
        self._duration_s += substep_s
        self._last = loads

    def finish(self) -> dict[str, np.ndarray]:
        """Means and peaks of the frame so far, and the impulses of contacts; all 0 where no time passed."""
        share = 1.0 / self._duration_s if self._duration_s else 0.0
        means = {name: share * values for name, values in self._means.items()}
        by_connections = resultants(self._pairs, means["connection_forces_n"], len(self._volumes))
        stresses, peak_stresses = share * self._contact_stresses, np.zeros_like(self._contact_stresses)
        if self._last:
            stresses += self._stresses_of_connections(
                self._last, means["connection_forces_n"], means["connection_moments_nm"]
            )
            forces, moments = self._largest.connection_forces_n, self._largest.connection_moments_nm
            peak_stresses = self._stresses_of_contacts(self._largest)
            peak_stresses += self._stresses_of_connections(self._largest, forces, moments)
        return {
            **means,
            **self._peaks,
            **self._at_peak,
            "body_forces_n": by_connections + share * self._contact_impulses,
            "body_contact_impulses_ns": self._contact_impulses,
            "stresses_pa": stresses,
            "von_mises_pa": von_mises(peak_stresses),
        }

    def _note_peaks(self, loads: SubstepLoads, magnitudes: np.ndarray, resultant: np.ndarray, sums: np.ndarray) -> None:
        higher = np.flatnonzero(magnitudes > self._peaks["connection_peaks_n"])
        self._at_peak["connection_peak_forces_n"][higher] = loads.connection_forces_n[higher]
        self._at_peak["connection_peak_moments_nm"][higher] = loads.connection_moments_nm[higher]
        for name, values in (
            ("connection_peaks_n", magnitudes),
            ("body_peaks_n", _lengths(resultant)),
            ("body_peak_sums_n", sums),
        ):
            np.maximum(self._peaks[name], values, out=self._peaks[name])
        total = np.nan_to_num(sums.sum(), nan=np.inf)  # loads that are not known must not pass for small ones
        if total > self._largest_sum_n:
            self._largest, self._largest_sum_n = loads, total

    def _signed(self, values: np.ndarray) -> np.ndarray:
        """Sum over the connections of every body, added for their first bodies and taken off for their second."""
        first, second = self._pairs.T
        count = len(self._volumes)
        return np.bincount(first, values, count) - np.bincount(second, values, count)

    def _stresses_of_contacts(self, loads: SubstepLoads) -> np.ndarray:
        forces, points = loads.contact_forces_n, loads.contact_points_m
        return self._stresses(loads.contact_pairs, forces, points, loads.centres_m)

    def _stresses_of_connections(self, loads: SubstepLoads, forces: np.ndarray, moments: np.ndarray) -> np.ndarray:
        """Stresses (n, 3, 3) under forces and moments (m, 3) of the connections, where they are in a sub-step."""
        normals = self._normals_at(loads.rotations)
        of_moments = average_stress_of_moments(
            self._pairs.T.ravel(),
            np.concatenate((moments, -moments)),
            np.concatenate((normals, -normals)),
            self._volumes,
        )
        of_forces = self._stresses(self._pairs, forces, loads.connection_points_m, loads.centres_m)
        return of_forces + self._of_solids(of_moments)

    def _stresses(self, pairs: np.ndarray, forces: np.ndarray, points: np.ndarray, centres: np.ndarray) -> np.ndarray:
        """Stresses under forces (k, 3) on the first bodies of pairs (k, 2), and their opposites on the second."""
        both, twice = np.concatenate((forces, -forces)), np.concatenate((points, points))
        return self._of_solids(average_stress(pairs.T.ravel(), both, twice, centres, self._volumes))

    def _of_solids(self, stresses: np.ndarray) -> np.ndarray:
        """Stresses (n, 3, 3), 0 for bodies without a volume; what is nan because its loads are stays nan."""
        return np.where(self._volumes[:, None, None] > 0.0, stresses, 0.0)


def _lengths(vectors: np.ndarray) -> np.ndarray:
    return np.sqrt(np.einsum("ki,ki->k", vectors, vectors))
