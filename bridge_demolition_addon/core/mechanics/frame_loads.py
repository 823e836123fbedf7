"""Loads on bodies and connections over one frame, gathered from its sub-steps: means, peaks and impulses."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields

import numpy as np

from ..geometry.vectors import length
from .forces import magnitude_sums, resultants
from .stress import average_stress, average_stress_of_moments, von_mises


@dataclass(frozen=True, slots=True, eq=False)
class SubstepLoads:
    """Loads of one sub-step on n bodies by m connections and k contact points.

    Contacts come as impulses, as Bullet keeps them. Loads of connections are forces: Bullet has divided them by the
    sub-step already.

    Attributes
    ----------
    substep_s : float
        How long the sub-step was.
    connection_forces_n, connection_moments_nm : (m, 3) float
        Force on the first body of each connection, and moment about the connection's own point.
    connection_points_m : (m, 3) float
        Where the connections are.
    signed_2019_ns : (m,) float
        The one number that Bullet keeps of a connection, an impulse.
    contact_pairs : (k, 2) int
        Bodies in contact.
    contact_impulses_ns, contact_points_m : (k, 3) float
        Impulse on the first of them, and where it acts.
    centres_m, rotations : (n, 3) float, (n, 3, 3) float
        Centres of mass and rotations of all bodies.
    """

    substep_s: float
    connection_forces_n: np.ndarray
    connection_moments_nm: np.ndarray
    connection_points_m: np.ndarray
    signed_2019_ns: np.ndarray
    contact_pairs: np.ndarray
    contact_impulses_ns: np.ndarray
    contact_points_m: np.ndarray
    centres_m: np.ndarray
    rotations: np.ndarray


@dataclass(frozen=True, slots=True, eq=False)
class FrameLoads:
    """Loads of one frame on n bodies and m connections.

    Forces on a body are those of its connections and contacts together, without gravity.

    Attributes
    ----------
    body_forces_n, body_peaks_n : (n, 3) float, (n,) float
        Mean of the resultant, and its largest magnitude.
    body_sums_n, body_peak_sums_n : (n,) float
        Mean and largest of the sum of the magnitudes.
    body_contact_impulses_ns : (n, 3) float
        Impulse of the contacts.
    body_signed_2019_n : (n,) float
        Mean of what the add-on of 2019 calls the contact force: the numbers that Bullet keeps of its connections, added
        or taken off with their signs. For comparison only.
    stresses_pa : (n, 3, 3) float
        Average stress under the mean loads, tension positive.
    von_mises_pa : (n,) float
        Equivalent stress in the sub-step in which all loads together were largest.
    connection_forces_n, connection_moments_nm : (m, 3) float
        Mean force on the first body of each pair, and moment about the connection's own point.
    connection_peaks_n : (m,) float
        Largest magnitude of the force.
    connection_peak_forces_n, connection_peak_moments_nm : (m, 3) float
        Force and moment in the sub-step that had it.
    """

    body_forces_n: np.ndarray
    body_peaks_n: np.ndarray
    body_sums_n: np.ndarray
    body_peak_sums_n: np.ndarray
    body_contact_impulses_ns: np.ndarray
    body_signed_2019_n: np.ndarray
    stresses_pa: np.ndarray
    von_mises_pa: np.ndarray
    connection_forces_n: np.ndarray
    connection_moments_nm: np.ndarray
    connection_peaks_n: np.ndarray
    connection_peak_forces_n: np.ndarray
    connection_peak_moments_nm: np.ndarray

    def unknown(self) -> FrameLoads:
        """Return loads of the same shape of which nothing is known: nan throughout."""
        return FrameLoads(*(np.full_like(getattr(self, each.name), np.nan) for each in fields(self)))


class LoadAccumulator:
    """Adds up the loads of a frame, sub-step by sub-step.

    Stress is calculated twice a frame and not for every sub-step, which would cost more than all the rest: from the
    mean loads, and from those of the sub-step in which all loads together were largest.

    Parameters
    ----------
    pairs : (m, 2) int
        Bodies of the connections.
    volumes_m3 : (n,) float
        Volumes of the bodies; 0 for a body without stress.
    normals_at : function
        Gives the unit normals (m, 3) of the connections under given rotations (n, 3, 3) of the bodies.
    """

    def __init__(self, pairs: np.ndarray, volumes_m3: np.ndarray, normals_at: Callable[[np.ndarray], np.ndarray]):
        self._pairs, self._volumes, self._normals_at = pairs, volumes_m3, normals_at
        self.begin()

    def begin(self) -> None:
        """Begin a new frame."""
        connections, bodies = len(self._pairs), len(self._volumes)
        self._duration_s = 0.0
        self._last: SubstepLoads | None = None
        self._largest: SubstepLoads | None = None
        self._largest_sum_n = -1.0
        # Time integrals: N·s, N·m·s and Pa·s.
        self._connection_impulses, self._connection_angular_impulses = np.zeros((2, connections, 3))
        self._sum_impulses, self._signed_impulses = np.zeros((2, bodies))
        self._contact_impulses = np.zeros((bodies, 3))
        self._contact_stress_impulses = np.zeros((bodies, 3, 3))
        self._connection_peaks = np.zeros(connections)
        self._connection_peak_forces, self._connection_peak_moments = np.zeros((2, connections, 3))
        self._body_peaks, self._body_peak_sums = np.zeros((2, bodies))

    def add(self, loads: SubstepLoads) -> np.ndarray:
        """Add the loads of one sub-step. Return the resultant force (n, 3) on every body."""
        count, substep_s = len(self._volumes), loads.substep_s
        by_contacts = resultants(loads.contact_pairs, loads.contact_impulses_ns, count)
        resultant = resultants(self._pairs, loads.connection_forces_n, count) + by_contacts / substep_s
        magnitudes = length(loads.connection_forces_n)
        of_contacts = magnitude_sums(loads.contact_pairs, length(loads.contact_impulses_ns), count) / substep_s
        sums = magnitude_sums(self._pairs, magnitudes, count) + of_contacts
        self._note_peaks(loads, magnitudes, resultant, sums)
        self._connection_impulses += substep_s * loads.connection_forces_n
        self._connection_angular_impulses += substep_s * loads.connection_moments_nm
        self._sum_impulses += substep_s * sums
        self._signed_impulses += self._signed(loads.signed_2019_ns)
        self._contact_impulses += by_contacts
        self._contact_stress_impulses += self._stress_impulses_of_contacts(loads)
        self._duration_s += substep_s
        self._last = loads
        return resultant

    def finish(self) -> FrameLoads:
        """Return means and peaks of the frame so far, and the impulses of contacts; all 0 where no time passed."""
        per_second = 1.0 / self._duration_s if self._duration_s else 0.0
        forces, moments = per_second * self._connection_impulses, per_second * self._connection_angular_impulses
        stresses, peak_stresses = per_second * self._contact_stress_impulses, np.zeros((len(self._volumes), 3, 3))
        if self._last:
            stresses += self._stresses_of_connections(self._last, forces, moments)
            largest = self._largest
            peak_stresses = self._stress_impulses_of_contacts(largest) / largest.substep_s
            peak_stresses += self._stresses_of_connections(
                largest, largest.connection_forces_n, largest.connection_moments_nm
            )
        by_connections = resultants(self._pairs, forces, len(self._volumes))
        return FrameLoads(
            body_forces_n=by_connections + per_second * self._contact_impulses,
            body_peaks_n=self._body_peaks,
            body_sums_n=per_second * self._sum_impulses,
            body_peak_sums_n=self._body_peak_sums,
            body_contact_impulses_ns=self._contact_impulses,
            body_signed_2019_n=per_second * self._signed_impulses,
            stresses_pa=stresses,
            von_mises_pa=von_mises(peak_stresses),
            connection_forces_n=forces,
            connection_moments_nm=moments,
            connection_peaks_n=self._connection_peaks,
            connection_peak_forces_n=self._connection_peak_forces,
            connection_peak_moments_nm=self._connection_peak_moments,
        )

    def _note_peaks(self, loads: SubstepLoads, magnitudes: np.ndarray, resultant: np.ndarray, sums: np.ndarray) -> None:
        higher = np.flatnonzero(magnitudes > self._connection_peaks)
        self._connection_peak_forces[higher] = loads.connection_forces_n[higher]
        self._connection_peak_moments[higher] = loads.connection_moments_nm[higher]
        for peaks, values in (
            (self._connection_peaks, magnitudes),
            (self._body_peaks, length(resultant)),
            (self._body_peak_sums, sums),
        ):
            np.maximum(peaks, values, out=peaks)
        total = np.nan_to_num(sums.sum(), nan=np.inf)  # loads that are not known must not pass for small ones
        if total > self._largest_sum_n:
            self._largest, self._largest_sum_n = loads, total

    def _signed(self, values: np.ndarray) -> np.ndarray:
        """Sum over the connections of every body, added for their first bodies and taken off for their second."""
        first, second = self._pairs.T
        count = len(self._volumes)
        return np.bincount(first, values, count) - np.bincount(second, values, count)

    def _stress_impulses_of_contacts(self, loads: SubstepLoads) -> np.ndarray:
        """Stresses (n, 3, 3) under the contacts of a sub-step times its length, Pa·s."""
        return self._stresses(loads.contact_pairs, loads.contact_impulses_ns, loads.contact_points_m, loads.centres_m)

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
