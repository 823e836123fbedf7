"""How a bridge stands with some of its connections gone, and at how many times its load it begins to come down."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from ...engineering.elasticity.equations import connected_parts
from ...engineering.elasticity.section_stiffness import SectionStiffness
from ...engineering.mechanics.joint import Joint
from ...engineering.mechanics.overloads import Overloads
from ...engineering.mechanics.section_cuts import ConnectionLoads, worst_around
from ...engineering.mechanics.section_forces import SectionForces, section_axes
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ...errors import ScenarioError
from ..scenario import Scenario
from ..scenario.connections import MATERIAL_OF_LARGE_MODELS
from ..structure.equilibrium import at_rest, held_motions, inertias_of, member_sections_of, overloads_of
from ..structure.model import Model

_MOST_ROUNDS = 200
"""Breaks one after another after which a bridge that still breaks is one that comes down."""

_FALLEN_SHARE = 0.005
"""Part of the mass that is held: what is less, such as a splinter that comes loose, is no collapse."""

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
"""What a connection is used by; the last where one force in any direction breaks it."""


@dataclass(frozen=True, slots=True, eq=False)
class Standing:
    """A bridge at rest.

    Attributes
    ----------
    held : (n,) bool
        Shards that connections to a support hold.
    loads : ConnectionLoads
        Of all m connections, in the axes of the world; 0 for those that are gone.
    alone, together : (m,) float
        Utilisation of each connection by itself, and of the section of its member; nan for those that are gone.
    sag_m, frequency_hz : float
        How far the shard goes down that goes down farthest, and the first frequency.
    """

    held: np.ndarray
    loads: ConnectionLoads
    alone: np.ndarray
    together: np.ndarray
    sag_m: float
    frequency_hz: float

    @property
    def used(self) -> np.ndarray:
        """Utilisation of each connection (m,): above 1 it breaks, as it and its section are overloaded."""
        return np.minimum(self.alone, self.together)


class StandingBridge:
    """Works out how a model stands, whatever of it is gone.

    Parameters
    ----------
    model : Model
        With elastic connections.
    joints : sequence of Joint
        What its connections have in common, and what breaks them; a force by itself where that is what does.
    pause : callable, optional
        Is called before each solution, of which there are many.
    """

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
        """Return how it stands.

        Parameters
        ----------
        intact, left : (m,) bool, (m,) float
            Connections that hold, and what is left of the strength of each.
        loads : (6, n) float
            Forces and moments on the shards, besides their weight.
        factor : float
            How many times as heavy all is.
        every_section : bool
            Whether the sections of all connections are judged, or of those alone that are overloaded by themselves: no
            other breaks.
        """
        self._pause()
        model, rows = self.model, np.flatnonzero(intact)
        kept = model.connections.only(intact)
        found = at_rest(
            kept,
            SectionStiffness(*(getattr(model.stiffness, field.name)[rows] for field in fields(SectionStiffness))),
            self._masses,
            self._inertias,
            model.centres_m,
            self._held_motions[:, rows],
            (0.0, 0.0, -factor * STANDARD_GRAVITY_M_S2),
            factor * loads,
        )
        borne = np.zeros((6, len(intact)))
        borne[:, rows] = found.loads
        of_connections = ConnectionLoads(borne[:3].T, borne[3:].T, model.connections.points)
        held = found.held[:-1]
        alone, together = self._utilisations(of_connections, intact, left, every_section)
        fallen = model.centres_m[held, 2] - found.positions_m[2, :-1][held]
        return Standing(held, of_connections, alone, together, float(fallen.max(initial=0.0)), found.frequency_hz)

    def comes_down(self, intact: np.ndarray, left: np.ndarray, loads: np.ndarray, factor: float) -> np.ndarray:
        """Return which shards (n,) come down at so many times the load: what is overloaded breaks, and so on.

        Splinters that come loose do not count.
        """
        first = standing = self.rest(intact, left, loads, factor, every_section=False)
        intact, weights = intact.copy(), self._masses
        least = _FALLEN_SHARE * weights[first.held].sum()
        for _ in range(_MOST_ROUNDS):
            broken = self._broken(standing, intact)
            if not len(broken):
                return np.zeros(len(weights), bool)
            intact[broken] = False
            standing = self.rest(intact, left, loads, factor, every_section=False)
            loose = first.held & ~standing.held
            if weights[loose].sum() > least:
                return self._all_that_falls(intact, left, loads, factor, first.held)
        return first.held

    def collapse_factor(self, intact: np.ndarray, left: np.ndarray, loads: np.ndarray) -> float:
        """Return at how many times its load it begins to come down, within 1 %.

        ∞ where it bears 64 times its load, nan where nothing is held.
        """
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
        """Return which of `DIRECTIONS` uses most of each connection (m,); empty where one is gone."""
        found = np.full(len(standing.alone), "", dtype=object)
        there = np.isfinite(standing.alone) & self.model.breakable
        for number, judge in enumerate(self._judges):
            rows = np.flatnonzero(there & (self.model.joint_of_connection == number))
            if judge is None:
                found[rows] = FORCE
            elif len(rows):
                found[rows] = _directions(judge, rows, standing.loads.in_sections(rows, self._axes[rows]))
        return found

    def parts(self, intact: np.ndarray) -> np.ndarray:
        """Return which part each connection (m,) holds together; -1 for those that are gone."""
        first, second = self._pairs[intact].T
        label = connected_parts(self._moves, first, second)
        found = np.full(len(intact), -1)
        found[intact] = np.where(self._moves[first], label[first], label[second])
        return found

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
        return alone, together

    def _broken(self, standing: Standing, intact: np.ndarray) -> np.ndarray:
        """Connections (k,) that are overloaded, each the worst around."""
        rows = np.flatnonzero(intact & (standing.used > 1.0))
        if not len(rows):
            return rows
        return rows[worst_around(self._pairs[rows], standing.together[rows], self._moves)]

    def _all_that_falls(
        self, intact: np.ndarray, left: np.ndarray, loads: np.ndarray, factor: float, held: np.ndarray
    ) -> np.ndarray:
        """Shards (n,) that come down once a part has begun to: what is overloaded goes on breaking."""
        standing = self.rest(intact, left, loads, factor, every_section=False)
        for _ in range(_MOST_ROUNDS):
            broken = self._broken(standing, intact)
            if not len(broken):
                break
            intact[broken] = False
            standing = self.rest(intact, left, loads, factor, every_section=False)
        return held & ~standing.held


def _directions(judge: Overloads, rows: np.ndarray, borne: SectionForces) -> np.ndarray:
    """Which direction uses most of connections (r,) that a strength breaks, each direction by itself."""
    nothing = {item.name: np.zeros_like(getattr(borne, item.name)) for item in fields(SectionForces)}
    used = [
        judge.of_forces(rows, SectionForces(**nothing | {name: getattr(borne, name)}))
        for name in ("axial_n", "shear_n", "torsion_nm", "bending_nm")
    ]
    names = np.array((TENSION, SHEAR, TORSION, BENDING))[np.argmax(used, axis=0)]
    return np.where((names == TENSION) & (borne.axial_n < 0.0), COMPRESSION, names)


def made_elastic(scenario: Scenario) -> Scenario:
    """Return a scenario with elastic connections, where they break by a force as stiff as the others.

    Where all do, they are as stiff as reinforced concrete.
    """
    between = tuple(
        replace(each, breaking_force_n=None, breaking_force_kgf=None) for each in scenario.connections.between
    )
    changes: dict[str, Any] = {"stiffness": "elastic", "between": between}
    if scenario.connections.material is None and scenario.connections.method == "face":
        changes |= {"breaking_force_n": None, "breaking_force_kgf": None, "material": MATERIAL_OF_LARGE_MODELS}
    try:
        return replace(scenario, connections=replace(scenario.connections, **changes))
    except ScenarioError as error:
        raise ScenarioError(f"how a bridge rests is worked out with elastic connections, but {error}") from error
