"""Utilisation of the connections of a model: load over strength, by the rules that break them in a run."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...engineering.elasticity.equations import connected_parts
from ...engineering.mechanics.overloads import Overloads
from ...engineering.mechanics.section_cuts import ConnectionLoads, section_axes, worst_around
from ...engineering.mechanics.strength import Joint
from .equilibrium import member_sections_of, overloads_of
from .model import Model


class Utilisations:
    """Judges all m connections of a model; `judges` has one for each joint, None where a force alone breaks it."""

    def __init__(self, model: Model, joints: Sequence[Joint]):
        self._model, self._joints = model, joints
        self.axes = section_axes(model.connections.normals)
        self._moves = np.append(~model.fixed, False)
        self._pairs = model.connections.pairs % len(self._moves)
        sections = member_sections_of(model)
        self.judges: list[Overloads | None] = [
            overloads_of(model, joint.strength, sections) if joint.strength else None for joint in joints
        ]

    def parts(self, holding: np.ndarray) -> np.ndarray:
        """Return which part each connection (m,) that holds belongs to; -1 for the others."""
        first, second = self._pairs[holding].T
        label = connected_parts(self._moves, first, second)
        parts = np.full(len(holding), -1)
        parts[holding] = np.where(self._moves[first], label[first], label[second])
        return parts

    def of(
        self,
        loads: ConnectionLoads,
        intact: np.ndarray,
        left: np.ndarray,
        parts: np.ndarray,
        *,
        every_section: bool,
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the utilisations (m,) of connections, each by itself and with its section; nan where it is not intact.

        Each has a part `left` (m,) of its strength. Without `every_section`, only sections of connections that are
        overloaded by themselves are judged.
        """
        model, axes = self._model, self.axes
        alone, together = np.full(len(intact), np.nan), np.full(len(intact), np.nan)
        breakable = intact & model.breakable
        alone[intact & ~breakable] = 0.0
        largest = np.maximum(abs(loads.forces_n).max(axis=1), abs(loads.moments_nm).max(axis=1))
        for number, (joint, judge) in enumerate(zip(self._joints, self.judges, strict=True)):
            rows = np.flatnonzero(breakable & (model.joint_of_connection == number))
            if not len(rows):
                continue
            if judge is not None:
                alone[rows] = judge.alone(rows, loads, axes[rows], left)
                judged = rows if every_section else rows[alone[rows] > 1.0]
                if len(judged):
                    together[judged] = judge.together(judged, alone[judged], loads, axes[judged], intact, left, parts)
            if joint.breaking_force_n is not None:
                by_force = largest[rows] / (joint.breaking_force_n * left[rows])
                alone[rows] = np.fmax(alone[rows], by_force)
                together[rows] = np.fmax(together[rows], by_force)
        if bearings := model.bearings:
            used = np.where(intact[bearings.springs.rows], bearings.utilisations(loads, intact, left), np.nan)
            alone[bearings.springs.rows] = together[bearings.springs.rows] = used
        return alone, together

    def worst(self, alone: np.ndarray, together: np.ndarray, intact: np.ndarray) -> np.ndarray:
        """Return the overloaded connections (k,), each the worst around."""
        rows = np.flatnonzero(intact & (np.minimum(alone, together) > 1.0))
        if not len(rows):
            return rows
        worst = rows[worst_around(self._pairs[rows], together[rows], self._moves)]
        return self._model.bearings.broken_together(worst) if self._model.bearings else worst
