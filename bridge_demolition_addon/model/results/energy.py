"""Energy of a run: potential, of motion and rotation, what is lost of their sum, and what Bullet's solver made."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from ...engineering.geometry.vectors import dot, transformed_back
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...texts import Text
from .arrays import Results
from .frames import Frame
from .motion import MOVED_M, throw

_SPHERE = 0.4
"""MomentOfRun of inertia of a solid sphere by mass and radius squared."""


@dataclass(frozen=True, eq=False, slots=True)
class Energy:
    """Energies of the bodies that can move, over k recorded steps, (k,) J.

    `potential_j` is above its lowest step, so that it is never negative.
    """

    times_s: np.ndarray
    potential_j: np.ndarray
    translation_j: np.ndarray
    rotation_j: np.ndarray

    @property
    def kinetic_j(self) -> np.ndarray:
        return self.translation_j + self.rotation_j

    @property
    def dissipated_j(self) -> np.ndarray:
        """Return the energy lost since the first step, (k,): into impacts, friction, damping and breaking.

        Negative where something else than gravity does work, such as charges, a prescribed motion, or the solver.
        """
        total = self.potential_j + self.kinetic_j
        return total[0] - total


def energy_of(results: Results, gravity_m_s2: float = STANDARD_GRAVITY_M_S2) -> Energy:
    """Return the energies of the bodies that can move, rotation by the `moments_of_inertia` of the simulation."""
    masses, frames = results.inventory.masses_kg, results.frames
    potentials = (gravity_m_s2 * frames.positions_m[:, :, 2] * masses).sum(axis=1)
    angular_velocities_rad_s = transformed_back(frames.rotations, frames.angular_velocities_rad_s)
    return Energy(
        times_s=frames.time_s,
        potential_j=potentials - potentials.min(),
        translation_j=0.5 * (dot(frames.velocities_m_s, frames.velocities_m_s) * masses).sum(axis=1),
        rotation_j=0.5 * (np.square(angular_velocities_rad_s) * moments_of_inertia(results)).sum(axis=(1, 2)),
    )


def kinetic_energies(frame: Frame, masses_kg: np.ndarray, moments_kg_m2: np.ndarray) -> np.ndarray:
    """Return the kinetic energy (n,) of each body in a frame, J, with what `moments_of_inertia` gives."""
    angular_velocities_rad_s = transformed_back(frame.rotations, frame.angular_velocities_rad_s)
    translation = dot(frame.velocities_m_s, frame.velocities_m_s) * masses_kg
    return 0.5 * (translation + (np.square(angular_velocities_rad_s) * moments_kg_m2).sum(axis=1))


def moments_of_inertia(results: Results) -> np.ndarray:
    """Return the moments of inertia (n, 3) about each body's own axes as Bullet uses them, kg·m².

    A ball is a sphere. Bullet takes a convex hull for the box around it, in the body's own axes: for a shard up to
    twice what its true shape has.
    """
    inventory, masses = results.inventory, results.inventory.masses_kg
    moments = np.zeros((len(masses), 3))
    bodies = np.flatnonzero((masses > 0.0) & (inventory.vertex_counts > 0))
    if not len(bodies):
        return moments
    own = inventory.vertices_by_body()
    squares = np.square([np.ptp(own[body], axis=0) for body in bodies])
    moments[bodies] = masses[bodies, None] * (squares.sum(axis=1, keepdims=True) - squares) / 12.0
    balls = inventory.body_kinds[bodies] == "ball"
    moments[bodies[balls]] = (_SPHERE * masses[bodies[balls]] * squares[balls].max(axis=1) / 4.0)[:, None]
    return moments


DOUBTFUL_SHARE = 0.5
"""Part of its largest kinetic energy from which on a shard that got so much from the solver flies on that energy."""

ACCEPTED_SHARE = 0.01
"""Energy made by the solver, over what was dissipated, from which on a report warns."""

LARGE_SHARE = 0.05
"""The same, from which on that is said before any result: beside it, distances of debris are doubtful as a whole."""

SMALL_DROP_M = 0.01
"""A fall of all shards. What the solver made is set against its energy where less was dissipated: `LARGE_SHARE` of it
throws one of a hundred equal shards by v² / g = 0.1 m at most, which is `MOVED_M`."""

FARTHEST = 10
"""Shards whose energies the summary names."""

LARGEST_THROW_PER_HEIGHT = 2.0
"""A body that falls by h has at most v² = 2 g h, and that carries it at most v² / g = 2 h over ground that is flat, or
where it lies as low as it fell. One that begins with a speed v₀ has the energy of a fall that is v₀² / 2g higher."""


@dataclass(frozen=True, slots=True, eq=False)
class Throws:
    """Throws of d shards, the largest first, and whether their energy explains them.

    Attributes
    ----------
    bodies, throws_m : (d,) int, (d,) float
        Indices of the shards, and the horizontal distances of their last positions from the first.
    made_j, largest_kinetic_j : (d,) float
        Energy that each got from the solver, and the largest kinetic energy of its translation at the end of a frame.
    on_solver_energy : (d,) bool
        Whether at least half of that kinetic energy was made by the solver.
    beyond_fall : (d,) bool
        Whether they flew farther than twice the height of a fall with all their energy: down to the ground, and by the
        height that their own speed at the beginning, and a ball's, make up for. Never where charges went off, nor where
        the solver made less than the energy that is lacking: such a shard has slid or rolled.
    """

    bodies: np.ndarray
    throws_m: np.ndarray
    made_j: np.ndarray
    largest_kinetic_j: np.ndarray
    on_solver_energy: np.ndarray
    beyond_fall: np.ndarray

    @property
    def made_shares(self) -> np.ndarray:
        """Return the energy (d,) that each got from the solver, over its largest kinetic energy."""
        kinetic = self.largest_kinetic_j
        return np.divide(self.made_j, kinetic, out=np.zeros_like(kinetic), where=kinetic > 0.0)

    @property
    def doubtful(self) -> np.ndarray:
        """Return which throws (d,) a real shard would not make."""
        return self.on_solver_energy | self.beyond_fall


def throws_of(results: Results) -> Throws:
    frames, shards = results.frames, results.inventory.of_kind("shard")
    first, last = frames.positions_m[0, shards], frames.positions_m[-1, shards]
    throws = throw(first, last)
    order = np.argsort(-throws, kind="stable")
    ground = results.ground()
    # To the ground below, or to where it lies, down a slope, if that is lower.
    lowest = 0.0 if ground.is_flat else np.minimum(ground.heights_at(first[:, :2]), last[:, 2])
    shards, throws, heights = shards[order], throws[order], (first[:, 2] - lowest)[order]
    made = np.nansum(frames.work.made_j[:, shards], axis=0)
    masses_kg = results.inventory.masses_kg[shards]
    squares = dot(frames.velocities_m_s[:, shards], frames.velocities_m_s[:, shards])
    kinetic = 0.5 * masses_kg * squares.max(axis=0)
    heights = np.maximum(heights, 0.0) + (squares[0] + _square_of_balls(results)) / (2.0 * STANDARD_GRAVITY_M_S2)
    beyond = throws > LARGEST_THROW_PER_HEIGHT * heights
    if is_known(results):
        lacking_j = masses_kg * STANDARD_GRAVITY_M_S2 * (throws / LARGEST_THROW_PER_HEIGHT - heights)
        beyond &= lacking_j <= np.nansum(frames.work.made_j)
    if frames.blast_impulses_ns.any():
        beyond = np.zeros(len(shards), bool)
    return Throws(shards, throws, made, kinetic, flies_on_solver_energy(throws, made, kinetic), beyond)


def _square_of_balls(results: Results) -> float:
    """Return the square of the largest speed of a ball, which it gives to what it strikes; 0 without one."""
    velocities = results.frames.velocities_m_s[:, results.inventory.of_kind("ball")]
    return float(dot(velocities, velocities).max(initial=0.0))


def flies_on_solver_energy(throws_m: np.ndarray, made_j: np.ndarray, largest_kinetic_j: np.ndarray) -> np.ndarray:
    """Return whether bodies (n,) were thrown, with at least half of their kinetic energy from the solver."""
    return (throws_m > MOVED_M) & (made_j > 0.0) & (made_j >= DOUBTFUL_SHARE * largest_kinetic_j)


def energy_summary(results: Results) -> dict[str, Any] | None:
    """Return the energies of a run, J, and of the shards thrown farthest, ready for JSON; None if unknown."""
    if not is_known(results):
        return None
    work = results.frames.work
    totals = {field.name: float(np.nansum(getattr(work, field.name))) for field in fields(work)}
    names, farthest = results.inventory.body_names, throws_of(results)
    return {
        "gravity_J": totals["gravity_j"],
        "blast_and_other_loads_J": totals["loads_j"],
        "tools_J": totals["tools_j"],
        "damping_J": totals["damping_j"],
        "dissipated_J": totals["dissipated_j"],
        "dissipated_by_bars_J": _known_sum(work.yielding_j),
        "dissipated_by_crack_friction_J": _known_sum(work.crack_friction_j),
        "made_by_solver": {
            "J": totals["made_j"],
            "share_of_dissipated": made_share(results),
            "share_that_counts": counted_share(results),
            "by_connections_J": totals["made_by_connections_j"],
            "by_contacts_J": totals["made_by_contacts_j"],
            "by_lifting_J": totals["made_by_lifting_j"],
        },
        "doubtful_throws": int(farthest.doubtful.sum()),
        "farthest_shards": [
            {
                "body": str(names[farthest.bodies[row]]),
                "throw_m": float(farthest.throws_m[row]),
                "largest_kinetic_J": float(farthest.largest_kinetic_j[row]),
                "made_by_solver_J": float(farthest.made_j[row]),
                "flies_on_solver_energy": bool(farthest.on_solver_energy[row]),
                "farther_than_a_fall_explains": bool(farthest.beyond_fall[row]),
            }
            for row in range(min(FARTHEST, len(farthest.bodies)))
        ],
    }


def _known_sum(of_frames_j: np.ndarray) -> float | None:
    """Return the sum over all frames; None where it is not known of one after the first."""
    return float(np.nansum(of_frames_j)) if np.isfinite(of_frames_j[1:]).all() else None


def is_known(results: Results) -> bool:
    """Return whether the work of every frame after the first is known."""
    return bool(np.isfinite(results.frames.work.gravity_j[1:]).all()) and len(results.frames) > 1


def much_made_text(counted: float, of_dissipated: float) -> str:
    """Return that the solver made much energy by the share that counts, as a sentence without a full stop, or nothing.

    The sentence has the share of what was dissipated.
    """
    if counted <= LARGE_SHARE:
        return ""
    return Text(
        "This run is not to be used for distances: the solver made {} % of what was "
        "dissipated, more than {} %, and debris may be thrown too far",
        f"{100.0 * of_dissipated:.1f}",
        f"{100.0 * LARGE_SHARE:g}",
    )


def made_share(results: Results) -> float:
    """Return the energy that the solver made over what was dissipated; 0 where nothing was."""
    return _made_over(results, 0.0)


def counted_share(results: Results) -> float:
    """Return the energy that the solver made over what was dissipated, or over a small drop where that is more.

    A bridge that stands dissipates next to nothing, so that a joule or two would count as much.
    """
    inventory = results.inventory
    weight_n = STANDARD_GRAVITY_M_S2 * float(inventory.masses_kg[inventory.of_kind("shard")].sum())
    return _made_over(results, weight_n * SMALL_DROP_M)


def _made_over(results: Results, least_j: float) -> float:
    against = max(float(np.nansum(results.frames.work.dissipated_j)), least_j)
    return float(np.nansum(results.frames.work.made_j)) / against if against > 0.0 else 0.0
