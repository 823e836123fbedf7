"""Bullet's own constraints of footings and pads, which lift off."""

from __future__ import annotations

import numpy as np

from ...bullet.constraint_rows import ConstraintRows
from ...engineering.elasticity.bearings import Bearings
from ...engineering.foundations import Footings


class LiftingConstraints:
    """Makes Bullet's own constraints of footings or pads softer as less of them touches."""

    def __init__(self, law: Footings | Bearings):
        self._law, self._touching = law, np.ones(len(law.rows))

    def begin(self) -> None:
        """Take all of them for touching, as constraints are made."""
        self._touching[:] = 1.0

    def follow(self, constraints: ConstraintRows, softness: np.ndarray, intact: np.ndarray) -> None:
        """Soften constraints (m,) that are intact, of which all (6, m) have a softness where they touch all over."""
        touching, rows = self._law.touching, self._law.rows
        changed = np.flatnonzero((touching != self._touching) & intact[rows])
        if not len(changed):
            return
        share = touching[changed]
        softness = softness[:, rows[changed]]
        softer = np.divide(softness, share, out=np.full_like(softness, np.inf), where=share > 0.0)
        constraints.soften(rows[changed], softer)
        self._touching[changed] = share
