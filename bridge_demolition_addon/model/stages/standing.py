"""Statics of a bridge with some of its connections gone, and its collapse load factor."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from ...engineering.elasticity.equations import connected_parts
from ...engineering.mechanics.joint import Joint
from ...engineering.mechanics.overloads import Overloads
from ...engineering.mechanics.section_cuts import ConnectionLoads, worst_around
from ...engineering.mechanics.section_forces import SectionForces, section_axes
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...errors import ScenarioError
from ..scenario import Scenario
from ..scenario.connections import MATERIAL_OF_LARGE_MODELS
from ..schema import given
from ..structure.equilibrium import at_rest, held_motions, inertias_of, member_sections_of, overloads_of
from ..structure.model import Model

_MOST_ROUNDS = 200
"""A bridge that still breaks after so many breaks, one after another, comes down."""

_FALLEN_SHARE = 0.005
"""Least part of the held mass for a collapse: a splinter that comes loose is not one."""

_LARGEST_FACTOR = 64.0
_PRECISION = 0.01

DIRECTIONS = TENSION, COMPRESSION, SHEAR, TORSION, BENDING, FORCE = (
    "tension",
    "compression",
    "shear",
    "torsion",
    "bending",
    "force",
)
"""Directions of load effects on a connection; the last where one force in any direction breaks it."""


@dataclass(frozen=True, slots=True, eq=False)
class Standing:
    """A bridge at rest."""

    held: np.ndarray  # (n,), shards that connections to a support hold
    loads: ConnectionLoads  # of all m connections, in the axes of the world; 0 for those that are gone
    alone: np.ndarray  # (m,), utilisation of each connection by itself; nan for those that are gone
    together: np.ndarray  # (m,), utilisation of the sections of their members; nan as above
    sag_m: float  # largest downward displacement of a shard
    frequency_hz: float  # first natural frequency

    @property
    def used(self) -> np.ndarray:
        """Utilisation (m,): above 1 a connection breaks, as it and its section are overloaded."""
        return np.minimum(self.alone, self.together)


class StandingBridge:
    """Solves a model with elastic connections at rest, whatever of it is gone; calls `pause` before each solution."""

    def __init__(self, model: Model, joints: Sequence[Joint], pause: Callable[[], None] = lambda: None):
        self.model, self._joints, self._pause = model, joints, pause
        self._masses = np.where(model.fixed, 0.0, model.masses_kg)
        self._inertias, self._held_motions = inertias_of(model), held_motions(model, joints)
        self._axes = section_axes(model.connections.normals)
        self._moves = np.append(~model.fixed, False)
        self._pairs = model.connections.pairs % len(self._moves)
        sections = member_sections_of(model)
        self._judges = [overloads_of(model, joint.strength, sections) if joint.strength else None for joint in joints]

    def rest(
        self,
        intact: np.ndarray,
        left: np.ndarray,
        loads: np.ndarray,
        factor: float = 1.0,
        *,
        every_section: bool = True,
    ) -> Standing:
        """Return the bridge at rest with the connections that are `intact` (m,), and `left` (m,) of their strength.

        Loads (6, n) are forces and moments on the shards, beside their weight; all are times the load factor. Without
        `every_section`, only sections of connections that are overloaded by themselves are judged: no other breaks.
        """
        self._pause()
        model, rows = self.model, np.flatnonzero(intact)
        kept = model.connections.only(intact)
        solution = at_rest(
            kept,
            given(model.stiffness).only(rows),
            self._masses,
            self._inertias,
            model.centres_m,
            self._held_motions[:, rows],
            (0.0, 0.0, -factor * STANDARD_GRAVITY_M_S2),
            factor * loads,
            model.bearings.springs.among(intact) if model.bearings else None,
        )
        carried = np.zeros((6, len(intact)))
        carried[:, rows] = solution.loads
        of_connections = ConnectionLoads(carried[:3].T, carried[3:].T, model.connections.points)
        held = solution.held[:-1]
        alone, together = self._utilisations(of_connections, intact, left, every_section)
        deflections_m = model.centres_m[held, 2] - solution.positions_m[2, :-1][held]
        deflection_m = float(deflections_m.max(initial=0.0))
        return Standing(held, of_connections, alone, together, deflection_m, solution.frequency_hz)

    def comes_down(self, intact: np.ndarray, left: np.ndarray, loads: np.ndarray, factor: float) -> np.ndarray:
        """Return which shards (n,) come down at a load factor, as overloaded connections break one after another.

        Splinters that come loose do not count.
        """
        first = standing = self.rest(intact, left, loads, factor, every_section=False)
        intact, is_collapse = intact.copy(), False
        least = _FALLEN_SHARE * self._masses[first.held].sum()
        rounds = 0
        while rounds < _MOST_ROUNDS:
            broken = self._broken(standing, intact)
            if not len(broken):
                return first.held & ~standing.held & is_collapse
            intact[broken] = False
            standing = self.rest(intact, left, loads, factor, every_section=False)
            rounds += 1
            if not is_collapse and self._masses[first.held & ~standing.held].sum() > least:
                is_collapse, rounds = True, 0
        return first.held & ~standing.held if is_collapse else first.held

    def collapse_factor(self, intact: np.ndarray, left: np.ndarray, loads: np.ndarray) -> float:
        """Return the collapse load factor, within 1 %: ∞ above 64, nan where nothing is held."""
        if not self.rest(intact, left, loads, every_section=False).held.any():
            return np.nan
        low, high = 0.0, 1.0
        while not self.comes_down(intact, left, loads, high).any():
            low, high = high, 2.0 * high
            if high > _LARGEST_FACTOR:
                return np.inf
        while high - low > _PRECISION * high:
            middle = (low + high) / 2.0
            if self.comes_down(intact, left, loads, middle).any():
                high = middle
            else:
                low = middle
        return (low + high) / 2.0

    def governed_by(self, standing: Standing) -> np.ndarray:
        """Return which of `DIRECTIONS` has the largest utilisation of each connection (m,); empty where it is gone."""
        directions = np.full(len(standing.alone), "", dtype=object)
        there = np.isfinite(standing.alone) & self.model.breakable
        for number, judge in enumerate(self._judges):
            rows = np.flatnonzero(there & (self.model.joint_of_connection == number))
            if judge is None:
                directions[rows] = FORCE
            elif len(rows):
                directions[rows] = _directions(judge, rows, standing.loads.in_sections(rows, self._axes[rows]))
        if self.model.bearings:
            pads = self.model.bearings.springs.rows
            directions[pads] = np.where(np.isfinite(standing.alone[pads]), FORCE, "")
        return directions

    def parts(self, intact: np.ndarray) -> np.ndarray:
        """Return which part each connection (m,) holds together; -1 for those that are gone."""
        first, second = self._pairs[intact].T
        label = connected_parts(self._moves, first, second)
        parts = np.full(len(intact), -1)
        parts[intact] = np.where(self._moves[first], label[first], label[second])
        return parts

    def _utilisations(
        self, loads: ConnectionLoads, intact: np.ndarray, left: np.ndarray, every_section: bool
    ) -> tuple[np.ndarray, np.ndarray]:
        alone, together = np.full(len(intact), np.nan), np.full(len(intact), np.nan)
        parts = self.parts(intact)
        breakable = intact & self.model.breakable
        alone[intact & ~breakable] = 0.0
        largest = np.maximum(abs(loads.forces_n).max(axis=1), abs(loads.moments_nm).max(axis=1))
        for number, (joint, judge) in enumerate(zip(self._joints, self._judges, strict=True)):
            rows = np.flatnonzero(breakable & (self.model.joint_of_connection == number))
            if not len(rows):
                continue
            if judge is not None:
                alone[rows] = judge.alone(rows, loads, self._axes[rows], left)
                judged = rows if every_section else rows[alone[rows] > 1.0]
                if len(judged):
                    of_faces, axes = alone[judged], self._axes[judged]
                    together[judged] = judge.together(judged, of_faces, loads, axes, intact, left, parts)
            if joint.breaking_force_n is not None:
                by_force = largest[rows] / (joint.breaking_force_n * left[rows])
                alone[rows] = np.fmax(alone[rows], by_force)
                together[rows] = np.fmax(together[rows], by_force)
        if bearings := self.model.bearings:
            used = np.where(intact[bearings.springs.rows], bearings.utilisations(loads, intact, left), np.nan)
            alone[bearings.springs.rows] = together[bearings.springs.rows] = used
        return alone, together

    def _broken(self, standing: Standing, intact: np.ndarray) -> np.ndarray:
        """Return the overloaded connections (k,), each the worst around."""
        rows = np.flatnonzero(intact & (standing.used > 1.0))
        if not len(rows):
            return rows
        worst = rows[worst_around(self._pairs[rows], standing.together[rows], self._moves)]
        return self.model.bearings.broken_together(worst) if self.model.bearings else worst


def _directions(judge: Overloads, rows: np.ndarray, carried: SectionForces) -> np.ndarray:
    """Return the direction with the largest utilisation of connections (r,) with a strength, each by itself."""
    nothing = {item.name: np.zeros_like(getattr(carried, item.name)) for item in fields(SectionForces)}
    used = [
        judge.of_forces(rows, SectionForces(**nothing | {name: getattr(carried, name)}))
        for name in ("axial_n", "shear_n", "torsion_nm", "bending_nm")
    ]
    names = np.array((TENSION, SHEAR, TORSION, BENDING))[np.argmax(used, axis=0)]
    return np.where((names == TENSION) & (carried.axial_n < 0.0), COMPRESSION, names)


def made_elastic(scenario: Scenario) -> Scenario:
    """Return a scenario with elastic connections; those that break by a force become as stiff as the others.

    Where all do, they are as stiff as reinforced concrete.
    """
    between = tuple(
        replace(table, breaking_force_n=None, breaking_force_kgf=None) for table in scenario.connections.between
    )
    changes: dict[str, Any] = {"stiffness": "elastic", "between": between}
    if scenario.connections.material is None and scenario.connections.method == "face":
        changes |= {"breaking_force_n": None, "breaking_force_kgf": None, "material": MATERIAL_OF_LARGE_MODELS}
    if (method := scenario.connections.method) != "face":
        raise ScenarioError(
            f'connections.method is "{method}": how the bridge stands can only be worked out with '
            f'method = "face", without search_radius_m, and material = "{MATERIAL_OF_LARGE_MODELS}" or another'
        )
    try:
        return replace(scenario, connections=replace(scenario.connections, **changes))
    except ScenarioError as error:
        raise ScenarioError(f"how a bridge rests is worked out with elastic connections, but {error}") from error
