"""Loads on bodies and connections over one frame, gathered from its sub-steps: means, peaks and impulses."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import cached_property

import numpy as np

from ..arrays import FloatArray, IntArray
from ..core.calls import call
from ..core.structs import Count, Doubles, Indices, Struct, WrittenDoubles
from ..geometry.vectors import as_components, as_vectors, length
from .stress import PairSums, average_stress, von_mises


@dataclass(frozen=True, eq=False)
class SubstepLoads:
    """Loads of s sub-steps that follow each other, on n bodies by m connections and k contact points.

    Contacts come as impulses, as Bullet keeps them. Loads of connections are forces: Bullet has divided them by the
    sub-step already. Both are on the first body of a pair.
    """

    substeps_s: FloatArray  # (s,), lengths
    connection_forces_n: FloatArray  # (s, m, 3)
    connection_moments_nm: FloatArray  # (s, m, 3), about the connection's own point
    connection_points_m: FloatArray  # (s, m, 3)
    signed_2019_ns: FloatArray  # (s, m), the one number that Bullet keeps of a connection, an impulse
    contact_substeps: IntArray  # (k,), in ascending order
    contact_pairs: IntArray  # (k, 2)
    contact_impulses_ns: FloatArray  # (k, 3)
    contact_points_m: FloatArray  # (k, 3)
    centres_m: FloatArray  # (s, n, 3), of mass
    rotations: FloatArray  # (s, n, 3, 3)

    @cached_property
    def connection_impulses_ns(self) -> FloatArray:
        """Impulses (s, m, 3) of the connections in each sub-step."""
        return self.substeps_s[:, None, None] * self.connection_forces_n

    @cached_property
    def connection_angular_impulses_nms(self) -> FloatArray:
        """Impulses (s, m, 3) of their moments in each sub-step."""
        return self.substeps_s[:, None, None] * self.connection_moments_nm

    def contacts_of(self, substep: int) -> slice:
        """Return which contacts are in a sub-step."""
        return slice(*np.searchsorted(self.contact_substeps, (substep, substep + 1)).tolist())

    def moment(self, substep: int) -> Moment:
        """Return the loads of one sub-step."""
        contacts = self.contacts_of(substep)
        return Moment(
            float(self.substeps_s[substep]),
            self.connection_forces_n[substep],
            self.connection_moments_nm[substep],
            self.connection_points_m[substep],
            self.contact_pairs[contacts],
            self.contact_impulses_ns[contacts],
            self.contact_points_m[contacts],
            self.centres_m[substep],
            self.rotations[substep],
        )


@dataclass(frozen=True, slots=True, eq=False)
class Moment:
    """Loads of one of the sub-steps of `SubstepLoads`, without their axis of sub-steps."""

    substep_s: float
    connection_forces_n: FloatArray
    connection_moments_nm: FloatArray
    connection_points_m: FloatArray
    contact_pairs: IntArray
    contact_impulses_ns: FloatArray
    contact_points_m: FloatArray
    centres_m: FloatArray
    rotations: FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class FrameLoads:
    """Loads of one frame on n bodies and m connections.

    The force on a body sums its connections and contacts, without gravity. Loads of a connection are on its first body,
    about the connection's own point.
    """

    body_forces_n: FloatArray  # (n, 3), mean of the resultant
    body_peaks_n: FloatArray  # (n,), its largest magnitude
    body_sums_n: FloatArray  # (n,), mean of the sum of the magnitudes
    body_peak_sums_n: FloatArray  # (n,), its largest
    body_contact_impulses_ns: FloatArray  # (n, 3)
    # (n,), mean of the contact force of the add-on of 2019, for comparison only: the numbers that Bullet keeps of the
    # body's connections, added or taken off with their signs.
    body_signed_2019_n: FloatArray
    stresses_pa: FloatArray  # (n, 3, 3), average stress under the mean loads, tension positive
    von_mises_pa: FloatArray  # (n,), equivalent stress in the sub-step in which all loads together were largest
    connection_forces_n: FloatArray  # (m, 3), mean
    connection_moments_nm: FloatArray  # (m, 3), mean
    connection_peaks_n: FloatArray  # (m,), largest magnitude of the force
    connection_peak_forces_n: FloatArray  # (m, 3), force in the sub-step of that peak
    connection_peak_moments_nm: FloatArray  # (m, 3)
    # (n,), largest part of their rupture strain that bars across cracks of the body used; None where no bars are known
    body_bar_use: FloatArray | None = None
    # (m,), as the frame ends: BARS_HOLD where bars hold a connection that has cracked, BARS_YIELDED where they have
    # yielded, 0 of others; None of runs that did not record it
    connection_bars: FloatArray | None = None

    def unknown(self) -> FrameLoads:
        """Return unknown loads of the same shape: nan throughout."""
        known = {item.name: getattr(self, item.name) for item in fields(self)}
        return FrameLoads(
            **{name: np.full_like(values, np.nan) for name, values in known.items() if values is not None}
        )


class CoreFrameLoads(Struct):
    """Loads of connections in the sub-steps of a frame: `bda_frame_loads`."""

    _fields_ = (
        *((name, Count) for name in ("substeps", "connections", "bodies")),
        ("pairs", Indices),
        *((name, Doubles) for name in ("forces", "moments", "signs", "lengths")),
        *((name, WrittenDoubles) for name in ("impulses", "peaks", "of_first", "of_second")),
    )


class LoadAccumulator:
    """Adds up the loads of a frame, some sub-steps at a time; how many makes no difference, to the last bit.

    Stress is calculated twice a frame and not for every sub-step, which would cost more than all the rest: from the
    mean loads, and from the loads of the sub-step in which they were largest together.

    A body with a volume of 0 has no stress. `normals_at` gives the unit normals (m, 3) of the connections under
    rotations (n, 3, 3) of the bodies.
    """

    def __init__(self, pairs: IntArray, volumes_m3: FloatArray, normals_at: Callable[[FloatArray], FloatArray]):
        self._pairs, self._volumes, self._normals_at = pairs, volumes_m3, normals_at
        self.begin()

    def begin(self) -> None:
        """Begin a new frame."""
        connections, bodies = len(self._pairs), len(self._volumes)
        self._duration_s = 0.0
        self._last: Moment | None = None
        self._largest: Moment | None = None
        self._largest_sum_n = -1.0
        # Time integrals: N·s, N·m·s and Pa·s.
        self._connection_impulses = np.zeros((6, connections))  # of forces, then of moments
        self._sum_impulses, self._signed_impulses = np.zeros((2, bodies))
        (self._contact_impulses,) = _vectors(1, bodies)
        self._contact_stress_impulses = np.zeros((bodies, 3, 3))
        self._connection_peaks = np.zeros((7, connections))  # size of the largest force, that force and its moment
        self._body_peaks, self._body_peak_sums = np.zeros((2, bodies))

    def add(self, loads: SubstepLoads) -> FloatArray:
        """Add the loads of some sub-steps. Return the resultant force (s, n, 3) on every body in each."""
        shape, substeps_s = (len(loads.substeps_s), len(self._volumes)), loads.substeps_s
        resultants_n, sums, signed = self._of_connections(loads, shape)
        if len(loads.contact_substeps):
            of_contacts = PairSums(loads.contact_pairs, loads.contact_substeps, shape)
            by_contacts = of_contacts.resultants(loads.contact_impulses_ns)
            resultants_n += by_contacts / substeps_s[:, None, None]
            sums += of_contacts.sums(length(loads.contact_impulses_ns)) / substeps_s[:, None]
            self._add_contacts(loads, by_contacts)
        self._note_peaks(loads, length(resultants_n), sums)
        sum_impulses = substeps_s[:, None] * sums
        for substep, substep_s in enumerate(substeps_s.tolist()):
            self._sum_impulses += sum_impulses[substep]
            self._signed_impulses += signed[substep]
            self._duration_s += substep_s
        self._last = loads.moment(-1 % shape[0])
        return resultants_n

    def finish(self) -> FrameLoads:
        """Return means and peaks of the frame so far, and the impulses of contacts; all 0 where no time passed."""
        per_second = 1.0 / self._duration_s if self._duration_s else 0.0
        forces, moments = (
            per_second * as_vectors(half) for half in (self._connection_impulses[:3], self._connection_impulses[3:])
        )
        stresses, peak_stresses = per_second * self._contact_stress_impulses, np.zeros((len(self._volumes), 3, 3))
        if self._last:
            largest = self._largest or self._last
            stresses += self._stresses_of_connections(self._last, forces, moments)
            peak_stresses = self._stress_impulses_of_contacts(largest) / largest.substep_s
            peak_stresses += self._stresses_of_connections(
                largest, largest.connection_forces_n, largest.connection_moments_nm
            )
        by_connections = PairSums(self._pairs, None, (1, len(self._volumes))).resultants(forces[None])[0]
        return FrameLoads(
            body_forces_n=np.ascontiguousarray(by_connections + per_second * self._contact_impulses),
            body_peaks_n=self._body_peaks,
            body_sums_n=per_second * self._sum_impulses,
            body_peak_sums_n=self._body_peak_sums,
            body_contact_impulses_ns=np.ascontiguousarray(self._contact_impulses),
            body_signed_2019_n=per_second * self._signed_impulses,
            stresses_pa=stresses,
            von_mises_pa=von_mises(peak_stresses),
            connection_forces_n=np.ascontiguousarray(forces),
            connection_moments_nm=np.ascontiguousarray(moments),
            connection_peaks_n=self._connection_peaks[0],
            connection_peak_forces_n=np.ascontiguousarray(self._connection_peaks[1:4].T),
            connection_peak_moments_nm=np.ascontiguousarray(self._connection_peaks[4:].T),
        )

    def _of_connections(self, loads: SubstepLoads, shape: tuple[int, int]) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Add what connections carry; return resultants (s, n, 3), sums of sizes and of signed numbers (s, n)."""
        (substeps, bodies), count = shape, len(self._pairs)
        of_first, of_second = np.zeros((2, 5, substeps, bodies))
        of_frame = CoreFrameLoads(substeps=substeps, connections=count, bodies=bodies)
        of_frame.take(
            pairs=(self._pairs, 2 * count),
            forces=(as_components(loads.connection_forces_n), 3 * substeps * count),
            moments=(as_components(loads.connection_moments_nm), 3 * substeps * count),
            signs=(loads.signed_2019_ns, substeps * count),
            lengths=(loads.substeps_s, substeps),
            impulses=(self._connection_impulses, 6 * count),
            peaks=(self._connection_peaks, 7 * count),
            of_first=(of_first, 5 * substeps * bodies),
            of_second=(of_second, 5 * substeps * bodies),
        )
        call("bda_add_frame_loads", of_frame)
        return as_vectors(of_first[:3] - of_second[:3]), of_first[3] + of_second[3], of_first[4] - of_second[4]

    def _add_contacts(self, loads: SubstepLoads, by_contacts: FloatArray) -> None:
        substeps, count = by_contacts.shape[:2]
        stresses = average_stress(
            loads.contact_pairs + count * loads.contact_substeps[:, None],
            loads.contact_impulses_ns,
            loads.contact_points_m,
            loads.centres_m.reshape(-1, 3),
            np.tile(self._volumes, substeps),
        )
        for impulses, stress in zip(by_contacts, stresses.reshape(substeps, count, 3, 3), strict=True):
            self._contact_impulses += impulses
            self._contact_stress_impulses += stress

    def _note_peaks(self, loads: SubstepLoads, resultants: FloatArray, sums: FloatArray) -> None:
        """Follow the largest resultant and sum (s, n) on each body, and the sub-step in which all were largest."""
        np.maximum(self._body_peaks, resultants.max(axis=0), out=self._body_peaks)
        np.maximum(self._body_peak_sums, sums.max(axis=0), out=self._body_peak_sums)
        for substep in range(len(sums)):
            # Loads that are not known must not pass for small ones.
            total = float(sums[substep].sum())
            total = math.inf if math.isnan(total) else total
            if total > self._largest_sum_n:
                self._largest, self._largest_sum_n = loads.moment(substep), total

    def _stress_impulses_of_contacts(self, loads: Moment) -> FloatArray:
        """Stresses (n, 3, 3) under the contacts of a sub-step times its length, Pa·s."""
        pairs, impulses, points = loads.contact_pairs, loads.contact_impulses_ns, loads.contact_points_m
        return average_stress(pairs, impulses, points, loads.centres_m, self._volumes)

    def _stresses_of_connections(self, loads: Moment, forces: FloatArray, moments: FloatArray) -> FloatArray:
        """Stresses (n, 3, 3) under forces and moments (m, 3) of the connections, where they are in a sub-step."""
        places = loads.connection_points_m, loads.centres_m, self._volumes
        return average_stress(self._pairs, forces, *places, moments, self._normals_at(loads.rotations))


def _vectors(*shape: int) -> FloatArray:
    """Vectors (k, n, 3) that are 0, whose components lie together in memory."""
    return np.moveaxis(np.zeros((shape[0], 3, shape[1])), 1, -1)
