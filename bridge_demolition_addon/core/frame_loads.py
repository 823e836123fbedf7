"""Loads on bodies and connections over one frame, gathered from its sub-steps: means, peaks and impulses."""

from __future__ import annotations

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
    connection_points_m, connection_normals
        (m, 3) where the connections are, and unit vectors from their first to their second bodies.
    signed_2019_n
        (m,) the one number that Bullet keeps of a connection, as a force.
    contact_pairs, contact_forces_n, contact_points_m
        (k, 2) bodies, (k, 3) force on the first of them and (k, 3) where it acts.
    centres_m
        (n, 3) centres of mass.
    """

    connection_forces_n: np.ndarray
    connection_moments_nm: np.ndarray
    connection_points_m: np.ndarray
    connection_normals: np.ndarray
    signed_2019_n: np.ndarray
    contact_pairs: np.ndarray
    contact_forces_n: np.ndarray
    contact_points_m: np.ndarray
    centres_m: np.ndarray


class FrameLoads:
    """Gathers the loads of a frame.

    Parameters
    ----------
    pairs
        (m, 2) bodies of the connections.
    volumes_m3
        (n,) volumes of the bodies; 0 for a body without stress.
    """

    def __init__(self, pairs: np.ndarray, volumes_m3: np.ndarray):
        self._pairs, self._volumes = pairs, volumes_m3
        self.begin()

    def begin(self) -> None:
        """Forget everything: a new frame begins."""
        connections, bodies = len(self._pairs), len(self._volumes)
        self._duration_s = 0.0
        self._means = {
            "connection_forces_n": np.zeros((connections, 3)),
            "connection_moments_nm": np.zeros((connections, 3)),
            "body_forces_n": np.zeros((bodies, 3)),
            "body_sums_n": np.zeros(bodies),
            "body_signed_2019_n": np.zeros(bodies),
            "stresses_pa": np.zeros((bodies, 3, 3)),
        }
        self._peaks = {
            "connection_peaks_n": np.zeros(connections),
            "body_peaks_n": np.zeros(bodies),
            "body_peak_sums_n": np.zeros(bodies),
            "von_mises_pa": np.zeros(bodies),
        }
        self._at_peak = {
            "connection_peak_forces_n": np.zeros((connections, 3)),
            "connection_peak_moments_nm": np.zeros((connections, 3)),
        }
        self._contact_impulses = np.zeros((bodies, 3))

    def add(self, loads: SubstepLoads, substep_s: float) -> None:
        """Add the loads of one sub-step of a length in s."""
        count = len(self._volumes)
        of_connections, of_contacts = (
            (self._pairs, loads.connection_forces_n, count),
            (loads.contact_pairs, loads.contact_forces_n, count),
        )
        by_contacts = resultants(*of_contacts)
        resultant = resultants(*of_connections) + by_contacts
        sums = magnitude_sums(*of_connections) + magnitude_sums(*of_contacts)
        stresses = self._stresses(loads)
        self._note_peaks(loads, resultant, sums, stresses)
        for name, values in (
            ("connection_forces_n", loads.connection_forces_n),
            ("connection_moments_nm", loads.connection_moments_nm),
            ("body_forces_n", resultant),
            ("body_sums_n", sums),
            ("body_signed_2019_n", self._signed(loads.signed_2019_n)),
            ("stresses_pa", stresses),
        ):
            self._means[name] += substep_s * values
        self._contact_impulses += substep_s * by_contacts
        self._duration_s += substep_s

    def finish(self) -> dict[str, np.ndarray]:
        """Means and peaks of the frame so far, and the impulses of contacts; all 0 where no time passed."""
        share = 1.0 / self._duration_s if self._duration_s else 0.0
        means = {name: share * values for name, values in self._means.items()}
        return {**means, **self._peaks, **self._at_peak, "body_contact_impulses_ns": self._contact_impulses}

    def _note_peaks(self, loads: SubstepLoads, resultant: np.ndarray, sums: np.ndarray, stresses: np.ndarray) -> None:
        magnitudes = np.linalg.norm(loads.connection_forces_n, axis=1)
        higher = magnitudes > self._peaks["connection_peaks_n"]
        self._at_peak["connection_peak_forces_n"][higher] = loads.connection_forces_n[higher]
        self._at_peak["connection_peak_moments_nm"][higher] = loads.connection_moments_nm[higher]
        for name, values in (
            ("connection_peaks_n", magnitudes),
            ("body_peaks_n", np.linalg.norm(resultant, axis=1)),
            ("body_peak_sums_n", sums),
            ("von_mises_pa", von_mises(stresses)),
        ):
            np.maximum(self._peaks[name], values, out=self._peaks[name])

    def _signed(self, values: np.ndarray) -> np.ndarray:
        """Sum over the connections of every body, added for their first bodies and taken off for their second."""
        return np.bincount(self._pairs.T.ravel(), np.concatenate((values, -values)), len(self._volumes))

    def _stresses(self, loads: SubstepLoads) -> np.ndarray:
        forces = np.concatenate((loads.connection_forces_n, loads.contact_forces_n))
        points = np.concatenate((loads.connection_points_m, loads.contact_points_m))
        bodies = np.concatenate((self._pairs, loads.contact_pairs)).T.ravel()
        of_forces = average_stress(
            bodies, np.concatenate((forces, -forces)), np.concatenate((points, points)), loads.centres_m, self._volumes
        )
        normals, moments = loads.connection_normals, loads.connection_moments_nm
        of_moments = average_stress_of_moments(
            self._pairs.T.ravel(),
            np.concatenate((moments, -moments)),
            np.concatenate((normals, -normals)),
            self._volumes,
        )
        return np.nan_to_num(of_forces + of_moments)
