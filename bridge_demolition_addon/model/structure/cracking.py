"""A model whose concrete cracks or is gone, and whose bars hold: at rest, by the law of a run."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from ...engineering.drilled_charges.cages import BareBars, Cages
from ...engineering.elasticity.bearings import Bearings
from ...engineering.elasticity.cracked_equilibrium import BuiltStructure, CrackedStructure, Pause
from ...engineering.elasticity.cracks import Cracks
from ...engineering.elasticity.equations import RigidBodies
from ...engineering.elasticity.equilibrium import Equilibrium
from ...engineering.elasticity.joint_rows import JointFrames, components_first, turned, turned_back
from ...engineering.elasticity.section_stiffness import in_frames
from ...engineering.elasticity.steel_bars import USUAL_STEEL
from ...engineering.elasticity.tendons import TendonForces
from ...engineering.foundations import Footings
from ...engineering.geometry.vectors import product, transformed
from ...engineering.mechanics.crack_faces import CrackFaces, TornFaces
from ...engineering.mechanics.reinforcement import FaceBars
from ...engineering.mechanics.section_cuts import ConnectionLoads
from ...engineering.mechanics.strength import Joint
from ...engineering.structure.connections import GROUND
from ...engineering.units import STANDARD_GRAVITY_M_S2
from ..schema import given
from .equilibrium import held_motions, inertias_of, largest_deflection_m, model_at_rest
from .model import CrackBars, Model
from .utilisation import Utilisations

FALLEN_SHARE = 0.005
"""Least part of the held mass for a collapse: a splinter that comes loose is not one."""


_LARGEST_STEP = 0.1
"""Part of a load by which it grows at once where there are tendons."""

_AT_ONCE = 0.5
"""Share of what bare bars resist where their load comes upon them at once: elastic ones are then pressed up to twice as
much as at rest."""


@dataclass(frozen=True, slots=True, eq=False)
class StandingBare:
    """Bars that stand bare, between points of the bridge as it was built.

    Their ends are held sideways and their load comes upon them slowly, or, `at_worst`, neither.
    """

    bars: BareBars
    at_worst: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class SteelBeside:
    """Steel that helps the connections of a bridge: bars that stand bare, and tendons after the cuts so far."""

    bare: StandingBare | None = None
    tendons: TendonForces | None = None


class CrackedBridge:
    """A model with bars, under loads that grow: what has cracked or yielded stays so.

    `intact` (m,) are its connections that are whole, with a part `left` (m,) of their strength each. At first it is at
    `rest` without cracks, with its tendons, which rupture across cracks. Then bars may stand bare. Without bars across
    faces, what breaks carries nothing.
    """

    def __init__(
        self,
        model: Model,
        joints: Sequence[Joint],
        utilisations: Utilisations,
        intact: np.ndarray,
        left: np.ndarray,
        rest: Equilibrium,
        beside: SteelBeside | None = None,
    ):
        bare, tendons = (beside.bare, beside.tendons) if beside else (None, None)
        self._model, self._utilisations, self._left = model, utilisations, left
        self._masses = np.append(np.where(model.fixed, 0.0, model.masses_kg), 0.0)
        self._inertias = np.vstack((inertias_of(model), np.zeros(3)))
        connections, stiffness = model.connections, given(model.stiffness)
        bars = model.crack_bars or CrackBars(FaceBars.none(len(connections)), USUAL_STEEL)
        self._faces = CrackFaces(connections.areas, model.second_moments_m4, bars.bars)
        has_strength = np.array([joint.strength is not None for joint in joints])[model.joint_of_connection]
        self._tears = has_strength & model.breakable & (model.crack_bars is not None)
        self._first, second = connections.pairs.T
        self._second = np.where(second == GROUND, len(model.shards), second)
        positions = np.vstack((model.centres_m, np.zeros(3)))
        axes = np.repeat(np.eye(3)[:, :, None], len(connections), axis=2)
        levers = [components_first(connections.points - positions[ends]) for ends in (self._first, self._second)]
        tensors, unturned = np.zeros((3, 3, len(positions))), np.repeat(np.eye(3)[:, :, None], len(positions), axis=2)
        tensors[[0, 1, 2], [0, 1, 2]] = self._inertias.T
        bodies = RigidBodies(self._masses, tensors, components_first(positions), unturned)
        ends, positions_built = (self._first, self._second), (bodies.positions_m, unturned)
        soil = Footings(model.soil, *ends, bodies.moves, *positions_built) if model.soil else None
        pads = None
        if model.bearings:
            springs = model.bearings.springs
            pads = Bearings(springs, *ends, self._first[springs.rows], *positions_built)
        of_bars = left.copy() if tendons is None else left * tendons.bars_left(len(left))
        built = BuiltStructure(
            JointFrames(self._first, self._second, axes, axes, *levers),
            in_frames(stiffness, components_first(utilisations.axes), held_motions(model, joints)),
            bodies,
            soil,
            pads,
        )
        cracks = self._faces.cracks(bars.steel, of_bars, stiffness.axial_n_m)
        cages = None if bare is None else _standing(bare, len(connections), bodies, rest)
        self._structure = CrackedStructure(built, cracks, of_bars, intact, rest, cages, tendons)
        self._has_tendons = tendons is not None
        self._carried: float | None = None  # the load factor of the last loads, with tendons
        self._held_at_first = self._structure.held.copy()
        self._judged = np.zeros((6, len(connections)))  # loads, some of them found to overload connections

    def copy(self) -> CrackedBridge:
        """Return one in the same state, that goes on by itself."""
        other = copy(self)
        other._structure = self._structure.copy()
        return other

    def carry(self, factor: float, loads: np.ndarray | None = None, pause: Pause = lambda: None) -> None:
        """Let it come to rest under its weight and loads (6, n) on the shards, times a load factor.

        It may take long: `pause` is called again and again meanwhile.
        """
        self._carry(factor, loads, pause, lambda: False)

    def carries(self, factor: float, loads: np.ndarray, pause: Pause = lambda: None) -> bool:
        """Return whether it carries these, as `carry` has them; what else would come down is left where it is."""
        self._carry(factor, loads, pause, lambda: bool(self.fallen.any()))
        return not self.fallen.any()

    def _carry(self, factor: float, loads: np.ndarray | None, pause: Pause, is_enough: Callable[[], bool]) -> None:
        accelerations = np.zeros((6, len(self._masses)))
        accelerations[2] = -STANDARD_GRAVITY_M_S2 * (self._masses > 0.0)
        if loads is not None:
            inert = np.vstack((np.tile(self._masses, (3, 1)), self._inertias.T))
            on_all = np.column_stack((loads, np.zeros(6)))
            accelerations += np.divide(on_all, inert, out=np.zeros_like(on_all), where=inert > 0.0)
        before, self._carried = self._carried, factor if self._has_tendons else None
        for part in _factors_between(before, factor):
            if not self._structure.load(part * accelerations, self._overloaded, self._tear, pause, is_enough):
                break

    @property
    def held(self) -> np.ndarray:
        """Return which shards (n,) connections or bars hold."""
        return self._structure.held[:-1]

    @property
    def fallen(self) -> np.ndarray:
        """Return which shards (n,) have come down; none where these are but splinters."""
        fallen: np.ndarray = self._held_at_first[:-1] & ~self.held
        least = FALLEN_SHARE * self._masses[self._held_at_first].sum()
        return fallen & bool(self._masses[:-1][fallen].sum() > least)

    @property
    def intact(self) -> np.ndarray:
        """Return which connections (m,) are whole."""
        return self._structure.intact

    @property
    def cracked(self) -> np.ndarray:
        """Return which connections (m,) have cracked, and hold by bars or press."""
        cracked = np.zeros(len(self.intact), bool)
        cracked[self._structure.cracks.rows] = True
        return cracked

    @property
    def bars_used(self) -> np.ndarray:
        """Return the force of the bars of each connection (m,) by that at which they rupture; nan where none hold."""
        used, structure = np.full(len(self.intact), np.nan), self._structure
        used[structure.cracks.rows] = structure.cracks.used(structure.positions_m, structure.rotations)
        return used

    @property
    def loads(self) -> ConnectionLoads:
        """Return the loads of connections and bars on their first shards."""
        loads = self._structure.loads
        return ConnectionLoads(loads[:3].T, loads[3:].T, self._model.connections.points)

    @property
    def bare_n(self) -> np.ndarray:
        """Return the forces (g,) of bars that stand bare, above 0 in tension; 0 for those that are gone."""
        structure = self._structure
        if structure.bare_bars is None:
            return np.zeros(0)
        return structure.bare_bars.forces_n(structure.positions_m, structure.rotations)

    @property
    def deflection_m(self) -> float:
        """Return the largest deflection of a shard that is held, below 0 where it is upwards."""
        fallen = self._model.centres_m[:, 2] - self._structure.positions_m[2, :-1]
        return largest_deflection_m(fallen[self.held])

    @property
    def holding(self) -> np.ndarray:
        """Return which connections (m,) hold, whole or cracked."""
        return self.intact | self.cracked

    def _overloaded(self, loads: np.ndarray, intact: np.ndarray) -> np.ndarray:
        """Connections (k,) that break of loads (6, m), each the worst around; in the axes of the shards they are on."""
        self._judged = loads
        turns = self._structure.rotations[..., self._first]
        forces, moments = (turned_back(turns, vectors).T for vectors in (loads[:3], loads[3:]))
        on_shards = ConnectionLoads(forces, moments, self._model.connections.points)
        parts = self._utilisations.parts(self.holding)
        alone, together = self._utilisations.of(on_shards, intact, self._left, parts, every_section=False)
        return self._utilisations.worst(alone, together, intact)

    def _tear(self, cracks: Cracks, rows: np.ndarray, positions_m: np.ndarray, rotations: np.ndarray) -> None:
        rows = rows[self._tears[rows]]
        if not len(rows):
            return
        turns = np.moveaxis(rotations[..., self._first[rows]], 2, 0)
        first = self._first[rows]
        arms = self._model.connections.points[rows] - self._model.centres_m[first]
        points = positions_m[:, first].T + transformed(turns, arms)
        axes = product(turns, self._utilisations.axes[rows])
        loads = self._judged
        torn = TornFaces(
            rows,
            first,
            self._second[rows],
            points,
            axes,
            np.ones(len(rows)),
            loads[:3, rows].T,
            loads[3:, rows].T,
        )
        self._faces.tear(cracks, torn, positions_m, rotations)


def _factors_between(before: float | None, factor: float) -> list[float]:
    """Return the load factors to go through one after another, from one that was carried before; None for none.

    With tendons, which press cracks, many cracks at once are not solved: bars in them would open too far.
    """
    if before is None or factor <= before:
        return [factor]
    count = math.ceil((factor - before) / (_LARGEST_STEP * factor))
    return [before + (factor - before) * number / count for number in range(1, count + 1)]


def _standing(bare: StandingBare, from_row: int, built: RigidBodies, rest: Equilibrium) -> Cages:
    """Return bars between points of bodies as they were built, without force where these are at rest."""
    share = _AT_ONCE if bare.at_worst else 1.0
    cages = Cages(from_row, held_sideways=not bare.at_worst, share=share, straight=False)
    bars, points = bare.bars, []
    for ends, built_m in ((bars.first, bars.first_points_m), (bars.second, bars.second_points_m)):
        anchors = built_m - built.positions_m[:, ends]
        points.append(rest.positions_m[:, ends] + turned(rest.rotations[..., ends], anchors))
    placed = replace(bars, first_points_m=points[0], second_points_m=points[1])
    cages.add(placed, rest.positions_m, rest.rotations)
    return cages


class RestingModel:
    """A model under its own weight, worked out as it is first asked for, once for all who do."""

    def __init__(self, model: Model, joints: Sequence[Joint]) -> None:
        self.model, self.joints = model, joints
        self._cracked: CrackedBridge | None = None

    @cached_property
    def rest(self) -> Equilibrium:
        """Where it rests without cracks."""
        return model_at_rest(self.model, self.joints)

    def cracked(self, pause: Pause = lambda: None) -> CrackedBridge | None:
        """Return it with its cracks, not to be changed; None without bars."""
        if self._cracked is None:
            self._cracked = cracked_by_weight(self.model, self.joints, self.rest, pause)
        return self._cracked


def cracked_by_weight(
    model: Model, joints: Sequence[Joint], rest: Equilibrium, pause: Pause = lambda: None
) -> CrackedBridge | None:
    """Return a model that cracks under its own weight, which it has at `rest` without cracks; None without bars."""
    if model.crack_bars is None:
        return None
    whole = np.ones(len(model.connections))
    beside = SteelBeside(tendons=model.tendons.forces_of_shards(model.centres_m)) if model.tendons else None
    cracked = CrackedBridge(model, joints, Utilisations(model, joints), whole > 0.0, whole, rest, beside)
    cracked.carry(1.0, pause=pause)
    return cracked
