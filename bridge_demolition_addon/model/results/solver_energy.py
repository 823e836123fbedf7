"""Energy that Bullet's solver has made, held against what was dissipated, and the throws that it makes doubtful."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from ...engineering.geometry.vectors import dot
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...texts import Text
from .arrays import Results
from .motion import MOVED_M, throw

DOUBTFUL_SHARE = 0.5
"""Part of its largest kinetic energy from which on a shard that got so much from the solver flies on that energy."""

ACCEPTED_SHARE = 0.01
"""Energy made by the solver, over what was dissipated, from which on a report warns."""

LARGE_SHARE = 0.05
"""The same, from which on that is said before any result: beside it, distances of debris are doubtful as a whole."""

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
        height that the speed with which they began, and that of a ball, make up for. Never where charges went off, nor
        where the solver made less than the energy that is lacking: such a shard has slid or rolled.
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


def much_made_text(share: float) -> str:
    """Return that the solver made much energy, as a sentence without a full stop; empty for little."""
    if share <= LARGE_SHARE:
        return ""
    return Text(
        "This run is not to be used for distances: the solver made {} % of what was "
        "dissipated, more than {} %, and debris may be thrown too far",
        f"{100.0 * share:.1f}",
        f"{100.0 * LARGE_SHARE:g}",
    )


def made_share(results: Results) -> float:
    """Return the energy that the solver made over what was dissipated; 0 where nothing was."""
    dissipated = float(np.nansum(results.frames.work.dissipated_j))
    return float(np.nansum(results.frames.work.made_j)) / dissipated if dissipated > 0.0 else 0.0
